#ifndef TOOLS_BENCH_CHANGED_FRAME_H
#define TOOLS_BENCH_CHANGED_FRAME_H

#include <lobe/profile.h>
#include <lobe/renderer.h>
#include <lobe/scene.h>

#include "tools/animation/animation.h"

/// What a frame costs after the host has changed the texels of all maps. Milliseconds of the calls
/// that hand them over (lobe_renderer_update_scene) and draw: everything from the first to the
/// return of the second, uploads, what a filter computes on the host, and waiting for the device.
typedef struct changed_cost {
    double wall;
    double caller_cpu;  ///< CPU time of the calling thread
    double process_cpu; ///< of all threads; with a software renderer, the device's work too
} changed_cost;

/// The names of a cost's parts in a profile, in this order.
enum { CHANGED_WALL, CHANGED_CALLER_CPU, CHANGED_PROCESS_CPU, CHANGED_COSTS };

/// Moves every image of the scene a texel to the left, as if it were a torus, tells the renderer,
/// and draws; moving is not part of the cost. Images on the device change as time goes on by 1/30 s
/// (`animation`, NULL if there are none). The scene must be the renderer's. Free the frame.
lobe_result changed_frame_render(lobe_renderer *renderer, lobe_scene *scene, animation *animation,
                                 const lobe_render_parameters *parameters, const lobe_host *host,
                                 lobe_frame *frame, changed_cost *cost);

/// Adds a cost as a frame whose passes are its parts.
lobe_result changed_cost_add(lobe_profile *profile, const changed_cost *cost);

#endif
