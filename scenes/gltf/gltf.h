#ifndef SCENES_GLTF_H
#define SCENES_GLTF_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include <lobe/host.h>
#include <lobe/result.h>
#include <lobe/scene.h>

#include "third_party/tinygltf.h"

/// Import of a glTF 2.0 file into a scene. Only what the scene's nodes reach is imported: meshes,
/// materials and images are converted when they are first needed.

/// Opens a .gltf or .glb file, recognised by its content; see lobe_scene_open_parameters.
lobe_result scenes_gltf_open(const lobe_scene_open_parameters *parameters, const lobe_host *host,
                             lobe_scene **scene);

// ---------------------------------------------------------------------------------------------
// Shared by the files of the import

/// Limits that keep a small file from using up the machine.
#define GLTF_MAXIMUM_VERTICES      ((size_t)1 << 26) ///< per scene
#define GLTF_MAXIMUM_INDICES       ((size_t)1 << 28) ///< per scene
#define GLTF_MAXIMUM_INSTANCES     ((size_t)1 << 20) ///< per scene
#define GLTF_MAXIMUM_TEXELS        ((size_t)1 << 29) ///< per scene
#define GLTF_MAXIMUM_ZERO_ELEMENTS ((size_t)1 << 20) ///< per accessor without a buffer view
#define GLTF_MAXIMUM_KEY_VALUES    ((size_t)1 << 26) ///< of all animations
#define GLTF_MAXIMUM_DELTAS        ((size_t)1 << 25) ///< of morph targets, per scene

/// What was left out or repaired: collected during the import, logged once at its end.
typedef struct gltf_notes {
    const char *unsupported[32];
    size_t unsupported_count;
    size_t degenerate_triangles, repaired_normals, repaired_tangents, clamped_factors;
    size_t flat_instances, missing_coordinates, unbound_vertices, unit_weights;
} gltf_notes;

/// Index in the scene of something that was converted already, or one of these.
enum { GLTF_NOT_CONVERTED = -1, GLTF_NOTHING_TO_DRAW = -2 };

typedef struct gltf_primitive_state {
    int64_t mesh, mirrored_mesh;
    int64_t material;
    // What deforms its mesh.
    int32_t skin;        ///< of the rig; -1: none
    int64_t weight_node; ///< of the file; -1: it has the weights of its mesh
    int32_t posed_mesh;  ///< of the rig; -1: its pose stays
} gltf_primitive_state;

/// What animations do to a node, or to one above it.
typedef struct gltf_node_motion {
    bool moves;   ///< its transform changes
    bool weights; ///< its own morph weights do
} gltf_node_motion;

typedef struct gltf_import {
    const char *path;
    const lobe_host *host;
    const lobe_file_source *files; ///< NULL: the file system
    bool own_light_only;           ///< no light is added
    const gltf_document *document;
    lobe_scene *scene;
    bool quantised;                   ///< KHR_mesh_quantization is in use
    size_t *first_primitives;         ///< for each mesh, its first in `primitives`
    gltf_primitive_state *primitives; ///< of all meshes
    gltf_primitive_state *deformed;   ///< the same, of the last node that deforms them
    gltf_node_motion *motions;        ///< for each node; NULL: there is no rig
    uint32_t *rig_nodes;              ///< for each node, its index in the rig; NULL: there is none
    int32_t *skins;                   ///< for each, its index in the rig; GLTF_NOT_CONVERTED
    uint32_t *moved_parts;            ///< of each material (scenes_posed_part); NULL: none
    int64_t *materials;               ///< for each, and for the default material
    int64_t *images[2];               ///< for each scene_image_use and image
    size_t vertices, indices, texels; ///< so far, for checking the limits
    size_t key_values, deltas;        ///< the same
    gltf_notes notes;
} gltf_import;

/// Records the name of a feature that is left out. The name must outlive the import.
void scenes_gltf_note_unsupported(gltf_import *import, const char *feature);
/// Logs what was recorded.
void scenes_gltf_report_notes(const gltf_import *import);

/// The checked elements of an accessor: reading one below `count` touches only valid memory.
typedef struct gltf_elements {
    const uint8_t *bytes; ///< NULL: all zero
    size_t count, stride;
    int component;
    unsigned channels;
    bool normalised;
    const uint8_t *sparse_indices, *sparse_values;
    size_t sparse_count;
    int sparse_component;
} gltf_elements;

/// `what` names the use of the accessor in messages. Errors: LOBE_ERROR_MALFORMED (an index or
/// range outside the file, or an unknown type), LOBE_ERROR_LIMIT.
lobe_result scenes_gltf_open_accessor(const gltf_import *import, int accessor, const char *what,
                                      gltf_elements *elements);
/// The same for matrices of 4x4 floats, which scenes_gltf_open_accessor refuses.
lobe_result scenes_gltf_open_matrices(const gltf_import *import, int accessor, const char *what,
                                      gltf_elements *elements);
/// Element `i` of an accessor of matrices.
void scenes_gltf_read_matrix(const gltf_elements *elements, size_t i, float out[16]);
/// Element `i` as numbers, normalised if the accessor says so; writes `elements->channels` values.
void scenes_gltf_read_floats(const gltf_elements *elements, size_t i, float out[4]);
/// Element `i` of an accessor of unsigned integers.
uint32_t scenes_gltf_read_index(const gltf_elements *elements, size_t i);
/// The bytes of a buffer view. LOBE_ERROR_MALFORMED if the file does not contain them.
lobe_result scenes_gltf_open_view(const gltf_import *import, int view, const char *what,
                                  const uint8_t **bytes, size_t *length, size_t *stride);

/// The triangles of a primitive as a list of indices of its accessors' elements; strips and fans
/// are unrolled. `element_count` is the number of positions. The caller frees `*indices`.
lobe_result scenes_gltf_read_triangles(const gltf_import *import, const gltf_primitive *primitive,
                                       const char *name, size_t element_count, uint32_t **indices,
                                       size_t *index_count);

/// Converts primitive `primitive` of mesh `mesh` unless that has been done already. `*state` then
/// holds its mesh and material, or GLTF_NOTHING_TO_DRAW.
lobe_result scenes_gltf_convert_primitive(gltf_import *import, size_t mesh, size_t primitive,
                                          gltf_primitive_state **state);
/// The same for a node whose skin or morph weights deform the mesh: nodes for which it deforms
/// alike share it. `skin`: of the rig; -1: none. `node`: of the file.
lobe_result scenes_gltf_convert_deformed(gltf_import *import, size_t mesh, size_t primitive,
                                         int32_t skin, int node, gltf_primitive_state **state);
/// Makes `state->mirrored_mesh`, the mesh reflected in x.
lobe_result scenes_gltf_convert_mirrored(gltf_import *import, gltf_primitive_state *state);

/// `material` of -1: the default material of glTF.
lobe_result scenes_gltf_convert_material(gltf_import *import, int material, int64_t *converted);

/// The index of an image in the scene, or -1. Decodes the image if it has not been decoded yet.
lobe_result scenes_gltf_convert_image(gltf_import *import, int image, bool colour,
                                      int32_t *converted);

/// Decodes a colour image (RGBA8_SRGB) without adding it to the scene. Free it with
/// lobe_image_free. LOBE_ERROR_MALFORMED if there is no image with this index.
lobe_result scenes_gltf_decode_image(gltf_import *import, int image, lobe_image *decoded);

/// Makes the scene's environment from its image-based light, if it has one.
lobe_result scenes_gltf_convert_environment(gltf_import *import);

/// The index of the scene to open; -1 if the file has none. LOBE_ERROR_MALFORMED if the file's
/// default scene does not exist.
lobe_result scenes_gltf_choose_scene(const gltf_import *import, int *scene);

/// The transform of a node to its parent, column-major. LOBE_ERROR_MALFORMED if it is none.
lobe_result scenes_gltf_local_transform(const gltf_import *import, int node, double out[16]);
/// Places instances, lights and the camera by walking through the nodes.
lobe_result scenes_gltf_convert_nodes(gltf_import *import);
/// `world` is column-major.
lobe_result scenes_gltf_convert_light(gltf_import *import, int light, const double world[16]);
lobe_result scenes_gltf_convert_camera(gltf_import *import, int camera, const double world[16]);
// ---------------------------------------------------------------------------------------------
// Motion

/// Starts the scene's rig if the file has animations, or skins that nodes use: its nodes (in
/// `order`, parents first; `parents` by the file's indices) and its animations.
lobe_result scenes_gltf_begin_rig(gltf_import *import, const int *order, const int *parents);
/// Lets an instance that was just added follow a node. `flat`: it is scaled to nothing at rest.
lobe_result scenes_gltf_pose_instance(gltf_import *import, int node, bool reflected, bool flat);
/// Lets it follow a mesh of the rig that has a skin.
lobe_result scenes_gltf_pose_skinned(gltf_import *import, int32_t posed_mesh);
/// Lets a mesh of the scene follow a skin of the rig (-1: none) and the weights of a node (-1:
/// none).
lobe_result scenes_gltf_pose_mesh(gltf_import *import, uint32_t mesh, int32_t skin,
                                  int64_t weight_node, int32_t *posed_mesh);
/// Lets the light that was just added, `light` of the file, follow a node that moves, or take its
/// numbers from the rig.
lobe_result scenes_gltf_pose_light(gltf_import *import, int node, int light);
/// Puts the scene at rest. Drops a rig that moves nothing.
lobe_result scenes_gltf_end_rig(gltf_import *import);
/// The camera is in its place.
void scenes_gltf_measure_camera(lobe_scene *scene);

/// Converts all animations, for nodes by their indices in the rig, and marks the nodes that they
/// move. Each broken channel is LOBE_ERROR_MALFORMED, with a line that names it.
lobe_result scenes_gltf_convert_animations(gltf_import *import);

/// The index in the rig of a skin of the file.
lobe_result scenes_gltf_convert_skin(gltf_import *import, int skin, int32_t *converted);

/// Number of morph targets of a mesh; LOBE_ERROR_MALFORMED if its primitives differ, or its weights
/// are not as many.
lobe_result scenes_gltf_count_targets(const gltf_import *import, size_t mesh, size_t *count);
/// The morph weights of a mesh at rest, of which a node may have its own (-1: it has not).
/// `weights`: one for each target. LOBE_ERROR_MALFORMED if they are not as many, or not finite.
lobe_result scenes_gltf_read_weights(const gltf_import *import, size_t mesh, int64_t node,
                                     size_t count, float *weights);

/// Moves the camera's target to the depth of the middle of the scene, for orbiting around it.
void scenes_gltf_aim_camera(lobe_scene *scene);

#endif
