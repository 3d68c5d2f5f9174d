#ifndef TESTS_PASSES_MAPS_COLOURS_COLOUR_SCENE_H
#define TESTS_PASSES_MAPS_COLOURS_COLOUR_SCENE_H

#include <lobe/scene.h>

/// A square with random normals and colours that go with them, or not.

enum { COLOUR_SCENE_NORMALS = 0, COLOUR_SCENE_COLOURS = 1, COLOUR_SCENE_IMAGES = 2 };

/// How colours go with normals: by how much, in what part of the map, and what a mask keeps.
typedef struct colour_way {
    const char *name;
    uint32_t width, height;
    double follow;   ///< how much of red is the normal's x, and of blue its negative
    double part;     ///< of the map's width in which it is
    double least_x;  ///< of the normals that the mask keeps; -1: all
    double metallic; ///< metal has no diffuse colour
    double alpha;    ///< factor of the map's; 0: 1
} colour_way;

/// Colours that clearly do not follow, and that do.
extern const colour_way colours_of_no_normals, colours_of_normals;

/// The x and y of a texel's normal.
void colour_scene_normal(const lobe_image *normals, size_t texel, double normal[2]);
/// Whether the mask keeps a texel.
bool colour_scene_keeps(const colour_way *way, const lobe_image *colours, size_t texel);

lobe_scene *colour_scene(const colour_way *way);
/// Gives the scene the colours of another way of the same size.
void colour_scene_recolour(lobe_scene *scene, const colour_way *way);

#endif
