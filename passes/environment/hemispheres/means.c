#include "passes/environment/hemispheres/means.h"

#include "passes/environment/reduction.h"

const lobe_sampler passes_hemispheres_sampler = {
    .texels = LOBE_SAMPLE_LINEAR, .wrap_u = LOBE_WRAP_CLAMP, .wrap_v = LOBE_WRAP_CLAMP};

/// Texels along a face of the filtered level that is read, at most: its lobes are then so narrow
/// that they hardly blur integrals over hemispheres.
#define FINEST_WIDTH 256

uint32_t passes_irradiance_source_level(const irradiance_source *source, uint32_t width) {
    uint32_t level = 0;
    while (source->size >> level > width && level + 1 < source->levels)
        ++level;
    return level;
}

/// A copy of a level of the source, reduced to few texels.
static lobe_resource reduced_copy(lobe_graph *graph, const irradiance_source *source,
                                  uint32_t level) {
    const uint32_t width = source->size >> level;
    reduced_map cube = {
        .width = width, .height = width, .layers = 6, .levels = passes_level_count(width, width)};
    cube.resource =
        lobe_graph_image(graph, &(lobe_image_description){.name = "means of the environment",
                                                          .format = LOBE_FORMAT_RGBA32_FLOAT,
                                                          .width = width,
                                                          .height = width,
                                                          .layers = 6,
                                                          .levels = cube.levels});
    lobe_pass *pass = lobe_graph_add_pass(graph, LOBE_PASS_TRANSFER, "environment_means");
    cube.resource = lobe_pass_copy(pass, source->cube, (lobe_range){level, 1, 0, 6}, cube.resource,
                                   (lobe_range){0, 1, 0, 6});
    passes_environment_reduction(graph, &cube);
    return cube.resource;
}

environment_means passes_environment_means(lobe_graph *graph, const irradiance_source *source) {
    const uint32_t level = passes_irradiance_source_level(
        source, source->filtered ? FINEST_WIDTH : ENVIRONMENT_MEANS_SIZE);
    environment_means means = {source->cube, level, source->size >> level};
    if (means.size <= ENVIRONMENT_MEANS_SIZE)
        return means;
    means.cube = reduced_copy(graph, source, level);
    for (means.level = 0; means.size > ENVIRONMENT_MEANS_SIZE; means.level++)
        means.size /= 2;
    return means;
}
