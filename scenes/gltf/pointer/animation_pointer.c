#include "scenes/gltf/pointer/animation_pointer.h"

#include <stdio.h>
#include <string.h>

// ---------------------------------------------------------------------------------------------
// Properties

typedef struct property_name {
    const char *name; ///< after the index
    lobe_channel_path path;
} property_name;

static const property_name node_properties[] = {
    {"translation", LOBE_CHANNEL_TRANSLATION},
    {"rotation", LOBE_CHANNEL_ROTATION},
    {"scale", LOBE_CHANNEL_SCALE},
    {"weights", LOBE_CHANNEL_WEIGHTS},
    {NULL, 0},
};
static const property_name material_properties[] = {
    {"pbrMetallicRoughness/baseColorFactor", LOBE_CHANNEL_BASE_COLOUR},
    {"pbrMetallicRoughness/metallicFactor", LOBE_CHANNEL_METALLIC},
    {"pbrMetallicRoughness/roughnessFactor", LOBE_CHANNEL_ROUGHNESS},
    {"emissiveFactor", LOBE_CHANNEL_EMISSIVE},
    {"extensions/KHR_materials_emissive_strength/emissiveStrength", LOBE_CHANNEL_EMISSIVE_STRENGTH},
    {"normalTexture/scale", LOBE_CHANNEL_NORMAL_SCALE},
    {"occlusionTexture/strength", LOBE_CHANNEL_OCCLUSION_STRENGTH},
    {"alphaCutoff", LOBE_CHANNEL_ALPHA_CUTOFF},
    {NULL, 0},
};
static const property_name light_properties[] = {
    {"color", LOBE_CHANNEL_LIGHT_COLOUR},
    {"intensity", LOBE_CHANNEL_LIGHT_INTENSITY},
    {"range", LOBE_CHANNEL_LIGHT_RANGE},
    {"spot/innerConeAngle", LOBE_CHANNEL_LIGHT_INNER_CONE},
    {"spot/outerConeAngle", LOBE_CHANNEL_LIGHT_OUTER_CONE},
    {NULL, 0},
};
/// After the name of a texture and its extension.
static const property_name place_properties[] = {
    {"offset", LOBE_CHANNEL_MAP_OFFSET},
    {"rotation", LOBE_CHANNEL_MAP_ROTATION},
    {"scale", LOBE_CHANNEL_MAP_SCALE},
    {NULL, 0},
};
static const char *const textures[LOBE_POSED_MAP_COUNT] = {
    [LOBE_POSED_BASE_COLOUR_MAP] = "pbrMetallicRoughness/baseColorTexture",
    [LOBE_POSED_NORMAL_MAP] = "normalTexture",
    [LOBE_POSED_METALLIC_ROUGHNESS_MAP] = "pbrMetallicRoughness/metallicRoughnessTexture",
    [LOBE_POSED_EMISSIVE_MAP] = "emissiveTexture",
    [LOBE_POSED_OCCLUSION_MAP] = "occlusionTexture",
};

static bool find_property(const property_name *list, const char *name, lobe_channel_path *path) {
    for (; list->name; list++) {
        if (strcmp(list->name, name) == 0) {
            *path = list->path;
            return true;
        }
    }
    return false;
}

/// What follows a prefix; NULL: the text does not begin with it.
static const char *after(const char *text, const char *prefix) {
    const size_t length = strlen(prefix);
    return strncmp(text, prefix, length) == 0 ? text + length : NULL;
}

/// The place of a texture. Of a material without the texture it is kept, and moves nothing.
static bool find_place(const char *name, animation_target *target) {
    for (int map = 0; map < LOBE_POSED_MAP_COUNT; map++) {
        const char *rest = after(name, textures[map]);
        rest = rest ? after(rest, "/extensions/KHR_texture_transform/") : NULL;
        if (rest && find_property(place_properties, rest, &target->path)) {
            target->map = (lobe_posed_map)map;
            return true;
        }
    }
    return false;
}

// ---------------------------------------------------------------------------------------------
// Pointers

/// Reads an index and the slash behind it; NULL: there is none.
static const char *read_index(const char *text, size_t *index) {
    const char *at = text;
    for (*index = 0; *at >= '0' && *at <= '9' && *index < 100000000; at++)
        *index = 10 * *index + (size_t)(*at - '0');
    return at > text && *at == '/' && (*text != '0' || at == text + 1) ? at + 1 : NULL;
}

bool scenes_gltf_resolve_pointer(const gltf_import *import, const char *pointer,
                                 animation_target *target, bool *known, char *cause, size_t size) {
    const struct {
        const char *prefix, *name;
        size_t count;
        const property_name *properties;
    } lists[] = {
        {"/nodes/", "node", import->document->node_count, node_properties},
        {"/materials/", "material", import->document->material_count, material_properties},
        {"/extensions/KHR_lights_punctual/lights/", "light", import->document->light_count,
         light_properties},
    };
    *known = false;
    if (pointer[0] != '/') {
        snprintf(cause, size, "it does not begin with '/'");
        return false;
    }
    for (size_t i = 0; i < sizeof lists / sizeof *lists; i++) {
        const char *rest = after(pointer, lists[i].prefix);
        size_t index;
        if (!rest)
            continue;
        rest = read_index(rest, &index);
        if (!rest || index >= lists[i].count) {
            snprintf(cause, size, "there is no such %s; the file has %zu", lists[i].name,
                     lists[i].count);
            return false;
        }
        *known = find_property(lists[i].properties, rest, &target->path) ||
                 (lists[i].properties == material_properties && find_place(rest, target));
        target->node = (int)index;
        target->index = (uint32_t)index;
        break;
    }
    return true;
}

// ---------------------------------------------------------------------------------------------
// Numbers at rest

static bool has_pointers(const gltf_document *document) {
    for (size_t a = 0; a < document->animation_count; a++)
        for (size_t i = 0; i < document->animations[a].channel_count; i++)
            if (document->animations[a].channels[i].pointer)
                return true;
    return false;
}

static void store(const double *from, size_t count, float *to) {
    for (size_t i = 0; i < count; i++)
        to[i] = (float)from[i];
}

static void store_place(const gltf_texture_reference *from, lobe_map_place *to) {
    store(from->offset, 2, to->offset);
    store(&from->rotation, 1, &to->rotation);
    store(from->scale, 2, to->scale);
}

static lobe_material_numbers rest_of_material(const gltf_material *from) {
    lobe_material_numbers to = {
        .metallic = (float)from->metallic,
        .roughness = (float)from->roughness,
        .emissive_strength = (float)from->emissive_strength,
        .normal_scale = (float)from->normal_scale,
        .occlusion_strength = (float)from->occlusion_strength,
        .alpha_cutoff = (float)from->alpha_cutoff,
    };
    store(from->base_colour, 4, to.base_colour);
    store(from->emissive, 3, to.emissive);
    store_place(&from->base_colour_map, &to.maps[LOBE_POSED_BASE_COLOUR_MAP]);
    store_place(&from->normal_map, &to.maps[LOBE_POSED_NORMAL_MAP]);
    store_place(&from->metallic_roughness_map, &to.maps[LOBE_POSED_METALLIC_ROUGHNESS_MAP]);
    store_place(&from->emissive_map, &to.maps[LOBE_POSED_EMISSIVE_MAP]);
    store_place(&from->occlusion_map, &to.maps[LOBE_POSED_OCCLUSION_MAP]);
    return to;
}

static lobe_light_numbers rest_of_light(const gltf_light *from) {
    lobe_light_numbers to = {
        .intensity = (float)from->intensity,
        .range = (float)from->range,
        .inner_cone = (float)from->inner_cone,
        .outer_cone = (float)from->outer_cone,
    };
    store(from->colour, 3, to.colour);
    return to;
}

lobe_result scenes_gltf_begin_numbers(gltf_import *import) {
    const gltf_document *document = import->document;
    const lobe_allocator *allocator = lobe_host_allocator(import->host);
    lobe_rig *rig = import->scene->rig;
    if (!has_pointers(document))
        return LOBE_OK;
    rig->materials = lobe_allocate(allocator, document->material_count + 1, sizeof *rig->materials);
    rig->light_numbers =
        lobe_allocate(allocator, document->light_count + 1, sizeof *rig->light_numbers);
    import->moved_parts =
        lobe_allocate(allocator, document->material_count + 1, sizeof *import->moved_parts);
    if (!rig->materials || !rig->light_numbers || !import->moved_parts)
        return lobe_host_fail(import->host, LOBE_ERROR_OUT_OF_MEMORY, "%s: out of memory",
                              import->path);
    for (size_t i = 0; i < document->material_count; i++)
        rig->materials[rig->material_count++] = (lobe_posed_material){
            .material = -1, .rest = rest_of_material(&document->materials[i])};
    for (size_t i = 0; i < document->light_count; i++)
        rig->light_numbers[rig->light_number_count++] = rest_of_light(&document->lights[i]);
    return LOBE_OK;
}

void scenes_gltf_end_numbers(gltf_import *import) {
    lobe_rig *rig = import->scene->rig;
    for (size_t i = 0; rig && i < rig->material_count; i++)
        if (import->moved_parts[i] != 0)
            rig->materials[i].material = (int32_t)import->materials[i]; // below 0: not converted
}
