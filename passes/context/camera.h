#ifndef PASSES_CONTEXT_CAMERA_H
#define PASSES_CONTEXT_CAMERA_H

#include <cglm/cglm.h>

#include <lobe/scene.h>

/// Checks that the camera has a picture: logs the first value that rules it out, in one line, and
/// returns LOBE_ERROR_INVALID_ARGUMENT.
lobe_result passes_camera_check(const lobe_camera *camera, const lobe_host *host);

/// Rotation from the world to the camera: x right, y up, z towards the viewer.
void passes_camera_rotation(const lobe_camera *camera, mat3 rotation);

/// Position of the eye, w = 1; for an orthographic camera, the direction to the viewer, w = 0.
void passes_camera_eye(const lobe_camera *camera, vec4 eye);

/// World to clip space as lobe_pass_draw expects it (y down, reversed depth), for a picture of
/// `width` x `height` pixels. `sample` is the sample's position in the pixel, [0, 1] each;
/// `minimum` and `maximum` bound the scene, for the far plane of an orthographic camera.
void passes_camera_projection(const lobe_camera *camera, uint32_t width, uint32_t height,
                              const float sample[2], const float minimum[3], const float maximum[3],
                              mat4 world_to_clip);

/// By how much a picture moves in clip space for the camera's shift and jitter, and so that the
/// samples are at the centres of its pixels.
void passes_camera_shift(const lobe_camera *camera, uint32_t width, uint32_t height,
                         const float sample[2], float shift[2]);

/// The direction of a pixel's sample is centre + x right + y down, with x and y in [-1, 1] across
/// the picture, in the world, not normalised. An orthographic camera looks in one direction only.
void passes_camera_directions(const lobe_camera *camera, uint32_t width, uint32_t height,
                              const float sample[2], vec3 centre, vec3 right, vec3 down);

/// How depths become slopes. The depth buffer's values are linear across the picture on any plane.
/// Where they are not, their second difference between neighbouring pixels, divided by the depth
/// times `scale` plus `offset`, is about the change of the surface's slope against the view, from
/// pixel to pixel. Bounds as for passes_camera_projection.
void passes_camera_slope_scale(const lobe_camera *camera, uint32_t height, const float minimum[3],
                               const float maximum[3], float *scale, float *offset);

/// Unit view direction, and in w its dot product with the eye's position: the distance of a point p
/// along the view is <axis, p> - w.
void passes_camera_axis(const lobe_camera *camera, vec4 axis);

#endif
