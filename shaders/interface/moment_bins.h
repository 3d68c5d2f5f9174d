#ifndef INTERFACE_MOMENT_BINS_H
#define INTERFACE_MOMENT_BINS_H

#include "specialisation.h"
#include "types.h"

// Layers of a map of lobe moments in the Lambert plane, and how lobes are assigned to bins (see
// shaders/filters/moments/binning.comp).
//
// With p the lobe's place in the plane, g = 1 / sqrt(v) its sharpness, v its variance and m its
// mass, all in units in which they are within [-1, 1] (moment_bin), bin b has
// [b layers + 0]  sums of m, l p_x, l p_y, l g. Of `moments`, where bins have colours, l is m times
//                 what the lobe mirrors (filters/moments/mirrored.glsl); otherwise l is m
// [b layers + 1]  sums of l p_x p_x, l p_y p_y, l p_x p_y, l v
// [b layers + 2]  where bins have colours: sum of m times the specular colour. Of microfacets the
//                 colour that the base colour gives to metal, and in alpha m times what is not
//                 metal, because the mesh's colours tint the base colour alone
// [last]          where bins have colours: mean of the diffuse colour; of microfacets times 1 - F0.
//                 There, and under a mask, in alpha how much the texels count (maps/base_maps.glsl)
#define MOMENT_MAXIMUM_BINS 6

#define SPECIALISE_BINS       (SPECIALISE_FILTER + 20) // uint, [1, MOMENT_MAXIMUM_BINS]
#define SPECIALISE_PARTITION  (SPECIALISE_FILTER + 21) // uint, PARTITION_...
#define SPECIALISE_BIN_COLOUR (SPECIALISE_FILTER + 22) // bool: bins have colours
#define SPECIALISE_BIN_WIDTHS (SPECIALISE_FILTER + 23) // bool: base lobes differ in width
// bool: texels of colour maps may exceed one
#define SPECIALISE_BRIGHT_TEXELS (SPECIALISE_FILTER + 24)
#define SPECIALISE_SINGLE_TEXELS (SPECIALISE_FILTER + 29) // uint, SINGLE_TEXELS_...
// bool: in bins with colours, lobes count by what they mirror (of `moments`)
#define SPECIALISE_MIRRORED_BINS (SPECIALISE_FILTER + 41)

// Which texels' bins are evaluated one by one, not blended with those of texels around.
#define SINGLE_TEXELS_NEVER  0
#define SINGLE_TEXELS_UNLIKE 1 // where the map `likeness_map` is not 0
#define SINGLE_TEXELS_ALWAYS 2

// Numbers of the filter's knobs (see knobs.h).
struct moments_knobs {
    float least_share; // bins with less of the footprint are skipped
    float padding_0;
    float padding_1;
    float padding_2;
};
INTERFACE_SIZE(moments_knobs, 16)

#define PARTITION_FITTED 0
#define PARTITION_HATS   1
#define PARTITION_CAP    2

// One bin. If the partition is fitted, its membership is exp(offset - quadratic - trace v) over the
// sum of all bins', for a lobe of variance v at the place q, with d = q - centre and
// quadratic = xx d_x d_x + yy d_y d_y + 2 xy d_x d_y.
struct moment_bin {
    float4 centre; // x, y; z: offset; w: trace
    float4 shape;  // xx, yy, xy; w: largest variance
    float4 range;  // x, y: origin of the places; z: their largest distance; w: largest sharpness
};
INTERFACE_SIZE(moment_bin, 48)
INTERFACE_OFFSET(moment_bin, shape, 16)
INTERFACE_OFFSET(moment_bin, range, 32)
#ifndef VULKAN
typedef struct moment_bin moment_bin;
#endif

// Uniform block of moment_binning and of the filter (std140), and what moment_refit writes. Not
// specialisation constants, because each material and each change of one would then need its own
// pipelines.
struct moment_binning_constants {
    // Partitions by hats: x, y: the middle; z: 1 / width of a hat; w: variance from which a lobe
    // is rough.
    float4 hats;
    // x: mass of a texel's lobes; y: texel of the maps of the bins' colours, which times the
    // material's largest_colour is their unit; z: the part [0, 1) of each lobe that is still shared
    // as by the old bins.
    float4 largest;
    // Those that lobes are assigned to; then the old ones, without range.
    moment_bin bins[2 * MOMENT_MAXIMUM_BINS];
};
INTERFACE_SIZE(moment_binning_constants, 608)
INTERFACE_OFFSET(moment_binning_constants, hats, 0)
INTERFACE_OFFSET(moment_binning_constants, largest, 16)
INTERFACE_OFFSET(moment_binning_constants, bins, 32)

#endif
