#include "engine/graph/words.h"

const char *engine_graph_kind_word(lobe_pass_kind kind) {
    static const char *const words[] = {
        [LOBE_PASS_COMPUTE] = "compute",
        [LOBE_PASS_RASTER] = "raster",
        [LOBE_PASS_TRANSFER] = "transfer",
    };
    return words[kind];
}

const char *engine_graph_state_word(lobe_pass_state state) {
    static const char *const words[] = {
        [LOBE_PASS_RUN] = "run",
        [LOBE_PASS_CULLED] = "culled",
        [LOBE_PASS_SKIPPED] = "skipped",
    };
    return words[state];
}

const char *engine_graph_layout_word(engine_layout layout) {
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

const char *engine_graph_origin_word(engine_graph_origin origin) {
    static const char *const words[] = {
        [ENGINE_GRAPH_TRANSIENT] = "transient", [ENGINE_GRAPH_RETAINED] = "retained",
        [ENGINE_GRAPH_TEXTURE] = "imported",    [ENGINE_GRAPH_BUFFER] = "imported",
        [ENGINE_GRAPH_UPLOAD] = "uploaded",     [ENGINE_GRAPH_HOST_IMAGE] = "the host's",
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

void engine_graph_print_range(engine_text_builder *out, const engine_graph_resource *resource,
                              const lobe_range *range) {
    bool all_levels = range->level_count == resource->levels;
    print_interval(out, "level", range->first_level, range->level_count, resource->levels, "");
    print_interval(out, "layer", range->first_layer, range->layer_count, resource->layers,
                   all_levels ? "" : ",");
}

void engine_graph_print_shape(engine_text_builder *out, const engine_graph_resource *resource) {
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
