#include "engine/graph/words.h"

/// Names come from users: control characters would break the lines.
static void print_name(engine_text_builder *out, const char *name) {
    engine_text_add(out, "'");
    for (; *name; name++)
        engine_text_add(out, "%c", (unsigned char)*name < 0x20 ? '?' : *name);
    engine_text_add(out, "'");
}

static void print_summary(engine_text_builder *out, const lobe_graph *graph) {
    const lobe_graph_report *report = &graph->report;
    engine_text_add(out, "render graph: %zu passes, %.3f ms\n", report->pass_count,
                    report->milliseconds);
    engine_text_add(out, "transient memory: %llu bytes (%llu without aliasing)\n",
                    (unsigned long long)report->transient_bytes,
                    (unsigned long long)report->transient_bytes_without_aliasing);
    engine_text_add(out, "retained memory: %llu bytes\n",
                    (unsigned long long)report->retained_bytes);
    engine_text_add(out, "barriers: %u\n", report->barrier_count);
}

static void print_accesses(engine_text_builder *out, const lobe_graph *graph, uint32_t pass) {
    static const char *const words[] = {
        [ENGINE_ACCESS_READ] = "reads",
        [ENGINE_ACCESS_WRITE] = "writes",
        [ENGINE_ACCESS_MODIFY] = "modifies",
    };
    const engine_dependency_graph *dependencies = &graph->dependencies;
    for (uint32_t n = dependencies->passes[pass].first_access; n != ENGINE_DEPENDENCY_NONE;
         n = dependencies->accesses[n].next) {
        const engine_dependency_access *access = &dependencies->accesses[n];
        engine_text_add(out, "      %s ", words[access->kind]);
        print_name(out, graph->resources[access->resource].name);
        engine_graph_print_range(out, &graph->resources[access->resource], &access->range);
        engine_text_add(out, "\n");
    }
}

static void print_barrier(engine_text_builder *out, const lobe_graph *graph,
                          const engine_dependency_barrier *barrier) {
    engine_text_add(out, "      barrier ");
    if (barrier->resource == ENGINE_DEPENDENCY_NONE) {
        engine_text_add(out, "on all memory: it held other resources before\n");
        return;
    }
    const engine_graph_resource *resource = &graph->resources[barrier->resource];
    print_name(out, resource->name);
    engine_graph_print_range(out, resource, &barrier->range);
    if (resource->is_image)
        engine_text_add(out, ": %s to %s", engine_graph_layout_word(barrier->from.layout),
                        engine_graph_layout_word(barrier->to.layout));
    engine_text_add(out, "\n");
}

static void print_barriers(engine_text_builder *out, const lobe_graph *graph, uint32_t position) {
    for (uint32_t n = 0; n < graph->dependencies.barrier_count; n++)
        if (graph->dependencies.barriers[n].position == position)
            print_barrier(out, graph, &graph->dependencies.barriers[n]);
}

static void print_pass(engine_text_builder *out, const lobe_graph *graph, uint32_t index) {
    const lobe_pass *pass = graph->passes[index];
    const engine_dependency_pass *dependency = &graph->dependencies.passes[index];
    engine_text_add(out, "  %-7s %-8s ", engine_graph_state_word(dependency->state),
                    engine_graph_kind_word(pass->kind));
    print_name(out, pass->name);
    if (graph->phase == ENGINE_GRAPH_EXECUTED && dependency->state == LOBE_PASS_RUN)
        engine_text_add(out, " %.3f ms", pass->milliseconds);
    engine_text_add(out, "\n");
    if (dependency->state == LOBE_PASS_RUN)
        print_barriers(out, graph, dependency->position);
    print_accesses(out, graph, index);
}

static void print_passes(engine_text_builder *out, const lobe_graph *graph) {
    const engine_dependency_graph *dependencies = &graph->dependencies;
    engine_text_add(out, "passes, in order of execution\n");
    for (uint32_t n = 0; n < dependencies->running_count; n++)
        print_pass(out, graph, dependencies->running[n]);
    for (uint32_t n = 0; n < dependencies->order_count; n++)
        if (dependencies->passes[dependencies->order[n]].state != LOBE_PASS_RUN)
            print_pass(out, graph, dependencies->order[n]);
}

static void print_resource(engine_text_builder *out, const lobe_graph *graph, uint32_t index) {
    const engine_graph_resource *resource = &graph->resources[index];
    const engine_dependency_resource *dependency = &graph->dependencies.resources[index];
    engine_text_add(out, "  %-9s ", engine_graph_origin_word(resource->origin));
    print_name(out, resource->name);
    engine_text_add(out, " ");
    engine_graph_print_shape(out, resource);
    engine_text_add(out, "; %llu bytes of memory", (unsigned long long)resource->bytes);
    if (dependency->placed)
        engine_text_add(out, " in block %u at %llu", dependency->block,
                        (unsigned long long)dependency->offset);
    if (dependency->first_position == ENGINE_DEPENDENCY_NONE)
        engine_text_add(out, ", not used");
    engine_text_add(out, "\n");
}

char *lobe_graph_dump_text(const lobe_graph *graph) {
    engine_text_builder builder = {.bytes.allocator = graph->device->host.allocator};
    engine_text_builder *out = &builder;
    print_summary(out, graph);
    print_passes(out, graph);
    engine_text_add(out, "resources\n");
    for (uint32_t n = 0; n < graph->dependencies.resource_count; n++)
        print_resource(out, graph, n);
    return engine_text_finish(out);
}
