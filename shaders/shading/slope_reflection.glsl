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
vec3 reflect_masked_slopes(surface_point surface, half_vector_distribution half_vectors, vec3 f0) {
    vec3 narrowest = principal_lobe(half_vectors.shape).second;
    float width =
        base_lobe_of_concentration(DISTRIBUTION, 1.0 / max(dot(narrowest, narrowest), 1e-6));
    return reflect_microfacets(surface, half_vectors, f0, width);
}
#endif

#endif
