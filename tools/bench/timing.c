#include "tools/bench/timing.h"

#include <stdlib.h>

lobe_result timing_add(lobe_profile *profile, const lobe_frame *frame, const lobe_host *host) {
    lobe_pass_report *passes = calloc(frame->pass_count + 1, sizeof *passes);
    if (!passes)
        return lobe_host_fail(host, LOBE_ERROR_OUT_OF_MEMORY, "times of passes: out of memory");
    for (size_t i = 0; i < frame->pass_count; i++)
        passes[i] = (lobe_pass_report){.name = frame->passes[i].name,
                                       .state = LOBE_PASS_RUN,
                                       .milliseconds = frame->passes[i].milliseconds};
    const lobe_graph_report report = {.passes = passes,
                                      .pass_count = frame->pass_count,
                                      .milliseconds = frame->milliseconds,
                                      .host_milliseconds = frame->host_milliseconds};
    const lobe_result result = lobe_profile_add(profile, &report);
    free(passes);
    return result;
}

static int compare_numbers(const void *left, const void *right) {
    const double a = *(const double *)left, b = *(const double *)right;
    return (a > b) - (a < b);
}

double timing_median(double *values, size_t count) {
    qsort(values, count, sizeof *values, compare_numbers);
    return 0.5 * (values[(count - 1) / 2] + values[count / 2]);
}
