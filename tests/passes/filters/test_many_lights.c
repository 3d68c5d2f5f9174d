// Scenes of many lights: lavapipe silently ends the loops of a shader that takes too many.

#include "tests/passes/support/fixture.h"

#include <math.h>

#include "scenes/scene/scene.h"
#include "tests/passes/support/picture.h"
#include "tests/passes/support/scene_builder.h"
#include "tests/passes/support/slope_plane.h"

enum { EXTENT = 4 };

/// A lamp above the origin, divided into `count`.
static void add_lamps(lobe_scene *scene, lobe_light_type type, uint32_t count) {
    lobe_light light = {.type = type, .position = {-0.5f, 0.6f, 0.3f}, .direction = {0, -1, 0}};
    light.outer_cone = 1.5f;
    for (int i = 0; i < 3; i++)
        light.intensity[i] = 1.0f / (float)count;
    for (uint32_t i = 0; i < count; i++)
        assert_int_equal(scenes_add_light(scene, &light, NULL), LOBE_OK);
}

/// A glowing plane below a sun, a lamp and a spot, each divided into `count`.
static lobe_scene *lit_plane(uint32_t count) {
    lobe_scene *scene = scene_begin();
    lobe_material material = microfacet_material(LOBE_DISTRIBUTION_GGX, 0.5, 0);
    for (int i = 0; i < 3; i++)
        material.emissive[i] = 0.1f;
    material.normal_map = scene_add_map(scene, slope_plane_bumpy_map(64, 0.4));
    scene_add_square(scene, &material, 32, NULL);
    scene_look_from(scene, (const double[3]){0.99, 0.1, 0.1}, 0.15);
    for (int type = LOBE_LIGHT_DIRECTIONAL; type <= LOBE_LIGHT_SPOT; type++)
        add_lamps(scene, (lobe_light_type)type, count);
    scene_end(scene);
    return scene;
}

static lobe_frame drawn(fixture *f, picture_request request, uint32_t count) {
    lobe_scene *scene = lit_plane(count);
    request.width = request.height = EXTENT;
    lobe_frame frame = draw_scene(f, scene, &request);
    lobe_scene_destroy(&scene);
    return frame;
}

static void check(fixture *f, const picture_request *request, uint32_t count) {
    lobe_frame one = drawn(f, *request, 1), many = drawn(f, *request, count);
    const double error = relative_l2(&many.radiance, &one.radiance);
    if (!(error <= 1e-5))
        fail_msg("%s, %s: 3 lights in %u parts differ by %g", request->filter,
                 request->settings[0] ? request->settings[0] : "", count, error);
    lobe_frame_free(&many);
    lobe_frame_free(&one);
}

/// Each light on a closed surface takes loops over its facets.
static void closed_surfaces_show_all_lights(void **state) {
    static const char closed[] = "normal_mapping=microfacet";
    check(*state, &(picture_request){.filter = "moments", .settings = {closed}}, 100);
    check(*state, &(picture_request){.filter = "moments", .settings = {closed, "samples=8"}}, 100);
    check(*state, &(picture_request){.filter = "leadr", .settings = {closed}}, 100);
    check(*state, &(picture_request){.filter = "direct", .settings = {closed}}, 1000);
    check(*state, &(picture_request){.filter = "reference", .settings = {closed}, .samples = 1},
          1000);
}

/// Four lights together fetch each of these bins up to 16 times.
static void footprints_of_many_probes_show_all_lights(void **state) {
    check(*state, &(picture_request){.filter = "moments", .settings = {"probes=16", "bins=6"}},
          1000);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(closed_surfaces_show_all_lights),
        cmocka_unit_test(footprints_of_many_probes_show_all_lights),
    };
    return cmocka_run_group_tests(tests, fixture_create, fixture_destroy);
}
