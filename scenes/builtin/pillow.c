#include "scenes/builtin/builtin.h"

#include <math.h>

#include "scenes/builtin/assembly.h"
#include "scenes/builtin/noise.h"
#include "scenes/builtin/random.h"
#include "scenes/mesh/circle.h"
#include "scenes/mesh/mesh.h"
#include "scenes/mesh/shape.h"
#include "scenes/mesh/vector.h"
#include "scenes/scene/scene.h"

// Xu et al. 2017, "Real-Time Linear BRDF MIP-Mapping", Fig. 1 and section 5.2: a pillow whose BRDF
// varies by a diffuse colour, a specular colour and a specular coefficient map of 2048 x 1024
// texels. Ours shows a brocade: a warp of dark silk with a sharp lobe and a weft of gold thread
// with a broad one, in a twill that brings one or the other to the top. Threads are round, and dive
// under those that cross them: a normal map, which the paper's pillow does not have.

enum { MAP_WIDTH = 2048, MAP_HEIGHT = 1024, PITCH = 4, TWILL = 4, MOTIF_EXTENT = 512 };

// Properties of the threads of one direction.
typedef struct thread_kind {
    double diffuse[3], specular[3]; // sRGB, 0 to 255
    double exponent;                // Blinn-Phong
    double roundness;               // slope at its sides
} thread_kind;

static const thread_kind silk = {{158, 30, 44}, {255, 206, 196}, 150, 0.14};
static const thread_kind gold = {{214, 160, 84}, {255, 206, 120}, 8, 0.5};

// A thread at one texel of the maps.
typedef struct thread_point {
    const thread_kind *kind;
    double shade; // 1 on top of the thread, less towards its sides
    double vary;  // random for each thread, in [-1, 1)
} thread_point;

// A flower in a ring, and a lozenge between four of them. Every other column of flowers is shifted
// by half a flower. Apart from the waviness of the petals, distances define the shapes; cos(6a) is
// the real part of the sixth power of a complex number of length 1.
static bool motif_covers(uint32_t column, uint32_t row) {
    uint32_t dropped = row + MOTIF_EXTENT / 2 * (column / MOTIF_EXTENT % 2);
    double x = (column % MOTIF_EXTENT + 0.5) / (MOTIF_EXTENT / 2) - 1;
    double y = (dropped % MOTIF_EXTENT + 0.5) / (MOTIF_EXTENT / 2) - 1;
    double square = x * x + y * y, cube = square * square * square;
    double re = x * x * x - 3 * x * y * y, im = 3 * x * x * y - y * y * y;
    double waviness = (re * re - im * im) / cube;
    double distance = sqrt(square), petals = 0.50 + 0.13 * waviness;
    bool flower = distance < petals && (distance < 0.13 || distance > 0.21);
    bool ring = distance > 0.76 && distance < 0.86;
    return flower || ring || fabs(x) + fabs(y) > 1.76;
}

// Where threads cross, one lies on top: the weft three times out of four within the motif, the warp
// three times out of four elsewhere.
static bool warp_is_on_top(uint32_t warp, uint32_t weft) {
    bool odd_one = (warp + weft) % TWILL == 0;
    bool in_motif = motif_covers(warp * PITCH + PITCH / 2, weft * PITCH + PITCH / 2);
    return odd_one == in_motif;
}

static thread_point find_thread(uint32_t column, uint32_t row) {
    static const double crown[PITCH] = {0.72, 1, 1, 0.72};
    uint32_t warp = column / PITCH, weft = row / PITCH;
    bool on_top = warp_is_on_top(warp, weft);
    uint32_t bits = scenes_random_lattice(on_top ? warp : weft, on_top, 17);
    return (thread_point){.kind = on_top ? &silk : &gold,
                          .shade = crown[(on_top ? column : row) % PITCH],
                          .vary = bits / 2147483648.0 - 1};
}

// The slope of a thread at one texel of its breadth, and of its length where it comes from below or
// goes there, as parts of the thread's roundness.
static const double across_thread[PITCH] = {1, 0.3, -0.3, -1};
static const double at_start[PITCH] = {0.8, 0.25, 0, 0}, at_end[PITCH] = {0, 0, -0.25, -0.8};

static double slope_along(uint32_t warp, uint32_t weft, bool on_top, uint32_t place) {
    const uint32_t warps = MAP_WIDTH / PITCH, wefts = MAP_HEIGHT / PITCH;
    uint32_t before[2] = {warp, weft}, after[2] = {warp, weft};
    // A warp thread runs down the columns, a weft thread along the rows.
    before[on_top] += on_top ? wefts - 1 : warps - 1;
    after[on_top] += 1;
    const bool comes = warp_is_on_top(before[0] % warps, before[1] % wefts) != on_top;
    const bool goes = warp_is_on_top(after[0] % warps, after[1] % wefts) != on_top;
    return (comes ? at_start[place] : 0) + (goes ? at_end[place] : 0);
}

static void fill_normal(uint32_t column, uint32_t row, void *texel) {
    uint32_t warp = column / PITCH, weft = row / PITCH;
    bool on_top = warp_is_on_top(warp, weft);
    double roundness = on_top ? silk.roundness : gold.roundness;
    double along = roundness * slope_along(warp, weft, on_top, (on_top ? row : column) % PITCH);
    double across = roundness * across_thread[(on_top ? column : row) % PITCH];
    scenes_normal_map_store_slope(texel, on_top ? across : along, on_top ? along : across);
}

static void store_colour(uint8_t *texel, const double colour[3], double scale) {
    for (int channel = 0; channel < 3; channel++)
        texel[channel] = (uint8_t)fmin(colour[channel] * scale + 0.5, 255);
    texel[3] = 255;
}

static void fill_diffuse(uint32_t column, uint32_t row, void *texel) {
    thread_point thread = find_thread(column, row);
    store_colour(texel, thread.kind->diffuse, thread.shade * (1 + 0.12 * thread.vary));
}

static void fill_specular(uint32_t column, uint32_t row, void *texel) {
    thread_point thread = find_thread(column, row);
    store_colour(texel, thread.kind->specular, thread.shade * (0.95 + 0.05 * thread.vary));
}

static void fill_exponent(uint32_t column, uint32_t row, void *texel) {
    thread_point thread = find_thread(column, row);
    *(float *)texel = (float)(thread.kind->exponent * (1 + 0.25 * thread.vary));
}

static lobe_result add_brocade(lobe_scene *scene, const lobe_host *host) {
    static const builtin_map diffuse = {"brocade diffuse colours", LOBE_FORMAT_RGBA8_SRGB,
                                        MAP_WIDTH, MAP_HEIGHT, fill_diffuse};
    static const builtin_map specular = {"brocade specular colours", LOBE_FORMAT_RGBA8_SRGB,
                                         MAP_WIDTH, MAP_HEIGHT, fill_specular};
    static const builtin_map normals = {"brocade normals", LOBE_FORMAT_RGBA8_UNORM, MAP_WIDTH,
                                        MAP_HEIGHT, fill_normal};
    static const builtin_map exponents = {"brocade exponents", LOBE_FORMAT_R32_FLOAT, MAP_WIDTH,
                                          MAP_HEIGHT, fill_exponent};
    lobe_material material;
    lobe_material_default(&material);
    lobe_result status =
        scenes_builtin_add_map(scene, &diffuse, host, &material.base_colour_map.image);
    if (!status)
        status = scenes_builtin_add_map(scene, &specular, host, &material.specular_map.image);
    if (!status)
        status = scenes_builtin_add_map(scene, &exponents, host, &material.width_map.image);
    if (!status)
        status = scenes_builtin_add_map(scene, &normals, host, &material.normal_map.image);
    if (status)
        return status;
    material.model = LOBE_MATERIAL_HALF_VECTOR_LOBES;
    material.distribution = LOBE_DISTRIBUTION_BLINN_PHONG;
    material.lobes[0] =
        (lobe_base_lobe){.direction = {0, 0, 1}, .width = 1, .colour = {0.10f, 0.10f, 0.10f}};
    material.lobe_count = 1;
    return scenes_add_material(scene, "brocade", &material, host, NULL);
}

// The pillow's frame of reference: it lies in the xz plane with its middle at the origin.
enum { GRID = 128, PIPING_SIDES = 12 };

static const double half_side = 0.24;             // metres, to the seam at a corner
static const double thickness[2] = {0.115, 0.07}; // above and below the seam, metres
static const double piping_radius = 0.0055;       // metres
static const float seam_height = 0.066f;          // above the ground, metres

// A number that runs from 0 to 8 around the square whose sides are the lines |s| = m, |t| = m.
static double place_round(double s, double t) {
    if (fabs(s) >= fabs(t))
        return (s > 0 ? 0 : 4) + (s == 0 ? 0 : t / s);
    return (t > 0 ? 2 : 6) - s / t;
}

// How far the point (s, t) of the square moves inwards, so that the square of size m becomes a
// figure with rounded corners: the points with norm m, the norm being the eighth root of x^8 + y^8.
static double corner_factor(double s, double t) {
    double greater = fmax(fabs(s), fabs(t)), lesser = fmin(fabs(s), fabs(t));
    double q = greater > 0 ? lesser / greater : 0, square = q * q, fourth = square * square;
    return 1 / sqrt(sqrt(sqrt(1 + fourth * fourth)));
}

// Gathers that run in from the seam, and creases of the whole pillow.
static double wrinkle(double s, double t, double across, const double plane[2]) {
    double round = place_round(s, t) + 8,
           gather = 1 - 4 * (across - 0.62) * (across - 0.62) / 0.5776;
    double gathers = scenes_noise_gradient(round * 4, across * 1.6, 32, 1, NULL) +
                     0.35 * scenes_noise_gradient(round * 9, across * 3, 72, 2, NULL);
    double crease = scenes_noise_gradient(plane[0] * 1.7 + 8, plane[1] * 2.3 + 8, 32, 3, NULL);
    double inside = 1 - across * across;
    return 0.011 * fmax(gather, 0) * gathers + inside * (0.012 * crease - 0.02 * fabs(crease));
}

// The point (s, t), each in [-1, 1], of the upper (0) or lower (1) sheet, with its texture
// coordinates. From the middle to the seam the sheet bends like an ellipse, nearly to the vertical;
// its sides are drawn in between the corners.
static vector3 pillow_point(double s, double t, int side, float coordinates[2]) {
    static const double bend = 0.22; // of a turn
    double across = fmax(fabs(s), fabs(t)), factor = corner_factor(s, t), arc[2], seam[2];
    scenes_circle_point(across * bend, arc);
    scenes_circle_point(bend, seam);
    double spread = across > 0 ? arc[1] / (across * seam[1]) : 6.283185307179586 * bend / seam[1];
    double swell = (arc[0] - seam[0]) / (1 - seam[0]);
    spread *= factor;
    double plane[2] = {s * spread, t * spread};
    double x = plane[0] * (1 - 0.08 * (1 - plane[1] * plane[1]));
    double z = plane[1] * (1 - 0.08 * (1 - plane[0] * plane[0]));
    double height = swell * thickness[side];
    height *= 1 - 0.5 * plane[0] * plane[0] * plane[1] * plane[1];
    height += wrinkle(s, t, across, plane);
    coordinates[0] = (float)((side ? -1 : 1) * (0.6 * plane[0] + 0.4 * s * factor));
    coordinates[1] = (float)(2 * (0.6 * plane[1] + 0.4 * t * factor));
    return (vector3){x * half_side, side ? -height : height, z * half_side};
}

static lobe_result finish_mesh(lobe_scene *scene, lobe_mesh *mesh, const lobe_host *host) {
    // Turned by 0.48 radians about the vertical axis.
    static const float placed[16] = {0.88699f, 0, -0.46178f, 0, 0, 1,           0, 0,
                                     0.46178f, 0, 0.88699f,  0, 0, seam_height, 0, 1};
    uint32_t index;
    lobe_result status = scenes_mesh_smooth_tangents(mesh, host);
    if (!status)
        status = scenes_add_mesh(scene, mesh, host, &index);
    if (!status)
        status = scenes_add_instance(scene, index, 0, placed, host);
    return status;
}

static lobe_result add_sheet(lobe_scene *scene, const char *name, int side, const lobe_host *host) {
    lobe_mesh mesh;
    lobe_result status = scenes_mesh_allocate(&mesh, name, (size_t)(GRID + 1) * (GRID + 1),
                                              (size_t)GRID * GRID * 6, host);
    if (status)
        return status;
    mesh.has_texture_coordinates[0] = true;
    for (uint32_t i = 0; i < mesh.vertex_count; i++) {
        double s = i % (GRID + 1) * (2.0 / GRID) - 1, t = i / (GRID + 1) * (2.0 / GRID) - 1;
        lobe_scene_vertex *vertex = &mesh.vertices[i];
        // Seen from below, left and right are swapped.
        vector3_store(pillow_point(side ? -s : s, t, side, vertex->texture_coordinates[0]),
                      vertex->position);
    }
    scenes_shape_grid_indices(GRID, GRID, mesh.indices);
    status = scenes_mesh_compute_normals(&mesh, host);
    if (!status)
        status = finish_mesh(scene, &mesh, host);
    scenes_mesh_free(&mesh);
    return status;
}

static lobe_result add_upper_sheet(lobe_scene *scene, const lobe_host *host) {
    return add_sheet(scene, "upper sheet", 0, host);
}

static lobe_result add_lower_sheet(lobe_scene *scene, const lobe_host *host) {
    return add_sheet(scene, "lower sheet", 1, host);
}

// A point on the seam; `place` is the result of place_round.
static vector3 seam_point(double place) {
    float coordinates[2];
    double turned = place + 1 - floor((place + 1) / 8) * 8,
           along = turned - floor(turned / 2) * 2 - 1;
    switch ((int)(turned / 2)) {
    case 0:
        return pillow_point(1, along, 0, coordinates);
    case 1:
        return pillow_point(-along, 1, 0, coordinates);
    case 2:
        return pillow_point(-1, -along, 0, coordinates);
    default:
        return pillow_point(along, -1, 0, coordinates);
    }
}

// The round cord that hides the seam: `turns` goes around it, starting inside the pillow, upwards.
static void place_on_piping(double place, double turns, lobe_scene_vertex *vertex) {
    vector3 ahead = vector3_subtract(seam_point(place + 0.01), seam_point(place - 0.01));
    vector3 up = {0, 1, 0}, outwards = vector3_cross(up, ahead);
    vector3_normalise(&outwards, 0);
    double circle[2];
    scenes_circle_point(turns, circle);
    vector3 normal = vector3_add(vector3_scale(outwards, circle[0]), vector3_scale(up, circle[1]));
    vector3_store(normal, vertex->normal);
    vector3_store(vector3_add(seam_point(place), vector3_scale(normal, piping_radius)),
                  vertex->position);
    vertex->texture_coordinates[0][0] = (float)-place;
    vertex->texture_coordinates[0][1] = (float)(turns * -0.3);
}

static lobe_result add_piping(lobe_scene *scene, const lobe_host *host) {
    enum { LENGTHS = 4 * GRID };
    lobe_mesh mesh;
    lobe_result status =
        scenes_mesh_allocate(&mesh, "piping", (size_t)(PIPING_SIDES + 1) * (LENGTHS + 1),
                             (size_t)PIPING_SIDES * LENGTHS * 6, host);
    if (status)
        return status;
    mesh.has_texture_coordinates[0] = true;
    for (uint32_t i = 0; i < mesh.vertex_count; i++) {
        uint32_t row = i / (LENGTHS + 1), column = i % (LENGTHS + 1);
        place_on_piping(8 - column * (8.0 / LENGTHS), 0.5 - row / (double)PIPING_SIDES,
                        &mesh.vertices[i]);
    }
    scenes_shape_grid_indices(PIPING_SIDES, LENGTHS, mesh.indices);
    status = finish_mesh(scene, &mesh, host);
    scenes_mesh_free(&mesh);
    return status;
}

// The ground is one tile of a map with the pillow's shade painted in: lights cast no shadows.
enum { GROUND_EXTENT = 512 };

static const float ground_side = 4; // metres

static void fill_ground(uint32_t column, uint32_t row, void *texel) {
    static const double plain[3] = {176, 166, 154};
    // The corner of the map is at the middle of the plane.
    double across = (column + 0.5) / GROUND_EXTENT, down = (row + 0.5) / GROUND_EXTENT;
    double x = (across - floor(across + 0.5)) * ground_side;
    double z = (down - floor(down + 0.5)) * ground_side;
    double s = (0.88699 * x - 0.46178 * z) / half_side, t = (0.46178 * x + 0.88699 * z) / half_side;
    double square = sqrt(s * s * s * s + t * t * t * t);
    double shade = 1 - 0.8 / (1 + square * square * square * 0.5);
    double grain =
        1 + 0.06 * scenes_noise_gradient(column / 4.0, row / 4.0, GROUND_EXTENT / 4, 5, NULL);
    store_colour(texel, plain, shade * grain);
}

static lobe_result add_ground(lobe_scene *scene, const lobe_host *host) {
    static const builtin_map colours = {"ground colours", LOBE_FORMAT_RGBA8_SRGB, GROUND_EXTENT,
                                        GROUND_EXTENT, fill_ground};
    lobe_material material;
    lobe_material_default(&material);
    lobe_mesh mesh;
    uint32_t index;
    lobe_result status =
        scenes_builtin_add_map(scene, &colours, host, &material.base_colour_map.image);
    if (!status)
        status = scenes_add_material(scene, "ground", &material, host, &index);
    if (!status)
        status = scenes_shape_plane(ground_side, ground_side, ground_side, host, &mesh);
    return status ? status : scenes_place_mesh(scene, &mesh, index, host);
}

static lobe_result add_view(lobe_scene *scene, const lobe_host *host) {
    static const lobe_light lights[] = {
        {.type = LOBE_LIGHT_DIRECTIONAL,
         .direction = {-0.36f, -0.8f, 0.48f},
         .intensity = {1.8f, 1.75f, 1.6f}},
        {.type = LOBE_LIGHT_POINT,
         .position = {-0.7f, 0.7f, -0.5f},
         .intensity = {0.4f, 0.5f, 0.65f}},
        {.type = LOBE_LIGHT_POINT, .position = {0.5f, 0.9f, 0.6f}, .intensity = {0.6f, 0.5f, 0.4f}},
    };
    scenes_set_camera(scene, (float[]){0, 0.60f, 0.72f}, (float[]){0, 0.075f, 0.02f}, 32);
    scene->background[0] = scene->background[1] = scene->background[2] = 0.3f;
    return scenes_add_lights(scene, lights, sizeof lights / sizeof *lights, host);
}

lobe_result scenes_builtin_pillow(const lobe_host *host, lobe_scene **scene) {
    static const builtin_step steps[] = {
        add_brocade, add_upper_sheet, add_lower_sheet, add_piping, add_ground, add_view, NULL};
    return scenes_builtin_assemble("pillow", steps, host, scene);
}
