#ifndef LOBE_ANIMATION_H
#define LOBE_ANIMATION_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include <lobe/api.h>
#include <lobe/host.h>
#include <lobe/result.h>

#ifdef __cplusplus
extern "C" {
#endif

/// What moves in a scene: nodes, animations of them, and what follows them, as in glTF 2.0
/// (sections 3.5, 3.7.3 and 3.11). lobe_scene_set_pose moves the scene to a time of an animation.
/// A rig is plain data, allocated with lobe_allocate and owned by its scene.

struct lobe_scene;

/// A node at rest. Its transform to its parent is T R S, or `matrix`.
typedef struct lobe_node {
    char *name;
    int32_t parent; ///< index, below its own; -1: none
    bool has_matrix;
    float matrix[16]; ///< column-major, affine
    float translation[3];
    float rotation[4]; ///< a quaternion (x, y, z, w) of any length above 0
    float scale[3];
    float *weights; ///< of its mesh's morph targets
    size_t weight_count;
} lobe_node;

/// Maps of a material whose place can move.
typedef enum lobe_posed_map {
    LOBE_POSED_BASE_COLOUR_MAP,
    LOBE_POSED_NORMAL_MAP,
    LOBE_POSED_METALLIC_ROUGHNESS_MAP,
    LOBE_POSED_EMISSIVE_MAP,
    LOBE_POSED_OCCLUSION_MAP,
    LOBE_POSED_MAP_COUNT,
} lobe_posed_map;

/// What a channel moves, and how many values a key has.
typedef enum lobe_channel_path {
    // Of a node.
    LOBE_CHANNEL_TRANSLATION, ///< three: metres
    LOBE_CHANNEL_ROTATION,    ///< four: a quaternion (x, y, z, w)
    LOBE_CHANNEL_SCALE,       ///< three
    LOBE_CHANNEL_WEIGHTS,     ///< one for each morph target
    // Of a material (KHR_animation_pointer): see lobe_material_numbers.
    LOBE_CHANNEL_BASE_COLOUR,        ///< four
    LOBE_CHANNEL_METALLIC,           ///< one
    LOBE_CHANNEL_ROUGHNESS,          ///< one
    LOBE_CHANNEL_EMISSIVE,           ///< three
    LOBE_CHANNEL_EMISSIVE_STRENGTH,  ///< one
    LOBE_CHANNEL_NORMAL_SCALE,       ///< one
    LOBE_CHANNEL_OCCLUSION_STRENGTH, ///< one
    LOBE_CHANNEL_ALPHA_CUTOFF,       ///< one
    LOBE_CHANNEL_MAP_OFFSET,         ///< two
    LOBE_CHANNEL_MAP_ROTATION,       ///< one: radians
    LOBE_CHANNEL_MAP_SCALE,          ///< two
    // Of a light: see lobe_light_numbers.
    LOBE_CHANNEL_LIGHT_COLOUR,     ///< three
    LOBE_CHANNEL_LIGHT_INTENSITY,  ///< one
    LOBE_CHANNEL_LIGHT_RANGE,      ///< one
    LOBE_CHANNEL_LIGHT_INNER_CONE, ///< one: radians
    LOBE_CHANNEL_LIGHT_OUTER_CONE, ///< one: radians
    LOBE_CHANNEL_PATH_COUNT,
} lobe_channel_path;

/// glTF 2.0, appendix C.
typedef enum lobe_interpolation {
    LOBE_INTERPOLATION_STEP,   ///< the last key's values
    LOBE_INTERPOLATION_LINEAR, ///< of rotations: along the shorter arc, at constant speed (slerp)
    LOBE_INTERPOLATION_CUBIC,  ///< Hermite splines; rotations are made unit length after that
} lobe_interpolation;

/// Key frames of one property.
typedef struct lobe_animation_channel {
    uint32_t target; ///< index into the rig's nodes, materials or light_numbers, as the path says
    lobe_channel_path path;
    lobe_interpolation interpolation;
    float *times; ///< seconds, at least 0, increasing. Before the first and after the last key the
                  ///< value is that key's.
    size_t key_count; ///< at least 1
    size_t width;     ///< values of a key
    /// `width` values for each key; of a cubic spline three times as many: its in-tangent, its
    /// values, its out-tangent (per second).
    float *values;
    lobe_posed_map map; ///< for LOBE_CHANNEL_MAP_...
} lobe_animation_channel;

typedef struct lobe_animation {
    char *name; ///< "" if it has none
    lobe_animation_channel *channels;
    size_t channel_count;
    double duration; ///< seconds: the last key of all channels
} lobe_animation;

typedef struct lobe_skin {
    char *name;
    uint32_t *joints;                   ///< nodes
    float (*inverse_bind_matrices)[16]; ///< base mesh to joint, column-major, affine
    size_t joint_count;                 ///< [1, LOBE_MAXIMUM_JOINTS]
} lobe_skin;

/// An instance that follows a node, or of a mesh with a skin, which takes no node's transform.
typedef struct lobe_posed_instance {
    uint32_t instance;
    int32_t node;         ///< -1: none
    int32_t skinned_mesh; ///< index into the rig's meshes; -1: none
    bool reflected;       ///< its mesh is reflected in x: see lobe_instance.transform
    bool flat;            ///< scaled to nothing by the pose, and hidden for that
} lobe_posed_instance;

/// A box around points: minimum and maximum.
typedef struct lobe_box {
    float minimum[3], maximum[3];
} lobe_box;

/// A mesh with a lobe_deformation whose pose follows nodes.
typedef struct lobe_posed_mesh {
    uint32_t mesh;
    int32_t skin; ///< -1: none
    int32_t node; ///< whose morph weights it takes; -1: none
    /// Of the base vertices: all, and one for each joint of those that it moves (a minimum above
    /// the maximum: none).
    lobe_box bounds, *joint_bounds;
    lobe_box *target_bounds; ///< one for each target: of its deltas' positions
} lobe_posed_mesh;

/// What can move of a light, as in KHR_lights_punctual.
typedef struct lobe_light_numbers {
    float colour[3]; ///< linear RGB
    float intensity; ///< times the colour: see lobe_light.intensity
    float range;
    float inner_cone, outer_cone;
} lobe_light_numbers;

typedef struct lobe_posed_light {
    uint32_t light;
    int32_t node;    ///< whose place and direction it takes; -1: none
    int32_t numbers; ///< index into the rig's light_numbers; -1: its own stay
} lobe_posed_light;

/// Where a map lies, as in KHR_texture_transform.
typedef struct lobe_map_place {
    float offset[2], rotation, scale[2];
} lobe_map_place;

/// What can move of a material: see lobe_material.
typedef struct lobe_material_numbers {
    float base_colour[4];
    float metallic, roughness;
    float emissive[3]; ///< times the strength
    float emissive_strength;
    float normal_scale, occlusion_strength, alpha_cutoff;
    lobe_map_place maps[LOBE_POSED_MAP_COUNT];
} lobe_material_numbers;

/// A material of which channels move something. What none of them moves, a pose leaves alone.
typedef struct lobe_posed_material {
    int32_t material; ///< -1: not in the scene
    lobe_material_numbers rest;
    uint32_t version; ///< increases with each pose that changes the material
} lobe_posed_material;

typedef struct lobe_rig {
    lobe_node *nodes;
    size_t node_count;
    lobe_skin *skins;
    size_t skin_count;
    lobe_animation *animations;
    size_t animation_count;
    // What follows the nodes. To move something by other means, take it off its list.
    lobe_posed_instance *instances;
    size_t instance_count;
    lobe_posed_mesh *meshes;
    size_t mesh_count;
    lobe_posed_light *lights;
    size_t light_count;
    lobe_light_numbers *light_numbers; ///< at rest
    size_t light_number_count;
    lobe_posed_material *materials;
    size_t material_count;
    int32_t camera_node;    ///< -1: the scene's camera stays
    double camera_distance; ///< from its eye to its target, metres
} lobe_rig;

/// Values of lobe_pose.animation that are no index.
#define LOBE_ANIMATION_NONE ((size_t)-1) ///< the nodes at rest
#define LOBE_ANIMATION_ALL  ((size_t)-2) ///< all at once; of two for one property, the later

typedef struct lobe_pose {
    size_t animation; ///< index; 0: the first
    /// Of any sign. An animation begins at 0 and repeats after its duration, which shows its
    /// beginning again.
    double seconds;
    bool once; ///< it does not repeat: before its beginning and after its end it stands still
} lobe_pose;

/// Moves a scene to a pose: writes the transforms of instances, lights, the camera, the poses of
/// meshes, numbers of materials, and the bounds of meshes and of the scene. These are read in every
/// frame: nothing has to be announced to renderers. (Of materials, each renderer compares the rig's
/// versions.) Numbers that an animation takes out of their range are those at its end. Bounds of a
/// deformed mesh contain it, but may be larger. An instance that the pose scales to nothing is
/// hidden until it no longer does.
///
/// A file's scene is opened at rest. `pose`: NULL for the first animation at 0 s. A scene without a
/// rig, or an animation of none, has only its pose at rest. Errors: LOBE_ERROR_INVALID_ARGUMENT (no
/// such animation, a time that is not finite), LOBE_ERROR_MALFORMED (a rig of the host's with an
/// index out of range, or a number that is not finite), LOBE_ERROR_LIMIT (farther than 1e18 m from
/// the origin), LOBE_ERROR_OUT_OF_MEMORY. The scene has not changed then, except that after
/// LOBE_ERROR_LIMIT of its bounds it is at rest.
LOBE_API lobe_result lobe_scene_set_pose(struct lobe_scene *scene, const lobe_pose *pose,
                                         const lobe_host *host);

/// Finds an animation by its name; the first of several. LOBE_ERROR_NOT_FOUND, with a line that
/// lists the names there are; `*animation` is unchanged then.
LOBE_API lobe_result lobe_scene_find_animation(const struct lobe_scene *scene, const char *name,
                                               const lobe_host *host, size_t *animation);

#ifdef __cplusplus
}
#endif

#endif
