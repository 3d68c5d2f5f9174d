#ifndef INTERFACE_PICTURE_SURFACES_H
#define INTERFACE_PICTURE_SURFACES_H

#include "../types.h"

// Layers of the picture of the surfaces that are seen (shading/surfaces/), four numbers a pixel.
#define SURFACES_POSITION    0 // in the world; `whose`, below
#define SURFACES_NORMAL      1 // interpolated; depth, as drawn
#define SURFACES_TANGENT     2 // interpolated; xy of the curvature's covariance
#define SURFACES_COORDINATES 3 // the first set; xx and yy of the curvature's covariance
#define SURFACES_GRADIENTS   4 // how these coordinates change to the right, and down
#define SURFACES_RIGHT       5 // how the position changes to the right; width of the height map
#define SURFACES_DOWN        6 // how it changes down; spacing of displaced vertices
#define SURFACES_COLOUR      7 // of the vertices
#define SURFACES_LAYERS      8

// Layers that every picture has; with the plane of the triangles; all are there with colours.
#define SURFACES_LEAST_LAYERS 5
#define SURFACES_PLANE_LAYERS 7

// `whose` is the number of the batch, times 4, plus these. Numbers count from 1; 0: nobody's.
#define SURFACES_FRONT  1      // the front of a triangle
#define SURFACES_LEFT   2      // the frame of the tangent is left-handed
#define SURFACES_HIDDEN (-1.0) // in place of all that: not to be drawn

// Numbers of batches as depths, which are exact.
#define SURFACES_DEPTH_OF_NUMBER (1.0 / 4194304.0)

// The pixels in which a batch is seen lie in this rectangle; all zero: it is not seen. Storage
// buffer, by the batch's number, written by shading/surfaces/surface_rectangles.comp.
struct surface_rectangle {
    uint right; // where it ends, exclusive
    uint bottom;
    uint from_right;  // where it begins, counted from the ends of the picture, so that all four
    uint from_bottom; // numbers are the largest of any pixel's
};
INTERFACE_SIZE(surface_rectangle, 16)
INTERFACE_OFFSET(surface_rectangle, bottom, 4)
INTERFACE_OFFSET(surface_rectangle, from_right, 8)
INTERFACE_OFFSET(surface_rectangle, from_bottom, 12)

// Pixels of a row that an invocation of surface_rectangles.comp takes.
#define SURFACE_RUN 32

#endif
