#ifndef TOOLS_RENDER_FRAME_TIMES_H
#define TOOLS_RENDER_FRAME_TIMES_H

#include <stdbool.h>

#include <lobe/profile.h>
#include <lobe/renderer.h>

/// Times of a number of frames. Those of the first contain the driver's compilation of its shaders,
/// which takes many times as long as the passes themselves, and are kept apart.
typedef struct frame_times {
    lobe_profile *profile;        ///< of the frames after the first
    lobe_profile_summary later;   ///< the same; no runs if there was one frame only
    lobe_profile_summary summary; ///< `later`, or of a single frame that of the first
    lobe_profile *first_profile;
    lobe_profile_summary first;
} frame_times;

/// Adds the times of a finished frame. Errors: LOBE_ERROR_OUT_OF_MEMORY, logged.
lobe_result frame_times_add(frame_times *times, const lobe_frame *frame, const lobe_host *host);
/// After the last frame.
lobe_result frame_times_finish(frame_times *times);
void frame_times_free(frame_times *times);

/// Whether `summary` is of a first frame.
bool frame_times_are_first(const frame_times *times);
/// Prints a line for each pass and for the whole frame.
void frame_times_print(const frame_times *times);

#endif
