#ifndef PASSES_DISPLACEMENT_DISPLACEMENT_H
#define PASSES_DISPLACEMENT_DISPLACEMENT_H

#include "passes/context/filter.h"

/// Geometry of surfaces that a height map displaces: made on the device for the camera of a frame,
/// and kept while that and the surface stay the same.
typedef struct displacement displacement;

/// Whether the filter's settings ask for it.
bool passes_displacement_wanted(const filter_context *context);

/// Before a frame begins: gives the device what displaced instances need and it does not have.
/// Where a surface cannot be displaced, one warning says why, and it is drawn as it is. `*state` is
/// NULL at first. Does nothing unless displacement is wanted.
lobe_result passes_displacement_prepare(displacement **state, const filter_context *context,
                                        device_scene *scene);

/// Adds the passes of a frame, after meshes have been deformed: whatever draws an instance then
/// draws what they wrote (`displaced` of the device scene). `cpu`: the device is one.
void passes_displacement(displacement *state, const filter_context *context, device_scene *scene,
                         bool cpu);

/// For motion, after meshes have been deformed as in the previous frame: adds passes that write
/// where the vertices of displaced surfaces were then (`previous_vertices`), as if the camera had
/// been where it is.
void passes_displacement_before(displacement *state, const filter_context *context);

void passes_displacement_destroy(displacement **state);

#endif
