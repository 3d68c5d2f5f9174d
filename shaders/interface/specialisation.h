#ifndef INTERFACE_SPECIALISATION_H
#define INTERFACE_SPECIALISATION_H

// Identifiers of specialisation constants. Whatever the material, the lights or the user's choices
// do not need is compiled out. If a knob feeds a constant, its default in GLSL is that of the knob
// in C.

// The material.
#define SPECIALISE_MODEL                0  // uint, MODEL_...
#define SPECIALISE_DISTRIBUTION         1  // uint, DISTRIBUTION_...
#define SPECIALISE_LOBE_COUNT           2  // uint, half-vector lobes
#define SPECIALISE_MAPS                 3  // uint, bit MAP_...: the material has this map
#define SPECIALISE_SECOND_COORDINATES   4  // uint, bit MAP_...: the map uses the second set
#define SPECIALISE_DIFFUSE              5  // bool, half-vector lobes: there is a Lambert part
#define SPECIALISE_NORMAL_CONCENTRATION 6  // bool, kappa_N is set
#define SPECIALISE_ALPHA_MASK           7  // bool
#define SPECIALISE_EMISSION             8  // bool
#define SPECIALISE_VERTEX_COLOUR        9  // bool
#define SPECIALISE_MIRRORED             10 // bool, the transform mirrors
#define SPECIALISE_METALLIC_MAP         11 // bool, the width map says where a microfacet is metal
// bool: shading sees the normal map interpolated; in passes that build maps, it or the width map
#define SPECIALISE_INTERPOLATED 12
#define SPECIALISE_MASKING      13 // uint, DISTRIBUTION_... whose masking is used
// The lights.
#define SPECIALISE_DIRECTIONAL_LIGHTS 16 // bool
#define SPECIALISE_POINT_LIGHTS       17 // bool
#define SPECIALISE_SPOT_LIGHTS        18 // bool
#define SPECIALISE_LIGHTS_AT_ONCE     19 // uint, [1, 4]: lights that filters process together
// The knobs of all filters.
#define SPECIALISE_VIEW              24 // uint, VIEW_...
#define SPECIALISE_BASE_AS_LOBE      25 // bool: base lobes become von Mises-Fisher lobes
#define SPECIALISE_DEPTH_AS_COVERAGE 26 // bool: alpha is the depth, see sample_choice.comp
#define SPECIALISE_CURVATURE         29 // bool: the knob `curvature` is not 0
// Filtered maps, see shaders/shading/filtered_maps.glsl.
#define SPECIALISE_PROBES         32 // uint, [1, 16]
#define SPECIALISE_ANISOTROPY     33 // uint, [1, 16]
#define SPECIALISE_FILTERED_LOBES 34 // bool: lobes vary, and there is a map of them
#define SPECIALISE_FILTERED_MAPS  35 // uint, bit MAP_...: there is a filtered map
#define SPECIALISE_MAGNIFIED_MAPS 36 // uint, bit MAP_...: some pixel may use level 0 of the map
#define SPECIALISE_LIKE_LOBES     37 // uint, bit MAP_...: same size and coordinates as the lobes'
// The first of the filters' own, which are in their headers; no two of any filters are the same.
#define SPECIALISE_FILTER 40

#define MODEL_MICROFACET        0
#define MODEL_HALF_VECTOR_LOBES 1

#define DISTRIBUTION_GGX         0
#define DISTRIBUTION_BECKMANN    1
#define DISTRIBUTION_BLINN_PHONG 2
#define DISTRIBUTION_VMF         3
#define DISTRIBUTION_COUNT       4

#define VIEW_RADIANCE 0
#define VIEW_LOBES    1
#define VIEW_LEVEL    2
#define VIEW_SAMPLES  3 // as VIEW_RADIANCE until the samples are resolved

#endif
