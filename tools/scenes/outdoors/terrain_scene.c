#include "tools/scenes/outdoors/terrain_scene.h"

#include <math.h>
#include <string.h>

#include "scenes/builtin/assembly.h"
#include "scenes/scene/scene.h"
#include "tools/scenes/keyed_animation.h"
#include "tools/scenes/outdoors/daylight_light.h"
#include "tools/scenes/outdoors/wide_grid.h"

/// Metres: the map's width, and how high it is in the middle of the valley.
#define TILE   4096.0
#define VALLEY (0.2 * TERRAIN_RELIEF * TILE)

enum { KEYS = 241 };

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

/// 32 metres from one row to the next in the middle, 64 texels of the map, and 24 km in all.
static lobe_result add_ground(lobe_scene *scene, const lobe_host *host) {
    static const wide_grid ground = {.name = "ground",
                                     .cells = 256,
                                     .width = 1446,
                                     .growth = 2.833,
                                     .height = -VALLEY,
                                     .tile = TILE,
                                     .middle_of_tile = 0.5};
    return wide_grid_add(scene, &ground, host);
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

static void fill_keys(lobe_animation_channel *places, lobe_animation_channel *rotations) {
    for (size_t i = 0; i < KEYS; i++) {
        const double part = (double)i / (KEYS - 1);
        const vector3 place = place_on_flight(part);
        vector3_store(place, &places->values[3 * i]);
        rotation_at(place, &rotations->values[4 * i]);
    }
}

static bool add_animation(lobe_rig *rig, const lobe_allocator *allocator) {
    static const keyed_channel channels[] = {{LOBE_CHANNEL_TRANSLATION, 3},
                                             {LOBE_CHANNEL_ROTATION, 4}};
    if (!keyed_animation_add(rig, "flight", PERIOD, KEYS, channels, 2, allocator))
        return false;
    fill_keys(&rig->animations[0].channels[0], &rig->animations[0].channels[1]);
    return true;
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
