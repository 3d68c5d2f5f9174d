// One anisotropic Beckmann lobe about any mean, masked, shadowed and projected as a displaced
// surface is: Dupuy, Heitz, Iehl, Poulin, Neyret, Ostromoukhov 2013, Linear Efficient Antialiased
// Displacement and Reflectance Mapping. What is behind the mean plane is dark, as on the displaced
// surface that the maps represent, although a normal map's own texels never hide each other.
//
// Under lights each texel has its base lobe about its own normal, and GGX its tails
// (leadr/mirroring_facets.glsl); in light from an environment, the covariance of the base lobes is
// added over the plane of the mean normal. The paper adds Beckmann lobes over the surface's plane,
// which makes the lobe of a tilted footprint too narrow: 13 % too bright at 16 degrees
// (BASE_PLANE_SURFACE).

#pragma variants CLOSED_SURFACE WAVES

#ifdef WAVES

#include "shading/waves/filtered_waves.glsl"

#else

#include "shading/slope_maps.glsl"
#include "filters/leadr/base_lobes.glsl"
#include "filters/leadr/drawn_slope.glsl"
#include "filters/leadr/mirroring_facets.glsl"
#include "shading/facet_grid.glsl"

layout(constant_id = SPECIALISE_BASE_PLANE) const uint BASE_PLANE = BASE_PLANE_FACETS;

layout(LOBE_DESCRIPTOR(FILTER_KNOB_BINDING), std140) uniform filter_knob_block {
    leadr_knobs filter_knobs;
};

float height_scale() {
    return filter_knobs.height;
}

struct footprint_lobe {
    slope_distribution facets; // texels' slopes
    slope_distribution slopes; // base lobes included, without the tails of GGX
    vec3 texels, base;         // covariances of both parts of the latter
    base_lobes microfacets;    // over their own plane
    // Of displaced geometry: variance of the texels' slopes that triangles draw, so that the
    // facets' area does not depend on it, and what shadows them.
    float drawn;
    vec2 shadowing_mean;
    vec3 shadowing_covariance;
};

#include "shading/slope_appearance.glsl"
#include "shading/slope_reflection.glsl"

// Of base lobes, over the surface's plane.
vec3 base_covariance(slope_moments moments) {
    return BASE_PLANE == BASE_PLANE_FACETS
               ? flat_covariance_of_tilted(moments.mean, moments.base_variance)
               : vec3(moments.base_variance, moments.base_variance, 0.0);
}

footprint_lobe fetch_lobe(map_area area, surface_point surface, out slope_moments moments) {
    moments = fetch_moments(area, surface);
    base_lobes microfacets = fetch_base_lobes(area, moments.base_variance, surface);
    if (BASE_PLANE == BASE_PLANE_FACETS)
        moments.base_variance = microfacets.variance;
    vec3 base = base_covariance(moments);
    return footprint_lobe(slope_distribution_of(moments.mean, moments.covariance),
                          slope_distribution_of(moments.mean, moments.covariance + base),
                          moments.covariance, base, microfacets, 0.0, moments.mean,
                          moments.covariance);
}

// Displaced triangles hide each other by themselves, and pixels show what is drawn as large as it
// is seen. The area that facets show counts only as far as their slopes are those of relief that is
// not drawn: of what is finer than the level whose texels are as large as vertices are apart, whose
// covariance that of `between` is. (The paper takes the footprint's own, so that the mean
// brightness depends on the size of triangles.)
//
// Where pixels are larger than triangles, part of their own covariance is drawn.
//
// What is not drawn shadows, too, about the triangle's slope where pixels are smaller than it.
void mask_by_triangles(inout footprint_lobe lobe, inout slope_moments moments, map_area area,
                       surface_point surface) {
    float level = level_of_vertices(surface);
    float share = clamp(level - area.level, 0.0, 1.0);
    slope_moments between = fetch_level(area.centre, level, surface);
    vec2 mean = mean_on_triangles(moments, between, share, surface);
    lobe.facets.mean = lobe.slopes.mean = mean;
    lobe.drawn = max(trace(moments.covariance) - trace(between.covariance), 0.0);
    lobe.shadowing_mean = mix(mean, surface.drawn_slope, share);
    lobe.shadowing_covariance = between.covariance;
}

// Which part of a slope's distance from the mean is undrawn relief.
float undrawn_part(footprint_lobe lobe, vec3 covariance) {
    return 1.0 - lobe.drawn / max(trace(covariance), max(lobe.drawn, 1e-12));
}

// The part of the facets that both directions see. `base`: covariance that base lobes add to that
// of the texels, where they are masked together.
float visibility_of_facets(footprint_lobe lobe, vec3 base, vec3 incoming, vec3 outgoing) {
    vec3 covariance = lobe.texels + base;
    slope_distribution slopes = slope_distribution_of(lobe.facets.mean, covariance);
    if (!DISPLACED)
        return masking_shadowing_of_slopes(slopes, incoming, outgoing);
    slopes.root *= undrawn_part(lobe, covariance);
    return masking_of_slopes(slopes, outgoing) *
           shadowing_of_seen_slopes(
               slope_distribution_of(lobe.shadowing_mean, lobe.shadowing_covariance + base),
               incoming, outgoing);
}

// Of Lambert facets of albedo pi, before their own masking and shadowing: Eqs. 20 and 23, where
// 1/height is the factor <n_mean, omega_g>/<n_mean, omega_o>.
void gather_footprint(inout appearance fetched, surface_point surface, vec3 incoming[4]) {
    if (!DIFFUSE || CLOSED)
        return;
    footprint_lobe lobe = fetched.lobe;
    float height = height_above_slope(lobe.facets.mean, surface.outgoing);
    fetched.gathered = facet_sums(lobe.facets, undrawn_part(lobe, lobe.texels), surface.outgoing,
                                  incoming) /
                       max(height, COSINE_MINIMUM);
}

vec3 lambert_facets(appearance fetched, vec3 fresnel, vec3 outgoing, vec3 incoming, uint light) {
    return microfacet_diffuse(fetched.filtered.diffuse, fresnel,
                              visibility_of_facets(fetched.lobe, vec3(0.0), incoming, outgoing) *
                                  fetched.gathered[light]);
}

lobes_of_texels texels_of(appearance fetched, vec3 halfway, vec3 outgoing, vec3 incoming) {
    footprint_lobe lobe = fetched.lobe;
    return lobes_of_texels(lobe.facets.mean, lobe.texels, lobe.microfacets,
                           fetched.filtered.width, undrawn_part(lobe, lobe.texels), halfway,
                           outgoing, incoming);
}

// Eq. 17, or each texel's own lobe instead of D.
vec3 mirror_facets(appearance fetched, vec3 fresnel, vec3 halfway, vec3 outgoing, vec3 incoming) {
    footprint_lobe lobe = fetched.lobe;
    vec2 mean = lobe.slopes.mean;
    float distribution;
    vec3 base = vec3(0.0);
    if (BASE_PLANE == BASE_PLANE_FACETS) {
        distribution = mirroring_facets(texels_of(fetched, halfway, outgoing, incoming));
    } else {
        base = lobe.base;
        distribution = distribution_of_slopes(lobe.slopes, halfway);
        // D F/4 is of facets that are seen as large as they are.
        vec2 slope = slope_of_normal(halfway);
        if (DISPLACED)
            distribution *= facet_height(mean, slope, undrawn_part(lobe, lobe.texels + base),
                                         outgoing) /
                            max(height_above_slope(slope, outgoing), COSINE_MINIMUM);
    }
    return microfacet_specular(fresnel, distribution,
                               visibility_of_facets(lobe, base, incoming, outgoing),
                               height_above_slope(mean, outgoing));
}

// ---------------------------------------------------------------------------------------------
// Closed surfaces: masked not as a displaced surface is, but as each texel's facets are

mapped_facet facet_of_footprint(appearance fetched, int node) {
    return mapped_facet(slope_at(fetched.lobe.facets, slope_node(node)),
                        fetched.filtered.specular, fetched.filtered.diffuse,
                        fetched.filtered.specular, fetched.filtered.width, turn_of_node(node));
}

// The mean over all texels of D times their visibility.
float mirroring_texels(lobes_of_texels texels) {
    mirroring_slopes mirroring = mirroring_slopes_of(texels);
    float sum = 0.0;
    for (int i = 0; i < SLOPE_NODES; ++i) {
        float quotient;
        vec2 slope = mirroring_slope(mirroring, slope_node(i), quotient);
        sum += quotient *
               visibility_of_texel(slope, texels.parameter, texels.outgoing, texels.incoming);
    }
    return mirroring.density * sum / float(SLOPE_NODES);
}

vec3 mirror_closed_facets(appearance fetched, vec3 halfway, vec3 outgoing, vec3 incoming) {
    vec3 f0 = fetched.filtered.specular;
    float width = fetched.filtered.width;
    float cosine = max(dot(fetched.normal, outgoing), 0.0);
    return fresnel_schlick(f0, vec3(1.0), dot(incoming, halfway)) *
           scattering_scale(f0, cosine, width) *
           mirroring_texels(texels_of(fetched, halfway, outgoing, incoming));
}

vec3 evaluate_closed_facets(appearance fetched, vec3 outgoing, vec3 incoming) {
    vec3 sum = vec3(0.0);
    for (int i = 0; i < SLOPE_NODES; ++i)
        sum += exchanged_and_diffuse(facet_of_footprint(fetched, i), outgoing, incoming);
    return sum / float(SLOPE_NODES) +
           mirror_closed_facets(fetched, half_vector(incoming, outgoing), outgoing, incoming);
}

// ---------------------------------------------------------------------------------------------
// A footprint

// Half-vector lobes include their own masking.
vec3 evaluate_footprint(appearance fetched, vec3 outgoing, vec3 incoming, uint light) {
    if (CLOSED)
        return evaluate_closed_facets(fetched, outgoing, incoming);
    vec3 halfway = half_vector(incoming, outgoing);
    vec3 fresnel = vec3(0.0), sum;
    if (MODEL == MODEL_MICROFACET) {
        fresnel = fresnel_schlick(fetched.filtered.specular, vec3(1.0), dot(incoming, halfway));
        sum = mirror_facets(fetched, fresnel, halfway, outgoing, incoming);
    } else {
        sum = lobes_colour() * fetched.filtered.specular *
              lobe_of_slopes(fetched.lobe.slopes, halfway);
    }
    if (DIFFUSE)
        sum += lambert_facets(fetched, fresnel, outgoing, incoming, light);
    return sum;
}

#ifdef ENVIRONMENT
// Algorithm 1. Each sample reads the mean over as far as neighbours are apart in the direction in
// which they are furthest apart, so that no light falls between them (section 5.2; the paper takes
// the larger of the two axes' deviations, which is less where slopes vary most along a diagonal).
vec3 sampled_slopes(surface_point surface, footprint_lobe lobe, vec3 f0) {
    slope_distribution slopes = lobe.slopes;
    float spacing = grid_spacing();
    float area = spacing * spacing * largest_variance(slopes);
    float height = height_above_slope(slopes.mean, surface.outgoing);
    float undrawn = undrawn_part(lobe, lobe.texels + lobe.base);
    vec3 sum = vec3(0.0);
    float weights = 0.0;
    for (uint j = 0u; j < ENVIRONMENT_GRID; ++j) {
        for (uint k = 0u; k < ENVIRONMENT_GRID; ++k) {
            vec2 place = spacing * (vec2(j, k) - 0.5 * (float(ENVIRONMENT_GRID) - 1.0));
            vec2 slope = slope_at(slopes, place);
            vec3 normal = normal_of_slope(slope);
            float cosine = dot(normal, surface.outgoing);
            vec3 incoming = 2.0 * cosine * normal - surface.outgoing;
            float seen = facet_height(slopes.mean, slope, undrawn, surface.outgoing) *
                         visibility_of_facets(lobe, lobe.base, incoming, surface.outgoing);
            float solid_angle = area * normal.z * normal.z * normal.z;
            float weight = exp(-0.5 * dot(place, place));
            sum += weight * (above_horizon(incoming) ? seen : 0.0) *
                   fresnel_schlick(f0, vec3(1.0), cosine) *
                   sample_radiance(surface, half_vector_sample(normal, weight, solid_angle),
                                   incoming);
            weights += weight;
        }
    }
    return sum / (weights * max(height, COSINE_MINIMUM));
}

vec3 reflect_slopes(appearance fetched, surface_point surface) {
    slope_distribution slopes = fetched.lobe.slopes;
    base_material frame = fetched.filtered;
    half_vector_distribution half_vectors = half_vectors_of_slopes(slopes);
    if (MODEL == MODEL_HALF_VECTOR_LOBES)
        return lobes_colour() * frame.specular * reflect_half_vectors(surface, half_vectors);
    if (sampled_by_grid())
        return sampled_slopes(surface, fetched.lobe, frame.specular);
    return reflect_masked_slopes(surface, half_vectors, frame.specular,
                                 BASE_HAS_TAILS && BASE_PLANE == BASE_PLANE_FACETS
                                     ? fetched.lobe.microfacets.variance
                                     : 0.0);
}

// Eq. 21 and Algorithm 3: irradiance of the facets of a grid of slopes, without light from below
// the surface. Only masking is applied, as in Algorithm 2: it is unknown which part of the light
// from above is shadowed.
vec3 lambert_slopes(appearance fetched, surface_point surface) {
    slope_distribution facets = fetched.lobe.facets;
    float undrawn = undrawn_part(fetched.lobe, fetched.lobe.texels);
    vec3 sum = vec3(0.0);
    vec4 normals = vec4(0.0); // w: weights
    for (uint j = 0u; j < GRID; ++j) {
        for (uint k = 0u; k < GRID; ++k) {
            vec2 position = vec2(grid_position(j), grid_position(k));
            vec2 slope = slope_at(facets, position);
            float weight = exp(-0.5 * dot(position, position)) *
                           facet_height(facets.mean, slope, undrawn, surface.outgoing);
            vec3 normal = normal_of_slope(slope);
            sum += weight * mean_irradiance(surface, normal);
            normals += weight * vec4(normal, 1.0);
        }
    }
    sum = lambert_sum_from_above(surface, sum, normals);
    float row = grid_weight();
    float height = height_above_slope(facets.mean, surface.outgoing);
    facets.root *= undrawn;
    float visible = masking_of_slopes(facets, surface.outgoing);
    return let_through(surface, fetched.filtered) * sum *
           (visible / (row * row * max(height, COSINE_MINIMUM)));
}

vec3 reflect_closed_facets(appearance fetched, surface_point surface) {
    facet_sum sum = no_facets();
    for (int i = 0; i < SLOPE_NODES; ++i)
        add_facet(sum, surface, facet_of_footprint(fetched, i));
    float width = fetched.filtered.width;
    uint kind = base_half_vectors(SURFACE_NORMAL, width, surface.outgoing).kind;
    return reflect_facets(surface, sum, kind, fetched.filtered.specular, width);
}

vec3 reflect_footprint(appearance fetched, surface_point surface) {
    if (CLOSED)
        return reflect_closed_facets(fetched, surface);
    vec3 sum = reflect_slopes(fetched, surface);
    if (DIFFUSE)
        sum += lambert_slopes(fetched, surface);
    return sum;
}
#endif

#endif
