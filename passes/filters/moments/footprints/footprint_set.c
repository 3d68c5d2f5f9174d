#include "passes/filters/moments/footprints/footprint_set.h"

#include <math.h>
#include <string.h>

#include "passes/context/sample_pattern.h"
#include "passes/maps/colours/lobe_mask.h"
#include "passes/upload/material_maps.h"
#include "shaders/interface/lobe_grid.h"

// In texels. What small ones show differs from place to place: one lobe or parts of two, which no
// single bin serves. What large ones show is the same everywhere, but of more lobes.
static const double widths[] = {8, 32, 128};
enum { WIDTHS = sizeof widths / sizeof *widths };

/// Points that are read along each side of a square.
enum { POINTS = 24 };

// An error of the mean diffuse colour counts as much as this much relative L2 of the lobes.
static const double diffuse_weight = 3;

// Below this part of what footprints reflect in the mean, errors count as much as they add to it.
static const double least_colour = 0.1;

// ---------------------------------------------------------------------------------------------
// Squares

/// In texels of the lobe_grid.
typedef struct map_square {
    double corner[2], size[2];
} map_square;

static map_square place_square(const lobe_grid *grid, uint32_t index) {
    const double extent[2] = {grid->width, grid->height};
    double position[2];
    map_square square;
    passes_spread_position(index, FOOTPRINT_SQUARES, position);
    for (uint32_t axis = 0; axis < 2; axis++) {
        square.size[axis] = fmin(extent[axis], widths[index % WIDTHS]);
        square.corner[axis] = position[axis] * (extent[axis] - square.size[axis]);
    }
    return square;
}

/// One point in each of the square's cells, by a hash. Pictures interpolate between texels, too,
/// and the directions in between fill the valleys between bins.
static void place_point(const map_square *square, uint32_t index, uint32_t i, double point[2]) {
    const uint64_t number = 2 * ((uint64_t)index << 32 | i);
    const uint32_t cell[2] = {i % POINTS, i / POINTS};
    for (uint32_t axis = 0; axis < 2; axis++)
        point[axis] = square->corner[axis] + (cell[axis] + passes_hashed_number(number + axis)) /
                                                 POINTS * square->size[axis];
}

/// To a point of the same texel at which passes read it (shaders/lib/map/texel_point.glsl), either
/// of the two by turns.
static void move_to_texel_point(uint32_t i, double point[2]) {
    for (uint32_t axis = 0; axis < 2; axis++)
        point[axis] = floor(point[axis]) + 0.5 + (i % 2 ? -TEXEL_POINT : TEXEL_POINT);
}

/// Returns how many lobes were read. `texel_points`: at points at which passes read texels.
static uint32_t read_square(const lobe_scene *scene, const device_material *material,
                            const lobe_mask *mask, uint32_t index, bool texel_points,
                            plane_sample *lobes) {
    const lobe_grid grid = passes_lobe_grid(material);
    const map_square square = place_square(&grid, index);
    uint32_t count = 0;
    for (uint32_t i = 0; i < POINTS * POINTS; i++) {
        double point[2];
        place_point(&square, index, i, point);
        if (texel_points)
            move_to_texel_point(i + i / POINTS, point);
        if (!passes_lobe_mask_cuts(mask, point))
            count +=
                passes_plane_samples_read(scene, material, point[0], point[1], 1, &lobes[count]);
    }
    return count;
}

enum { LOBES = POINTS * POINTS * LOBE_MATERIAL_MAXIMUM_LOBES };

footprint_lobes *passes_footprint_lobes_read(const device_scene *scene,
                                             const device_material *material,
                                             const lobe_allocator *allocator) {
    const lobe_mask mask = passes_lobe_mask(scene, material);
    footprint_lobes *read = lobe_allocate(
        allocator, 1, sizeof *read + (size_t)FOOTPRINT_SQUARES * LOBES * sizeof *read->all);
    for (uint32_t i = 0; read && i < FOOTPRINT_SQUARES; i++) {
        plane_sample *lobes = read->all + (size_t)i * LOBES;
        read->lobes[i] = lobes;
        read->counts[i] = read_square(scene->scene, material, &mask, i, true, lobes);
        passes_footprint_normalise(lobes, read->counts[i]);
    }
    return read;
}

// ---------------------------------------------------------------------------------------------
// The set

static uint32_t count_lights(const lobe_survey *survey) {
    for (uint32_t i = 0; i < survey->count; i++)
        if (passes_footprint_is_sharp(survey->samples[i].variance))
            return FOOTPRINT_LIGHTS;
    return 1;
}

/// Errors are relative to each footprint, but for those that are all but black.
static void find_units(const footprint_set *set, uint32_t light, double units[FOOTPRINTS]) {
    double colours[FOOTPRINTS], mean = 0;
    for (uint32_t i = 0; i < FOOTPRINTS; i++) {
        const footprint_light *lit = &set->all[i].lights[light];
        colours[i] = sqrt(lit->shown / fmax(lit->whites, 1e-30));
        mean += colours[i] / FOOTPRINTS;
    }
    for (uint32_t i = 0; i < FOOTPRINTS; i++) {
        const double colour = fmax(colours[i], least_colour * mean);
        units[i] = fmax(set->all[i].lights[light].whites * colour * colour, 1e-30);
    }
}

/// The last is of all the maps, and so is a square that a mask cuts away.
footprint_set *passes_footprint_set_read(const device_scene *scene, const device_material *material,
                                         const lobe_survey *survey,
                                         const lobe_allocator *allocator) {
    const uint32_t lights = count_lights(survey);
    const lobe_mask mask = passes_lobe_mask(scene, material);
    footprint_set *set = lobe_allocate(
        allocator, 1,
        sizeof *set + ((size_t)FOOTPRINT_SQUARES * LOBES + survey->count) * sizeof *set->lobes);
    if (!set)
        return NULL;
    plane_sample *whole = set->lobes + (size_t)FOOTPRINT_SQUARES * LOBES;
    memcpy(whole, survey->samples, survey->count * sizeof *survey->samples);
    for (uint32_t i = 0; i < FOOTPRINTS; i++) {
        footprint *one = &set->all[i];
        one->lobes = set->lobes + (size_t)i * LOBES;
        one->log_normal = material->distribution == LOBE_DISTRIBUTION_GGX;
        one->microfacet = material->material->model == LOBE_MATERIAL_MICROFACET;
        for (uint32_t k = 0; k < 3; k++)
            one->base_colour[k] = (double)material->values.base_colour[k];
        one->light_count = lights;
        if (i < FOOTPRINT_SQUARES)
            one->count = read_square(scene->scene, material, &mask, i, false, one->lobes);
        if (one->count == 0) {
            one->lobes = whole;
            one->count = survey->count;
        }
        passes_footprint_complete(one);
    }
    for (uint32_t i = 0; i < FOOTPRINT_LIGHTS; i++)
        find_units(set, i, set->units[i]);
    return set;
}

uint32_t passes_footprint_set_compare(const footprint_set *set, const footprint_lobes *lobes,
                                      const plane_mixture *mixture,
                                      footprint_error errors[FOOTPRINT_LIGHTS]) {
    const uint32_t lights = set->all[0].light_count;
    double diffuse = 0;
    for (uint32_t k = 0; k < lights; k++)
        errors[k] = (footprint_error){0};
    for (uint32_t i = 0; i < FOOTPRINTS; i++) {
        footprint_error own[FOOTPRINT_LIGHTS];
        const bool own_lobes = !lobes || i >= FOOTPRINT_SQUARES || lobes->counts[i] == 0;
        passes_footprint_compare(&set->all[i], own_lobes ? set->all[i].lobes : lobes->lobes[i],
                                 own_lobes ? set->all[i].count : lobes->counts[i], mixture, own);
        for (uint32_t k = 0; k < lights; k++) {
            errors[k].mean_colour += own[k].mean_colour / set->units[k][i] / FOOTPRINTS;
            errors[k].bin_colours += own[k].bin_colours / set->units[k][i] / FOOTPRINTS;
        }
        diffuse += set->all[i].diffuse_error / FOOTPRINTS;
    }
    for (uint32_t k = 0; k < lights; k++) {
        const double error = sqrt(errors[k].mean_colour) + diffuse_weight * diffuse;
        errors[k].mean_colour = error * error;
    }
    return lights;
}
