#include "passes/environment/reflected_lobes.h"

#include "passes/environment/reflection_table.h"
#include "shaders/interface/environment/reflected_lobes.h"
#include "shaders/interface/environment/reflected_rings.h"
#include "shaders/interface/specialisation.h"

lobe_resource passes_reflected_lobes(lobe_graph *graph, lobe_distribution distribution,
                                     lobe_distribution masking) {
    lobe_resource table = passes_reflection_table(graph, "reflected lobes", distribution, masking,
                                                  REFLECTED_LOBES_SIZE, REFLECTED_LOBES);
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
