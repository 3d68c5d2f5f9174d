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
};

vec3 scaled_normal(vec3 normal) {
    float height = height_scale();
    return height == 1.0 ? normal : normalize(vec3(height * normal.xy, normal.z));
}

// Dupuy et al. 2013, section 4.2, height scaling: first moments are multiplied by the factor,
// second ones by its square.
//
// The covariance of the surface's own curvature is added: slopes about the normal are differences
// of normals.
slope_moments moments_of_layers(vec4 first, vec4 second, surface_point surface) {
    float height = height_scale();
    slope_moments result;
    result.mean = height * first.xy;
    result.covariance =
        height * height * covariance_of_moments(first.xy, second.xyz) + surface.curvature;
    result.mean_cosine = first.z;
    result.base_variance = max(first.w, 1.0 / CONCENTRATION_MAXIMUM);
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

// Moments over a square of a level.
slope_moments fetch_level(vec2 centre, float level, surface_point surface) {
    float fetched = max(level - 1.0, 0.0);
    return moments_of_layers(textureLod(moment_map, vec3(centre, SLOPE_LAYER_FIRST), fetched),
                             textureLod(moment_map, vec3(centre, SLOPE_LAYER_SECOND), fetched),
                             surface);
}

#endif
