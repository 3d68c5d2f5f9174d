#include "passes/renderer/accumulation.h"

lobe_resource passes_accumulation(lobe_graph *graph, lobe_resource radiance, lobe_resource sum,
                                  uint32_t width, uint32_t height) {
    lobe_pass *pass = lobe_graph_add_pass(graph, LOBE_PASS_COMPUTE, "accumulation");
    lobe_pass_read(pass, &(lobe_binding){.name = "radiance", .resource = radiance});
    sum = lobe_pass_modify(pass, &(lobe_binding){.name = "sum", .resource = sum});
    lobe_pass_dispatch(pass, &(lobe_dispatch){.shader = "shading/accumulation.comp",
                                              .threads = {width, height, 1}});
    return sum;
}
