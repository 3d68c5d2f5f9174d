#ifndef INTERFACE_SPECIALISATION_H
#define INTERFACE_SPECIALISATION_H

// Identifiers of specialisation constants. Whatever the material, the lights or the user's choices
// do not need is compiled out. If a knob feeds a constant, its default in GLSL is that of the knob
// in C.

// Hosts that include shading in shaders of their own may add a number to all of them.
#ifndef LOBE_CONSTANT_BASE
#define LOBE_CONSTANT_BASE 0
#endif
#define SPECIALISE(number) (LOBE_CONSTANT_BASE + number)

// The material.
#define SPECIALISE_MODEL                SPECIALISE(0)  // uint, MODEL_...
#define SPECIALISE_DISTRIBUTION         SPECIALISE(1)  // uint, DISTRIBUTION_...
#define SPECIALISE_LOBE_COUNT           SPECIALISE(2)  // uint, half-vector lobes
#define SPECIALISE_MAPS                 SPECIALISE(3)  // uint, bit MAP_...: there is this map
#define SPECIALISE_SECOND_COORDINATES   SPECIALISE(4)  // uint, bit MAP_...: it uses the second set
#define SPECIALISE_DIFFUSE              SPECIALISE(5)  // bool, of half-vector lobes: a Lambert part
#define SPECIALISE_NORMAL_CONCENTRATION SPECIALISE(6)  // bool, kappa_N is set
#define SPECIALISE_ALPHA_MASK           SPECIALISE(7)  // bool
#define SPECIALISE_EMISSION             SPECIALISE(8)  // bool
#define SPECIALISE_VERTEX_COLOUR        SPECIALISE(9)  // bool
#define SPECIALISE_MIRRORED             SPECIALISE(10) // bool, the transform mirrors
#define SPECIALISE_METALLIC_MAP         SPECIALISE(11) // bool, the width map says where it is metal
// bool: shading sees the normal map interpolated; in passes that build maps, it or the width map
#define SPECIALISE_INTERPOLATED SPECIALISE(12)
#define SPECIALISE_MASKING      SPECIALISE(13) // uint, DISTRIBUTION_... whose masking is used
#define SPECIALISE_NORMALS      SPECIALISE(14) // uint, NORMALS_...: how the normal map has them
#define SPECIALISE_DISPLACED    SPECIALISE(15) // bool: the geometry is that of a height map
// The lights.
#define SPECIALISE_DIRECTIONAL_LIGHTS SPECIALISE(16) // bool
#define SPECIALISE_POINT_LIGHTS       SPECIALISE(17) // bool
#define SPECIALISE_SPOT_LIGHTS        SPECIALISE(18) // bool
#define SPECIALISE_LIGHTS_AT_ONCE     SPECIALISE(19) // uint, [1, 4]: lights that filters take together
#define SPECIALISE_SHADOWS            SPECIALISE(31) // bool: there are shadow maps
// The knobs of all filters.
#define SPECIALISE_VIEW              SPECIALISE(24) // uint, VIEW_...
#define SPECIALISE_BASE_AS_LOBE      SPECIALISE(25) // bool: base lobes become von Mises-Fisher lobes
#define SPECIALISE_DEPTH_AS_COVERAGE SPECIALISE(26) // bool: alpha is depth, see sample_choice.comp
#define SPECIALISE_CURVATURE         SPECIALISE(29) // bool: the knob `curvature` is not 0
// bool, of the material and the filter: slopes are those of heights, and follow how the map is
// stretched over the surface
#define SPECIALISE_STRETCHED SPECIALISE(30)
// bool, of the material and the filter: tangents do not follow the height map's coordinates
#define SPECIALISE_HEIGHTS_TURNED SPECIALISE(59)
#define SPECIALISE_DEFERRED       SPECIALISE(58) // bool: surfaces come from a picture of them
// Filtered maps, see shaders/shading/filtered_maps.glsl.
#define SPECIALISE_PROBES         SPECIALISE(32) // uint, [1, 16]
#define SPECIALISE_ANISOTROPY     SPECIALISE(33) // uint, [1, 16]
#define SPECIALISE_FILTERED_LOBES SPECIALISE(34) // bool: lobes vary, and there is a map of them
#define SPECIALISE_FILTERED_MAPS  SPECIALISE(35) // uint, bit MAP_...: there is a filtered map
#define SPECIALISE_MAGNIFIED_MAPS SPECIALISE(36) // uint, bit MAP_...: pixels may use its level 0
// uint, bit MAP_... and, of v, MAP_COUNT + MAP_...: it is clamped, and surfaces leave it
#define SPECIALISE_CLAMPED_MAPS   SPECIALISE(76)
#define SPECIALISE_LIKE_LOBES     SPECIALISE(37) // uint, bit MAP_...: laid out like the lobes' map
#define SPECIALISE_TEXEL_SAMPLES  SPECIALISE(38) // uint, along each axis of a texel; 0: all texels
#define SPECIALISE_WIDTHS_APART   SPECIALISE(75) // bool: widths have a map of their own
#define SPECIALISE_METAL_MEANS    SPECIALISE(53) // uint, METAL_MEANS_...
#define SPECIALISE_COLOUR_SQUARE  SPECIALISE(77) // uint, COLOUR_SQUARE_...
#define SPECIALISE_COLOUR_NORMALS SPECIALISE(54) // bool: diffuse colours may go with normals
#define SPECIALISE_MASKED_LOBES   SPECIALISE(55) // bool: maps of lobes leave out what a mask cuts
#define SPECIALISE_MANY_POINTS    SPECIALISE(56) // bool: texels are read at MANY_TEXEL_POINTS
#define SPECIALISE_MASK_VARIES    SPECIALISE(57) // bool: a mask has several thresholds, and layers
// The first of the filters' own, which are in their headers; no two of any filters are the same.
#define SPECIALISE_FILTER SPECIALISE(40)

#define MODEL_MICROFACET        0
#define MODEL_HALF_VECTOR_LOBES 1

#define DISTRIBUTION_GGX         0
#define DISTRIBUTION_BECKMANN    1
#define DISTRIBUTION_BLINN_PHONG 2
#define DISTRIBUTION_VMF         3
#define DISTRIBUTION_COUNT       4

// See lobe_normal_encoding.
#define NORMALS_UNSIGNED    0
#define NORMALS_SIGNED      1
#define NORMALS_UNSIGNED_XY 2
#define NORMALS_SIGNED_XY   3

// Whether a map of means (maps/metal_means.comp) has a material's colour and metal.
#define METAL_MEANS_NONE     0 // no: metal is the same everywhere, or lies apart from the lobes
#define METAL_MEANS_ALONE    1 // metal: colours are alike everywhere, or lie apart
#define METAL_MEANS_COLOURED 2 // both
#define METAL_MEANS_FINER    3 // both, and colours have more texels than lobes

// Whether passes that build maps read the base colour map in squares of 4 x 4 texels
// (maps/colour_square.glsl), and bits for the axes along which it repeats then.
#define COLOUR_SQUARE_NONE      0
#define COLOUR_SQUARE_CLAMPS    1
#define COLOUR_SQUARE_REPEATS_U 2
#define COLOUR_SQUARE_REPEATS_V 4

#define VIEW_RADIANCE 0
#define VIEW_LOBES    1
#define VIEW_LEVEL    2
#define VIEW_SAMPLES  3 // as VIEW_RADIANCE until the samples are resolved

#endif
