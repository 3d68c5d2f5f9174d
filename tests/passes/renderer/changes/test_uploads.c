// What a host changes between frames reaches the device with the next frame: lobe submits nothing
// for it, waits for nothing, creates nothing and writes nothing twice. Pictures equal those of a
// scene that was always like that.

#include "tests/passes/support/fixture.h"

#include <math.h>
#include <string.h>

#include "engine/graph/state.h"
#include "shaders/interface/moment_refit.h"
#include "tests/engine/support/host_device.h"
#include "tests/engine/support/vulkan_faults.h"
#include "tests/passes/support/picture.h"
#include "tests/passes/support/scene_builder.h"

enum { EXTENT = 16, MATERIALS = 6, MAP = 32 };

static const uint32_t map = 0;

/// Six materials that share one map of normals, which `seed` decides.
static lobe_scene *shared_map_scene(uint64_t seed) {
    lobe_scene *scene = scene_begin();
    lobe_material material = half_vector_material(LOBE_DISTRIBUTION_VMF, 30);
    material.normal_map = scene_add_map(scene, random_normal_map(MAP, MAP, 0.5, seed));
    for (int n = 0; n < MATERIALS; n++) {
        float place[16] = {0.3f, 0, 0, 0, 0, 0.3f, 0, 0, 0, 0, 0.3f, 0, 0, 0, 0, 1};
        place[12] = 0.7f * (float)(n % 3 - 1);
        place[14] = 0.7f * (float)(n / 3) - 0.35f;
        material.base_colour[0] = 0.1f * (float)(n + 1);
        scene_add_square(scene, &material, 1, place);
    }
    scene_add_sun(scene, (double[]){0.3, 1, 0.2}, 2);
    scene_look_down(scene, 2.2);
    scene_end(scene);
    return scene;
}

static void stop(fixture *f, lobe_scene **scene) {
    assert_int_equal(lobe_renderer_set_scene(f->renderer, NULL), LOBE_OK);
    lobe_scene_destroy(scene);
    assert_int_equal(f->errors, 0);
    assert_int_equal(lobe_device_validation_count(f->device), 0);
}

static lobe_render_parameters parameters(void) {
    return (lobe_render_parameters){
        .filter = filter_named("lean"), .width = EXTENT, .height = EXTENT};
}

static uint64_t picture(fixture *f, lobe_renderer *renderer) {
    const lobe_render_parameters wanted = parameters();
    lobe_frame frame;
    if (lobe_renderer_render(renderer, &wanted, &frame) != LOBE_OK)
        fail_msg("%s", f->error);
    const uint64_t hash = image_hash(&frame.radiance);
    lobe_frame_free(&frame);
    return hash;
}

/// The picture of a renderer that never saw the scene in another state.
static uint64_t fresh_picture(fixture *f, const lobe_scene *scene) {
    lobe_renderer *renderer;
    assert_int_equal(lobe_renderer_create(f->device, &f->host, &renderer), LOBE_OK);
    assert_int_equal(lobe_renderer_set_scene(renderer, scene), LOBE_OK);
    const uint64_t hash = picture(f, renderer);
    lobe_renderer_destroy(&renderer);
    return hash;
}

static void update(fixture *f, const lobe_scene_changes *changes) {
    if (lobe_renderer_update_scene(f->renderer, changes) != LOBE_OK)
        fail_msg("%s", f->error);
}

static void change_texels(lobe_scene *scene, uint64_t seed) {
    lobe_image other = random_normal_map(MAP, MAP, 0.5, seed);
    memcpy(scene->images[map].image.texels, other.texels, (size_t)MAP * MAP * 16);
    lobe_image_free(&other);
}

/// After an update and two frames: there is memory that the next updates go through.
static lobe_scene *start(fixture *f) {
    lobe_scene *scene = shared_map_scene(7);
    faults.paused = true; // nothing fails, unless a test says so
    fixture_forget_messages(f);
    assert_int_equal(lobe_renderer_set_scene(f->renderer, scene), LOBE_OK);
    picture(f, f->renderer);
    update(f, &(lobe_scene_changes){.images = &map, .image_count = 1});
    picture(f, f->renderer);
    return scene;
}

// ---------------------------------------------------------------------------------------------
// Calls of Vulkan

typedef struct calls {
    int submissions, waits, made;
} calls;

static calls calls_until_now(void) {
    return (calls){vulkan_calls("vkQueueSubmit2"),
                   vulkan_calls("vkWaitSemaphores") + vulkan_calls("vkQueueWaitIdle") +
                       vulkan_calls("vkDeviceWaitIdle"),
                   faults.made};
}

static void assert_calls(const calls *before, int submissions, int waits, int made) {
    const calls now = calls_until_now();
    assert_int_equal(now.submissions - before->submissions, submissions);
    assert_int_equal(now.waits - before->waits, waits);
    if (made >= 0)
        assert_int_equal(now.made - before->made, made);
}

static size_t copies(const fixture *f) {
    return lobe_renderer_graph(f->renderer)->kept.uploads.count;
}

/// An update calls nothing, and the frame after it is one submission that lobe waits for because it
/// delivers the picture. `made`: objects that the update creates; -1: any.
static void check_update(fixture *f, const lobe_scene *scene, const lobe_scene_changes *changes,
                         size_t expected_copies, int made) {
    const calls before = calls_until_now();
    update(f, changes);
    assert_calls(&before, 0, 0, made);
    assert_int_equal(copies(f), expected_copies);
    const uint64_t hash = picture(f, f->renderer);
    assert_calls(&before, 1, 1, -1);
    assert_true(hash == fresh_picture(f, scene));
}

/// All objects of a new scene share submissions, which only memory that they pass through waits
/// for; the first frame waits for the last one.
static void a_scene_comes_in_few_submissions(void **state) {
    fixture *f = *state;
    lobe_scene *scene = start(f);
    const calls before = calls_until_now();
    assert_int_equal(lobe_renderer_set_scene(f->renderer, scene), LOBE_OK);
    assert_calls(&before, 1, 0, -1);
    picture(f, f->renderer);
    assert_calls(&before, 2, 2, -1);
    // Twice what is submitted at a time, and less than half of that again.
    lobe_image_free(&scene->images[map].image);
    scene->images[map].image = random_normal_map(768, 768, 0.5, 7);
    const calls large = calls_until_now();
    assert_int_equal(lobe_renderer_set_scene(f->renderer, scene), LOBE_OK);
    assert_calls(&large, 3, 2, -1);
    picture(f, f->renderer);
    assert_calls(&large, 4, 4, -1);
    stop(f, &scene);
}

static void texels_take_one_copy(void **state) {
    const lobe_scene_changes changes = {.images = &map, .image_count = 1};
    fixture *f = *state;
    lobe_scene *scene = start(f);
    for (uint64_t n = 0; n < 4; n++) {
        change_texels(scene, 20 + n);
        check_update(f, scene, &changes, 1, 0);
    }
    stop(f, &scene);
}

static void frames_with_changes_create_nothing(void **state) {
    const lobe_scene_changes changes = {.images = &map, .image_count = 1};
    fixture *f = *state;
    lobe_scene *scene = start(f);
    for (uint64_t n = 0; n < 5; n++) {
        change_texels(scene, 130 + n);
        const calls before = calls_until_now();
        update(f, &changes);
        picture(f, f->renderer);
        assert_calls(&before, 1, 1, 0);
    }
    stop(f, &scene);
}

/// Where what a filter keeps depends on the texels, it is the device that looks at them.
static void the_device_fits_bins_to_new_texels(void **state) {
    fixture *f = *state;
    lobe_scene *scene = start(f);
    lobe_render_parameters wanted = parameters();
    wanted.filter = filter_named("moments");
    for (uint64_t n = 0; n < 4; n++) {
        const calls before = calls_until_now();
        lobe_frame frame;
        assert_int_equal(lobe_renderer_render(f->renderer, &wanted, &frame), LOBE_OK);
        lobe_frame_free(&frame);
        const size_t refits =
            count_passes(lobe_renderer_graph(f->renderer), "moment_refit", LOBE_PASS_RUN);
        assert_int_equal(refits, n == 0 ? 0 : MATERIALS);
        // The first frames with and without refits create what they need.
        if (n > 0)
            assert_calls(&before, 1, 1, n > 1 ? 0 : -1);
        change_texels(scene, 40 + n);
        update(f, &(lobe_scene_changes){.images = &map, .image_count = 1});
    }
    stop(f, &scene);
}

/// A picture of `moments` with such a setting, whose fits follow no others, and how many fits it
/// took.
static uint64_t moments_picture(lobe_renderer *renderer, const char *setting, size_t *refits) {
    lobe_settings settings;
    lobe_render_parameters wanted = parameters();
    lobe_frame frame;
    wanted.filter = filter_named("moments");
    wanted.settings = &settings;
    lobe_settings_default(wanted.filter, &settings);
    assert_int_equal(lobe_settings_set(wanted.filter, &settings, "refit=anew", NULL), LOBE_OK);
    assert_int_equal(lobe_settings_set(wanted.filter, &settings, setting, NULL), LOBE_OK);
    assert_int_equal(lobe_renderer_render(renderer, &wanted, &frame), LOBE_OK);
    const uint64_t hash = image_hash(&frame.radiance);
    lobe_frame_free(&frame);
    *refits = count_passes(lobe_renderer_graph(renderer), "moment_refit", LOBE_PASS_RUN);
    return hash;
}

/// In frames with a fit of their own, pictures are those of a renderer that fits in every frame.
static void a_fit_serves_the_frames_after_it(void **state) {
    static const size_t expected[] = {0, MATERIALS, 0, MATERIALS, 0, 0, MATERIALS};
    const lobe_scene_changes changes = {.images = &map, .image_count = 1};
    fixture *f = *state;
    lobe_scene *scene = start(f);
    lobe_renderer *always;
    assert_int_equal(lobe_renderer_create(f->device, &f->host, &always), LOBE_OK);
    assert_int_equal(lobe_renderer_set_scene(always, scene), LOBE_OK);
    for (size_t n = 0; n < sizeof expected / sizeof *expected; n++) {
        size_t refits, others;
        const calls before = calls_until_now();
        const uint64_t hash = moments_picture(f->renderer, "frames_of_fit=3", &refits);
        if (n > 1) {
            assert_calls(&before, 1, 1, -1);
            assert_true(faults.made - before.made <= 1); // descriptors of a pool that there is
        }
        assert_int_equal(refits, expected[n]);
        const uint64_t other = moments_picture(always, "frames_of_fit=1", &others);
        assert_true((hash == other) == (refits == others));
        change_texels(scene, 70 + n);
        update(f, &changes);
        assert_int_equal(lobe_renderer_update_scene(always, &changes), LOBE_OK);
    }
    lobe_renderer_destroy(&always);
    stop(f, &scene);
}

/// Bins go on for some frames, then stay: each material's until a fit has left them as they were.
static void check_rest(fixture *f) {
    enum { MOST = FIT_RESTS_AFTER + 2 * (FITS_OF_SETTLING + 1) };
    size_t refits, before = MATERIALS, frames = 0;
    uint64_t hash = 0, former = 0;
    for (; lobe_graph_settles(lobe_renderer_graph(f->renderer)); frames++, before = refits) {
        former = hash;
        hash = moments_picture(f->renderer, "refit=follow", &refits);
        assert_true(refits > 0 && refits <= before);
    }
    assert_true(frames > FIT_RESTS_AFTER && frames < MOST);
    assert_true(hash == former);
    assert_true(moments_picture(f->renderer, "refit=follow", &refits) == hash);
    assert_int_equal(refits, 0);
}

/// Bins follow only where something changes, or has changed some frames ago, and neither those of
/// another scene nor of a frame that rebuilds all.
static void fits_follow_others(void **state) {
    fixture *f = *state;
    const lobe_scene_changes changes = {.images = &map, .image_count = 1};
    uint64_t hashes[2][3];
    size_t refits, none;
    for (int run = 0; run < 2; run++) {
        lobe_scene *scene = start(f);
        (void)moments_picture(f->renderer, "refit=follow", &none);
        for (int n = 0; n < 3; n++) {
            change_texels(scene, 90);
            ((float *)scene->images[map].image.texels)[4 * n] *= 0.9f;
            update(f, &changes);
            hashes[run][n] = moments_picture(f->renderer, "refit=follow", &refits);
            assert_int_equal(refits, MATERIALS);
        }
        if (run == 0)
            check_rest(f);
        const uint64_t anew = moments_picture(f->renderer, "refit=anew", &refits);
        assert_int_equal(refits, MATERIALS);
        assert_true(anew != hashes[run][2]);
        stop(f, &scene);
    }
    assert_memory_equal(hashes[0], hashes[1], sizeof hashes[0]);
}

/// The host makes bins for numbers that change once; where they change from frame to frame, and
/// stay near those, the device fits them again. Colours leave the bins alone.
static void the_device_fits_bins_to_moving_numbers(void **state) {
    static const struct {
        float width, red;
        size_t refits;
        bool exact; ///< bins are those of a renderer that never had other numbers
    } steps[] = {
        {30, 0.2f, 0, true},          {30, 0.9f, 0, true},          {45, 0.9f, 0, true},
        {59, 0.9f, MATERIALS, false}, {61, 0.9f, MATERIALS, false}, {61, 0.1f, 0, false},
        {70, 0.1f, 0, true},          {250, 0.1f, 0, true},
    };
    static const uint32_t all[MATERIALS] = {0, 1, 2, 3, 4, 5};
    const lobe_scene_changes changes = {.materials = all, .material_count = MATERIALS};
    fixture *f = *state;
    lobe_scene *scene = start(f);
    for (size_t i = 0; i < sizeof steps / sizeof *steps; i++) {
        for (int n = 0; n < MATERIALS; n++) {
            scene->materials[n].lobes[0].width = steps[i].width;
            scene->materials[n].base_colour[0] = steps[i].red;
        }
        update(f, &changes);
        size_t refits, fresh_refits;
        const uint64_t hash = moments_picture(f->renderer, "frames_of_fit=1", &refits);
        assert_int_equal(refits, steps[i].refits);
        lobe_renderer *fresh;
        assert_int_equal(lobe_renderer_create(f->device, &f->host, &fresh), LOBE_OK);
        assert_int_equal(lobe_renderer_set_scene(fresh, scene), LOBE_OK);
        const uint64_t expected = moments_picture(fresh, "frames_of_fit=1", &fresh_refits);
        assert_int_equal(fresh_refits, 0);
        assert_true((hash == expected) == steps[i].exact);
        lobe_renderer_destroy(&fresh);
    }
    stop(f, &scene);
}

static void equal_constants_are_not_written(void **state) {
    static const uint32_t all[MATERIALS] = {0, 1, 2, 3, 4, 5};
    const lobe_scene_changes changes = {.materials = all, .material_count = MATERIALS};
    fixture *f = *state;
    lobe_scene *scene = start(f);
    const uint64_t before = picture(f, f->renderer);
    check_update(f, scene, &changes, 0, 0);
    assert_int_equal(count_passes(lobe_renderer_graph(f->renderer), NULL, LOBE_PASS_RUN), 1);
    // Where a map lies is only in what shading reads, a colour also in what maps of lobes with
    // their colours are made of, a width in what all are made of.
    scene->materials[3].normal_map.transform[0][2] = 0.25f;
    check_update(f, scene, &changes, 1, 0);
    assert_int_equal(count_passes(lobe_renderer_graph(f->renderer), NULL, LOBE_PASS_RUN), 1);
    scene->materials[3].base_colour[1] = 0.25f;
    check_update(f, scene, &changes, 2, 0);
    assert_int_equal(count_passes(lobe_renderer_graph(f->renderer), NULL, LOBE_PASS_RUN), 1);
    scene->materials[2].lobes[0].width = 50;
    check_update(f, scene, &changes, 3, 0);
    assert_true(picture(f, f->renderer) != before);
    stop(f, &scene);
}

static void meshes_and_other_sizes_do_not_wait(void **state) {
    static const uint32_t second = 1;
    const lobe_scene_changes mesh = {.meshes = &second, .mesh_count = 1};
    const lobe_scene_changes image = {.images = &map, .image_count = 1};
    fixture *f = *state;
    lobe_scene *scene = start(f);
    scene->meshes[1].vertices[0].position[0] *= 0.5f;
    check_update(f, scene, &mesh, 2, 0);
    // Other sizes are other objects; the former go without a wait, too.
    scene->meshes[1].index_count = 3;
    check_update(f, scene, &mesh, 2, -1);
    lobe_image_free(&scene->images[map].image);
    scene->images[map].image = random_normal_map(8, 64, 0.5, 30);
    check_update(f, scene, &image, 1, -1);
    stop(f, &scene);
}

// ---------------------------------------------------------------------------------------------
// Parts of images

static void randomise(lobe_scene *scene, const lobe_rectangle *part, uint64_t seed) {
    lobe_image other = random_normal_map(MAP, MAP, 0.5, seed);
    for (uint32_t y = part->y; y < part->y + part->height; y++)
        memcpy((float *)scene->images[map].image.texels + 4 * (y * MAP + part->x),
               (float *)other.texels + 4 * (y * MAP + part->x), (size_t)part->width * 16);
    lobe_image_free(&other);
}

static void parts_of_images_are_enough(void **state) {
    static const lobe_rectangle parts[] = {{3, 5, 20, 1}, {0, 0, 1, 32}, {16, 16, 16, 16}, {0}};
    fixture *f = *state;
    lobe_scene *scene = start(f);
    for (uint64_t n = 0; n < 4; n++) {
        const lobe_rectangle whole = {0, 0, MAP, MAP};
        randomise(scene, parts[n].width ? &parts[n] : &whole, 40 + n);
        check_update(
            f, scene,
            &(lobe_scene_changes){.images = &map, .image_count = 1, .image_parts = &parts[n]}, 1,
            0);
    }
    stop(f, &scene);
}

static void an_image_may_change_in_several_parts(void **state) {
    static const lobe_rectangle parts[] = {{0, 0, 4, 4}, {20, 20, 8, 3}};
    static const uint32_t images[] = {0, 0};
    fixture *f = *state;
    lobe_scene *scene = start(f);
    for (int i = 0; i < 2; i++)
        randomise(scene, &parts[i], 50);
    check_update(f, scene,
                 &(lobe_scene_changes){.images = images, .image_count = 2, .image_parts = parts}, 2,
                 0);
    stop(f, &scene);
}

/// The second part is one of the new image.
static void parts_of_an_image_with_another_extent(void **state) {
    static const lobe_rectangle parts[] = {{0, 0, 4, 4}, {2, 40, 6, 3}};
    static const uint32_t images[] = {0, 0};
    fixture *f = *state;
    lobe_scene *scene = start(f);
    lobe_image_free(&scene->images[map].image);
    scene->images[map].image = random_normal_map(8, 64, 0.5, 31);
    check_update(f, scene,
                 &(lobe_scene_changes){.images = images, .image_count = 2, .image_parts = parts}, 1,
                 -1);
    stop(f, &scene);
}

/// Neither checked nor uploaded; a new extent makes them part of the change.
static void texels_outside_the_part_are_left_alone(void **state) {
    static const lobe_rectangle part = {4, 4, 8, 8};
    const lobe_scene_changes changes = {.images = &map, .image_count = 1, .image_parts = &part};
    fixture *f = *state;
    lobe_scene *scene = start(f);
    const uint64_t before = picture(f, f->renderer);
    float *texels = scene->images[map].image.texels;
    const float was = texels[0];
    texels[0] = NAN;
    update(f, &changes);
    assert_true(picture(f, f->renderer) == before);
    scene->images[map].image.height /= 2;
    assert_failure(f, lobe_renderer_update_scene(f->renderer, &changes), LOBE_ERROR_MALFORMED,
                   "texel 0, 0 is not finite");
    fixture_forget_messages(f);
    scene->images[map].image.height *= 2;
    texels[0] = was;
    texels[4 * (5 * MAP + 11) + 1] = INFINITY;
    assert_failure(f, lobe_renderer_update_scene(f->renderer, &changes), LOBE_ERROR_MALFORMED,
                   "texel 11, 5 is not finite");
    fixture_forget_messages(f);
    assert_true(picture(f, f->renderer) == before);
    stop(f, &scene);
}

static void parts_outside_the_image_are_refused(void **state) {
    static const lobe_rectangle parts[] = {
        {0, 0, 33, 1}, {31, 0, 2, 1}, {0, 32, 1, 1}, {3, 3, 0, 1}};
    fixture *f = *state;
    lobe_scene *scene = start(f);
    const uint64_t before = picture(f, f->renderer);
    change_texels(scene, 60);
    for (int i = 0; i < 4; i++) {
        assert_failure(
            f,
            lobe_renderer_update_scene(
                f->renderer,
                &(lobe_scene_changes){.images = &map, .image_count = 1, .image_parts = &parts[i]}),
            LOBE_ERROR_INVALID_ARGUMENT, "is 32x32, without");
        fixture_forget_messages(f);
    }
    assert_true(picture(f, f->renderer) == before);
    stop(f, &scene);
}

// ---------------------------------------------------------------------------------------------
// Frames

static void the_last_of_several_updates_counts(void **state) {
    const lobe_scene_changes changes = {.images = &map, .image_count = 1};
    static const lobe_rectangle part = {1, 2, 3, 4};
    fixture *f = *state;
    lobe_scene *scene = start(f);
    assert_int_equal(lobe_renderer_set_scene(f->renderer, scene), LOBE_OK);
    for (uint64_t n = 0; n < 5; n++) { // before the first frame, too
        change_texels(scene, 70 + 2 * n);
        update(f, &changes);
        change_texels(scene, 71 + 2 * n);
        update(f, &changes);
        randomise(scene, &part, 90 + n);
        const size_t before = copies(f);
        update(f, &(lobe_scene_changes){.images = &map, .image_count = 1, .image_parts = &part});
        assert_int_equal(copies(f), before);
        assert_true(picture(f, f->renderer) == fresh_picture(f, scene));
    }
    stop(f, &scene);
}

/// The device may still be reading former content when the host changes it again.
static void frames_in_flight_have_their_own_content(void **state) {
    enum { FRAMES = 6 };
    const lobe_scene_changes changes = {.images = &map, .image_count = 1};
    fixture *f = *state;
    lobe_scene *scene = start(f);
    host_device host = {0};
    host_image images[FRAMES];
    uint64_t expected[FRAMES];
    lobe_vulkan_export_device(f->device, &host.vulkan);
    const VkCommandPoolCreateInfo pool = {.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO,
                                          .queueFamilyIndex = host.vulkan.queue_family};
    assert_int_equal(vkCreateCommandPool(host.vulkan.device, &pool, NULL, &host.pool), VK_SUCCESS);
    const VkImageUsageFlags usage =
        VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT;
    for (uint64_t n = 0; n < FRAMES; n++) {
        change_texels(scene, 100 + n);
        expected[n] = fresh_picture(f, scene);
        images[n] = host_image_create(&host, VK_FORMAT_R32G32B32A32_SFLOAT, EXTENT, EXTENT, usage);
    }
    for (uint64_t n = 0; n < FRAMES; n++) {
        const lobe_vulkan_image lent = {.image = images[n].image,
                                        .format = images[n].format,
                                        .width = EXTENT,
                                        .height = EXTENT,
                                        .usage = usage,
                                        .final_layout = VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL};
        const lobe_render_target target = {.radiance = &lent};
        const bool own = n % 3 == 2; // into the host's commands
        const lobe_vulkan_submission submission = {.commands = own ? host_begin(&host) : NULL};
        lobe_render_parameters wanted = parameters();
        lobe_frame frame;
        wanted.host =
            (lobe_render_host){.target = &target, .submission = &submission, .frames_in_flight = 2};
        change_texels(scene, 100 + n);
        const calls before = calls_until_now();
        update(f, &changes);
        assert_calls(&before, 0, 0, n > 3 ? 0 : -1);
        if (lobe_renderer_render(f->renderer, &wanted, &frame) != LOBE_OK)
            fail_msg("%s", f->error);
        assert_int_equal(calls_until_now().submissions - before.submissions, !own);
        if (!own)
            continue;
        // The next content may come before the host submits this one.
        change_texels(scene, 101 + n);
        update(f, &changes);
        host_finish(&host, submission.commands);
    }
    assert_int_equal(lobe_graph_wait(lobe_renderer_graph(f->renderer)), LOBE_OK);
    for (int n = 0; n < FRAMES; n++) {
        float texels[EXTENT * EXTENT * 4];
        host_read(&host, &images[n], texels, sizeof texels);
        assert_true(image_hash(&(lobe_image){LOBE_FORMAT_RGBA32_FLOAT, EXTENT, EXTENT, texels}) ==
                    expected[n]);
        host_image_destroy(&host, &images[n]);
    }
    vkDestroyCommandPool(host.vulkan.device, host.pool, NULL);
    stop(f, &scene);
}

/// A frame that could not be submitted has copied nothing: the next one does.
static void the_frame_after_a_failed_one_has_the_change(void **state) {
    const lobe_scene_changes changes = {.images = &map, .image_count = 1};
    fixture *f = *state;
    lobe_scene *scene = start(f);
    change_texels(scene, 120);
    update(f, &changes);
    const lobe_render_parameters wanted = parameters();
    lobe_frame frame;
    faults.fault = VK_ERROR_OUT_OF_DEVICE_MEMORY;
    faults.failed = NULL;
    // Each call of the frame fails, up to its submission.
    for (int n = 1; !faults.failed || strcmp(faults.failed, "vkQueueSubmit2") != 0; n++) {
        faults.calls = 0;
        faults.failing = n;
        faults.paused = false;
        assert_int_equal(lobe_renderer_render(f->renderer, &wanted, &frame),
                         LOBE_ERROR_OUT_OF_DEVICE_MEMORY);
        faults.paused = true;
        assert_int_equal(copies(f), 1);
    }
    faults.failing = 0;
    fixture_forget_messages(f);
    assert_true(picture(f, f->renderer) == fresh_picture(f, scene));
    stop(f, &scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_scene_comes_in_few_submissions),
        cmocka_unit_test(texels_take_one_copy),
        cmocka_unit_test(frames_with_changes_create_nothing),
        cmocka_unit_test(the_device_fits_bins_to_new_texels),
        cmocka_unit_test(a_fit_serves_the_frames_after_it),
        cmocka_unit_test(fits_follow_others),
        cmocka_unit_test(the_device_fits_bins_to_moving_numbers),
        cmocka_unit_test(equal_constants_are_not_written),
        cmocka_unit_test(meshes_and_other_sizes_do_not_wait),
        cmocka_unit_test(parts_of_images_are_enough),
        cmocka_unit_test(an_image_may_change_in_several_parts),
        cmocka_unit_test(parts_of_an_image_with_another_extent),
        cmocka_unit_test(texels_outside_the_part_are_left_alone),
        cmocka_unit_test(parts_outside_the_image_are_refused),
        cmocka_unit_test(the_last_of_several_updates_counts),
        cmocka_unit_test(frames_in_flight_have_their_own_content),
        cmocka_unit_test(the_frame_after_a_failed_one_has_the_change),
    };
    return cmocka_run_group_tests(tests, fixture_create_validated, fixture_destroy);
}
