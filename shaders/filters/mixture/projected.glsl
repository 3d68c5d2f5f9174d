#ifndef PROJECTED_GLSL
#define PROJECTED_GLSL

// Round lobes of normals projected onto the surface, as maps of MIXTURE_PLANE_PROJECTED hold them,
// and what mixtures of them reflect: the Cook-Torrance and Lambert terms of Tan et al. 2005,
// section 3.

#include "shading/base_material.glsl"
#include "interface/gaussian_mixture.h"
#include "interface/moment_bins.h"

#ifdef ENVIRONMENT
#include "environment/reflection.glsl"
#endif

layout(constant_id = SPECIALISE_BINS) const uint BINS = 4;

layout(LOBE_DESCRIPTOR(16)) uniform sampler2DArray moment_map;

struct projected_lobe {
    float part;
    vec3 normal;  // x and y are the mean
    float square; // the mean of |d|^2, d from the mean
};

projected_lobe lobe_of_sums(vec4 sums) {
    projected_lobe lobe;
    lobe.part = sums.x;
    vec2 mean = sums.yz / max(sums.x, 1e-6);
    lobe.square = sums.w / max(sums.x, 1e-6) - dot(mean, mean);
    mean *= min(1.0, 0.999 * inversesqrt(max(dot(mean, mean), 1e-12)));
    lobe.normal = vec3(mean, sqrt(1.0 - dot(mean, mean)));
    return lobe;
}

// What a lobe reflects, from its density of half vectors per solid angle. Microfacets divide by
// 4 <m, omega_o>, without masking.
float reflected_density(vec3 normal, float density, vec3 outgoing) {
    float cosine = dot(normal, outgoing);
    if (MODEL == MODEL_HALF_VECTOR_LOBES)
        return density;
    return cosine > 0.0 ? density / (4.0 * max(cosine, COSINE_MINIMUM)) : 0.0;
}

// `specular`: the sum of lobes' reflected densities; `cosine`: the mean of <m, omega_i>.
vec3 evaluate_projected(base_material filtered, float specular, float cosine, vec3 halfway,
                        vec3 incoming) {
    vec3 fresnel = vec3(0.0), colour = filtered.specular * lobes_colour();
    if (MODEL == MODEL_MICROFACET)
        colour = fresnel = fresnel_schlick(filtered.specular, vec3(1.0), dot(incoming, halfway));
    vec3 sum = colour * specular;
    if (DIFFUSE)
        sum += microfacet_diffuse(filtered.diffuse, fresnel, cosine);
    return sum;
}

#ifdef ENVIRONMENT
// The paper has no light from all around. Here a lobe reflects it masked like the base material.
vec3 reflect_projected(surface_point surface, base_material filtered, direction_lobe shape) {
    half_vector_distribution half_vectors = half_vector_distribution(shape, DISTRIBUTION_VMF);
    if (MODEL == MODEL_MICROFACET)
        return reflect_microfacets(surface, half_vectors, filtered.specular, filtered.width);
    return lobes_colour() * filtered.specular * reflect_half_vectors(surface, half_vectors);
}
#endif

#endif
