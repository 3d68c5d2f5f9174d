#ifndef ENGINE_GRAPH_STATE_H
#define ENGINE_GRAPH_STATE_H

#include "engine/device/device.h"
#include "engine/graph/frame.h"
#include "engine/graph/store/kept.h"

struct lobe_graph {
    lobe_device *device;
    engine_graph_frame frame; ///< declared in this frame; lobe_graph_begin empties it
    engine_graph_kept kept;   ///< kept between frames
};

// Failures of a frame, besides lobe_graph_fail

/// Marks the frame as failed where the failure was logged already. Returns the frame's first
/// failure.
lobe_result engine_graph_propagate(lobe_graph *graph, lobe_result result);
/// Logs the fault that the dependency graph found, and fails the frame.
lobe_result engine_graph_fail_dependency(lobe_graph *graph);
lobe_result engine_graph_fail_memory(lobe_graph *graph);

#endif
