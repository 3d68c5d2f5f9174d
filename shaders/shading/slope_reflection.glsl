#ifndef SLOPE_REFLECTION_GLSL
#define SLOPE_REFLECTION_GLSL

// What Gaussians of slopes reflect of the environment.

#ifdef ENVIRONMENT
// The slopes' lobe as one of directions, about the mean normal, to first order.
half_vector_distribution half_vectors_of_slopes(slope_distribution slopes) {
    vec3 normal = normal_of_slope(slopes.mean);
    vec3 first = vec3(-slopes.root.x, -slopes.root.z, 0.0) * normal.z;
    vec3 second = vec3(0.0, -slopes.root.y, 0.0) * normal.z;
    return gaussian_slopes(normal, first - normal * dot(normal, first),
                           second - normal * dot(normal, second));
}

// In the direction in which slopes vary most.
float largest_variance(slope_distribution slopes) {
    vec3 root = slopes.root;
    float x = root.x * root.x, y = root.z * root.z + root.y * root.y, mixed = root.x * root.z;
    return 0.5 * (x + y) + length(vec2(0.5 * (x - y), mixed));
}

// Masked as a round distribution as narrow as the slopes are: the rest of their variance elongates
// the lobe.
//
// `base_variance`: of base lobes that have GGX's tails; 0: without. Of slopes s far from the mean,
// GGX's density is in proportion to the variance of its scale, and Beckmann's is nothing. So the
// part of GGX of the common scale is that of the base lobes in the common variance.
vec3 reflect_masked_slopes(surface_point surface, half_vector_distribution half_vectors, vec3 f0,
                           float base_variance) {
    vec3 narrowest = principal_lobe(half_vectors.shape).second;
    float variance = max(dot(narrowest, narrowest), 1e-6);
    float width = base_lobe_of_concentration(DISTRIBUTION, 1.0 / variance);
    // Where there is little of one of them, the other takes its place.
    float tails = clamp(1.1 * min(base_variance / variance, 1.0) - 0.05, 0.0, 1.0);
    vec3 sum = vec3(0.0);
    for (int i = 0; i < 2; ++i) {
        float part = i == 0 ? 1.0 - tails : tails;
        half_vectors.kind = i == 0 ? DISTRIBUTION_BECKMANN : DISTRIBUTION_GGX;
        if (part > 0.0)
            sum += part * reflect_microfacets(surface, half_vectors, f0, width);
    }
    return sum;
}
#endif

#endif
