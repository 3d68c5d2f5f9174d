#ifndef COLOUR_NORMALS_GLSL
#define COLOUR_NORMALS_GLSL

// What diffuse colours that go with normals reflect beyond the product of means, which filters
// evaluate. Of normally distributed normals the mean of d max(<n, l>, 0) is
//   E[d] E[max(<n, l>, 0)] + <Cov(d, n), l> P(<n, l> > 0):
// Stein, 1981, Estimation of the Mean of a Multivariate Normal Distribution, lemma 1. For light
// from all around the same holds with the gradient of irradiance in place of l and P.
//
// Under a mask all of these, and what filters have, are means over what it keeps.
//
// Included after the filter. One that filters no maps has nothing to add.

#ifdef FILTERED_MAPS_GLSL

#include "interface/colours/colour_correlation.h"
#include "interface/mirrored.h"
#include "lib/lobe/direction_lobe.glsl"
#include "lib/lobe/half_vector_lobe.glsl"
#include "lib/microfacet/microfacet.glsl"

#ifdef ENVIRONMENT
#include "environment/irradiance.glsl"
#endif

layout(constant_id = SPECIALISE_COLOUR_NORMALS) const bool COLOUR_NORMALS = false;

layout(LOBE_DESCRIPTOR(47)) uniform sampler2DArray colour_normal_map;
layout(LOBE_DESCRIPTOR(48), std140) uniform correlation_block {
    colour_correlation_found correlation;
};

// Facets of closed surfaces are masked one by one, of which this knows nothing.
const bool COLOURS_TURN = COLOUR_NORMALS && DIFFUSE && !CLOSED;

struct colour_normals {
    mat3 covariance; // columns: of each channel with the normal
    vec3 colour; // mean diffuse colour
    vec3 mean;   // normal
};
colour_normals drawn_colours;

// The device finds it where texels change; then there is no map to read.
bool colours_turn() {
    return COLOURS_TURN && correlation.follow != 0u;
}

// Of normals of this mean, in any direction across it.
float normal_deviation(vec3 mean) {
    return sqrt(max(0.5 - 0.5 * dot(mean, mean), 1e-4));
}

// Mean of max(<n, l>, 0) over normals of this mean.
float mean_cosine(vec3 mean, vec3 incoming) {
    return mean_above_zero(dot(mean, incoming), normal_deviation(mean));
}

void fetch_colour_normals(surface_point surface) {
    if (!colours_turn())
        return;
    map_area area = lobe_area(surface);
    vec3 factor = material.base_colour.rgb * (VERTEX_COLOUR ? surface.colour.rgb : vec3(1.0));
    if (MODEL == MODEL_MICROFACET && !METALLIC_MAP)
        factor *= 1.0 - material.metallic;
    // A texel of level 0 has one colour and one normal.
    float share = may_see_level_0(lobe_map()) ? area.share : 1.0;
    vec4 mean = filtered_layer(colour_normal_map, area, COLOUR_NORMALS_MEAN);
    float scale = per_kept(mean.w);
    drawn_colours.mean = scale * mean.xyz;
    for (uint k = 0u; k < 3u; ++k) {
        vec4 own = scale * filtered_layer(colour_normal_map, area, k);
        drawn_colours.covariance[k] =
            share * factor[k] * (own.xyz - own.w * drawn_colours.mean);
        drawn_colours.colour[k] = factor[k] * own.w;
    }
}

// `reflected`: reflectance times cosine of the means. Where the filter has less than the mean of
// max(<n, l>, 0), as under low light those have that take the cosine of the mean normal, it is not
// darkened below what it should have.
vec3 add_colour_normals(vec3 reflected, surface_point surface, vec3 incoming) {
    if (!colours_turn() || incoming.z <= 0.0)
        return reflected;
    vec3 let_through = vec3(INVERSE_PI);
    if (MODEL == MODEL_MICROFACET)
        let_through *=
            1.0 - fresnel_schlick(vec3(DIELECTRIC_F0), vec3(1.0),
                                  dot(incoming, half_vector(incoming, surface.outgoing)));
    vec3 mean = drawn_colours.mean, colour = let_through * drawn_colours.colour;
    float facing = normal_below(dot(mean, incoming) / normal_deviation(mean));
    vec3 growth = facing * let_through * (incoming * drawn_colours.covariance);
    vec3 means = mean_cosine(mean, incoming) * colour;
    vec3 loss = min(growth + max(means - reflected, 0.0), 0.0);
    return max(reflected + max(growth, loss), 0.0);
}

#ifdef ENVIRONMENT
// The irradiance over pi grows by this much as normals turn towards a direction across the mean.
vec3 irradiance_growth(surface_point surface, float size, vec3 axis, vec3 across) {
    const float STEP = 0.25;
    return (mean_irradiance(surface, size * normalize(axis + STEP * across)) -
            mean_irradiance(surface, size * normalize(axis - STEP * across))) /
           (2.0 * STEP);
}

// `reflected`: radiance of the environment by the means. Along the mean it is the length that
// grows: normals spread less.
vec3 add_colour_normals_of_environment(vec3 reflected, surface_point surface) {
    const float STEP = 0.25;
    if (!colours_turn())
        return reflected;
    float size = max(length(drawn_colours.mean), 1e-4);
    vec3 axis = drawn_colours.mean / size;
    vec3 first = perpendicular_towards(axis, vec3(1.0, 0.0, 0.0)), second = cross(axis, first);
    vec3 along = (mean_irradiance(surface, size * axis) -
                  mean_irradiance(surface, max(size - STEP, 0.0) * axis)) /
                 STEP;
    reflected +=
        along * (axis * drawn_colours.covariance) +
        irradiance_growth(surface, size, axis, first) * (first * drawn_colours.covariance) +
        irradiance_growth(surface, size, axis, second) * (second * drawn_colours.covariance);
    return max(reflected, 0.0);
}
#endif

#else

void fetch_colour_normals(surface_point surface) {
}

vec3 add_colour_normals(vec3 reflected, surface_point surface, vec3 incoming) {
    return reflected;
}

vec3 add_colour_normals_of_environment(vec3 reflected, surface_point surface) {
    return reflected;
}

#endif

#endif
