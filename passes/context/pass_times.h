#ifndef PASSES_CONTEXT_PASS_TIMES_H
#define PASSES_CONTEXT_PASS_TIMES_H

#include <stdbool.h>

#include <lobe/graph.h>
#include <lobe/renderer.h>

/// Adds the times of the passes that ran in a frame of the graph to `frame`. False: out of memory.
bool passes_pass_times_add(lobe_frame *frame, const lobe_graph_report *report,
                           const lobe_allocator *allocator);

#endif
