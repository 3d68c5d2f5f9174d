#ifndef PASSES_ENVIRONMENT_HEMISPHERES_MEANS_H
#define PASSES_ENVIRONMENT_HEMISPHERES_MEANS_H

#include <stdbool.h>

#include <lobe/graph.h>

/// An environment cube: `levels` of six square layers, faces in Vulkan's order and orientation,
/// linear radiance. Every level holds means over solid angle of the one above, or radiance filtered
/// with von Mises-Fisher lobes of lobe_environment_level_concentration().
typedef struct irradiance_source {
    lobe_resource cube;
    uint32_t size; ///< texels along a face's edge at level 0, above 0
    uint32_t levels;
    bool filtered;
} irradiance_source;

/// The first level whose faces are at most `width` texels wide; the last one if there is none.
uint32_t passes_irradiance_source_level(const irradiance_source *source, uint32_t width);

/// A level of a cube that holds mean radiances of texels of 3 degrees, or wider ones.
typedef struct environment_means {
    lobe_resource cube;
    uint32_t level;
    uint32_t size; ///< texels along a face's edge of that level, at most ENVIRONMENT_MEANS_SIZE
} environment_means;

#define ENVIRONMENT_MEANS_SIZE 32

/// Finds such a level, or adds passes that make one of a filtered cube: its own coarse levels are
/// blurred by lobes wider than their texels. Call it once in a graph.
environment_means passes_environment_means(lobe_graph *graph, const irradiance_source *source);

/// How shaders sample maps of what hemispheres have, by normal (lib/light/octahedron.glsl):
/// linearly; their border makes that continuous across all edges.
extern const lobe_sampler passes_hemispheres_sampler;

#endif
