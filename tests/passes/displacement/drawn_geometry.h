#ifndef TESTS_PASSES_DISPLACEMENT_DRAWN_GEOMETRY_H
#define TESTS_PASSES_DISPLACEMENT_DRAWN_GEOMETRY_H

#include <lobe/scene.h>

#include "shaders/interface/displacement/displacement.h"
#include "tests/passes/support/fixture.h"

/// Scenes with height maps, and the displaced triangles of them that are drawn.

/// Heights in [0, 1], each texel's of its own.
lobe_image random_heights(uint32_t width, uint32_t height);
/// Random waves that repeat, with heights from 0 to 1: slopes are nearly Gaussian. `*scale`: the
/// height_scale with which the root of their mean square is `slope` in each direction. Waves are at
/// least 6 texels long if the map has 256 a side.
lobe_image gaussian_heights(uint32_t texels, double slope, uint64_t seed, float *scale);
/// Adds the map, whose texels become the scene's.
lobe_material material_with_heights(lobe_scene *scene, lobe_image heights, float scale);
/// Adds an instance; the mesh becomes the scene's. `transform` may be NULL.
void add_instance_of(lobe_scene *scene, lobe_mesh *mesh, const lobe_material *material,
                     const float transform[16]);
/// A plane of `quads` x `quads` of one metre around the origin, with `tiles` of texture coordinates
/// on each, seen from above by an orthographic camera that sees `seen` metres.
lobe_scene *plane_with_heights(uint32_t quads, float tiles, lobe_image heights, float scale,
                               double seen);

typedef struct drawn_geometry {
    lobe_scene_vertex *vertices;
    uint32_t *indices;
    uint32_t words[PATCH_WORDS]; ///< arguments
    uint32_t vertex_count, triangle_count;
} drawn_geometry;

/// The geometry of the first instance, made as a frame of `extent` x `extent` pixels makes it.
/// `spacing`: an assignment of a knob.
drawn_geometry displaced_geometry_of(fixture *f, const lobe_scene *scene, uint32_t extent,
                                     const char *spacing);
void drawn_geometry_free(drawn_geometry *g);

#endif
