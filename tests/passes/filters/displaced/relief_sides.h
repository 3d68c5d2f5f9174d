#ifndef TESTS_PASSES_FILTERS_DISPLACED_RELIEF_SIDES_H
#define TESTS_PASSES_FILTERS_DISPLACED_RELIEF_SIDES_H

#include "tests/passes/filters/displaced/relief_plane.h"

/// A plane of a relief that is held by the renderer, from several sides.

/// Degrees above the carrier, and around its normal.
typedef struct relief_side {
    double height, azimuth;
} relief_side;

/// The plane of a material with heights `map` in widths of a texel (moved into the scene), `tiles`
/// times along the picture, under one sun, or under a white sky.
lobe_scene *relief_sides_plane(const lobe_material *material, lobe_image map, double tiles,
                               bool sky);

/// Of a scene's viewer.
void relief_sides_look(lobe_scene *scene, relief_side viewer);
/// Of its sun.
void relief_sides_shine(lobe_scene *scene, relief_side sun);

/// The mean of the green of a picture, 8 x 8 pixels of so many samples, and how far it is likely to
/// be off (the standard error).
typedef struct relief_mean {
    double value, noise;
} relief_mean;

relief_mean relief_sides_draw(fixture *f, const lobe_scene *scene, const char *filter,
                              uint32_t samples);

#endif
