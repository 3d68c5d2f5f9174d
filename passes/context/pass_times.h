#ifndef PASSES_CONTEXT_PASS_TIMES_H
#define PASSES_CONTEXT_PASS_TIMES_H

#include <stdbool.h>

#include <lobe/graph.h>
#include <lobe/renderer.h>

/// Adds what is known of a submitted frame of the graph before the device has finished it.
void passes_pass_times_add_submission(lobe_frame *frame, const lobe_graph_report *report);
/// Adds that of a finished one, with the times of the passes that ran. False: out of memory.
bool passes_pass_times_add(lobe_frame *frame, const lobe_graph_report *report,
                           const lobe_allocator *allocator);

#endif
