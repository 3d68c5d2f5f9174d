#include "passes/environment/hemispheres/hemisphere_moments.h"

#include "shaders/interface/environment/hemisphere_moments.h"

lobe_resource passes_hemisphere_moments(lobe_graph *graph, const environment_means *means) {
    const struct hemisphere_moments_constants constants = {means->size};
    const uint32_t width = HEMISPHERE_MOMENTS_SIZE + 2;
    lobe_resource moments = lobe_graph_image(
        graph, &(lobe_image_description){.name = "environment moments over hemispheres",
                                         .format = LOBE_FORMAT_RGBA32_FLOAT,
                                         .width = width,
                                         .height = width,
                                         .layers = HEMISPHERE_MOMENT_LAYERS,
                                         .retained = true});
    lobe_pass *pass = lobe_graph_add_pass(graph, LOBE_PASS_COMPUTE, "hemisphere_moments");
    lobe_pass_read(pass,
                   &(lobe_binding){"environment", means->cube, .range = {means->level, 1, 0, 6}});
    moments = lobe_pass_write(pass, &(lobe_binding){.name = "moments", .resource = moments});
    lobe_pass_dispatch(pass, &(lobe_dispatch){.shader = "environment/hemisphere_moments.comp",
                                              .threads = {width * width},
                                              .constants = &constants,
                                              .constants_size = sizeof constants});
    return moments;
}
