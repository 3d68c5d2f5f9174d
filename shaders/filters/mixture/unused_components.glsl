#ifndef UNUSED_COMPONENTS_GLSL
#define UNUSED_COMPONENTS_GLSL

// Components that have next to nothing in a large part of the map, because its material is another,
// take half of the widest one there. Only coarse levels do so: finer ones start alike at what these
// found, and neighbours that differ meet at a few lines alone.

#include "filters/mixture/components.glsl"
#include "lib/number/constants.glsl"

const uint MOST_PARTS = 2; // of the map, along each side

const float LEAST_USED_PART = 0.01;

// The deviation of a component, in those of base lobes as broad as its own and times its part, from
// which its halves differ.
const float LEAST_WIDTH_OF_HALVES = 0.2;

bool shares_unused_components(uvec2 size) {
    return START == MIXTURE_START_PARENT && !PRINTED && max(size.x, size.y) <= MOST_PARTS;
}

// Deviation along the longer axis; `axis`: its direction, always to the same side.
float longer_axis(vec4 covariance, out vec2 axis) {
    float mean = 0.5 * (covariance.x + covariance.y);
    float difference = length(vec2(0.5 * (covariance.x - covariance.y), covariance.z));
    float square = mean + difference;
    axis = difference < 0.05 * mean ? vec2(1.0, 0.0)
                                    : normalize(abs(covariance.z) > 1e-6 * mean
                                                    ? vec2(covariance.z, square - covariance.x)
                                                : covariance.x > covariance.y ? vec2(1.0, 0.0)
                                                                              : vec2(0.0, 1.0));
    if (axis.x < 0.0)
        axis = -axis;
    return sqrt(square);
}

float width_of_halves(mixture_component component, mixture_units units) {
    vec2 axis;
    float base = units.deviation * exp(component.mean.z / units.deviation);
    return component.part * longer_axis(component.covariance, axis) / base;
}

// The halves of a Gaussian about its mean, at -`side` and `side` times sqrt(2 / pi) deviations.
mixture_component half_of(mixture_component whole, float side, mixture_units units) {
    const float SQUARE = 2.0 * INVERSE_PI;
    vec2 axis;
    vec2 offset = sqrt(SQUARE) * longer_axis(whole.covariance, axis) * axis;
    mixture_component result = whole;
    result.part *= 0.5;
    result.mean.xy += side * offset;
    vec4 c = whole.covariance - vec4(offset * offset, offset.x * offset.y, 0.0);
    c.xy = max(c.xy, vec2(LEAST_VARIANCE * units.deviation * units.deviation));
    float limit = MOST_CORRELATION * sqrt(c.x * c.y);
    c.z = clamp(c.z, -limit, limit);
    result.covariance = c;
    return result;
}

// The one whose halves differ most, or -1.
int widest_component(mixture_component all[MIXTURE_MAXIMUM_COMPONENTS], mixture_units units) {
    int widest = -1;
    float most = LEAST_WIDTH_OF_HALVES;
    for (int j = 0; j < BINS; ++j) {
        float width = width_of_halves(all[j], units);
        if (width > most) {
            most = width;
            widest = j;
        }
    }
    return widest;
}

// After a first step, which tells what components have.
void share_unused_components(inout mixture_component all[MIXTURE_MAXIMUM_COMPONENTS],
                             mixture_units units) {
    for (int j = 0; j < BINS; ++j) {
        int widest = all[j].part < LEAST_USED_PART ? widest_component(all, units) : -1;
        if (widest < 0)
            continue;
        all[j] = half_of(all[widest], 1.0, units);
        all[widest] = half_of(all[widest], -1.0, units);
    }
}

#endif
