#ifndef PASSES_RENDERER_PASS_TIMES_H
#define PASSES_RENDERER_PASS_TIMES_H

#include <stdbool.h>

#include <lobe/graph.h>
#include <lobe/renderer.h>

/// Adds the passes that ran in a frame of the graph to the frame's times. False without memory.
bool passes_pass_times_add(lobe_frame *frame, const lobe_graph_report *report,
                           const lobe_allocator *allocator);

#endif
