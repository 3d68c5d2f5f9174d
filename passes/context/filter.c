#include "passes/context/filter.h"

#include <stdio.h>
#include <string.h>

size_t lobe_filter_count(void) {
    size_t count = 0;
    while (passes_filter_table[count])
        count++;
    return count;
}

const lobe_filter *lobe_filter_get(size_t index) {
    return index < lobe_filter_count() ? passes_filter_table[index] : NULL;
}

void passes_append_name(char *names, size_t size, const char *name) {
    size_t used = strlen(names);
    snprintf(names + used, size - used, "%s%s", used ? ", " : "", name);
}

lobe_result lobe_filter_find(const char *name, const lobe_host *host, const lobe_filter **filter) {
    if (!name || !filter)
        return lobe_host_fail(host, LOBE_ERROR_INVALID_ARGUMENT,
                              "lobe_filter_find: name and filter must not be NULL");
    char names[512] = "";
    for (size_t i = 0; passes_filter_table[i]; i++) {
        if (strcmp(passes_filter_table[i]->name, name) == 0) {
            *filter = passes_filter_table[i];
            return LOBE_OK;
        }
        passes_append_name(names, sizeof names, passes_filter_table[i]->name);
    }
    *filter = NULL;
    lobe_host_log(host, LOBE_LOG_ERROR, "no filter '%s'; the filters are %s", name, names);
    return LOBE_ERROR_NOT_FOUND;
}

const char *lobe_filter_name(const lobe_filter *filter) {
    if (!filter)
        return "";
    return filter->name;
}

const char *lobe_filter_summary(const lobe_filter *filter) {
    if (!filter)
        return "";
    return filter->summary;
}

const char *lobe_filter_paper(const lobe_filter *filter) {
    if (!filter)
        return "";
    return filter->paper;
}

bool lobe_filter_supersamples(const lobe_filter *filter) {
    if (!filter)
        return false;
    return filter->supersamples;
}

bool lobe_filter_fits(const lobe_filter *filter) {
    return filter && filter->save;
}

bool lobe_filter_shares(const lobe_filter *filter) {
    return filter && filter->shares;
}

bool lobe_filter_draws_waves(const lobe_filter *filter) {
    return filter && filter->draws_waves;
}

static void warn_of_waves(const lobe_filter *filter, const lobe_scene *scene,
                          const lobe_host *host) {
    for (size_t i = 0; !filter->draws_waves && i < scene->material_count; i++)
        if (scene->materials[i].waves.layers > 0)
            lobe_host_log(host, LOBE_LOG_WARNING,
                          "%s: material '%s', filter '%s': its waves are not drawn", scene->name,
                          scene->materials[i].name, filter->name);
}

void passes_filter_warn(const lobe_filter *filter, const device_scene *scene,
                        const lobe_host *host) {
    warn_of_waves(filter, scene->scene, host);
    for (size_t i = 0; filter->ignores && i < scene->scene->material_count; i++) {
        const device_material *material = &scene->materials[i];
        const char *limit = material->constants ? filter->ignores(scene->scene, material) : NULL;
        if (limit)
            lobe_host_log(host, LOBE_LOG_WARNING, "%s: material '%s', filter '%s': %s",
                          scene->scene->name, material->material->name, filter->name, limit);
    }
}

// ---------------------------------------------------------------------------------------------
// Appearances

size_t passes_filtered_images_count(const lobe_scene *scene) {
    return scene->image_count + 5 * scene->material_count;
}

filtered_images passes_filtered_images_of(lobe_resource *resources, const lobe_scene *scene) {
    lobe_resource *of_materials = resources + scene->image_count;
    return (filtered_images){.resources = resources,
                             .masked = of_materials,
                             .metal = of_materials + scene->material_count,
                             .normals = of_materials + 2 * scene->material_count,
                             .correlations = of_materials + 3 * scene->material_count,
                             .widths = of_materials + 4 * scene->material_count};
}

void passes_appearance_bind(filtered_appearance *appearance, const char *name,
                            lobe_resource resource, lobe_sampler sampler) {
    if (appearance->binding_count == FILTER_MAXIMUM_BINDINGS) {
        lobe_graph_fail(appearance->graph, LOBE_ERROR_LIMIT,
                        "the filter binds '%s' after %d other resources, which is the limit", name,
                        FILTER_MAXIMUM_BINDINGS);
        return;
    }
    appearance->bindings[appearance->binding_count++] =
        (lobe_binding){.name = name, .resource = resource, .sampler = sampler};
}

void passes_appearance_specialise(filtered_appearance *appearance, uint32_t id, uint32_t bits) {
    if (appearance->specialisation_count == FILTER_MAXIMUM_SPECIALISATIONS) {
        lobe_graph_fail(appearance->graph, LOBE_ERROR_LIMIT,
                        "the filter sets specialisation constant %u after %d others, which is the "
                        "limit",
                        id, FILTER_MAXIMUM_SPECIALISATIONS);
        return;
    }
    appearance->specialisation[appearance->specialisation_count++] =
        (lobe_specialisation){id, bits};
}
