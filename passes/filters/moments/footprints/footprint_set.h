#ifndef PASSES_FILTERS_MOMENTS_FOOTPRINTS_FOOTPRINT_SET_H
#define PASSES_FILTERS_MOMENTS_FOOTPRINTS_FOOTPRINT_SET_H

#include "passes/filters/moments/footprints/footprint.h"
#include "passes/upload/device_scene.h"

/// Footprints that stand for all that pictures may show of a material: squares of its maps, of
/// widths from a few texels, as seen from near, to a hundred; and all of the maps, from afar.

enum { FOOTPRINT_SQUARES = 12, FOOTPRINTS = FOOTPRINT_SQUARES + 1 };

typedef struct footprint_set {
    footprint all[FOOTPRINTS];
    /// That squared errors are divided by.
    double units[FOOTPRINT_LIGHTS][FOOTPRINTS];
    plane_sample lobes[];
} footprint_set;

/// What passes that build maps read of the squares: the lobes at the points of texels.
typedef struct footprint_lobes {
    const plane_sample *lobes[FOOTPRINT_SQUARES];
    uint32_t counts[FOOTPRINT_SQUARES];
    plane_sample all[];
} footprint_lobes;

/// `survey`: of the same maps, with samples. The caller releases the set; NULL: out of memory.
footprint_set *passes_footprint_set_read(const device_scene *scene, const device_material *material,
                                         const lobe_survey *survey,
                                         const lobe_allocator *allocator);

/// Of a material whose maps are interpolated. The caller releases it; NULL: out of memory.
footprint_lobes *passes_footprint_lobes_read(const device_scene *scene,
                                             const device_material *material,
                                             const lobe_allocator *allocator);

/// Squared errors of the bins that a mixture makes of the footprints, by light, each relative to
/// its footprint: the mean over all of them. (If errors were summed before they are relative, those
/// of polished squares, where all lobes are sharp and no bins are good, would outweigh all others.)
/// Returns the number of lights.
/// `lobes`: what the bins are made of, or NULL for all of the footprints'.
uint32_t passes_footprint_set_compare(const footprint_set *set, const footprint_lobes *lobes,
                                      const plane_mixture *mixture,
                                      footprint_error errors[FOOTPRINT_LIGHTS]);

#endif
