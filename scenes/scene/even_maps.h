#ifndef SCENES_EVEN_MAPS_H
#define SCENES_EVEN_MAPS_H

#include <lobe/host.h>
#include <lobe/scene.h>

/// Of microfacet materials, turns maps that have the same value in all texels into factors: such a
/// map costs each pixel as much as any other, and its filters as much memory. Flat normal maps, and
/// occlusion maps that occlude nothing, are taken away. One notice says how many maps went.
///
/// Left alone: materials that the rig moves, as poses write factors; heights, and flat normals
/// above them, which would give way to the heights' own; occlusion; normals that all lean.
///
/// Images with one value keep a single texel of it, unless they are heights.
/// Errors: LOBE_ERROR_OUT_OF_MEMORY.
lobe_result scenes_fold_even_maps(lobe_scene *scene, const lobe_host *host);

#endif
