// Polished microfacets of GGX far from their highlight, where their long tails are all that is seen
// of metal, against the mean of what the texels reflect. Sums of Gaussians end where those begin.

#include "tests/passes/support/fixture.h"

#include <math.h>

#include "tests/long_runs.h"
#include "tests/passes/support/scene_builder.h"
#include "tests/passes/support/slope_plane.h"

enum { EXTENT = 32 };

static void check_views(fixture *f, const char *filter, const lobe_material *material, double slope,
                        double tolerance) {
    lobe_image normals = slope_plane_bumpy_map(EXTENT, slope);
    for (int i = 0; i < 4; i++) {
        double outgoing[3], incoming[3];
        float found[3];
        slope_plane_direction(i < 2 ? 20 : 65, 0, outgoing);
        slope_plane_direction(i % 2 == 0 ? 25 : 60, i % 2 == 0 ? 0.6 * M_PI : 0.1, incoming);
        slope_plane_draw_lit(f, material, &normals, filter, NULL, outgoing, incoming, found);
        double expected = slope_plane_bumpy_radiance(material, EXTENT, slope, outgoing, incoming);
        if (!(fabs((double)found[1] / expected - 1) < tolerance))
            fail_msg("%s, roughness %g, slopes of %g, direction %d: %g instead of %g", filter,
                     (double)material->roughness, slope, i, (double)found[1], expected);
    }
    lobe_image_free(&normals);
}

static void metal_shines_far_from_its_highlight(void **state) {
    // Clusters have tails about their axes; bins, about each of their normals.
    static const struct {
        const char *name;
        double tolerance;
    } filters[] = {
        {"moments", 0.1}, {"leadr", 0.1}, {"lobes", 0.35}, {"mixture", 0.1}, {"multi_leadr", 0.1}};
    static const struct {
        float roughness;
        double slope;
    } surfaces[] = {{0.1f, 0.02}, {0.2f, 0.02}, {0.1f, 0.04}, {0.25f, 0.05}};
    for (size_t i = 0; i < (long_runs() ? 5 : 3); i++)
        for (size_t k = 0; k < sizeof surfaces / sizeof *surfaces; k++) {
            const lobe_material material =
                microfacet_material(LOBE_DISTRIBUTION_GGX, surfaces[k].roughness, 1);
            check_views(*state, filters[i].name, &material, surfaces[k].slope,
                        filters[i].tolerance);
        }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(metal_shines_far_from_its_highlight),
    };
    return cmocka_run_group_tests(tests, fixture_create, fixture_destroy);
}
