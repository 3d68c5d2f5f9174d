#ifndef SCENES_ENVIRONMENT_DIRECTION_H
#define SCENES_ENVIRONMENT_DIRECTION_H

#include <stdbool.h>
#include <stdint.h>

#include <lobe/environment.h>

/// Where directions of an environment's own space lie on its image, for each layout: see
/// lobe_environment_layout.

/// A face of a cube on the image.
typedef struct environment_face {
    uint32_t column, row; ///< its position, in faces
    double forward[3];    ///< the direction of its middle
    double right[3], down[3];
} environment_face;

#define ENVIRONMENT_FACE_COUNT 6

/// The six faces in the order +X -X +Y -Y +Z -Z; NULL for latitude and longitude.
const environment_face *scenes_environment_faces(lobe_environment_layout layout);

/// The number of columns and rows of equal regions into which the layout divides the image: faces,
/// or one region.
void scenes_environment_grid(lobe_environment_layout layout, uint32_t grid[2]);

/// Whether an image of this extent can have the layout: whole square faces of at least one texel.
bool scenes_environment_layout_fits(lobe_environment_layout layout, uint32_t width,
                                    uint32_t height);

/// The position of a direction of any length but 0, on an image that fits the layout. A direction
/// on an edge lies on one of the faces that meet there.
void scenes_environment_position(lobe_environment_layout layout, uint32_t width, uint32_t height,
                                 const double direction[3], double position[2]);

/// The unit direction of a position; false for the empty parts of a cross and outside the image.
bool scenes_environment_direction(lobe_environment_layout layout, uint32_t width, uint32_t height,
                                  const double position[2], double direction[3]);

/// The solid angle, in steradians, of the rectangle from (left, top) to (right, bottom), which lies
/// within one face (or anywhere in latitude and longitude); 0 in the empty parts of a cross.
double scenes_environment_solid_angle(lobe_environment_layout layout, uint32_t width,
                                      uint32_t height, double left, double top, double right,
                                      double bottom);

#endif
