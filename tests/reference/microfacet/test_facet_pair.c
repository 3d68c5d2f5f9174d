// The closed form of two facets that light each other, against random walks between them: the only
// thing both know is which facet a ray meets (Schuessler et al. 2017, Eqs. 6 and 8).

#include <math.h>
#include <stdint.h>

#include "tests/engine/support/cmocka_all.h"
#include "tests/reference/microfacet/facet_pair.h"
#include "tests/reference/vector.h"

/// Knuth's MMIX generator.
static double random_number(uint64_t *state) {
    *state = *state * 6364136223846793005u + 1442695040888963407u;
    return (double)(*state >> 11) / 9007199254740992.0;
}

/// In proportion to the cosine to the normal: a point of the unit sphere about its tip.
static void lambert_direction(uint64_t *random, const double normal[3], double direction[3]) {
    const double z = 2 * random_number(random) - 1, azimuth = 2 * M_PI * random_number(random);
    const double sine = sqrt(1 - z * z);
    direction[0] = normal[0] + sine * cos(azimuth);
    direction[1] = normal[1] + sine * sin(azimuth);
    direction[2] = normal[2] + z;
    reference_normalise(direction);
}

static void upper_direction(double degrees, double azimuth, double direction[3]) {
    const double angle = degrees * M_PI / 180;
    direction[0] = sin(angle) * cos(azimuth);
    direction[1] = sin(angle) * sin(azimuth);
    direction[2] = cos(angle);
}

/// One walk from the viewer, between Lambert facets: what it gathers of the light from a direction,
/// and, added to `escaped`, whether it leaves the surface.
static double walk(uint64_t *random, const double slope[2], double albedo, const double from[3],
                   const double light[3], double *escaped) {
    double normals[2][3], shares[2], direction[3], weight = 1, sum = 0;
    reference_facet_normals(slope, normals);
    reference_facet_shares(slope, from, shares);
    int facet = random_number(random) < shares[MAPPED_FACET] ? MAPPED_FACET : UPRIGHT_FACET;
    for (;; facet = 1 - facet) {
        weight *= albedo;
        sum += weight / M_PI * fmax(reference_dot(normals[facet], light), 0) *
               reference_facet_masking(slope, light);
        lambert_direction(random, normals[facet], direction);
        if (random_number(random) < reference_facet_masking(slope, direction)) {
            *escaped += weight;
            return sum;
        }
    }
}

enum { WALKS = 20000 };

static void check_walks(uint64_t *random, double steepness, double albedo, double azimuth) {
    const double slope[2] = {steepness * cos(azimuth), steepness * sin(azimuth)};
    double from[3], light[3];
    upper_direction(90 * random_number(random), 0, from);
    upper_direction(85 * random_number(random), 6 * random_number(random), light);
    double sum = 0, squares = 0, escaped = 0;
    for (int i = 0; i < WALKS; i++) {
        const double gathered = walk(random, slope, albedo, from, light, &escaped);
        sum += gathered;
        squares += gathered * gathered;
    }
    const double mean = sum / WALKS,
                 expected = reference_lambert_facet_pair(slope, albedo, from, light);
    const double deviation = sqrt(fmax(squares / WALKS - mean * mean, 0) / WALKS);
    if (!(fabs(mean - expected) <= 4.5 * deviation + 1e-9))
        fail_msg("slope %g, albedo %g: %g, and %g (+-%g) by walks", steepness, albedo, expected,
                 mean, deviation);
    if (albedo == 1)
        assert_float_equal(escaped / WALKS, 1, 1e-6);
}

static void the_closed_form_is_the_mean_of_walks(void **state) {
    (void)state;
    static const double slopes[] = {0.05, 0.3, 0.8, 2}, albedos[] = {0.2, 0.7, 1};
    uint64_t random = 3;
    for (int i = 0; i < 48; i++)
        check_walks(&random, slopes[i % 4], albedos[i % 3], 0.4 * i);
}

/// What is reflected of light from everywhere; all of it if the facets are white.
static double furnace(const double slope[2], double albedo, const double outgoing[3]) {
    enum { RINGS = 200, AZIMUTHS = 400 };
    double sum = 0;
    for (int i = 0; i < RINGS * AZIMUTHS; i++) {
        const double cosine = (i / AZIMUTHS + 0.5) / RINGS;
        double incoming[3];
        upper_direction(acos(cosine) * 180 / M_PI, 2 * M_PI * (i % AZIMUTHS + 0.5) / AZIMUTHS,
                        incoming);
        sum += reference_lambert_facet_pair(slope, albedo, outgoing, incoming);
    }
    return sum * 2 * M_PI / (RINGS * AZIMUTHS);
}

static void white_facets_lose_nothing(void **state) {
    (void)state;
    for (int i = 0; i < 15; i++) {
        const double slope[2] = {0.02 + 0.1 * i, 0.7 - 0.1 * i};
        double outgoing[3];
        upper_direction(6.3 * i, 1, outgoing);
        assert_float_equal(furnace(slope, 1, outgoing), 1, 1e-3);
        assert_true(furnace(slope, 0.5, outgoing) < 0.5001);
    }
}

static void light_and_viewer_can_be_exchanged(void **state) {
    (void)state;
    for (int i = 0; i < 50; i++) {
        const double slope[2] = {0.3 * (i % 7) - 0.8, 0.1 + 0.02 * i};
        double a[3], b[3];
        upper_direction(1.7 * i, 0.3 * i, a);
        upper_direction(80 - 1.5 * i, 2 + 0.7 * i, b);
        assert_float_equal(reference_lambert_facet_pair(slope, 0.6, a, b) / b[2],
                           reference_lambert_facet_pair(slope, 0.6, b, a) / a[2], 1e-6);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_closed_form_is_the_mean_of_walks),
        cmocka_unit_test(white_facets_lose_nothing),
        cmocka_unit_test(light_and_viewer_can_be_exchanged),
    };
    return cmocka_run_group_tests_name("facet_pair", tests, NULL, NULL);
}
