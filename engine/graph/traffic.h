#ifndef ENGINE_GRAPH_TRAFFIC_H
#define ENGINE_GRAPH_TRAFFIC_H

#include "engine/graph/graph.h"

/// Bytes of these levels and layers of an image, tightly packed, all samples; of a whole buffer.
uint64_t engine_graph_range_bytes(const engine_graph_resource *resource, const lobe_range *range);

/// Compilation: what each pass must move, from what it declared: each subresource once a
/// direction, through however many bindings the pass uses it.
lobe_result engine_graph_count_traffic(lobe_graph *graph);

#endif
