#include "tools/scenes/relief/relief_scenes.h"

#include <math.h>
#include <string.h>

#include "scenes/builtin/assembly.h"
#include "scenes/builtin/noise.h"
#include "scenes/builtin/random.h"
#include "scenes/environment/environment.h"
#include "scenes/mesh/shape.h"
#include "scenes/scene/scene.h"

// Wu et al. 2019, "Accurate Appearance Preserving Prefiltering for Rendering Displacement-Mapped
// Surfaces", Fig. 13 to 18: threads, stones and bumps on a curved body and on what it lies on, seen
// from near to far.

enum { TEXELS = 256, THREAD = 16, STONES = 8, STUDS = 8 };

/// Metres: of a map, of the ball's radius, and of the floor's side.
#define TILE   0.1f
#define RADIUS 0.6f
#define FLOOR  20.0f

#define TILES_AROUND 38.0f ///< 2 pi RADIUS / TILE

// ---------------------------------------------------------------------------------------------
// Heights, as fractions of the map's width, and colours

/// Maps end at 0 and 1, and reliefs go below their ground.
static void store_height(void *texel, double texels) {
    *(float *)texel = (float)(0.5 + texels / TEXELS);
}

static void store_colour(uint8_t *texel, const double colour[3], double factor) {
    for (int i = 0; i < 3; i++)
        texel[i] = (uint8_t)lround(255 * fmin(fmax(factor * colour[i], 0), 1));
    texel[3] = 255;
}

/// Of both threads that cross at a texel, in texels: the one along columns passes over two rows and
/// under two.
static void twill_at(uint32_t column, uint32_t row, double heights[2]) {
    const double x = (column + 0.5) / THREAD, y = (row + 0.5) / THREAD;
    const double across[2] = {2 * (x - floor(x)) - 1, 2 * (y - floor(y)) - 1};
    const double along[2] = {(y + floor(x) - 1) / 4, (x + floor(y) - 1) / 4};
    for (int i = 0; i < 2; i++)
        heights[i] = 6 * sqrt(fmax(1 - across[i] * across[i], 0)) +
                     (i ? -2.2 : 2.2) * cos(2 * M_PI * along[i]);
}

static void fill_twill(uint32_t column, uint32_t row, void *texel) {
    double heights[2];
    twill_at(column, row, heights);
    store_height(texel, fmax(heights[0], heights[1]));
}

static void fill_twill_colour(uint32_t column, uint32_t row, void *texel) {
    static const double colours[2][3] = {{0.42, 0.5, 0.72}, {0.87, 0.84, 0.76}};
    double heights[2];
    twill_at(column, row, heights);
    store_colour(texel, colours[heights[1] > heights[0]], 1);
}

/// The stone that a texel is on: 0 at its rim, 1 in its middle; which one is in `stone`.
static double stone_at(uint32_t column, uint32_t row, uint32_t *stone) {
    const double x = (double)STONES * column / TEXELS, y = (double)STONES * row / TEXELS;
    double nearest = 1e9, second = 1e9;
    for (int j = -1; j <= 1; j++)
        for (int i = -1; i <= 1; i++) {
            const int cell[2] = {(int)floor(x) + i, (int)floor(y) + j};
            const uint32_t which =
                (uint32_t)((cell[1] + STONES) % STONES * STONES + (cell[0] + STONES) % STONES);
            random_sequence numbers = scenes_random_start(140 + which);
            const double u = cell[0] + scenes_random_between(&numbers, 0.15, 0.85),
                         v = cell[1] + scenes_random_between(&numbers, 0.15, 0.85);
            const double distance = hypot(x - u, y - v);
            second = fmin(second, fmax(distance, nearest));
            *stone = distance < nearest ? which : *stone;
            nearest = fmin(nearest, distance);
        }
    return fmin((second - nearest) / 0.6, 1);
}

static void fill_cobbles(uint32_t column, uint32_t row, void *texel) {
    uint32_t stone = 0;
    const double inside = stone_at(column, row, &stone);
    const double grain = scenes_noise_gradient(column / 4.0, row / 4.0, TEXELS / 4, 9, NULL);
    store_height(texel, 14 * sqrt(fmax(1 - (1 - inside) * (1 - inside), 0)) + 0.6 * grain);
}

static void fill_cobble_colour(uint32_t column, uint32_t row, void *texel) {
    static const double warm[3] = {0.78, 0.7, 0.6}, cold[3] = {0.55, 0.6, 0.66};
    uint32_t stone = 0;
    const double inside = stone_at(column, row, &stone);
    random_sequence numbers = scenes_random_start(7140 + stone);
    const double tint = scenes_random_between(&numbers, 0, 1);
    double colour[3];
    for (int i = 0; i < 3; i++)
        colour[i] = warm[i] + tint * (cold[i] - warm[i]);
    store_colour(texel, colour, 0.3 + 0.7 * fmin(4 * inside, 1));
}

static void fill_studs(uint32_t column, uint32_t row, void *texel) {
    const double pitch = (double)TEXELS / STUDS, radius = 0.42 * pitch;
    const double x = column + 0.5 - pitch * floor((column + 0.5) / pitch) - 0.5 * pitch,
                 y = row + 0.5 - pitch * floor((row + 0.5) / pitch) - 0.5 * pitch;
    store_height(texel, sqrt(fmax(radius * radius - x * x - y * y, 0)));
}

static void fill_noise(uint32_t column, uint32_t row, void *texel) {
    double height = 0;
    for (uint32_t octave = 0; octave < 3; octave++) {
        const double period = 8 << octave, scale = period / TEXELS;
        height += 32 / period * 7 *
                  scenes_noise_gradient((column + 0.5) * scale, (row + 0.5) * scale,
                                        (uint32_t)period, octave, NULL);
    }
    store_height(texel, height);
}

// ---------------------------------------------------------------------------------------------
// Materials

/// `colours`: NULL: `albedo` everywhere.
static lobe_result add_material(lobe_scene *scene, const char *name, const builtin_map *heights,
                                const builtin_map *colours, float albedo, const lobe_host *host) {
    lobe_material material;
    lobe_material_default(&material);
    material.height_scale = 1;
    material.roughness = 0.6f;
    for (int i = 0; i < 3; i++)
        material.base_colour[i] = colours ? 1 : albedo;
    if (!colours) { // diffuse: lobes without colour
        material.model = LOBE_MATERIAL_HALF_VECTOR_LOBES;
        material.distribution = LOBE_DISTRIBUTION_VMF;
        material.lobe_count = 1;
        material.lobes[0] = (lobe_base_lobe){.direction = {0, 0, 1}, .width = 10};
    }
    lobe_result result = scenes_builtin_add_map(scene, heights, host, &material.height_map.image);
    if (!result && colours)
        result = scenes_builtin_add_map(scene, colours, host, &material.base_colour_map.image);
    return result ? result : scenes_add_material(scene, name, &material, host, NULL);
}

#define HEIGHT_MAP(name, fill)                                                                     \
    &(const builtin_map) {                                                                         \
        name, LOBE_FORMAT_R32_FLOAT, TEXELS, TEXELS, fill                                          \
    }
#define COLOUR_MAP(name, fill)                                                                     \
    &(const builtin_map) {                                                                         \
        name, LOBE_FORMAT_RGBA8_SRGB, TEXELS, TEXELS, fill                                         \
    }

static lobe_result add_twill(lobe_scene *scene, const lobe_host *host) {
    return add_material(scene, "twill", HEIGHT_MAP("twill heights", fill_twill),
                        COLOUR_MAP("twill colours", fill_twill_colour), 1, host);
}

static lobe_result add_cobbles(lobe_scene *scene, const lobe_host *host) {
    return add_material(scene, "cobbles", HEIGHT_MAP("cobble heights", fill_cobbles),
                        COLOUR_MAP("cobble colours", fill_cobble_colour), 1, host);
}

static lobe_result add_two_materials(lobe_scene *scene, float albedo, const lobe_host *host) {
    const lobe_result result =
        add_material(scene, "studs", HEIGHT_MAP("stud heights", fill_studs), NULL, albedo, host);
    return result ? result
                  : add_material(scene, "noise", HEIGHT_MAP("noise heights", fill_noise), NULL,
                                 albedo, host);
}

static lobe_result add_studs(lobe_scene *scene, const lobe_host *host) {
    return add_two_materials(scene, 0.8f, host);
}

static lobe_result add_white_studs(lobe_scene *scene, const lobe_host *host) {
    return add_two_materials(scene, 1, host);
}

// ---------------------------------------------------------------------------------------------
// Bodies and light

static lobe_result add_bodies(lobe_scene *scene, const lobe_host *host) {
    static const float place[16] = {RADIUS, 0, 0,      0, 0, RADIUS, 0, 0,
                                    0,      0, RADIUS, 0, 0, RADIUS, 0, 1};
    lobe_mesh mesh;
    uint32_t index = 0;
    lobe_result result = scenes_shape_sphere(96, 192, TILES_AROUND, TILES_AROUND / 2, host, &mesh);
    if (!result)
        result = scenes_add_mesh(scene, &mesh, host, &index);
    if (!result)
        result = scenes_add_instance(scene, index, 0, place, host);
    if (!result)
        result = scenes_shape_plane(FLOOR, FLOOR, TILE, host, &mesh);
    // The floor's material is the last: the ball's, if there is one.
    return result ? result
                  : scenes_place_mesh(scene, &mesh, (uint32_t)scene->material_count - 1, host);
}

static void look(lobe_scene *scene) {
    scenes_set_camera(scene, (float[]){0.02f, 0.96f, 0.62f}, (float[]){0, 0.9f, 0.52f}, 40);
    scene->background[0] = 0.3f;
    scene->background[1] = 0.36f;
    scene->background[2] = 0.45f;
}

static lobe_result add_sun(lobe_scene *scene, const lobe_host *host) {
    static const lobe_light sun = {.type = LOBE_LIGHT_DIRECTIONAL,
                                   .direction = {0.64f, -0.6f, -0.48f},
                                   .intensity = {3, 2.9f, 2.7f}};
    look(scene);
    return scenes_add_light(scene, &sun, host);
}

static lobe_result add_white_sky(lobe_scene *scene, const lobe_host *host) {
    lobe_environment *environment;
    look(scene);
    lobe_result result = scenes_environment_allocate("white", host, &environment);
    if (result)
        return result;
    lobe_scene_set_environment(scene, environment);
    scene->environment_visible = true;
    result = lobe_image_allocate(&environment->image, LOBE_FORMAT_RGBA32_FLOAT, 8, 4, host);
    for (size_t i = 0; !result && i < (size_t)8 * 4 * 4; i++)
        ((float *)environment->image.texels)[i] = 1;
    return result;
}

lobe_result relief_scene_twill(const char *assets, const lobe_host *host, lobe_scene **scene) {
    static const builtin_step steps[] = {add_twill, add_bodies, add_sun, NULL};
    (void)assets;
    return scenes_builtin_assemble("twill", steps, host, scene);
}

lobe_result relief_scene_cobbles(const char *assets, const lobe_host *host, lobe_scene **scene) {
    static const builtin_step steps[] = {add_cobbles, add_bodies, add_sun, NULL};
    (void)assets;
    return scenes_builtin_assemble("cobbles", steps, host, scene);
}

lobe_result relief_scene_studs(const char *assets, const lobe_host *host, lobe_scene **scene) {
    static const builtin_step steps[] = {add_studs, add_bodies, add_sun, NULL};
    (void)assets;
    return scenes_builtin_assemble("studs", steps, host, scene);
}

lobe_result relief_scene_furnace(const char *assets, const lobe_host *host, lobe_scene **scene) {
    static const builtin_step steps[] = {add_white_studs, add_bodies, add_white_sky, NULL};
    (void)assets;
    return scenes_builtin_assemble("furnace", steps, host, scene);
}
