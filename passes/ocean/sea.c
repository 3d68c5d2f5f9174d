#include "passes/ocean/sea.h"

#include <math.h>

#define PI 3.14159265358979323846
/// Waves shorter than 10 cm belong to no gravity spectrum.
#define GRAVITY_LARGEST (2 * PI / 0.1)
#define CAPILLARY_SPEED 0.23
#define KARMAN          0.40
/// Below, there are no waves.
#define LEAST_WIND 0.5

// ---------------------------------------------------------------------------------------------
// The wind

/// The logarithmic law, with the roughness length of Elfouhaily et al. 1997, Eq. 66.
static double friction_velocity(double wind, double age) {
    const double roughness = 3.7e-5 * wind * wind / SEA_GRAVITY * pow(age, 0.9);
    return wind * KARMAN / log(10 / roughness);
}

/// Elfouhaily et al., Eq. 37.
static double inverse_wave_age(double wind, double fetch) {
    const double relative = SEA_GRAVITY * fetch / (wind * wind * 2.2e4);
    return fmin(0.84 * pow(tanh(pow(relative, 0.4)), -0.75), 5);
}

sea passes_sea(const lobe_ocean_parameters *p) {
    sea s = {.spectrum = p->spectrum, .spreading = p->spreading, .direction = p->wind_direction};
    if (p->wind_speed < LEAST_WIND)
        return s;
    s.wind = p->wind_speed;
    const bool grown = p->spectrum == LOBE_OCEAN_PIERSON_MOSKOWITZ;
    s.age = grown ? 0.84 : inverse_wave_age(s.wind, p->fetch);
    s.friction = friction_velocity(s.wind, s.age);
    s.peak = SEA_GRAVITY * s.age * s.age / (s.wind * s.wind);
    s.peak_speed = s.wind / s.age;
    // Hasselmann et al. 1973, with the fetch and the speed of the wind without dimension.
    const double fetch = SEA_GRAVITY * p->fetch / (s.wind * s.wind);
    s.jonswap_peak = 22 * SEA_GRAVITY / s.wind * pow(fetch, -1.0 / 3);
    s.jonswap_scale = 0.076 * pow(fetch, -0.22);
    return s;
}

double passes_sea_frequency(double k) {
    const double relative = k / SEA_CAPILLARY_NUMBER;
    return sqrt(SEA_GRAVITY * k * (1 + relative * relative));
}

static double speed(double k) {
    return passes_sea_frequency(k) / k;
}

/// d omega / dk.
static double group_speed(double k) {
    const double relative = k / SEA_CAPILLARY_NUMBER;
    return SEA_GRAVITY * (1 + 3 * relative * relative) / (2 * passes_sea_frequency(k));
}

// ---------------------------------------------------------------------------------------------
// Spectra of heights

/// Elfouhaily et al., Eqs. 31 to 34.
static double long_waves(const sea *s, double k) {
    const double width = 0.08 * (1 + 4 * pow(s->age, -3));
    const double root = sqrt(k / s->peak) - 1, ratio = s->peak / k;
    const double shape = exp(-root * root / (2 * width * width));
    const double growth = s->age <= 1 ? 1.7 : 1.7 + 6 * log10(s->age);
    const double cut =
        exp(-1.25 * ratio * ratio) * pow(growth, shape) * exp(-s->age / sqrt(10.0) * root);
    return 0.5 * 6e-3 * sqrt(s->age) * s->peak_speed / speed(k) * cut;
}

/// Eqs. 40 to 44.
static double short_waves(const sea *s, double k) {
    const double ratio = s->friction / CAPILLARY_SPEED;
    const double scale = 0.01 * fmax(1 + (ratio < 1 ? 1 : 3) * log(ratio), 0);
    const double away = k / SEA_CAPILLARY_NUMBER - 1;
    return 0.5 * scale * CAPILLARY_SPEED / speed(k) * exp(-0.25 * away * away);
}

/// Of frequencies, m2 s: Phillips' tail below a peak.
static double tail(double frequency, double scale, double cut) {
    return scale * SEA_GRAVITY * SEA_GRAVITY * pow(frequency, -5) * exp(-cut);
}

static double jonswap(const sea *s, double frequency) {
    const double peak = s->jonswap_peak, width = frequency <= peak ? 0.07 : 0.09;
    const double away = (frequency - peak) / (width * peak);
    return tail(frequency, s->jonswap_scale, 1.25 * pow(peak / frequency, 4)) *
           pow(3.3, exp(-0.5 * away * away));
}

/// The wind was measured 19.5 m above the sea, where it is 1.026 times that at 10 m.
static double pierson_moskowitz(const sea *s, double frequency) {
    const double cut = SEA_GRAVITY / (1.026 * s->wind * frequency);
    return tail(frequency, 8.1e-3, 0.74 * pow(cut, 4));
}

double passes_sea_elevation(const sea *s, double k) {
    if (s->wind == 0 || k <= 0)
        return 0;
    if (s->spectrum == LOBE_OCEAN_ELFOUHAILY)
        return (long_waves(s, k) + short_waves(s, k)) / (k * k * k);
    if (k >= GRAVITY_LARGEST)
        return 0;
    const double frequency = passes_sea_frequency(k);
    return group_speed(k) *
           (s->spectrum == LOBE_OCEAN_JONSWAP ? jonswap : pierson_moskowitz)(s, frequency);
}

// ---------------------------------------------------------------------------------------------
// Directions

/// Elfouhaily et al., Eq. 57: D(k).
static double upwind_contrast(const sea *s, double k) {
    const double own = speed(k);
    return tanh(log(2.0) / 4 + 4 * pow(own / s->peak_speed, 2.5) +
                0.13 * s->friction / CAPILLARY_SPEED * pow(CAPILLARY_SPEED / own, 2.5));
}

/// Hasselmann, Dunckel, Ewing 1980: the s of cos(angle/2)^(2 s).
static double sharpness(const sea *s, double k) {
    const double relative = sqrt(k / s->peak);
    return relative < 1 ? 6.97 * pow(relative, 4.06)
                        : 9.77 * pow(relative, -2.33 - 1.45 * (s->age - 1.17));
}

double passes_sea_spread(const sea *s, double k, double angle) {
    angle = remainder(angle, 2 * PI);
    if (s->spreading == LOBE_OCEAN_SPREADING_SYMMETRIC)
        return fabs(angle) < SEA_SPREAD_WIDTH ? (1 + upwind_contrast(s, k) * cos(2 * angle)) / PI
                                              : 0;
    const double power = sharpness(s, k);
    // Half the quotient of Gamma functions whose logarithms these are.
    const double scale = exp(lgamma(power + 1) - lgamma(power + 0.5)) / (2 * sqrt(PI));
    return scale * pow(fabs(cos(angle / 2)), 2 * power);
}

double passes_sea_alignment(const sea *s, double k) {
    if (s->wind == 0 || k <= 0)
        return 0.5;
    if (s->spreading == LOBE_OCEAN_SPREADING_SYMMETRIC)
        return 0.5 + 0.25 * upwind_contrast(s, k);
    // The second Fourier coefficient of cos(angle/2)^(2 s).
    const double power = sharpness(s, k);
    return 0.5 + 0.5 * power * (power - 1) / ((power + 1) * (power + 2));
}

double passes_sea_density(const sea *s, double kx, double ky) {
    const double k = hypot(kx, ky);
    if (s->wind == 0 || k <= 0)
        return 0;
    return passes_sea_elevation(s, k) / k * passes_sea_spread(s, k, atan2(ky, kx) - s->direction);
}

// ---------------------------------------------------------------------------------------------
// Slopes

/// Simpson's rule over the logarithm of k; beyond these limits, waves add nothing.
void passes_sea_slopes(const sea *s, double from, double to, double along_across[2]) {
    enum { STEPS = 4096 };
    const double first = log(fmax(from, 1e-5)), last = log(fmin(to, 2e4));
    const double step = (last - first) / STEPS;
    along_across[0] = along_across[1] = 0;
    for (int i = 0; s->wind > 0 && step > 0 && i <= STEPS; i++) {
        const double weight = i == 0 || i == STEPS ? 1 : i % 2 ? 4 : 2;
        const double k = exp(first + i * step);
        const double part = weight * step / 3 * k * k * k * passes_sea_elevation(s, k);
        const double along = passes_sea_alignment(s, k);
        along_across[0] += part * along;
        along_across[1] += part * (1 - along);
    }
}

void passes_sea_covariance(const sea *s, const double v[2], double covariance[3]) {
    const double c = cos(s->direction), n = sin(s->direction);
    covariance[0] = v[0] * c * c + v[1] * n * n;
    covariance[1] = v[0] * n * n + v[1] * c * c;
    covariance[2] = (v[0] - v[1]) * c * n;
}
