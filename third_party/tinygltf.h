#ifndef THIRD_PARTY_TINYGLTF_H
#define THIRD_PARTY_TINYGLTF_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/// glTF 2.0 through tinygltf, as plain C data.
///
/// Numbers are as the file has them: indices may be out of range, sizes absurd, floats out of
/// their bounds. An index of -1 means "none". Strings are never NULL. Everything belongs to the
/// document.

typedef struct gltf_buffer {
    const uint8_t *data;
    size_t size;
} gltf_buffer;

typedef struct gltf_view {
    int buffer;
    size_t offset, length;
    size_t stride; ///< bytes; 0: elements are packed
} gltf_view;

typedef enum gltf_component {
    GLTF_BYTE = 5120,
    GLTF_UNSIGNED_BYTE = 5121,
    GLTF_SHORT = 5122,
    GLTF_UNSIGNED_SHORT = 5123,
    GLTF_UNSIGNED_INT = 5125,
    GLTF_FLOAT = 5126,
} gltf_component;

typedef struct gltf_sparse {
    size_t count; ///< 0: the accessor is not sparse
    int index_view, value_view;
    size_t index_offset, value_offset;
    int index_component; ///< a gltf_component or garbage
} gltf_sparse;

typedef struct gltf_accessor {
    int view;
    size_t offset, count;
    int component;     ///< a gltf_component or garbage
    unsigned channels; ///< 1 to 4 of a scalar or vector, 16 of a matrix of 4x4; 0: another matrix
    bool normalised;
    gltf_sparse sparse;
} gltf_accessor;

/// Attributes that lobe knows; the rest is only counted.
typedef enum gltf_attribute {
    GLTF_POSITION,
    GLTF_NORMAL,
    GLTF_TANGENT,
    GLTF_TEXCOORD_0,
    GLTF_TEXCOORD_1,
    GLTF_COLOR_0,
    GLTF_JOINTS_0,
    GLTF_JOINTS_1,
    GLTF_WEIGHTS_0,
    GLTF_WEIGHTS_1,
    GLTF_ATTRIBUTE_COUNT
} gltf_attribute;

/// What a morph target adds to: accessors; -1: none.
typedef struct gltf_target {
    int position, normal, tangent;
    bool has_others; ///< attributes that lobe does not know
} gltf_target;

typedef enum gltf_mode {
    GLTF_POINTS,
    GLTF_LINES,
    GLTF_LINE_LOOP,
    GLTF_LINE_STRIP,
    GLTF_TRIANGLES,
    GLTF_TRIANGLE_STRIP,
    GLTF_TRIANGLE_FAN,
} gltf_mode;

typedef struct gltf_primitive {
    int attributes[GLTF_ATTRIBUTE_COUNT]; ///< accessors
    int indices;                          ///< accessor
    int material;
    int mode; ///< a gltf_mode or garbage
    const gltf_target *targets;
    size_t target_count;
    bool has_more_joints; ///< JOINTS_2
} gltf_primitive;

typedef struct gltf_mesh {
    const char *name;
    const gltf_primitive *primitives;
    size_t primitive_count;
    const double *weights; ///< of the morph targets
    size_t weight_count;
} gltf_mesh;

typedef struct gltf_node {
    const char *name;
    int mesh, camera, light, skin;
    const int *children;
    size_t child_count;
    bool has_matrix;
    double matrix[16]; ///< column-major
    double translation[3], rotation[4], scale[3];
    const double *weights; ///< of the mesh's morph targets, instead of its own
    size_t weight_count;
} gltf_node;

typedef struct gltf_skin {
    const char *name;
    const int *joints; ///< nodes
    size_t joint_count;
    int inverse_bind_matrices; ///< accessor
} gltf_skin;

typedef struct gltf_channel {
    int sampler, node;
    const char *path;    ///< "translation", "rotation", "scale", "weights", "pointer" or garbage
    const char *pointer; ///< of KHR_animation_pointer, whatever the node; NULL: there is none
} gltf_channel;

typedef struct gltf_animation_sampler {
    int input, output;         ///< accessors
    const char *interpolation; ///< "STEP", "LINEAR", "CUBICSPLINE" or garbage
} gltf_animation_sampler;

typedef struct gltf_animation {
    const char *name;
    const gltf_channel *channels; ///< those without a node are left out
    size_t channel_count;
    const gltf_animation_sampler *samplers;
    size_t sampler_count;
} gltf_animation;

typedef struct gltf_texture_reference {
    int texture;     ///< index; -1: none
    int coordinates; ///< which set, KHR_texture_transform considered
    double offset[2], rotation, scale[2];
} gltf_texture_reference;

typedef struct gltf_material {
    const char *name;
    double base_colour[4], metallic, roughness;
    double emissive[3], emissive_strength;
    double normal_scale, occlusion_strength;
    gltf_texture_reference base_colour_map, metallic_roughness_map, normal_map, occlusion_map,
        emissive_map;
    const char *alpha_mode; ///< "OPAQUE", "MASK", "BLEND" or garbage
    double alpha_cutoff;
    bool double_sided;
} gltf_material;

typedef struct gltf_texture {
    int image, sampler;
} gltf_texture;

typedef struct gltf_sampler {
    int magnification, wrap_u, wrap_v; ///< OpenGL's numbers; -1: not given
} gltf_sampler;

typedef struct gltf_image {
    const char *name;
    const char *uri; ///< percent-encoded, of an external file; "": none
    int view;        ///< -1: none
    const uint8_t *data;
    size_t size; ///< of a data URI, decoded; 0: none
} gltf_image;

typedef struct gltf_camera {
    bool perspective;
    double field_of_view; ///< vertical, radians
    double height;        ///< orthographic: half of what is seen
    double near_plane;
} gltf_camera;

typedef struct gltf_light {
    const char *type; ///< "directional", "point", "spot" or garbage
    double colour[3], intensity, range, inner_cone, outer_cone;
} gltf_light;

/// EXT_lights_image_based. Of the levels of its cube the first is given.
typedef struct gltf_image_light {
    double rotation[4]; ///< a quaternion (x, y, z, w)
    double intensity;
    int faces[6];       ///< images: +X -X +Y -Y +Z -Z
    bool has_harmonics; ///< of the irradiance
} gltf_image_light;

typedef struct gltf_scene {
    const int *nodes;
    size_t node_count;
    int image_light; ///< index; -1: none
} gltf_scene;

typedef struct gltf_document {
    const gltf_buffer *buffers;
    size_t buffer_count;
    const gltf_view *views;
    size_t view_count;
    const gltf_accessor *accessors;
    size_t accessor_count;
    const gltf_mesh *meshes;
    size_t mesh_count;
    const gltf_node *nodes;
    size_t node_count;
    const gltf_material *materials;
    size_t material_count;
    const gltf_texture *textures;
    size_t texture_count;
    const gltf_sampler *samplers;
    size_t sampler_count;
    const gltf_image *images;
    size_t image_count;
    const gltf_camera *cameras;
    size_t camera_count;
    const gltf_light *lights;
    size_t light_count;
    const gltf_image_light *image_lights;
    size_t image_light_count;
    const gltf_scene *scenes;
    size_t scene_count;
    int scene; ///< the default scene
    const gltf_skin *skins;
    size_t skin_count;
    const gltf_animation *animations;
    size_t animation_count;
    const char *const *extensions; ///< those the file says it uses
    size_t extension_count;
} gltf_document;

typedef struct gltf_source {
    const void *bytes; ///< a whole GLB file, or JSON
    size_t size;
    bool binary;        ///< GLB
    const char *folder; ///< buffers' files are relative to it
    /// Reads an external buffer; `path` is relative to the working directory. NULL: parsing fails.
    /// `release` gets back what was read. Neither may throw.
    void *(*read)(void *user, const char *path, size_t *size);
    void (*release)(void *bytes);
    void *user;
} gltf_source;

/// Parses a document that scenes_json_check (scenes/gltf/json.h) has accepted: tinygltf itself
/// ignores values of a wrong type, and recurses without limit. Images with a file of their own are
/// left to the caller. Returns NULL on failure, `message` (of `message_size` bytes) says why; it is
/// empty where memory ran out. Free with third_party_gltf_document_free.
const gltf_document *third_party_gltf_document_parse(const gltf_source *source, char *message,
                                                     size_t message_size);

/// NULL is allowed.
void third_party_gltf_document_free(const gltf_document *document);

#ifdef __cplusplus
}
#endif

#endif
