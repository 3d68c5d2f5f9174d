#ifndef ENVIRONMENT_BROAD_REFLECTION_GLSL
#define ENVIRONMENT_BROAD_REFLECTION_GLSL

// What rough microfacets gather over the hemisphere of their normal, beside the light of a lobe
// (interface/environment/broad_reflection.h).

#include "environment/environment.glsl"
#include "interface/environment/broad_reflection.h"
#include "lib/light/hemisphere_moments.glsl"

layout(constant_id = SPECIALISE_BROAD_REFLECTION) const uint BROAD_REFLECTION = 0;

layout(LOBE_DESCRIPTOR(40)) uniform sampler2DArray hemisphere_moments_map;
layout(LOBE_DESCRIPTOR(41)) uniform sampler2DArray broad_reflection_table;
#ifdef SLOPE_FILTER
// Of microfacets that the filter has turned into Gaussian slopes.
layout(LOBE_DESCRIPTOR(42)) uniform sampler2DArray slope_broad_reflection_table;
#endif

// For an albedo of 1.
struct broad_part {
    vec4 upright, aside, turned; // coefficients of orders 0; 1 and, last, 2; 2, 3
    float lobe;                  // weight of the lobe
};

vec4 broad_row(uint kind, vec2 place, float layer) {
#ifdef SLOPE_FILTER
    if (kind == DISTRIBUTION_BECKMANN)
        return textureLod(slope_broad_reflection_table, vec3(place, layer), 0.0);
#endif
    return textureLod(broad_reflection_table, vec3(place, layer), 0.0);
}

// `part`: 0 for F_0, 1 for F_90.
broad_part broad_reflection(uint kind, float cosine, float roughness, float part) {
    const float size = float(BROAD_REFLECTION_SIZE);
    float row = (roughness - BROAD_LEAST_ROUGHNESS) / (1.0 - BROAD_LEAST_ROUGHNESS);
    vec2 place = (clamp(vec2(sqrt(max(cosine, 0.0)), row), 0.0, 1.0) * (size - 1.0) + 0.5) / size;
    broad_part result;
    result.upright = broad_row(kind, place, 3.0 * part);
    result.aside = broad_row(kind, place, 3.0 * part + 1.0);
    result.turned = broad_row(kind, place, 3.0 * part + 2.0);
    result.lobe = result.turned.z;
    return result;
}

// The functions' sum as a polynomial, for a unit normal and the unit vector across it on the
// viewer's side: with X and Z the components of a direction along these, and x^2 + y^2 + z^2 = 1,
//   x^2 - y^2 = 2 X^2 + Z^2 - 1,   x^3 - 3 x y^2 = X (4 X^2 + 3 Z^2 - 3).
mat4 polynomial_of(broad_part part, vec3 normal, vec3 aside) {
    mat3 one = mat3(1.0), zz = outerProduct(normal, normal), xx = outerProduct(aside, aside);
    float second = part.aside.w, second_turned = part.turned.x, third = part.turned.y;
    mat3 with_x = (part.aside.x - 3.0 * third) * one + (part.aside.z + 3.0 * third) * zz +
                  (4.0 * third) * xx;
    mat3 with_z = (part.upright.y - second_turned) * one +
                  (part.upright.w + second_turned) * zz + (2.0 * second_turned) * xx;
    mat3 xz = outerProduct(aside, normal);
    mat3 even = (part.upright.x - second) * one + (part.upright.z + second) * zz +
                (2.0 * second) * xx + (0.5 * part.aside.y) * (xz + transpose(xz));
    return cubic_form(aside, with_x) + cubic_form(normal, with_z) + quadratic_form(even);
}

struct broad_light {
    vec3 f0, f90; // light of the parts, for an albedo of 1 each
};

// Gathered about a normal, both of the tangent frame.
broad_light gather_broadly(surface_point surface, vec3 normal, broad_part f0, broad_part f90) {
    vec3 axis = to_environment(surface, normal);
    vec3 aside = to_environment(surface, perpendicular_towards(normal, surface.outgoing));
    hemisphere_moments moments = hemisphere_moments_about(hemisphere_moments_map, axis);
    broad_light light;
    light.f0 = environment.intensity * gathered_light(moments, polynomial_of(f0, axis, aside));
    light.f90 = environment.intensity * gathered_light(moments, polynomial_of(f90, axis, aside));
    return light;
}

#endif
