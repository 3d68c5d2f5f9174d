#include "engine/graph/words.h"

/// Passes are boxes; each content that a pass leaves in a resource is an ellipse of its own, so
/// that the picture has no circles. `w` counts accesses, `r` resources, `p` passes.

static void print_escaped(engine_text_builder *out, const char *text) {
    for (; *text; text++) {
        if (*text == '"' || *text == '\\')
            engine_text_add(out, "\\");
        engine_text_add(out, "%c", (unsigned char)*text < 0x20 ? '?' : *text);
    }
}

static const char *pass_style(lobe_pass_state state) {
    static const char *const styles[] = {
        [LOBE_PASS_RUN] = "style=filled, fillcolor=\"#ffd27f\"",
        [LOBE_PASS_CULLED] = "style=dashed, fontcolor=\"#808080\", color=\"#808080\"",
        [LOBE_PASS_SKIPPED] = "style=\"filled,dashed\", fillcolor=\"#e8e8e8\"",
    };
    return styles[state];
}

static uint32_t barriers_before(const lobe_graph *graph, uint32_t position) {
    uint32_t count = 0;
    for (uint32_t n = 0; n < graph->dependencies.barrier_count; n++)
        count += graph->dependencies.barriers[n].position == position &&
                 graph->dependencies.barriers[n].resource != ENGINE_DEPENDENCY_NONE;
    return count;
}

static void print_pass(engine_text_builder *out, const lobe_graph *graph, uint32_t index) {
    const lobe_pass *pass = graph->passes[index];
    const engine_dependency_pass *dependency = &graph->dependencies.passes[index];
    engine_text_add(out, "  p%u [shape=box, %s, label=\"", index, pass_style(dependency->state));
    print_escaped(out, pass->name);
    engine_text_add(out, "\\n%s, %s", engine_graph_kind_word(pass->kind),
                    engine_graph_state_word(dependency->state));
    if (dependency->state == LOBE_PASS_RUN && graph->phase == ENGINE_GRAPH_EXECUTED)
        engine_text_add(out, ", %.3f ms", pass->milliseconds);
    if (dependency->state == LOBE_PASS_RUN)
        engine_text_add(out, "\\n%u barriers before", barriers_before(graph, dependency->position));
    engine_text_add(out, "\"];\n");
}

static const char *resource_style(engine_graph_origin origin) {
    if (origin == ENGINE_GRAPH_RETAINED)
        return "peripheries=2, style=filled, fillcolor=\"#bfe3bf\"";
    return origin == ENGINE_GRAPH_TRANSIENT ? "style=filled, fillcolor=\"#cfe2ff\""
                                            : "style=filled, fillcolor=\"#eeeeee\"";
}

static void print_resource_label(engine_text_builder *out, const engine_graph_resource *resource) {
    print_escaped(out, resource->name);
    engine_text_add(out, "\\n");
    engine_graph_print_shape(out, resource);
    engine_text_add(out, "\\n%s, %llu bytes of memory", engine_graph_origin_word(resource->origin),
                    (unsigned long long)resource->bytes);
}

static void print_content(engine_text_builder *out, const lobe_graph *graph, uint32_t index) {
    const engine_dependency_access *access = &graph->dependencies.accesses[index];
    const engine_graph_resource *resource = &graph->resources[access->resource];
    if (access->kind == ENGINE_ACCESS_READ || access->pass == ENGINE_DEPENDENCY_NONE)
        return;
    engine_text_add(out, "  w%u [shape=ellipse, %s, label=\"", index,
                    resource_style(resource->origin));
    print_resource_label(out, resource);
    if (resource->is_image) {
        engine_text_add(out, "\\n");
        engine_graph_print_range(out, resource, &access->range);
    }
    engine_text_add(out, "\"];\n  p%u -> w%u;\n", access->pass, index);
}

/// Content that was there before any pass of the frame.
static void print_start(engine_text_builder *out, const lobe_graph *graph, uint32_t index) {
    const engine_graph_resource *resource = &graph->resources[index];
    engine_text_add(out, "  r%u [shape=ellipse, %s, label=\"", index,
                    resource_style(resource->origin));
    print_resource_label(out, resource);
    engine_text_add(out, "\"];\n");
}

static bool starts_with_content(const engine_dependency_graph *dependencies, uint32_t resource) {
    for (uint32_t n = 0; n < dependencies->access_count; n++) {
        const engine_dependency_access *access = &dependencies->accesses[n];
        if (access->resource != resource || access->kind == ENGINE_ACCESS_WRITE)
            continue;
        for (uint32_t s = 0; s < engine_access_size(access); s++)
            if (engine_access_source(dependencies, access, s) == ENGINE_DEPENDENCY_NONE)
                return true;
    }
    return false;
}

/// One edge for each content that the access reads.
static void print_reads(engine_text_builder *out, const lobe_graph *graph, uint32_t index) {
    const engine_dependency_graph *dependencies = &graph->dependencies;
    const engine_dependency_access *access = &dependencies->accesses[index];
    if (access->kind == ENGINE_ACCESS_WRITE)
        return;
    for (uint32_t n = 0; n < engine_access_size(access); n++) {
        uint32_t source = engine_access_source(dependencies, access, n);
        bool known = false;
        for (uint32_t before = 0; before < n && !known; before++)
            known = engine_access_source(dependencies, access, before) == source;
        if (known)
            continue;
        if (source == ENGINE_DEPENDENCY_NONE)
            engine_text_add(out, "  r%u -> ", access->resource);
        else
            engine_text_add(out, "  w%u -> ", source);
        if (access->pass == ENGINE_DEPENDENCY_NONE)
            engine_text_add(out, "output;\n");
        else
            engine_text_add(out, "p%u;\n", access->pass);
    }
}

static void print_legend(engine_text_builder *out, const lobe_graph *graph) {
    const lobe_graph_report *report = &graph->report;
    engine_text_add(
        out,
        "  label=\"%.3f ms; transient memory %llu bytes (%llu without aliasing), retained %llu "
        "bytes; %u barriers\";\n",
        report->milliseconds, (unsigned long long)report->transient_bytes,
        (unsigned long long)report->transient_bytes_without_aliasing,
        (unsigned long long)report->retained_bytes, report->barrier_count);
}

static bool has_output(const engine_dependency_graph *dependencies) {
    for (uint32_t n = 0; n < dependencies->access_count; n++)
        if (dependencies->accesses[n].pass == ENGINE_DEPENDENCY_NONE)
            return true;
    return false;
}

static void print_graph(engine_text_builder *out, const lobe_graph *graph) {
    const engine_dependency_graph *dependencies = &graph->dependencies;
    print_legend(out, graph);
    for (uint32_t n = 0; n < dependencies->order_count; n++)
        print_pass(out, graph, dependencies->order[n]);
    for (uint32_t n = 0; n < dependencies->resource_count; n++)
        if (starts_with_content(dependencies, n))
            print_start(out, graph, n);
    if (has_output(dependencies))
        engine_text_add(out, "  output [shape=doublecircle];\n");
    for (uint32_t n = 0; n < dependencies->access_count; n++) {
        print_content(out, graph, n);
        print_reads(out, graph, n);
    }
}

char *lobe_graph_dump_graphviz(const lobe_graph *graph) {
    engine_text_builder builder = {.bytes.allocator = graph->device->host.allocator};
    engine_text_builder *out = &builder;
    engine_text_add(out, "digraph lobe {\n  rankdir=LR;\n  node [fontname=\"sans-serif\"];\n");
    if (graph->phase != ENGINE_GRAPH_DECLARING)
        print_graph(out, graph);
    engine_text_add(out, "}\n");
    return engine_text_finish(out);
}
