// Moments of lobes in the Lambert plane, in bins. A material's lobes are assigned to a few bins
// fitted to them (see passes/filters/moments/partition.h). Under a pixel each bin is a Gaussian of
// the normals, convolved with the base lobe's own shape. Developed here, after Olano, Baker 2010,
// LEAN Mapping (linear moments), and Vasconcelos, Lippman 1998 (mixtures of mixtures).

#pragma variants CLOSED_SURFACE

#include "shading/level_0.glsl"
#include "shading/mask.glsl"
#include "filters/moments/bins.glsl"
#include "lib/lobe/characteristic_vector.glsl"

#ifdef ENVIRONMENT
#include "environment/reflection.glsl"
#endif

layout(LOBE_DESCRIPTOR(FILTER_KNOB_BINDING), std140) uniform filter_knob_block {
    moments_knobs filter_knobs;
};

struct appearance {
    base_material base;     // level 0, where it may be seen; colours are the footprint's
    base_material filtered; // averaged over the footprint
    map_area area;
    float mass_scale; // of the bins
    float base_share; // [0, 1]: how much of the appearance is level 0
    // Of the texels' normals those that face the viewer, and their share, each by how much of it is
    // Lambert's; of half-vector lobes all.
    normal_spread facing;
    float facing_share;
    light_sum first, second, third, fourth;
    // Of the whole pixel.
    vec3 emission;
    bool kept;
    vec3 normal;
    float lobe_count;
    float level;
};

// Sums over all bins of the footprint.
struct bin_means {
    float mass;
    vec3 axis;
    // Of microfacets, by how much of a bin is Lambert's: of all, and of those that face the viewer.
    float diffuse;
    float facing;
    vec3 normal;
    vec2 place;
    vec3 second_moments;
};

bin_means no_bins() {
    return bin_means(0.0, vec3(0.0), 0.0, 0.0, vec3(0.0), vec2(0.0), vec3(0.0));
}

vec3 bin_half_vector(surface_point surface, vec3 incoming) {
    return half_vector(incoming, surface.outgoing);
}

light_sum no_light() {
    return light_sum(0.0, vec2(0.0), vec3(0.0), 0.0, vec3(0.0), vec3(0.0), 0.0, 0.0);
}

// The mean normal of the texels, from the mean axis of their lobes: lobes turn with the normals,
//   axis_z = n_z l_z - <n_xy, l_xy>,   axis_xy = l_xy + n_xy l_z + ...,
// l the mean of the base lobes' directions about the pole; the rest is quadratic in n_xy and l_xy.
vec3 normal_from_axis(vec3 axis) {
    if (MODEL == MODEL_MICROFACET)
        return axis;
    vec3 local = vec3(0.0);
    for (int i = 0; i < LOBE_COUNT; ++i)
        local += material.lobe_colour[i].w * material.lobe_direction[i].xyz;
    float height = max(local.z, 0.1);
    vec2 planar = (axis.xy - local.xy) / height;
    return vec3(planar, (axis.z + dot(planar, local.xy)) / height);
}

void add_facing(inout bin_means means, normal_spread facing, float weight) {
    means.facing += weight;
    means.normal += weight * facing.mean;
    means.place += weight * facing.place;
    means.second_moments += weight * (facing.covariance + second_moments_of(facing.place));
}

void add_to_means(inout bin_means means, plane_bin bin, vec3 outgoing) {
    means.mass += bin.mass;
    // The mean of 1 - |q|^2 / 2 is exactly the mean of the directions' third coordinate.
    vec3 axis = vec3(bin.axis.xy, bin.axis.z - bin.spread);
    means.axis += bin.mass * axis;
    if (MODEL == MODEL_MICROFACET && DIFFUSE && !CLOSED) {
        float diffuse = part_of_bin(bin) * (BIN_COLOUR ? bin.dielectric : 1.0), share;
        normal_spread facing =
            facing_normals(normal_spread(axis, bin.mean, bin.places), outgoing, share);
        means.diffuse += diffuse;
        add_facing(means, facing, diffuse * share);
    }
}

// The normals whose Lambert part is seen. Level 0 is one more of them.
void take_facing(inout appearance fetched, surface_point surface, bin_means means) {
    float scale = 1.0 / max(means.diffuse, 1e-20);
    if (may_see_level_0(lobe_map())) {
        vec3 normal = fetched.base.normal;
        float share = dot(normal, surface.outgoing) > 0.0 ? fetched.base_share : 0.0;
        scale *= 1.0 - fetched.base_share;
        means.facing *= scale;
        means.normal *= scale;
        means.place *= scale;
        means.second_moments *= scale;
        scale = 1.0;
        add_facing(means, normal_spread(normal, plane_from_direction(normal), vec3(0.0)), share);
    }
    fetched.facing_share = scale * means.facing;
    float per_facing = 1.0 / max(means.facing, 1e-20);
    fetched.facing.mean = per_facing * means.normal;
    fetched.facing.place = per_facing * means.place;
    fetched.facing.covariance =
        covariance_of(fetched.facing.place, per_facing * means.second_moments);
}

// Sets the footprint's normals from the sums over the bins.
void take_means(inout appearance fetched, surface_point surface, bin_means means) {
    vec3 normal = normal_from_axis(means.axis / max(means.mass, 1e-6));
    if (may_see_level_0(lobe_map()))
        normal = mix(normal, fetched.base.normal, fetched.base_share);
    fetched.normal = mean_direction(normal, vec3(0.0, 0.0, 1.0));
    fetched.filtered.normal = fetched.normal;
    fetched.facing = normal_spread(normal, vec2(0.0), vec3(0.0));
    fetched.facing_share = 1.0;
    if (MODEL == MODEL_MICROFACET && DIFFUSE && !CLOSED)
        take_facing(fetched, surface, means);
}

// Of closed surfaces, what the bin's facets exchange, and their Lambert part.
void add_exchange(inout appearance fetched, surface_point surface, plane_bin bin,
                  vec3 incoming[4]) {
    float part = part_of_bin(bin) / float(SLOPE_NODES);
    for (int i = 0; i < SLOPE_NODES; ++i) {
        mapped_facet facet = facet_of_bin(bin, fetched.filtered, i);
        facet_exchange exchange = exchange_seen(facet, surface.outgoing);
        fetched.first.exchanged_and_diffuse +=
            part * exchanged_and_diffuse(facet, exchange, surface.outgoing, incoming[0]);
        if (LIGHTS_AT_ONCE > 1u)
            fetched.second.exchanged_and_diffuse +=
                part * exchanged_and_diffuse(facet, exchange, surface.outgoing, incoming[1]);
        if (LIGHTS_AT_ONCE > 2u)
            fetched.third.exchanged_and_diffuse +=
                part * exchanged_and_diffuse(facet, exchange, surface.outgoing, incoming[2]);
        if (LIGHTS_AT_ONCE > 3u)
            fetched.fourth.exchanged_and_diffuse +=
                part * exchanged_and_diffuse(facet, exchange, surface.outgoing, incoming[3]);
    }
}

void add_bin(inout light_sum sum, plane_bin bin, vec3 halfway, vec2 place, surface_point surface,
             vec3 incoming) {
    if (MODEL == MODEL_MICROFACET && !CLOSED)
        add_masked_bin(sum, bin, halfway, place, surface.outgoing, incoming);
    else
        add_bin_to_light(sum, bin, halfway, place);
}

// The bins of one texel, or of the blend of several: of what `texels` fetches, which has this
// weight.
void gather_bins(inout appearance fetched, inout bin_means means, surface_point surface,
                 map_area texels, float weight, vec3 incoming[4], vec3 halfway[4],
                 vec2 places[4]) {
    for (uint i = 0u; i < BINS; ++i) {
        plane_bin bin = read_bin(surface, texels, weight * fetched.mass_scale, i);
        // A footprint's lobes together have a mass of at least one.
        if (bin.mass <= weight * filter_knobs.least_share)
            continue;
        add_to_means(means, bin, surface.outgoing);
        fetched.lobe_count += 1.0;
        add_bin(fetched.first, bin, halfway[0], places[0], surface, incoming[0]);
        if (LIGHTS_AT_ONCE > 1u)
            add_bin(fetched.second, bin, halfway[1], places[1], surface, incoming[1]);
        if (LIGHTS_AT_ONCE > 2u)
            add_bin(fetched.third, bin, halfway[2], places[2], surface, incoming[2]);
        if (LIGHTS_AT_ONCE > 3u)
            add_bin(fetched.fourth, bin, halfway[3], places[3], surface, incoming[3]);
        if (CLOSED)
            add_exchange(fetched, surface, bin, incoming);
    }
}

void gather_lights(inout appearance fetched, surface_point surface, vec3 incoming[4]) {
    if (!FILTERED_LOBES)
        return;
    vec3 halfway[4];
    vec2 places[4];
    for (int i = 0; i < 4; ++i) {
        halfway[i] = bin_half_vector(surface, incoming[i]);
        places[i] = plane_from_direction(halfway[i]);
    }
    fetched.first = fetched.second = fetched.third = fetched.fourth = no_light();
    fetched.lobe_count = fetched.base_share > 0.0 ? float(LOBE_COUNT) : 0.0;
    bin_means means = no_bins();
    texels_seen seen = find_texels(fetched.area);
    for (uint i = 0u; i < seen.count; ++i) {
        float weight;
        map_area texels = area_of_texel(fetched.area, seen, i, weight);
        if (weight > 0.0)
            gather_bins(fetched, means, surface, texels, weight, incoming, halfway, places);
    }
    take_means(fetched, surface, means);
}

// Colours of the footprint. Where bins have their own, these are means of the texels' reflection,
// not the reflection of mean parameters.
// `last`: of the map, see read_last_layer.
base_material footprint_material(surface_point surface, vec3 normal, map_area area, vec4 last) {
    if (!(FILTERED_LOBES && BIN_COLOUR))
        return filtered_material(surface, normal, area);
    base_material base;
    base.normal = normal;
    base.diffuse = last.rgb;
    if (VERTEX_COLOUR) {
        // Of d (1 - m)(1 - F0), which the map has, F0's part d m is tinted, too.
        vec3 tint = surface.colour.rgb;
        base.diffuse *= tint;
        if (MODEL == MODEL_MICROFACET)
            base.diffuse += (1.0 / max(tint, vec3(1e-3)) - 1.0) * covered_by_metal(surface, area);
    }
    base.specular = vec3(0.0); // each bin has its own
    base.width = 1.0;          // each bin has its own
    return base;
}

appearance fetch_appearance(surface_point surface) {
    appearance result;
    result.area = lobe_area(surface);
    result.base_share = 1.0;
    result.lobe_count = float(LOBE_COUNT);
    result.level = 0.0;
    result.normal = unfiltered_normal(surface);
    vec4 last = FILTERED_LOBES ? read_last_layer(result.area) : vec4(0.0);
    result.mass_scale = last.w;
    result.filtered = footprint_material(surface, result.normal, result.area, last);
    draw_widths(surface);
    if (FILTERED_LOBES) {
        result.level = result.area.level;
        level_0_normals normals = normals_of_level_0(surface, result.area, 1.0);
        result.base_share = share_of_level_0(normals, result.area.share, 1.0 / result.mass_scale);
        if (may_see_level_0(lobe_map()))
            result.base = level_0_material(surface, normals);
    }
    result.kept = !ALPHA_MASK || keeps_footprint(surface);
    result.emission = EMISSION ? filtered_emission(surface, result.area) : vec3(0.0);
    return result;
}

light_sum sum_of_light(appearance fetched, uint light) {
    return light == 0u   ? fetched.first
           : light == 1u ? fetched.second
           : light == 2u ? fetched.third
                         : fetched.fourth;
}

// The diffuse colour of the footprint, or of level 0, times 1 - F0.
vec3 diffuse_below_bins(appearance fetched) {
    vec3 diffuse = fetched.filtered.diffuse;
    if (may_see_level_0(lobe_map()))
        diffuse = mix(diffuse, fetched.base.diffuse * (1.0 - fetched.base.specular),
                      fetched.base_share);
    return diffuse;
}

// Metal has no diffuse colour, so that the mean of diffuse colours must not be dimmed by what metal
// reflects: 1 - F = (1 - F0)(1 - (1 - c)^5), and texels' 1 - F0 are part of the mean.
vec3 evaluate_bin_diffuse(appearance fetched, vec3 fresnel, vec3 halfway, vec3 incoming) {
    if (!DIFFUSE)
        return vec3(0.0);
    float cosine = fetched.facing_share * mean_facing_cosine(fetched.facing, incoming);
    vec3 let_through =
        BIN_COLOUR ? fresnel_schlick(vec3(0.0), vec3(1.0), dot(incoming, halfway)) : fresnel;
    return microfacet_diffuse(BIN_COLOUR ? diffuse_below_bins(fetched) : fetched.filtered.diffuse,
                              let_through, cosine);
}

// Masking of the microfacets and of the facets of a closed surface, over 4 <n, omega_o>: mean of
// the texels that reflect. All of their spread counts: at grazing angles both fall off on either
// side of the surface's own normal.
float mean_visibility(normal_spread normals, float width, vec3 outgoing, vec3 incoming) {
    float sum = 0.0;
    for (int i = 0; i < SLOPE_NODES; ++i)
        sum += visibility_of_texel(slope_in_plane(normals.place, normals.covariance, i), width,
                                   outgoing, incoming);
    return sum / float(SLOPE_NODES);
}

// Of a closed surface's bins, without what they exchange.
vec3 evaluate_closed_specular(appearance fetched, light_sum sum, vec3 halfway, vec3 outgoing,
                              vec3 incoming) {
    float scale = 1.0 / max(sum.distribution, 1e-20);
    float sharpness = max(sum.sharpness * scale, 0.4);
    float width = parameter_of_plane_variance(DISTRIBUTION, 1.0 / (sharpness * sharpness));
    vec3 f0 = BIN_COLOUR ? sum.colour * scale : fetched.filtered.specular;
    normal_spread normals = normal_spread_of(scale * sum.place, scale * sum.second_moments);
    float outgoing_cosine = facing_cosines_of(normals, incoming, outgoing).outgoing;
    return scattering_scale(f0, outgoing_cosine, width) *
           fresnel_schlick(f0, vec3(1.0), dot(incoming, halfway)) *
           (sum.distribution * mean_visibility(normals, width, outgoing, incoming));
}

// What level 0 reflects, without Lambert's part.
vec3 evaluate_level_0_specular(appearance fetched, vec3 outgoing, vec3 incoming) {
    base_material base = fetched.base;
    base.diffuse = vec3(0.0);
    if (!BIN_COLOUR)
        base.specular = fetched.filtered.specular;
    return evaluate_base_material(base, base.normal, outgoing, incoming);
}

// Without Lambert's part.
vec3 evaluate_bin_specular(appearance fetched, light_sum sum, vec3 halfway, vec3 outgoing,
                           vec3 incoming, out vec3 fresnel) {
    float scale = 1.0 / max(sum.reflected, 1e-20);
    float sharpness = max(sum.sharpness * scale, 0.4);
    float width = parameter_of_plane_variance(DISTRIBUTION, 1.0 / (sharpness * sharpness));
    vec3 f0 = BIN_COLOUR ? sum.colour * scale : fetched.filtered.specular;
    fresnel = fresnel_schlick(f0, vec3(1.0), dot(incoming, halfway));
    vec3 value = scattering_scale(f0, sum.outgoing * scale, width) * fresnel * sum.reflected;
    if (may_see_level_0(lobe_map()))
        value = mix(value, evaluate_level_0_specular(fetched, outgoing, incoming),
                    fetched.base_share);
    return value;
}

vec3 evaluate_bin_microfacets(appearance fetched, light_sum sum, vec3 halfway, vec3 outgoing,
                              vec3 incoming) {
    vec3 fresnel;
    vec3 specular = evaluate_bin_specular(fetched, sum, halfway, outgoing, incoming, fresnel);
    return specular + evaluate_bin_diffuse(fetched, fresnel, halfway, incoming);
}

vec3 evaluate_closed_bins(appearance fetched, light_sum sum, vec3 halfway, vec3 outgoing,
                          vec3 incoming) {
    vec3 value = evaluate_closed_specular(fetched, sum, halfway, outgoing, incoming) +
                 sum.exchanged_and_diffuse;
    if (may_see_level_0(lobe_map()))
        value = mix(value, evaluate_base_material(fetched.base, outgoing, incoming),
                    fetched.base_share);
    return value;
}

vec3 evaluate_bin_lobes(appearance fetched, light_sum sum, vec3 halfway, vec3 incoming) {
    vec3 value = BIN_COLOUR
                     ? sum.colour
                     : fetched.filtered.specular * lobes_colour() * sum.distribution;
    vec3 diffuse = fetched.filtered.diffuse;
    value *= 1.0 - fetched.base_share;
    if (may_see_level_0(lobe_map())) {
        value += fetched.base_share * fetched.base.specular *
                 evaluate_half_vector_lobes(fetched.base, halfway);
        diffuse = mix(diffuse, fetched.base.diffuse, fetched.base_share);
    }
    if (DIFFUSE)
        value += microfacet_diffuse(diffuse, vec3(0.0), dot(fetched.facing.mean, incoming));
    return value;
}

vec3 evaluate_appearance(appearance fetched, surface_point surface, vec3 incoming, uint light) {
    if (!FILTERED_LOBES)
        return evaluate_base_material(fetched.filtered, surface.outgoing, incoming);
    if (incoming.z <= 0.0)
        return vec3(0.0);
    vec3 halfway = bin_half_vector(surface, incoming);
    light_sum sum = sum_of_light(fetched, light);
    if (CLOSED)
        return evaluate_closed_bins(fetched, sum, halfway, surface.outgoing, incoming);
    return MODEL == MODEL_MICROFACET
               ? evaluate_bin_microfacets(fetched, sum, halfway, surface.outgoing, incoming)
               : evaluate_bin_lobes(fetched, sum, halfway, incoming);
}

#ifdef ENVIRONMENT
vec3 reflect_closed_bin(appearance fetched, surface_point surface, plane_bin bin, vec3 f0) {
    facet_sum sum = no_facets();
    for (int i = 0; i < SLOPE_NODES; ++i)
        add_facet(sum, surface, facet_of_bin(bin, fetched.filtered, i));
    return reflect_facets(surface, sum, distribution_kind(), f0,
                          parameter_of_plane_variance(DISTRIBUTION, bin.variance));
}

// As gather_bins.
vec3 reflect_texel(inout appearance fetched, inout bin_means means, surface_point surface,
                   map_area texels, float weight) {
    vec3 sum = vec3(0.0);
    for (uint i = 0u; i < BINS; ++i) {
        plane_bin bin = read_bin(surface, texels, weight * fetched.mass_scale, i);
        if (bin.mass <= weight * filter_knobs.least_share)
            continue;
        add_to_means(means, bin, surface.outgoing);
        fetched.lobe_count += 1.0;
        vec3 f0 = BIN_COLOUR ? bin.colour : fetched.filtered.specular;
        vec3 reflected = CLOSED ? reflect_closed_bin(fetched, surface, bin, f0)
                                : reflect_bin(surface, bin, f0, VIEW_OF_BIN);
        reflected *= part_of_bin(bin);
        if (MODEL == MODEL_HALF_VECTOR_LOBES)
            reflected *= BIN_COLOUR ? bin.colour : fetched.filtered.specular * lobes_colour();
        sum += reflected;
    }
    return sum;
}

vec3 reflect_bins(inout appearance fetched, surface_point surface) {
    vec3 sum = vec3(0.0);
    bin_means means = no_bins();
    fetched.lobe_count = fetched.base_share > 0.0 ? float(LOBE_COUNT) : 0.0;
    texels_seen seen = find_texels(fetched.area);
    for (uint i = 0u; i < seen.count; ++i) {
        float weight;
        map_area texels = area_of_texel(fetched.area, seen, i, weight);
        if (weight > 0.0)
            sum += reflect_texel(fetched, means, surface, texels, weight);
    }
    take_means(fetched, surface, means);
    return (1.0 - fetched.base_share) * sum;
}

vec3 reflect_environment(inout appearance fetched, surface_point surface) {
    if (!FILTERED_LOBES)
        return reflect_base_material(surface, fetched.filtered, fetched.filtered.normal);
    vec3 sum = reflect_bins(fetched, surface);
    if (CLOSED)
        return sum + (may_see_level_0(lobe_map())
                          ? fetched.base_share *
                                reflect_base_material(surface, fetched.base, fetched.base.normal)
                          : vec3(0.0));
    base_material frame = fetched.filtered;
    if (may_see_level_0(lobe_map())) {
        base_material base = fetched.base;
        if (BIN_COLOUR)
            frame.diffuse = MODEL == MODEL_MICROFACET
                                ? diffuse_below_bins(fetched)
                                : mix(frame.diffuse, base.diffuse, fetched.base_share);
        else
            base.specular = frame.specular;
        sum += fetched.base_share * reflect_base_specular(surface, base);
    }
    if (DIFFUSE) {
        if (MODEL == MODEL_MICROFACET)
            frame.normal = mean_direction(fetched.facing.mean, frame.normal);
        sum += fetched.facing_share * reflect_lambert(surface, frame, fetched.facing.mean);
    }
    return sum;
}
#endif
