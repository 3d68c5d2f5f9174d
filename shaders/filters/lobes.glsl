// MIP-mapped mixtures of lobes: Xu et al. 2017, Real-Time Linear BRDF MIP-Mapping, Algorithm 1,
// with corrections: a cluster's vector is divided by its weight; the children of cluster i are 2i
// and 2i + 1; the steps from one lobe to four and to eight blend, because a switch would make
// highlights pop. Level 0 of the maps is the base material itself.
//
// Clusters are visited depth first, one fetch and one lobe at a time, so that a pixel only pays for
// those it needs: first the base lobes if level 0 has a share, then the footprint's one lobe, then
// each sector and its halves.

#include "interface/mixture.h"
#include "shading/level_0.glsl"
#include "shading/mask.glsl"
#include "lib/lobe/characteristic_vector.glsl"
#include "lib/light/luminance.glsl"
#include "lib/lobe/dispersion.glsl"
#include "lib/lobe/width_pair.glsl"

#ifdef ENVIRONMENT
#include "environment/reflection.glsl"
#endif

layout(constant_id = SPECIALISE_SUBDIVISION) const uint SUBDIVISION = 2;
layout(constant_id = SPECIALISE_COARSEST) const uint COARSEST = 0;
layout(constant_id = SPECIALISE_MEAN_LAYER) const uint MEAN_LAYER = 0;
layout(constant_id = SPECIALISE_WEIGHTED) const bool WEIGHTED = false;
layout(constant_id = SPECIALISE_KEPT_LAYER) const uint KEPT_LAYER = 0;
layout(constant_id = SPECIALISE_WIDTH_LAYER) const uint WIDTH_LAYER = 0;
layout(constant_id = SPECIALISE_WIDTH_COLOURS) const bool WIDTH_COLOURS = false;
layout(constant_id = SPECIALISE_SPACE) const uint SPACE = SPACE_TANGENT;
layout(constant_id = SPECIALISE_THRESHOLD) const uint THRESHOLD = THRESHOLD_DISPERSION;
layout(constant_id = SPECIALISE_ONE_HUE) const bool ONE_HUE = false;

layout(LOBE_DESCRIPTOR(FILTER_KNOB_BINDING), std140) uniform filter_knob_block {
    lobes_knobs filter_knobs;
};

layout(LOBE_DESCRIPTOR(16)) uniform sampler2DArray mixture_map;

// Base lobes of the mixture's own kind are part of the traversal, so that a pixel without level 0
// does not pay for them.
bool base_in_walk() {
    return MODEL == MODEL_HALF_VECTOR_LOBES && ONE_HUE &&
           (BASE_AS_LOBE || DISTRIBUTION == DISTRIBUTION_VMF);
}

// Clusters with less of the footprint than this are skipped.
const float LEAST_WEIGHT = 1e-5;

// How many widths each cluster stands for.
const int WIDTHS = WIDTH_LAYER != 0u ? 2 : 1;

// The one lobe of all sectors is walked first.
const int SECTOR_ALL = -1;
const int SECTOR_END = 4;

struct appearance {
    base_material base;     // level 0, where it may be seen; colours are the footprint's
    base_material filtered; // averaged over the footprint
    map_area area;
    float base_share;       // [0, 1]: how much of the appearance is level 0
    float mixture_scale;    // factor of the distributions' weights, whose projected area is one
    float base_complement;  // mean 1 - |r| of the base lobes in the footprint
    vec2 complements;       // 1 - |r| of the first WIDTHS, which stand for all of them
    vec2 width_parts;       // and their parts
    vec4 cluster_widths[2]; // sums of 1 - |r| in clusters
    vec3 width_tints[2];    // F0 of either width, over that of the footprint
    vec2 lobe_scales;       // factors of the weights of lobes about base lobes so wide
    float resultant_scale;  // of |r|: 1, unless widths lie apart
    float complement;       // 1 - |r| of the footprint's one lobe if it were about the normals
    float variance;         // of the macro-surface's normals, unless the mixture includes it
    vec3 diffuse_normal;    // mean of the texels' normals, at most of unit length
    mat3 mixture_from_tangent;
    vec4 distributions; // the mixture at the half vectors of the lights gathered last
    vec4 broad_distributions; // the second width's part of it
    float breadth;      // 1 - |r| of that lobe, widened by curvature
    float spread;       // [0, 1]: part of the breadth that is due to varying normals
    // Of the whole pixel.
    vec3 emission;
    bool kept;
    vec3 normal;
    float lobe_count;
    float level;
};

// A lobe of the mixture, of the first WIDTHS widths.
struct lobe {
    vec3 axis; // unit, in the mixtures' space
    vec2 concentration;
    vec2 weight; // share of the appearance times the lobe's peak
    // Of microfacets: the part with the base distribution's own shape.
    vec2 parameter; // of the distribution as broad as the lobe
    vec2 own_weight;
};

// The state of a traversal.
struct walk {
    int base_lobe;      // next base lobe
    int sector;         // next cluster: of this sector, [0, 4), SECTOR_ALL or SECTOR_END
    int part;           // 0: all of it; 1, 2: a half
    float root_share;   // of the mixture, the share of the sectors
    float sector_share; // of that, the share of the current sector's halves
};

// From the tangent frame to the mixtures' space; the other two are the picture's.
mat3 mixture_frame(surface_point surface) {
    if (SPACE == SPACE_OBJECT)
        return object_from_tangent(surface);
    if (SPACE == SPACE_CAMERA)
        return camera_from_tangent(surface);
    return mat3(1.0);
}

// 1 - |r| of the base lobes in the map where all have one width.
float uniform_complement() {
    float parameter = MODEL == MODEL_MICROFACET
                          ? parameter_of_factor(material.width_factor)
                          : half_vector_lobe_parameter(0, 1.0);
    return mean_resultant_complement(base_lobe_concentration(DISTRIBUTION, parameter));
}

// The mean of the texels' normals, and of 1 - |r| of their base lobes; `coverage`: below 1 at the
// edge of an atlas and under a mask; `weight`: the sum of the lobes' weights, which is the coverage
// or what it mirrors.
vec4 fetch_mean(map_area area, out float coverage, out float weight) {
    coverage = weight = 1.0;
    vec4 one = vec4(0.0);
    if (SPACE != SPACE_TANGENT || MASKED_LOBES || WEIGHTED || MEAN_LAYER == 0u) {
        one = filtered_layer(mixture_map, area, MIXTURE_LAYER_ONE);
        weight = max(one.w, LEAST_WEIGHT);
        coverage = WEIGHTED ? 1.0 : weight;
    }
    if (KEPT_LAYER != 0u)
        coverage = max(filtered_layer(mixture_map, area, KEPT_LAYER).x, LEAST_WEIGHT);
    if (MEAN_LAYER != 0u)
        return filtered_layer(mixture_map, area, MEAN_LAYER) / vec4(vec3(coverage), weight);
    // There is no such layer if all base lobes are equal and along their normals.
    float complement = uniform_complement();
    return vec4(one.xyz / max(weight * (1.0 - complement), LEAST_WEIGHT), complement);
}

// What colour each of two widths has. Vertices' colours tint both alike. `powers`: of the layer of
// widths, over `weight`.
void take_width_tints(inout appearance fetched, width_pair pair, vec4 powers, float coverage,
                      float weight) {
    vec4 sums =
        filtered_layer(mixture_map, fetched.area, WIDTH_LAYER + 1u + SUBDIVISION) / weight;
    // F0 without the white that weights have.
    vec3 colour = 1.0 - LEAST_MIRRORED * coverage / weight + chroma_of_red_and_blue(sums.xy);
    vec3 products = powers.x - LEAST_MIRRORED * powers.w + chroma_of_red_and_blue(sums.zw);
    vec3 broad = broad_share(pair, powers.x, colour, products);
    fetched.width_tints[0] = (1.0 - broad) / max(pair.parts.x, 1e-4);
    fetched.width_tints[1] = broad / max(pair.parts.y, 1e-4);
}

// Two widths with the footprint's moments of all.
void take_widths(inout appearance fetched, float coverage, float weight) {
    vec4 powers = filtered_layer(mixture_map, fetched.area, WIDTH_LAYER) / weight;
    width_pair pair = width_pair_of(powers.xyz);
    fetched.complements = pair.complements;
    fetched.width_parts = pair.parts;
    if (WIDTH_COLOURS)
        take_width_tints(fetched, pair, powers, coverage, weight);
}

// What the walk needs of the clusters' own base lobes, once it goes beyond one cluster.
void fetch_cluster_widths(inout appearance fetched) {
    if (WIDTHS == 1 || SUBDIVISION == 0u)
        return;
    fetched.cluster_widths[0] = filtered_layer(mixture_map, fetched.area, WIDTH_LAYER + 1u);
    if (SUBDIVISION > 1u)
        fetched.cluster_widths[1] = filtered_layer(mixture_map, fetched.area, WIDTH_LAYER + 2u);
}

// The mean 1 - |r| of the base lobes in a cluster of this weight. `part`: as in the walk.
float base_complement_of(appearance fetched, int sector, int part, float weight) {
    if (WIDTHS == 1 || sector == SECTOR_ALL)
        return fetched.base_complement;
    if (SUBDIVISION < 2u)
        return fetched.cluster_widths[0][sector] / max(weight, LEAST_WEIGHT);
    int first = 2 * (sector % 2);
    vec4 four = fetched.cluster_widths[sector / 2];
    float sum = part == 0 ? four[first] + four[first + 1] : four[first + part - 1];
    return sum / max(weight, LEAST_WEIGHT);
}

// The widths' parts where the mean 1 - |r| is `base`.
vec2 width_parts_of(appearance fetched, float base) {
    if (WIDTHS == 1)
        return vec2(1.0, 0.0);
    vec2 widths = fetched.complements;
    float scale = dot(widths, fetched.width_parts) / max(fetched.base_complement, 1e-6);
    float range = widths.y - widths.x;
    float broad = range > 1e-3 * widths.y ? clamp((scale * base - widths.x) / range, 0.0, 1.0)
                                          : fetched.width_parts.y;
    return vec2(1.0 - broad, broad);
}

// 1 - |r| of lobes about base lobes of one width, where it is `complement` about those of all
// widths, whose mean is `base`: the normals shorten all alike.
float complement_of_width(appearance fetched, int width, float base, float complement) {
    if (WIDTHS == 1)
        return complement;
    float shortened = (1.0 - complement) / max(1.0 - base, 1e-3);
    return 1.0 - (1.0 - fetched.complements[width]) * min(shortened, 1.0);
}

// [0, 1]: the base lobes' share of a cluster's breadth, 1 / (1 + dispersion).
float base_share_of_breadth(appearance fetched, float base, float complement) {
    vec2 parts = width_parts_of(fetched, base);
    float share = 0.0;
    for (int width = 0; width < WIDTHS; ++width)
        share += parts[width] /
                 (1.0 + dispersion(fetched.complements[width],
                                   complement_of_width(fetched, width, base, complement)));
    return share;
}

// [0, 1]: how far a cluster must be refined. The measure is near 1 if one lobe is enough: |r| as in
// the paper, or the base lobes' share of the lobe's breadth.
float refinement(appearance fetched, float base, float complement, float epsilon) {
    float measure = THRESHOLD == THRESHOLD_LENGTH
                        ? 1.0 - complement
                        : base_share_of_breadth(fetched, base, complement);
    return 1.0 - transition(measure, epsilon, filter_knobs.blend);
}

// For lobes about their texels' normals the mean layer gives the resultant, so that the footprint's
// one lobe is fetched only if needed.
bool root_from_mean() {
    return MODEL == MODEL_MICROFACET && MEAN_LAYER != 0u && SUBDIVISION > 0u;
}

// The next base lobe of level 0. Those of other kinds are evaluated in evaluate_appearance.
lobe take_base_lobe(inout walk at, inout appearance fetched) {
    int i = at.base_lobe++;
    lobe result;
    result.axis = fetched.mixture_from_tangent *
                  rotate_from_pole(fetched.base.normal, material.lobe_direction[i].xyz);
    float concentration =
        base_lobe_concentration(DISTRIBUTION, widened_lobe_parameter(i, fetched.base));
    result.concentration = vec2(concentration);
    result.weight = vec2(fetched.base_share * material.lobe_colour[i].w *
                         von_mises_fisher_peak(concentration), 0.0);
    fetched.lobe_count += 1.0;
    return result;
}

// Microfacet distributions have tails that no von Mises-Fisher lobe has. A lobe keeps this shape to
// the extent that its breadth is the base lobes' and not the normals'.
bool keeps_shape() {
    return MODEL == MODEL_MICROFACET && !BASE_AS_LOBE && DISTRIBUTION != DISTRIBUTION_VMF;
}

float base_complement_share(float complement, float base_complement) {
    return clamp(base_complement / max(complement, LEAST_WEIGHT), 0.0, 1.0);
}

// How much broader than the whole the Gaussian part of a GGX lobe about spread normals is, in
// variance. Both as broad as the whole, the parts together are up to 1.24 times too high in the
// middle, and 0.63 at three deviations. `own`: the base lobes' share of the breadth. Found for GGX
// convolved with a Gaussian in the plane, of which the lobe then lacks 0.01 to 0.04 instead of
// 0.02 to 0.14 (relative L2).
float gaussian_widening(float own) {
    return DISTRIBUTION == DISTRIBUTION_GGX ? 1.0 + GGX_WIDENING * sqrt(own) : 1.0;
}

// A cluster's lobe, about the base lobes of one width. `complement`: 1 - |r|; `share`: of the
// appearance.
void make_lobe(inout lobe result, appearance fetched, int width, float complement, float share) {
    // The surface's curvature widens one lobe and many in the same way.
    float breadth = widened_complement(complement, fetched.variance);
    float concentration = concentration_from_complement(breadth);
    float weight = fetched.lobe_scales[width] * share;
    if (keeps_shape()) {
        float own = base_complement_share(breadth, fetched.complements[width]);
        result.parameter[width] = base_lobe_of_concentration(DISTRIBUTION, concentration);
        result.own_weight[width] = own * share * fetched.mixture_scale;
        concentration /= gaussian_widening(own);
        weight *= 1.0 - own;
    }
    result.concentration[width] = concentration;
    result.weight[width] = weight * von_mises_fisher_peak(concentration);
}

// The lobe of the next cluster; advances the traversal.
lobe take_cluster(inout walk at, inout appearance fetched) {
    bool one = at.sector == SECTOR_ALL;
    bool is_sector = !one && at.part == 0;
    int layer = one         ? MIXTURE_LAYER_ONE
                : is_sector ? MIXTURE_LAYER_SECTORS + at.sector
                            : MIXTURE_LAYER_HALVES + 2 * at.sector + at.part - 1;
    vec4 moment = filtered_layer(mixture_map, fetched.area, layer);
    if (WIDTHS_APART)
        moment.xyz *= fetched.resultant_scale;

    float complement = resultant_complement(moment.xyz, moment.w);
    float base = base_complement_of(fetched, at.sector, at.part, moment.w);
    float refine = 0.0;
    if ((one && SUBDIVISION > 0u) || (is_sector && SUBDIVISION > 1u))
        refine = refinement(fetched, base, complement,
                            one ? filter_knobs.epsilon0 : filter_knobs.epsilon1);
    refine = moment.w > LEAST_WEIGHT ? refine : 0.0;
    if (root_from_mean())
        refine = one ? at.root_share : refine;

    float share = (one ? 1.0 : at.root_share) * (one || is_sector ? 1.0 : at.sector_share) *
                  (1.0 - refine) * moment.w;
    lobe result;
    result.axis = moment.xyz * inversesqrt(max(dot(moment.xyz, moment.xyz), 1e-30));
    vec2 parts = width_parts_of(fetched, base);
    for (int width = 0; width < WIDTHS; ++width)
        make_lobe(result, fetched, width, complement_of_width(fetched, width, base, complement),
                  parts[width] * share);
    fetched.lobe_count += share > LEAST_WEIGHT ? 1.0 : 0.0;

    at.root_share = one ? refine : at.root_share;
    at.sector_share = is_sector ? refine : at.sector_share;
    bool deeper = refine > 0.0;
    bool to_second = !one && at.part == 1;
    // The one lobe is followed by all sectors or the end, a sector by its halves or the next one.
    bool next_sector = one || (is_sector && !deeper) || at.part == 2;
    at.sector = one && !deeper ? SECTOR_END : at.sector + (next_sector ? 1 : 0);
    at.part = to_second ? 2 : is_sector && deeper ? 1 : 0;
    return result;
}

bool walks_base() {
    return base_in_walk() && may_see_level_0(lobe_map());
}

walk start_walk(appearance fetched) {
    walk at;
    at.base_lobe = walks_base() && fetched.base_share > 0.0 ? 0 : int(LOBE_COUNT);
    at.sector = fetched.base_share < 1.0 ? (COARSEST == 0u ? SECTOR_ALL : 0) : SECTOR_END;
    at.part = 0;
    at.root_share = 1.0;
    at.sector_share = 0.0;
    if (root_from_mean()) {
        at.root_share = refinement(fetched, fetched.base_complement, fetched.complement,
                                   filter_knobs.epsilon0);
        if (fetched.base_share < 1.0 && at.root_share >= 1.0)
            at.sector = 0;
    }
    return at;
}

vec2 evaluate_lobe(lobe one, vec3 direction) {
    vec2 values = vec2(0.0);
    float square = difference_squared(direction, one.axis);
    for (int width = 0; width < WIDTHS; ++width) {
        values[width] = one.weight[width] * exp(-0.5 * one.concentration[width] * square);
        if (keeps_shape())
            values[width] +=
                one.own_weight[width] *
                normal_distribution(DISTRIBUTION, one.axis, direction, one.parameter[width]);
    }
    return values;
}

vec3 mixture_half_vector(appearance fetched, surface_point surface, vec3 incoming) {
    return fetched.mixture_from_tangent * half_vector(incoming, surface.outgoing);
}

// The half vectors of the current lights, in the mixtures' space.
struct light_directions {
    vec3 first, second, third, fourth;
};

void add_lobe_to_light(inout appearance fetched, lobe next, uint light, vec3 halfway) {
    vec2 values = evaluate_lobe(next, halfway);
    fetched.distributions[light] += values.x + values.y;
    if (WIDTH_COLOURS)
        fetched.broad_distributions[light] += values.y;
}

void add_lobe(inout appearance fetched, lobe next, light_directions halfway) {
    add_lobe_to_light(fetched, next, 0u, halfway.first);
    if (LIGHTS_AT_ONCE > 1u)
        add_lobe_to_light(fetched, next, 1u, halfway.second);
    if (LIGHTS_AT_ONCE > 2u)
        add_lobe_to_light(fetched, next, 2u, halfway.third);
    if (LIGHTS_AT_ONCE > 3u)
        add_lobe_to_light(fetched, next, 3u, halfway.fourth);
}

void gather_lights(inout appearance fetched, surface_point surface, vec3 incoming[4]) {
    if (!FILTERED_LOBES)
        return;
    light_directions halfway = light_directions(mixture_half_vector(fetched, surface, incoming[0]),
                                                mixture_half_vector(fetched, surface, incoming[1]),
                                                mixture_half_vector(fetched, surface, incoming[2]),
                                                mixture_half_vector(fetched, surface, incoming[3]));
    fetched.distributions = fetched.broad_distributions = vec4(0.0);
    fetched.lobe_count = !base_in_walk() && fetched.base_share > 0.0 ? float(LOBE_COUNT) : 0.0;
    walk at = start_walk(fetched);
    if (SUBDIVISION == 0u && !walks_base()) {
        at.sector = SECTOR_ALL; // only one cluster
        add_lobe(fetched, take_cluster(at, fetched), halfway);
        return;
    }
    while (at.base_lobe < LOBE_COUNT || at.sector < SECTOR_END) {
        lobe next;
        if (walks_base() && at.base_lobe < LOBE_COUNT)
            next = take_base_lobe(at, fetched);
        else
            next = take_cluster(at, fetched);
        add_lobe(fetched, next, halfway);
    }
}

// Prepares the traversal of the mixture.
void enter_mixture(inout appearance fetched, surface_point surface) {
    fetched.level = fetched.area.level;
    fetched.mixture_from_tangent = mixture_frame(surface);
    float coverage, weight;
    vec4 mean = fetch_mean(fetched.area, coverage, weight);
    level_0_normals normals = normals_of_level_0(surface, fetched.area, 1.0);
    fetched.base_share = share_of_level_0(normals, fetched.area.share, coverage);
    if (WIDTHS_APART) {
        mean.w = fetch_width_means(surface).complement;
        fetched.resultant_scale = (1.0 - mean.w) / max(1.0 - uniform_complement(), 1e-3);
    }
    fetched.base_complement = mean.w;
    // A mixture over some of the texels represents all of them.
    fetched.mixture_scale = (1.0 - fetched.base_share) / weight;
    fetched.complements = vec2(mean.w);
    if (WIDTHS > 1)
        take_widths(fetched, coverage, weight);
    fetch_cluster_widths(fetched);
    // A distribution of normals is normalised to projected area one, a lobe to area one.
    fetched.lobe_scales = vec2(fetched.mixture_scale);
    if (MODEL == MODEL_MICROFACET)
        for (int width = 0; width < WIDTHS; ++width)
            fetched.lobe_scales[width] /= von_mises_fisher_projected_area(
                concentration_from_complement(fetched.complements[width]));
    fetched.diffuse_normal = mean.xyz * fetched.mixture_from_tangent;
    // Lobes about normals: their resultant is the product of the normals' and the base lobes'.
    fetched.complement = 1.0 - (1.0 - mean.w) * min(length(mean.xyz), 1.0);
    // Mixtures over an atlas already include the macro-surface's normals.
    fetched.variance = SPACE == SPACE_TANGENT ? isotropic_variance(surface.curvature) : 0.0;
    fetched.breadth = widened_complement(fetched.complement, fetched.variance);
    fetched.spread = 1.0 - base_complement_share(fetched.breadth, mean.w);
    if (may_see_level_0(lobe_map())) {
        fetched.base = level_0_material(surface, normals);
        fetched.diffuse_normal = mix(fetched.diffuse_normal, normals.mean, fetched.base_share);
    }
}

appearance fetch_appearance(surface_point surface) {
    appearance result;
    result.area = lobe_area(surface);
    result.base_share = 1.0;
    result.lobe_count = float(LOBE_COUNT);
    result.level = 0.0;
    if (FILTERED_LOBES)
        enter_mixture(result, surface);
    else
        result.diffuse_normal = unfiltered_normal(surface);
    result.normal = mean_direction(result.diffuse_normal, vec3(0.0, 0.0, 1.0));
    result.filtered = filtered_material(surface, result.normal, result.area);
    if (FILTERED_LOBES && MODEL == MODEL_MICROFACET)
        result.filtered.width = base_lobe_of_concentration(
            DISTRIBUTION, concentration_from_complement(result.base_complement));
    result.kept = !ALPHA_MASK || keeps_footprint(surface);
    result.emission = EMISSION ? filtered_emission(surface, result.area) : vec3(0.0);
    return result;
}

// The mean normal of the texels that reflect about `halfway`, for their cosines and masking. If the
// texels' normals and the base lobes are both about Gaussian, with variances that add up to the
// mixture's, the mean normal for a given sum divides it in the ratio of the variances. In the tails
// of GGX, beyond two deviations, it moves less: at a distance d their logarithm falls by 4/d.
vec3 reflecting_normal(appearance fetched, vec3 halfway) {
    float part = fetched.spread;
    if (keeps_shape() && DISTRIBUTION == DISTRIBUTION_GGX)
        part *= fetched.breadth /
                max(fetched.breadth,
                    0.25 * difference_squared(halfway, fetched.filtered.normal));
    vec3 sum = mix(fetched.filtered.normal, halfway, part);
    if (may_see_level_0(lobe_map()))
        sum = mix(sum, fetched.base.normal, fetched.base_share);
    return sum * inversesqrt(max(dot(sum, sum), 1e-30));
}

// F0 of what reflects about a half vector, over that of the footprint, where `mixture` is the
// mixture's distribution there, `broad` the second width's part of it, and `base` that of level 0.
vec3 reflecting_tint(appearance fetched, float mixture, float broad, float base) {
    vec3 sum = (mixture - broad) * fetched.width_tints[0] + broad * fetched.width_tints[1] + base;
    return sum / max(mixture + base, 1e-20);
}

vec3 evaluate_footprint_microfacets(appearance fetched, uint light, vec3 halfway, vec3 outgoing,
                                    vec3 incoming) {
    float mixture = fetched.distributions[light], base = 0.0;
    base_material frame = fetched.filtered;
    frame.normal = reflecting_normal(fetched, halfway);
    if (may_see_level_0(lobe_map())) {
        frame.width = mix(frame.width, widened_width(fetched.base), fetched.base_share);
        base = fetched.base_share * evaluate_base_distribution(fetched.base, halfway);
    }
    if (!WIDTH_COLOURS)
        return evaluate_microfacets(frame, fetched.diffuse_normal, mixture + base, halfway,
                                    outgoing, incoming);
    // Lambert's part is below the footprint's F0.
    vec3 diffuse =
        evaluate_microfacets(frame, fetched.diffuse_normal, 0.0, halfway, outgoing, incoming);
    frame.diffuse = vec3(0.0);
    frame.specular *=
        reflecting_tint(fetched, mixture, fetched.broad_distributions[light], base);
    return diffuse + evaluate_microfacets(frame, frame.normal, mixture + base, halfway, outgoing,
                                          incoming);
}

vec3 evaluate_footprint_lobes(appearance fetched, float distribution, vec3 halfway, vec3 incoming) {
    vec3 sum = lobes_colour() * distribution;
    if (may_see_level_0(lobe_map()) && !base_in_walk())
        sum += fetched.base_share * evaluate_half_vector_lobes(fetched.base, halfway);
    sum *= fetched.filtered.specular;
    if (DIFFUSE)
        sum += microfacet_diffuse(fetched.filtered.diffuse, vec3(0.0),
                                  dot(fetched.diffuse_normal, incoming));
    return sum;
}

vec3 evaluate_appearance(appearance fetched, surface_point surface, vec3 incoming, uint light) {
    if (!FILTERED_LOBES)
        return evaluate_base_material(fetched.filtered, surface.outgoing, incoming);
    if (incoming.z <= 0.0)
        return vec3(0.0);
    vec3 halfway = half_vector(incoming, surface.outgoing);
    return MODEL == MODEL_MICROFACET
               ? evaluate_footprint_microfacets(fetched, light, halfway, surface.outgoing,
                                                incoming)
               : evaluate_footprint_lobes(fetched, fetched.distributions[light], halfway,
                                          incoming);
}

#ifdef ENVIRONMENT
vec3 reflect_width(appearance fetched, surface_point surface, lobe one, int width) {
    vec3 axis = one.axis * fetched.mixture_from_tangent;
    half_vector_distribution round =
        round_half_vectors(axis, one.concentration[width], surface.outgoing);
    float mass = one.weight[width] / von_mises_fisher_peak(one.concentration[width]);
    if (MODEL == MODEL_HALF_VECTOR_LOBES)
        return mass * reflect_half_vectors(surface, round);
    // Undoes the normalisation to projected area one; GGX's tails are kept as in `moments`.
    mass *= von_mises_fisher_projected_area(
        concentration_from_complement(fetched.complements[width]));
    base_material frame = fetched.filtered;
    if (WIDTHS > 1)
        frame.width = base_lobe_of_concentration(
            DISTRIBUTION, concentration_from_complement(fetched.complements[width]));
    if (WIDTH_COLOURS)
        frame.specular *= fetched.width_tints[width];
    if (keeps_shape()) {
        round = base_half_vectors(axis, one.parameter[width], surface.outgoing);
        mass += one.own_weight[width];
    }
    return mass * reflect_microfacets(surface, round, frame.specular, frame.width);
}

vec3 reflect_lobe(appearance fetched, surface_point surface, lobe one) {
    vec3 sum = vec3(0.0);
    for (int width = 0; width < WIDTHS; ++width)
        sum += reflect_width(fetched, surface, one, width);
    return sum;
}

vec3 reflect_mixture(inout appearance fetched, surface_point surface) {
    vec3 sum = vec3(0.0);
    walk at = start_walk(fetched);
    if (SUBDIVISION == 0u && !walks_base()) {
        at.sector = SECTOR_ALL; // only one cluster
        return reflect_lobe(fetched, surface, take_cluster(at, fetched));
    }
    while (at.base_lobe < LOBE_COUNT || at.sector < SECTOR_END) {
        lobe next;
        if (walks_base() && at.base_lobe < LOBE_COUNT)
            next = take_base_lobe(at, fetched);
        else
            next = take_cluster(at, fetched);
        sum += reflect_lobe(fetched, surface, next);
    }
    return sum;
}

vec3 reflect_environment(inout appearance fetched, surface_point surface) {
    if (!FILTERED_LOBES)
        return reflect_base_material(surface, fetched.filtered, fetched.filtered.normal);
    fetched.lobe_count = !base_in_walk() && fetched.base_share > 0.0 ? float(LOBE_COUNT) : 0.0;
    vec3 sum = reflect_mixture(fetched, surface);
    if (MODEL == MODEL_HALF_VECTOR_LOBES)
        sum *= lobes_colour() * fetched.filtered.specular;
    if (may_see_level_0(lobe_map()) && !base_in_walk()) {
        base_material base = fetched.base;
        base.specular = fetched.filtered.specular;
        sum += fetched.base_share * reflect_base_specular(surface, base);
    }
    if (DIFFUSE)
        sum += reflect_lambert(surface, fetched.filtered, fetched.diffuse_normal);
    return sum;
}
#endif
