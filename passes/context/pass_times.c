#include "passes/context/pass_times.h"

#include <stdio.h>
#include <string.h>

static lobe_pass_time *find_or_append(lobe_frame *frame, const char *name,
                                      const lobe_allocator *allocator) {
    for (size_t i = 0; i < frame->pass_count; i++) {
        if (strcmp(frame->passes[i].name, name) == 0)
            return &frame->passes[i];
    }
    lobe_pass_time *grown =
        lobe_reallocate(allocator, frame->passes, frame->pass_count + 1, sizeof *frame->passes);
    if (!grown)
        return NULL;
    frame->passes = grown;
    lobe_pass_time *time = &grown[frame->pass_count++];
    *time = (lobe_pass_time){0};
    snprintf(time->name, sizeof time->name, "%s", name);
    return time;
}

void passes_pass_times_add_submission(lobe_frame *frame, const lobe_graph_report *report) {
    frame->host_milliseconds += report->host_milliseconds;
    ++frame->submissions;
}

bool passes_pass_times_add(lobe_frame *frame, const lobe_graph_report *report,
                           const lobe_allocator *allocator) {
    passes_pass_times_add_submission(frame, report);
    frame->milliseconds += report->milliseconds;
    for (size_t i = 0; i < report->pass_count; i++) {
        if (report->passes[i].state != LOBE_PASS_RUN)
            continue;
        lobe_pass_time *time = find_or_append(frame, report->passes[i].name, allocator);
        if (!time)
            return false;
        time->milliseconds += report->passes[i].milliseconds;
        ++time->count;
        time->read_bytes += report->passes[i].read_bytes;
        time->written_bytes += report->passes[i].written_bytes;
    }
    return true;
}
