#ifndef SCENES_ENVIRONMENT_DAYLIGHT_H
#define SCENES_ENVIRONMENT_DAYLIGHT_H

#include "scenes/mesh/vector.h"

/// A clear sky and the sun in it: Preetham, Shirley, Smits 1999, "A Practical Analytic Model for
/// Daylight". Light is linear RGB of Rec. 709 (white point D65); its luminance is in kcd/m2, its
/// illuminance in klx.

typedef struct daylight {
    vector3 sun;               ///< direction to the sun, unit length
    double distribution[3][5]; ///< of luminance Y and chromaticities x, y
    double zenith[3];          ///< the same, straight up, divided by the distribution there
    double sun_irradiance[3];  ///< on a surface that faces the sun
} daylight;

/// `sun` has unit length and is above the horizon (its y is above 0). Turbidity [2, 10] measures
/// haze: 2 is very clear, 6 hazy.
daylight scenes_daylight_of(vector3 sun, double turbidity);

/// The radiance of the sky, without the sun's disc, in a direction of unit length; below the
/// horizon, the radiance at the horizon.
void scenes_daylight_sky(const daylight *light, vector3 direction, double rgb[3]);

/// The irradiance of sky and sun on the ground.
void scenes_daylight_ground_irradiance(const daylight *light, double rgb[3]);

/// Luminance of linear RGB.
double scenes_daylight_luminance(const double rgb[3]);

#endif
