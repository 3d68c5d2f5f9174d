#include "passes/environment/reflected_lobes.h"

#include <stdio.h>

#include "shaders/interface/environment/reflected_lobes.h"
#include "shaders/interface/environment/reflected_rings.h"
#include "shaders/interface/specialisation.h"

const lobe_sampler passes_reflected_lobes_sampler = {
    .texels = LOBE_SAMPLE_LINEAR, .wrap_u = LOBE_WRAP_CLAMP, .wrap_v = LOBE_WRAP_CLAMP};

lobe_resource passes_reflected_lobes(lobe_graph *graph, lobe_distribution distribution,
                                     lobe_distribution masking) {
    char name[64];
    snprintf(name, sizeof name, "reflected lobes of distribution %d, masked as %d",
             (int)distribution, (int)masking);
    lobe_resource table =
        lobe_graph_image(graph, &(lobe_image_description){.name = name,
                                                          .format = LOBE_FORMAT_RGBA32_FLOAT,
                                                          .width = REFLECTED_LOBES_SIZE,
                                                          .height = REFLECTED_LOBES_SIZE,
                                                          .layers = REFLECTED_LOBES,
                                                          .retained = true,
                                                          .shared = true,
                                                          .permanent = true});
    lobe_pass *pass = lobe_graph_add_pass(graph, LOBE_PASS_COMPUTE, "reflected_lobes");
    table = lobe_pass_write(pass, &(lobe_binding){.name = "reflected_lobes", .resource = table});
    const lobe_specialisation specialisation[] = {
        {SPECIALISE_DISTRIBUTION, (uint32_t)distribution},
        {SPECIALISE_MASKING, (uint32_t)masking},
    };
    lobe_pass_dispatch(pass, &(lobe_dispatch){.shader = "environment/reflected_lobes.comp",
                                              .threads = {REFLECTED_RINGS * REFLECTED_LOBES_SIZE,
                                                          REFLECTED_LOBES_SIZE},
                                              .specialisation = specialisation,
                                              .specialisation_count = 2});
    return table;
}
