#ifndef ENGINE_GRAPH_WORDS_H
#define ENGINE_GRAPH_WORDS_H

#include "engine/base/text.h"
#include "engine/graph/graph.h"

/// Words that both dumps use.

const char *engine_graph_kind_word(lobe_pass_kind kind);
const char *engine_graph_state_word(lobe_pass_state state);
const char *engine_graph_layout_word(engine_layout layout);
const char *engine_graph_origin_word(engine_graph_origin origin);

/// " levels 1 to 3, layer 0": only what a range leaves out of the whole resource.
void engine_graph_print_range(engine_text_builder *out, const engine_graph_resource *resource,
                              const lobe_range *range);
/// "RGBA16_FLOAT 1024x1024, 6 layers, 11 levels" or "96 bytes".
void engine_graph_print_shape(engine_text_builder *out, const engine_graph_resource *resource);

#endif
