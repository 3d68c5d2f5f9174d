// Instances that come and go between frames: pictures equal those of a renderer that never had
// others, nothing is uploaded again, and maps of materials that are still drawn stay.

#include "tests/passes/support/fixture.h"

#include <string.h>

#include "engine/graph/state.h"
#include "scenes/scene/scene.h"
#include "tests/engine/support/host_device.h"
#include "tests/engine/support/vulkan_faults.h"
#include "tests/passes/support/picture.h"
#include "tests/passes/support/scene_builder.h"

enum { EXTENT = 16, MESHES = 2, MATERIALS = 2, DRAWN = 2 };

/// Small and turned, anywhere on the ground; each third is mirrored.
static void place(size_t number, float transform[16]) {
    const float size = 0.15f, x = -0.9f + 0.45f * (float)(number % 5),
                z = -0.9f + 0.45f * (float)(number / 5 % 5);
    const float side = number % 3 == 2 ? -size : size;
    const float placed[16] = {0.6f * side,  0, 0.8f * side, 0, 0, size,      0, 0,
                              -0.8f * size, 0, 0.6f * size, 0, x, 0.05f * x, z, 1};
    memcpy(transform, placed, sizeof placed);
}

static lobe_material bumpy_material(lobe_scene *scene, float roughness, uint64_t seed) {
    lobe_material material;
    lobe_material_default(&material);
    material.roughness = roughness;
    material.double_sided = true;
    material.normal_map = scene_add_map(scene, random_normal_map(16, 16, 0.5, seed));
    return material;
}

static void append(lobe_scene *scene, uint32_t mesh, uint32_t material) {
    float transform[16];
    place(scene->instance_count, transform);
    assert_int_equal(scenes_add_instance(scene, mesh, material, transform, NULL), LOBE_OK);
}

/// A square and a sphere; of a further mesh and material there is no instance yet.
static lobe_scene *start_scene(void) {
    lobe_scene *scene = scene_begin();
    const lobe_material materials[] = {bumpy_material(scene, 0.3f, 201),
                                       bumpy_material(scene, 0.6f, 202),
                                       bumpy_material(scene, 0.45f, 203)};
    scene_add_square(scene, &materials[0], 1, NULL);
    scene_add_sphere(scene, &materials[1], 1);
    scene_add_square(scene, &materials[2], 3, NULL);
    --scene->instance_count;
    for (size_t i = 0; i < DRAWN; i++)
        place(i, scene->instances[i].transform);
    scene_add_sun(scene, (double[]){0.3, 1, 0.2}, 2);
    scene_look_down(scene, 2);
    scene_end(scene);
    return scene;
}

typedef struct method {
    const char *filter, *setting;
    bool shares; ///< instances of a material share its maps
} method;

static const method methods[] = {
    {"direct", NULL, true},
    {"moments", "bins=2", true},
    {"lobes", NULL, true},
    {"lobes", "space=object", false},
};

static lobe_frame draw_with(fixture *f, lobe_renderer *renderer, const method *by) {
    fixture with = *f;
    with.renderer = renderer;
    const picture_request request = {
        .filter = by->filter, .settings = {by->setting, NULL}, .width = EXTENT, .height = EXTENT};
    return draw(&with, &request);
}

static uint64_t picture(fixture *f, lobe_renderer *renderer, const method *by) {
    lobe_frame frame = draw_with(f, renderer, by);
    const uint64_t hash = image_hash(&frame.radiance);
    lobe_frame_free(&frame);
    return hash;
}

/// The picture of a renderer that never saw the scene in another state.
static uint64_t fresh_picture(fixture *f, const lobe_scene *scene, const method *by) {
    lobe_renderer *renderer;
    assert_int_equal(lobe_renderer_create(f->device, &f->host, &renderer), LOBE_OK);
    assert_int_equal(lobe_renderer_set_scene(renderer, scene), LOBE_OK);
    const uint64_t hash = picture(f, renderer, by);
    lobe_renderer_destroy(&renderer);
    return hash;
}

static lobe_scene *start(fixture *f, const method *by) {
    lobe_scene *scene = start_scene();
    faults.paused = true; // nothing fails
    fixture_forget_messages(f);
    assert_int_equal(lobe_renderer_set_scene(f->renderer, scene), LOBE_OK);
    picture(f, f->renderer, by);
    return scene;
}

static void stop(fixture *f, lobe_scene **scene) {
    assert_int_equal(lobe_renderer_set_scene(f->renderer, NULL), LOBE_OK);
    lobe_scene_destroy(scene);
    assert_int_equal(f->errors, 0);
    assert_int_equal(lobe_device_validation_count(f->device), 0);
}

static int calls_until_now(void) {
    return vulkan_calls("vkQueueSubmit2") + vulkan_calls("vkWaitSemaphores") +
           vulkan_calls("vkQueueWaitIdle") + vulkan_calls("vkDeviceWaitIdle") + faults.made;
}

/// The update calls nothing, copies `copies` things, and the frame after it equals that of a new
/// renderer. Returns the passes that this frame ran.
static size_t check_update(fixture *f, const lobe_scene *scene, const method *by,
                           const lobe_scene_changes *changes, size_t copies) {
    const int before = calls_until_now();
    if (lobe_renderer_update_scene(f->renderer, changes) != LOBE_OK)
        fail_msg("%s", f->error);
    assert_int_equal(lobe_renderer_graph(f->renderer)->kept.uploads.count, copies);
    if (copies == 0)
        assert_int_equal(calls_until_now() - before, 0);
    const uint64_t hash = picture(f, f->renderer, by);
    const size_t ran = count_passes(lobe_renderer_graph(f->renderer), NULL, LOBE_PASS_RUN);
    if (hash != fresh_picture(f, scene, by))
        fail_msg("%s %s, %zu instances: not the picture of a new renderer", by->filter,
                 by->setting ? by->setting : "", scene->instance_count);
    return ran;
}

/// By moving the last one to its place.
static void remove_one(lobe_scene *scene, size_t index) {
    scene->instances[index] = scene->instances[--scene->instance_count];
}

// ---------------------------------------------------------------------------------------------
// What comes and goes

/// Maps over a surface belong to an instance: those of new ones are made, no others.
static void check_maps(const method *by, size_t ran, bool adds) {
    if (by->shares || !adds)
        assert_int_equal(ran, 1);
    else
        assert_true(ran > 1);
}

static void check_coming_and_going(fixture *f, const method *by) {
    static const lobe_scene_changes nothing = {0};
    static const uint32_t second = 1;
    lobe_scene *scene = start(f, by);
    const uint64_t first = picture(f, f->renderer, by);
    for (uint32_t n = 0; n < 5; n++)
        append(scene, n % MESHES, (n + 1) / 2 % MATERIALS);
    check_maps(by, check_update(f, scene, by, &nothing, 0), true);
    // From within, and from the end. What is now at that place is another instance.
    remove_one(scene, second);
    const lobe_scene_changes moved = {.instances = &second, .instance_count = 1};
    const size_t ran = check_update(f, scene, by, &moved, 0);
    if (by->shares)
        assert_int_equal(ran, 1);
    scene->instance_count -= 2;
    check_maps(by, check_update(f, scene, by, &nothing, 0), false);
    // Back to where it began.
    scene->instance_count = DRAWN;
    scene->instances[1].mesh = scene->instances[1].material = 1;
    place(1, scene->instances[1].transform);
    check_update(f, scene, by, &moved, 0);
    assert_true(picture(f, f->renderer, by) == first);
    stop(f, &scene);
}

static void instances_come_and_go(void **state) {
    for (size_t i = 0; i < sizeof methods / sizeof *methods; i++)
        check_coming_and_going(*state, &methods[i]);
}

/// The first instance of a mesh and a material brings them to the device.
static void what_had_no_instance_is_uploaded_once(void **state) {
    static const lobe_scene_changes nothing = {0};
    fixture *f = *state;
    lobe_scene *scene = start(f, &methods[1]);
    append(scene, 2, 2);
    // The map, three sets of constants, vertices and indices.
    check_update(f, scene, &methods[1], &nothing, 6);
    append(scene, 2, 2);
    assert_int_equal(check_update(f, scene, &methods[1], &nothing, 0), 1);
    // They stay while they have no instance.
    scene->instance_count -= 2;
    check_update(f, scene, &methods[1], &nothing, 0);
    append(scene, 2, 2);
    check_update(f, scene, &methods[1], &nothing, 0);
    stop(f, &scene);
}

static void all_may_go(void **state) {
    static const lobe_scene_changes nothing = {0};
    fixture *f = *state;
    for (size_t i = 0; i < sizeof methods / sizeof *methods; i++) {
        lobe_scene *scene = start(f, &methods[i]);
        lobe_instance *instances = scene->instances;
        const uint64_t before = picture(f, f->renderer, &methods[i]);
        for (int n = 0; n < 3; n++)
            scene->background[n] = 0.25f;
        scene->instances = NULL;
        scene->instance_count = 0;
        assert_int_equal(lobe_renderer_update_scene(f->renderer, &nothing), LOBE_OK);
        lobe_frame frame = draw_with(f, f->renderer, &methods[i]);
        for (uint32_t n = 0; n < EXTENT * EXTENT; n++)
            assert_true(pixel_at(&frame.radiance, n % EXTENT, n / EXTENT)[0] == 0.25f);
        lobe_frame_free(&frame);
        for (int n = 0; n < 3; n++)
            scene->background[n] = 0;
        scene->instances = instances;
        scene->instance_count = DRAWN;
        assert_int_equal(lobe_renderer_update_scene(f->renderer, &nothing), LOBE_OK);
        assert_true(picture(f, f->renderer, &methods[i]) == before);
        stop(f, &scene);
    }
}

/// One at a time, through several steps of the memory for them.
static void many_come_one_by_one(void **state) {
    static const lobe_scene_changes nothing = {0};
    fixture *f = *state;
    lobe_scene *scene = start(f, &methods[0]);
    for (uint32_t n = 0; n < 40; n++) {
        append(scene, n % MESHES, n / 2 % MATERIALS);
        assert_int_equal(lobe_renderer_update_scene(f->renderer, &nothing), LOBE_OK);
        if (n % 3 == 0)
            picture(f, f->renderer, &methods[0]);
    }
    assert_true(picture(f, f->renderer, &methods[0]) == fresh_picture(f, scene, &methods[0]));
    stop(f, &scene);
}

// ---------------------------------------------------------------------------------------------
// Other renderers, frames in flight

/// A renderer draws the instances that it was told of, and asks for news.
static void each_renderer_is_told(void **state) {
    static const lobe_scene_changes nothing = {0};
    const method *by = &methods[2];
    fixture *f = *state;
    lobe_scene *scene = start(f, by);
    lobe_renderer *other;
    assert_int_equal(lobe_renderer_create(f->device, &f->host, &other), LOBE_OK);
    assert_int_equal(lobe_renderer_set_scene(other, scene), LOBE_OK);
    picture(f, other, by);
    append(scene, 1, 0);
    check_update(f, scene, by, &nothing, 0);
    lobe_frame frame;
    assert_failure(f, lobe_renderer_render(other, &(lobe_render_parameters){0}, &frame),
                   LOBE_ERROR_INVALID_ARGUMENT, "3 instances, but the renderer was told of 2");
    fixture_forget_messages(f);
    assert_int_equal(lobe_renderer_update_scene(other, &nothing), LOBE_OK);
    assert_true(picture(f, other, by) == picture(f, f->renderer, by));
    assert_int_equal(count_passes(lobe_renderer_graph(other), NULL, LOBE_PASS_RUN), 1);
    lobe_renderer_destroy(&other);
    stop(f, &scene);
}

/// Frames that were submitted before the change show what there was then.
static void frames_in_flight_keep_their_instances(void **state) {
    enum { FRAMES = 6 };
    static const uint32_t third = 2;
    const lobe_scene_changes replaced = {.instances = &third, .instance_count = 1};
    const VkImageUsageFlags usage =
        VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT;
    fixture *f = *state;
    lobe_scene *scene = start(f, &methods[0]);
    host_device host = {0};
    host_image images[FRAMES];
    uint64_t expected[FRAMES];
    lobe_vulkan_export_device(f->device, &host.vulkan);
    const VkCommandPoolCreateInfo pool = {.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO,
                                          .queueFamilyIndex = host.vulkan.queue_family};
    assert_int_equal(vkCreateCommandPool(host.vulkan.device, &pool, NULL, &host.pool), VK_SUCCESS);
    for (int n = 0; n < FRAMES; n++) {
        if (n == 3)
            scene->instance_count = DRAWN;
        append(scene, (uint32_t)n % MESHES, (uint32_t)n / 2 % MATERIALS);
        expected[n] = fresh_picture(f, scene, &methods[0]);
        images[n] = host_image_create(&host, VK_FORMAT_R32G32B32A32_SFLOAT, EXTENT, EXTENT, usage);
        const lobe_vulkan_image lent = {.image = images[n].image,
                                        .format = images[n].format,
                                        .width = EXTENT,
                                        .height = EXTENT,
                                        .usage = usage,
                                        .final_layout = VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL};
        const lobe_render_target target = {.radiance = &lent};
        const lobe_vulkan_submission submission = {0};
        const lobe_render_parameters wanted = {
            .filter = filter_named(methods[0].filter),
            .width = EXTENT,
            .height = EXTENT,
            .host = {.target = &target, .submission = &submission, .frames_in_flight = 3}};
        lobe_frame frame;
        const int before = vulkan_calls("vkQueueSubmit2");
        assert_int_equal(lobe_renderer_update_scene(f->renderer, &replaced), LOBE_OK);
        if (lobe_renderer_render(f->renderer, &wanted, &frame) != LOBE_OK)
            fail_msg("%s", f->error);
        assert_int_equal(vulkan_calls("vkQueueSubmit2") - before, 1);
    }
    assert_int_equal(lobe_graph_wait(lobe_renderer_graph(f->renderer)), LOBE_OK);
    for (int n = 0; n < FRAMES; n++) {
        float texels[EXTENT * EXTENT * 4];
        host_read(&host, &images[n], texels, sizeof texels);
        if (image_hash(&(lobe_image){LOBE_FORMAT_RGBA32_FLOAT, EXTENT, EXTENT, texels}) !=
            expected[n])
            fail_msg("frame %d differs", n);
        host_image_destroy(&host, &images[n]);
    }
    vkDestroyCommandPool(host.vulkan.device, host.pool, NULL);
    stop(f, &scene);
}

// ---------------------------------------------------------------------------------------------
// Mistakes

static void mistakes_change_nothing(void **state) {
    static const lobe_scene_changes nothing = {0};
    static const uint32_t third = 2;
    fixture *f = *state;
    lobe_scene *scene = start(f, &methods[0]);
    const uint64_t before = picture(f, f->renderer, &methods[0]);
    append(scene, 0, 0);
    scene->instances[2].mesh = 50;
    assert_failure(f, lobe_renderer_update_scene(f->renderer, &nothing), LOBE_ERROR_MALFORMED,
                   "instance 2 uses mesh 50");
    fixture_forget_messages(f);
    scene->instances[2].mesh = 0;
    scene->instances[2].transform[5] = 0;
    assert_failure(f, lobe_renderer_update_scene(f->renderer, &nothing), LOBE_ERROR_MALFORMED,
                   "instance 2: its transform");
    fixture_forget_messages(f);
    // What the new one needs is checked, too.
    float *position = scene->meshes[2].vertices[1].position;
    place(2, scene->instances[2].transform);
    scene->instances[2].mesh = 2;
    const float was = position[0];
    position[0] = 1.0f / 0.0f;
    assert_failure(f, lobe_renderer_update_scene(f->renderer, &nothing), LOBE_ERROR_MALFORMED,
                   "vertex 1");
    fixture_forget_messages(f);
    position[0] = was;
    scene->instance_count = DRAWN;
    assert_failure(
        f,
        lobe_renderer_update_scene(f->renderer,
                                   &(lobe_scene_changes){.instances = &third, .instance_count = 1}),
        LOBE_ERROR_INVALID_ARGUMENT, "instance 2 of 2");
    fixture_forget_messages(f);
    lobe_instance *instances = scene->instances;
    scene->instances = NULL;
    assert_failure(f, lobe_renderer_update_scene(f->renderer, &nothing), LOBE_ERROR_MALFORMED,
                   "2 instances, but no array");
    fixture_forget_messages(f);
    scene->instances = instances;
    assert_true(picture(f, f->renderer, &methods[0]) == before);
    stop(f, &scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(instances_come_and_go),
        cmocka_unit_test(what_had_no_instance_is_uploaded_once),
        cmocka_unit_test(all_may_go),
        cmocka_unit_test(many_come_one_by_one),
        cmocka_unit_test(each_renderer_is_told),
        cmocka_unit_test(frames_in_flight_keep_their_instances),
        cmocka_unit_test(mistakes_change_nothing),
    };
    return cmocka_run_group_tests(tests, fixture_create_validated, fixture_destroy);
}
