#ifndef INTERFACE_MIXTURE_H
#define INTERFACE_MIXTURE_H

#include "specialisation.h"
#include "types.h"

// Layers of a map of lobe mixtures (see shaders/filters/lobes/clustering.comp).
//
// Of microfacets whose colours may go with their lobes, each texel counts by the luminance of its
// F0 (SPECIALISE_WEIGHTED): the mean colour, which multiplies the mixture, has that of all.
//
// [0]           one lobe for all texels: (sum r, coverage or, weighted, what it mirrors)
// [1 .. 4]      one for each of four sectors, where the subdivision is 1 or more
// [5 .. 12]     one for each half of a sector, where the subdivision is 2
// Then, where needed:
// [MEAN_LAYER]  (mean normal of all texels, mean of 1 - |r| over the base lobes)
// [KEPT_LAYER]  coverage, where the weights that [0] has are of what texels mirror
// [WIDTH_LAYER] where shading takes two widths: sums of u, u^2, u^3 (lib/lobe/width_pair.glsl), and
//               of u over texels, whatever they mirror, where these have colours of their own
// [+ 1]         where the subdivision is 1 or more: sums of 1 - |r| over the base lobes in each
//               sector or, where it is 2, in the first four halves
// [+ 2]         where it is 2: in the other four
// [then]        where the two widths have colours of their own: sums of r, b, r u, b u over texels,
//               r and b the first and last channel of mirrored_colour less its luminance, which the
//               weights have (maps/mirrored_luminance.glsl)
#define MIXTURE_LAYER_ONE     0
#define MIXTURE_LAYER_SECTORS 1
#define MIXTURE_LAYER_HALVES  5

// Of GGX about spread normals, see gaussian_widening in shaders/filters/lobes.glsl.
#define GGX_WIDENING 0.56

#define SPECIALISE_SUBDIVISION (SPECIALISE_FILTER + 0) // uint, [0, 2]: finest level stored
#define SPECIALISE_COARSEST    (SPECIALISE_FILTER + 1) // uint, [0, 1]: coarsest that can suffice
#define SPECIALISE_MEAN_LAYER  (SPECIALISE_FILTER + 2) // uint, layer of the mean; 0: none
#define SPECIALISE_SPACE       (SPECIALISE_FILTER + 3) // uint, SPACE_...
#define SPECIALISE_THRESHOLD   (SPECIALISE_FILTER + 4) // uint, THRESHOLD_...
#define SPECIALISE_CLUSTERS    (SPECIALISE_FILTER + 5) // uint, CLUSTERS_...
// bool: the base lobes' colours differ in brightness only, so that one mixture serves them all
#define SPECIALISE_ONE_HUE       (SPECIALISE_FILTER + 6)
#define SPECIALISE_WEIGHTED      (SPECIALISE_FILTER + 7)  // bool, texels count by what they mirror
#define SPECIALISE_KEPT_LAYER    (SPECIALISE_FILTER + 8)  // uint, layer of the coverage; 0: none
#define SPECIALISE_WIDTH_LAYER   (SPECIALISE_FILTER + 9)  // uint, first layer of widths; 0: none
#define SPECIALISE_WIDTH_COLOURS (SPECIALISE_FILTER + 38) // bool: there is a layer of their colours

// Numbers of the filter's knobs (see knobs.h).
struct lobes_knobs {
    float epsilon0; // below this, one lobe becomes four
    float epsilon1; // below this, each of the four becomes two
    float blend;    // half width of the transition
    float padding;
};
INTERFACE_SIZE(lobes_knobs, 16)
INTERFACE_OFFSET(lobes_knobs, epsilon1, 4)
INTERFACE_OFFSET(lobes_knobs, blend, 8)

#define SPACE_TANGENT 0
#define SPACE_OBJECT  1
#define SPACE_CAMERA  2

#define THRESHOLD_DISPERSION 0
#define THRESHOLD_LENGTH     1

#endif
