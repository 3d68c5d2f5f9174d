#ifndef PASSES_UPLOAD_COLOURS_MASK_ALPHA_H
#define PASSES_UPLOAD_COLOURS_MASK_ALPHA_H

#include "passes/upload/device_scene.h"

/// Whether the material has a mask that may cut something away. Many files ask for masks whose maps
/// keep all: these cost nothing, and are filtered as if there were none. What the host cannot read,
/// and what a rig moves, may cut. Reads texels that have not been read.
bool passes_mask_may_cut(device_scene *scene, const device_material *material);

/// The factor of a map's alpha that a mask compares with its cutoff: that of the base colour, times
/// that of vertices. Where these differ it is the largest, with which most is kept.
float passes_mask_alpha(const device_scene *scene, const device_material *material);

/// Thresholds of a map's own alpha, as vertices' factors make them of the cutoff, without those
/// that nothing meets. Equal: there is one alone.
typedef struct mask_range {
    float least; ///< with passes_mask_alpha
    float largest;
} mask_range;

mask_range passes_mask_range(const device_scene *scene, const device_material *material);

#endif
