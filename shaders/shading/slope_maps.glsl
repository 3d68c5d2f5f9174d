#ifndef SLOPE_MAPS_GLSL
#define SLOPE_MAPS_GLSL

// Reading maps of slope moments over a pixel's footprint.

// Filters with these maps turn microfacets into Gaussian slopes.
#define SLOPE_FILTER

#include "shading/level_0.glsl"
#include "interface/slope_moments.h"
#include "lib/lobe/characteristic_vector.glsl"
#include "lib/microfacet/slope_distribution.glsl"
#include "lib/microfacet/tilted_slopes.glsl"
#include "lib/map/slope_stretch.glsl"

#ifdef ENVIRONMENT
#include "environment/reflection.glsl"
#endif


// Factor of all slopes: defined by the filter.
float height_scale();

layout(LOBE_DESCRIPTOR(16)) uniform sampler2DArray moment_map;

// Moments of the directions in a footprint and of the base lobes about them.
struct slope_moments {
    vec2 mean;
    vec3 covariance;     // (xx, yy, xy), of the directions alone
    float mean_cosine;   // mean n_z
    float base_variance; // of the base lobes, mean alpha^2/2
    float kept;          // how much the texels count
};

// Of slopes. `mean`: as maps hold it.
float base_variance_of(float mean, surface_point surface) {
    if (WIDTHS_APART)
        mean = 0.5 * fetch_width_means(surface).alpha_square;
    return max(mean, 1.0 / CONCENTRATION_MAXIMUM);
}

vec3 scaled_normal(vec3 normal) {
    float height = height_scale();
    return height == 1.0 ? normal : normalize(vec3(height * normal.xy, normal.z));
}

// Slopes of a relief on a stretched map, see lib/map/slope_stretch.glsl, as steep as a map can hold
// at most. Cosines fall as those of slopes with that mean square do.
void stretch_moments(inout slope_moments moments, surface_point surface) {
    if (!STRETCHED)
        return;
    vec3 square = moments.covariance + vec3(moments.mean * moments.mean, 0.0);
    moments.mean = surface.stretch * moments.mean;
    moments.mean *= min(1.0, SLOPE_MAXIMUM / max(length(moments.mean), 1e-30));
    moments.covariance = stretched_covariance(surface.stretch, moments.covariance);
    float largest = max(moments.covariance.x, moments.covariance.y);
    moments.covariance *= min(1.0, SLOPE_MAXIMUM * SLOPE_MAXIMUM / max(largest, 1e-30));
    vec3 stretched = moments.covariance + vec3(moments.mean * moments.mean, 0.0);
    moments.mean_cosine *=
        sqrt((1.0 + square.x + square.y) / (1.0 + stretched.x + stretched.y));
}

// Dupuy et al. 2013, section 4.2, height scaling: first moments are multiplied by the factor,
// second ones by its square.
//
// The covariance of the surface's own curvature is added: slopes about the normal are differences
// of normals.
slope_moments moments_of_layers(vec4 first, vec4 second, surface_point surface) {
    float height = height_scale();
    float kept = second.w;
    first *= per_kept(kept);
    second *= per_kept(kept);
    slope_moments result;
    result.kept = MASKED_LOBES ? kept : 1.0;
    result.mean = height * first.xy;
    result.covariance = height * height * covariance_of_moments(first.xy, second.xyz);
    result.mean_cosine = first.z;
    result.base_variance = base_variance_of(first.w, surface);
    stretch_moments(result, surface);
    result.covariance += surface.curvature;
    return result;
}

slope_moments fetch_moments(map_area area, surface_point surface) {
    return moments_of_layers(filtered_layer(moment_map, area, SLOPE_LAYER_FIRST),
                             filtered_layer(moment_map, area, SLOPE_LAYER_SECOND), surface);
}

// The level whose texels are as large as vertices of displaced geometry are apart: of the pixel's
// width, as its length is that of the triangle's tilt.
float level_of_vertices(surface_point surface) {
    int map = lobe_map();
    vec2 size = lobe_map_size();
    footprint pixel = footprint_of(map_coordinates(map, surface.coordinates_dx, 0.0) * size,
                                   map_coordinates(map, surface.coordinates_dy, 0.0) * size);
    return max(log2(max(surface.vertex_spacing * pixel.minor_axis, 1.0)), 0.0);
}

// Moments over a square of a level. A texel's slopes do not vary.
slope_moments fetch_level(vec2 centre, float level, surface_point surface) {
    float fetched = max(level - 1.0, 0.0);
    slope_moments moments =
        moments_of_layers(textureLod(moment_map, vec3(centre, SLOPE_LAYER_FIRST), fetched),
                          textureLod(moment_map, vec3(centre, SLOPE_LAYER_SECOND), fetched),
                          surface);
    moments.covariance *= min(level, 1.0);
    return moments;
}

#endif
