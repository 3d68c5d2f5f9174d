#ifndef OVERLAP_GLSL
#define OVERLAP_GLSL

// How much of a component, with base lobes, lies over a lobe or over another component.

#include "filters/mixture/components.glsl"
#include "lib/lobe/plane_gaussian.glsl"

// The variance of base lobes of a width.
vec3 base_covariance(float width, mixture_units units) {
    float deviation = units.deviation * exp(width / units.deviation);
    return vec3(vec2(deviation * deviation), 0.0);
}

mixture_sample as_sample(mixture_component component) {
    return mixture_sample(component.mean, component.covariance.xyz, vec2(0.0), component.part);
}

// The integral of a component with base lobes, times the sample's lobe of mass one.
float overlap(mixture_component component, mixture_sample lobe, mixture_units units) {
    vec3 covariance = component.covariance.xyz + lobe.covariance +
                      base_covariance(component.mean.z, units) +
                      base_covariance(lobe.place.z, units);
    return component.part * evaluate_plane_gaussian(make_plane_gaussian(covariance, 1.0),
                                                    lobe.place.xy - component.mean.xy);
}

#endif
