#include "tools/render/frame_times.h"

#include <stdio.h>
#include <string.h>

#include "tools/bench/timing.h"

lobe_result frame_times_add(frame_times *times, const lobe_frame *frame, const lobe_host *host) {
    lobe_profile **profile = times->first_profile ? &times->profile : &times->first_profile;
    lobe_result result = *profile ? LOBE_OK : lobe_profile_create(host, profile);
    return result == LOBE_OK ? timing_add(*profile, frame, host) : result;
}

lobe_result frame_times_finish(frame_times *times) {
    lobe_result result = lobe_profile_statistics(times->first_profile, &times->first);
    if (result == LOBE_OK && times->profile)
        result = lobe_profile_statistics(times->profile, &times->later);
    times->summary = times->profile ? times->later : times->first;
    return result;
}

void frame_times_free(frame_times *times) {
    lobe_profile_destroy(&times->profile);
    lobe_profile_destroy(&times->first_profile);
}

bool frame_times_are_first(const frame_times *times) {
    return times->later.frame.runs == 0;
}

static void print_line(const char *name, const lobe_profile_times *first,
                       const lobe_profile_times *later) {
    printf("  %-36s %12.3f", name, first->median_milliseconds);
    if (later && later->runs > 0)
        printf(" %8u %12.3f", later->runs, later->median_milliseconds);
    else if (later)
        printf(" %8u %12s", 0u, "-");
    printf("\n");
}

/// Those of a pass in later frames; without runs where it ran in the first only.
static lobe_profile_times later_of(const frame_times *times, const char *pass) {
    for (size_t i = 0; i < times->later.pass_count; i++)
        if (strcmp(times->later.passes[i].name, pass) == 0)
            return times->later.passes[i];
    return (lobe_profile_times){.name = pass};
}

void frame_times_print(const frame_times *times) {
    const bool alone = frame_times_are_first(times);
    printf("  %-36s %12s", "pass", "first ms");
    if (!alone)
        printf(" %8s %12s", "later", "median ms");
    printf("\n");
    for (size_t i = 0; i < times->first.pass_count; i++) {
        const lobe_profile_times later = later_of(times, times->first.passes[i].name);
        print_line(times->first.passes[i].name, &times->first.passes[i], alone ? NULL : &later);
    }
    print_line("whole frame", &times->first.frame, alone ? NULL : &times->later.frame);
    printf("  The first frame's times include compiling its shaders%s.\n",
           alone ? "; --frames 4 also draws three without" : "");
}
