#include "engine/base/text.h"
#include "engine/graph/state.h"

// ---------------------------------------------------------------------------------------------
// Words that both dumps use

static const char *kind_word(lobe_pass_kind kind) {
    static const char *const words[] = {
        [LOBE_PASS_COMPUTE] = "compute",
        [LOBE_PASS_RASTER] = "raster",
        [LOBE_PASS_TRANSFER] = "transfer",
        [LOBE_PASS_EXPORT] = "export",
    };
    return words[kind];
}

static const char *state_word(lobe_pass_state state) {
    static const char *const words[] = {
        [LOBE_PASS_RUN] = "run",
        [LOBE_PASS_CULLED] = "culled",
        [LOBE_PASS_SKIPPED] = "skipped",
    };
    return words[state];
}

static const char *layout_word(engine_layout layout) {
    static const char *const words[] = {
        [ENGINE_LAYOUT_UNDEFINED] = "undefined",
        [ENGINE_LAYOUT_GENERAL] = "general",
        [ENGINE_LAYOUT_SAMPLED] = "sampled",
        [ENGINE_LAYOUT_COLOUR] = "colour",
        [ENGINE_LAYOUT_DEPTH] = "depth",
        [ENGINE_LAYOUT_COPY_SOURCE] = "copy source",
        [ENGINE_LAYOUT_COPY_TARGET] = "copy target",
        [ENGINE_LAYOUT_LENT] = "lent",
        [ENGINE_LAYOUT_RETURNED] = "returned",
    };
    return words[layout];
}

static const char *origin_word(engine_graph_origin origin) {
    static const char *const words[] = {
        [ENGINE_GRAPH_TRANSIENT] = "transient", [ENGINE_GRAPH_RETAINED] = "retained",
        [ENGINE_GRAPH_TEXTURE] = "imported",    [ENGINE_GRAPH_BUFFER] = "imported",
        [ENGINE_GRAPH_UPLOAD] = "uploaded",     [ENGINE_GRAPH_HOST_IMAGE] = "host",
        [ENGINE_GRAPH_HOST_BUFFER] = "host",
    };
    return words[origin];
}

static void print_interval(engine_text_builder *out, const char *what, uint32_t first,
                           uint32_t count, uint32_t all, const char *before) {
    if (count == all)
        return;
    if (count == 1)
        engine_text_add(out, "%s %s %u", before, what, first);
    else
        engine_text_add(out, "%s %ss %u to %u", before, what, first, first + count - 1);
}

/// " level 1, layers 0 to 3": only where the range is not the whole resource.
static void print_range(engine_text_builder *out, const engine_graph_resource *resource,
                        const lobe_range *range) {
    bool all_levels = range->level_count == resource->levels;
    print_interval(out, "level", range->first_level, range->level_count, resource->levels, "");
    print_interval(out, "layer", range->first_layer, range->layer_count, resource->layers,
                   all_levels ? "" : ",");
}

/// "RGBA16_FLOAT 1024x1024, 6 layers, 11 levels" or "96 bytes".
static void print_shape(engine_text_builder *out, const engine_graph_resource *resource) {
    if (!resource->is_image) {
        engine_text_add(out, "%llu bytes", (unsigned long long)resource->size);
        return;
    }
    engine_text_add(out, "%s %ux%u", lobe_format_name(resource->format), resource->width,
                    resource->height);
    if (resource->layers > 1)
        engine_text_add(out, ", %u layers", resource->layers);
    if (resource->levels > 1)
        engine_text_add(out, ", %u levels", resource->levels);
    if (resource->samples > 1)
        engine_text_add(out, ", %u samples", resource->samples);
}

// ---------------------------------------------------------------------------------------------
// Text

/// Names come from users; control characters in them would break the lines.
static void text_name(engine_text_builder *out, const char *name) {
    engine_text_add(out, "'");
    for (; *name; name++)
        engine_text_add(out, "%c", (unsigned char)*name < 0x20 ? '?' : *name);
    engine_text_add(out, "'");
}

static void text_summary(engine_text_builder *out, const lobe_graph *graph) {
    const lobe_graph_report *report = &graph->frame.report;
    engine_text_add(out, "render graph: %zu passes, %.3f ms\n", report->pass_count,
                    report->milliseconds);
    engine_text_add(out, "transient memory: %llu bytes (%llu without aliasing)\n",
                    (unsigned long long)report->transient_bytes,
                    (unsigned long long)report->transient_bytes_without_aliasing);
    engine_text_add(out, "retained memory: %llu bytes\n",
                    (unsigned long long)report->retained_bytes);
    engine_text_add(out, "barriers: %u\n", report->barrier_count);
}

static void text_accesses(engine_text_builder *out, const lobe_graph *graph, uint32_t pass) {
    static const char *const words[] = {
        [ENGINE_ACCESS_READ] = "reads",
        [ENGINE_ACCESS_WRITE] = "writes",
        [ENGINE_ACCESS_MODIFY] = "modifies",
    };
    const engine_dependency_graph *dependencies = &graph->frame.dependencies;
    for (uint32_t i = dependencies->passes[pass].first_access; i != ENGINE_DEPENDENCY_NONE;
         i = dependencies->accesses[i].next) {
        const engine_dependency_access *access = &dependencies->accesses[i];
        engine_text_add(out, "      %s ", words[access->kind]);
        text_name(out, graph->frame.resources[access->resource].name);
        print_range(out, &graph->frame.resources[access->resource], &access->range);
        engine_text_add(out, "\n");
    }
}

static void text_barrier(engine_text_builder *out, const lobe_graph *graph,
                         const engine_dependency_barrier *barrier) {
    engine_text_add(out, "      barrier ");
    if (barrier->resource == ENGINE_DEPENDENCY_NONE) {
        engine_text_add(out, "on all memory, which other resources used before\n");
        return;
    }
    const engine_graph_resource *resource = &graph->frame.resources[barrier->resource];
    text_name(out, resource->name);
    print_range(out, resource, &barrier->range);
    if (resource->is_image)
        engine_text_add(out, ": %s to %s", layout_word(barrier->from.layout),
                        layout_word(barrier->to.layout));
    engine_text_add(out, "\n");
}

static void text_barriers(engine_text_builder *out, const lobe_graph *graph, uint32_t position) {
    for (uint32_t i = 0; i < graph->frame.dependencies.barrier_count; i++)
        if (graph->frame.dependencies.barriers[i].position == position)
            text_barrier(out, graph, &graph->frame.dependencies.barriers[i]);
}

static void text_pass(engine_text_builder *out, const lobe_graph *graph, uint32_t index) {
    const lobe_pass *pass = graph->frame.passes[index];
    const engine_dependency_pass *dependency = &graph->frame.dependencies.passes[index];
    engine_text_add(out, "  %-7s %-8s ", state_word(dependency->state), kind_word(pass->kind));
    text_name(out, pass->name);
    if (graph->frame.phase == ENGINE_GRAPH_EXECUTED && dependency->state == LOBE_PASS_RUN)
        engine_text_add(out, " %.3f ms", pass->milliseconds);
    engine_text_add(out, "\n");
    if (dependency->state == LOBE_PASS_RUN)
        text_barriers(out, graph, dependency->position);
    text_accesses(out, graph, index);
}

static void text_passes(engine_text_builder *out, const lobe_graph *graph) {
    const engine_dependency_graph *dependencies = &graph->frame.dependencies;
    engine_text_add(out, "passes, in order of execution\n");
    for (uint32_t i = 0; i < dependencies->running_count; i++)
        text_pass(out, graph, dependencies->running[i]);
    for (uint32_t i = 0; i < dependencies->order_count; i++)
        if (dependencies->passes[dependencies->order[i]].state != LOBE_PASS_RUN)
            text_pass(out, graph, dependencies->order[i]);
}

static void text_resource(engine_text_builder *out, const lobe_graph *graph, uint32_t index) {
    const engine_graph_resource *resource = &graph->frame.resources[index];
    const engine_dependency_resource *dependency = &graph->frame.dependencies.resources[index];
    engine_text_add(out, "  %-9s ", origin_word(resource->origin));
    text_name(out, resource->name);
    engine_text_add(out, " ");
    print_shape(out, resource);
    engine_text_add(out, "; %llu bytes of memory", (unsigned long long)resource->bytes);
    if (dependency->placed)
        engine_text_add(out, " in block %u at %llu", dependency->block,
                        (unsigned long long)dependency->offset);
    if (dependency->first_position == ENGINE_DEPENDENCY_NONE)
        engine_text_add(out, ", not used");
    engine_text_add(out, "\n");
}

char *lobe_graph_dump_text(const lobe_graph *graph) {
    if (!graph)
        return NULL;
    engine_text_builder builder = {.bytes.allocator = graph->device->host.allocator};
    engine_text_builder *out = &builder;
    text_summary(out, graph);
    text_passes(out, graph);
    engine_text_add(out, "resources\n");
    for (uint32_t i = 0; i < graph->frame.dependencies.resource_count; i++)
        text_resource(out, graph, i);
    return engine_text_finish(out);
}

// ---------------------------------------------------------------------------------------------
// Graphviz
//
// Passes are boxes. Each content that a pass leaves in a resource is an ellipse of its own, so that
// the picture has no cycles. Node names: `w` and an access, `r` and a resource, `p` and a pass.

static void graphviz_escaped(engine_text_builder *out, const char *text) {
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
    for (uint32_t i = 0; i < graph->frame.dependencies.barrier_count; i++)
        count += graph->frame.dependencies.barriers[i].position == position &&
                 graph->frame.dependencies.barriers[i].resource != ENGINE_DEPENDENCY_NONE;
    return count;
}

static void graphviz_pass(engine_text_builder *out, const lobe_graph *graph, uint32_t index) {
    const lobe_pass *pass = graph->frame.passes[index];
    const engine_dependency_pass *dependency = &graph->frame.dependencies.passes[index];
    engine_text_add(out, "  p%u [shape=box, %s, label=\"", index, pass_style(dependency->state));
    graphviz_escaped(out, pass->name);
    engine_text_add(out, "\\n%s, %s", kind_word(pass->kind), state_word(dependency->state));
    if (dependency->state == LOBE_PASS_RUN && graph->frame.phase == ENGINE_GRAPH_EXECUTED)
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

static void graphviz_resource_label(engine_text_builder *out,
                                    const engine_graph_resource *resource) {
    graphviz_escaped(out, resource->name);
    engine_text_add(out, "\\n");
    print_shape(out, resource);
    engine_text_add(out, "\\n%s, %llu bytes of memory", origin_word(resource->origin),
                    (unsigned long long)resource->bytes);
}

static void graphviz_content(engine_text_builder *out, const lobe_graph *graph, uint32_t index) {
    const engine_dependency_access *access = &graph->frame.dependencies.accesses[index];
    const engine_graph_resource *resource = &graph->frame.resources[access->resource];
    if (access->kind == ENGINE_ACCESS_READ || access->pass == ENGINE_DEPENDENCY_NONE)
        return;
    engine_text_add(out, "  w%u [shape=ellipse, %s, label=\"", index,
                    resource_style(resource->origin));
    graphviz_resource_label(out, resource);
    if (resource->is_image) {
        engine_text_add(out, "\\n");
        print_range(out, resource, &access->range);
    }
    engine_text_add(out, "\"];\n  p%u -> w%u;\n", access->pass, index);
}

/// Content from before the frame.
static void graphviz_start(engine_text_builder *out, const lobe_graph *graph, uint32_t index) {
    const engine_graph_resource *resource = &graph->frame.resources[index];
    engine_text_add(out, "  r%u [shape=ellipse, %s, label=\"", index,
                    resource_style(resource->origin));
    graphviz_resource_label(out, resource);
    engine_text_add(out, "\"];\n");
}

static bool starts_with_content(const engine_dependency_graph *dependencies, uint32_t resource) {
    for (uint32_t i = 0; i < dependencies->access_count; i++) {
        const engine_dependency_access *access = &dependencies->accesses[i];
        if (access->resource != resource || access->kind == ENGINE_ACCESS_WRITE)
            continue;
        for (uint32_t s = 0; s < engine_access_size(access); s++)
            if (engine_access_source(dependencies, access, s) == ENGINE_DEPENDENCY_NONE)
                return true;
    }
    return false;
}

/// One edge for each content that the access reads.
static void graphviz_reads(engine_text_builder *out, const lobe_graph *graph, uint32_t index) {
    const engine_dependency_graph *dependencies = &graph->frame.dependencies;
    const engine_dependency_access *access = &dependencies->accesses[index];
    if (access->kind == ENGINE_ACCESS_WRITE)
        return;
    for (uint32_t i = 0; i < engine_access_size(access); i++) {
        uint32_t source = engine_access_source(dependencies, access, i);
        bool known = false;
        for (uint32_t before = 0; before < i && !known; before++)
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

static void graphviz_legend(engine_text_builder *out, const lobe_graph *graph) {
    const lobe_graph_report *report = &graph->frame.report;
    engine_text_add(
        out,
        "  label=\"%.3f ms; transient memory %llu bytes (%llu without aliasing), retained %llu "
        "bytes; %u barriers\";\n",
        report->milliseconds, (unsigned long long)report->transient_bytes,
        (unsigned long long)report->transient_bytes_without_aliasing,
        (unsigned long long)report->retained_bytes, report->barrier_count);
}

static bool has_output(const engine_dependency_graph *dependencies) {
    for (uint32_t i = 0; i < dependencies->access_count; i++)
        if (dependencies->accesses[i].pass == ENGINE_DEPENDENCY_NONE)
            return true;
    return false;
}

static void graphviz_graph(engine_text_builder *out, const lobe_graph *graph) {
    const engine_dependency_graph *dependencies = &graph->frame.dependencies;
    graphviz_legend(out, graph);
    for (uint32_t i = 0; i < dependencies->order_count; i++)
        graphviz_pass(out, graph, dependencies->order[i]);
    for (uint32_t i = 0; i < dependencies->resource_count; i++)
        if (starts_with_content(dependencies, i))
            graphviz_start(out, graph, i);
    if (has_output(dependencies))
        engine_text_add(out, "  output [shape=doublecircle];\n");
    for (uint32_t i = 0; i < dependencies->access_count; i++) {
        graphviz_content(out, graph, i);
        graphviz_reads(out, graph, i);
    }
}

char *lobe_graph_dump_graphviz(const lobe_graph *graph) {
    if (!graph)
        return NULL;
    engine_text_builder builder = {.bytes.allocator = graph->device->host.allocator};
    engine_text_builder *out = &builder;
    engine_text_add(out, "digraph lobe {\n  rankdir=LR;\n  node [fontname=\"sans-serif\"];\n");
    if (graph->frame.phase != ENGINE_GRAPH_DECLARING && graph->frame.phase != ENGINE_GRAPH_PREPARED)
        graphviz_graph(out, graph);
    engine_text_add(out, "}\n");
    return engine_text_finish(out);
}
