#include <stdlib.h>

#include "engine/graph_words.h"

/// Passes are boxes; each content that a pass leaves in a resource is an ellipse of its own, so
/// that the picture has no circles. `w` counts accesses, `r` resources, `p` passes.

static void print_escaped(FILE *stream, const char *text) {
    for (; *text; text++) {
        if (*text == '"' || *text == '\\')
            fputc('\\', stream);
        fputc((unsigned char)*text < 0x20 ? '?' : *text, stream);
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

static void print_pass(FILE *stream, const lobe_graph *graph, uint32_t index) {
    const lobe_pass *pass = graph->passes[index];
    const engine_dependency_pass *dependency = &graph->dependencies.passes[index];
    fprintf(stream, "  p%u [shape=box, %s, label=\"", index, pass_style(dependency->state));
    print_escaped(stream, pass->name);
    fprintf(stream, "\\n%s, %s", engine_graph_kind_word(pass->kind),
            engine_graph_state_word(dependency->state));
    if (dependency->state == LOBE_PASS_RUN && graph->phase == ENGINE_GRAPH_EXECUTED)
        fprintf(stream, ", %.3f ms", pass->milliseconds);
    if (dependency->state == LOBE_PASS_RUN)
        fprintf(stream, "\\n%u barriers before", barriers_before(graph, dependency->position));
    fprintf(stream, "\"];\n");
}

static const char *resource_style(engine_graph_origin origin) {
    if (origin == ENGINE_GRAPH_RETAINED)
        return "peripheries=2, style=filled, fillcolor=\"#bfe3bf\"";
    return origin == ENGINE_GRAPH_TRANSIENT ? "style=filled, fillcolor=\"#cfe2ff\""
                                            : "style=filled, fillcolor=\"#eeeeee\"";
}

static void print_resource_label(FILE *stream, const engine_graph_resource *resource) {
    print_escaped(stream, resource->name);
    fprintf(stream, "\\n");
    engine_graph_print_shape(stream, resource);
    fprintf(stream, "\\n%s, %llu bytes of memory", engine_graph_origin_word(resource->origin),
            (unsigned long long)resource->bytes);
}

static void print_content(FILE *stream, const lobe_graph *graph, uint32_t index) {
    const engine_dependency_access *access = &graph->dependencies.accesses[index];
    const engine_graph_resource *resource = &graph->resources[access->resource];
    if (access->kind == ENGINE_ACCESS_READ || access->pass == ENGINE_DEPENDENCY_NONE)
        return;
    fprintf(stream, "  w%u [shape=ellipse, %s, label=\"", index, resource_style(resource->origin));
    print_resource_label(stream, resource);
    if (resource->is_image) {
        fprintf(stream, "\\n");
        engine_graph_print_range(stream, resource, &access->range);
    }
    fprintf(stream, "\"];\n  p%u -> w%u;\n", access->pass, index);
}

/// Content that was there before any pass of the frame.
static void print_start(FILE *stream, const lobe_graph *graph, uint32_t index) {
    const engine_graph_resource *resource = &graph->resources[index];
    fprintf(stream, "  r%u [shape=ellipse, %s, label=\"", index, resource_style(resource->origin));
    print_resource_label(stream, resource);
    fprintf(stream, "\"];\n");
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
static void print_reads(FILE *stream, const lobe_graph *graph, uint32_t index) {
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
            fprintf(stream, "  r%u -> ", access->resource);
        else
            fprintf(stream, "  w%u -> ", source);
        if (access->pass == ENGINE_DEPENDENCY_NONE)
            fprintf(stream, "output;\n");
        else
            fprintf(stream, "p%u;\n", access->pass);
    }
}

static void print_legend(FILE *stream, const lobe_graph *graph) {
    const lobe_graph_report *report = &graph->report;
    fprintf(stream,
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

static void print_graph(FILE *stream, const lobe_graph *graph) {
    const engine_dependency_graph *dependencies = &graph->dependencies;
    print_legend(stream, graph);
    for (uint32_t n = 0; n < dependencies->order_count; n++)
        print_pass(stream, graph, dependencies->order[n]);
    for (uint32_t n = 0; n < dependencies->resource_count; n++)
        if (starts_with_content(dependencies, n))
            print_start(stream, graph, n);
    if (has_output(dependencies))
        fprintf(stream, "  output [shape=doublecircle];\n");
    for (uint32_t n = 0; n < dependencies->access_count; n++) {
        print_content(stream, graph, n);
        print_reads(stream, graph, n);
    }
}

char *lobe_graph_dump_graphviz(const lobe_graph *graph) {
    char *text = NULL;
    size_t size = 0;
    FILE *stream = open_memstream(&text, &size);
    if (!stream)
        return NULL;
    fprintf(stream, "digraph lobe {\n  rankdir=LR;\n  node [fontname=\"sans-serif\"];\n");
    if (graph->phase != ENGINE_GRAPH_DECLARING)
        print_graph(stream, graph);
    fprintf(stream, "}\n");
    if (fclose(stream) == 0)
        return text;
    free(text);
    return NULL;
}
