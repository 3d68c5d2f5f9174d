// Instances that no pixel can show are left out: those that are drawn keep their order, and
// pictures are the same to the bit.

#include "passes/renderer/culling/culling.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "passes/context/camera.h"
#include "passes/renderer/renderer.h"
#include "scenes/builtin/random.h"
#include "scenes/scene/scene.h"
#include "tests/passes/renderer/culling/listed_draws.h"
#include "tests/passes/support/pass_run.h"
#include "tests/passes/support/picture.h"
#include "tests/passes/support/scene_builder.h"

enum { INSTANCES = 400, EXTENT = 32 };

/// Anywhere around the origin, turned, sheared, some of them mirrored.
static void place(random_sequence *random, float transform[16]) {
    const double distance = pow(10, scenes_random_between(random, 0.2, 1.5));
    double position[3], length = 0;
    for (int i = 0; i < 3; i++) {
        position[i] = scenes_random_between(random, -1, 1);
        length += position[i] * position[i];
    }
    for (int i = 0; i < 12; i++)
        transform[i] =
            i % 4 < 3 ? (float)(scenes_random_between(random, -0.15, 0.15) * distance) : 0;
    for (int i = 0; i < 3; i++) {
        transform[5 * i] += (float)(0.05 * distance);
        transform[12 + i] = (float)(distance * position[i] / sqrt(length));
    }
    transform[15] = 1;
}

static lobe_material bumpy(lobe_scene *scene, float roughness) {
    lobe_material material = microfacet_material(LOBE_DISTRIBUTION_GGX, roughness, 0.5);
    material.normal_map = scene_add_map(scene, random_normal_map(16, 16, 0.5, 3));
    material.double_sided = true;
    return material;
}

/// A crowd all around the eye, of two meshes and three materials.
static lobe_scene *crowd(void) {
    lobe_scene *scene = scene_begin();
    random_sequence random = scenes_random_start(17);
    float transform[16];
    const lobe_material materials[] = {bumpy(scene, 0.2f), bumpy(scene, 0.5f), bumpy(scene, 0.8f)};
    scene_add_sphere(scene, &materials[0], 1);
    scene_add_square(scene, &materials[1], 1, NULL);
    scene_add_sphere(scene, &materials[2], 2);
    for (uint32_t i = 0; i < INSTANCES; i++) {
        place(&random, transform);
        if (i < 3)
            memcpy(scene->instances[i].transform, transform, sizeof transform);
        else
            assert_int_equal(scenes_add_instance(scene, i % 3, i / 3 % 3, transform, NULL),
                             LOBE_OK);
    }
    scene_add_sun(scene, (double[]){0.3, 1, 0.2}, 2);
    const lobe_light lamp = {
        .type = LOBE_LIGHT_POINT, .position = {0.5f, 0.5f, -2}, .intensity = {4, 4, 4}};
    assert_int_equal(scenes_add_lights(scene, &lamp, 1, NULL), LOBE_OK);
    scene_end(scene);
    scene->camera = (lobe_camera){
        .target = {0, 0, -1}, .up = {0, 1, 0}, .vertical_field_of_view = 0.8f, .near_plane = 0.01f};
    return scene;
}

/// Cameras of all kinds.
static lobe_camera camera_of(const lobe_scene *scene, int number) {
    lobe_camera camera = scene->camera;
    if (number == 1)
        camera.vertical_field_of_view = 2.6f;
    if (number == 2) {
        camera.target[0] = 5;
        camera.up[2] = 0.7f;
        camera.shift[0] = 1.5f;
        camera.jitter[1] = 0.4f;
    }
    if (number == 3) {
        camera.vertical_field_of_view = 0;
        camera.orthographic_height = 4;
    }
    if (number == 4) {
        camera.eye[1] = 100;
        camera.vertical_field_of_view = 0.02f;
    }
    return camera;
}

enum { CAMERAS = 5 };

// ---------------------------------------------------------------------------------------------
// What is kept

/// How far all points of an instance are beyond the farthest side of the picture, over the sizes
/// that are compared: below 0: one is within all.
static double distance_beyond(const lobe_mesh *mesh, const float *m, mat4 matrix, double wider) {
    double beyond = -INFINITY;
    for (int side = 0; side < 4; side++) {
        double nearest = INFINITY;
        for (int corner = 0; corner < 8; corner++) {
            double world[4] = {0, 0, 0, 1}, clip[4] = {0};
            for (int row = 0; row < 3; row++) {
                world[row] = m[12 + row];
                for (int axis = 0; axis < 3; axis++)
                    world[row] += (double)m[4 * axis + row] *
                                  (corner >> axis & 1 ? mesh->maximum : mesh->minimum)[axis];
            }
            for (int row = 0; row < 4; row++)
                for (int column = 0; column < 4; column++)
                    clip[row] += (double)matrix[column][row] * world[column];
            const double along = side % 2 ? clip[side / 2] : -clip[side / 2];
            nearest = fmin(nearest, (along - wider * clip[3]) / (fabs(along) + fabs(clip[3])));
        }
        beyond = fmax(beyond, nearest);
    }
    return beyond;
}

/// Checks one batch, whose instances are those of the list's transforms; returns how many are kept.
static uint32_t check_batch(const draw_list *list, const instance_batch *batch,
                            const lobe_mesh *mesh, mat4 matrix,
                            const struct instance_constants *seen,
                            const lobe_draw_arguments *arguments) {
    uint32_t kept = 0;
    for (uint32_t i = 0; i < batch->count; i++) {
        const struct instance_constants *own = &list->transforms[batch->start + i];
        float transform[16] = {0};
        for (int row = 0; row < 3; row++)
            for (int column = 0; column < 4; column++)
                transform[4 * column + row] = own->rows[row][column];
        const bool drawn = kept < arguments->instance_count &&
                           memcmp(&seen[batch->first + kept], own, sizeof *own) == 0;
        if (!drawn)
            assert_true(distance_beyond(mesh, transform, matrix, 1) > 0);
        else
            assert_true(distance_beyond(mesh, transform, matrix, 1 + 2.0 / EXTENT) < 1e-4);
        kept += drawn;
    }
    assert_int_equal(kept, arguments->instance_count);
    return kept;
}

static void instances_that_may_be_seen_keep_their_order(void **state) {
    static const float centre[2] = {0.5f, 0.5f};
    static const filtered_appearance maps[3] = {0}; // of each material
    lobe_scene *scene = crowd();
    for (int number = 0; number < CAMERAS; number++) {
        const lobe_camera camera = camera_of(scene, number);
        pass_run run;
        draw_list list;
        mat4 matrix;
        uint32_t kept = 0;
        pass_run_begin(&run, *state, scene, "direct", (const char *[]){NULL});
        run.context.view = (filter_view){&camera, EXTENT, EXTENT};
        passes_camera_projection(&camera, EXTENT, EXTENT, centre, scene->minimum, scene->maximum,
                                 matrix);
        list_draws(&run, &list, maps, true);
        passes_culling(&run.context, &list);
        const seen_instances *all = &list.batches[0].seen[DRAW_FOR_PICTURE];
        assert_true(all->transforms.version > 0);
        lobe_graph_read_back(run.context.graph, all->transforms, (lobe_range){0});
        lobe_graph_read_back(run.context.graph, all->arguments, (lobe_range){0});
        pass_run_execute(&run);
        const struct instance_constants *seen =
            lobe_graph_data(run.context.graph, all->transforms, NULL);
        const lobe_draw_arguments *arguments =
            lobe_graph_data(run.context.graph, all->arguments, NULL);
        for (uint32_t i = 0; i < list.batch_count; i++) {
            const uint32_t mesh = run.scene->instances[list.batches[i].instance].mesh;
            assert_int_equal(arguments[i].index_count, scene->meshes[mesh].index_count);
            kept += check_batch(&list, &list.batches[i], &scene->meshes[mesh], matrix, seen,
                                &arguments[list.batches[i].seen[DRAW_FOR_PICTURE].record]);
        }
        print_message("# camera %d: %u of %d instances\n", number, kept, INSTANCES);
        assert_true(kept < 0.8 * INSTANCES);
        passes_draw_list_destroy(&list);
        pass_run_end(&run);
    }
    lobe_scene_destroy(&scene);
}

// ---------------------------------------------------------------------------------------------
// Pictures

/// `previous`: transforms, for motion; NULL: no motion.
static lobe_frame picture(fixture *f, const lobe_camera *camera, const picture_request *request,
                          const float (*previous)[16]) {
    const lobe_filter *filter = filter_named(request->filter);
    const lobe_settings settings = settings_of(filter, request->settings);
    lobe_frame frame;
    const lobe_render_parameters parameters = {.camera = camera,
                                               .width = EXTENT,
                                               .height = EXTENT,
                                               .filter = filter,
                                               .settings = &settings,
                                               .reference.samples = 2,
                                               .aov = request->outputs,
                                               .motion = {.deliver = previous != NULL,
                                                          .previous_camera = camera,
                                                          .previous_transforms = previous}};
    if (lobe_renderer_render(f->renderer, &parameters, &frame) != LOBE_OK)
        fail_msg("%s", f->error);
    assert_silence(f, "crowd", request);
    return frame;
}

static void check_equal(const lobe_image *culled, const lobe_image *all, const char *what,
                        size_t number, int camera) {
    if (image_hash(culled) != image_hash(all))
        fail_msg("case %zu, camera %d: largest difference of %s %g", number, camera, what,
                 largest_difference(culled, all));
}

/// A part of the crowd, of all meshes and materials.
static lobe_scene *small_crowd(void) {
    lobe_scene *scene = crowd();
    for (size_t i = 0; i < scene->instance_count; i++)
        scene->instances[i].hidden = i % 5 > 0;
    return scene;
}

/// Where the instances were: each at another place.
static void shift_all(const lobe_scene *scene, float (*transforms)[16]) {
    for (size_t i = 0; i < scene->instance_count; i++) {
        memcpy(transforms[i], scene->instances[i].transform, sizeof *transforms);
        transforms[i][12] += 0.001f * (float)(i % 37);
    }
}

/// The vertices of the first mesh are on the device.
static void give_vertices(void *user, lobe_graph *graph, const lobe_given_content *content) {
    content->vertices[0] = lobe_graph_import_buffer(graph, user);
}

static lobe_buffer *move_to_device(fixture *f, lobe_mesh *mesh) {
    lobe_buffer *buffer;
    const lobe_buffer_parameters parameters = {.size = mesh->vertex_count * sizeof *mesh->vertices,
                                               .data = mesh->vertices};
    assert_int_equal(lobe_buffer_create(f->device, &parameters, &buffer), LOBE_OK);
    mesh->on_device = true;
    lobe_renderer_set_content_giver(f->renderer, give_vertices, buffer);
    return buffer;
}

static void pictures_are_those_of_all_instances(void **state) {
    static const struct {
        picture_request request;
        int cameras;
        bool motion, without_bounds;
    } cases[] = {
        {{.filter = "toksvig", .settings = {NULL}, .outputs = true}, CAMERAS, false, false},
        {{.filter = "toksvig", .settings = {"samples=4", NULL}}, 1, false, false},
        {{.filter = "reference", .settings = {"shadows=512", NULL}}, 1, false, false},
        {{.filter = "direct", .settings = {"shadows=512", NULL}}, 2, true, false},
        {{.filter = "lean", .settings = {"samples=1", "built=seen", NULL}}, 1, false, false},
        {{.filter = "direct", .settings = {NULL}}, 1, false, true},
    };
    fixture *f = *state;
    lobe_scene *scene = small_crowd();
    static float previous[INSTANCES][16];
    shift_all(scene, previous);
    lobe_buffer *vertices = move_to_device(f, &scene->meshes[0]);
    assert_int_equal(lobe_renderer_set_scene(f->renderer, scene), LOBE_OK);
    const lobe_graph *graph = lobe_renderer_graph(f->renderer);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        for (int axis = 0; cases[i].without_bounds && axis < 3; axis++)
            scene->meshes[0].minimum[axis] = scene->meshes[0].maximum[axis] = 0;
        for (int number = 0; number < cases[i].cameras; number++) {
            const lobe_camera camera = camera_of(scene, number);
            lobe_frame frames[2];
            for (int all = 0; all < 2; all++) {
                f->renderer->draws.draws_all = all;
                frames[all] =
                    picture(f, &camera, &cases[i].request, cases[i].motion ? previous : NULL);
                assert_int_equal(count_passes(graph, "culling", LOBE_PASS_RUN) > 0, !all);
            }
            assert_true(number == 4 || largest_value(&frames[1].radiance) > 0.01);
            check_equal(&frames[0].radiance, &frames[1].radiance, "radiance", i, number);
            if (cases[i].request.outputs)
                check_equal(&frames[0].normal_depth, &frames[1].normal_depth, "normals", i, number);
            if (cases[i].motion) {
                assert_true(largest_value(&frames[1].motion) > 0.1);
                check_equal(&frames[0].motion, &frames[1].motion, "motion", i, number);
            }
            lobe_frame_free(&frames[0]);
            lobe_frame_free(&frames[1]);
        }
    }
    f->renderer->draws.draws_all = false;
    lobe_renderer_set_content_giver(f->renderer, NULL, NULL);
    assert_int_equal(lobe_renderer_set_scene(f->renderer, NULL), LOBE_OK);
    lobe_buffer_destroy(&vertices);
    lobe_scene_destroy(&scene);
}

/// Of seven maps, only the sun's follows the camera.
static void shadow_maps_are_kept(void **state) {
    fixture *f = *state;
    lobe_scene *scene = small_crowd();
    const picture_request request = {.filter = "direct", .settings = {"shadows=512", NULL}};
    const lobe_camera cameras[] = {camera_of(scene, 0), camera_of(scene, 0), camera_of(scene, 2)};
    static const int drawn[] = {7, 0, 1};
    assert_int_equal(lobe_renderer_set_scene(f->renderer, scene), LOBE_OK);
    const lobe_graph *graph = lobe_renderer_graph(f->renderer);
    for (int i = 0; i < 3; i++) {
        lobe_frame frame = picture(f, &cameras[i], &request, NULL);
        assert_int_equal(count_passes(graph, "shadow_map", LOBE_PASS_RUN), drawn[i]);
        assert_int_equal(count_passes(graph, "culling", LOBE_PASS_RUN), 1 + drawn[i]);
        lobe_frame_free(&frame);
    }
    assert_int_equal(lobe_renderer_set_scene(f->renderer, NULL), LOBE_OK);
    lobe_scene_destroy(&scene);
}

/// Few triangles are drawn as they are.
static void small_scenes_take_no_pass(void **state) {
    fixture *f = *state;
    lobe_scene *scene = crowd();
    const picture_request request = {.filter = "direct", .settings = {NULL}};
    for (size_t i = 10; i < scene->instance_count; i++)
        scene->instances[i].hidden = true;
    assert_int_equal(lobe_renderer_set_scene(f->renderer, scene), LOBE_OK);
    lobe_frame frame = picture(f, NULL, &request, NULL);
    assert_int_equal(count_passes(lobe_renderer_graph(f->renderer), "culling", LOBE_PASS_RUN), 0);
    lobe_frame_free(&frame);
    assert_int_equal(lobe_renderer_set_scene(f->renderer, NULL), LOBE_OK);
    lobe_scene_destroy(&scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(instances_that_may_be_seen_keep_their_order),
        cmocka_unit_test(pictures_are_those_of_all_instances),
        cmocka_unit_test(shadow_maps_are_kept),
        cmocka_unit_test(small_scenes_take_no_pass),
    };
    return cmocka_run_group_tests(tests, fixture_create_validated, fixture_destroy);
}
