#include "tools/scenes/outdoors/terrain_scene.h"

#include <math.h>
#include <string.h>

#include "scenes/builtin/assembly.h"
#include "scenes/mesh/mesh.h"
#include "scenes/mesh/shape.h"
#include "scenes/scene/scene.h"
#include "tools/scenes/outdoors/daylight_light.h"

/// Metres: the map's width, and how high it is in the middle of the valley.
#define TILE   4096.0
#define VALLEY (0.2 * TERRAIN_RELIEF * TILE)

enum { CELLS = 256, KEYS = 241 };

#define PERIOD 20.0 ///< of the flight, seconds

// ---------------------------------------------------------------------------------------------
// Ground

static lobe_result add_image(lobe_scene *scene, const char *name, lobe_format format,
                             const lobe_host *host, int32_t *index) {
    lobe_image none = {.format = format, .width = TERRAIN_TEXELS, .height = TERRAIN_TEXELS};
    uint32_t added = 0;
    const lobe_result result = scenes_add_image(scene, name, &none, host, &added);
    if (result != LOBE_OK)
        return result;
    scene->images[added].on_device = true;
    scene->images[added].normals = LOBE_NORMALS_SIGNED_XY;
    *index = (int32_t)added;
    return LOBE_OK;
}

static lobe_result add_material(lobe_scene *scene, const lobe_host *host) {
    static const float ground[4] = {0.36f, 0.3f, 0.22f, 1};
    lobe_material material;
    lobe_material_default(&material);
    memcpy(material.base_colour, ground, sizeof ground);
    material.roughness = 0.8f;
    material.distribution = LOBE_DISTRIBUTION_BECKMANN;
    material.height_scale = (float)TERRAIN_RELIEF;
    lobe_result result =
        add_image(scene, TERRAIN_HEIGHTS, LOBE_FORMAT_R32_FLOAT, host, &material.height_map.image);
    if (result == LOBE_OK)
        result = add_image(scene, TERRAIN_NORMALS, LOBE_FORMAT_RG16_FLOAT, host,
                           &material.normal_map.image);
    return result ? result : scenes_add_material(scene, "ground", &material, host, NULL);
}

/// Metres from the middle for each row and column: 32 there, 64 texels of the map, and 24 km in
/// all.
static float line_of_grid(uint32_t index) {
    return (float)(1446.0 * sinh(2.833 * (2.0 * index / CELLS - 1)));
}

static lobe_result add_ground(lobe_scene *scene, const lobe_host *host) {
    lobe_mesh mesh;
    const lobe_result result = scenes_mesh_allocate(&mesh, "ground", (CELLS + 1) * (CELLS + 1),
                                                    (size_t)CELLS * CELLS * 6, host);
    if (result != LOBE_OK)
        return result;
    mesh.has_texture_coordinates[0] = true;
    for (uint32_t row = 0; row <= CELLS; row++)
        for (uint32_t column = 0; column <= CELLS; column++) {
            const float x = line_of_grid(column), z = line_of_grid(row);
            mesh.vertices[row * (CELLS + 1) + column] = (lobe_scene_vertex){
                .position = {x, (float)-VALLEY, z},
                .normal = {0, 1, 0},
                .tangent = {1, 0, 0, 1},
                .texture_coordinates = {{(float)(x / TILE + 0.5), (float)(z / TILE + 0.5)}},
                .colour = {1, 1, 1, 1}};
        }
    scenes_shape_grid_indices(CELLS, CELLS, mesh.indices);
    return scenes_place_mesh(scene, &mesh, 0, host);
}

// ---------------------------------------------------------------------------------------------
// Flight

/// Where the camera is after a part of its flight; it looks at the origin.
static vector3 place_on_flight(double part) {
    const double angle = 2 * M_PI * part, away = 0.5 * (1 - cos(angle));
    const double radius = 80 + 1500 * away;
    return (vector3){radius * sin(angle), 67 + 500 * away, radius * cos(angle)};
}

/// The rotation that turns -z to the origin and keeps x level, as a quaternion (x, y, z, w).
static void rotation_at(vector3 place, float rotation[4]) {
    const double turn = atan2(place.x, place.z), tilt = -atan2(place.y, hypot(place.x, place.z));
    rotation[0] = (float)(sin(0.5 * tilt) * cos(0.5 * turn));
    rotation[1] = (float)(cos(0.5 * tilt) * sin(0.5 * turn));
    rotation[2] = (float)(-sin(0.5 * tilt) * sin(0.5 * turn));
    rotation[3] = (float)(cos(0.5 * tilt) * cos(0.5 * turn));
}

static bool allocate_channel(lobe_animation_channel *channel, lobe_channel_path path, size_t width,
                             const lobe_allocator *allocator) {
    *channel = (lobe_animation_channel){
        .path = path,
        .interpolation = LOBE_INTERPOLATION_LINEAR,
        .times = lobe_allocate(allocator, KEYS, sizeof *channel->times),
        .key_count = KEYS,
        .width = width,
        .values = lobe_allocate(allocator, KEYS * width, sizeof *channel->values),
    };
    return channel->times && channel->values;
}

static void fill_keys(lobe_animation_channel *places, lobe_animation_channel *rotations) {
    for (size_t i = 0; i < KEYS; i++) {
        const double part = (double)i / (KEYS - 1);
        const vector3 place = place_on_flight(part);
        places->times[i] = rotations->times[i] = (float)(PERIOD * part);
        vector3_store(place, &places->values[3 * i]);
        rotation_at(place, &rotations->values[4 * i]);
    }
}

static bool add_animation(lobe_rig *rig, const lobe_allocator *allocator) {
    lobe_animation *animation = rig->animations =
        lobe_allocate(allocator, 1, sizeof *rig->animations);
    if (!animation)
        return false;
    rig->animation_count = 1;
    animation->name = lobe_copy_text(allocator, "flight");
    animation->channels = lobe_allocate(allocator, 2, sizeof *animation->channels);
    animation->duration = PERIOD;
    if (!animation->name || !animation->channels)
        return false;
    animation->channel_count = 2;
    const bool done =
        allocate_channel(&animation->channels[0], LOBE_CHANNEL_TRANSLATION, 3, allocator) &&
        allocate_channel(&animation->channels[1], LOBE_CHANNEL_ROTATION, 4, allocator);
    if (done)
        fill_keys(&animation->channels[0], &animation->channels[1]);
    return done;
}

static bool add_node(lobe_rig *rig, const lobe_allocator *allocator) {
    const vector3 start = place_on_flight(0);
    lobe_node *node = rig->nodes = lobe_allocate(allocator, 1, sizeof *rig->nodes);
    if (!node)
        return false;
    rig->node_count = 1;
    *node =
        (lobe_node){.name = lobe_copy_text(allocator, "camera"), .parent = -1, .scale = {1, 1, 1}};
    vector3_store(start, node->translation);
    rotation_at(start, node->rotation);
    rig->camera_node = 0;
    rig->camera_distance = vector3_length(start);
    return node->name;
}

static lobe_result add_flight(lobe_scene *scene, const lobe_host *host) {
    const lobe_allocator *allocator = lobe_host_allocator(host);
    lobe_rig *rig = scene->rig = lobe_allocate(allocator, 1, sizeof *rig);
    if (!rig || !add_node(rig, allocator) || !add_animation(rig, allocator))
        return lobe_host_fail(host, LOBE_ERROR_OUT_OF_MEMORY, "terrain: out of memory");
    return LOBE_OK;
}

static lobe_result add_view(lobe_scene *scene, const lobe_host *host) {
    static const daylight_light light = {
        .name = "day", .sun = {-0.7, 0.5, 0.35}, .turbidity = 3, .ground = 0.2};
    float eye[3];
    vector3_store(place_on_flight(0), eye);
    scenes_set_camera(scene, eye, (float[]){0, 0, 0}, 40);
    return daylight_light_add(scene, &light, host);
}

lobe_result terrain_scene(const char *assets, const lobe_host *host, lobe_scene **scene) {
    static const builtin_step steps[] = {add_material, add_ground, add_view, add_flight, NULL};
    (void)assets;
    return scenes_builtin_assemble("terrain", steps, host, scene);
}
