#ifndef ENGINE_GRAPH_STORE_RETAIN_H
#define ENGINE_GRAPH_STORE_RETAIN_H

#include "engine/graph/graph.h"

/// A new frame: nothing is declared yet.
void engine_graph_begin_retained(lobe_graph *graph);
void engine_graph_free_retained(lobe_graph *graph);

/// Compilation: what was kept but cannot serve this frame's uses loses its content.
lobe_result engine_graph_check_retained(lobe_graph *graph);
/// Compilation: frees what this frame did not declare again.
lobe_result engine_graph_release_retained(lobe_graph *graph);
/// Compilation: makes the retained objects that running passes need.
lobe_result engine_graph_place_retained(lobe_graph *graph);

/// Execution: what running passes write holds nothing reliable until they are done.
void engine_graph_invalidate_retained(lobe_graph *graph);
/// Execution: remembers what each subresource holds now.
void engine_graph_record_retained(lobe_graph *graph);

#endif
