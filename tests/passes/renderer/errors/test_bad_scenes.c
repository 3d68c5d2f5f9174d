// Scenes of a host with numbers that make no picture: exact error codes, one line that names the
// object and the value, and a renderer that still works.

#include "tests/passes/support/fixture.h"

#include <math.h>
#include <string.h>

#include "tests/passes/support/misuse.h"
#include "tests/passes/support/picture.h"
#include "tests/passes/support/scene_builder.h"

typedef struct broken_scene {
    const char *words; ///< of the error line
    void (*damage)(lobe_scene *scene);
} broken_scene;

static void use_missing_mesh(lobe_scene *scene) {
    scene->instances[0].mesh = 1;
}

static void use_missing_material(lobe_scene *scene) {
    scene->instances[0].material = UINT32_MAX;
}

static void use_missing_image(lobe_scene *scene) {
    scene->materials[0].normal_map.image = 1;
}

static void use_missing_vertex(lobe_scene *scene) {
    scene->meshes[0].indices[4] = 4;
}

static void use_missing_coordinates(lobe_scene *scene) {
    scene->materials[0].normal_map.texture_coordinates = 2;
}

static void leave_no_triangles(lobe_scene *scene) {
    scene->meshes[0].index_count = 0;
}

static void leave_no_instances(lobe_scene *scene) {
    scene->instance_count = 0;
}

static void use_too_many_lobes(lobe_scene *scene) {
    scene->materials[0].lobe_count = LOBE_MATERIAL_MAXIMUM_LOBES + 1;
}

static void use_no_lobes(lobe_scene *scene) {
    scene->materials[0].lobe_count = 0;
}

static void make_vertex_infinite(lobe_scene *scene) {
    scene->meshes[0].vertices[2].position[1] = INFINITY;
}

static void make_normal_nan(lobe_scene *scene) {
    scene->meshes[0].vertices[3].normal[0] = NAN;
}

static void make_normal_zero(lobe_scene *scene) {
    memset(scene->meshes[0].vertices[1].normal, 0, 3 * sizeof(float));
}

static void make_vertex_colour_nan(lobe_scene *scene) {
    scene->meshes[0].vertices[0].colour[3] = NAN;
}

static void make_mesh_bounds_infinite(lobe_scene *scene) {
    scene->meshes[0].maximum[1] = INFINITY;
}

static void leave_part_of_a_triangle(lobe_scene *scene) {
    scene->meshes[0].index_count--;
}

static void make_texel_nan(lobe_scene *scene) {
    ((float *)scene->images[0].image.texels)[4 * (16 * 3 + 5) + 1] = NAN;
}

static void make_texel_infinite(lobe_scene *scene) {
    ((float *)scene->images[0].image.texels)[4 * (16 * 7 + 2)] = -INFINITY;
}

static void make_image_empty(lobe_scene *scene) {
    scene->images[0].image.width = 0;
}

static void make_image_without_format(lobe_scene *scene) {
    scene->images[0].image.format = LOBE_FORMAT_NONE;
}

static void give_normals_two_channels(lobe_scene *scene) {
    scene->images[0].image.format = LOBE_FORMAT_RG32_FLOAT;
}

static void give_normals_one_channel(lobe_scene *scene) {
    scene->images[0].normals = LOBE_NORMALS_SIGNED_XY;
    scene->images[0].image.format = LOBE_FORMAT_R32_FLOAT;
}

static void encode_normals_as_colours(lobe_scene *scene) {
    scene->images[0].image.format = LOBE_FORMAT_RGBA8_SRGB;
}

static void make_wrapping_unknown(lobe_scene *scene) {
    scene->materials[0].normal_map.wrap_v = 3;
}

static void make_base_colour_nan(lobe_scene *scene) {
    scene->materials[0].base_colour[1] = NAN;
}

static void make_emission_negative(lobe_scene *scene) {
    scene->materials[0].emissive[2] = -1;
}

static void make_normal_scale_infinite(lobe_scene *scene) {
    scene->materials[0].normal_scale = -INFINITY;
}

static void make_occlusion_too_strong(lobe_scene *scene) {
    scene->materials[0].occlusion_strength = 1.5f;
}

static void make_model_unknown(lobe_scene *scene) {
    scene->materials[0].model = 7;
}

static void make_lobes_of_microfacets(lobe_scene *scene) {
    scene->materials[0].distribution = LOBE_DISTRIBUTION_BECKMANN;
}

static void make_lobe_long(lobe_scene *scene) {
    scene->materials[0].lobes[0].direction[2] = 2;
}

static void make_lobe_width_negative(lobe_scene *scene) {
    scene->materials[0].lobes[0].width = -3;
}

static void make_rough_beyond_one(lobe_scene *scene) {
    scene->materials[0].model = LOBE_MATERIAL_MICROFACET;
    scene->materials[0].roughness = 1.25f;
}

static void make_map_transform_nan(lobe_scene *scene) {
    scene->materials[0].normal_map.transform[1][2] = NAN;
}

static void make_environment_nan(lobe_scene *scene) {
    scene_set_environment(scene, constant_map(4, 2, 1, 1, 1));
    ((float *)scene->environment->image.texels)[4 * (4 + 2)] = NAN;
}

static void make_environment_no_column(lobe_scene *scene) {
    scene_set_environment(scene, constant_map(4, 2, 1, 1, 1));
    scene->environment->layout = LOBE_ENVIRONMENT_CUBE_COLUMN;
}

static void make_environment_layout_unknown(lobe_scene *scene) {
    scene_set_environment(scene, constant_map(4, 2, 1, 1, 1));
    scene->environment->layout = 77;
}

// What a host may change in every frame without announcing it.

static void make_transform_nan(lobe_scene *scene) {
    scene->instances[0].transform[13] = NAN;
}

static void make_transform_degenerate(lobe_scene *scene) {
    memset(scene->instances[0].transform + 4, 0, 4 * sizeof(float));
}

static void make_transform_projective(lobe_scene *scene) {
    scene->instances[0].transform[11] = -1;
}

static void broken_scenes_are_refused(void **state) {
    static const broken_scene cases[] = {
        {"mesh 1 of 1", use_missing_mesh},
        {"material 4294967295 of 1", use_missing_material},
        {"image 1 of 1", use_missing_image},
        {"vertex 4 of 4", use_missing_vertex},
        {"texture coordinates", use_missing_coordinates},
        {"no triangles", leave_no_triangles},
        {"nothing to draw", leave_no_instances},
        {"5 lobes", use_too_many_lobes},
        {"0 lobes", use_no_lobes},
        {"position of vertex 2[1] is inf", make_vertex_infinite},
        {"normal of vertex 3[0] is nan", make_normal_nan},
        {"normal of vertex 1 has no length", make_normal_zero},
        {"colour of vertex 0[3] is nan", make_vertex_colour_nan},
        {"maximum[1] is inf", make_mesh_bounds_infinite},
        {"5 indices", leave_part_of_a_triangle},
        {"texel 5, 3", make_texel_nan},
        {"texel 2, 7", make_texel_infinite},
        {"0x16 texels", make_image_empty},
        {"texels of NONE", make_image_without_format},
        {"normals of 3 channels in the format RG32_FLOAT, which has 2", give_normals_two_channels},
        {"normals of 2 channels in the format R32_FLOAT, which has 1", give_normals_one_channel},
        {"normals in the format RGBA8_SRGB, which is for colours", encode_normals_as_colours},
        {"a map with the wrapping 0, 3; there are 0 to 2", make_wrapping_unknown},
        {"'material': base_colour[1] is nan", make_base_colour_nan},
        {"emissive[2] is -1; expected a finite number of at least 0", make_emission_negative},
        {"normal_scale is -inf", make_normal_scale_infinite},
        {"occlusion_strength is 1.5; expected a number in [0, 1]", make_occlusion_too_strong},
        {"model is 7", make_model_unknown},
        {"not those of distribution 1", make_lobes_of_microfacets},
        {"direction is (0, 0, 2)", make_lobe_long},
        {"width is -3", make_lobe_width_negative},
        {"roughness is 1.25", make_rough_beyond_one},
        {"transform of a map[5] is nan", make_map_transform_nan},
        {"'environment': texel 2, 1 has the value nan", make_environment_nan},
        {"4x2 texels do not have the shape of layout 1", make_environment_no_column},
        {"4x2 texels do not have the shape of layout 77", make_environment_layout_unknown},
        {"instance 0: transform[13] is nan", make_transform_nan},
        {"instance 0: its transform has the determinant 0", make_transform_degenerate},
        {"instance 0: the last row of its transform is (0, 0, -1, 1)", make_transform_projective},
    };
    fixture *f = *state;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        lobe_scene *scene = small_scene();
        cases[i].damage(scene);
        fixture_forget_messages(f);
        lobe_result result = lobe_renderer_set_scene(f->renderer, scene);
        assert_failure(f, result, LOBE_ERROR_MALFORMED, cases[i].words);
        // The previous scene is removed nevertheless.
        check_render_failure(f, &(lobe_render_parameters){0}, LOBE_ERROR_INVALID_ARGUMENT,
                             "no scene");
        lobe_scene_destroy(&scene);
    }
    check_it_works(f);
}

static void make_light_nan(lobe_scene *scene) {
    scene->lights[0].intensity[2] = NAN;
}

static void make_light_negative(lobe_scene *scene) {
    scene->lights[0].intensity[0] = -0.5f;
}

static void make_light_long(lobe_scene *scene) {
    scene->lights[0].direction[0] = 3;
}

static void make_lamp_far(lobe_scene *scene) {
    scene->lights[0].type = LOBE_LIGHT_POINT;
    scene->lights[0].position[1] = INFINITY;
}

static void make_lamp_range_negative(lobe_scene *scene) {
    scene->lights[0].type = LOBE_LIGHT_POINT;
    scene->lights[0].range = -2;
}

static void make_spot_wide(lobe_scene *scene) {
    scene->lights[0].type = LOBE_LIGHT_SPOT;
    scene->lights[0].outer_cone = 2;
}

static void make_spot_inside_out(lobe_scene *scene) {
    scene->lights[0].type = LOBE_LIGHT_SPOT;
    scene->lights[0].inner_cone = 0.5f;
    scene->lights[0].outer_cone = 0.25f;
}

static void make_light_unknown(lobe_scene *scene) {
    scene->lights[0].type = 3;
}

static void make_background_nan(lobe_scene *scene) {
    scene->background[1] = NAN;
}

static void make_bounds_nan(lobe_scene *scene) {
    scene->minimum[0] = NAN;
}

static void turn_bounds_around(lobe_scene *scene) {
    scene->minimum[0] = scene->maximum[0] + 1;
}

static void make_environment_intensity_nan(lobe_scene *scene) {
    scene->environment->intensity = NAN;
}

static void shear_environment(lobe_scene *scene) {
    scene->environment->world_from_environment[1][0] = 0.6f;
    scene->environment->world_from_environment[1][1] = 0.8f;
}

static void stretch_environment(lobe_scene *scene) {
    scene->environment->world_from_environment[2][2] = 2;
}

static lobe_scene *small_scene_in_environment(void) {
    lobe_scene *scene = small_scene();
    scene_set_environment(scene, constant_map(4, 2, 1, 1, 1));
    return scene;
}

/// Changed after the scene was set: the next frame is refused, and the one after it is drawn if the
/// scene is sound again.
static void broken_frames_are_refused(void **state) {
    static const broken_scene cases[] = {
        {"instance 0: transform[13] is nan", make_transform_nan},
        {"instance 0: its transform has the determinant 0", make_transform_degenerate},
        {"instance 0: the last row of its transform is (0, 0, -1, 1)", make_transform_projective},
        {"light 0: intensity[2] is nan", make_light_nan},
        {"light 0: intensity[0] is -0.5", make_light_negative},
        {"light 0: direction is (3, -1, ", make_light_long},
        {"light 0: position[1] is inf", make_lamp_far},
        {"light 0: range is -2", make_lamp_range_negative},
        {"light 0: outer_cone is 2", make_spot_wide},
        {"light 0: inner_cone is 0.5; expected a number in [0, 0.25]", make_spot_inside_out},
        {"light 0: type is 3", make_light_unknown},
        {"scene: background[1] is nan", make_background_nan},
        {"bounds: minimum[0] is nan", make_bounds_nan},
        {"bounds: minimum is (2, ", turn_bounds_around},
        {"'environment': intensity is nan", make_environment_intensity_nan},
        {"world_from_environment is (1, 0, 0); expected to be at right", shear_environment},
        {"world_from_environment is (0, 0, 2); expected a vector of unit", stretch_environment},
    };
    fixture *f = *state;
    lobe_scene *scene = small_scene_in_environment();
    assert_int_equal(lobe_renderer_set_scene(f->renderer, scene), LOBE_OK);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const lobe_scene sound = *scene;
        const lobe_light light = scene->lights[0];
        const lobe_instance instance = scene->instances[0];
        const lobe_environment environment = *scene->environment;
        cases[i].damage(scene);
        check_render_failure(f, &(lobe_render_parameters){.width = 4, .height = 4},
                             LOBE_ERROR_MALFORMED, cases[i].words);
        *scene = sound;
        scene->lights[0] = light;
        scene->instances[0] = instance;
        *scene->environment = environment;
    }
    // Without the environment, whose shaders take seconds to compile.
    lobe_scene_set_environment(scene, NULL);
    const lobe_scene_changes changes = {.environment = true};
    assert_int_equal(lobe_renderer_update_scene(f->renderer, &changes), LOBE_OK);
    picture_request request = {.filter = "direct", .settings = {NULL}, .width = 4, .height = 4};
    lobe_frame frame = draw(f, &request);
    lobe_frame_free(&frame);
    assert_int_equal(lobe_renderer_set_scene(f->renderer, NULL), LOBE_OK);
    lobe_scene_destroy(&scene);
}

// ---------------------------------------------------------------------------------------------
// Cameras

typedef struct broken_camera {
    const char *words; ///< of the error line
    lobe_camera camera;
} broken_camera;

static void broken_cameras_are_refused(void **state) {
    static const broken_camera cases[] = {
        {"eye[2] is nan", {{0, 0, NAN}, {0, 0, 0}, {0, 1, 0}, 1, 0, 0.1f, {0, 0}, {0, 0}}},
        {"target[0] is inf", {{0, 0, 1}, {INFINITY, 0, 0}, {0, 1, 0}, 1, 0, 0.1f, {0, 0}, {0, 0}}},
        {"up[1] is nan", {{0, 0, 1}, {0, 0, 0}, {0, NAN, 0}, 1, 0, 0.1f, {0, 0}, {0, 0}}},
        {"up is (0, 0, 0)", {{0, 0, 1}, {0, 0, 0}, {0, 0, 0}, 1, 0, 0.1f, {0, 0}, {0, 0}}},
        {"eye is (3, 4, 5); the target",
         {{3, 4, 5}, {3, 4, 5}, {0, 1, 0}, 1, 0, 0.1f, {0, 0}, {0, 0}}},
        {"vertical_field_of_view is nan",
         {{0, 0, 1}, {0, 0, 0}, {0, 1, 0}, NAN, 1, 0.1f, {0, 0}, {0, 0}}},
        {"vertical_field_of_view is -1",
         {{0, 0, 1}, {0, 0, 0}, {0, 1, 0}, -1, 1, 0.1f, {0, 0}, {0, 0}}},
        {"vertical_field_of_view is 3.14159",
         {{0, 0, 1}, {0, 0, 0}, {0, 1, 0}, 3.14159265f, 1, 0.1f, {0, 0}, {0, 0}}},
        {"near_plane is 0; expected a finite number above 0",
         {{0, 0, 1}, {0, 0, 0}, {0, 1, 0}, 1, 0, 0, {0, 0}, {0, 0}}},
        {"near_plane is -1", {{0, 0, 1}, {0, 0, 0}, {0, 1, 0}, 1, 0, -1, {0, 0}, {0, 0}}},
        {"near_plane is inf", {{0, 0, 1}, {0, 0, 0}, {0, 1, 0}, 0, 1, INFINITY, {0, 0}, {0, 0}}},
        {"orthographic_height (the field of view is 0) is 0",
         {{0, 0, 1}, {0, 0, 0}, {0, 1, 0}, 0, 0, 0.1f, {0, 0}, {0, 0}}},
        {"jitter[0] is inf", {{0, 0, 1}, {0, 0, 0}, {0, 1, 0}, 1, 0, 0.1f, {0, 0}, {INFINITY, 0}}},
        {"shift[1] is nan", {{0, 0, 1}, {0, 0, 0}, {0, 1, 0}, 1, 0, 0.1f, {0, NAN}, {0, 0}}},
    };
    fixture *f = *state;
    lobe_scene *scene = small_scene();
    assert_int_equal(lobe_renderer_set_scene(f->renderer, scene), LOBE_OK);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        lobe_render_parameters parameters = {.camera = &cases[i].camera, .width = 4, .height = 4};
        check_render_failure(f, &parameters, LOBE_ERROR_INVALID_ARGUMENT, cases[i].words);
        // The same as the scene's own.
        scene->camera = cases[i].camera;
        parameters.camera = NULL;
        check_render_failure(f, &parameters, LOBE_ERROR_INVALID_ARGUMENT, cases[i].words);
    }
    assert_int_equal(lobe_renderer_set_scene(f->renderer, NULL), LOBE_OK);
    lobe_scene_destroy(&scene);
}

/// A picture from straight above, which has no side that is up, is a picture all the same.
static void a_view_along_the_up_vector_is_drawn(void **state) {
    fixture *f = *state;
    lobe_scene *scene = small_scene();
    scene->camera = (lobe_camera){
        .eye = {0, 3, 0}, .up = {0, 1, 0}, .vertical_field_of_view = 0.5f, .near_plane = 0.1f};
    picture_request request = {.filter = "direct", .settings = {NULL}, .width = 4, .height = 4};
    lobe_frame frame = draw_scene(f, scene, &request);
    assert_true(largest_value(&frame.radiance) > 0 && all_finite(&frame.radiance));
    lobe_frame_free(&frame);
    lobe_scene_destroy(&scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(broken_scenes_are_refused),
        cmocka_unit_test(broken_frames_are_refused),
        cmocka_unit_test(broken_cameras_are_refused),
        cmocka_unit_test(a_view_along_the_up_vector_is_drawn),
    };
    return cmocka_run_group_tests(tests, fixture_create, fixture_destroy);
}
