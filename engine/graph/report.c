#include "engine/graph/report.h"

#include "engine/base/growing_array.h"

static void add_pass(lobe_graph *graph, uint32_t index) {
    const lobe_pass *pass = graph->passes[index];
    if (pass->internal)
        return;
    graph->pass_reports[graph->report.pass_count++] =
        (lobe_pass_report){.name = pass->name,
                           .kind = pass->kind,
                           .state = graph->dependencies.passes[index].state,
                           .milliseconds = pass->milliseconds,
                           .read_bytes = pass->read_bytes,
                           .written_bytes = pass->written_bytes};
}

static lobe_result list_passes(lobe_graph *graph) {
    const engine_dependency_graph *dependencies = &graph->dependencies;
    if (!engine_array_reserve(graph->device->host.allocator, (void **)&graph->pass_reports,
                              &graph->report_capacity, (uint64_t)dependencies->pass_count + 1,
                              sizeof *graph->pass_reports))
        return engine_graph_fail_memory(graph);
    graph->report.passes = graph->pass_reports;
    graph->report.pass_count = 0;
    for (uint32_t n = 0; n < dependencies->running_count; n++)
        add_pass(graph, dependencies->running[n]);
    for (uint32_t n = 0; n < dependencies->order_count; n++)
        if (dependencies->passes[dependencies->order[n]].state != LOBE_PASS_RUN)
            add_pass(graph, dependencies->order[n]);
    return LOBE_OK;
}

static uint32_t count_barriers(const engine_dependency_graph *dependencies) {
    uint32_t count = 0;
    for (uint32_t n = 0; n < dependencies->barrier_count; n++)
        count += dependencies->barriers[n].resource != ENGINE_DEPENDENCY_NONE;
    return count;
}

lobe_result engine_graph_report_compiled(lobe_graph *graph) {
    graph->report =
        (lobe_graph_report){.transient_bytes = graph->transients.shared_bytes,
                            .transient_bytes_without_aliasing = graph->transients.separate_bytes,
                            .barrier_count = count_barriers(&graph->dependencies)};
    for (const engine_graph_retained *kept = graph->retained; kept; kept = kept->next)
        graph->report.retained_bytes += kept->allocation.size;
    return list_passes(graph);
}

lobe_result engine_graph_report_executed(lobe_graph *graph) {
    return list_passes(graph);
}

const lobe_graph_report *lobe_graph_describe(const lobe_graph *graph) {
    return &graph->report;
}
