#include "engine/graph/state.h"

#include <stdarg.h>
#include <stdio.h>

#define LINE_SIZE 1024

lobe_result lobe_graph_fail(lobe_graph *graph, lobe_result result, const char *format, ...) {
    if (!graph)
        return result;
    if (graph->frame.result != LOBE_OK)
        return graph->frame.result;
    char line[LINE_SIZE];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(line, sizeof line, format, arguments);
    va_end(arguments);
    graph->frame.result = lobe_host_fail(&graph->device->host, result, "%s", line);
    return result;
}

lobe_result engine_graph_propagate(lobe_graph *graph, lobe_result result) {
    if (graph->frame.result == LOBE_OK)
        graph->frame.result = result;
    return graph->frame.result;
}

lobe_result engine_graph_fail_memory(lobe_graph *graph) {
    return lobe_graph_fail(graph, LOBE_ERROR_OUT_OF_MEMORY, "render graph: out of memory");
}

lobe_result engine_graph_fail_dependency(lobe_graph *graph) {
    char line[LINE_SIZE];
    if (graph->frame.dependencies.fault.kind == ENGINE_FAULT_MEMORY)
        return engine_graph_fail_memory(graph);
    engine_dependency_explain(&graph->frame.dependencies, line, sizeof line);
    return lobe_graph_fail(graph, LOBE_ERROR_GRAPH, "%s", line);
}
