#include "passes/environment/directional_albedo.h"

#include <stdio.h>

#include "shaders/interface/environment/directional_albedo.h"
#include "shaders/interface/specialisation.h"

const lobe_sampler passes_directional_albedo_sampler = {
    .texels = LOBE_SAMPLE_LINEAR, .wrap_u = LOBE_WRAP_CLAMP, .wrap_v = LOBE_WRAP_CLAMP};

lobe_resource passes_directional_albedo(lobe_graph *graph, lobe_distribution distribution,
                                        lobe_distribution masking) {
    char name[64];
    snprintf(name, sizeof name, "directional albedo of distribution %d, masked as %d",
             (int)distribution, (int)masking);
    lobe_resource table =
        lobe_graph_image(graph, &(lobe_image_description){.name = name,
                                                          .format = LOBE_FORMAT_RGBA32_FLOAT,
                                                          .width = DIRECTIONAL_ALBEDO_SIZE,
                                                          .height = DIRECTIONAL_ALBEDO_SIZE,
                                                          .retained = true,
                                                          .shared = true,
                                                          .permanent = true});
    lobe_pass *pass = lobe_graph_add_pass(graph, LOBE_PASS_COMPUTE, "directional_albedo");
    table = lobe_pass_write(pass, &(lobe_binding){.name = "directional_albedo", .resource = table});
    const lobe_specialisation specialisation[] = {
        {SPECIALISE_DISTRIBUTION, (uint32_t)distribution},
        {SPECIALISE_MASKING, (uint32_t)masking},
    };
    lobe_pass_dispatch(
        pass, &(lobe_dispatch){.shader = "environment/directional_albedo.comp",
                               .threads = {DIRECTIONAL_ALBEDO_SIZE * DIRECTIONAL_ALBEDO_SIZE},
                               .specialisation = specialisation,
                               .specialisation_count = 2});
    return table;
}
