// LEADR with several lobes. The slopes under a pixel are a mixture of Gaussians fitted to them
// (shaders/filters/mixture/level.comp), where relief with flat places between steep ones, or with
// few directions, is no Gaussian. All lobes are one displaced surface, which masks itself as a
// whole:
//   1 + Lambda(omega) = sum_j w_j E_j[<omega, (-s, 1)>^+] / <omega, (-E[s], 1)>,
// so that what is visible of it keeps the surface's projected area. Developed here, after Dupuy,
// Heitz, Iehl, Poulin, Neyret, Ostromoukhov 2013, Linear Efficient Antialiased Displacement and
// Reflectance Mapping, Eqs. 13 to 23.

#include "shading/slope_maps.glsl"
#include "interface/moment_bins.h"
#include "filters/leadr/base_lobes.glsl"
#include "filters/leadr/drawn_slope.glsl"
#include "filters/leadr/mirroring_facets.glsl"
#include "shading/facet_grid.glsl"

layout(constant_id = SPECIALISE_BINS) const uint BINS = 4;

layout(LOBE_DESCRIPTOR(22), std140) uniform binning_block { moment_binning_constants binning; };
layout(LOBE_DESCRIPTOR(FILTER_KNOB_BINDING), std140) uniform filter_knob_block {
    leadr_knobs filter_knobs;
};

float height_scale() {
    return filter_knobs.height;
}

struct slope_lobe {
    float part;
    slope_distribution facets; // texels' slopes
    slope_distribution slopes; // base lobes included, without the tails of GGX
    vec3 texels;               // covariance of the former
    float base_variance;       // of base lobes, over their own plane
};

struct footprint_lobe {
    slope_lobe lobes[MOMENT_MAXIMUM_BINS]; // the first BINS
    base_lobes microfacets;                // of all; `varies` within each
};

#include "shading/slope_appearance.glsl"
#include "shading/slope_reflection.glsl"

// Of component `index`; all parts together are one.
slope_moments fetch_component(map_area area, surface_point surface, uint index, out float part) {
    vec4 place = filtered_layer(moment_map, area, 2u * index);
    vec4 spread = filtered_layer(moment_map, area, 2u * index + 1u);
    vec4 range = binning.bins[0].range; // of all components alike
    float scale = 1.0 / max(place.x, 1e-6), height = height_scale();
    vec2 mean = place.yz * scale;
    part = place.x * binning.largest.x;
    slope_moments moments;
    moments.mean = height * (mean * range.z + range.xy);
    moments.covariance =
        height * height * range.z * range.z * covariance_of_moments(mean, spread.xyz * scale);
    moments.mean_cosine = 1.0;
    moments.base_variance =
        base_variance_of(spread.w * scale * binning.bins[0].shape.w, surface);
    stretch_moments(moments, surface);
    moments.covariance += surface.curvature;
    return moments;
}

footprint_lobe fetch_lobe(map_area area, surface_point surface, out slope_moments moments) {
    footprint_lobe result;
    float whole = 0.0, base_variance = 0.0, base_width = 0.0;
    vec2 mean = vec2(0.0);
    vec3 second = vec3(0.0);
    for (uint i = 0u; i < BINS; ++i) {
        float part;
        slope_moments own = fetch_component(area, surface, i, part);
        result.lobes[i].part = part;
        result.lobes[i].facets = slope_distribution_of(own.mean, own.covariance);
        result.lobes[i].texels = own.covariance;
        result.lobes[i].base_variance = own.base_variance;
        whole += part;
        base_variance += part * own.base_variance;
        base_width += part * sqrt(own.base_variance);
        mean += part * own.mean;
        second += part * (own.covariance + vec3(own.mean * own.mean, own.mean.x * own.mean.y));
    }
    float scale = 1.0 / max(whole, 1e-6);
    base_variance *= scale;
    base_width *= scale;
    result.microfacets = fetch_base_lobes(area, base_variance, surface);
    float wider = 1.0;
    if (base_lobes_vary()) {
        // Components know the mean variance of their base lobes alone.
        float between = log(base_variance / (base_width * base_width));
        result.microfacets.varies = max(result.microfacets.varies - between, 0.0);
        wider = result.microfacets.variance / (base_width * base_width);
    }
    for (uint i = 0u; i < BINS; ++i) {
        result.lobes[i].part *= scale;
        result.lobes[i].base_variance *= wider;
        vec2 own = result.lobes[i].facets.mean;
        result.lobes[i].slopes = slope_distribution_of(
            own, result.lobes[i].texels +
                     flat_covariance_of_tilted(own, result.lobes[i].base_variance));
    }
    mean *= scale;
    moments = slope_moments(mean, covariance_of_moments(mean, second * scale), 1.0,
                            result.microfacets.variance, whole);
    return result;
}

// Over a square of a level, around the middle of an area.
map_area square_of_level(map_area area, float level) {
    map_area square = area;
    square.level = max(level, 1.0);
    square.probes = 1u;
    vec2 side = exp2(square.level) / lobe_map_size();
    square.along = vec2(side.x, 0.0);
    square.across = vec2(0.0, side.y);
    return square;
}

// Where pixels are smaller than triangles, all lobes move as the mean of the footprint does.
// Then the footprint masks itself, as in the paper, however the triangles lie: to mask about the
// triangle's slope was worse.
void mask_by_triangles(inout footprint_lobe lobe, inout slope_moments moments, map_area area,
                       surface_point surface) {
    float level = level_of_vertices(surface);
    float share = clamp(level - area.level, 0.0, 1.0);
    slope_moments between = moments;
    if (share > 0.0)
        fetch_lobe(square_of_level(area, level), surface, between);
    vec2 moved = mean_on_triangles(moments, between, share, surface) - moments.mean;
    moments.mean += moved;
    for (uint i = 0u; i < BINS; ++i) {
        lobe.lobes[i].facets.mean += moved;
        lobe.lobes[i].slopes.mean += moved;
    }
}

// ---------------------------------------------------------------------------------------------
// Masking

// 1 + Lambda of the whole mixture, of the texels' facets alone or with base lobes. The direction is
// above the mean plane.
float area_ratio(appearance fetched, vec3 direction, bool with_base) {
    float area = 0.0;
    for (uint i = 0u; i < BINS; ++i) {
        slope_lobe lobe = fetched.lobe.lobes[i];
        area += lobe.part *
                mean_height(height_above_slope(lobe.facets.mean, direction),
                            with_base ? slope_variance_along(lobe.slopes, direction.xy)
                                      : slope_variance_along(lobe.facets, direction.xy));
    }
    float height = height_above_slope(fetched.moments.mean, direction);
    return max(area / max(height, 1e-6), 1.0);
}

// How independent the heights are that two directions see, by the angle between their azimuths:
// Heitz 2014, Understanding the Masking-Shadowing Function in Microfacet-Based BRDFs, section 5.3;
// the angle's function is that of Ashikhmin, Premoze, Shirley 2000, A Microfacet-based BRDF
// Generator, as there.
float height_independence(vec3 incoming, vec3 outgoing) {
    float lengths = dot(incoming.xy, incoming.xy) * dot(outgoing.xy, outgoing.xy);
    if (lengths <= 0.0)
        return 0.0;
    float cosine = dot(incoming.xy, outgoing.xy) * inversesqrt(lengths);
    float angle = 4.41 * acos(clamp(cosine, -1.0, 1.0));
    return angle / (angle + 1.0);
}

bool both_above(appearance fetched, vec3 incoming, vec3 outgoing) {
    return height_above_slope(fetched.moments.mean, incoming) > 0.0 &&
           height_above_slope(fetched.moments.mean, outgoing) > 0.0;
}

// The part of the surface that both directions see, base lobes included: Eq. 13.
float visibility_of_slopes(appearance fetched, vec3 incoming, vec3 outgoing) {
    return both_above(fetched, incoming, outgoing)
               ? 1.0 / (area_ratio(fetched, incoming, true) +
                        area_ratio(fetched, outgoing, true) - 1.0)
               : 0.0;
}

// The same of the texels' facets. Which of them both see depends on the azimuths.
float visibility_of_facets(appearance fetched, vec3 incoming, vec3 outgoing) {
    if (!both_above(fetched, incoming, outgoing))
        return 0.0;
    float first = area_ratio(fetched, incoming, false) - 1.0;
    float second = area_ratio(fetched, outgoing, false) - 1.0;
    return 1.0 / (1.0 + max(first, second) +
                  height_independence(incoming, outgoing) * min(first, second));
}

float divisor_height(appearance fetched, vec3 outgoing) {
    return max(height_above_slope(fetched.moments.mean, outgoing), COSINE_MINIMUM);
}

// ---------------------------------------------------------------------------------------------
// Lights

void gather_footprint(inout appearance fetched, surface_point surface, vec3 incoming[4]) {
    if (!DIFFUSE)
        return;
    vec4 sums = vec4(0.0);
    for (uint i = 0u; i < BINS; ++i)
        sums += fetched.lobe.lobes[i].part *
                facet_sums(fetched.lobe.lobes[i].facets, 1.0, surface.outgoing, incoming);
    fetched.gathered = sums / divisor_height(fetched, surface.outgoing);
}

vec3 mirror_facets(appearance fetched, vec3 fresnel, float visible, vec3 halfway, vec3 outgoing,
                   vec3 incoming) {
    float distribution = 0.0;
    for (uint i = 0u; i < BINS; ++i) {
        slope_lobe lobe = fetched.lobe.lobes[i];
        base_lobes microfacets = fetched.lobe.microfacets;
        microfacets.variance = lobe.base_variance;
        distribution +=
            lobe.part * mirroring_facets(lobes_of_texels(lobe.facets.mean, lobe.texels, microfacets,
                                                         fetched.filtered.width, 1.0, halfway,
                                                         outgoing, incoming));
    }
    return microfacet_specular(fresnel, distribution, visible,
                               height_above_slope(fetched.moments.mean, outgoing));
}

vec3 lambert_facets(appearance fetched, vec3 fresnel, float visible, uint light) {
    return microfacet_diffuse(fetched.filtered.diffuse, fresnel,
                              visible * fetched.gathered[light]);
}

float half_vector_lobes(appearance fetched, vec3 halfway) {
    float sum = 0.0;
    for (uint i = 0u; i < BINS; ++i)
        sum += fetched.lobe.lobes[i].part *
               lobe_of_slopes(fetched.lobe.lobes[i].slopes, halfway);
    return sum;
}

// Half-vector lobes include their own masking.
vec3 evaluate_footprint(appearance fetched, vec3 outgoing, vec3 incoming, uint light) {
    vec3 halfway = half_vector(incoming, outgoing);
    vec3 fresnel = vec3(0.0), sum;
    float visible = visibility_of_facets(fetched, incoming, outgoing);
    if (MODEL == MODEL_MICROFACET) {
        fresnel = fresnel_schlick(fetched.filtered.specular, vec3(1.0), dot(incoming, halfway));
        sum = mirror_facets(fetched, fresnel, visible, halfway, outgoing, incoming);
    } else {
        sum = lobes_colour() * fetched.filtered.specular * half_vector_lobes(fetched, halfway);
    }
    if (DIFFUSE)
        sum += lambert_facets(fetched, fresnel, visible, light);
    return sum;
}

// ---------------------------------------------------------------------------------------------
// The environment

#ifdef ENVIRONMENT
// Algorithm 1 for one of the lobes, masked as the whole mixture.
vec3 sampled_lobe(appearance fetched, surface_point surface, slope_distribution slopes) {
    float spacing = grid_spacing();
    float area = spacing * spacing * largest_variance(slopes);
    vec3 sum = vec3(0.0);
    float weights = 0.0;
    for (uint j = 0u; j < ENVIRONMENT_GRID; ++j) {
        for (uint k = 0u; k < ENVIRONMENT_GRID; ++k) {
            vec2 place = spacing * (vec2(j, k) - 0.5 * (float(ENVIRONMENT_GRID) - 1.0));
            vec2 slope = slope_at(slopes, place);
            vec3 normal = normal_of_slope(slope);
            float cosine = dot(normal, surface.outgoing);
            vec3 incoming = 2.0 * cosine * normal - surface.outgoing;
            float seen = max(height_above_slope(slope, surface.outgoing), 0.0) *
                         visibility_of_slopes(fetched, incoming, surface.outgoing);
            float solid_angle = area * normal.z * normal.z * normal.z;
            float weight = exp(-0.5 * dot(place, place));
            sum += weight * (above_horizon(incoming) ? seen : 0.0) *
                   fresnel_schlick(fetched.filtered.specular, vec3(1.0), cosine) *
                   sample_radiance(surface, half_vector_sample(normal, weight, solid_angle),
                                   incoming);
            weights += weight;
        }
    }
    return sum / (weights * divisor_height(fetched, surface.outgoing));
}

vec3 reflect_lobe(appearance fetched, surface_point surface, slope_lobe lobe) {
    slope_distribution slopes = lobe.slopes;
    if (MODEL == MODEL_MICROFACET && sampled_by_grid())
        return sampled_lobe(fetched, surface, slopes);
    half_vector_distribution half_vectors = half_vectors_of_slopes(slopes);
    if (MODEL == MODEL_HALF_VECTOR_LOBES)
        return lobes_colour() * fetched.filtered.specular *
               reflect_half_vectors(surface, half_vectors);
    return reflect_masked_slopes(surface, half_vectors, fetched.filtered.specular,
                                 BASE_HAS_TAILS ? lobe.base_variance : 0.0);
}

// Adds the irradiance of a lobe's facets over pi and their normals (w: weights). Only masking is
// applied: it is unknown which part of the environment's light from above is shadowed.
void add_lambert_lobe(surface_point surface, slope_lobe lobe, inout vec3 sum, inout vec4 normals) {
    float row = grid_weight();
    for (uint j = 0u; j < GRID; ++j) {
        for (uint k = 0u; k < GRID; ++k) {
            vec2 position = vec2(grid_position(j), grid_position(k));
            vec2 slope = slope_at(lobe.facets, position);
            float weight = lobe.part / (row * row) * exp(-0.5 * dot(position, position)) *
                           max(height_above_slope(slope, surface.outgoing), 0.0);
            vec3 normal = normal_of_slope(slope);
            sum += weight * mean_irradiance(surface, normal);
            normals += weight * vec4(normal, 1.0);
        }
    }
}

vec3 reflect_footprint(appearance fetched, surface_point surface) {
    vec3 sum = vec3(0.0), diffuse = vec3(0.0);
    vec4 normals = vec4(0.0);
    for (uint i = 0u; i < BINS; ++i) {
        slope_lobe lobe = fetched.lobe.lobes[i];
        if (lobe.part < 1.0 / 64.0)
            continue;
        sum += lobe.part * reflect_lobe(fetched, surface, lobe);
        if (DIFFUSE)
            add_lambert_lobe(surface, lobe, diffuse, normals);
    }
    if (DIFFUSE && height_above_slope(fetched.moments.mean, surface.outgoing) > 0.0)
        sum += let_through(surface, fetched.filtered) *
               lambert_sum_from_above(surface, diffuse, normals) /
               (area_ratio(fetched, surface.outgoing, false) *
                divisor_height(fetched, surface.outgoing));
    return sum;
}
#endif
