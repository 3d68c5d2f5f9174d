#include <stdlib.h>

#include "engine/graph_words.h"

/// Names come from users: control characters would break the lines.
static void print_name(FILE *stream, const char *name) {
    fputc('\'', stream);
    for (; *name; name++)
        fputc((unsigned char)*name < 0x20 ? '?' : *name, stream);
    fputc('\'', stream);
}

static void print_summary(FILE *stream, const lobe_graph *graph) {
    const lobe_graph_report *report = &graph->report;
    fprintf(stream, "render graph: %zu passes, %.3f ms\n", report->pass_count,
            report->milliseconds);
    fprintf(stream, "transient memory: %llu bytes (%llu without aliasing)\n",
            (unsigned long long)report->transient_bytes,
            (unsigned long long)report->transient_bytes_without_aliasing);
    fprintf(stream, "retained memory: %llu bytes\n", (unsigned long long)report->retained_bytes);
    fprintf(stream, "barriers: %u\n", report->barrier_count);
}

static void print_accesses(FILE *stream, const lobe_graph *graph, uint32_t pass) {
    static const char *const words[] = {
        [ENGINE_ACCESS_READ] = "reads",
        [ENGINE_ACCESS_WRITE] = "writes",
        [ENGINE_ACCESS_MODIFY] = "modifies",
    };
    const engine_dependency_graph *dependencies = &graph->dependencies;
    for (uint32_t n = dependencies->passes[pass].first_access; n != ENGINE_DEPENDENCY_NONE;
         n = dependencies->accesses[n].next) {
        const engine_dependency_access *access = &dependencies->accesses[n];
        fprintf(stream, "      %s ", words[access->kind]);
        print_name(stream, graph->resources[access->resource].name);
        engine_graph_print_range(stream, &graph->resources[access->resource], &access->range);
        fputc('\n', stream);
    }
}

static void print_barrier(FILE *stream, const lobe_graph *graph,
                          const engine_dependency_barrier *barrier) {
    fprintf(stream, "      barrier ");
    if (barrier->resource == ENGINE_DEPENDENCY_NONE) {
        fprintf(stream, "on all memory: it held other resources before\n");
        return;
    }
    const engine_graph_resource *resource = &graph->resources[barrier->resource];
    print_name(stream, resource->name);
    engine_graph_print_range(stream, resource, &barrier->range);
    if (resource->is_image)
        fprintf(stream, ": %s to %s", engine_graph_layout_word(barrier->from.layout),
                engine_graph_layout_word(barrier->to.layout));
    fputc('\n', stream);
}

static void print_barriers(FILE *stream, const lobe_graph *graph, uint32_t position) {
    for (uint32_t n = 0; n < graph->dependencies.barrier_count; n++)
        if (graph->dependencies.barriers[n].position == position)
            print_barrier(stream, graph, &graph->dependencies.barriers[n]);
}

static void print_pass(FILE *stream, const lobe_graph *graph, uint32_t index) {
    const lobe_pass *pass = graph->passes[index];
    const engine_dependency_pass *dependency = &graph->dependencies.passes[index];
    fprintf(stream, "  %-7s %-8s ", engine_graph_state_word(dependency->state),
            engine_graph_kind_word(pass->kind));
    print_name(stream, pass->name);
    if (graph->phase == ENGINE_GRAPH_EXECUTED && dependency->state == LOBE_PASS_RUN)
        fprintf(stream, " %.3f ms", pass->milliseconds);
    fputc('\n', stream);
    if (dependency->state == LOBE_PASS_RUN)
        print_barriers(stream, graph, dependency->position);
    print_accesses(stream, graph, index);
}

static void print_passes(FILE *stream, const lobe_graph *graph) {
    const engine_dependency_graph *dependencies = &graph->dependencies;
    fprintf(stream, "passes, in order of execution\n");
    for (uint32_t n = 0; n < dependencies->running_count; n++)
        print_pass(stream, graph, dependencies->running[n]);
    for (uint32_t n = 0; n < dependencies->order_count; n++)
        if (dependencies->passes[dependencies->order[n]].state != LOBE_PASS_RUN)
            print_pass(stream, graph, dependencies->order[n]);
}

static void print_resource(FILE *stream, const lobe_graph *graph, uint32_t index) {
    const engine_graph_resource *resource = &graph->resources[index];
    const engine_dependency_resource *dependency = &graph->dependencies.resources[index];
    fprintf(stream, "  %-9s ", engine_graph_origin_word(resource->origin));
    print_name(stream, resource->name);
    fprintf(stream, " ");
    engine_graph_print_shape(stream, resource);
    fprintf(stream, "; %llu bytes of memory", (unsigned long long)resource->bytes);
    if (dependency->placed)
        fprintf(stream, " in block %u at %llu", dependency->block,
                (unsigned long long)dependency->offset);
    if (dependency->first_position == ENGINE_DEPENDENCY_NONE)
        fprintf(stream, ", not used");
    fputc('\n', stream);
}

char *lobe_graph_dump_text(const lobe_graph *graph) {
    char *text = NULL;
    size_t size = 0;
    FILE *stream = open_memstream(&text, &size);
    if (!stream)
        return NULL;
    print_summary(stream, graph);
    print_passes(stream, graph);
    fprintf(stream, "resources\n");
    for (uint32_t n = 0; n < graph->dependencies.resource_count; n++)
        print_resource(stream, graph, n);
    if (fclose(stream) == 0)
        return text;
    free(text);
    return NULL;
}
