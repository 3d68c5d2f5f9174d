#ifndef INTERFACE_KNOBS_H
#define INTERFACE_KNOBS_H

#include "types.h"

// The numeric knobs, in uniform blocks (std140): a new value compiles nothing. In C, only the
// knob's entry refers to its member (passes/context/knob.h).
//
// Those that several filters have. A filter without such a knob reads 0.
struct shared_knobs {
    float curvature;  // factor of the macro-surface's curvature; 0: ignored
    float level_bias; // added to the MIP level
    // Part of the way from a MIP level to the next over which both are blended: [0, 1].
    float level_blend;
    float padding_0;
};
INTERFACE_SIZE(shared_knobs, 16)
INTERFACE_OFFSET(shared_knobs, level_bias, 4)
INTERFACE_OFFSET(shared_knobs, level_blend, 8)

// Those of one filter are in a struct in the filter's own header, which its shader declares so:
//   layout(LOBE_DESCRIPTOR(FILTER_KNOB_BINDING), std140) uniform filter_knob_block {
//       lobes_knobs filter_knobs;
//   };
#define FILTER_KNOB_BINDING 11

#endif
