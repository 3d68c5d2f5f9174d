#ifndef SCENES_GLTF_ATTRIBUTES_H
#define SCENES_GLTF_ATTRIBUTES_H

#include "scenes/gltf/gltf.h"

/// The vertex attributes of one primitive.
typedef struct gltf_attributes {
    const char *name; ///< of the primitive, for messages
    bool present[GLTF_ATTRIBUTE_COUNT];
    gltf_elements elements[GLTF_ATTRIBUTE_COUNT];
} gltf_attributes;

/// Opens all attributes and checks their types (also those of KHR_mesh_quantization if the file
/// uses it) and counts. Positions are required.
lobe_result scenes_gltf_open_attributes(const gltf_import *import, const gltf_primitive *primitive,
                                        const char *name, gltf_attributes *attributes);

/// Fills the vertices of `mesh`: vertex i from element `source[i]`, or from element i if `source`
/// is NULL. LOBE_ERROR_MALFORMED, with the attribute and the element named, if a number is not
/// finite.
lobe_result scenes_gltf_read_vertices(const gltf_import *import, const gltf_attributes *attributes,
                                      const uint32_t *source, lobe_mesh *mesh);

#endif
