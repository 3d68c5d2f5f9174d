// What microfacets reflect of an environment: spheres, whose pixels see it at all angles, drawn by
// each method of lighting, against the sum over all its texels.

#include "tests/passes/support/fixture.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "tests/long_runs.h"
#include "tests/passes/support/picture.h"
#include "tests/passes/support/scene_builder.h"
#include "tests/reference/microfacet/directional_albedo.h"

enum { EXTENT = 24 };

/// The camera is orthographic and shows the sphere's whole width.
static const double towards[3] = {0.4, 0.5, 1};

// ---------------------------------------------------------------------------------------------
// Environments

static void white(const double direction[3], float radiance[3]) {
    (void)direction;
    for (int i = 0; i < 3; i++)
        radiance[i] = 1;
}

/// A blue sky with a sun of a few degrees, brown ground.
static void landscape(const double direction[3], float radiance[3]) {
    static const float sky[] = {0.3f, 0.5f, 1}, ground[] = {0.3f, 0.2f, 0.1f};
    double cosine = (0.6 * direction[0] + 0.6 * direction[1] + 0.53 * direction[2]);
    for (int i = 0; i < 3; i++)
        radiance[i] =
            (direction[1] > 0 ? sky[i] : ground[i]) + (float)(60 * exp(90 * (cosine - 1)));
}

/// Three windows of a dim room.
static void room(const double direction[3], float radiance[3]) {
    static const double windows[3][3] = {{0, 0, 1}, {0.8, 0.6, 0}, {-0.6, 0, -0.8}};
    for (int i = 0; i < 3; i++) {
        double cosine = direction[0] * windows[i][0] + direction[1] * windows[i][1] +
                        direction[2] * windows[i][2];
        radiance[i] = 0.1f + (float)(6 * exp(14 * (cosine - 1)));
    }
}

// ---------------------------------------------------------------------------------------------
// Spheres

static lobe_material metal(double roughness) {
    lobe_material material;
    lobe_material_default(&material);
    material.roughness = (float)roughness;
    material.metallic = 1;
    return material;
}

/// Normals up to `tilt` radians off, several texels to a pixel.
static lobe_scene *sphere_in(environment_radiance radiance, const lobe_material *material,
                             double tilt) {
    lobe_scene *scene = scene_begin();
    lobe_material mapped = *material;
    mapped.normal_map = scene_add_map(scene, tilt > 0 ? random_normal_map(32, 32, tilt, 7)
                                                      : constant_map(32, 32, 0.5f, 0.5f, 1));
    scene_add_sphere(scene, &mapped, 8);
    scene_surround(scene, 32, radiance);
    scene_look_from(scene, towards, 2);
    scene_end(scene);
    return scene;
}

static lobe_frame draw_by(fixture *f, const lobe_scene *scene, const char *filter,
                          const char *method, const char *knob) {
    picture_request request = {.filter = filter,
                               .settings = {method, "env_size=16", knob},
                               .width = EXTENT,
                               .height = EXTENT,
                               .samples = 64};
    return draw_scene(f, scene, &request);
}

/// The mean of a channel over pixels that see the sphere at [low, high) degrees.
static double mean_between(const lobe_frame *frame, int channel, double low, double high) {
    double sum = 0;
    int count = 0;
    for (uint32_t i = 0; i < EXTENT * EXTENT; i++) {
        double x = (2 * (i % EXTENT) + 1.0) / EXTENT - 1, y = (2 * (i / EXTENT) + 1.0) / EXTENT - 1;
        double angle = asin(fmin(sqrt(x * x + y * y), 1)) * 180 / M_PI;
        if (x * x + y * y < 1 && angle >= low && angle < high) {
            sum += (double)pixel_at(&frame->radiance, i % EXTENT, i / EXTENT)[channel];
            count++;
        }
    }
    assert_true(count > 0);
    return sum / count;
}

/// Fails unless the mean of each channel is near to that of the exact picture, up to 60 degrees of
/// view and up to 80.
static void check_light(fixture *f, const lobe_scene *scene, const char *what, const char *filter,
                        const char *method, double to_60, double to_80) {
    lobe_frame exact = draw_by(f, scene, filter, "env=exact", NULL);
    lobe_frame frame = draw_by(f, scene, filter, method, NULL);
    double near[3], far[3];
    for (int i = 0; i < 3; i++) {
        near[i] = mean_between(&frame, i, 0, 60) / mean_between(&exact, i, 0, 60) - 1;
        far[i] = mean_between(&frame, i, 0, 80) / mean_between(&exact, i, 0, 80) - 1;
    }
    print_message("# %s, %s, %s: %+.3f %+.3f %+.3f, to 80 degrees %+.3f %+.3f %+.3f, %.3f off\n",
                  what, filter, method, near[0], near[1], near[2], far[0], far[1], far[2],
                  relative_l2(&frame.radiance, &exact.radiance));
    for (int i = 0; i < 3; i++) {
        if (!(fabs(near[i]) <= to_60 && fabs(far[i]) <= to_80))
            fail_msg("%s, %s, %s, channel %d: %+.3f, to 80 degrees %+.3f", what, filter, method, i,
                     near[i], far[i]);
    }
    lobe_frame_free(&exact);
    lobe_frame_free(&frame);
}

// ---------------------------------------------------------------------------------------------
// Light

/// To 60 degrees, hardly any of the room's blue light is seen: no mean over many lobes.
static const struct {
    const char *name;
    environment_radiance radiance;
    double to_60, to_80;
} environments[] = {{"landscape", landscape, 0.03, 0.04}, {"room", room, 0.15, 0.09}};

static void rough_metal_reflects_what_it_should(void **state) {
    static const double roughnesses[] = {0.35, 0.6, 1};
    for (int e = 0; e < 2; e++) {
        for (size_t i = 0; i < sizeof roughnesses / sizeof *roughnesses; i++) {
            lobe_material material = metal(roughnesses[i]);
            lobe_scene *scene = sphere_in(environments[e].radiance, &material, 0);
            char what[64];
            snprintf(what, sizeof what, "%s, roughness %g", environments[e].name, roughnesses[i]);
            check_light(*state, scene, what, "direct", "env=prefiltered", environments[e].to_60,
                        environments[e].to_80);
            lobe_scene_destroy(&scene);
        }
    }
}

/// Where Fresnel reflects most.
static void black_dielectrics_do_too(void **state) {
    lobe_material material = metal(0.6);
    material.metallic = 0;
    for (int i = 0; i < 3; i++)
        material.base_colour[i] = 0;
    for (int e = 0; e < 2; e++) {
        lobe_scene *scene = sphere_in(environments[e].radiance, &material, 0);
        check_light(*state, scene, environments[e].name, "direct", "env=prefiltered",
                    environments[e].to_60, environments[e].to_80);
        lobe_scene_destroy(&scene);
    }
}

/// Of filtered maps; `lean` reflects Beckmann's lobes.
static void filters_reflect_what_they_should(void **state) {
    static const struct {
        const char *filter;
        double to_60;
    } cases[] = {{"mipmap", 0.03},  {"toksvig", 0.04}, {"lobes", 0.08},
                 {"moments", 0.12}, {"lean", 0.12},    {"leadr", 0.03}};
    lobe_material material = metal(0.6);
    lobe_scene *rough = sphere_in(landscape, &material, 0.35);
    hold_scene(*state, rough);
    for (size_t i = !long_runs(); i < sizeof cases / sizeof *cases; i += long_runs() ? 1 : 2)
        check_light(*state, rough, "rough", cases[i].filter, "env=prefiltered", cases[i].to_60,
                    1.3 * cases[i].to_60);
    hold_scene(*state, NULL);
    lobe_scene_destroy(&rough);
}

// ---------------------------------------------------------------------------------------------
// Energy: white light from all sides

/// Degrees of view, in rings, and what one facet reflects of white light there.
enum { RINGS = 4 };
static const double rings[RINGS + 1] = {0, 25, 45, 60, 75};

static void check_white(fixture *f, const lobe_scene *scene, const char *what, const char *filter,
                        const char *method, const double expected[RINGS],
                        const double tolerance[RINGS]) {
    lobe_frame frame = draw_by(f, scene, filter, method, NULL);
    double found[RINGS];
    for (int i = 0; i < RINGS; i++)
        found[i] = mean_between(&frame, 1, rings[i], rings[i + 1]);
    print_message("# %s, %s, %s: %.3f %.3f %.3f %.3f\n", what, filter, method, found[0], found[1],
                  found[2], found[3]);
    for (int i = 0; i < RINGS; i++) {
        if (!(fabs(found[i] / expected[i] - 1) <= tolerance[i]))
            fail_msg("%s, %s, %s, %g degrees: %.3f instead of %.3f", what, filter, method, rings[i],
                     found[i], expected[i]);
    }
    lobe_frame_free(&frame);
}

/// By brute force, over the same pixels.
static void white_albedo(double roughness, double expected[RINGS]) {
    int counts[RINGS] = {0};
    for (int i = 0; i < RINGS; i++)
        expected[i] = 0;
    for (int i = 0; i < EXTENT * EXTENT / 4; i++) {
        double x = (2 * (i % (EXTENT / 2)) + 1.0) / EXTENT,
               y = (2 * (i / (EXTENT / 2)) + 1.0) / EXTENT;
        double angle = asin(fmin(sqrt(x * x + y * y), 1)) * 180 / M_PI, parts[2];
        for (int ring = 0; ring < RINGS; ring++) {
            if (!(angle >= rings[ring] && angle < rings[ring + 1]))
                continue;
            reference_specular_parts(LOBE_DISTRIBUTION_GGX, cos(angle * M_PI / 180), roughness,
                                     parts);
            expected[ring] += parts[0] + parts[1];
            counts[ring]++;
        }
    }
    for (int i = 0; i < RINGS; i++)
        expected[i] /= counts[i];
}

/// Flat metal reflects what one facet does; what the papers of `lean`
/// and `leadr` make of GGX is tested in their own tests.
static void white_light_is_reflected_once(void **state) {
    only_in_long_runs();
    static const char *const filters[] = {"direct", "lobes", "moments"};
    static const double roughnesses[] = {0.4, 0.8};
    static const double prefiltered[RINGS] = {0.01, 0.01, 0.01, 0.02};
    static const double sampled[RINGS] = {0.05, 0.05, 0.05, 0.06};
    for (int r = 0; r < 2; r++) {
        double expected[RINGS];
        white_albedo(roughnesses[r], expected);
        lobe_material material = metal(roughnesses[r]);
        lobe_scene *scene = sphere_in(white, &material, 0);
        hold_scene(*state, scene);
        for (size_t i = 0; i < sizeof filters / sizeof *filters; i++) {
            check_white(*state, scene, "flat", filters[i], "env=prefiltered", expected,
                        prefiltered);
            check_white(*state, scene, "flat", filters[i], "env=sampled", expected, sampled);
        }
        check_white(*state, scene, "flat", "direct", "env=exact", expected, sampled);
        hold_scene(*state, NULL);
        lobe_scene_destroy(&scene);
    }
}

/// With normals spread by several degrees, filters reflect of white light what the reference does:
/// what faces away is dark, and what is reflected into the ground is lost.
static void rough_surfaces_lose_what_they_should(void **state) {
    static const char *const filters[] = {"lobes", "moments"};
    static const double tolerance[RINGS] = {0.05, 0.05, 0.06, 0.08};
    static const double roughnesses[] = {0.3, 0.7};
    for (int r = long_runs() ? 0 : 1; r < 2; r++) {
        lobe_material material = metal(roughnesses[r]);
        lobe_scene *scene = sphere_in(white, &material, 0.5);
        lobe_frame truth = draw_by(*state, scene, "reference", "env=exact", NULL);
        double expected[RINGS];
        for (int i = 0; i < RINGS; i++)
            expected[i] = mean_between(&truth, 1, rings[i], rings[i + 1]);
        print_message("# reference: %.3f %.3f %.3f %.3f\n", expected[0], expected[1], expected[2],
                      expected[3]);
        for (size_t i = 0; i < sizeof filters / sizeof *filters; i++)
            check_white(*state, scene, "rough", filters[i], "env=prefiltered", expected, tolerance);
        lobe_frame_free(&truth);
        lobe_scene_destroy(&scene);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rough_metal_reflects_what_it_should),
        cmocka_unit_test(black_dielectrics_do_too),
        cmocka_unit_test(filters_reflect_what_they_should),
        cmocka_unit_test(white_light_is_reflected_once),
        cmocka_unit_test(rough_surfaces_lose_what_they_should),
    };
    return cmocka_run_group_tests(tests, fixture_create, fixture_destroy);
}
