#include "passes/environment/reflection_table.h"

#include <stdio.h>

const lobe_sampler passes_reflection_table_sampler = {
    .texels = LOBE_SAMPLE_LINEAR, .wrap_u = LOBE_WRAP_CLAMP, .wrap_v = LOBE_WRAP_CLAMP};

lobe_resource passes_reflection_table(lobe_graph *graph, const char *content,
                                      lobe_distribution distribution, lobe_distribution masking,
                                      uint32_t size, uint32_t layers) {
    char name[64];
    snprintf(name, sizeof name, "%s of distribution %d, masked as %d", content, (int)distribution,
             (int)masking);
    return lobe_graph_image(graph, &(lobe_image_description){.name = name,
                                                             .format = LOBE_FORMAT_RGBA32_FLOAT,
                                                             .width = size,
                                                             .height = size,
                                                             .layers = layers,
                                                             .retained = true,
                                                             .shared = true,
                                                             .permanent = true});
}
