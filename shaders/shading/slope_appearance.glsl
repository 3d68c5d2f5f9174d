#ifndef SLOPE_APPEARANCE_GLSL
#define SLOPE_APPEARANCE_GLSL

// Shading from slope moments. Level 0 of the maps is the base material itself. A file in filters/
// defines, the structure before it includes this file:
//
//   struct footprint_lobe                         what its lobe is made of
//   footprint_lobe fetch_lobe(map_area, surface_point, out slope_moments)
//                                                 and the moments of all slopes
//   void mask_by_triangles(inout footprint_lobe, inout slope_moments, map_area, surface_point)
//                                                 for displaced geometry
//   void gather_footprint(inout appearance, surface_point, vec3 incoming[4])
//   vec3 evaluate_footprint(appearance, vec3 outgoing, vec3 incoming, uint light)
//                                                 like gather_lights and evaluate_appearance

#include "shading/mask.glsl"
#include "shading/slope_maps.glsl"

struct appearance {
    base_material base;     // level 0, where it may be seen
    base_material filtered; // averaged over the footprint
    slope_moments moments;
    footprint_lobe lobe;
    float base_share; // [0, 1]: how much of the appearance is level 0
    vec4 gathered;    // what the filter keeps for each of the lights gathered last
    vec3 emission;
    bool kept;
    vec3 normal;
    float lobe_count;
    float level;
};

footprint_lobe fetch_lobe(map_area area, surface_point surface, out slope_moments moments);
void mask_by_triangles(inout footprint_lobe lobe, inout slope_moments moments, map_area area,
                       surface_point surface);
void gather_footprint(inout appearance fetched, surface_point surface, vec3 incoming[4]);
vec3 evaluate_footprint(appearance fetched, vec3 outgoing, vec3 incoming, uint light);

void fetch_base(inout appearance fetched, map_area area, surface_point surface) {
    level_0_normals normals = normals_of_level_0(surface, area, height_scale());
    fetched.base_share = share_of_level_0(normals, area.share, fetched.moments.kept);
    fetched.base = level_0_material(surface, normals);
    // Under its own F0, not that of the footprint, where these differ.
    if (METAL_MEANS == METAL_MEANS_NONE)
        fetched.base.diffuse = fetched.filtered.diffuse;
    if (MODEL == MODEL_HALF_VECTOR_LOBES)
        fetched.base.specular = fetched.filtered.specular;
}

appearance fetch_appearance(surface_point surface) {
    appearance result;
    map_area area = lobe_area(surface);
    result.base_share = 1.0;
    result.level = 0.0;
    if (FILTERED_LOBES) {
        result.level = area.level;
        result.base_share = 0.0;
        result.lobe = fetch_lobe(area, surface, result.moments);
        if (DISPLACED)
            mask_by_triangles(result.lobe, result.moments, area, surface);
        result.normal = normal_of_slope(result.moments.mean);
    } else {
        result.normal = scaled_normal(unfiltered_normal(surface));
    }
    result.filtered = filtered_material(surface, result.normal, area);
    if (FILTERED_LOBES && may_see_level_0(lobe_map()))
        fetch_base(result, area, surface);
    if (FILTERED_LOBES && MODEL == MODEL_MICROFACET)
        result.filtered.width =
            base_lobe_of_concentration(DISTRIBUTION, 1.0 / result.moments.base_variance);
    result.gathered = vec4(0.0);
    result.kept = !ALPHA_MASK || keeps_footprint(surface);
    result.emission = EMISSION ? filtered_emission(surface, area) : vec3(0.0);
    result.lobe_count = (result.base_share > 0.0 ? float(LOBE_COUNT) : 0.0) +
                        (result.base_share < 1.0 ? 1.0 : 0.0);
    return result;
}

void gather_lights(inout appearance fetched, surface_point surface, vec3 incoming[4]) {
    if (FILTERED_LOBES)
        gather_footprint(fetched, surface, incoming);
}

vec3 evaluate_appearance(appearance fetched, surface_point surface, vec3 incoming, uint light) {
    if (!FILTERED_LOBES)
        return evaluate_base_material(fetched.filtered, surface.outgoing, incoming);
    if (!arrives(incoming))
        return vec3(0.0);
    vec3 sum = evaluate_footprint(fetched, surface.outgoing, incoming, light);
    if (may_see_level_0(lobe_map()))
        sum = mix(sum, evaluate_base_material(fetched.base, surface.outgoing, incoming),
                  fetched.base_share);
    return sum;
}

#ifdef ENVIRONMENT
// Like evaluate_footprint, for light from the environment: defined by the filter.
vec3 reflect_footprint(appearance fetched, surface_point surface);

vec3 reflect_environment(appearance fetched, surface_point surface) {
    if (!FILTERED_LOBES)
        return reflect_base_material(surface, fetched.filtered, fetched.filtered.normal);
    vec3 sum = reflect_footprint(fetched, surface);
    if (may_see_level_0(lobe_map()))
        sum = mix(sum, reflect_base_material(surface, fetched.base, fetched.base.normal),
                  fetched.base_share);
    return sum;
}
#endif

#endif
