// Meshes that joints and morph targets deform: vertices on the device are those of a reference in
// double precision, pictures those of a mesh that was posed on the host.

#include "tests/passes/support/fixture.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "passes/renderer/deform.h"
#include "passes/upload/device_scene.h"
#include "scenes/builtin/random.h"
#include "tests/passes/host/host_renderer.h"
#include "tests/passes/support/pass_run.h"
#include "tests/passes/support/picture.h"
#include "tests/passes/support/scene_builder.h"
#include "tests/scenes/animation/pose_reference.h"

enum { EXTENT = 16, JOINTS = 5, TARGETS = 4 };

typedef struct deform_case {
    const char *name;
    uint32_t influences;
    bool targets, flat, mirrored;
    double scale; ///< of the joints
} deform_case;

static float between(random_sequence *sequence, double low, double high) {
    return (float)scenes_random_between(sequence, low, high);
}

static void *allocate(size_t count, size_t size) {
    void *memory = lobe_allocate(NULL, count, size);
    assert_non_null(memory);
    return memory;
}

// ---------------------------------------------------------------------------------------------
// Deformations

/// Each vertex of its own: as flat meshes are.
static void separate_corners(lobe_mesh *mesh) {
    lobe_scene_vertex *vertices = allocate(mesh->index_count, sizeof *vertices);
    for (size_t i = 0; i < mesh->index_count; i++) {
        vertices[i] = mesh->vertices[mesh->indices[i]];
        mesh->indices[i] = (uint32_t)i;
    }
    lobe_release(mesh->vertices);
    mesh->vertices = vertices;
    mesh->vertex_count = mesh->index_count;
}

static void add_influences(lobe_mesh *mesh, uint32_t count, random_sequence *sequence) {
    lobe_deformation *d = mesh->deformation;
    d->influences_per_vertex = count;
    d->joint_count = JOINTS;
    d->influences = allocate(mesh->vertex_count * count, sizeof *d->influences);
    d->joint_matrices = allocate(JOINTS, sizeof *d->joint_matrices);
    for (size_t i = 0; i < mesh->vertex_count; i++) {
        lobe_joint_influence *influences = d->influences + i * count;
        float sum = 0;
        for (uint32_t k = 0; k < count; k++) {
            influences[k].joint = (uint32_t)(between(sequence, 0, JOINTS - 1e-3));
            influences[k].weight = between(sequence, 0.1, 1);
            sum += influences[k].weight;
        }
        for (uint32_t k = 0; k < count; k++)
            influences[k].weight /= sum;
    }
}

/// Every second vertex, on the average, by each target.
static void add_deltas(lobe_mesh *mesh, random_sequence *sequence) {
    lobe_deformation *d = mesh->deformation;
    d->target_count = TARGETS;
    d->weights = allocate(TARGETS, sizeof *d->weights);
    d->first_deltas = allocate(mesh->vertex_count + 1, sizeof *d->first_deltas);
    d->deltas = allocate(mesh->vertex_count * TARGETS, sizeof *d->deltas);
    for (size_t i = 0; i < mesh->vertex_count; i++) {
        for (uint32_t k = 0; k < TARGETS; k++) {
            if (between(sequence, 0, 1) < 0.5f)
                continue;
            lobe_morph_delta *delta = &d->deltas[d->delta_count++];
            delta->target = k;
            for (int axis = 0; axis < 3; axis++) {
                delta->position[axis] = between(sequence, -0.1, 0.1);
                delta->normal[axis] = between(sequence, -0.2, 0.2);
                delta->tangent[axis] = between(sequence, -0.2, 0.2);
            }
        }
        d->first_deltas[i + 1] = (uint32_t)d->delta_count;
    }
}

/// Another pose: joints near the identity, so that blends are invertible, of unequal scale.
static void set_pose(const deform_case *c, lobe_mesh *mesh, uint64_t seed) {
    random_sequence sequence = scenes_random_start(seed);
    lobe_deformation *d = mesh->deformation;
    for (size_t i = 0; i < d->joint_count; i++) {
        float *m = d->joint_matrices[i];
        memset(m, 0, sizeof *d->joint_matrices);
        for (int k = 0; k < 12; k++)
            m[k + k / 3] = (float)(c->scale * between(&sequence, -0.25, 0.25));
        for (int k = 0; k < 3; k++)
            m[5 * k] += (float)(c->scale * (k == 1 ? 0.7 : 1));
        m[0] = c->mirrored ? -m[0] : m[0];
        m[15] = 1;
    }
    for (size_t i = 0; i < d->target_count; i++)
        d->weights[i] = between(&sequence, -1, 1.5);
}

static void deform(const deform_case *c, lobe_mesh *mesh) {
    random_sequence sequence = scenes_random_start(7);
    if (c->flat)
        separate_corners(mesh);
    mesh->deformation = allocate(1, sizeof *mesh->deformation);
    mesh->deformation->flat = c->flat;
    if (c->influences > 0)
        add_influences(mesh, c->influences, &sequence);
    if (c->targets)
        add_deltas(mesh, &sequence);
    set_pose(c, mesh, 1);
}

/// A ball with a map.
static lobe_scene *ball(void) {
    lobe_scene *scene = scene_begin();
    lobe_material material = microfacet_material(LOBE_DISTRIBUTION_GGX, 0.5, 1);
    material.normal_map = scene_add_map(scene, random_normal_map(32, 32, 0.4, 400));
    scene_add_sphere(scene, &material, 1);
    scene_add_sun(scene, (double[]){0.3, 1, 0.2}, 2);
    scene_look_from(scene, (double[]){0.3, 1, 0.4}, 4);
    scene_end(scene);
    return scene;
}

static lobe_scene *deformed_ball(const deform_case *c) {
    lobe_scene *scene = ball();
    deform(c, &scene->meshes[0]);
    return scene;
}

/// The same scene with vertices posed on the host, instead of a deformation.
static lobe_scene *posed_ball(const lobe_scene *deformed) {
    lobe_scene *scene = ball();
    lobe_mesh *mesh = &scene->meshes[0];
    const lobe_mesh *from = &deformed->meshes[0];
    if (from->deformation->flat)
        separate_corners(mesh);
    for (size_t i = 0; i < mesh->vertex_count; i++)
        pose_reference(from, i, &mesh->vertices[i]);
    return scene;
}

static const deform_case cases[] = {
    {.name = "one joint", .influences = 1, .scale = 1},
    {.name = "four joints", .influences = 4, .scale = 1},
    {.name = "eight joints, large", .influences = 8, .scale = 1e6},
    {.name = "mirrored, small", .influences = 3, .mirrored = true, .scale = 1e-6},
    {.name = "targets", .targets = true},
    {.name = "both", .influences = 4, .targets = true, .scale = 1},
    {.name = "flat targets", .targets = true, .flat = true},
    {.name = "flat, both", .influences = 2, .targets = true, .flat = true, .scale = 1},
};

// ---------------------------------------------------------------------------------------------
// Vertices

static double distance(const float *a, const float *b, int count) {
    double square = 0;
    for (int i = 0; i < count; i++)
        square += ((double)a[i] - b[i]) * ((double)a[i] - b[i]);
    return sqrt(square);
}

/// Runs the pass alone; the caller frees the vertices.
static lobe_scene_vertex *run_pass(fixture *f, const lobe_scene *scene) {
    const char *const none[] = {NULL};
    const size_t size = scene->meshes[0].vertex_count * sizeof(lobe_scene_vertex);
    pass_run run;
    pass_run_begin(&run, f, scene, "direct", none);
    passes_deform(&run.context);
    const lobe_resource deformed = run.scene->deformed[0];
    assert_true(deformed.version > 0);
    lobe_graph_read_back(run.context.graph, deformed, (lobe_range){0});
    pass_run_execute(&run);
    size_t found;
    const void *data = lobe_graph_data(run.context.graph, deformed, &found);
    assert_int_equal(found, size);
    lobe_scene_vertex *vertices = malloc(size);
    assert_non_null(vertices);
    memcpy(vertices, data, size);
    pass_run_end(&run);
    return vertices;
}

static void vertices_are_those_of_the_reference(void **state) {
    fixture *f = *state;
    for (size_t n = 0; n < sizeof cases / sizeof *cases; n++) {
        lobe_scene *scene = deformed_ball(&cases[n]);
        const lobe_mesh *mesh = &scene->meshes[0];
        const double size = cases[n].scale > 0 ? cases[n].scale : 1;
        lobe_scene_vertex *vertices = run_pass(f, scene);
        double moved = 0;
        for (size_t i = 0; i < mesh->vertex_count; i++) {
            lobe_scene_vertex expected;
            pose_reference(mesh, i, &expected);
            // Flat triangles at the poles are thin: their normals lose what their corners round.
            const double slack = cases[n].flat ? 2e-3 : 2e-5;
            if (!(distance(vertices[i].position, expected.position, 3) < 3e-6 * size) ||
                !(distance(vertices[i].normal, expected.normal, 3) < slack) ||
                !(distance(vertices[i].tangent, expected.tangent, 4) < 2 * slack))
                fail_msg("%s: vertex %zu: errors of %g, %g, %g", cases[n].name, i,
                         distance(vertices[i].position, expected.position, 3),
                         distance(vertices[i].normal, expected.normal, 3),
                         distance(vertices[i].tangent, expected.tangent, 4));
            assert_memory_equal(vertices[i].texture_coordinates, expected.texture_coordinates,
                                sizeof expected - offsetof(lobe_scene_vertex, texture_coordinates));
            moved += distance(expected.position, mesh->vertices[i].position, 3);
        }
        assert_true(moved > 0.05 * (double)mesh->vertex_count);
        free(vertices);
        lobe_scene_destroy(&scene);
    }
    assert_int_equal(lobe_device_validation_count(f->device), 0);
}

/// Poses that leave no surface: numbers stay finite, normals and tangents of unit length.
static void collapsed_poses_stay_finite(void **state) {
    static const float diagonals[][3] = {
        {0, 0, 0}, {1, 0, 1}, {0, 0, 1}, {1e-30f, 1e-30f, 1e-30f}, {1e18f, 1e-18f, 1}};
    fixture *f = *state;
    for (int flat = 0; flat < 2; flat++) {
        for (size_t n = 0; n < sizeof diagonals / sizeof *diagonals; n++) {
            lobe_scene *scene =
                deformed_ball(&(deform_case){.influences = 1, .flat = flat, .scale = 1});
            lobe_mesh *mesh = &scene->meshes[0];
            for (int joint = 0; joint < JOINTS; joint++) {
                float *m = mesh->deformation->joint_matrices[joint];
                memset(m, 0, 15 * sizeof *m);
                for (int axis = 0; axis < 3; axis++)
                    m[5 * axis] = diagonals[n][axis];
            }
            lobe_scene_vertex *vertices = run_pass(f, scene);
            for (size_t i = 0; i < mesh->vertex_count; i++) {
                const lobe_scene_vertex *v = &vertices[i];
                const float zero[3] = {0};
                assert_true(isfinite(v->position[0] + v->position[1] + v->position[2]));
                assert_float_equal(distance(v->normal, zero, 3), 1, 1e-5);
                assert_float_equal(distance(v->tangent, zero, 3), 1, 1e-5);
                assert_true(fabsf(v->normal[0] * v->tangent[0] + v->normal[1] * v->tangent[1] +
                                  v->normal[2] * v->tangent[2]) < 1e-4f);
            }
            free(vertices);
            lobe_scene_destroy(&scene);
        }
    }
}

// ---------------------------------------------------------------------------------------------
// Pictures

static lobe_frame picture(fixture *f, const char *filter, const char *knob) {
    const picture_request request = {.filter = filter,
                                     .settings = {knob, NULL},
                                     .width = EXTENT,
                                     .height = EXTENT,
                                     .samples = 12};
    return draw(f, &request);
}

static void pictures_are_those_of_posed_meshes(void **state) {
    static const char *const methods[][2] = {
        {"direct"}, {"moments"}, {"lobes", "space=object"}, {"reference"}};
    fixture *f = *state;
    for (size_t n = 0; n < 2; n++) {
        const deform_case *c = &cases[n == 0 ? 5 : 6];
        lobe_scene *scene = deformed_ball(c), *posed = posed_ball(scene);
        for (size_t i = 0; i < sizeof methods / sizeof *methods; i++) {
            assert_int_equal(lobe_renderer_set_scene(f->renderer, posed), LOBE_OK);
            lobe_frame expected = picture(f, methods[i][0], methods[i][1]);
            assert_int_equal(lobe_renderer_set_scene(f->renderer, scene), LOBE_OK);
            lobe_frame frame = picture(f, methods[i][0], methods[i][1]);
            const double error = relative_l2(&frame.radiance, &expected.radiance);
            if (!(error < 2e-3) || !(largest_value(&expected.radiance) > 0.01))
                fail_msg("%s, %s: another picture, by %g", c->name, methods[i][0], error);
            lobe_frame_free(&expected);
            lobe_frame_free(&frame);
        }
        assert_int_equal(lobe_renderer_set_scene(f->renderer, NULL), LOBE_OK);
        lobe_scene_destroy(&scene);
        lobe_scene_destroy(&posed);
    }
    assert_int_equal(lobe_device_validation_count(f->device), 0);
}

static size_t count(const fixture *f, lobe_pass_state pass) {
    return count_passes(lobe_renderer_graph(f->renderer), "deform", pass);
}

static void draw_and_count(fixture *f, size_t run, size_t skipped) {
    lobe_frame frame = picture(f, "direct", NULL);
    lobe_frame_free(&frame);
    assert_int_equal(count(f, LOBE_PASS_RUN), run);
    assert_int_equal(count(f, LOBE_PASS_SKIPPED), skipped);
}

/// What a pose does not need does not run.
static void passes_run_when_poses_change(void **state) {
    const uint32_t first = 0;
    const lobe_scene_changes changes = {.meshes = &first, .mesh_count = 1};
    fixture *f = *state;
    lobe_scene *scene = deformed_ball(&cases[5]);
    lobe_mesh *mesh = &scene->meshes[0];
    assert_int_equal(lobe_renderer_set_scene(f->renderer, scene), LOBE_OK);
    draw_and_count(f, 1, 0);
    draw_and_count(f, 0, 1);
    scene->instances[0].transform[12] = 0.1f;
    scene->camera.eye[0] += 0.1f;
    draw_and_count(f, 0, 1);
    mesh->deformation->weights[0] += 0.1f;
    draw_and_count(f, 1, 0);
    mesh->deformation->joint_matrices[1][13] += 0.1f;
    draw_and_count(f, 1, 0);
    draw_and_count(f, 0, 1);
    mesh->vertices[0].position[0] += 0.1f;
    assert_int_equal(lobe_renderer_update_scene(f->renderer, &changes), LOBE_OK);
    draw_and_count(f, 1, 0);
    scene->instances[0].hidden = true;
    draw_and_count(f, 0, 0);
    assert_int_equal(lobe_renderer_set_scene(f->renderer, NULL), LOBE_OK);
    lobe_scene_destroy(&scene);
    // Targets of weight 0 do nothing; a mesh that keeps its shape has no pass at all.
    scene = deformed_ball(&cases[4]);
    memset(scene->meshes[0].deformation->weights, 0, TARGETS * sizeof(float));
    assert_int_equal(lobe_renderer_set_scene(f->renderer, scene), LOBE_OK);
    draw_and_count(f, 0, 0);
    assert_int_equal(count(f, LOBE_PASS_CULLED), 0);
    scene->meshes[0].deformation->weights[2] = 1;
    draw_and_count(f, 1, 0);
    assert_int_equal(lobe_renderer_set_scene(f->renderer, NULL), LOBE_OK);
    lobe_scene_destroy(&scene);
}

/// A mesh may lose its deformation, get another one, or get its base from the host.
static void give_base(void *user, lobe_graph *graph, const lobe_given_content *content) {
    content->vertices[0] = lobe_graph_import_buffer(graph, user);
}

static void bases_may_be_given(void **state) {
    fixture *f = *state;
    lobe_scene *scene = deformed_ball(&cases[5]);
    lobe_mesh *mesh = &scene->meshes[0];
    const uint32_t first = 0;
    const lobe_scene_changes changes = {.meshes = &first, .mesh_count = 1};
    lobe_buffer *base;
    assert_int_equal(lobe_buffer_create(f->device,
                                        &(lobe_buffer_parameters){.size = mesh->vertex_count *
                                                                          sizeof *mesh->vertices,
                                                                  .data = mesh->vertices},
                                        &base),
                     LOBE_OK);
    assert_int_equal(lobe_renderer_set_scene(f->renderer, scene), LOBE_OK);
    lobe_frame expected = picture(f, "direct", NULL);
    mesh->on_device = true;
    assert_int_equal(lobe_renderer_update_scene(f->renderer, &changes), LOBE_OK);
    lobe_renderer_set_content_giver(f->renderer, give_base, base);
    lobe_frame frame = picture(f, "direct", NULL);
    assert_true(image_hash(&frame.radiance) == image_hash(&expected.radiance));
    lobe_frame_free(&frame);
    lobe_renderer_set_content_giver(f->renderer, NULL, NULL);
    mesh->on_device = false;
    lobe_deformation *deformation = mesh->deformation;
    mesh->deformation = NULL;
    assert_int_equal(lobe_renderer_update_scene(f->renderer, &changes), LOBE_OK);
    draw_and_count(f, 0, 0);
    mesh->deformation = deformation;
    assert_int_equal(lobe_renderer_update_scene(f->renderer, &changes), LOBE_OK);
    frame = picture(f, "direct", NULL);
    assert_true(image_hash(&frame.radiance) == image_hash(&expected.radiance));
    lobe_frame_free(&frame);
    lobe_frame_free(&expected);
    assert_int_equal(lobe_renderer_set_scene(f->renderer, NULL), LOBE_OK);
    lobe_buffer_destroy(&base);
    lobe_scene_destroy(&scene);
}

// ---------------------------------------------------------------------------------------------
// Frames in flight

enum { FRAMES = 6 };

static void submit(lobe_renderer *renderer, const host_device *host, const host_image *image,
                   VkCommandBuffer commands) {
    const lobe_vulkan_image lent = {.image = image->image,
                                    .format = image->format,
                                    .width = EXTENT,
                                    .height = EXTENT,
                                    .usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT,
                                    .final_layout = VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL};
    const lobe_render_target target = {.radiance = &lent};
    const lobe_vulkan_submission submission = {.commands = commands};
    const lobe_render_parameters parameters = {
        .filter = filter_named("direct"),
        .host = {.target = &target, .submission = &submission, .frames_in_flight = 3}};
    lobe_frame frame;
    if (lobe_renderer_render(renderer, &parameters, &frame) != LOBE_OK)
        fail_msg("%s", host->recorder.last_error);
    lobe_frame_free(&frame);
}

/// The host poses the scene for the next frame while the device draws the last: each has its own.
static void frames_in_flight_have_their_own_poses(void **state) {
    (void)state;
    host_device host;
    lobe_device *device;
    lobe_renderer *renderer = host_renderer_open(&host, &device);
    lobe_scene *scene = deformed_ball(&cases[5]);
    assert_int_equal(lobe_renderer_set_scene(renderer, scene), LOBE_OK);
    host_image images[2][FRAMES];
    for (int waits = 0; waits < 2; waits++) {
        for (uint64_t n = 0; n < FRAMES; n++) {
            const bool own = !waits && n == 3; // into the host's commands
            VkCommandBuffer commands = own ? host_begin(&host) : NULL;
            images[waits][n] = host_image_create(
                &host, VK_FORMAT_R32G32B32A32_SFLOAT, EXTENT, EXTENT,
                VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT);
            set_pose(&cases[5], &scene->meshes[0], 10 + n / 2 * 2);
            submit(renderer, &host, &images[waits][n], commands);
            if (own)
                host_finish(&host, commands);
            if (waits)
                assert_int_equal(lobe_graph_wait(lobe_renderer_graph(renderer)), LOBE_OK);
        }
        assert_int_equal(lobe_graph_wait(lobe_renderer_graph(renderer)), LOBE_OK);
    }
    uint64_t last = 0;
    for (int n = 0; n < FRAMES; n++) {
        float texels[2][EXTENT * EXTENT * 4];
        uint64_t hashes[2];
        for (int i = 0; i < 2; i++) {
            host_read(&host, &images[i][n], texels[i], sizeof texels[i]);
            hashes[i] =
                image_hash(&(lobe_image){LOBE_FORMAT_RGBA32_FLOAT, EXTENT, EXTENT, texels[i]});
            host_image_destroy(&host, &images[i][n]);
        }
        assert_true(hashes[0] == hashes[1]);
        assert_int_equal(hashes[0] == last, n % 2 == 1); // each pose is shown twice
        last = hashes[0];
    }
    lobe_renderer_destroy(&renderer);
    lobe_device_destroy(&device);
    lobe_scene_destroy(&scene);
    host_device_close(&host);
}

// ---------------------------------------------------------------------------------------------
// Mistakes

typedef void (*mistake)(lobe_mesh *mesh);

static void lose_joint(lobe_mesh *mesh) {
    mesh->deformation->influences[5].joint = JOINTS;
}
static void lose_weight(lobe_mesh *mesh) {
    mesh->deformation->influences[5].weight = NAN;
}
static void lose_joints(lobe_mesh *mesh) {
    mesh->deformation->joint_count = 0;
}
static void lose_target(lobe_mesh *mesh) {
    mesh->deformation->deltas[3].target = TARGETS;
}
static void lose_delta(lobe_mesh *mesh) {
    mesh->deformation->deltas[3].normal[1] = INFINITY;
}
static void lose_order(lobe_mesh *mesh) {
    mesh->deformation->first_deltas[4] = (uint32_t)mesh->deformation->delta_count + 1;
}
static void add_many(lobe_mesh *mesh) {
    mesh->deformation->influences_per_vertex = LOBE_MAXIMUM_INFLUENCES + 1;
}
static void lose_matrix(lobe_mesh *mesh) {
    mesh->deformation->joint_matrices[2][6] = NAN;
}
static void lose_row(lobe_mesh *mesh) {
    mesh->deformation->joint_matrices[2][7] = 1;
}
static void lose_pose(lobe_mesh *mesh) {
    mesh->deformation->weights[1] = INFINITY;
}

static void mistakes_are_named(void **state) {
    static const struct {
        mistake make;
        bool in_frames; ///< noticed in a frame, too
        lobe_result result;
        const char *line;
    } mistakes[] = {
        {lose_joint, false, LOBE_ERROR_MALFORMED, "vertex 1 follows joint 5 of 5"},
        {lose_weight, false, LOBE_ERROR_MALFORMED, "vertex 1 has the joint weight nan"},
        {lose_joints, false, LOBE_ERROR_MALFORMED, "joints without influences"},
        {lose_target, false, LOBE_ERROR_MALFORMED, "morph delta 3"},
        {lose_delta, false, LOBE_ERROR_MALFORMED, "morph delta 3"},
        {lose_order, false, LOBE_ERROR_MALFORMED, "deltas that are not in order"},
        {add_many, false, LOBE_ERROR_LIMIT, "too many joints"},
        {lose_matrix, true, LOBE_ERROR_MALFORMED, "joint_matrices[2][6] is nan"},
        {lose_row, true, LOBE_ERROR_MALFORMED, "the last row of joint_matrices[2]"},
        {lose_pose, true, LOBE_ERROR_MALFORMED, "weights[1] is inf"},
    };
    fixture *f = *state;
    for (size_t i = 0; i < sizeof mistakes / sizeof *mistakes; i++) {
        lobe_scene *scene = deformed_ball(&cases[5]);
        if (mistakes[i].in_frames) {
            const lobe_render_parameters parameters = {.width = EXTENT, .height = EXTENT};
            lobe_frame frame;
            assert_int_equal(lobe_renderer_set_scene(f->renderer, scene), LOBE_OK);
            mistakes[i].make(&scene->meshes[0]);
            fixture_forget_messages(f);
            assert_failure(f, lobe_renderer_render(f->renderer, &parameters, &frame),
                           mistakes[i].result, mistakes[i].line);
        } else {
            mistakes[i].make(&scene->meshes[0]);
        }
        fixture_forget_messages(f);
        assert_failure(f, lobe_renderer_set_scene(f->renderer, scene), mistakes[i].result,
                       mistakes[i].line);
        fixture_forget_messages(f);
        assert_int_equal(lobe_renderer_set_scene(f->renderer, NULL), LOBE_OK);
        lobe_scene_destroy(&scene);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(vertices_are_those_of_the_reference),
        cmocka_unit_test(collapsed_poses_stay_finite),
        cmocka_unit_test(pictures_are_those_of_posed_meshes),
        cmocka_unit_test(passes_run_when_poses_change),
        cmocka_unit_test(bases_may_be_given),
        cmocka_unit_test(frames_in_flight_have_their_own_poses),
        cmocka_unit_test(mistakes_are_named),
    };
    return cmocka_run_group_tests(tests, fixture_create_validated, fixture_destroy);
}
