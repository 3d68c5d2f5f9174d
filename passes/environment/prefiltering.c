#include "passes/environment/prefiltering.h"

#include <lobe/environment_maps.h>

#include <math.h>

#include "shaders/interface/environment/environment.h"

// Variance of the smoothing before a halving, in squared texels of the smaller cube: enough that
// the smaller cube represents everything between its texels to a thousandth.
#define SMOOTHING_VARIANCE 0.4

// Smallest face width of a source: a sum over few texels depends on where they lie.
#define LEAST_SOURCE_WIDTH 32

// Least standard deviation of a lobe in texels of its source: sums over them are then exact.
#define SOURCE_TEXELS_PER_DEVIATION 1

// The same in texels of the level that stores the filtered environment. Interpolating them is then
// off by 1.1 % (relative L2) if all light comes from one point, by 1.6 % for GGX lobes. Measured
// over the sphere, with faces of 128 and 256 texels, kappa = 1, 4, 16 to 4096, and six real
// environments: 0.03 to 0.9 %; GGX lobes 0.03 to 1.2 %, and 1.8 % where the peak is narrower than
// the radiance's texels (kappa = 4096 with 128). Four texels give a third of these errors, for four
// times the work.
#define LEVEL_TEXELS_PER_DEVIATION 2

uint32_t passes_prefiltered_width(uint32_t size) {
    // No lobe is narrower than a texel of the radiance; kappa reaches 4096 from 128 texels on.
    return size <= 128 ? 2 * size : size;
}

double lobe_environment_level_concentration(uint32_t width, uint32_t level) {
    if (level >= 32 || width >> level <= 1)
        return 0; // uniform: the mean of all directions
    double texel = 2.0 / (width >> level), deviation = LEVEL_TEXELS_PER_DEVIATION * texel;
    return 1 / (deviation * deviation);
}

typedef struct filtered_source {
    lobe_resource resource;
    uint32_t level, width;
    double variance; ///< of the smoothing so far
} filtered_source;

typedef struct filtered_target {
    uint32_t level, width, first_face, face_count;
    double concentration;
    bool interpolated;
} filtered_target;

static lobe_pass *add_pass(lobe_graph *graph, const char *name, const filtered_source *source,
                           const filtered_target *target, lobe_resource *cube) {
    struct environment_prefiltering_constants constants = {
        .width = target->width,
        .source_width = source->width,
        .first_face = target->first_face,
        .concentration = (float)target->concentration,
        .source_variance = (float)source->variance,
        .interpolation = target->interpolated,
    };
    lobe_pass *pass = lobe_graph_add_pass(graph, LOBE_PASS_COMPUTE, name);
    lobe_pass_read(pass,
                   &(lobe_binding){"source", source->resource, .range = {source->level, 1, 0, 6}});
    *cube = lobe_pass_write(
        pass, &(lobe_binding){"target", *cube,
                              .range = {target->level, 1, target->first_face, target->face_count}});
    lobe_pass_dispatch(
        pass, &(lobe_dispatch){.shader = "environment/prefiltering.comp",
                               .threads = {target->width, target->width, target->face_count},
                               .constants = &constants,
                               .constants_size = sizeof constants});
    return pass;
}

// ---------------------------------------------------------------------------------------------
// Sources

static double texel_squared(uint32_t width) {
    return 4.0 / ((double)width * width);
}

/// Level 0 is the radiance, level n > 0 is level n - 1 of the smoothed cube.
static filtered_source source_at(const prefiltering_sources *sources, uint32_t level) {
    filtered_source source = {sources->radiance, 0, sources->size >> level, 0};
    if (level > 0) {
        source.resource = sources->smoothed;
        source.level = level - 1;
    }
    for (uint32_t i = 1; i <= level; i++)
        source.variance += SMOOTHING_VARIANCE * texel_squared(sources->size >> i);
    return source;
}

prefiltering_sources passes_environment_smoothing(lobe_graph *graph, lobe_resource radiance,
                                                  uint32_t size, bool retained) {
    prefiltering_sources sources = {.radiance = radiance, .size = size};
    uint32_t count = 0;
    while (size >> (count + 1) >= LEAST_SOURCE_WIDTH)
        ++count;
    if (count == 0)
        return sources;
    sources.smoothed =
        lobe_graph_image(graph, &(lobe_image_description){.name = "environment smoothed",
                                                          .format = LOBE_FORMAT_RGBA32_FLOAT,
                                                          .width = size / 2,
                                                          .height = size / 2,
                                                          .layers = 6,
                                                          .levels = count,
                                                          .retained = retained});
    for (uint32_t level = 0; level < count; level++) {
        filtered_source source = source_at(&sources, level);
        source.variance = 0; // in addition to the previous smoothing
        filtered_target target = {.level = level,
                                  .width = source.width / 2,
                                  .face_count = 6,
                                  .concentration =
                                      1 / (SMOOTHING_VARIANCE * texel_squared(source.width / 2))};
        add_pass(graph, "environment_smoothing", &source, &target, &sources.smoothed);
    }
    sources.smoothed_levels = count;
    return sources;
}

static filtered_source source_for(const prefiltering_sources *sources, double concentration) {
    uint32_t level = 0;
    while (level < sources->smoothed_levels && SOURCE_TEXELS_PER_DEVIATION *
                                                       SOURCE_TEXELS_PER_DEVIATION * concentration *
                                                       texel_squared(sources->size >> (level + 1)) <
                                                   1.001)
        ++level;
    return source_at(sources, level);
}

lobe_pass *passes_environment_prefiltering(lobe_graph *graph, const prefiltering_sources *sources,
                                           reduced_map *cube, uint32_t level, uint32_t first_face,
                                           uint32_t face_count, double concentration) {
    filtered_source source = source_for(sources, concentration);
    filtered_target target = {level,      cube->width >> level, first_face,
                              face_count, concentration,        true};
    return add_pass(graph, "environment_prefiltering", &source, &target, &cube->resource);
}
