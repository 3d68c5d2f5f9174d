// The unit of length does not show: with all lengths times s and intensities of lamps times s^2,
// every filter draws the same picture. Scales are powers of two, with which single precision
// computes the same digits, so that a difference is a constant in the code with a length of its
// own.

#include "tests/passes/support/fixture.h"

#include <math.h>

#include "scenes/scene/scene.h"
#include "tests/passes/support/picture.h"
#include "tests/passes/support/scene_builder.h"

enum { EXTENT = 16 };

/// Exponents of two.
typedef struct scaling {
    int vertices, transform; ///< the scene's scale is their product
} scaling;

static void add_lamps(lobe_scene *scene, float scale) {
    const float square = scale * scale;
    const lobe_light lamps[] = {
        {.type = LOBE_LIGHT_POINT,
         .position = {0.3f * scale, 0.5f * scale, 0.2f * scale},
         .intensity = {square, square, square},
         .range = 1.5f * scale},
        {.type = LOBE_LIGHT_SPOT,
         .position = {-0.5f * scale, 1.25f * scale, 0},
         .direction = {0.28f, -0.96f, 0},
         .intensity = {square, 2 * square, square},
         .inner_cone = 0.2f,
         .outer_cone = 0.6f},
    };
    assert_int_equal(scenes_add_lights(scene, lamps, 2, NULL), LOBE_OK);
}

static void scale_vertices(lobe_mesh *mesh, float scale) {
    for (size_t i = 0; i < mesh->vertex_count; i++) {
        for (int axis = 0; axis < 3; axis++)
            mesh->vertices[i].position[axis] *= scale;
    }
    for (int axis = 0; axis < 3; axis++) {
        mesh->minimum[axis] *= scale;
        mesh->maximum[axis] *= scale;
    }
}

static void aim(lobe_scene *scene, float scale, bool perspective) {
    scene->camera = (lobe_camera){.eye = {0.5f * scale, 1.5f * scale, 0.75f * scale},
                                  .up = {0, 1, 0},
                                  .vertical_field_of_view = perspective ? 0.9f : 0,
                                  .orthographic_height = 1.5f * scale,
                                  .near_plane = 0.01f * scale};
    scene->has_camera = true;
}

static lobe_material bumpy_material(lobe_scene *scene) {
    lobe_material material;
    lobe_material_default(&material);
    material.base_colour[0] = material.base_colour[1] = material.base_colour[2] = 0.5f;
    material.roughness = 0.5f;
    material.normal_map = scene_add_map(scene, random_normal_map(32, 32, 0.6, 141));
    return material;
}

static lobe_scene *scaled_scene(const scaling *by, bool perspective) {
    const float scale = ldexpf(1, by->vertices + by->transform);
    float transform[16] = {0, 0.8f, -0.6f, 0, 0, 0.6f, 0.8f, 0, -1, 0, 0, 0, 0, 0, 0, 1};
    for (int i = 0; i < 12; i++)
        transform[i] = ldexpf(transform[i], by->transform);
    transform[13] = 0.1f * scale;
    lobe_scene *scene = scene_begin();
    lobe_material material = bumpy_material(scene);
    material.double_sided = true;
    scene_add_square(scene, &material, 1, transform);
    scale_vertices(&scene->meshes[0], ldexpf(1, by->vertices));
    add_lamps(scene, scale);
    scene_add_sun(scene, (double[]){0.2, 1, 0.3}, 1);
    aim(scene, scale, perspective);
    scene_end(scene);
    return scene;
}

/// The last few see the scene through an orthographic camera, too.
static const struct {
    const char *filter, *setting;
} methods[] = {
    {"direct", NULL},    {"mipmap", NULL},          {"toksvig", NULL},         {"lean", NULL},
    {"leadr", NULL},     {"lobes", NULL},           {"lobes", "space=object"}, {"moments", NULL},
    {"reference", NULL}, {"lobes", "space=camera"},
};
enum { METHODS = sizeof methods / sizeof *methods, ORTHOGRAPHIC = METHODS - 2 };

static void draw_all(fixture *f, lobe_scene *scene, size_t first, lobe_frame frames[METHODS]) {
    assert_int_equal(lobe_renderer_set_scene(f->renderer, scene), LOBE_OK);
    for (size_t i = first; i < METHODS; i++) {
        picture_request request = {.filter = methods[i].filter,
                                   .settings = {methods[i].setting, NULL},
                                   .width = EXTENT,
                                   .height = EXTENT,
                                   .samples = 2};
        frames[i] = draw(f, &request);
    }
    assert_int_equal(lobe_renderer_set_scene(f->renderer, NULL), LOBE_OK);
    lobe_scene_destroy(&scene);
}

static void check_scale(fixture *f, const scaling *by, bool perspective,
                        const lobe_frame expected[METHODS]) {
    const size_t first = perspective ? 0 : ORTHOGRAPHIC;
    lobe_frame frames[METHODS];
    draw_all(f, scaled_scene(by, perspective), first, frames);
    for (size_t i = first; i < METHODS; i++) {
        const double error = relative_l2(&frames[i].radiance, &expected[i].radiance);
        if (!(error < 1e-5))
            fail_msg("%s %s, vertices times 2^%d, transform times 2^%d, %s: %g off",
                     methods[i].filter, methods[i].setting ? methods[i].setting : "", by->vertices,
                     by->transform, perspective ? "perspective" : "orthographic", error);
        lobe_frame_free(&frames[i]);
    }
}

static void check_scales(fixture *f, bool perspective) {
    static const scaling one = {0, 0}, others[] = {{20, -40}, {-20, 40}, {-40, 0}};
    const size_t first = perspective ? 0 : ORTHOGRAPHIC;
    lobe_frame expected[METHODS];
    draw_all(f, scaled_scene(&one, perspective), first, expected);
    for (size_t i = first; i < METHODS; i++)
        assert_true(largest_value(&expected[i].radiance) > 0.01);
    for (size_t i = 0; i < sizeof others / sizeof *others; i++)
        check_scale(f, &others[i], perspective, expected);
    for (size_t i = first; i < METHODS; i++)
        lobe_frame_free(&expected[i]);
}

static void perspective_pictures_have_no_scale(void **state) {
    check_scales(*state, true);
}

static void orthographic_pictures_have_no_scale(void **state) {
    check_scales(*state, false);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(perspective_pictures_have_no_scale),
        cmocka_unit_test(orthographic_pictures_have_no_scale),
    };
    return cmocka_run_group_tests(tests, fixture_create, fixture_destroy);
}
