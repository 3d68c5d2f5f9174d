#ifndef TESTS_REFERENCE_LOBE_DISPERSION_H
#define TESTS_REFERENCE_LOBE_DISPERSION_H

/// When to separate lobes, in double precision; see shaders/lib/lobe/dispersion.glsl.

/// (mean |r_i| - |r_M|) / (1 - mean |r_i|), from mean (1 - |r_i|) and 1 - |r_M|.
double reference_dispersion(double mean_complement, double resultant_complement);

/// 0 to 1 across threshold -+ half_width.
double reference_transition(double measure, double threshold, double half_width);

#endif
