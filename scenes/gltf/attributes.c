#include "scenes/gltf/attributes.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

// Kinds of component that an attribute may have, as bit flags.
enum {
    KIND_FLOAT = 1,
    KIND_UNSIGNED_BYTE = 2,
    KIND_UNSIGNED_SHORT = 4,
    KIND_BYTE = 8,
    KIND_SHORT = 16,
    KIND_NORMALISED = 32, // shift from plain integers to normalised ones
    UNSIGNED_NORMALISED = (KIND_UNSIGNED_BYTE | KIND_UNSIGNED_SHORT) * KIND_NORMALISED,
    SIGNED_NORMALISED = (KIND_BYTE | KIND_SHORT) * KIND_NORMALISED,
    ANY_INTEGER =
        (KIND_UNSIGNED_BYTE | KIND_UNSIGNED_SHORT | KIND_BYTE | KIND_SHORT) * (1 + KIND_NORMALISED),
};

typedef struct attribute_rule {
    const char *name;
    unsigned minimum_channels, maximum_channels;
    unsigned kinds, quantised_kinds;
} attribute_rule;

// glTF 2.0, section 3.7.2.1, and KHR_mesh_quantization.
static const attribute_rule rules[GLTF_ATTRIBUTE_COUNT] = {
    [GLTF_POSITION] = {"POSITION", 3, 3, KIND_FLOAT, ANY_INTEGER},
    [GLTF_NORMAL] = {"NORMAL", 3, 3, KIND_FLOAT, SIGNED_NORMALISED},
    [GLTF_TANGENT] = {"TANGENT", 4, 4, KIND_FLOAT, SIGNED_NORMALISED},
    [GLTF_TEXCOORD_0] = {"TEXCOORD_0", 2, 2, KIND_FLOAT | UNSIGNED_NORMALISED, ANY_INTEGER},
    [GLTF_TEXCOORD_1] = {"TEXCOORD_1", 2, 2, KIND_FLOAT | UNSIGNED_NORMALISED, ANY_INTEGER},
    [GLTF_COLOR_0] = {"COLOR_0", 3, 4, KIND_FLOAT | UNSIGNED_NORMALISED, 0},
    [GLTF_JOINTS_0] = {"JOINTS_0", 4, 4, KIND_UNSIGNED_BYTE | KIND_UNSIGNED_SHORT, 0},
    [GLTF_JOINTS_1] = {"JOINTS_1", 4, 4, KIND_UNSIGNED_BYTE | KIND_UNSIGNED_SHORT, 0},
    [GLTF_WEIGHTS_0] = {"WEIGHTS_0", 4, 4, KIND_FLOAT | UNSIGNED_NORMALISED, 0},
    [GLTF_WEIGHTS_1] = {"WEIGHTS_1", 4, 4, KIND_FLOAT | UNSIGNED_NORMALISED, 0},
};

static unsigned kind_of(const gltf_elements *elements) {
    unsigned shift = elements->normalised ? KIND_NORMALISED : 1;
    switch (elements->component) {
    case GLTF_FLOAT:
        return KIND_FLOAT;
    case GLTF_UNSIGNED_BYTE:
        return KIND_UNSIGNED_BYTE * shift;
    case GLTF_UNSIGNED_SHORT:
        return KIND_UNSIGNED_SHORT * shift;
    case GLTF_BYTE:
        return KIND_BYTE * shift;
    case GLTF_SHORT:
        return KIND_SHORT * shift;
    default:
        return 0;
    }
}

static lobe_result open_checked(const gltf_import *import, const attribute_rule *rule, int accessor,
                                const char *what, gltf_elements *elements) {
    lobe_result result = scenes_gltf_open_accessor(import, accessor, what, elements);
    if (result != LOBE_OK)
        return result;
    unsigned kinds = rule->kinds | (import->quantised ? rule->quantised_kinds : 0);
    if (elements->channels < rule->minimum_channels ||
        elements->channels > rule->maximum_channels || !(kind_of(elements) & kinds))
        return lobe_host_fail(import->host, LOBE_ERROR_MALFORMED,
                              "%s: %s: %u components of type %d%s are not allowed", import->path,
                              what, elements->channels, elements->component,
                              elements->normalised ? ", normalised," : "");
    return LOBE_OK;
}

static lobe_result check_count(const gltf_import *import, const gltf_elements *elements,
                               size_t count, const char *what) {
    if (elements->count == count)
        return LOBE_OK;
    return lobe_host_fail(import->host, LOBE_ERROR_MALFORMED,
                          "%s: %s: %zu elements for %zu positions", import->path, what,
                          elements->count, count);
}

static lobe_result open_attribute(const gltf_import *import, const gltf_primitive *primitive,
                                  gltf_attribute attribute, gltf_attributes *attributes) {
    gltf_elements *elements = &attributes->elements[attribute];
    char what[192];
    snprintf(what, sizeof what, "%s of %s", rules[attribute].name, attributes->name);
    lobe_result result =
        open_checked(import, &rules[attribute], primitive->attributes[attribute], what, elements);
    if (result == LOBE_OK)
        result = check_count(import, elements, attributes->elements[GLTF_POSITION].count, what);
    attributes->present[attribute] = result == LOBE_OK;
    return result;
}

lobe_result scenes_gltf_open_target(const gltf_import *import, const gltf_attributes *attributes,
                                    gltf_attribute attribute, int accessor, size_t target,
                                    gltf_elements *elements) {
    attribute_rule rule = rules[attribute];
    rule.minimum_channels = rule.maximum_channels = 3; // a tangent's handedness stays
    char what[192];
    snprintf(what, sizeof what, "%s of morph target %zu of %s", rule.name, target,
             attributes->name);
    lobe_result result = open_checked(import, &rule, accessor, what, elements);
    return result == LOBE_OK
               ? check_count(import, elements, attributes->elements[GLTF_POSITION].count, what)
               : result;
}

lobe_result scenes_gltf_open_attributes(const gltf_import *import, const gltf_primitive *primitive,
                                        const char *name, gltf_attributes *attributes) {
    *attributes = (gltf_attributes){.name = name};
    for (int i = 0; i < GLTF_ATTRIBUTE_COUNT; i++) {
        if (primitive->attributes[i] < 0)
            continue;
        lobe_result result = open_attribute(import, primitive, (gltf_attribute)i, attributes);
        if (result != LOBE_OK)
            return result;
    }
    return LOBE_OK;
}

static float *destination(lobe_scene_vertex *vertex, gltf_attribute attribute) {
    switch (attribute) {
    case GLTF_POSITION:
        return vertex->position;
    case GLTF_NORMAL:
        return vertex->normal;
    case GLTF_TANGENT:
        return vertex->tangent;
    case GLTF_TEXCOORD_0:
        return vertex->texture_coordinates[0];
    case GLTF_TEXCOORD_1:
        return vertex->texture_coordinates[1];
    default:
        return vertex->colour;
    }
}

static lobe_result read_attribute(const gltf_import *import, const gltf_attributes *attributes,
                                  gltf_attribute attribute, const uint32_t *source,
                                  lobe_mesh *mesh) {
    const gltf_elements *elements = &attributes->elements[attribute];
    for (size_t i = 0; i < mesh->vertex_count; i++) {
        float values[4] = {0};
        size_t element = source ? source[i] : i;
        scenes_gltf_read_floats(elements, element, values);
        for (unsigned c = 0; c < elements->channels; c++) {
            if (!isfinite(values[c]))
                return lobe_host_fail(import->host, LOBE_ERROR_MALFORMED,
                                      "%s: %s: %s of vertex %zu is not finite", import->path,
                                      attributes->name, rules[attribute].name, element);
        }
        // A colour with three channels keeps its initial alpha of 1.
        memcpy(destination(&mesh->vertices[i], attribute), values,
               elements->channels * sizeof(float));
    }
    return LOBE_OK;
}

lobe_result scenes_gltf_read_vertices(const gltf_import *import, const gltf_attributes *attributes,
                                      const uint32_t *source, lobe_mesh *mesh) {
    // Joints and their weights are no part of a vertex.
    for (int i = 0; i <= GLTF_COLOR_0; i++) {
        if (!attributes->present[i])
            continue;
        lobe_result result = read_attribute(import, attributes, (gltf_attribute)i, source, mesh);
        if (result != LOBE_OK)
            return result;
    }
    mesh->has_texture_coordinates[0] = attributes->present[GLTF_TEXCOORD_0];
    mesh->has_texture_coordinates[1] = attributes->present[GLTF_TEXCOORD_1];
    mesh->has_colour = attributes->present[GLTF_COLOR_0];
    return LOBE_OK;
}
