#ifndef TESTS_PASSES_RENDERER_MOTION_PLATE_MOTION_H
#define TESTS_PASSES_RENDERER_MOTION_PLATE_MOTION_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include <lobe/scene.h>

/// The motion of squares (scene_add_square), from rays and projections in double precision.

typedef struct plate_view {
    lobe_camera camera;
    uint32_t width, height; ///< pixels
} plate_view;

typedef struct plate_hit {
    bool unsure; ///< near an edge, or near where two squares meet: rounding decides
    bool hit;
    size_t plate;
    double place[3]; ///< in the square's space
} plate_hit;

/// What the centre of a pixel (plus jitter) sees. `transforms`: one for each of `count` squares.
plate_hit plate_seen(const plate_view *view, const float (*transforms)[16], size_t count,
                     const uint32_t pixel[2]);

/// Where a point of a square is in a picture without jitter, in pixels from the upper left corner.
/// False: behind the eye.
bool plate_projected(const plate_view *view, const float transform[16], const double place[3],
                     double position[2]);
/// The same for what is infinitely far away where a pixel of another view looks; false also for an
/// orthographic camera.
bool plate_distance_projected(const plate_view *view, const plate_view *from,
                              const uint32_t pixel[2], double position[2]);

#endif
