#ifndef TOOLS_ANIMATION_TERRAIN_MAPS_H
#define TOOLS_ANIMATION_TERRAIN_MAPS_H

#include <lobe/graph.h>
#include <lobe/scene.h>

/// The maps of the scene "terrain", which are made on the device and do not change with time.
typedef struct terrain_maps {
    uint32_t heights, normals; ///< images of the scene
    uint32_t texels;           ///< along each side
} terrain_maps;

/// False, if the scene has none.
bool terrain_maps_find(const lobe_scene *scene, terrain_maps *maps);

/// Adds the passes that make them, which run in the first frame. `images`: as lobe_given_content
/// has them.
void terrain_maps_give(const terrain_maps *maps, lobe_graph *graph, lobe_resource *images);

#endif
