#include "tools/scenes/flag_scene.h"

#include <math.h>
#include <string.h>

#include "scenes/builtin/assembly.h"
#include "scenes/mesh/mesh.h"
#include "scenes/mesh/shape.h"
#include "scenes/scene/scene.h"
#include "tools/scenes/keyed_animation.h"

// Canvas on a pole at x = 0. Two waves run along it; each is the sum of two morph targets, its
// cosine and its sine, whose weights turn with time. Gusts stretch the whole flag.

enum { COLUMNS = 72, ROWS = 48, TEXELS = 256, THREADS = 16, TARGETS = 4, KEYS = 97 };

/// Metres: of the flag, and of a tile of the canvas.
#define WIDTH  1.5f
#define HEIGHT 1.0f
#define TILE   0.25f

#define PERIOD      4.0 ///< seconds
#define MOST_STRAIN 0.3 ///< of the width

/// Of a wave: radians per metre, turns in a period, and metres at the free end.
typedef struct flag_wave {
    double x, y, turns, amplitude;
} flag_wave;

static const flag_wave waves[TARGETS / 2] = {{5.2, 0.9, 2, 0.11}, {9.1, -2.3, 3, 0.035}};

static void fill_canvas(uint32_t column, uint32_t row, void *texel) {
    const double u = 2 * M_PI * THREADS * (column + 0.5) / TEXELS,
                 v = 2 * M_PI * THREADS * (row + 0.5) / TEXELS;
    const double height = 0.5 + 0.27 * sin(u) * sin(v) + 0.2 * cos(2 * v);
    const uint8_t value = (uint8_t)lround(255 * height);
    memcpy(texel, (uint8_t[]){value, value, value, 255}, 4);
}

static lobe_result add_canvas(lobe_scene *scene, const lobe_host *host) {
    static const builtin_map map = {.name = "canvas heights",
                                    .format = LOBE_FORMAT_RGBA8_UNORM,
                                    .width = TEXELS,
                                    .height = TEXELS,
                                    .fill = fill_canvas};
    static const float red[3] = {0.62f, 0.05f, 0.045f};
    lobe_material material;
    lobe_material_default(&material);
    memcpy(material.base_colour, red, sizeof red);
    material.roughness = 0.5f;
    material.distribution = LOBE_DISTRIBUTION_BECKMANN;
    material.double_sided = true;
    material.height_scale = 0.02f;
    const lobe_result result =
        scenes_builtin_add_map(scene, &map, host, &material.height_map.image);
    return result ? result : scenes_add_material(scene, "canvas", &material, host, NULL);
}

// ---------------------------------------------------------------------------------------------
// Cloth

static void fill_vertices(lobe_mesh *mesh) {
    for (uint32_t i = 0; i < mesh->vertex_count; i++) {
        const float x = WIDTH * (float)(i % (COLUMNS + 1)) / COLUMNS,
                    y = HEIGHT * (0.5f - (float)(i / (COLUMNS + 1)) / ROWS); // NOLINT
        mesh->vertices[i] = (lobe_scene_vertex){.position = {x, y, 0},
                                                .normal = {0, 0, 1},
                                                .tangent = {1, 0, 0, 1},
                                                .texture_coordinates = {{x / TILE, -y / TILE}},
                                                .colour = {1, 1, 1, 1}};
    }
    scenes_shape_grid_indices(ROWS, COLUMNS, mesh->indices);
    mesh->has_texture_coordinates[0] = true;
    scenes_mesh_compute_bounds(mesh);
}

/// z of a wave's cosine (`phase` 0) or sine, and its slopes. Waves grow from the pole, which holds
/// the flag: amplitude times (1 - cos) of up to half a turn, over 2.
static lobe_morph_delta delta_at(const flag_wave *wave, double phase, const float position[3]) {
    const double turn = M_PI / (double)WIDTH, x = (double)position[0], y = (double)position[1];
    const double size = 0.5 * wave->amplitude * (1 - cos(turn * x)),
                 growth = 0.5 * wave->amplitude * turn * sin(turn * x);
    const double angle = wave->x * x + wave->y * y - phase;
    return (lobe_morph_delta){.position = {0, 0, (float)(size * cos(angle))},
                              .normal = {(float)(size * wave->x * sin(angle) - growth * cos(angle)),
                                         (float)(size * wave->y * sin(angle)), 0}};
}

static bool allocate_targets(lobe_mesh *mesh, const lobe_allocator *allocator) {
    lobe_deformation *d = mesh->deformation = lobe_allocate(allocator, 1, sizeof *d);
    if (!d)
        return false;
    const size_t count = mesh->vertex_count * TARGETS;
    d->first_deltas = lobe_allocate(allocator, mesh->vertex_count + 1, sizeof *d->first_deltas);
    d->deltas = lobe_allocate(allocator, count, sizeof *d->deltas);
    d->weights = lobe_allocate(allocator, TARGETS, sizeof *d->weights);
    return d->first_deltas && d->deltas && d->weights;
}

static void fill_targets(lobe_mesh *mesh) {
    lobe_deformation *d = mesh->deformation;
    d->target_count = TARGETS;
    for (size_t i = 0; i < mesh->vertex_count; i++) {
        for (uint32_t k = 0; k < TARGETS; k++) {
            d->deltas[d->delta_count] =
                delta_at(&waves[k / 2], k % 2 * 0.5 * M_PI, mesh->vertices[i].position);
            d->deltas[d->delta_count++].target = k;
        }
        d->first_deltas[i + 1] = (uint32_t)d->delta_count;
    }
}

static lobe_result add_cloth(lobe_scene *scene, const lobe_host *host) {
    lobe_mesh mesh;
    const lobe_result result = scenes_mesh_allocate(
        &mesh, "flag", (size_t)(COLUMNS + 1) * (ROWS + 1), (size_t)6 * COLUMNS * ROWS, host);
    if (result != LOBE_OK)
        return result;
    fill_vertices(&mesh);
    if (!allocate_targets(&mesh, lobe_host_allocator(host))) {
        scenes_mesh_free(&mesh);
        return lobe_host_fail(host, LOBE_ERROR_OUT_OF_MEMORY, "flag: out of memory");
    }
    fill_targets(&mesh);
    return scenes_place_mesh(scene, &mesh, 0, host);
}

// ---------------------------------------------------------------------------------------------
// Wind

static void fill_keys(lobe_animation_channel *wind, lobe_animation_channel *gusts) {
    for (size_t i = 0; i < KEYS; i++) {
        const double turn = 2 * M_PI * (double)i / (KEYS - 1);
        for (size_t k = 0; k < TARGETS; k++) {
            const double angle = waves[k / 2].turns * turn;
            wind->values[TARGETS * i + k] = (float)(k % 2 == 0 ? cos(angle) : sin(angle));
        }
        gusts->values[3 * i] = (float)(1 + MOST_STRAIN * 0.5 * (1 - cos(turn)));
        gusts->values[3 * i + 1] = gusts->values[3 * i + 2] = 1;
    }
}

static bool add_animation(lobe_rig *rig, const lobe_allocator *allocator) {
    static const keyed_channel channels[] = {{LOBE_CHANNEL_WEIGHTS, TARGETS},
                                             {LOBE_CHANNEL_SCALE, 3}};
    if (!keyed_animation_add(rig, "wind", PERIOD, KEYS, channels, 2, allocator))
        return false;
    fill_keys(&rig->animations[0].channels[0], &rig->animations[0].channels[1]);
    return true;
}

static bool add_node(lobe_rig *rig, const lobe_allocator *allocator) {
    rig->nodes = lobe_allocate(allocator, 1, sizeof *rig->nodes);
    if (!rig->nodes)
        return false;
    rig->node_count = 1;
    rig->nodes[0] =
        (lobe_node){.name = lobe_copy_text(allocator, "flag"),
                    .parent = -1,
                    .rotation = {0, 0, 0, 1},
                    .scale = {1, 1, 1},
                    .weights = lobe_allocate(allocator, TARGETS, sizeof *rig->nodes[0].weights),
                    .weight_count = TARGETS};
    return rig->nodes[0].name && rig->nodes[0].weights;
}

static void measure_targets(const lobe_mesh *mesh, lobe_box boxes[TARGETS]) {
    const lobe_deformation *d = mesh->deformation;
    for (size_t i = 0; i < d->delta_count; i++) {
        lobe_box *box = &boxes[d->deltas[i].target];
        box->minimum[2] = fminf(box->minimum[2], d->deltas[i].position[2]);
        box->maximum[2] = fmaxf(box->maximum[2], d->deltas[i].position[2]);
    }
}

/// The mesh and its instance follow the node.
static bool add_followers(lobe_rig *rig, const lobe_mesh *mesh, const lobe_allocator *allocator) {
    rig->instances = lobe_allocate(allocator, 1, sizeof *rig->instances);
    rig->meshes = lobe_allocate(allocator, 1, sizeof *rig->meshes);
    if (!rig->instances || !rig->meshes)
        return false;
    rig->instance_count = rig->mesh_count = 1;
    rig->instances[0] = (lobe_posed_instance){.skinned_mesh = -1};
    rig->meshes[0] = (lobe_posed_mesh){
        .skin = -1,
        .target_bounds = lobe_allocate(allocator, TARGETS, sizeof *rig->meshes[0].target_bounds)};
    if (!rig->meshes[0].target_bounds)
        return false;
    memcpy(rig->meshes[0].bounds.minimum, mesh->minimum, sizeof mesh->minimum);
    memcpy(rig->meshes[0].bounds.maximum, mesh->maximum, sizeof mesh->maximum);
    measure_targets(mesh, rig->meshes[0].target_bounds);
    return true;
}

static lobe_result add_wind(lobe_scene *scene, const lobe_host *host) {
    const lobe_allocator *allocator = lobe_host_allocator(host);
    lobe_rig *rig = scene->rig = lobe_allocate(allocator, 1, sizeof *rig);
    if (!rig || !add_node(rig, allocator) || !add_animation(rig, allocator) ||
        !add_followers(rig, &scene->meshes[0], allocator))
        return lobe_host_fail(host, LOBE_ERROR_OUT_OF_MEMORY, "flag: out of memory");
    rig->camera_node = -1;
    return LOBE_OK;
}

static lobe_result add_view(lobe_scene *scene, const lobe_host *host) {
    static const lobe_light lights[] = {
        {.type = LOBE_LIGHT_DIRECTIONAL,
         .direction = {0.48f, -0.6f, -0.64f},
         .intensity = {3, 2.8f, 2.4f}},
        {.type = LOBE_LIGHT_DIRECTIONAL,
         .direction = {-0.8f, 0, -0.6f},
         .intensity = {0.4f, 0.6f, 1}},
    };
    scenes_set_camera(scene, (float[]){0.8f, 0.1f, 2.2f}, (float[]){0.95f, 0, 0}, 38);
    scene->background[0] = 0.3f;
    scene->background[1] = 0.42f;
    scene->background[2] = 0.6f;
    return scenes_add_lights(scene, lights, sizeof lights / sizeof *lights, host);
}

lobe_result flag_scene(const char *assets, const lobe_host *host, lobe_scene **scene) {
    static const builtin_step steps[] = {add_canvas, add_cloth, add_wind, add_view, NULL};
    (void)assets;
    return scenes_builtin_assemble("flag", steps, host, scene);
}
