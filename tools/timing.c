#include "tools/timing.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/// Samples are kept in order of size.
static bool insert(timing_samples *samples, double milliseconds) {
    double *grown = realloc(samples->milliseconds, (samples->count + 1) * sizeof *grown);
    if (!grown)
        return false;
    size_t place = samples->count++;
    for (; place > 0 && grown[place - 1] > milliseconds; --place)
        grown[place] = grown[place - 1];
    grown[place] = milliseconds;
    samples->milliseconds = grown;
    return true;
}

static timing_pass *find_or_append(timing *timing, const char *name) {
    for (size_t i = 0; i < timing->pass_count; ++i) {
        if (strcmp(timing->passes[i].name, name) == 0)
            return &timing->passes[i];
    }
    timing_pass *grown = realloc(timing->passes, (timing->pass_count + 1) * sizeof *grown);
    if (!grown)
        return NULL;
    timing->passes = grown;
    timing_pass *pass = &grown[timing->pass_count++];
    *pass = (timing_pass){0};
    snprintf(pass->name, sizeof pass->name, "%s", name);
    return pass;
}

bool timing_add(timing *timing, const lobe_frame *frame) {
    for (size_t i = 0; i < frame->pass_count; ++i) {
        timing_pass *pass = find_or_append(timing, frame->passes[i].name);
        if (!pass || !insert(&pass->samples, frame->passes[i].milliseconds))
            return false;
    }
    return insert(&timing->frames, frame->milliseconds);
}

void timing_free(timing *timing) {
    for (size_t i = 0; i < timing->pass_count; ++i)
        free(timing->passes[i].samples.milliseconds);
    free(timing->passes);
    free(timing->frames.milliseconds);
    *timing = (struct timing){0};
}

double timing_quantile(const timing_samples *samples, double part) {
    if (samples->count == 0)
        return 0;
    double place = part * (double)(samples->count - 1);
    size_t below = (size_t)place;
    size_t above = below + 1 < samples->count ? below + 1 : below;
    double weight = place - (double)below;
    return (1 - weight) * samples->milliseconds[below] + weight * samples->milliseconds[above];
}
