#ifndef ENGINE_GRAPH_REPORT_H
#define ENGINE_GRAPH_REPORT_H

#include "engine/graph/graph.h"

/// Compilation: what will run, and what memory and barriers that takes.
lobe_result engine_graph_report_compiled(lobe_graph *graph);
/// Execution: adds the times.
lobe_result engine_graph_report_executed(lobe_graph *graph);

#endif
