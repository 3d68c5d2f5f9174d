#ifndef BINS_GLSL
#define BINS_GLSL

// Bins of a map of lobe moments (interface/moment_bins.h) as a pixel sees them, and their sum for a
// light.

#include "filters/moments/texels_seen.glsl"

layout(constant_id = SPECIALISE_BINS) const uint BINS = 1;
layout(constant_id = SPECIALISE_BIN_COLOUR) const bool BIN_COLOUR = false;
layout(constant_id = SPECIALISE_MIRRORED_BINS) const bool MIRRORED_BINS = false;
layout(constant_id = SPECIALISE_BIN_WIDTHS) const bool BIN_WIDTHS = true;

#include "filters/moments/plane_bin.glsl"
#include "filters/moments/mirrored.glsl"

layout(LOBE_DESCRIPTOR(22), std140) uniform binning_block { moment_binning_constants binning; };

float colour_unit() {
    return binning.largest.y * material.largest_colour;
}

// Meshes tint metal, but not what a dielectric reflects (glTF 2.0, appendix B.2: 4 %).
vec3 colour_of_bin(surface_point surface, vec4 fetched) {
    if (MODEL != MODEL_MICROFACET)
        return fetched.rgb;
    vec3 metal = VERTEX_COLOUR ? fetched.rgb * surface.colour.rgb : fetched.rgb;
    return DIELECTRIC_F0 * fetched.a + metal;
}

// What follows the layers of all bins: the mean diffuse colour, and the inverse of how much the
// texels count.
vec4 read_last_layer(map_area area) {
    vec4 last = BIN_COLOUR || MASKED_LOBES
                    ? filtered_layer(moment_map, area, (BIN_COLOUR ? 3u : 2u) * BINS)
                    : vec4(0.0);
    float scale = per_kept(last.w);
    return vec4(scale * colour_unit() * last.rgb, scale);
}

// In place of the one that the map holds, where widths lie apart from the normals.
void take_widths(inout plane_bin bin) {
    float mass;
    own_width_in_plane(mass);
    bin.sharpness = max(drawn_widths.sharpness, 0.4);
    bin.mean_variance = drawn_widths.variance;
    bin.mass *= drawn_widths.mass / mass;
}

// `mass_scale`: as read_last_layer gives it.
plane_bin read_bin(surface_point surface, map_area texels, float mass_scale, uint index) {
    uint layers = BIN_COLOUR ? 3u : 2u;
    vec4 place = moment_layer(texels, layers * index);
    vec4 spread = moment_layer(texels, layers * index + 1u);
    float per_mass = 1.0 / max(place.x, 1e-6), scale = per_mass;
    vec4 range = binning.bins[index].range;
    plane_bin bin;
    if (BIN_COLOUR) {
        vec4 colour = per_mass * moment_layer(texels, layers * index + 2u);
        if (MIRRORED_BINS)
            scale /= mirrored_by(colour, colour_unit());
        bin.colour = colour_of_bin(surface, vec4(colour_unit() * colour.rgb, colour.a));
        bin.dielectric = colour.a;
    }
    bin.mass = mass_scale * place.x * binning.largest.x;
    vec2 mean = place.yz * scale;
    bin.mean = mean * range.z + range.xy;
    bin.axis = direction_from_plane(bin.mean);
    bin.sharpness = max(place.w * scale * range.w, 0.4);
    bin.mean_variance = spread.w * scale * binning.bins[index].shape.w;
    if (WIDTHS_APART)
        take_widths(bin);
    float varies;
    vec2 halves = width_statistics(bin, varies);
    vec3 covariance =
        covariance_of(mean, spread.xyz * scale) * (range.z * range.z) + surface.curvature;
    vec3 base = bin.variance * plane_distortion(bin.mean);
    bin.covariance = covariance + base;
    bin.places = covariance;
    make_terms(bin, covariance, base, halves, varies);
    bin.spread = 0.5 * (covariance.x + covariance.y);
    keep_shape(bin, halves);
    return bin;
}

// The texels' facets at one of the bin's nodes.
mapped_facet facet_of_bin(plane_bin bin, base_material footprint, int node) {
    mapped_facet facet;
    facet.slope = slope_in_plane(bin.mean, bin.places, node);
    facet.f0 = BIN_COLOUR ? bin.colour : footprint.specular;
    facet.diffuse = footprint.diffuse;
    facet.cover = BIN_COLOUR ? vec3(0.0) : footprint.specular;
    facet.width = parameter_of_plane_variance(DISTRIBUTION, bin.variance);
    facet.turn = turn_of_node(node);
    return facet;
}

#endif
