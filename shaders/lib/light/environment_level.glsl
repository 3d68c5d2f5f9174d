#ifndef LIB_ENVIRONMENT_LEVEL_GLSL
#define LIB_ENVIRONMENT_LEVEL_GLSL

#include "lib/number/constants.glsl"
#include "lib/lobe/von_mises_fisher.glsl"

// Which level of an environment's cubes to read. `width`: texels along a face of level 0.

// The level of the radiance's MIP chain whose texels cover a solid angle, in steradian: at level m,
// each of the 6 w^2/4^m texels all around covers 4 pi 4^m/(6 w^2) on average.
float solid_angle_level(float width, float solid_angle) {
    return clamp(0.5 * log2(solid_angle * (1.5 * INVERSE_PI) * width * width), 0.0, log2(width));
}

// McGuire et al., 2013, Plausible Blinn-Phong Reflection of Standard Cube MIP-Maps, Eq. 12: the
// same for a Blinn-Phong lobe, whose integral over the hemisphere is 2 pi/(s + 1),
//   m = log2(w sqrt 3) - log2(s + 1)/2.
float mip_level(float width, float exponent) {
    return clamp(log2(width * sqrt(3.0)) - 0.5 * log2(exponent + 1.0), 0.0, log2(width));
}

// The concentration that a level of a filtered cube represents, as in
// passes/environment/prefiltering.c: a standard deviation of two texels in the middle of a face;
// nothing at the 1x1 level, which holds the mean.
float prefiltered_concentration(float width, float level) {
    float texels = width * exp2(-level);
    return texels > 1.5 ? texels * texels / 16.0 : 0.0;
}

// Integral over the sphere of the product of two von Mises-Fisher lobes about the same axis: that
// of exp(a (c - 1)) exp(b (c - 1)) is the inverse of the peak of the lobe a + b.
float lobe_product(float first, float second) {
    return von_mises_fisher_peak(first) * von_mises_fisher_peak(second) /
           von_mises_fisher_peak(first + second);
}

// The share w of the sharper of two lobes, a and b, with which w a + (1 - w) b is nearest to a
// lobe c in between, in least squares over the sphere:
//   w = <c - b, a - b> / <a - b, a - b>.
// For narrow lobes it depends on ratios alone: 0.41 half way (in log kappa) between lobes four
// times as concentrated as one another, where the blend is 13 % off the lobe (its relative L2),
// which is the visible error if all light comes from one point.
float sharper_share(float sharper, float broader, float concentration) {
    float across = lobe_product(sharper, broader), square = lobe_product(broader, broader);
    float part = lobe_product(concentration, sharper) - lobe_product(concentration, broader) -
                 across + square;
    return clamp(part / (lobe_product(sharper, sharper) - 2.0 * across + square), 0.0, 1.0);
}

// The level of a filtered cube for a lobe of any concentration: trilinear interpolation there
// blends the two adjacent levels with the best weights. 0 for lobes that are too concentrated.
float prefiltered_level(float width, float concentration) {
    float last = log2(width);
    float finer = clamp(floor(last - 2.0 - 0.5 * log2(max(concentration, 1e-6))), 0.0, last - 1.0);
    return finer + 1.0 -
           sharper_share(prefiltered_concentration(width, finer),
                         prefiltered_concentration(width, finer + 1.0), concentration);
}

// A lobe of any concentration as a blend of one level of the cube and one of the cube in between
// (twice the concentrations): at most 3.5 % off, for two reads of one level instead of one read of
// two. Up to twice the concentration of level 0.
struct prefiltered_blend {
    float level, level_between;
    float share; // of the first
};

prefiltered_blend blend_of_lobe(float width, float concentration) {
    float last = log2(width), exact = last - 2.0 - 0.5 * log2(max(concentration, 1e-6));
    float level = clamp(round(exact), 0.0, last - 1.0);
    float level_between = exact >= level ? level + 1.0 : level;
    float here = prefiltered_concentration(width, level);
    float between = 2.0 * prefiltered_concentration(width, level_between);
    float share = sharper_share(max(here, between), min(here, between), concentration);
    return prefiltered_blend(level, level_between, here > between ? share : 1.0 - share);
}

// For lobes more concentrated than those of the finest level: the share of the radiance itself,
// read at its level 0, whose faces are `size` texels wide; the rest is level 0 of the filtered
// cube. Linear interpolation between texels t apart is a lobe of variance t^2/6, here with the mean
// texel.
float radiance_share(float finest, float size, float concentration) {
    float interpolation = 4.0 * PI / (36.0 * size * size);
    return concentration > finest
               ? sharper_share(1.0 / interpolation, finest, min(concentration, 1.0 / interpolation))
               : 0.0;
}

#endif
