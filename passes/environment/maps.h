#ifndef PASSES_ENVIRONMENT_MAPS_H
#define PASSES_ENVIRONMENT_MAPS_H

#include <lobe/environment.h>
#include <lobe/environment_maps.h>
#include <lobe/graph.h>

#include "passes/environment/cache/restoring.h"

/// The names of all retained maps of an environment begin with this.
#define ENVIRONMENT_MAP_PREFIX "environment "

/// Which maps of an environment to make.
typedef struct environment_maps_request {
    const lobe_environment *environment; ///< only its layout and its image's extent are read
    const lobe_texture *texture;         ///< the image on the device
    uint32_t size; ///< texels along a face of the radiance: a power of two in [16, 2048]
    bool wanted[LOBE_ENVIRONMENT_MAP_COUNT]; ///< the radiance is always made
    /// Filtered cubes from the cache, by lobe_environment_map; NULL: they are made.
    const cube_textures *cached;
    /// Maximum number of parts of the work on filtered cubes in this frame; 0: all.
    uint32_t parts;
} environment_maps_request;

/// What is kept between frames; all zero: nothing was made yet.
typedef struct environment_maps_progress {
    uint32_t size; ///< of the last frame
    uint32_t set;  ///< 0 or 1: filtered cubes alternate between two sets of images
    uint32_t done; ///< parts of the current set that are done
    bool former[LOBE_ENVIRONMENT_MAP_COUNT]; ///< the other set holds this cube of the last
                                             ///< environment
} environment_maps_progress;

/// The cubes of a frame, to be sampled with linear interpolation. A cube that is not wanted or not
/// finished has version 0.
typedef struct environment_maps {
    lobe_resource cubes[LOBE_ENVIRONMENT_MAP_COUNT];
    uint32_t width[LOBE_ENVIRONMENT_MAP_COUNT], levels[LOBE_ENVIRONMENT_MAP_COUNT];
    bool complete;   ///< all wanted cubes exist, perhaps those of the last environment
    bool up_to_date; ///< all wanted cubes are those of this environment
    uint32_t parts_done, part_count;
} environment_maps;

/// Declares the maps and adds the passes that make them. All maps are retained: passes run only if
/// the texture or the request changed. Call it once in every frame that uses the maps.
environment_maps passes_environment_maps_declare(lobe_graph *graph,
                                                 const environment_maps_request *request,
                                                 environment_maps_progress *progress);

/// Parts of the work on filtered cubes that the next frames have to do.
uint32_t passes_environment_maps_parts_left(const environment_maps_request *request,
                                            const environment_maps_progress *progress);

/// Call it when the texture's content changes: from the next frame on, filtered cubes are rebuilt
/// part by part; until they are complete, those of the last environment are used.
void passes_environment_maps_invalidate(const environment_maps *last,
                                        environment_maps_progress *progress);

#endif
