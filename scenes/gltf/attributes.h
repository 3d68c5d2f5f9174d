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

/// Fills the mesh's deformation: from the joints of its vertices if `joint_count` is above 0, and
/// from the primitive's morph targets. `source` as above. Weights are normalised to sum to 1, as
/// glTF 2.0 allows (section 3.7.3.3). LOBE_ERROR_MALFORMED names the attribute and the vertex.
lobe_result scenes_gltf_read_deformation(gltf_import *import, const gltf_attributes *attributes,
                                         const gltf_primitive *primitive, const uint32_t *source,
                                         size_t joint_count, lobe_mesh *mesh);

/// Checks what glTF 2.0 allows for morph targets (section 3.7.2.2), which have VEC3 tangents.
lobe_result scenes_gltf_open_target(const gltf_import *import, const gltf_attributes *attributes,
                                    gltf_attribute attribute, int accessor, size_t target,
                                    gltf_elements *elements);

#endif
