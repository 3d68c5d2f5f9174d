#include "scenes/builtin/bump_maps.h"

#include <math.h>

#include "scenes/builtin/assembly.h"
#include "scenes/builtin/random.h"
#include "scenes/scene/scene.h"

enum { MAP_EXTENT = 1024, BUMP_COLUMNS = 32, BUMP_ROWS = 36 };

static const double column_pitch = (double)MAP_EXTENT / BUMP_COLUMNS; // texels
static const double row_pitch = (double)MAP_EXTENT / BUMP_ROWS;

// Sine of the tilt at a bump's rim. A whole hemisphere would end in normals along the plane, which
// neither eight bits nor a view from above can show.
static const double rim_sine = 0.85;

typedef struct bump {
    double column, row, radius; // texels
    bump_matter matter;
} bump;

// The three maps being made, and the bumps they show.
typedef struct bump_maps {
    const bump_style *style;
    bump bumps[BUMP_ROWS][BUMP_COLUMNS];
    lobe_image normals, colours, roughness;
} bump_maps;

static bump make_bump(const bump_style *style, uint32_t column, uint32_t row,
                      random_sequence *sequence) {
    bump made;
    made.column = (column + (row % 2 ? 0.75 : 0.25)) * column_pitch +
                  scenes_random_between(sequence, -0.06, 0.06) * column_pitch;
    made.row = (row + 0.5) * row_pitch + scenes_random_between(sequence, -0.06, 0.06) * row_pitch;
    made.radius = scenes_random_between(sequence, 0.42, 0.54) * column_pitch;
    uint8_t roughness = (uint8_t)scenes_random_between(sequence, 64, 144);
    made.matter = style->kinds[scenes_random_bits(sequence) >> 30];
    made.matter.roughness = roughness;
    return made;
}

static void make_bumps(bump_maps *maps) {
    random_sequence sequence = scenes_random_start(maps->style->seed);
    for (uint32_t row = 0; row < BUMP_ROWS; row++)
        for (uint32_t column = 0; column < BUMP_COLUMNS; column++)
            maps->bumps[row][column] = make_bump(maps->style, column, row, &sequence);
}

// The shorter way around a map that repeats.
static double wrapped(double difference) {
    if (difference > MAP_EXTENT / 2)
        return difference - MAP_EXTENT;
    return difference < -MAP_EXTENT / 2 ? difference + MAP_EXTENT : difference;
}

// The highest bump at a point, and the normal there; NULL and +z on the ground.
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
    scenes_normal_map_store((uint8_t *)maps->normals.texels + offset, normal[0], normal[1],
                            normal[2]);
    const bump_matter *matter = top ? &top->matter : &maps->style->ground;
    uint8_t *colour = (uint8_t *)maps->colours.texels + offset;
    uint8_t *roughness = (uint8_t *)maps->roughness.texels + offset;
    for (int channel = 0; channel < 3; channel++)
        colour[channel] = matter->colour[channel];
    roughness[1] = matter->roughness;
    roughness[2] = matter->metallic ? 255 : 0;
    colour[3] = roughness[3] = 255;
}

static lobe_result make_maps(bump_maps *maps, const lobe_host *host) {
    lobe_result status =
        lobe_image_allocate(&maps->normals, LOBE_FORMAT_RGBA8_UNORM, MAP_EXTENT, MAP_EXTENT, host);
    if (!status)
        status = lobe_image_allocate(&maps->colours, LOBE_FORMAT_RGBA8_SRGB, MAP_EXTENT, MAP_EXTENT,
                                     host);
    if (!status)
        status = lobe_image_allocate(&maps->roughness, LOBE_FORMAT_RGBA8_UNORM, MAP_EXTENT,
                                     MAP_EXTENT, host);
    if (status)
        return status;
    make_bumps(maps);
    for (uint32_t row = 0; row < MAP_EXTENT; row++)
        for (uint32_t column = 0; column < MAP_EXTENT; column++)
            fill_texel(maps, column, row);
    return LOBE_OK;
}

static lobe_result hand_over(bump_maps *maps, lobe_scene *scene, const lobe_host *host,
                             lobe_material *material) {
    uint32_t normal_map, colour_map, roughness_map;
    lobe_result status = scenes_add_image(scene, "bump normals", &maps->normals, host, &normal_map);
    if (!status)
        status = scenes_add_image(scene, "bump colours", &maps->colours, host, &colour_map);
    if (!status)
        status = scenes_add_image(scene, "bump roughness", &maps->roughness, host, &roughness_map);
    if (status)
        return status;
    material->metallic = material->roughness = 1;
    material->normal_map.image = (int32_t)normal_map;
    material->base_colour_map.image = (int32_t)colour_map;
    material->metallic_roughness_map.image = (int32_t)roughness_map;
    return LOBE_OK;
}

lobe_result scenes_bump_maps_add(lobe_scene *scene, const bump_style *style, const lobe_host *host,
                                 lobe_material *material) {
    bump_maps maps = {.style = style};
    lobe_result status = make_maps(&maps, host);
    if (!status)
        status = hand_over(&maps, scene, host, material);
    lobe_image_free(&maps.normals);
    lobe_image_free(&maps.colours);
    lobe_image_free(&maps.roughness);
    return status;
}
