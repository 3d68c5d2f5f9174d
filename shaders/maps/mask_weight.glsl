#ifndef MASK_WEIGHT_GLSL
#define MASK_WEIGHT_GLSL

#include "interface/specialisation.h"

// Under a mask that lies on the surface as the lobes do, maps are means over what it keeps: what it
// cuts away, as the flat ground between the wires of a fence, is not seen. Sums and how much was
// summed are filtered, and divided after that.
layout(constant_id = SPECIALISE_MASKED_LOBES) const bool MASKED_LOBES = false;

// How much a point counts that is cut away: next to nothing, but where nothing is kept there are
// normals, too. The smallest number that half floats have with all their digits.
const float WEIGHT_OF_CUT = 1.0 / 16384.0;

// Whether a mask cuts away where the base colour map has this alpha. `factor`, `cutoff`: of the
// mask, as in lobe_grid_constants.
bool is_cut(float alpha, float factor, float cutoff) {
    return MASKED_LOBES && alpha * factor < cutoff;
}

float weight_of_alpha(float alpha, float factor, float cutoff) {
    return is_cut(alpha, factor, cutoff) ? WEIGHT_OF_CUT : 1.0;
}

#endif
