#ifndef INTERFACE_ENVIRONMENT_H
#define INTERFACE_ENVIRONMENT_H

#include "../types.h"

// Push constants of the passes that prepare an environment.

// Where a face of the cube lies on the image: the position, in texels, of the face's point (x, y),
// each in [-1, 1], is origin + x * right + y * down.
struct environment_face_place {
    float4 right_down; // right, down
    float4 origin;     // x, y, 0, 0
};
INTERFACE_SIZE(environment_face_place, 32)

// Of a texel of an environment's image, along each axis, at least.
#define ENVIRONMENT_SUBSAMPLES 4

// Invocations that sum the points of a texel at a pole.
#define ENVIRONMENT_POLAR_GROUP_SIZE 256

// environment_cube and environment_poles. Six places of faces follow in a buffer; latitude and
// longitude need none.
struct environment_cube_constants {
    uint size;               // texels along a face of the cube
    uint latitude_longitude; // 0: the image is made of faces
    uint face_texels;        // texels along a face of the image, or rows from pole to pole
    uint subsamples;         // along each axis of a texel of the cube, at the middle of a face
    uint nearest;            // 1: texels of the image are not interpolated
    uint polar_width;        // texels along either square that environment_poles makes; 0: none
};
INTERFACE_SIZE(environment_cube_constants, 24)

// environment_prefiltering.
struct environment_prefiltering_constants {
    uint width;        // texels along a face of the level to fill
    uint source_width; // texels along a face of what is filtered
    uint first_face;
    // The lobe that the result should represent: over the radiance, after linear interpolation.
    float concentration;
    float source_variance; // of the filter that the source already went through
    float interpolation;   // 1: the result is read with interpolation; 0: without
};
INTERFACE_SIZE(environment_prefiltering_constants, 24)

// environment_mixture: weights of lobes whose concentrations are 4 (sharpest), 2 (between) and 1
// (lobes) times that of each level, from the level to fill on.
#define ENVIRONMENT_LEVELS 12 // of cubes at most 2048 wide
struct environment_mixture_constants {
    uint width;  // texels along a face of the level to fill
    uint levels; // from this one to the last
    uint first_face;
    float sharpest;
    float between[ENVIRONMENT_LEVELS];
    float lobes[ENVIRONMENT_LEVELS];
};
INTERFACE_SIZE(environment_mixture_constants, 112)

#endif
