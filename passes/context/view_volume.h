#ifndef PASSES_CONTEXT_VIEW_VOLUME_H
#define PASSES_CONTEXT_VIEW_VOLUME_H

#include <cglm/cglm.h>

#include <lobe/scene.h>

/// What a camera with perspective sees, as planes in the world: a point p is inside of one where
/// <plane, (p, 1)> >= 0. Their normals have any length.
typedef struct view_volume {
    vec4 axis; ///< of the view: see passes_camera_axis
    float near_plane;
    vec4 planes[5];  ///< of the picture's sides, and the near plane
    vec3 corners[4]; ///< of the picture, on the near plane
} view_volume;

/// `width` and `height`: of the picture, in pixels; wider by two pixels on each side, so that all
/// samples of a pixel are inside.
void passes_view_volume_make(const lobe_camera *camera, uint32_t width, uint32_t height,
                             view_volume *volume);

/// The smallest distance along the view of those points of a box that the camera sees; INFINITY if
/// it sees none. `transform`: of the box into the world, column-major, affine.
float passes_view_volume_nearest(const view_volume *volume, const float transform[16],
                                 const float minimum[3], const float maximum[3]);

#endif
