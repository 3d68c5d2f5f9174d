#ifndef LOBE_DEFORMATION_H
#define LOBE_DEFORMATION_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/// How the vertices of a mesh follow morph targets and the joints of a skin (glTF 2.0, sections
/// 3.7.2.2 and 3.7.3), and the pose they are in. The renderer deforms the mesh on the device, once
/// for each pose: first by the targets, then by the joints. Normals are transformed by the inverse
/// transpose of the joints' matrices and stay of unit length; tangents stay orthogonal to them and
/// keep their w.
///
/// Like all of a scene plain data, allocated with lobe_allocate and owned by the mesh. The pose
/// (`weights`, `joint_matrices`) is read in every frame. All else is read when the scene is set, or
/// when the mesh is listed among its changes; an index out of range is LOBE_ERROR_MALFORMED then.

/// Largest number of joints of a skin, and of morph targets of a mesh.
#define LOBE_MAXIMUM_JOINTS  65536
#define LOBE_MAXIMUM_TARGETS 8192

/// Largest number of joints that move one vertex.
#define LOBE_MAXIMUM_INFLUENCES 8

/// A joint that moves a vertex, and to which part.
typedef struct lobe_joint_influence {
    uint32_t joint; ///< index into the joint matrices
    float weight;   ///< [0, 1]; those of a vertex sum to 1
} lobe_joint_influence;

/// What a morph target of weight 1 adds to a vertex. 10 words, read by the shaders as they are.
/// Sums need not be of unit length. Of a glTF file's mesh without tangents, those of each target
/// are found from its shape, if the material has a normal map.
typedef struct lobe_morph_delta {
    uint32_t target;
    float position[3], normal[3], tangent[3];
} lobe_morph_delta;

typedef struct lobe_deformation {
    // Morph targets. Only vertices that a target moves have a delta of it.
    size_t target_count;      ///< 0: none
    uint32_t *first_deltas;   ///< vertex_count + 1 numbers: those of vertex i are the deltas
                              ///< [first_deltas[i], first_deltas[i + 1])
    lobe_morph_delta *deltas; ///< in the order of the vertices
    size_t delta_count;
    float *weights; ///< pose: one for each target, of any finite value

    // Skin.
    uint32_t influences_per_vertex;   ///< [0, LOBE_MAXIMUM_INFLUENCES]; 0: none
    lobe_joint_influence *influences; ///< those of vertex i begin at i * influences_per_vertex
    size_t joint_count;
    float (*joint_matrices)[16]; ///< pose: base mesh to object, column-major, affine

    /// The mesh is flat: vertices 3 i to 3 i + 2 are a triangle of their own, whose normal is found
    /// anew in each pose.
    bool flat;
} lobe_deformation;

#ifdef __cplusplus
}
#endif

#endif
