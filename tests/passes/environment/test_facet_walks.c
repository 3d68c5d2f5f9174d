// Closed normal-mapped surfaces (the knob `normal_mapping`) of metal under a sun, against random
// walks between a texel's two facets. Walks know which facet a ray meets and how each facet
// scatters, but neither the sums of all orders nor the fits of shaders/shading/facet_pairs.glsl.

#include "tests/passes/support/fixture.h"

#include <math.h>
#include <stdint.h>

#include "tests/passes/support/scene_builder.h"
#include "tests/passes/support/shading_reference.h"
#include "tests/passes/support/slope_plane.h"
#include "tests/reference/microfacet/facet_pair.h"
#include "tests/reference/microfacet/microfacet.h"
#include "tests/reference/vector.h"

enum { WALKS = 60000, ORDERS = 16 };

static const double f0 = 0.8;

/// A texel's facets.
typedef struct facet_pair {
    double slope[2], normals[2][3];
    double alpha;
    double albedo; // of the upright facet
} facet_pair;

/// Knuth's MMIX generator.
static double random_number(uint64_t *state) {
    *state = *state * 6364136223846793005u + 1442695040888963407u;
    return (double)(*state >> 11) / 9007199254740992.0;
}

/// Along x and z of a frame about `normal`.
static void direction_about(const double normal[3], double cosine, double azimuth,
                            double direction[3]) {
    const double sine = sqrt(fmax(1 - cosine * cosine, 0));
    double first[3] = {normal[1], -normal[0], 0};
    reference_normalise(first);
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        const double second = normal[j] * first[k] - normal[k] * first[j];
        direction[i] =
            cosine * normal[i] + sine * (cos(azimuth) * first[i] + sin(azimuth) * second);
    }
}

/// A half vector of GGX (Walter et al. 2007, Eqs. 35 and 36), and what it reflects: the weight.
static double reflect_microfacet(uint64_t *random, const double normal[3], double alpha,
                                 const double outgoing[3], double incoming[3]) {
    const double u = random_number(random), tangent = alpha * sqrt(u / (1 - u));
    double half_vector[3];
    direction_about(normal, 1 / sqrt(1 + tangent * tangent), 2 * M_PI * random_number(random),
                    half_vector);
    const double product = reference_dot(half_vector, outgoing);
    for (int i = 0; i < 3; i++)
        incoming[i] = 2 * product * half_vector[i] - outgoing[i];
    const double lit = reference_dot(normal, incoming), seen = reference_dot(normal, outgoing);
    if (product <= 0 || lit <= 0 || seen <= 0)
        return 0;
    return reference_fresnel(f0, 1, product) * product *
           reference_masking_shadowing(LOBE_DISTRIBUTION_GGX, lit, seen, alpha) /
           (seen * reference_dot(normal, half_vector));
}

static double scatter(uint64_t *random, const facet_pair *pair, int facet, const double outgoing[3],
                      double incoming[3]) {
    if (facet == MAPPED_FACET)
        return reflect_microfacet(random, pair->normals[facet], pair->alpha, outgoing, incoming);
    direction_about(pair->normals[facet], sqrt(random_number(random)),
                    2 * M_PI * random_number(random), incoming);
    return pair->albedo;
}

/// What a facet reflects of a sun, before the other one hides it.
static double reflect_sun(const facet_pair *pair, int facet, const double outgoing[3],
                          const double sun[3]) {
    const double *normal = pair->normals[facet];
    const double lit = reference_dot(normal, sun), seen = reference_dot(normal, outgoing);
    if (facet == UPRIGHT_FACET)
        return pair->albedo / M_PI * fmax(lit, 0);
    if (lit <= 0 || seen <= 0)
        return 0;
    double half_vector[3];
    half_between(outgoing, sun, half_vector);
    return reference_microfacet_specular(
        reference_fresnel(f0, 1, reference_dot(sun, half_vector)),
        reference_normal_distribution(LOBE_DISTRIBUTION_GGX, normal, half_vector, pair->alpha),
        reference_masking_shadowing(LOBE_DISTRIBUTION_GGX, lit, seen, pair->alpha), seen);
}

static double walk(uint64_t *random, const facet_pair *pair, const double viewer[3],
                   const double sun[3]) {
    double shares[2], outgoing[3] = {viewer[0], viewer[1], viewer[2]}, weight = 1, sum = 0;
    reference_facet_shares(pair->slope, viewer, shares);
    int facet = random_number(random) < shares[MAPPED_FACET] ? MAPPED_FACET : UPRIGHT_FACET;
    for (int order = 0; order < ORDERS && weight > 0; order++, facet = 1 - facet) {
        sum += weight * reflect_sun(pair, facet, outgoing, sun) *
               reference_facet_masking(pair->slope, sun);
        double incoming[3];
        weight *= scatter(random, pair, facet, outgoing, incoming);
        if (random_number(random) < reference_facet_masking(pair->slope, incoming))
            break;
        for (int i = 0; i < 3; i++)
            outgoing[i] = -incoming[i];
    }
    return sum;
}

/// The upright facet is as bright as the mapped one's microfacets in light from everywhere.
static double mean_albedo(uint64_t *random, const facet_pair *pair) {
    double sum = 0, weights = 0;
    for (int i = 0; i < WALKS; i++) {
        double outgoing[3], incoming[3];
        direction_about(pair->normals[MAPPED_FACET], sqrt(random_number(random)), 0, outgoing);
        sum += reflect_microfacet(random, pair->normals[MAPPED_FACET], pair->alpha, outgoing,
                                  incoming);
        weights += 1;
    }
    return sum / weights;
}

static facet_pair make_pair(uint64_t *random, const double normal[3], double roughness) {
    facet_pair pair = {.slope = {-normal[0] / normal[2], -normal[1] / normal[2]},
                       .alpha = roughness * roughness};
    reference_facet_normals(pair.slope, pair.normals);
    pair.albedo = mean_albedo(random, &pair);
    return pair;
}

static double drawn(fixture *f, const lobe_image *normals, double roughness, const double viewer[3],
                    const double sun[3]) {
    lobe_material metal = microfacet_material(LOBE_DISTRIBUTION_GGX, roughness, 1), mapped;
    for (int i = 0; i < 3; i++)
        metal.base_colour[i] = (float)f0;
    lobe_scene *scene = slope_plane(&metal, normals, viewer, &mapped);
    slope_plane_add_sun(scene, sun, 1);
    float colour[3];
    slope_plane_draw(f, scene, "direct", "normal_mapping=microfacet", colour);
    lobe_scene_destroy(&scene);
    return (double)colour[1];
}

static void check_texel(fixture *f, uint64_t *random, double steepness, double roughness) {
    double normal[3] = {steepness * cos(1), steepness * sin(1), 1};
    reference_normalise(normal);
    lobe_image normals =
        constant_map(1, 1, (float)(0.5 + 0.5 * normal[0]), (float)(0.5 + 0.5 * normal[1]),
                     (float)(0.5 + 0.5 * normal[2]));
    const facet_pair pair = make_pair(random, normal, roughness);
    for (int i = 0; i < 6; i++) {
        double viewer[3], sun[3], sum = 0, squares = 0;
        slope_plane_direction(75 - 15 * i % 90, 1.1 * i, viewer);
        slope_plane_direction(20 + 11 * i, 2 + 2.3 * i, sun);
        for (int j = 0; j < WALKS; j++) {
            const double value = walk(random, &pair, viewer, sun);
            sum += value / WALKS;
            squares += value * value / WALKS;
        }
        const double deviation = sqrt(fmax(squares - sum * sum, 0) / WALKS);
        const double found = drawn(f, &normals, roughness, viewer, sun);
        if (!(fabs(found - sum) <= 4.5 * deviation + 0.006 + 0.01 * sum))
            fail_msg("slope %g, roughness %g, case %d: %g, and %g (+-%g) by walks", steepness,
                     roughness, i, found, sum, deviation);
    }
    lobe_image_free(&normals);
}

static void metal_reflects_what_walks_gather(void **state) {
    uint64_t random = 5;
    check_texel(*state, &random, 0.2, 0.5);
    check_texel(*state, &random, 0.6, 0.5);
    check_texel(*state, &random, 1.2, 0.4);
    check_texel(*state, &random, 0.6, 0.9);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(metal_reflects_what_walks_gather),
    };
    return cmocka_run_group_tests(tests, fixture_create, fixture_destroy);
}
