#ifndef PASSES_OCEAN_SEA_H
#define PASSES_OCEAN_SEA_H

#include <lobe/ocean.h>

/// m/s2
#define SEA_GRAVITY 9.81
/// rad/m: waves of least speed, between those of gravity and of surface tension.
#define SEA_CAPILLARY_NUMBER 370.0
/// Waves of a direction: none travel against the wind.
#define SEA_SPREAD_WIDTH 1.5707963267948966

/// What follows from the wind. All lengths of waves below are numbers k, rad/m.
typedef struct sea {
    lobe_ocean_spectrum spectrum;
    lobe_ocean_spreading spreading;
    double wind;      ///< m/s; 0: calm
    double direction; ///< radians
    double age;       ///< inverse: of the wind's speed over that of the peak's waves, [0.84, 5]
    double friction;  ///< velocity, m/s
    double peak;      ///< rad/m
    double peak_speed;
    double jonswap_peak;  ///< rad/s
    double jonswap_scale; ///< Phillips' "constant"
} sea;

sea passes_sea(const lobe_ocean_parameters *parameters);

/// rad/s, of k >= 0: gravity and surface tension, in deep water.
double passes_sea_frequency(double k);
/// S(k), m3, for k >= 0.
double passes_sea_elevation(const sea *sea, double k);
/// The density of directions at an angle from the wind's, per radian; its integral over the circle
/// is 1. Where it is symmetric, what would travel against the wind travels with it: waves of both
/// ways would stand still.
double passes_sea_spread(const sea *sea, double k, double angle);
/// The density of variance over the plane of wave vectors, m4: S(k) spread(k, angle)/k.
double passes_sea_density(const sea *sea, double kx, double ky);
/// The mean of cos^2 of the angle from the wind.
double passes_sea_alignment(const sea *sea, double k);
/// Variance of slopes of the waves of k in [from, to) along the wind and across it; `to` may be
/// INFINITY.
void passes_sea_slopes(const sea *sea, double from, double to, double along_across[2]);
/// Turns variances along the wind and across it into the covariance (xx, yy, xy).
void passes_sea_covariance(const sea *sea, const double along_across[2], double covariance[3]);

#endif
