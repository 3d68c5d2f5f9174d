#ifndef ENGINE_GRAPH_RECORD_H
#define ENGINE_GRAPH_RECORD_H

#include "engine/graph/graph.h"

/// Records one pass (graph_record.c).
lobe_result engine_graph_record_pass(lobe_graph *graph, lobe_pass *pass);

/// Records the barriers before the pass at `position` (graph_record_barrier.c). `*next` is the
/// first barrier not recorded yet.
lobe_result engine_graph_record_barriers(lobe_graph *graph, uint32_t position, uint32_t *next);
/// All that former submissions wrote becomes visible.
void engine_graph_record_start(lobe_graph *graph);
/// All that was copied for the host becomes visible to it.
void engine_graph_record_end(lobe_graph *graph);

/// Timestamps (graph_timestamp.c). Slot n is written before and after the n-th running pass.
lobe_result engine_graph_prepare_timestamps(lobe_graph *graph);
void engine_graph_reset_timestamps(lobe_graph *graph);
void engine_graph_write_timestamp(lobe_graph *graph, uint32_t position, bool after);
lobe_result engine_graph_read_timestamps(lobe_graph *graph);

/// Records and submits (graph_execute.c). `submission` NULL: without semaphores of the host's.
lobe_result engine_graph_run(lobe_graph *graph, const lobe_vulkan_submission *submission);
/// Waits for what was submitted, and reads the times.
lobe_result engine_graph_finish(lobe_graph *graph);

#endif
