// One anisotropic Beckmann lobe for each footprint, from moments of slopes: Olano, Baker 2010, LEAN
// Mapping. Their lobe is over the surface's plane. Here it is over the plane of the mean normal,
// and base lobes are added there, so that a footprint with a single normal is exactly the Beckmann
// distribution about it. Where the mean normal is the surface's, the two are the same.
//
// The microfacet frame is that of all filters: masked like the base lobes, about the mean normal of
// the texels that reflect.

#include "shading/slope_maps.glsl"

float height_scale() {
    return 1.0;
}

struct footprint_lobe {
    mat3 tangent_from_mean; // z: the mean normal
    slope_distribution slopes; // over the mean normal's plane, base lobes included
};

#include "shading/slope_appearance.glsl"

footprint_lobe fetch_lobe(map_area area, surface_point surface, out slope_moments moments) {
    moments = fetch_moments(area, surface);
    moments.mean = facing_slope(moments.mean, surface);
    footprint_lobe result;
    vec3 normal = normal_of_slope(moments.mean);
    result.tangent_from_mean = mat3(rotate_from_pole(normal, vec3(1.0, 0.0, 0.0)),
                                    rotate_from_pole(normal, vec3(0.0, 1.0, 0.0)), normal);
    vec3 covariance =
        transformed_covariance(tilted_from_flat_slopes(moments.mean), moments.covariance);
    result.slopes = slope_distribution_of(
        vec2(0.0), covariance + vec3(vec2(moments.base_variance), 0.0));
    return result;
}

// Masked about the normal of the texels that reflect, however the triangles lie.
void mask_by_triangles(inout footprint_lobe lobe, inout slope_moments moments, map_area area,
                       surface_point surface) {
}

void gather_footprint(inout appearance fetched, surface_point surface, vec3 incoming[4]) {
}

// The mean normal of the texels that reflect about `halfway` (here over the mean normal's plane).
// Of two Gaussians, texels' slopes with covariance C and base lobes with b I, whose sum is given as
// s, the mean of the first is C (C + b I)^-1 s = s - b (C + b I)^-1 s.
vec3 reflecting_normal(appearance fetched, vec3 halfway) {
    vec2 slope = halfway.xy / -max(halfway.z, COSINE_MINIMUM);
    slope_distribution slopes = fetched.lobe.slopes;
    vec2 standardised = standardised_slope(slopes, slope);
    float y = standardised.y / slopes.root.y;
    vec2 solved = vec2((standardised.x - slopes.root.z * y) / slopes.root.x, y);
    vec2 texels = slope - fetched.moments.base_variance * solved;
    return fetched.lobe.tangent_from_mean * normal_of_slope(texels);
}

// All texels of a normal map have the same weight, each with a distribution of projected area one
// about its own normal. Their sum is the lobe, of area one, divided by the cosine to the reflecting
// normals: 1/cos^4 for a single normal, 1/cos^3 for sharp lobes about many normals.
float distribution_about(vec3 normal, vec3 halfway, float lobe) {
    return lobe / max(dot(normal, halfway), COSINE_MINIMUM);
}

// Its product with the incoming direction is the mean of the texels' cosines if their slopes and
// n_z are uncorrelated.
vec3 lambert_normal(slope_moments moments) {
    return vec3(-moments.mean, 1.0) * moments.mean_cosine;
}

vec3 evaluate_footprint(appearance fetched, vec3 outgoing, vec3 incoming, uint light) {
    vec3 halfway = half_vector(incoming, outgoing);
    vec3 over_mean = halfway * fetched.lobe.tangent_from_mean;
    float lobe = lobe_of_slopes(fetched.lobe.slopes, over_mean);
    vec3 lambert = lambert_normal(fetched.moments);
    if (MODEL == MODEL_MICROFACET) {
        base_material frame = fetched.filtered;
        frame.normal = reflecting_normal(fetched, over_mean);
        return evaluate_microfacets(frame, lambert,
                                    distribution_about(frame.normal, halfway, lobe), halfway,
                                    outgoing, incoming);
    }
    vec3 sum = lobes_colour() * fetched.filtered.specular * lobe;
    if (DIFFUSE)
        sum += microfacet_diffuse(fetched.filtered.diffuse, vec3(0.0), dot(lambert, incoming));
    return sum;
}

#ifdef ENVIRONMENT
vec3 reflect_footprint(appearance fetched, surface_point surface) {
    footprint_lobe lobe = fetched.lobe;
    vec3 root = lobe.slopes.root;
    half_vector_distribution half_vectors =
        gaussian_slopes(lobe.tangent_from_mean[2],
                        lobe.tangent_from_mean * vec3(-root.x, -root.z, 0.0),
                        lobe.tangent_from_mean * vec3(0.0, -root.y, 0.0));
    base_material frame = fetched.filtered;
    vec3 sum = MODEL == MODEL_MICROFACET
                   ? reflect_microfacets(surface, half_vectors, frame.specular, frame.width)
                   : lobes_colour() * frame.specular *
                         reflect_half_vectors(surface, half_vectors);
    if (DIFFUSE)
        sum += reflect_lambert(surface, frame, lambert_normal(fetched.moments));
    return sum;
}
#endif
