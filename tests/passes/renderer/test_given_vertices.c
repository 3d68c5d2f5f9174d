// Meshes whose vertices the host gives on the device: pictures equal those of the same vertices
// uploaded, wherever the example's were, and they may change in every frame.

#include "tests/passes/support/fixture.h"

#include <string.h>

#include "tests/passes/host/host_renderer.h"
#include "tests/passes/support/picture.h"
#include "tests/passes/support/scene_builder.h"

enum { EXTENT = 16 };

/// A bumpy ball with a map on an atlas; `place`: of its centre.
static lobe_scene *ball(float place) {
    lobe_scene *scene = scene_begin();
    lobe_material material = microfacet_material(LOBE_DISTRIBUTION_GGX, 0.5, 1);
    material.normal_map = scene_add_map(scene, random_normal_map(32, 32, 0.4, 400));
    scene_add_sphere(scene, &material, 1);
    for (size_t i = 0; i < scene->meshes[0].vertex_count; i++) {
        float *position = scene->meshes[0].vertices[i].position;
        for (int axis = 0; axis < 3; axis++)
            position[axis] *= 1 - 0.3f * place;
        position[0] += place;
    }
    scene_add_sun(scene, (double[]){0.3, 1, 0.2}, 2);
    scene_look_from(scene, (double[]){0.3, 1, 0.4}, 3);
    scene_end(scene);
    return scene;
}

static size_t vertex_bytes(const lobe_scene *scene) {
    return scene->meshes[0].vertex_count * sizeof *scene->meshes[0].vertices;
}

// ---------------------------------------------------------------------------------------------
// By passes

static void give_buffer(void *user, lobe_graph *graph, const lobe_given_content *content) {
    content->vertices[0] = lobe_graph_import_buffer(graph, user);
}

static lobe_buffer *buffer_of(fixture *f, const lobe_scene *scene) {
    lobe_buffer *buffer;
    assert_int_equal(
        lobe_buffer_create(f->device,
                           &(lobe_buffer_parameters){.size = vertex_bytes(scene),
                                                     .data = scene->meshes[0].vertices},
                           &buffer),
        LOBE_OK);
    return buffer;
}

static lobe_frame picture(fixture *f, const char *filter, const char *knob) {
    const picture_request request = {.filter = filter,
                                     .settings = {knob, NULL},
                                     .width = EXTENT,
                                     .height = EXTENT,
                                     .samples = 12};
    return draw(f, &request);
}

static void pictures_are_those_of_uploaded_vertices(void **state) {
    static const char *const methods[][2] = {
        {"direct"}, {"mipmap"}, {"moments"}, {"lobes", "space=object"}, {"reference"}};
    fixture *f = *state;
    lobe_scene *example = ball(0);
    example->meshes[0].on_device = true;
    for (int place = -1; place < 2; place++) {
        lobe_scene *scene = ball(0.4f * (float)place);
        memcpy(example->minimum, scene->minimum, sizeof scene->minimum);
        memcpy(example->maximum, scene->maximum, sizeof scene->maximum);
        lobe_buffer *vertices = buffer_of(f, scene);
        for (size_t i = 0; i < sizeof methods / sizeof *methods; i++) {
            assert_int_equal(lobe_renderer_set_scene(f->renderer, scene), LOBE_OK);
            lobe_frame expected = picture(f, methods[i][0], methods[i][1]);
            assert_int_equal(lobe_renderer_set_scene(f->renderer, example), LOBE_OK);
            lobe_renderer_set_content_giver(f->renderer, give_buffer, vertices);
            lobe_frame frame = picture(f, methods[i][0], methods[i][1]);
            lobe_renderer_set_content_giver(f->renderer, NULL, NULL);
            const double error = relative_l2(&frame.radiance, &expected.radiance);
            if (!(error < 1e-5) || !(largest_value(&expected.radiance) > 0.01))
                fail_msg("%s, place %d: another picture, by %g", methods[i][0], place, error);
            lobe_frame_free(&expected);
            lobe_frame_free(&frame);
        }
        assert_int_equal(lobe_renderer_set_scene(f->renderer, NULL), LOBE_OK);
        lobe_buffer_destroy(&vertices);
        lobe_scene_destroy(&scene);
    }
    lobe_scene_destroy(&example);
    assert_int_equal(lobe_device_validation_count(f->device), 0);
}

/// The copy on the device is made, and goes, where the host says so.
static void vertices_may_move_between_host_and_device(void **state) {
    fixture *f = *state;
    lobe_scene *scene = ball(0.2f);
    lobe_buffer *vertices = buffer_of(f, scene);
    const uint32_t mesh = 0;
    const lobe_scene_changes changes = {.meshes = &mesh, .mesh_count = 1};
    assert_int_equal(lobe_renderer_set_scene(f->renderer, scene), LOBE_OK);
    lobe_frame expected = picture(f, "toksvig", NULL);
    for (int i = 0; i < 4; i++) {
        const bool given = i % 2 == 0;
        scene->meshes[0].on_device = given;
        assert_int_equal(lobe_renderer_update_scene(f->renderer, &changes), LOBE_OK);
        lobe_renderer_set_content_giver(f->renderer, given ? give_buffer : NULL, vertices);
        lobe_frame frame = picture(f, "toksvig", NULL);
        assert_true(relative_l2(&frame.radiance, &expected.radiance) < 1e-5);
        lobe_frame_free(&frame);
    }
    lobe_frame_free(&expected);
    assert_int_equal(lobe_renderer_set_scene(f->renderer, NULL), LOBE_OK);
    lobe_buffer_destroy(&vertices);
    lobe_scene_destroy(&scene);
}

// ---------------------------------------------------------------------------------------------
// By the host's Vulkan

static void give_vulkan(void *user, lobe_graph *graph, const lobe_given_content *content) {
    content->vertices[0] = lobe_graph_import_host_buffer(graph, user);
}

static void render_into(lobe_renderer *renderer, const host_device *host, const host_image *picture,
                        VkCommandBuffer commands) {
    const lobe_vulkan_image target = {.image = picture->image,
                                      .format = picture->format,
                                      .width = EXTENT,
                                      .height = EXTENT,
                                      .usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT,
                                      .final_layout = VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL};
    const lobe_render_parameters parameters = {
        .filter = filter_named("toksvig"),
        .host = {.target = &(lobe_render_target){.radiance = &target},
                 .submission = &(lobe_vulkan_submission){.commands = commands}}};
    lobe_frame frame;
    if (lobe_renderer_render(renderer, &parameters, &frame) != LOBE_OK)
        fail_msg("%s", host->recorder.last_error);
    lobe_frame_free(&frame);
}

/// The host writes its buffer, and lobe reads it in the same command buffer.
static void buffers_of_the_hosts_vulkan_are_meshes(void **state) {
    enum { FIRST = 1024 }; // bytes before the vertices
    (void)state;
    host_device host;
    lobe_device *device;
    lobe_renderer *renderer = host_renderer_open(&host, &device);
    lobe_scene *scene = ball(0.3f);
    host_image picture =
        host_image_create(&host, VK_FORMAT_R32G32B32A32_SFLOAT, EXTENT, EXTENT,
                          VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT);
    const VkBufferUsageFlags usage =
        VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT;
    host_buffer buffer = host_buffer_create(&host, FIRST + vertex_bytes(scene), usage);
    float texels[2][EXTENT * EXTENT * 4];
    for (int given = 0; given < 2; given++) {
        scene->meshes[0].on_device = given;
        assert_int_equal(lobe_renderer_set_scene(renderer, scene), LOBE_OK);
        lobe_vulkan_buffer lent = {
            .buffer = buffer.buffer, .offset = FIRST, .size = vertex_bytes(scene), .usage = usage};
        lobe_renderer_set_content_giver(renderer, given ? give_vulkan : NULL, &lent);
        VkCommandBuffer commands = host_begin(&host);
        host_write(commands, &buffer, FIRST, scene->meshes[0].vertices, vertex_bytes(scene));
        render_into(renderer, &host, &picture, commands);
        host_finish(&host, commands);
        host_read(&host, &picture, texels[given], sizeof texels[given]);
    }
    assert_true(texels[0][4 * (EXTENT / 2 * EXTENT + EXTENT / 2)] > 0);
    for (size_t i = 0; i < sizeof texels[0] / sizeof texels[0][0]; i++)
        assert_float_equal(texels[0][i], texels[1][i], 1e-5);
    lobe_renderer_destroy(&renderer);
    lobe_device_destroy(&device);
    host_image_destroy(&host, &picture);
    host_buffer_destroy(&host, &buffer);
    host_device_close(&host);
    lobe_scene_destroy(&scene);
}

// ---------------------------------------------------------------------------------------------
// Mistakes

static void assert_refused(fixture *f, lobe_content_giver given, void *user, const char *line) {
    const lobe_render_parameters parameters = {
        .filter = filter_named("moments"), .width = EXTENT, .height = EXTENT};
    lobe_frame frame;
    fixture_forget_messages(f);
    lobe_renderer_set_content_giver(f->renderer, given, user);
    assert_failure(f, lobe_renderer_render(f->renderer, &parameters, &frame),
                   LOBE_ERROR_INVALID_ARGUMENT, line);
    fixture_forget_messages(f);
}

static void give_little(void *user, lobe_graph *graph, const lobe_given_content *content) {
    (void)user;
    content->vertices[0] = lobe_graph_upload(graph, "little", "text", 4);
}

static void mistakes_are_named(void **state) {
    fixture *f = *state;
    lobe_scene *scene = ball(0);
    lobe_buffer *vertices = buffer_of(f, scene);
    assert_int_equal(lobe_renderer_set_scene(f->renderer, scene), LOBE_OK);
    assert_refused(f, give_buffer, vertices, "is not on the device");
    scene->meshes[0].on_device = true;
    assert_int_equal(lobe_renderer_set_scene(f->renderer, scene), LOBE_OK);
    assert_refused(f, NULL, NULL, "the host gave no vertices");
    assert_refused(f, give_little, NULL, "bytes of vertices, but the host gave 4");
    assert_int_equal(lobe_renderer_set_scene(f->renderer, NULL), LOBE_OK);
    lobe_renderer_set_content_giver(f->renderer, NULL, NULL);
    lobe_buffer_destroy(&vertices);
    lobe_scene_destroy(&scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pictures_are_those_of_uploaded_vertices),
        cmocka_unit_test(vertices_may_move_between_host_and_device),
        cmocka_unit_test(buffers_of_the_hosts_vulkan_are_meshes),
        cmocka_unit_test(mistakes_are_named),
    };
    return cmocka_run_group_tests(tests, fixture_create_validated, fixture_destroy);
}
