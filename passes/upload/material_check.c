#include <math.h>

#include "passes/upload/number_check.h"
#include "passes/upload/scene_check.h"

enum { OBJECT_SIZE = 160 };

static lobe_result check_texture(const number_owner *owner, const lobe_scene *scene,
                                 const lobe_texture_use *use) {
    char object[OBJECT_SIZE];
    if (use->image < 0)
        return LOBE_OK;
    passes_print_owner(owner, object, sizeof object);
    if ((size_t)use->image >= scene->image_count)
        return lobe_host_fail(owner->host, LOBE_ERROR_MALFORMED, "%s: %s uses image %d of %zu",
                              owner->where, object, use->image, scene->image_count);
    if (use->texture_coordinates > 1)
        return lobe_host_fail(owner->host, LOBE_ERROR_MALFORMED,
                              "%s: %s uses set %u of texture coordinates; there are 0 and 1",
                              owner->where, object, use->texture_coordinates);
    if ((unsigned)use->wrap_u > LOBE_SCENE_WRAP_CLAMP ||
        (unsigned)use->wrap_v > LOBE_SCENE_WRAP_CLAMP)
        return lobe_host_fail(owner->host, LOBE_ERROR_MALFORMED,
                              "%s: %s has a map with the wrapping %d, %d; there are %d to %d",
                              owner->where, object, (int)use->wrap_u, (int)use->wrap_v,
                              LOBE_SCENE_WRAP_REPEAT, LOBE_SCENE_WRAP_CLAMP);
    return passes_check_numbers(owner, "transform of a map", use->transform[0], 6, -INFINITY,
                                INFINITY);
}

static lobe_result check_textures(const number_owner *owner, const lobe_scene *scene,
                                  const lobe_material *material) {
    const lobe_texture_use *uses[] = {
        &material->base_colour_map, &material->normal_map,
        &material->emissive_map,    &material->metallic_roughness_map,
        &material->width_map,       &material->specular_map,
        &material->height_map,      &material->occlusion_map,
    };
    lobe_result result = LOBE_OK;
    for (size_t i = 0; !result && i < sizeof uses / sizeof *uses; i++)
        result = check_texture(owner, scene, uses[i]);
    if (!result && material->normal_map.image >= 0)
        result = passes_scene_check_normals(scene, (size_t)material->normal_map.image, owner->host);
    return result;
}

/// The numbers of both models.
static lobe_result check_factors(const number_owner *owner, const lobe_material *material) {
    const struct {
        const char *name;
        double value, minimum, maximum;
    } members[] = {
        {"model", material->model, LOBE_MATERIAL_MICROFACET, LOBE_MATERIAL_HALF_VECTOR_LOBES},
        {"distribution", material->distribution, LOBE_DISTRIBUTION_GGX, LOBE_DISTRIBUTION_VMF},
        {"space", material->space, LOBE_SPACE_AUTOMATIC, LOBE_SPACE_CAMERA},
        {"normal_scale", material->normal_scale, -INFINITY, INFINITY},
        {"normal_concentration", material->normal_concentration, 0, INFINITY},
        {"height_scale", material->height_scale, -INFINITY, INFINITY},
        {"occlusion_strength", material->occlusion_strength, 0, 1},
        {"alpha_cutoff", material->alpha_cutoff, -INFINITY, INFINITY},
    };
    lobe_result result =
        passes_check_numbers(owner, "base_colour", material->base_colour, 4, 0, INFINITY);
    result = result ? result
                    : passes_check_numbers(owner, "emissive", material->emissive, 3, 0, INFINITY);
    for (size_t i = 0; !result && i < sizeof members / sizeof *members; i++)
        result = passes_check_number(owner, members[i].name, members[i].value, members[i].minimum,
                                     members[i].maximum);
    return result;
}

static lobe_result check_lobe(const number_owner *owner, const lobe_base_lobe *lobe) {
    lobe_result result = passes_check_direction(owner, "a lobe's direction", lobe->direction);
    result = result ? result : passes_check_number(owner, "a lobe's width", lobe->width, 0, 1e6);
    return result ? result
                  : passes_check_numbers(owner, "a lobe's colour", lobe->colour, 3, 0, INFINITY);
}

static lobe_result check_model(const number_owner *owner, const lobe_material *material) {
    char object[OBJECT_SIZE];
    if (material->model == LOBE_MATERIAL_MICROFACET) {
        lobe_result result = passes_check_number(owner, "metallic", material->metallic, 0, 1);
        return result ? result : passes_check_number(owner, "roughness", material->roughness, 0, 1);
    }
    passes_print_owner(owner, object, sizeof object);
    if (material->distribution != LOBE_DISTRIBUTION_BLINN_PHONG &&
        material->distribution != LOBE_DISTRIBUTION_VMF)
        return lobe_host_fail(owner->host, LOBE_ERROR_MALFORMED,
                              "%s: %s: half-vector lobes are Blinn-Phong or von Mises-Fisher "
                              "lobes, not those of distribution %d",
                              owner->where, object, (int)material->distribution);
    if (material->lobe_count < 1 || material->lobe_count > LOBE_MATERIAL_MAXIMUM_LOBES)
        return lobe_host_fail(owner->host, LOBE_ERROR_MALFORMED,
                              "%s: %s has %u lobes; there may be 1 to %d", owner->where, object,
                              material->lobe_count, LOBE_MATERIAL_MAXIMUM_LOBES);
    lobe_result result = LOBE_OK;
    for (uint32_t i = 0; !result && i < material->lobe_count; i++)
        result = check_lobe(owner, &material->lobes[i]);
    return result;
}

/// What waves exclude; NULL: nothing that the material has.
static const char *excluded_by_waves(const lobe_material *material) {
    return material->model != LOBE_MATERIAL_MICROFACET   ? "half-vector lobes"
           : material->normal_map.image >= 0             ? "a normal map"
           : material->height_map.image >= 0             ? "a map of heights"
           : material->metallic_roughness_map.image >= 0 ? "a map of roughness"
           : material->alpha_mask                        ? "a mask"
                                                         : NULL;
}

static lobe_result check_waves(const number_owner *owner, const lobe_material *material) {
    const lobe_waves *waves = &material->waves;
    char object[OBJECT_SIZE];
    if (waves->layers == 0)
        return LOBE_OK;
    passes_print_owner(owner, object, sizeof object);
    if (excluded_by_waves(material))
        return lobe_host_fail(owner->host, LOBE_ERROR_MALFORMED,
                              "%s: %s has waves and %s, which exclude each other", owner->where,
                              object, excluded_by_waves(material));
    lobe_result result =
        passes_check_number(owner, "layers of waves", waves->layers, 1, LOBE_WAVES_MAXIMUM_LAYERS);
    if (!result && (waves->size < 8 || waves->size > 4096 || (waves->size & (waves->size - 1))))
        result = lobe_host_fail(owner->host, LOBE_ERROR_MALFORMED,
                                "%s: %s has waves of %u texels; expected a power of two from 8 to "
                                "4096",
                                owner->where, object, waves->size);
    result = result ? result
                    : passes_check_numbers(owner, "lengths of waves", waves->lengths, waves->layers,
                                           1e-6, 1e9);
    result =
        result ? result : passes_check_numbers(owner, "rest of waves", waves->rest, 3, -100, 100);
    return result ? result
                  : passes_check_numbers(owner, "total of waves", waves->total, 3, -100, 100);
}

lobe_result passes_scene_check_material(const lobe_scene *scene, size_t index,
                                        const lobe_host *host) {
    const lobe_material *material = &scene->materials[index];
    const number_owner owner = {.host = host,
                                .where = scene->name,
                                .kind = "material",
                                .name = material->name,
                                .index = index};
    lobe_result result = check_textures(&owner, scene, material);
    result = result ? result : check_factors(&owner, material);
    result = result ? result : check_model(&owner, material);
    return result ? result : check_waves(&owner, material);
}
