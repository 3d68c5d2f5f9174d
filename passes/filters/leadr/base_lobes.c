#include "passes/filters/leadr/base_lobes.h"

#include "passes/maps/colours/mirrored_luminance.h"
#include "passes/maps/filtered_maps.h"
#include "passes/maps/lobe_map.h"
#include "passes/upload/material_maps.h"
#include "shaders/interface/slope_moments.h"

/// BASE_LOBES_...
static uint32_t variation_of(const device_material *material) {
    const device_map *widths = &material->maps[MAP_WIDTH];
    if (material->material->model != LOBE_MATERIAL_MICROFACET || !widths->use ||
        widths->width * widths->height == 1 || passes_widths_lie_apart(material))
        return BASE_LOBES_ALIKE;
    return passes_mirrored_luminance_varies(material) ? BASE_LOBES_COLOURED : BASE_LOBES_VARY;
}

static void specialise(const filter_context *context, const device_material *material,
                       lobe_pass *pass, specialisation_list *list) {
    (void)context;
    (void)pass;
    passes_specialise(list, SPECIALISE_BASE_LOBES, variation_of(material));
}

static reduced_map make_map(const filter_context *context, uint32_t index, uint32_t variation,
                            bool metallic_varies) {
    const lobe_map_kind kind = {
        .content = "base lobes",
        .pass = "base_lobes",
        .shader = "filters/leadr/base_lobes.comp",
        .seen_shader = "filters/leadr/base_lobes_seen_tiles.comp",
        .binding = "base_lobe_map",
        .layers = 1,
        .reads_base_colour = variation == BASE_LOBES_COLOURED,
        .reads_factors = variation == BASE_LOBES_COLOURED || metallic_varies,
        .read_more = specialise,
    };
    return passes_lobe_map(context, index, &kind, passes_filtered_map_format(context));
}

void passes_base_lobes_build(const filter_context *context, uint32_t index, bool needed,
                             filtered_appearance *appearance) {
    const device_material *material = &context->scene->materials[index];
    const uint32_t variation = needed ? variation_of(material) : BASE_LOBES_ALIKE;
    lobe_resource resource = lobe_graph_import_texture(context->graph, context->scene->white);
    if (variation != BASE_LOBES_ALIKE) {
        const reduced_map map = make_map(context, index, variation, material->metallic_varies);
        appearance->bytes += passes_reduced_map_bytes(&map, passes_filtered_map_format(context));
        resource = map.resource;
    }
    passes_appearance_bind(
        appearance, "base_lobe_map", resource,
        passes_filtered_map_sampler(context, material, passes_lobe_grid(material).map));
    passes_appearance_specialise(appearance, SPECIALISE_BASE_LOBES, variation);
}
