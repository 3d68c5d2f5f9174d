#include "scenes/builtin/noise.h"

#include <math.h>

#include "scenes/builtin/random.h"

// A ramp through 0 at each lattice point. Its two slopes are uniform over a square rather than a
// disc, which needs no square root.
static double ramp(uint32_t x, uint32_t y, uint32_t seed, double dx, double dy, double slope[2]) {
    uint32_t bits = scenes_random_lattice(x, y, seed);
    slope[0] = (double)(bits & 0xffff) / 32767.5 - 1;
    slope[1] = (double)(bits >> 16) / 32767.5 - 1;
    return slope[0] * dx + slope[1] * dy;
}

// Perlin 2002, "Improving Noise": 6t^5 - 15t^4 + 10t^3, whose second derivative is continuous.
static double fade(double t) {
    return t * t * t * (t * (t * 6 - 15) + 10);
}

static double fade_slope(double t) {
    return 30 * t * t * (t - 1) * (t - 1);
}

static double mix(double a, double b, double t) {
    return a + (b - a) * t;
}

static uint32_t wrap(double cell, uint32_t period) {
    // Nearly always true; the division below is slow.
    if (cell >= 0 && cell < period)
        return (uint32_t)cell;
    return (uint32_t)(cell - floor(cell / period) * period);
}

double scenes_noise_gradient(double x, double y, uint32_t period, uint32_t seed, double slope[2]) {
    double column = floor(x), row = floor(y), dx = x - column, dy = y - row;
    uint32_t x0 = wrap(column, period), x1 = x0 + 1 < period ? x0 + 1 : 0;
    uint32_t y0 = wrap(row, period), y1 = y0 + 1 < period ? y0 + 1 : 0;
    double s00[2], s10[2], s01[2], s11[2];
    double h00 = ramp(x0, y0, seed, dx, dy, s00), h10 = ramp(x1, y0, seed, dx - 1, dy, s10);
    double h01 = ramp(x0, y1, seed, dx, dy - 1, s01);
    double h11 = ramp(x1, y1, seed, dx - 1, dy - 1, s11);
    double u = fade(dx), v = fade(dy);
    if (slope) {
        slope[0] = mix(mix(s00[0], s10[0], u), mix(s01[0], s11[0], u), v) +
                   fade_slope(dx) * mix(h10 - h00, h11 - h01, v);
        slope[1] = mix(mix(s00[1], s10[1], u), mix(s01[1], s11[1], u), v) +
                   fade_slope(dy) * mix(h01 - h00, h11 - h10, u);
    }
    return mix(mix(h00, h10, u), mix(h01, h11, u), v);
}
