#ifndef INTERFACE_MOMENT_BINS_H
#define INTERFACE_MOMENT_BINS_H

#include "specialisation.h"
#include "types.h"

// Layers of a map of lobe moments in the Lambert plane, and how lobes are assigned to bins (see
// shaders/filters/moments/binning.comp).
//
// With p the lobe's place in the plane, g its sharpness and m its mass, all scaled to [-1, 1] by
// the material's own range (moment_range), bin b has
// [b layers + 0]  sums of m, m p_x, m p_y, m g
// [b layers + 1]  sums of m p_x p_x, m p_y p_y, m p_x p_y
// [b layers + 2]  where bins have colours: sum of m times the specular colour
// [last]          where bins have colours: mean of the diffuse colour
#define MOMENT_MAXIMUM_BINS 6

#define SPECIALISE_BINS       (SPECIALISE_FILTER + 32) // uint, [1, MOMENT_MAXIMUM_BINS]
#define SPECIALISE_PARTITION  (SPECIALISE_FILTER + 33) // uint, PARTITION_...
#define SPECIALISE_BIN_COLOUR (SPECIALISE_FILTER + 34) // bool: bins have colours

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

// One bin of a fitted partition: its membership is exp(offset - quadratic - trace v) over the sum
// of all bins', for a lobe of variance v at the place q, with d = q - centre and
// quadratic = xx d_x d_x + yy d_y d_y + 2 xy d_x d_y.
struct moment_bin {
    float4 centre; // x, y; z: offset; w: trace
    float4 shape;  // xx, yy, xy
};
INTERFACE_SIZE(moment_bin, 32)
INTERFACE_OFFSET(moment_bin, shape, 16)
#ifndef VULKAN
typedef struct moment_bin moment_bin;
#endif

// The ranges that a map's values are relative to. Not specialisation constants, because each
// material and each change of one would then need its own pipelines.
struct moment_range {
    float4 place;   // x, y: middle of the places; z: half the width of their range
    float4 largest; // x: mass of a texel's lobes; y: sharpness; z: colour
};
INTERFACE_SIZE(moment_range, 32)
INTERFACE_OFFSET(moment_range, largest, 16)
#ifndef VULKAN
typedef struct moment_range moment_range;
#endif

// Uniform block of moment_binning and of the filter (std140).
struct moment_binning_constants {
    // Partitions by hats: x, y: the middle; z: 1 / width of a hat; w: variance from which a lobe
    // is rough.
    float4 hats;
    moment_range range;
    moment_bin bins[MOMENT_MAXIMUM_BINS];
};
INTERFACE_SIZE(moment_binning_constants, 240)
INTERFACE_OFFSET(moment_binning_constants, hats, 0)
INTERFACE_OFFSET(moment_binning_constants, range, 16)
INTERFACE_OFFSET(moment_binning_constants, bins, 48)

#endif
