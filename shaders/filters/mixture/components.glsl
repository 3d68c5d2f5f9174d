#ifndef COMPONENTS_GLSL
#define COMPONENTS_GLSL

// Expectation maximisation of a mixture of Gaussians over samples of lobes (Dempster, Laird, Rubin
// 1977). A sample stands for all places inside its texel, which have a covariance of their own.
// Base lobes do not count: components separate normals, and where base lobes vary their widths.

#include "interface/gaussian_mixture.h"
#include "interface/moment_bins.h"
#include "interface/specialisation.h"

layout(constant_id = SPECIALISE_LOBE_COUNT) const uint LOBE_COUNT = 1;
layout(constant_id = SPECIALISE_BINS) const uint BINS = 4;
layout(constant_id = SPECIALISE_BIN_COLOUR) const bool BIN_COLOUR = false;
layout(constant_id = SPECIALISE_BIN_WIDTHS) const bool BIN_WIDTHS = true;
layout(constant_id = SPECIALISE_MASKED_LOBES) const bool MASKED_LOBES = false;
layout(constant_id = SPECIALISE_MIXTURE_SHAPE) const uint SHAPE = MIXTURE_SHAPE_AUTOMATIC;
layout(constant_id = SPECIALISE_MIXTURE_START) const uint START = MIXTURE_START_PARENT;
layout(constant_id = SPECIALISE_MIXTURE_PRINTED) const bool PRINTED = false;

layout(set = 0, binding = 0) uniform sampler2DArray sample_map;

layout(push_constant) uniform constants_block { mixture_fit_constants constants; };

// Components that are fitted at a time: those of the map, or of which some are merged then.
#ifndef COMPONENTS
#define COMPONENTS BINS
#endif

const int LAYERS = BIN_COLOUR ? 3 : 2;

// Less of all lobes moves no component: it stays at its place, for finer levels.
const float LEAST_PART = 1e-4;

// Of variances, in those of the base lobes: what is much narrower than these does not show.
const float LEAST_VARIANCE = 0.01;

// The same of widths. They separate base lobes more strictly than places do: a lobe twice as broad
// as another is another shape wherever it is.
const float LEAST_WIDTH_VARIANCE = 0.001;

const float MOST_CORRELATION = 0.999;

// The material's places and widths (moment_bins.h and gaussian_mixture.h).
struct mixture_units {
    vec2 origin;
    float deviation;    // usual one of base lobes
    bool is_round;      // components are, while lobes are shared out among them
    float width_weight; // of squared distances along widths, where nearness decides
};

struct mixture_sample {
    vec3 place; // from the origin; z: the width
    vec3 covariance;
    vec2 widths; // sharpness and variance
    float mass;
};

struct mixture_component {
    float part;
    vec3 mean;
    vec4 covariance; // xx, yy, xy; w: variance of the width
};

// log2 of its part times its density, up to a constant, is
//   offset + inverse.x d_x^2 + inverse.y d_y^2 + inverse.z d_x d_y + inverse.w d_z^2.
struct component_density {
    vec3 mean;
    vec4 inverse;
    float offset;
};

// Sums over a component's shares of samples, d their distances from its mean.
struct component_sums {
    vec4 first;  // m, m d
    vec4 second; // m (d d + covariance): xx, yy, xy; w: m d_z^2
};

mixture_sample read_sample(ivec2 texel, int lobe, mixture_units units) {
    vec4 means = texelFetch(sample_map, ivec3(texel, LAYERS * lobe), 0);
    vec4 spread = texelFetch(sample_map, ivec3(texel, LAYERS * lobe + 1), 0);
    float width = BIN_WIDTHS ? -log(means.z * units.deviation) * units.deviation : 0.0;
    return mixture_sample(vec3(means.xy - units.origin, width), spread.xyz, means.zw, spread.w);
}

component_density density_of(mixture_component component) {
    const float HALF_LOG2_E = 0.72134752;
    vec4 c = component.covariance;
    float determinant = c.x * c.y - c.z * c.z;
    component_density density;
    density.mean = component.mean;
    density.inverse = -HALF_LOG2_E * vec4(vec3(c.yx, -2.0 * c.z) / determinant,
                                          BIN_WIDTHS ? 1.0 / c.w : 0.0);
    density.offset = log2(component.part) -
                     0.5 * log2(BIN_WIDTHS ? determinant * c.w : determinant);
    return density;
}

float evaluate_density(component_density density, mixture_sample lobe) {
    vec3 d = lobe.place - density.mean;
    vec3 square = vec3(d.xy * d.xy, d.x * d.y) + lobe.covariance;
    return density.offset + dot(density.inverse.xyz, square) +
           (BIN_WIDTHS ? density.inverse.w * d.z * d.z : 0.0);
}

// Bayes: what each component has of a sample.
void find_shares(component_density densities[MIXTURE_MAXIMUM_COMPONENTS], mixture_sample lobe,
                  out float shares[MIXTURE_MAXIMUM_COMPONENTS]) {
    float most = -1e30, sum = 0.0;
    for (int j = 0; j < COMPONENTS; ++j) {
        shares[j] = evaluate_density(densities[j], lobe);
        most = max(most, shares[j]);
    }
    for (int j = 0; j < COMPONENTS; ++j) {
        shares[j] = exp2(shares[j] - most);
        sum += shares[j];
    }
    for (int j = 0; j < COMPONENTS; ++j)
        shares[j] /= sum;
}

float squared_distance(mixture_sample lobe, vec3 place, mixture_units units) {
    vec3 d = lobe.place - place;
    return dot(d.xy, d.xy) + units.width_weight * d.z * d.z;
}

// Each sample wholly to the nearest component.
void find_nearest(component_density densities[MIXTURE_MAXIMUM_COMPONENTS], mixture_sample lobe,
                  mixture_units units, out float shares[MIXTURE_MAXIMUM_COMPONENTS]) {
    int nearest = 0;
    float least = 1e30;
    for (int j = 0; j < COMPONENTS; ++j) {
        float square = squared_distance(lobe, densities[j].mean, units);
        if (square < least) {
            least = square;
            nearest = j;
        }
    }
    for (int j = 0; j < COMPONENTS; ++j)
        shares[j] = j == nearest ? 1.0 : 0.0;
}

// By densities or, `nearest`, by distance.
void share_out(component_density densities[MIXTURE_MAXIMUM_COMPONENTS], mixture_sample lobe,
               bool nearest, mixture_units units, out float shares[MIXTURE_MAXIMUM_COMPONENTS]) {
    if (nearest)
        find_nearest(densities, lobe, units, shares);
    else
        find_shares(densities, lobe, shares);
}

// A component at a sample, before the first step.
mixture_component first_component(vec3 mean, mixture_units units) {
    float variance = units.deviation * units.deviation;
    return mixture_component(1.0 / float(BINS), mean, vec4(variance, variance, 0.0, variance));
}

void add_share(inout component_sums sums, vec3 mean, mixture_sample lobe, float mass) {
    vec3 d = lobe.place - mean;
    sums.first += mass * vec4(1.0, d);
    sums.second +=
        mass * vec4(vec3(d.xy * d.xy, d.x * d.y) + lobe.covariance, BIN_WIDTHS ? d.z * d.z : 0.0);
}

// The component that has its sums' moments; `whole`: the mass of all samples. Tan et al. print a
// variance that is too small by the component's part.
mixture_component improved(mixture_component former, component_sums sums, float whole,
                           mixture_units units) {
    mixture_component component = former;
    component.part = max(sums.first.x / whole, 1e-6);
    if (component.part < LEAST_PART)
        return component;
    vec3 step = sums.first.yzw / sums.first.x;
    component.mean = former.mean + step;
    vec4 c = sums.second / sums.first.x - vec4(step.xy * step.xy, step.x * step.y, step.z * step.z);
    float least = LEAST_VARIANCE * units.deviation * units.deviation;
    if (PRINTED)
        c *= component.part;
    c.xyw = max(c.xyw, vec3(0.0)) +
            vec3(vec2(least), LEAST_WIDTH_VARIANCE * units.deviation * units.deviation);
    if (units.is_round)
        c.xyz = vec3(vec2(0.5 * (c.x + c.y)), 0.0);
    float limit = MOST_CORRELATION * sqrt(c.x * c.y);
    c.z = clamp(c.z, -limit, limit);
    component.covariance = c;
    return component;
}

#endif
