#ifndef ENGINE_GRAPH_REPORT_H
#define ENGINE_GRAPH_REPORT_H

#include <time.h>

#include "engine/graph/state.h"

/// CPU time of the calling thread in milliseconds, from an arbitrary start: neither waiting nor
/// other processes count.
static inline double engine_host_milliseconds(void) {
    struct timespec time = {0};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return 1e3 * (double)time.tv_sec + 1e-6 * (double)time.tv_nsec;
}

/// Compilation: counts the bytes that each pass reads and writes according to its declaration, each
/// subresource once per direction, however many bindings use it.
lobe_result engine_graph_count_traffic(lobe_graph *graph);

/// Compilation: reports what will run, and the memory and barriers that it takes.
lobe_result engine_graph_report_compiled(lobe_graph *graph);
/// Execution: adds the times.
lobe_result engine_graph_report_executed(lobe_graph *graph);

// Device times. Each running pass, at `position`, has one timestamp before it and one after.

lobe_result engine_graph_prepare_timestamps(lobe_graph *graph);
void engine_graph_reset_timestamps(lobe_graph *graph);
void engine_graph_write_timestamp(lobe_graph *graph, uint32_t position, bool after);
lobe_result engine_graph_read_timestamps(lobe_graph *graph);

#endif
