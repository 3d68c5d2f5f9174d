#ifndef INTERFACE_MATERIAL_H
#define INTERFACE_MATERIAL_H

#include "types.h"

#define MATERIAL_MAXIMUM_LOBES 4

// A material's maps.
#define MAP_BASE_COLOUR 0
#define MAP_NORMAL      1
#define MAP_WIDTH       2 // metallic-roughness, or the width of half-vector lobes
#define MAP_SPECULAR    3
#define MAP_EMISSIVE    4
#define MAP_OCCLUSION   5 // used with light from an environment
#define MAP_HEIGHT      6 // read by passes only, not by every shading
#define MAP_COUNT       7
#define MAP_SHADING     6 // the first of them: every shading binds these

// Layers of the map of where microfacets are metal (maps/metal_means.comp): with c the texel of the
// base colour map, or one with METAL_MEANS_ALONE, m that of metal's share, and s how much the texel
// counts, which is less than one only under a mask,
#define METAL_LAYER_METAL  0 // E[s c m], E[s m^2]; with METAL_MEANS_ALONE E[s m], E[s], 0, E[s m^2]
#define METAL_LAYER_COLOUR 1 // E[c], E[m], or under a mask E[s m], E[s], 0, 0; not with ..._ALONE

// Layers of the map of widths that lie apart from normals (maps/width_means.comp): with v and m a
// texel's variance and mass in the Lambert plane, c, kappa and alpha its 1 - |r|, concentration and
// alpha, and s how much it mirrors,
#define WIDTH_LAYER_LOBES       0 // E[s m / sqrt(v)], E[s m v], E[s c], E[s m]
#define WIDTH_LAYER_MICROFACETS 1 // E[s kappa], E[s alpha], E[s alpha^2], E[s]
#define WIDTH_LAYERS            2

// Layers of the map of how diffuse colours go with normals (maps/colour_normals.comp): with d the
// diffuse colour and n the normal of a point, and s how much it counts (maps/base_maps.glsl),
// layers 0 to 2 have E[s d_k n], E[s d_k] of a channel.
#define COLOUR_NORMALS_MEAN   3 // the layer of E[s n], E[s]
#define COLOUR_NORMALS_LAYERS 4

// A material's constants (uniform block, std140). Which parts are read depends on the
// specialisation of the shader.
struct material_constants {
    float4 base_colour; // linear RGB, alpha
    float4 emissive;    // linear RGB, w: alpha cutoff
    float metallic;
    float roughness;
    float normal_scale;
    float normal_concentration;                    // kappa_N, 0: none
    float4 lobe_direction[MATERIAL_MAXIMUM_LOBES]; // in the frame of the normal; w: width
    float4 lobe_colour[MATERIAL_MAXIMUM_LOBES];    // linear RGB; w: share of the sum's luminance
    float occlusion_strength;                      // of MAP_OCCLUSION, [0, 1]
    // At least 1: of the base colour, and of the lobes' colours over their shares.
    float largest_colour;
    float width_factor; // of what maps of lobes hold where widths lie apart, see WIDTH_LAYER_...
    float padding_0;
    // Where each map is read: two rows (u, v) of an affine transform of the texture coordinates.
    float4 transforms[2 * MAP_COUNT];
};
INTERFACE_SIZE(material_constants, 416)
INTERFACE_OFFSET(material_constants, emissive, 16)
INTERFACE_OFFSET(material_constants, metallic, 32)
INTERFACE_OFFSET(material_constants, roughness, 36)
INTERFACE_OFFSET(material_constants, normal_scale, 40)
INTERFACE_OFFSET(material_constants, normal_concentration, 44)
INTERFACE_OFFSET(material_constants, lobe_direction, 48)
INTERFACE_OFFSET(material_constants, lobe_colour, 112)
INTERFACE_OFFSET(material_constants, occlusion_strength, 176)
INTERFACE_OFFSET(material_constants, largest_colour, 180)
INTERFACE_OFFSET(material_constants, width_factor, 184)
INTERFACE_OFFSET(material_constants, transforms, 192)

#endif
