// Deferred shading (knob shading): pictures are those of shading by triangles, bit by bit.

#include "tests/passes/support/fixture.h"

#include <math.h>
#include <string.h>

#include "scenes/scene/scene.h"
#include "tests/passes/support/picture.h"
#include "tests/passes/support/scene_builder.h"

enum { SIZE = 48 };

// ---------------------------------------------------------------------------------------------
// A scene of everything that a picture of surfaces holds, and of what it does not

static void place(lobe_scene *scene, float x, float y, float scale, float mirror) {
    const float transform[16] = {scale * mirror, 0, 0, 0,    0, scale, 0, 0, 0, 0,
                                 scale,          0, x, 0.3f, y, 1};
    memcpy(scene->instances[scene->instance_count - 1].transform, transform, sizeof transform);
}

static lobe_material bumpy(lobe_scene *scene, uint64_t seed) {
    lobe_material material = microfacet_material(LOBE_DISTRIBUTION_GGX, 0.4, 0);
    material.normal_map = scene_add_map(scene, random_normal_map(32, 32, 0.4, seed));
    return material;
}

/// With holes.
static void add_masked_sphere(lobe_scene *scene) {
    lobe_material material = bumpy(scene, 3);
    lobe_image colours = random_map(16, 16, 0, 1, 4);
    material.base_colour_map = scene_add_map(scene, colours);
    material.alpha_mask = true;
    material.alpha_cutoff = 0.5f;
    scene_add_sphere(scene, &material, 2);
    place(scene, 0.6f, 0.5f, 0.3f, 1);
}

static void add_coloured_sphere(lobe_scene *scene) {
    const lobe_material material = bumpy(scene, 5);
    scene_add_sphere(scene, &material, 3);
    place(scene, -0.6f, 0.5f, 0.3f, 1);
    lobe_mesh *mesh = &scene->meshes[scene->mesh_count - 1];
    mesh->has_colour = true;
    for (size_t i = 0; i < mesh->vertex_count; i++)
        mesh->vertices[i].colour[i % 3] = 0.3f;
}

static void add_mirrored_sphere(lobe_scene *scene) {
    const lobe_material material = bumpy(scene, 6);
    scene_add_sphere(scene, &material, 2);
    place(scene, 0.6f, -0.5f, 0.3f, -1);
}

static void add_relief(lobe_scene *scene) {
    lobe_material material = microfacet_material(LOBE_DISTRIBUTION_GGX, 0.5, 0);
    material.height_map = scene_add_map(scene, random_map(32, 32, 0, 1, 7));
    material.height_scale = 0.05f;
    scene_add_sphere(scene, &material, 2);
    place(scene, -0.6f, -0.5f, 0.3f, 1);
}

/// Its back.
static void add_back(lobe_scene *scene) {
    lobe_material material = bumpy(scene, 8);
    material.double_sided = true;
    const float turned[16] = {0.2f, 0, 0, 0, 0, -0.2f, 0.1f, 0, 0, -0.1f, -0.2f, 0, 0, 0.6f, 0, 1};
    scene_add_square(scene, &material, 2, turned);
}

static void add_second_set(lobe_scene *scene) {
    lobe_material material = bumpy(scene, 9);
    material.normal_map.texture_coordinates = 1;
    scene_add_square(scene, &material, 2, NULL);
    place(scene, 0, 0.8f, 0.15f, 1);
    lobe_mesh *mesh = &scene->meshes[scene->mesh_count - 1];
    for (size_t i = 0; i < mesh->vertex_count; i++)
        for (int k = 0; k < 2; k++)
            mesh->vertices[i].texture_coordinates[1][k] =
                3 * mesh->vertices[i].texture_coordinates[0][k];
}

static void sky(const double direction[3], float radiance[3]) {
    for (int i = 0; i < 3; i++)
        radiance[i] = (float)(0.3 + 0.2 * direction[i]);
}

static lobe_scene *everything(uint32_t lamps, bool surrounded) {
    lobe_scene *scene = scene_begin();
    const lobe_material ground = bumpy(scene, 2);
    add_masked_sphere(scene);
    scene_add_square(scene, &ground, 6, NULL);
    add_coloured_sphere(scene);
    add_mirrored_sphere(scene);
    add_relief(scene);
    add_back(scene);
    add_second_set(scene);
    scene_add_sun(scene, (double[]){0.4, 1, 0.3}, 2);
    lobe_light lamp = {.type = LOBE_LIGHT_POINT, .position = {-0.2f, 1, 0.2f}};
    for (int i = 0; i < 3; i++)
        lamp.intensity[i] = 1 / (float)lamps;
    for (uint32_t i = 0; i < lamps; i++)
        assert_int_equal(scenes_add_light(scene, &lamp, NULL), LOBE_OK);
    if (surrounded)
        scene_surround(scene, 8, sky);
    scene_look_from(scene, (double[]){0.2, 1, 0.7}, 2.2);
    scene_end(scene);
    return scene;
}

/// Of so many materials that each is looked for in the picture: some on others, some hidden below,
/// some at the edge and some outside.
static lobe_scene *many_squares(void) {
    enum { SQUARES = 40 };
    lobe_scene *scene = scene_begin();
    lobe_material material = bumpy(scene, 2);
    for (int i = 0; i < SQUARES; i++) {
        material.roughness = 0.2f + 0.01f * (float)i;
        scene_add_square(scene, &material, 1, NULL);
        const float x = -1.3f + 0.07f * (float)i, height = i % 3 ? 0.01f * (float)i : -0.2f;
        const float transform[16] = {
            0.2f, 0, 0, 0, 0, 0.2f, 0.05f, 0, 0, 0, 0.3f, 0, x, height, 0.9f * sinf(x * 9), 1};
        memcpy(scene->instances[scene->instance_count - 1].transform, transform, sizeof transform);
    }
    material.roughness = 0.9f;
    scene_add_square(scene, &material, 1, NULL);
    scene_add_sun(scene, (double[]){0.4, 1, 0.3}, 2);
    scene_look_down(scene, 2);
    scene_end(scene);
    return scene;
}

// ---------------------------------------------------------------------------------------------
// Comparisons

static picture_request request_of(const char *filter, const char *const settings[],
                                  const char *shading) {
    picture_request request = {
        .filter = filter, .width = SIZE, .height = SIZE, .samples = 2, .outputs = true};
    size_t count = 0;
    while (settings[count]) {
        request.settings[count] = settings[count];
        count++;
    }
    request.settings[count] = shading;
    return request;
}

static void assert_same_image(const lobe_image *a, const lobe_image *b, double tolerance,
                              const char *what, const picture_request *request) {
    assert_int_equal(a->format, b->format);
    const size_t bytes = (size_t)a->width * a->height * lobe_format_size(a->format);
    if (memcmp(a->texels, b->texels, bytes) != 0 && !(largest_difference(a, b) <= tolerance))
        fail_msg("%s, %s %s: another %s, by up to %g", request->filter,
                 request->settings[0] ? request->settings[0] : "",
                 request->settings[1] ? request->settings[1] : "", what, largest_difference(a, b));
}

static size_t pictures_of_surfaces(const fixture *f) {
    return count_passes(lobe_renderer_graph(f->renderer), "surfaces", LOBE_PASS_RUN);
}

static void check(fixture *f, const lobe_scene *scene, const char *filter,
                  const char *const settings[], double tolerance) {
    picture_request request = request_of(filter, settings, "shading=triangles");
    lobe_frame expected = draw_silently(f, scene->name, &request);
    assert_int_equal(pictures_of_surfaces(f), 0);
    request = request_of(filter, settings, "shading=deferred");
    lobe_frame deferred = draw_silently(f, scene->name, &request);
    assert_true(pictures_of_surfaces(f) > 0);
    assert_same_image(&deferred.radiance, &expected.radiance, tolerance, "radiance", &request);
    assert_same_image(&deferred.normal_depth, &expected.normal_depth, 0, "normal or depth",
                      &request);
    assert_same_image(&deferred.lobes_level, &expected.lobes_level, 0, "lobes or level", &request);
    lobe_frame_free(&expected);
    lobe_frame_free(&deferred);
}

/// Draws a scene, which it frees, with filters and settings.
static void check_all(fixture *f, lobe_scene *scene, const char *const cases[][4], size_t count,
                      double tolerance) {
    assert_int_equal(lobe_renderer_set_scene(f->renderer, scene), LOBE_OK);
    for (size_t i = 0; i < count; i++)
        check(f, scene, cases[i][0], &cases[i][1], tolerance);
    assert_int_equal(lobe_renderer_set_scene(f->renderer, NULL), LOBE_OK);
    lobe_scene_destroy(&scene);
}

static void pictures_are_the_same(void **state) {
    static const char *const cases[][4] = {
        {"direct", "samples=auto", NULL},
        {"moments", NULL},
        {"direct", "displacement=geometry", "shadows=512", NULL},
    };
    check_all(*state, everything(1, false), cases, sizeof cases / sizeof *cases, 0);
}

static void pictures_of_many_batches_are_the_same(void **state) {
    fixture *f = *state;
    static const char *const settings[][3] = {{NULL}, {"samples=auto", NULL}};
    lobe_scene *scene = many_squares();
    assert_int_equal(lobe_renderer_set_scene(f->renderer, scene), LOBE_OK);
    for (int i = 0; i < 2; i++) {
        check(f, scene, "direct", settings[i], 0);
        assert_true(count_passes(lobe_renderer_graph(f->renderer), "surface_rectangles",
                                 LOBE_PASS_RUN) > 0);
    }
    assert_int_equal(lobe_renderer_set_scene(f->renderer, NULL), LOBE_OK);
    lobe_scene_destroy(&scene);
}

/// Each part of them is added from the same picture of surfaces.
static void pictures_of_many_lights_are_the_same(void **state) {
    static const char *const cases[][4] = {{"direct", "samples=2", "shadows=512", NULL}};
    check_all(*state, everything(100, false), cases, 1, 0);
}

/// Lavapipe rounds texels of cubes by those that the pixels around read.
static void pictures_under_a_sky_are_the_same(void **state) {
    static const char *const cases[][4] = {{"direct", "samples=auto", NULL}};
    check_all(*state, everything(1, true), cases, 1, 1e-6);
}

// ---------------------------------------------------------------------------------------------
// Marking of tiles

/// Holes through which a surface without maps is seen.
static lobe_scene *leaf_on_plain_ground(void) {
    lobe_scene *scene = scene_begin();
    const lobe_material ground = microfacet_material(LOBE_DISTRIBUTION_GGX, 0.5, 0);
    scene_add_square(scene, &ground, 1, NULL);
    add_masked_sphere(scene);
    scene_add_sun(scene, (double[]){0.4, 1, 0.3}, 2);
    scene_end(scene);
    return scene;
}

static lobe_frame from_place(fixture *f, lobe_scene *scene, int place, const char *built) {
    static const double towards[][3] = {{0.2, 1, 0.7}, {0.7, 0.4, 0.2}, {-0.6, 0.9, -0.4}};
    scene_look_from(scene, towards[place], 1.2 + 0.5 * place);
    picture_request request =
        request_of("moments", (const char *[]){"samples=1", built, NULL}, "shading=deferred");
    request.samples = 1;
    return draw_silently(f, scene->name, &request);
}

/// Tiles are marked from the picture of surfaces that shading reads: one is drawn. Pictures are
/// those of whole maps, from one place after another.
static void check_marking(fixture *f, lobe_scene *scene) {
    enum { PLACES = 3 };
    lobe_frame whole[PLACES];
    for (int seen = 0; seen < 2; seen++) {
        assert_int_equal(lobe_renderer_set_scene(f->renderer, scene), LOBE_OK);
        for (int i = 0; i < PLACES; i++) {
            lobe_frame frame = from_place(f, scene, i, seen ? "built=seen" : "built=whole");
            assert_int_equal(pictures_of_surfaces(f), 1);
            if (!seen) {
                whole[i] = frame;
                continue;
            }
            assert_true(
                count_passes(lobe_renderer_graph(f->renderer), "tile_marking", LOBE_PASS_RUN) > 0);
            if (image_hash(&frame.radiance) != image_hash(&whole[i].radiance))
                fail_msg("place %d: by %g", i,
                         largest_difference(&frame.radiance, &whole[i].radiance));
            lobe_frame_free(&frame);
        }
    }
    for (int i = 0; i < PLACES; i++)
        lobe_frame_free(&whole[i]);
    assert_int_equal(lobe_renderer_set_scene(f->renderer, NULL), LOBE_OK);
    lobe_scene_destroy(&scene);
}

static void tiles_are_marked_from_the_same_picture(void **state) {
    check_marking(*state, everything(1, false));
    check_marking(*state, leaf_on_plain_ground());
}

/// Holes are in the picture: nothing is left to be drawn by its triangles.
static void masks_cut_the_picture(void **state) {
    fixture *f = *state;
    lobe_scene *scene = leaf_on_plain_ground();
    scene_look_down(scene, 2);
    assert_int_equal(lobe_renderer_set_scene(f->renderer, scene), LOBE_OK);
    check(f, scene, "toksvig", (const char *[]){"samples=1", NULL}, 0);
    assert_int_equal(count_passes(lobe_renderer_graph(f->renderer), "shading", LOBE_PASS_RUN), 1);
    assert_int_equal(lobe_renderer_set_scene(f->renderer, NULL), LOBE_OK);
    lobe_scene_destroy(&scene);
}

// ---------------------------------------------------------------------------------------------
// The choice

/// Of a sphere of thousands of triangles, or of this many squares.
static size_t pictures_by_default(fixture *f, const char *filter, int squares, uint32_t extent) {
    lobe_scene *scene = scene_begin();
    const lobe_material material = bumpy(scene, 2);
    if (squares == 0)
        scene_add_sphere(scene, &material, 2);
    for (int i = 0; i < squares; i++)
        scene_add_square(scene, &material, 2, NULL);
    scene_add_sun(scene, (double[]){0.4, 1, 0.3}, 2);
    scene_look_down(scene, 2);
    scene_end(scene);
    assert_int_equal(lobe_renderer_set_scene(f->renderer, scene), LOBE_OK);
    const picture_request request = {
        .filter = filter, .width = extent, .height = extent, .samples = 1};
    lobe_frame frame = draw_silently(f, scene->name, &request);
    const size_t count = pictures_of_surfaces(f);
    lobe_frame_free(&frame);
    assert_int_equal(lobe_renderer_set_scene(f->renderer, NULL), LOBE_OK);
    lobe_scene_destroy(&scene);
    return count;
}

/// Where triangles are small for what the filter takes, in pictures that are not.
static void shading_is_deferred_where_that_is_faster(void **state) {
    fixture *f = *state;
    const bool cpu = lobe_device_describe(f->device)->type == LOBE_DEVICE_CPU;
    assert_int_equal(pictures_by_default(f, "moments", 0, 128), cpu);
    assert_int_equal(pictures_by_default(f, "moments", 40, 128), cpu);
    assert_int_equal(pictures_by_default(f, "moments", 1, 128), 0);
    assert_int_equal(pictures_by_default(f, "direct", 0, 128), cpu);
    assert_int_equal(pictures_by_default(f, "direct", 40, 128), 0);
    assert_int_equal(pictures_by_default(f, "reference", 0, 128), cpu);
    assert_int_equal(pictures_by_default(f, "moments", 0, 64), 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pictures_are_the_same),
        cmocka_unit_test(pictures_of_many_batches_are_the_same),
        cmocka_unit_test(pictures_of_many_lights_are_the_same),
        cmocka_unit_test(pictures_under_a_sky_are_the_same),
        cmocka_unit_test(masks_cut_the_picture),
        cmocka_unit_test(tiles_are_marked_from_the_same_picture),
        cmocka_unit_test(shading_is_deferred_where_that_is_faster),
        cmocka_unit_test(validation_is_silent),
    };
    return cmocka_run_group_tests(tests, fixture_create_validated, fixture_destroy);
}
