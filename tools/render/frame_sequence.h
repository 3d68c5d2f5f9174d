#ifndef TOOLS_RENDER_FRAME_SEQUENCE_H
#define TOOLS_RENDER_FRAME_SEQUENCE_H

#include <limits.h>
#include <stdbool.h>
#include <stdint.h>

/// Which frames `lobe render --frames` draws.
typedef struct frame_sequence {
    uint32_t count; ///< at least 1
    uint32_t first; ///< number of the first, if they are numbered
    bool numbered;  ///< each is at a time of its own and has files of its own
} frame_sequence;

#define FRAME_SEQUENCE_MAXIMUM 100000

/// Frames of an animation are this far apart.
#define FRAME_SEQUENCE_RATE 30

/// Reads "N", the number of times that one picture is drawn, or "A..B", the numbers of the first
/// and the last frame. False if it is neither: N in [1, FRAME_SEQUENCE_MAXIMUM], A and B in
/// [0, FRAME_SEQUENCE_MAXIMUM], A no greater than B.
bool frame_sequence_parse(const char *text, frame_sequence *sequence);

/// Seconds of the n-th frame.
double frame_sequence_seconds(const frame_sequence *sequence, double start, uint32_t n);

/// The name of a frame's file: its number goes before the ending, "rain-0012.exr" for "rain.exr",
/// in four digits, or as many as the last frame's number has. The path as it is if frames are not
/// numbered. False: too long.
bool frame_sequence_path(const frame_sequence *sequence, const char *path, uint32_t n,
                         char name[PATH_MAX]);

#endif
