#include "scenes/builtin/builtin.h"

#include <math.h>

#include "scenes/builtin/assembly.h"
#include "scenes/builtin/noise.h"
#include "scenes/mesh/circle.h"
#include "scenes/mesh/mesh.h"
#include "scenes/mesh/shape.h"
#include "scenes/scene/scene.h"

// Xu et al. 2017, "Real-Time Linear BRDF MIP-Mapping", Fig. 5 top and section 5.2: a cloth with two
// lobes and a noise normal map of 1024 x 1024 texels. Here the lobes lie at 45 degrees on either
// side of the normal; the paper prints them in the surface plane, with half their energy below it.

enum { MAP_EXTENT = 1024, COLOUR_EXTENT = 512, GRID = 160 };

static const double cloth_side = 1.9;   // metres
static const double table_radius = 0.6; // metres
static const double table_height = 0.8; // metres
static const double rim_radius = 0.04;  // of the rounded edge, metres
static const double tiles = 14;         // repetitions of the maps along a side

// The noise has wavelengths of MAP_EXTENT / period texels; its slopes grow with the period.
typedef struct noise_octave {
    uint32_t period;
    double slope; // scale of the slopes
} noise_octave;

static void fill_normal(uint32_t column, uint32_t row, void *texel) {
    static const noise_octave octaves[] = {{96, 0.06}, {192, 0.22}, {256, 0.22}};
    double sum[2] = {0, 0};
    for (uint32_t i = 0; i < sizeof octaves / sizeof *octaves; i++) {
        double scale = (double)octaves[i].period / MAP_EXTENT, slope[2];
        scenes_noise_gradient((column + 0.5) * scale, (row + 0.5) * scale, octaves[i].period, i,
                              slope);
        sum[0] += slope[0] * octaves[i].slope;
        sum[1] += slope[1] * octaves[i].slope;
    }
    scenes_normal_map_store_slope(texel, sum[0], sum[1]);
}

// A check pattern of two blended bands, as if woven from threads of two colours.
static void fill_colour(uint32_t column, uint32_t row, void *texel) {
    static const double plain[3] = {206, 196, 178}, dyed[3] = {150, 52, 48}; // sRGB
    bool warp = column >= COLOUR_EXTENT / 2, weft = row >= COLOUR_EXTENT / 2;
    bool warp_on_top = (column / 2 + row / 2) % 2 != 0;
    double grain =
        1 + 0.2 * scenes_noise_gradient(column / 8.0, row / 8.0, COLOUR_EXTENT / 8, 7, NULL);
    const double *colour = (warp_on_top ? warp : weft) ? dyed : plain;
    uint8_t *channels = texel;
    for (int channel = 0; channel < 3; channel++)
        channels[channel] = (uint8_t)fmin(colour[channel] * grain + 0.5, 255);
    channels[3] = 255;
}

static lobe_result add_material(lobe_scene *scene, const lobe_host *host) {
    static const builtin_map normals = {"tablecloth normals", LOBE_FORMAT_RGBA8_UNORM, MAP_EXTENT,
                                        MAP_EXTENT, fill_normal};
    static const builtin_map colours = {"tablecloth colours", LOBE_FORMAT_RGBA8_SRGB, COLOUR_EXTENT,
                                        COLOUR_EXTENT, fill_colour};
    const float half_root = 0.70710678f;
    lobe_material material;
    lobe_material_default(&material);
    lobe_result status = scenes_builtin_add_map(scene, &normals, host, &material.normal_map.image);
    if (!status)
        status = scenes_builtin_add_map(scene, &colours, host, &material.base_colour_map.image);
    if (status)
        return status;
    material.model = LOBE_MATERIAL_HALF_VECTOR_LOBES;
    material.distribution = LOBE_DISTRIBUTION_VMF;
    for (int i = 0; i < 2; i++)
        material.lobes[i] =
            (lobe_base_lobe){.direction = {i ? -half_root : half_root, 0, half_root},
                             .width = 128,
                             .colour = {0.25f, 0.25f, 0.25f}};
    material.lobe_count = 2;
    material.double_sided = true;
    return scenes_add_material(scene, "tablecloth", &material, host, NULL);
}

// How far the cloth bends outwards in its folds around the table, between 0 and 1.
static double fold(double cosine, double sine) {
    // Powers of the complex number cosine + i sine multiply its angle by 9 and by 5.
    double re = 1, im = 0, re5 = 1;
    for (int power = 1; power <= 9; power++) {
        double turned = re * cosine - im * sine;
        im = re * sine + im * cosine;
        re = turned;
        re5 = power == 5 ? re : re5;
    }
    return 0.5 + 0.35 * re + 0.15 * re5;
}

// Where the point (x, z) of the flat sheet ends up: flat on the table, around its edge, and down in
// folds. Lengths along the fall are preserved.
static void drape(double x, double z, float position[3]) {
    double distance = sqrt(x * x + z * z), flat = table_radius - rim_radius;
    position[0] = (float)x, position[1] = (float)table_height, position[2] = (float)z;
    if (distance <= flat)
        return;
    double hanging = distance - flat, quarter = rim_radius * 1.5707963267948966;
    double bent = fmin(hanging, quarter), edge[2];
    scenes_circle_point(0.25 * bent / quarter, edge);
    double radius = flat + rim_radius * edge[1], drop = rim_radius * (1 - edge[0]);
    double fall = hanging - bent;
    radius += 0.3 * fall * fall / (fall + 0.08) * fold(x / distance, z / distance);
    drop += fall * 0.97;
    position[0] = (float)(x / distance * radius);
    position[1] = (float)(table_height - drop);
    position[2] = (float)(z / distance * radius);
}

static lobe_result add_cloth(lobe_scene *scene, const lobe_host *host) {
    lobe_mesh mesh;
    lobe_result status = scenes_mesh_allocate(&mesh, "cloth", (size_t)(GRID + 1) * (GRID + 1),
                                              (size_t)GRID * GRID * 6, host);
    if (status)
        return status;
    mesh.has_texture_coordinates[0] = true;
    for (uint32_t i = 0; i < mesh.vertex_count; i++) {
        double u = i % (GRID + 1) / (double)GRID, v = i / (GRID + 1) / (double)GRID;
        drape((u - 0.5) * cloth_side, (v - 0.5) * cloth_side, mesh.vertices[i].position);
        mesh.vertices[i].texture_coordinates[0][0] = (float)(u * tiles);
        mesh.vertices[i].texture_coordinates[0][1] = (float)(v * tiles);
    }
    scenes_shape_grid_indices(GRID, GRID, mesh.indices);
    status = scenes_mesh_compute_normals(&mesh, host);
    if (!status)
        status = scenes_mesh_smooth_tangents(&mesh, host);
    if (!status)
        status = scenes_place_mesh(scene, &mesh, 0, host);
    scenes_mesh_free(&mesh);
    return status;
}

static lobe_result add_view(lobe_scene *scene, const lobe_host *host) {
    static const lobe_light lights[] = {
        {.type = LOBE_LIGHT_DIRECTIONAL,
         .direction = {0.36f, -0.8f, -0.48f},
         .intensity = {1, 0.97f, 0.92f}},
        {.type = LOBE_LIGHT_POINT,
         .position = {1.2f, 1.6f, -1.4f},
         .intensity = {3.4f, 2.4f, 1.4f}},
        {.type = LOBE_LIGHT_POINT,
         .position = {-1.3f, 1.7f, -1.2f},
         .intensity = {1.4f, 2.2f, 3.2f}},
    };
    scenes_set_camera(scene, (float[]){0.1f, 1.52f, 1.0f}, (float[]){0.0f, 0.62f, 0.26f}, 40);
    scene->background[0] = scene->background[1] = scene->background[2] = 0.4f;
    return scenes_add_lights(scene, lights, sizeof lights / sizeof *lights, host);
}

lobe_result scenes_builtin_tablecloth(const lobe_host *host, lobe_scene **scene) {
    static const builtin_step steps[] = {add_material, add_cloth, add_view, NULL};
    return scenes_builtin_assemble("tablecloth", steps, host, scene);
}
