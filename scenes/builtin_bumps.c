#include "scenes/builtin.h"

#include <math.h>

#include "scenes/mesh.h"
#include "scenes/normal_map.h"
#include "scenes/random.h"
#include "scenes/scene.h"
#include "scenes/scene_view.h"
#include "scenes/shape.h"

// Xu et al. 2017, "Real-Time Linear BRDF MIP-Mapping", Fig. 4 bottom and section 5.2: hemispherical
// bumps in a 1024 x 1024 normal map, with microfacet BRDFs that change quickly. The bumps lie in
// a hexagonal packing that tiles, each a little out of its place; each is a metal of its own
// colour and roughness, drawn independently of one another.

enum { MAP_EXTENT = 1024, BUMP_COLUMNS = 32, BUMP_ROWS = 36 };

static const double column_pitch = (double)MAP_EXTENT / BUMP_COLUMNS; // texels
static const double row_pitch = (double)MAP_EXTENT / BUMP_ROWS;

// Sine of the tilt at a bump's rim. A whole hemisphere would end in normals along the plane,
// which neither eight bits nor a view from above shows.
static const double rim_sine = 0.85;

typedef struct bump {
    double column, row, radius; // texels
    uint8_t colour[3];          // sRGB
    uint8_t roughness;
} bump;

// The three maps while they are made, and the bumps they show.
typedef struct bump_maps {
    bump bumps[BUMP_ROWS][BUMP_COLUMNS];
    lobe_image normals, colours, roughness;
} bump_maps;

// What lies between the bumps.
static const bump ground = {.colour = {234, 203, 180}, .roughness = 128};

static bump make_bump(uint32_t column, uint32_t row, random_sequence *sequence) {
    static const uint8_t metals[4][3] = {
        {245, 226, 190}, {250, 196, 130}, {236, 168, 140}, {206, 214, 226}};
    bump made;
    made.column = (column + (row % 2 ? 0.75 : 0.25)) * column_pitch +
                  random_between(sequence, -0.06, 0.06) * column_pitch;
    made.row = (row + 0.5) * row_pitch + random_between(sequence, -0.06, 0.06) * row_pitch;
    made.radius = random_between(sequence, 0.42, 0.54) * column_pitch;
    made.roughness = (uint8_t)random_between(sequence, 64, 144);
    const uint8_t *metal = metals[random_bits(sequence) >> 30];
    for (int channel = 0; channel < 3; channel++)
        made.colour[channel] = metal[channel];
    return made;
}

static void make_bumps(bump_maps *maps) {
    random_sequence sequence = random_start(2017);
    for (uint32_t row = 0; row < BUMP_ROWS; row++)
        for (uint32_t column = 0; column < BUMP_COLUMNS; column++)
            maps->bumps[row][column] = make_bump(column, row, &sequence);
}

// The shorter way round a map that repeats.
static double wrapped(double difference) {
    if (difference > MAP_EXTENT / 2)
        return difference - MAP_EXTENT;
    return difference < -MAP_EXTENT / 2 ? difference + MAP_EXTENT : difference;
}

// The highest bump over a point, and the normal there; NULL and +z on the ground.
static const bump *find_bump(const bump_maps *maps, double column, double row, double normal[3]) {
    int near_row = (int)(row / row_pitch), near_column = (int)(column / column_pitch);
    const bump *found = NULL;
    double highest = 0;
    normal[0] = normal[1] = 0, normal[2] = 1;
    for (int i = 0; i < 9; i++) {
        const bump *candidate =
            &maps->bumps[(near_row + i / 3 + BUMP_ROWS - 1) % BUMP_ROWS]
                        [(near_column + i % 3 + BUMP_COLUMNS - 1) % BUMP_COLUMNS];
        double x = wrapped(column - candidate->column), y = wrapped(row - candidate->row);
        double distance = x * x + y * y, rim = candidate->radius * candidate->radius;
        if (distance >= rim)
            continue;
        double sphere = rim / (rim_sine * rim_sine), z = sqrt(sphere - distance);
        double height = z - sqrt(sphere - rim);
        if (height > highest) {
            highest = height, found = candidate;
            normal[0] = x, normal[1] = -y, normal[2] = z;
        }
    }
    return found;
}

static void fill_texel(const bump_maps *maps, uint32_t column, uint32_t row) {
    size_t offset = ((size_t)row * MAP_EXTENT + column) * 4;
    double normal[3];
    const bump *top = find_bump(maps, column + 0.5, row + 0.5, normal);
    normal_map_store((uint8_t *)maps->normals.texels + offset, normal[0], normal[1], normal[2]);
    top = top ? top : &ground;
    uint8_t *colour = (uint8_t *)maps->colours.texels + offset;
    uint8_t *roughness = (uint8_t *)maps->roughness.texels + offset;
    for (int channel = 0; channel < 3; channel++)
        colour[channel] = top->colour[channel];
    roughness[1] = top->roughness;
    roughness[2] = colour[3] = roughness[3] = 255;
}

static lobe_result make_maps(bump_maps *maps, const lobe_log *log) {
    lobe_result status =
        lobe_image_allocate(&maps->normals, LOBE_FORMAT_RGBA8_UNORM, MAP_EXTENT, MAP_EXTENT, log);
    if (!status)
        status = lobe_image_allocate(&maps->colours, LOBE_FORMAT_RGBA8_SRGB, MAP_EXTENT, MAP_EXTENT,
                                     log);
    if (!status)
        status = lobe_image_allocate(&maps->roughness, LOBE_FORMAT_RGBA8_UNORM, MAP_EXTENT,
                                     MAP_EXTENT, log);
    if (status)
        return status;
    make_bumps(maps);
    for (uint32_t row = 0; row < MAP_EXTENT; row++)
        for (uint32_t column = 0; column < MAP_EXTENT; column++)
            fill_texel(maps, column, row);
    return LOBE_OK;
}

static lobe_result add_material(lobe_scene *scene, const lobe_log *log) {
    bump_maps maps = {0};
    uint32_t normal_map, colour_map, roughness_map;
    lobe_result status = make_maps(&maps, log);
    if (!status)
        status = scene_add_image(scene, "bump normals", &maps.normals, log, &normal_map);
    if (!status)
        status = scene_add_image(scene, "bump colours", &maps.colours, log, &colour_map);
    if (!status)
        status = scene_add_image(scene, "bump roughness", &maps.roughness, log, &roughness_map);
    if (status)
        goto cleanup;
    lobe_material material;
    lobe_material_default(&material);
    material.metallic = 1;
    material.normal_map.image = (int32_t)normal_map;
    material.base_colour_map.image = (int32_t)colour_map;
    material.metallic_roughness_map.image = (int32_t)roughness_map;
    status = scene_add_material(scene, "bumps", &material, log, NULL);
cleanup:
    lobe_image_free(&maps.normals);
    lobe_image_free(&maps.colours);
    lobe_image_free(&maps.roughness);
    return status;
}

static lobe_result add_plane(lobe_scene *scene, const lobe_log *log) {
    lobe_mesh mesh;
    lobe_result status = shape_plane(48, 48, 0.22f, log, &mesh);
    return status ? status : scene_place_mesh(scene, &mesh, 0, log);
}

static lobe_result add_view(lobe_scene *scene, const lobe_log *log) {
    static const lobe_light lights[] = {
        {.type = LOBE_LIGHT_DIRECTIONAL,
         .direction = {-0.3f, -0.6f, 0.7416198f},
         .intensity = {2.2f, 2.1f, 1.9f}},
        {.type = LOBE_LIGHT_POINT, .position = {1.8f, 1.6f, -2.6f}, .intensity = {9, 6, 3.6f}},
        {.type = LOBE_LIGHT_POINT, .position = {-2.6f, 2.2f, -6}, .intensity = {6, 11, 18}},
    };
    scene_look(scene, (float[]){0, 2.2f, 1.0f}, (float[]){0, 0, -1.35f}, 42);
    scene->background[0] = scene->background[1] = scene->background[2] = 0.25f;
    return scene_add_lights(scene, lights, sizeof lights / sizeof *lights, log);
}

lobe_result builtin_bumps(const lobe_log *log, lobe_scene **scene) {
    static const builtin_step steps[] = {add_material, add_plane, add_view, NULL};
    return builtin_scene_assemble("bumps", steps, log, scene);
}
