#ifndef PASSES_ENVIRONMENT_MAPS_H
#define PASSES_ENVIRONMENT_MAPS_H

#include <lobe/environment.h>
#include <lobe/environment_maps.h>
#include <lobe/graph.h>

#include "passes/environment/kept/restoring.h"

/// What the names of all retained maps of an environment begin with.
#define ENVIRONMENT_MAP_PREFIX "environment "

/// What to make of an environment.
typedef struct environment_maps_request {
    const lobe_environment *environment; ///< only its layout and the image's extent are looked at
    const lobe_texture *texture;         ///< holds its image
    uint32_t size; ///< texels along a face of the radiance: a power of two in [16, 2048]
    bool wanted[LOBE_ENVIRONMENT_MAP_COUNT]; ///< the radiance is always made
    /// Filtered cubes that were made before, for each that is wanted; NULL: they are made.
    const stored_cube *stored;
    /// Parts of the work on filtered cubes to add in this frame at most; 0: all.
    uint32_t parts;
} environment_maps_request;

/// What is remembered from frame to frame; all zero: nothing was made yet.
typedef struct environment_maps_progress {
    uint32_t size; ///< of the last frame
    uint32_t set;  ///< 0 or 1: filtered cubes are made in turn under two names
    uint32_t done; ///< parts of the current set so far
    bool former[LOBE_ENVIRONMENT_MAP_COUNT]; ///< the other set still has this cube, of before
} environment_maps_progress;

/// Cubes of this frame, to be sampled with linear interpolation; none (version 0): not wanted, or
/// not finished.
typedef struct environment_maps {
    lobe_resource cubes[LOBE_ENVIRONMENT_MAP_COUNT];
    uint32_t width[LOBE_ENVIRONMENT_MAP_COUNT], levels[LOBE_ENVIRONMENT_MAP_COUNT];
    bool complete;   ///< all that is wanted can be used, be it of the environment before
    bool up_to_date; ///< and is of this environment
    uint32_t parts_done, part_count;
} environment_maps;

/// Declares the maps and adds the passes that make them. All is retained: passes run only where the
/// texture or the request changed. Call it once in every frame that uses the maps.
environment_maps passes_environment_maps_declare(lobe_graph *graph,
                                                 const environment_maps_request *request,
                                                 environment_maps_progress *progress);

/// The texture has, or soon gets, another content: filtered cubes are made anew from the next frame
/// on, part by part, and the former ones are used until then.
void passes_environment_maps_renew(const environment_maps *last,
                                   environment_maps_progress *progress);

/// Begins a frame of the graph that holds the maps of a tool, for passes that read them.
lobe_graph *passes_environment_maps_begin(lobe_environment_maps *maps, environment_maps *cubes);

#endif
