// MIP-mapped mixtures of lobes: Xu et al. 2017, Real-Time Linear BRDF MIP-Mapping, Algorithm 1,
// repaired: a cluster's vector is divided by its weight; the children of cluster i are 2i and
// 2i + 1; the step from one lobe to four to eight is a blend and not a switch, which would make
// highlights pop. Level 0 of the maps is the base material itself.

#include "filtered_maps.glsl"
#include "lib/characteristic_vector.glsl"
#include "lib/dispersion.glsl"

layout(constant_id = SPECIALISE_MIXTURE) const bool MIXTURE = false;
layout(constant_id = SPECIALISE_SUBDIVISION) const uint SUBDIVISION = 2;
layout(constant_id = SPECIALISE_MEAN_LAYER) const uint MEAN_LAYER = 0;
layout(constant_id = SPECIALISE_SPACE) const uint SPACE = SPACE_TANGENT;
layout(constant_id = SPECIALISE_THRESHOLD) const uint THRESHOLD = THRESHOLD_LENGTH;
layout(constant_id = SPECIALISE_EPSILON_0) const float EPSILON_0 = 0.95;
layout(constant_id = SPECIALISE_EPSILON_1) const float EPSILON_1 = 0.85;
layout(constant_id = SPECIALISE_BLEND) const float BLEND = 0.05;

layout(set = 0, binding = 16) uniform sampler2DArray mixture_map;

// Clusters with less of the footprint than this are left out.
const float LEAST_WEIGHT = 1e-5;
// Lobes there may be at most.
const int LOBES = SUBDIVISION == 0u ? 1 : (SUBDIVISION == 1u ? 5 : 13);

struct appearance {
    base_material base;     // of the maps themselves, where base_share > 0
    base_material filtered; // averaged over the footprint; its normal is that of the frame
    float base_share;       // [0, 1]: how much of the appearance is the maps' own, level 0
    vec4 axes[13];      // unit, in the mixtures' space; w: concentration
    float weights[13];  // share times the lobe's normalisation; 0: not evaluated
    vec3 mean_normal;   // mean of the texels' normals, at most unit length
    mat3 mixture_from_tangent;
    vec3 emission;
    float alpha;
    vec3 normal;
    float lobe_count;
    float level;
};

mat3 mixture_frame(surface_point surface) {
    // A mesh's mixtures are those of its front; behind, both they and the frame are reversed.
    mat3 world_from_front = front_side() ? surface.world_from_tangent : -surface.world_from_tangent;
    if (SPACE == SPACE_OBJECT) {
        // Of a rotation and a uniform scale the transpose is the inverse but for the length.
        mat3 world_from_object =
            transpose(mat3(instance.rows[0].xyz, instance.rows[1].xyz, instance.rows[2].xyz));
        mat3 frame = transpose(world_from_object) * world_from_front;
        return frame * inversesqrt(dot(frame[0], frame[0]));
    }
    if (SPACE == SPACE_CAMERA)
        return mat3(frame.world_to_camera) * world_from_front;
    return mat3(1.0);
}

vec4 fetch_layer(map_area area, int layer) {
    vec4 sum = vec4(0.0);
    for (uint i = 0u; i < PROBES; ++i)
        sum += textureLod(mixture_map, vec3(probe_position(area, i), layer),
                          max(area.level - 1.0, 0.0));
    return sum / float(PROBES);
}

// Adds the lobe of one cluster with its weight times `share`.
void set_lobe(inout appearance result, int slot, vec4 moment, float share) {
    if (share <= 0.0 || moment.w < LEAST_WEIGHT)
        return;
    float concentration = concentration_from_complement(resultant_complement(moment.xyz, moment.w));
    result.axes[slot] = vec4(mean_direction(moment.xyz, vec3(0.0, 0.0, 1.0)), concentration);
    result.weights[slot] = share * moment.w * von_mises_fisher_peak(concentration);
    result.lobe_count += 1.0;
}

// [0, 1]: how far the lobes of a cluster must be told apart. The measure is near 1 where one lobe
// is enough: |r| as in the paper, or the part of the lobe's breadth that is the base lobes' own,
// 1 / (1 + dispersion). `base_complement` is the mean 1 - |r| of the base lobes in the footprint.
float refinement(vec4 moment, float base_complement, float epsilon) {
    if (moment.w < LEAST_WEIGHT)
        return 0.0;
    float complement = resultant_complement(moment.xyz, moment.w);
    float measure = THRESHOLD == THRESHOLD_LENGTH
                        ? 1.0 - complement
                        : 1.0 / (1.0 + dispersion(base_complement, complement));
    return 1.0 - transition(measure, epsilon, BLEND);
}

// Fills the lobes from the clusters of the footprint; `base_complement` as above.
void fetch_lobes(inout appearance result, map_area area, vec4 one, float base_complement,
                 float share) {
    // A mixture over a part of the texels (an atlas' edge) stands for all of them.
    share /= max(one.w, LEAST_WEIGHT);
    float refine = SUBDIVISION == 0u ? 0.0 : refinement(one, base_complement, EPSILON_0);
    set_lobe(result, MIXTURE_LAYER_ONE, one, share * (1.0 - refine));
    for (int i = 0; i < (SUBDIVISION == 0u ? 0 : 4); ++i) {
        int slot = MIXTURE_LAYER_SECTORS + i;
        int half_slot = MIXTURE_LAYER_HALVES + 2 * i;
        result.weights[slot] = 0.0;
        if (SUBDIVISION == 2u) {
            result.weights[half_slot] = 0.0;
            result.weights[half_slot + 1] = 0.0;
        }
        if (refine <= 0.0)
            continue;
        vec4 sector = fetch_layer(area, slot);
        float refine_half =
            SUBDIVISION == 2u ? refinement(sector, base_complement, EPSILON_1) : 0.0;
        set_lobe(result, slot, sector, share * refine * (1.0 - refine_half));
        if (refine_half <= 0.0)
            continue;
        set_lobe(result, half_slot, fetch_layer(area, half_slot), share * refine * refine_half);
        set_lobe(result, half_slot + 1, fetch_layer(area, half_slot + 1),
                 share * refine * refine_half);
    }
}

// 1 - |r| of the base lobes where all have one width.
float uniform_complement() {
    float parameter = MODEL == MODEL_MICROFACET
                          ? convolved(microfacet_parameter(DISTRIBUTION, material.roughness))
                          : half_vector_lobe_parameter(0, 1.0);
    return mean_resultant_complement(base_lobe_concentration(DISTRIBUTION, parameter));
}

// The mean of the texels' normals, and of 1 - |r| of their base lobes.
vec4 fetch_mean(map_area area, vec4 one) {
    float weight = max(one.w, LEAST_WEIGHT);
    if (MEAN_LAYER != 0u)
        return fetch_layer(area, int(MEAN_LAYER)) / weight;
    // There is no such layer where all base lobes are equal and lie along their normals.
    float complement = uniform_complement();
    return vec4(one.xyz / max(weight * (1.0 - complement), LEAST_WEIGHT), complement);
}

void fetch_mixture(inout appearance result, surface_point surface, map_area area) {
    result.mixture_from_tangent = mixture_frame(surface);
    vec4 one = fetch_layer(area, MIXTURE_LAYER_ONE);
    vec4 mean = fetch_mean(area, one);
    // A distribution of normals is normalised to projected area one, a lobe to area one.
    float area_of_lobes = MODEL == MODEL_MICROFACET ? von_mises_fisher_projected_area(
                                                          concentration_from_complement(mean.w))
                                                    : 1.0;
    fetch_lobes(result, area, one, mean.w, 1.0 / area_of_lobes);
    result.mean_normal = mean.xyz * result.mixture_from_tangent;
}

appearance fetch_appearance(surface_point surface) {
    appearance result;
    result.base_share = 1.0;
    result.lobe_count = 0.0;
    result.level = 0.0;
    result.mean_normal = vec3(0.0, 0.0, 1.0);
    if (MIXTURE) {
        for (int i = 0; i < LOBES; ++i)
            result.weights[i] = 0.0;
        map_area area = lobe_area(surface);
        result.level = area.level;
        result.base_share = max(1.0 - area.level, 0.0);
        if (result.base_share > 0.0)
            result.base = unfiltered_material(surface);
        if (result.base_share < 1.0)
            fetch_mixture(result, surface, area);
    }
    vec3 normal = MIXTURE ? mean_direction(result.mean_normal, vec3(0.0, 0.0, 1.0))
                          : unfiltered_normal(surface);
    result.filtered = filtered_material(surface, normal);
    if (!MIXTURE)
        result.base = result.filtered;
    result.normal = result.base_share > 0.5 ? result.base.normal : result.filtered.normal;
    if (result.base_share > 0.0)
        result.lobe_count += float(LOBE_COUNT);
    result.alpha = 1.0;
    if (ALPHA_MASK)
        result.alpha = filtered_base_colour(surface).a * material.base_colour.a * surface.colour.a;
    result.emission = EMISSION ? filtered_emission(surface) : vec3(0.0);
    return result;
}

// The mixture at a half vector given in the tangent frame.
float evaluate_mixture(appearance fetched, vec3 halfway) {
    vec3 direction = fetched.mixture_from_tangent * halfway;
    float sum = 0.0;
    for (int i = 0; i < LOBES; ++i) {
        if (fetched.weights[i] > 0.0)
            sum += fetched.weights[i] *
                   exp(-0.5 * fetched.axes[i].w *
                       difference_squared(direction, fetched.axes[i].xyz));
    }
    return sum;
}

vec3 evaluate_footprint(appearance fetched, vec3 outgoing, vec3 incoming) {
    if (incoming.z <= 0.0)
        return vec3(0.0);
    vec3 halfway = half_vector(incoming, outgoing);
    float distribution = evaluate_mixture(fetched, halfway);
    if (MODEL == MODEL_MICROFACET)
        return evaluate_microfacets(fetched.filtered, fetched.mean_normal, distribution, halfway,
                                    outgoing, incoming);
    vec3 colour = vec3(0.0);
    for (int i = 0; i < LOBE_COUNT; ++i)
        colour += material.lobe_colour[i].rgb;
    vec3 sum = fetched.filtered.specular * colour * distribution;
    if (DIFFUSE)
        sum += microfacet_diffuse(fetched.filtered.diffuse, vec3(0.0),
                                  dot(fetched.mean_normal, incoming));
    return sum;
}

vec3 evaluate_appearance(appearance fetched, surface_point surface, vec3 incoming) {
    vec3 value = vec3(0.0);
    if (fetched.base_share > 0.0)
        value = fetched.base_share *
                evaluate_base_material(fetched.base, surface.outgoing, incoming);
    if (fetched.base_share < 1.0)
        value += (1.0 - fetched.base_share) *
                 evaluate_footprint(fetched, surface.outgoing, incoming);
    return value;
}
