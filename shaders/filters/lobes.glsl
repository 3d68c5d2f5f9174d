// MIP-mapped mixtures of lobes: Xu et al. 2017, Real-Time Linear BRDF MIP-Mapping, Algorithm 1,
// repaired: a cluster's vector is divided by its weight; the children of cluster i are 2i and
// 2i + 1; the step from one lobe to four to eight is a blend and not a switch, which would make
// highlights pop. Level 0 of the maps is the base material itself.
//
// The clusters are walked depth first, a fetch and a lobe at a time, so that a pixel pays for as
// many as it needs: first the base lobes where level 0 has a share, then the footprint's one lobe,
// then each sector and its halves.

#include "filtered_maps.glsl"
#include "lib/characteristic_vector.glsl"
#include "lib/dispersion.glsl"

layout(constant_id = SPECIALISE_MIXTURE) const bool MIXTURE = false;
layout(constant_id = SPECIALISE_SUBDIVISION) const uint SUBDIVISION = 2;
layout(constant_id = SPECIALISE_COARSEST) const uint COARSEST = 0;
layout(constant_id = SPECIALISE_MEAN_LAYER) const uint MEAN_LAYER = 0;
layout(constant_id = SPECIALISE_SPACE) const uint SPACE = SPACE_TANGENT;
layout(constant_id = SPECIALISE_THRESHOLD) const uint THRESHOLD = THRESHOLD_LENGTH;
layout(constant_id = SPECIALISE_EPSILON_0) const float EPSILON_0 = 0.95;
layout(constant_id = SPECIALISE_EPSILON_1) const float EPSILON_1 = 0.85;
layout(constant_id = SPECIALISE_BLEND) const float BLEND = 0.05;

layout(set = 0, binding = 16) uniform sampler2DArray mixture_map;

// Base lobes are von Mises-Fisher lobes like those of the mixture.
const bool BASE_IS_LOBE = BASE_AS_LOBE || DISTRIBUTION == DISTRIBUTION_VMF;

// Clusters with less of the footprint than this are left out.
const float LEAST_WEIGHT = 1e-5;

// Nodes of the walk: the one lobe, then for sector i the sector (1 + 3i) and its two halves.
const int NODE_ONE = 0;
const int NODE_SECTOR = 1;
const int NODE_END = 13;

struct appearance {
    // The part at hand: one lobe, or one base lobe of level 0.
    bool of_base;
    vec3 axis;           // unit, in the mixtures' space
    float concentration; // of a base lobe of another kind: its own parameter
    float weight;        // share of the appearance; for a von Mises-Fisher lobe times its peak
    vec3 colour;         // half-vector lobes: of the lobe
    vec3 diffuse;        // albedo in the first part, which brings the Lambert part, else 0
    float spread;        // [0, 1]: how much of the lobe's breadth is texels' normals pointing apart
    // Where the walk is.
    bool entered;  // past the first part
    int base_lobe; // next base lobe
    int node;      // next node
    float share;        // of the appearance that the mixture stands for
    float root_share;   // of that, what sectors stand for
    float sector_share; // of that, what the halves of the sector at hand stand for
    // What all parts share.
    map_area area;
    float base_share;       // [0, 1]: how much of the appearance is level 0
    base_material base;     // level 0; colours are taken from the footprint
    base_material filtered; // averaged over the footprint
    vec3 diffuse_normal;    // mean of the texels' normals, at most of unit length
    float base_complement;  // mean 1 - |r| of the base lobes in the footprint
    mat3 mixture_from_tangent;
    // Of the whole pixel.
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

// 1 - |r| of the base lobes where all have one width.
float uniform_complement() {
    float parameter = MODEL == MODEL_MICROFACET
                          ? convolved(microfacet_parameter(DISTRIBUTION, material.roughness))
                          : half_vector_lobe_parameter(0, 1.0);
    return mean_resultant_complement(base_lobe_concentration(DISTRIBUTION, parameter));
}

// The mean of the texels' normals, and of 1 - |r| of their base lobes; `coverage`: the weights'
// sum in a footprint, below 1 at the edge of an atlas.
vec4 fetch_mean(map_area area, out float coverage) {
    coverage = 1.0;
    vec4 one = vec4(0.0);
    if (SPACE != SPACE_TANGENT || MEAN_LAYER == 0u) {
        one = fetch_layer(area, MIXTURE_LAYER_ONE);
        coverage = max(one.w, LEAST_WEIGHT);
    }
    if (MEAN_LAYER != 0u)
        return fetch_layer(area, int(MEAN_LAYER)) / coverage;
    // There is no such layer where all base lobes are equal and lie along their normals.
    float complement = uniform_complement();
    return vec4(one.xyz / max(coverage * (1.0 - complement), LEAST_WEIGHT), complement);
}

// [0, 1]: how far the lobes of a cluster must be told apart. The measure is near 1 where one lobe
// is enough: |r| as in the paper, or the part of the lobe's breadth that is the base lobes' own,
// 1 / (1 + dispersion).
float refinement(float complement, float base_complement, float epsilon) {
    float measure = THRESHOLD == THRESHOLD_LENGTH
                        ? 1.0 - complement
                        : 1.0 / (1.0 + dispersion(base_complement, complement));
    return 1.0 - transition(measure, epsilon, BLEND);
}

// Takes the next base lobe of level 0.
void take_base_lobe(inout appearance walk) {
    int i = walk.base_lobe;
    bool microfacets = MODEL == MODEL_MICROFACET;
    vec3 axis = microfacets ? walk.base.normal
                            : rotate_from_pole(walk.base.normal, material.lobe_direction[i].xyz);
    walk.axis = walk.mixture_from_tangent * axis;
    walk.concentration =
        microfacets ? walk.base.width : half_vector_lobe_parameter(i, walk.base.width);
    walk.weight = walk.base_share;
    walk.spread = 0.0;
    if (BASE_IS_LOBE) {
        walk.concentration = base_lobe_concentration(DISTRIBUTION, walk.concentration);
        walk.weight *= von_mises_fisher_peak(walk.concentration);
        if (microfacets)
            walk.weight /= von_mises_fisher_projected_area(walk.concentration);
    }
    walk.colour = walk.filtered.specular * material.lobe_colour[i].rgb;
    walk.lobe_count += 1.0;
    ++walk.base_lobe;
}

// The colour of all base lobes together.
vec3 mixture_colour() {
    vec3 sum = vec3(0.0);
    for (int i = 0; i < LOBE_COUNT; ++i)
        sum += material.lobe_colour[i].rgb;
    return sum;
}

// Takes the lobe of the next cluster, and says which follows.
void take_cluster(inout appearance walk) {
    int sector = (walk.node - NODE_SECTOR) / 3;
    int part = walk.node - NODE_SECTOR - 3 * sector;
    bool one = walk.node == NODE_ONE;
    bool is_sector = !one && part == 0;
    int layer = one         ? MIXTURE_LAYER_ONE
                : is_sector ? MIXTURE_LAYER_SECTORS + sector
                            : MIXTURE_LAYER_HALVES + 2 * sector + part - 1;
    vec4 moment = fetch_layer(walk.area, layer);

    float complement = resultant_complement(moment.xyz, moment.w);
    float refine = 0.0;
    if ((one && SUBDIVISION > 0u) || (is_sector && SUBDIVISION > 1u))
        refine = refinement(complement, walk.base_complement, one ? EPSILON_0 : EPSILON_1);
    refine = moment.w > LEAST_WEIGHT ? refine : 0.0;

    float share = walk.share * (one ? 1.0 : walk.root_share) *
                  (one || is_sector ? 1.0 : walk.sector_share) * (1.0 - refine);
    walk.axis = mean_direction(moment.xyz, vec3(0.0, 0.0, 1.0));
    walk.concentration = concentration_from_complement(complement);
    walk.weight = share * moment.w * von_mises_fisher_peak(walk.concentration);
    walk.spread = clamp(1.0 - walk.base_complement / max(complement, LEAST_WEIGHT), 0.0, 1.0);
    walk.colour = walk.filtered.specular * mixture_colour();
    walk.lobe_count += share * moment.w > LEAST_WEIGHT ? 1.0 : 0.0;

    walk.root_share = one ? refine : walk.root_share;
    walk.sector_share = is_sector ? refine : walk.sector_share;
    int past = one ? NODE_END : NODE_SECTOR + 3 * (sector + 1);
    walk.node = refine > 0.0 || (!one && !is_sector) ? walk.node + 1 : past;
}

bool has_part(appearance walk) {
    return MIXTURE ? walk.base_lobe < LOBE_COUNT || walk.node < NODE_END
                   : walk.base_lobe < LOBE_COUNT;
}

void next_part(inout appearance walk) {
    walk.diffuse = walk.entered ? vec3(0.0) : walk.filtered.diffuse;
    walk.entered = true;
    walk.of_base = !MIXTURE || walk.base_lobe < LOBE_COUNT;
    if (walk.of_base)
        take_base_lobe(walk);
    else
        take_cluster(walk);
}

// Prepares the walk over the mixture.
void enter_mixture(inout appearance walk, surface_point surface) {
    walk.area = lobe_area(surface);
    walk.level = walk.area.level;
    walk.base_share = clamp(1.0 - walk.level, 0.0, 1.0);
    walk.base_lobe = walk.base_share > 0.0 ? 0 : int(LOBE_COUNT);
    walk.node = walk.base_share < 1.0 ? (COARSEST == 0u ? NODE_ONE : NODE_SECTOR) : NODE_END;
    walk.root_share = 1.0;
    walk.mixture_from_tangent = mixture_frame(surface);
    float coverage;
    vec4 mean = fetch_mean(walk.area, coverage);
    walk.base_complement = mean.w;
    // A mixture over a part of the texels stands for all of them.
    walk.share = (1.0 - walk.base_share) / coverage;
    // A distribution of normals is normalised to projected area one, a lobe to area one.
    if (MODEL == MODEL_MICROFACET)
        walk.share /= von_mises_fisher_projected_area(concentration_from_complement(mean.w));
    walk.diffuse_normal = mix(mean.xyz * walk.mixture_from_tangent, walk.base.normal,
                              walk.base_share);
}

appearance fetch_appearance(surface_point surface) {
    appearance result;
    result.base = unfiltered_material(surface);
    result.entered = false;
    result.mixture_from_tangent = mat3(1.0);
    result.base_share = 1.0;
    result.base_lobe = 0;
    result.node = NODE_END;
    result.lobe_count = 0.0;
    result.level = 0.0;
    result.diffuse_normal = result.base.normal;
    if (MIXTURE)
        enter_mixture(result, surface);
    result.normal = mean_direction(result.diffuse_normal, vec3(0.0, 0.0, 1.0));
    result.filtered = filtered_material(surface, result.normal);
    result.alpha = 1.0;
    if (ALPHA_MASK)
        result.alpha = filtered_base_colour(surface).a * material.base_colour.a * surface.colour.a;
    result.emission = EMISSION ? filtered_emission(surface) : vec3(0.0);
    return result;
}

// The lobe at hand, or its distribution of normals.
float evaluate_lobe(appearance walk, vec3 halfway) {
    vec3 direction = walk.mixture_from_tangent * halfway;
    if (!BASE_IS_LOBE && walk.of_base)
        return walk.weight *
               (MODEL == MODEL_MICROFACET
                    ? normal_distribution(DISTRIBUTION, walk.axis, direction, walk.concentration)
                    : half_vector_lobe(DISTRIBUTION, direction, walk.axis, walk.concentration));
    return walk.weight * exp(-0.5 * walk.concentration * difference_squared(direction, walk.axis));
}

// The mean normal of the texels that reflect about `halfway`, for their cosines and masking. With
// texels' normals and base lobes both about normal, of variances that add up to the lobe's, the
// mean of the normals where their sum is given divides as the variances do.
vec3 reflecting_normal(appearance walk, vec3 halfway) {
    vec3 axis = walk.axis * walk.mixture_from_tangent;
    return mean_direction(mix(axis, halfway, walk.spread), axis);
}

vec3 evaluate_part(appearance walk, surface_point surface, vec3 incoming) {
    if (incoming.z <= 0.0)
        return vec3(0.0);
    vec3 halfway = half_vector(incoming, surface.outgoing);
    float distribution = evaluate_lobe(walk, halfway);
    if (MODEL == MODEL_MICROFACET) {
        base_material frame = walk.filtered;
        frame.normal = reflecting_normal(walk, halfway);
        if (walk.of_base)
            frame.width = walk.base.width;
        frame.diffuse = walk.diffuse;
        return evaluate_microfacets(frame, walk.diffuse_normal, distribution, halfway,
                                    surface.outgoing, incoming);
    }
    vec3 sum = walk.colour * distribution;
    if (DIFFUSE)
        sum += microfacet_diffuse(walk.diffuse, vec3(0.0), dot(walk.diffuse_normal, incoming));
    return sum;
}
