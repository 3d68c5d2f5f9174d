#include "passes/environment/hemisphere_moments.h"

#include "passes/environment/reduction.h"
#include "shaders/interface/environment/hemisphere_moments.h"

/// Texels along a face of the level that is read, at most: its lobes are then so narrow that they
/// hardly blur moments.
#define FINEST_WIDTH 256

const lobe_sampler passes_hemisphere_moments_sampler = {
    .texels = LOBE_SAMPLE_LINEAR, .wrap_u = LOBE_WRAP_CLAMP, .wrap_v = LOBE_WRAP_CLAMP};

/// A copy of a level of the source, reduced to few texels.
static reduced_map reduced_copy(lobe_graph *graph, const irradiance_source *source,
                                uint32_t level) {
    const uint32_t width = source->size >> level;
    reduced_map cube = {
        .width = width, .height = width, .layers = 6, .levels = passes_level_count(width, width)};
    cube.resource =
        lobe_graph_image(graph, &(lobe_image_description){.name = "environment for moments",
                                                          .format = LOBE_FORMAT_RGBA32_FLOAT,
                                                          .width = width,
                                                          .height = width,
                                                          .layers = 6,
                                                          .levels = cube.levels});
    lobe_pass *pass = lobe_graph_add_pass(graph, LOBE_PASS_TRANSFER, "environment_for_moments");
    cube.resource = lobe_pass_copy(pass, source->cube, (lobe_range){level, 1, 0, 6}, cube.resource,
                                   (lobe_range){0, 1, 0, 6});
    passes_environment_reduction(graph, &cube);
    return cube;
}

lobe_resource passes_hemisphere_moments(lobe_graph *graph, irradiance_source source) {
    uint32_t level = 0;
    while (source.size >> level > FINEST_WIDTH && level + 1 < source.levels)
        ++level;
    struct hemisphere_moments_constants constants = {source.size >> level};
    lobe_resource cube = source.cube;
    if (constants.size > HEMISPHERE_MOMENTS_SOURCE) {
        cube = reduced_copy(graph, &source, level).resource;
        for (level = 0; constants.size > HEMISPHERE_MOMENTS_SOURCE; level++)
            constants.size /= 2;
    }
    const uint32_t width = HEMISPHERE_MOMENTS_SIZE + 2;
    lobe_resource moments = lobe_graph_image(
        graph, &(lobe_image_description){.name = "environment moments over hemispheres",
                                         .format = LOBE_FORMAT_RGBA32_FLOAT,
                                         .width = width,
                                         .height = width,
                                         .layers = HEMISPHERE_MOMENT_LAYERS,
                                         .retained = true});
    lobe_pass *pass = lobe_graph_add_pass(graph, LOBE_PASS_COMPUTE, "hemisphere_moments");
    lobe_pass_read(pass, &(lobe_binding){"environment", cube, .range = {level, 1, 0, 6}});
    moments = lobe_pass_write(pass, &(lobe_binding){.name = "moments", .resource = moments});
    lobe_pass_dispatch(pass, &(lobe_dispatch){.shader = "environment/hemisphere_moments.comp",
                                              .threads = {width * width},
                                              .constants = &constants,
                                              .constants_size = sizeof constants});
    return moments;
}
