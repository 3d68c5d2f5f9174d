// Phong peaks that are fitted to the normals under each texel alone: Fournier 1992, Normal
// Distribution Functions and Multiple Surfaces, as Tan et al. 2005 describe it. Nothing is averaged
// between texels: the peaks of all four around, of both levels, are evaluated and weighted, up to
// 56. What they reflect is as in `tan`, to compare the two.

#include "shading/level_0.glsl"
#include "shading/mask.glsl"
#include "filters/mixture/projected.glsl"
#include "lib/lobe/half_vector_lobe.glsl"
#include "lib/map/bilinear_texel.glsl"

struct phong_peak {
    float part; // of the pixel
    vec3 axis;
    float exponent;
};

// One of the texels around.
struct weighted_texel {
    vec2 position; // texture coordinates of its centre
    float level;   // of the filtered map
    float weight;
};

struct appearance {
    base_material base;     // level 0, where it may be seen
    base_material filtered; // averaged over the footprint
    map_area area;
    float base_share; // [0, 1]: how much of the appearance is level 0
    // Sums over the peaks, for each of four lights.
    vec4 specular;
    vec4 cosines;
    // Of the whole pixel.
    vec3 emission;
    bool kept;
    vec3 normal;
    float lobe_count;
    float level;
};

const uint TEXELS = 8u; // four in each of two levels

// Weights are those of a trilinear sampler.
weighted_texel texel_around(map_area area, uint index) {
    float last = float(textureQueryLevels(moment_map) - 1);
    float level = clamp(area.level - 1.0, 0.0, last);
    bool coarser = index >= 4u;
    weighted_texel texel;
    texel.level = min(floor(level) + (coarser ? 1.0 : 0.0), last);
    vec2 size = size_of_level(textureSize(moment_map, 0).xy, texel.level);
    bilinear_texel one = find_bilinear_texel(area.centre, size, index);
    texel.weight = one.weight * (coarser ? fract(level) : 1.0 - fract(level));
    texel.position = one.position;
    return texel;
}

// Of the variance v along each axis, which is (1 + n_z^2) / 2 of that on the sphere once projected,
// the exponent is 1/v - 1: the peak (s + 1) / (2 pi) is then that of a Gaussian, 1 / (2 pi v). Base
// lobes of Blinn-Phong keep their exponents.
phong_peak read_peak(surface_point surface, weighted_texel texel, uint index) {
    projected_lobe lobe =
        lobe_of_sums(textureLod(moment_map, vec3(texel.position, index), texel.level));
    float variance = max(lobe.square / (1.0 + lobe.normal.z * lobe.normal.z) +
                             projected_variance_lacking(), 1e-6) +
                     isotropic_variance(surface.curvature);
    return phong_peak(texel.weight * lobe.part, lobe.normal, max(1.0 / variance - 1.0, 0.0));
}

void take_normal(inout appearance fetched, vec3 mean) {
    fetched.normal = mean_direction(mean, vec3(0.0, 0.0, 1.0));
    fetched.filtered.normal = fetched.normal;
}

appearance fetch_appearance(surface_point surface) {
    appearance result;
    result.area = lobe_area(surface);
    draw_widths(surface);
    bool near = may_see_level_0(lobe_map());
    result.level = FILTERED_LOBES ? result.area.level : 0.0;
    level_0_normals normals = normals_of_level_0(surface, result.area, 1.0);
    result.base_share = FILTERED_LOBES ? share_of_level_0(normals, result.area.share, 1.0) : 1.0;
    result.lobe_count = float(LOBE_COUNT);
    result.normal = unfiltered_normal(surface);
    result.filtered = filtered_material(surface, result.normal, result.area);
    result.base = result.filtered;
    if (FILTERED_LOBES && near)
        result.base = level_0_material(surface, normals);
    result.kept = !ALPHA_MASK || keeps_footprint(surface);
    result.emission = EMISSION ? filtered_emission(surface, result.area) : vec3(0.0);
    return result;
}

void add_peak(inout appearance fetched, surface_point surface, phong_peak peak,
              vec3 incoming[4], vec3 halfway[4]) {
    for (uint k = 0u; k < LIGHTS_AT_ONCE; ++k) {
        float density = peak.part * blinn_phong_lobe(halfway[k], peak.axis, peak.exponent);
        fetched.specular[k] += reflected_density(peak.axis, density, surface.outgoing);
        fetched.cosines[k] += peak.part * max(dot(peak.axis, incoming[k]), 0.0);
    }
}

void gather_lights(inout appearance fetched, surface_point surface, vec3 incoming[4]) {
    if (!FILTERED_LOBES)
        return;
    fetched.specular = fetched.cosines = vec4(0.0);
    fetched.lobe_count = fetched.base_share > 0.0 ? float(LOBE_COUNT) : 0.0;
    float share = 0.0; // of the texels, that a mask keeps
    vec3 mean = vec3(0.0), halfway[4];
    for (int k = 0; k < 4; ++k)
        halfway[k] = half_vector(incoming[k], surface.outgoing);
    for (uint i = 0u; i < TEXELS; ++i) {
        weighted_texel texel = texel_around(fetched.area, i);
        for (uint j = 0u; j < BINS && texel.weight > 0.0; ++j) {
            phong_peak peak = read_peak(surface, texel, j);
            if (peak.part <= 0.0)
                continue;
            add_peak(fetched, surface, peak, incoming, halfway);
            mean += peak.part * peak.axis;
            share += peak.part;
            fetched.lobe_count += 1.0;
        }
    }
    fetched.specular *= per_kept(share);
    fetched.cosines *= per_kept(share);
    take_normal(fetched, mean);
}

vec3 evaluate_appearance(appearance fetched, surface_point surface, vec3 incoming, uint light) {
    if (incoming.z <= 0.0)
        return vec3(0.0);
    vec3 sum = vec3(0.0);
    if (FILTERED_LOBES)
        sum = (1.0 - fetched.base_share) *
              evaluate_projected(fetched.filtered, fetched.specular[light], fetched.cosines[light],
                                 half_vector(incoming, surface.outgoing), incoming);
    if (!FILTERED_LOBES || may_see_level_0(lobe_map()))
        sum += fetched.base_share *
               evaluate_base_material(fetched.base, surface.outgoing, incoming);
    return sum;
}

#ifdef ENVIRONMENT
// Less of a pixel's light is left to the other peaks. Under a mask, of the peaks so far.
const float LEAST_PART = 1.0 / 512.0;

vec3 reflect_peak(appearance fetched, surface_point surface, phong_peak peak) {
    return reflect_projected(surface, fetched.filtered,
                             isotropic_lobe(peak.axis, inversesqrt(peak.exponent + 1.0),
                                            surface.outgoing));
}

vec3 reflect_peaks(inout appearance fetched, surface_point surface) {
    fetched.lobe_count = fetched.base_share > 0.0 ? float(LOBE_COUNT) : 0.0;
    vec3 sum = vec3(0.0), mean = vec3(0.0);
    float reflecting = 0.0, share = 0.0;
    for (uint i = 0u; i < TEXELS; ++i) {
        weighted_texel texel = texel_around(fetched.area, i);
        for (uint j = 0u; j < BINS && texel.weight > 0.0; ++j) {
            phong_peak peak = read_peak(surface, texel, j);
            mean += peak.part * peak.axis;
            share += peak.part;
            if (peak.part < (MASKED_LOBES ? LEAST_PART * share : LEAST_PART))
                continue;
            sum += peak.part * reflect_peak(fetched, surface, peak);
            reflecting += peak.part;
            fetched.lobe_count += 1.0;
        }
    }
    take_normal(fetched, mean);
    sum /= max(reflecting, MASKED_LOBES ? 1e-6 : LEAST_PART);
    if (DIFFUSE)
        sum += reflect_lambert(surface, fetched.filtered, mean * per_kept(share));
    return sum;
}

vec3 reflect_environment(inout appearance fetched, surface_point surface) {
    if (!FILTERED_LOBES)
        return reflect_base_material(surface, fetched.filtered, fetched.filtered.normal);
    vec3 sum = (1.0 - fetched.base_share) * reflect_peaks(fetched, surface);
    if (may_see_level_0(lobe_map()))
        sum += fetched.base_share *
               reflect_base_material(surface, fetched.base, fetched.base.normal);
    return sum;
}
#endif
