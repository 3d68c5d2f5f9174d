#ifndef SCENES_BUILTIN_BUMP_MAPS_H
#define SCENES_BUILTIN_BUMP_MAPS_H

#include <stdbool.h>
#include <stdint.h>

#include <lobe/host.h>
#include <lobe/result.h>
#include <lobe/scene.h>

/// Maps of hemispherical bumps (Xu et al. 2017, "Real-Time Linear BRDF MIP-Mapping", Fig. 4 bottom
/// and section 5.2): normals, colours, and roughness with metallic, 1024 x 1024 texels each. The
/// bumps lie in a hexagonal packing that tiles, 32 per row, each slightly displaced. Colour and
/// roughness are drawn at random for each bump, independently of one another.

enum { BUMP_KINDS = 4 };

/// What a bump, or the ground between them, is made of.
typedef struct bump_matter {
    uint8_t colour[3]; ///< sRGB
    uint8_t roughness; ///< of the ground; ignored for bumps, whose roughness is random
    bool metallic;
} bump_matter;

typedef struct bump_style {
    uint64_t seed;
    bump_matter ground;
    bump_matter kinds[BUMP_KINDS]; ///< of bumps, equally frequent
} bump_style;

/// Adds the three maps to the scene and makes the material use them.
lobe_result scenes_bump_maps_add(lobe_scene *scene, const bump_style *style, const lobe_host *host,
                                 lobe_material *material);

#endif
