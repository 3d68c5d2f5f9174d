#include <math.h>
#include <stdio.h>
#include <string.h>

#include "scenes/animation/posed_numbers.h"
#include "scenes/gltf/gltf.h"
#include "scenes/scene/scene.h"

// OpenGL's constants, which glTF 2.0 keeps (sections 5.26.1 and 5.26.3).
enum {
    FILTER_NEAREST = 9728,
    FILTER_LINEAR = 9729,
    WRAP_CLAMP = 33071,
    WRAP_MIRROR = 33648,
    WRAP_REPEAT = 10497
};

static bool convert_wrap(int wrap, lobe_scene_wrap *converted) {
    switch (wrap) {
    case -1:
    case WRAP_REPEAT:
        *converted = LOBE_SCENE_WRAP_REPEAT;
        return true;
    case WRAP_MIRROR:
        *converted = LOBE_SCENE_WRAP_MIRROR;
        return true;
    case WRAP_CLAMP:
        *converted = LOBE_SCENE_WRAP_CLAMP;
        return true;
    default:
        return false;
    }
}

static lobe_result convert_sampler(const gltf_import *import, int sampler, lobe_texture_use *use) {
    if (sampler < 0)
        return LOBE_OK;
    if ((size_t)sampler >= import->document->sampler_count)
        return lobe_host_fail(import->host, LOBE_ERROR_MALFORMED, "%s: there is no sampler %d",
                              import->path, sampler);
    const gltf_sampler *s = &import->document->samplers[sampler];
    bool known = s->magnification == -1 || s->magnification == FILTER_NEAREST ||
                 s->magnification == FILTER_LINEAR;
    use->nearest = s->magnification == FILTER_NEAREST;
    known = convert_wrap(s->wrap_u, &use->wrap_u) && known;
    known = convert_wrap(s->wrap_v, &use->wrap_v) && known;
    if (known)
        return LOBE_OK;
    return lobe_host_fail(import->host, LOBE_ERROR_MALFORMED,
                          "%s: sampler %d: unknown filter %d or wrap mode %d, %d", import->path,
                          sampler, s->magnification, s->wrap_u, s->wrap_v);
}

static lobe_result convert_texture(gltf_import *import, const gltf_texture_reference *reference,
                                   bool colour, lobe_texture_use *use) {
    *use = LOBE_TEXTURE_NONE;
    if (reference->texture < 0)
        return LOBE_OK;
    if ((size_t)reference->texture >= import->document->texture_count)
        return lobe_host_fail(import->host, LOBE_ERROR_MALFORMED, "%s: there is no texture %d",
                              import->path, reference->texture);
    const gltf_texture *texture = &import->document->textures[reference->texture];
    if (texture->image < 0) {
        scenes_gltf_note_unsupported(import, "textures without a PNG or JPEG image");
        return LOBE_OK;
    }
    if (reference->coordinates > 1) {
        scenes_gltf_note_unsupported(import, "textures that use a third set of coordinates");
        return LOBE_OK;
    }
    lobe_texture_use converted = LOBE_TEXTURE_NONE;
    converted.texture_coordinates = (uint32_t)reference->coordinates;
    if (!scenes_map_transform(reference->offset, reference->rotation, reference->scale,
                              converted.transform))
        return lobe_host_fail(import->host, LOBE_ERROR_MALFORMED,
                              "%s: the transform of texture %d is not finite", import->path,
                              reference->texture);
    lobe_result result = convert_sampler(import, texture->sampler, &converted);
    if (result == LOBE_OK)
        result = scenes_gltf_convert_image(import, texture->image, colour, &converted.image);
    if (result == LOBE_OK)
        *use = converted;
    return result;
}

// Clamps a factor to its range and counts the clamped ones.
static float clamp_factor(gltf_import *import, double factor, double maximum) {
    double clamped = fmin(fmax(factor, 0), maximum);
    import->notes.clamped_factors += clamped != factor;
    return (float)clamped;
}

static void convert_factors(gltf_import *import, const gltf_material *from, lobe_material *to) {
    const double largest = 1e6; // of emitted light; beyond it products overflow
    for (int i = 0; i < 4; i++)
        to->base_colour[i] = clamp_factor(import, from->base_colour[i], 1);
    for (int i = 0; i < 3; i++)
        to->emissive[i] =
            clamp_factor(import, from->emissive[i] * from->emissive_strength, largest);
    to->metallic = clamp_factor(import, from->metallic, 1);
    to->roughness = clamp_factor(import, from->roughness, 1);
    to->occlusion_strength = clamp_factor(import, from->occlusion_strength, 1);
    to->alpha_cutoff = clamp_factor(import, from->alpha_cutoff, largest);
    bool reversed = from->normal_scale < 0;
    double scale = clamp_factor(import, fabs(from->normal_scale), largest);
    to->normal_scale = (float)(reversed ? -scale : scale);
    to->double_sided = from->double_sided;
}

static bool is_black(const float colour[3]) {
    return colour[0] == 0 && colour[1] == 0 && colour[2] == 0;
}

/// Whether an animation moves a number of a material of the file.
static bool is_moved(const gltf_import *import, size_t material, lobe_channel_path path) {
    return import->moved_parts && (import->moved_parts[material] & UINT32_C(1) << path);
}

// A map whose factor is zero, and stays so, has no effect, and is neither decoded nor sampled.
static lobe_result convert_maps(gltf_import *import, size_t material, lobe_material *to) {
    const gltf_material *from = &import->document->materials[material];
    const bool glows = is_moved(import, material, LOBE_CHANNEL_EMISSIVE) ||
                       is_moved(import, material, LOBE_CHANNEL_EMISSIVE_STRENGTH);
    const bool tilts = is_moved(import, material, LOBE_CHANNEL_NORMAL_SCALE);
    const bool occludes = is_moved(import, material, LOBE_CHANNEL_OCCLUSION_STRENGTH);
    const bool polishes = is_moved(import, material, LOBE_CHANNEL_METALLIC) ||
                          is_moved(import, material, LOBE_CHANNEL_ROUGHNESS);
    const struct {
        const gltf_texture_reference *reference;
        bool matters, colour;
        lobe_texture_use *use;
    } maps[] = {
        {&from->base_colour_map, true, true, &to->base_colour_map},
        {&from->normal_map, to->normal_scale != 0 || tilts, false, &to->normal_map},
        {&from->emissive_map, !is_black(to->emissive) || glows, true, &to->emissive_map},
        {&from->occlusion_map, to->occlusion_strength > 0 || occludes, false, &to->occlusion_map},
        {&from->metallic_roughness_map, to->metallic > 0 || to->roughness > 0 || polishes, false,
         &to->metallic_roughness_map},
    };
    for (size_t i = 0; i < sizeof maps / sizeof *maps; i++) {
        if (!maps[i].matters)
            continue;
        lobe_result result =
            convert_texture(import, maps[i].reference, maps[i].colour, maps[i].use);
        if (result != LOBE_OK)
            return result;
    }
    return LOBE_OK;
}

static lobe_result convert_alpha_mode(gltf_import *import, const gltf_material *from,
                                      lobe_material *to) {
    to->alpha_mask = strcmp(from->alpha_mode, "MASK") == 0;
    if (strcmp(from->alpha_mode, "BLEND") == 0)
        scenes_gltf_note_unsupported(import, "blending (drawn opaque)");
    else if (!to->alpha_mask && strcmp(from->alpha_mode, "OPAQUE") != 0)
        return lobe_host_fail(import->host, LOBE_ERROR_MALFORMED,
                              "%s: material '%.64s': unknown alpha mode '%.32s'", import->path,
                              from->name, from->alpha_mode);
    return LOBE_OK;
}

static lobe_result add_default_material(gltf_import *import, uint32_t *index) {
    lobe_material material;
    lobe_material_default(&material);
    material.metallic = 1; // glTF 2.0, section 5.22.2
    return scenes_add_material(import->scene, "default", &material, import->host, index);
}

static lobe_result add_material(gltf_import *import, int material, uint32_t *index) {
    const gltf_material *from = &import->document->materials[material];
    lobe_material to;
    lobe_material_default(&to);
    convert_factors(import, from, &to);
    lobe_result result = convert_alpha_mode(import, from, &to);
    if (result == LOBE_OK)
        result = convert_maps(import, (size_t)material, &to);
    if (result != LOBE_OK)
        return result;
    char number[32];
    snprintf(number, sizeof number, "material %d", material);
    return scenes_add_material(import->scene, *from->name ? from->name : number, &to, import->host,
                               index);
}

lobe_result scenes_gltf_convert_material(gltf_import *import, int material, int64_t *converted) {
    size_t count = import->document->material_count;
    if (material >= 0 && (size_t)material >= count)
        return lobe_host_fail(import->host, LOBE_ERROR_MALFORMED, "%s: there is no material %d",
                              import->path, material);
    int64_t *known = &import->materials[material < 0 ? count : (size_t)material];
    if (*known == GLTF_NOT_CONVERTED) {
        uint32_t index = 0;
        lobe_result result = material < 0 ? add_default_material(import, &index)
                                          : add_material(import, material, &index);
        if (result != LOBE_OK)
            return result;
        *known = index;
    }
    *converted = *known;
    return LOBE_OK;
}
