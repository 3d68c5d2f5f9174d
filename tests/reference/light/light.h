#ifndef TESTS_REFERENCE_LIGHT_H
#define TESTS_REFERENCE_LIGHT_H

/// Punctual lights in double precision; see shaders/lib/light/light.glsl.

/// `range` in metres, 0: unlimited.
double reference_distance_attenuation(double distance, double range);

/// `cosine` of the angle between where the spot points and the way from it; half angles in radians.
double reference_cone_attenuation(double cosine, double inner_cone, double outer_cone);

#endif
