#include "passes/environment/directional_albedo.h"

#include "passes/environment/reflection_table.h"
#include "shaders/interface/environment/directional_albedo.h"
#include "shaders/interface/specialisation.h"

lobe_resource passes_directional_albedo(lobe_graph *graph, lobe_distribution distribution,
                                        lobe_distribution masking) {
    lobe_resource table = passes_reflection_table(graph, "directional albedo", distribution,
                                                  masking, DIRECTIONAL_ALBEDO_SIZE, 1);
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
