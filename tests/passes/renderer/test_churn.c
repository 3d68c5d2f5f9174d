// Frames that differ at random from one to the next: scenes, filters, sizes, materials, maps,
// targets and submissions. Memory returns to its level, and the validation layer is silent.
// `test_renderer_churn FRAMES` draws that many frames with all filters and prints the memory that
// they take (`ninja churn`: 10 000).

#include "tests/passes/support/fixture.h"

#include <malloc.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include "scenes/builtin/random.h"
#include "tests/engine/support/counting_allocator.h"
#include "tests/engine/support/host_device.h"
#include "tests/passes/support/picture.h"
#include "tests/passes/support/scene_builder.h"

enum { SCENES = 3, SIZES = 3, ROUNDS = 20, STRETCH = 8, FRAMES = 12, FILTERS = 4, QUARTERS = 4 };

typedef struct churn {
    host_device host;
    counting_allocator counting; ///< of everything in lobe except the scenes
    lobe_device *device;
    lobe_renderer *renderer;
    lobe_scene *scenes[SCENES];
    const lobe_scene *set;
    host_image targets[SIZES];
    random_sequence sequence;
    const lobe_filter *filters[32];
    uint32_t filter_count;
} churn;

static const uint32_t sizes[SIZES] = {4, 9, 16};

static uint32_t pick(churn *c, uint32_t count) {
    return scenes_random_bits(&c->sequence) % count;
}

/// Maps are `extent` texels high.
static lobe_scene *scene_of(int number, uint32_t extent) {
    lobe_scene *scene = scene_begin();
    for (int n = 0; n <= number; n++) {
        float aside[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0.5f * (float)n, 0, 0, 1};
        lobe_material material = half_vector_material(LOBE_DISTRIBUTION_VMF, 20);
        if (n % 2)
            lobe_material_default(&material);
        material.normal_map =
            scene_add_map(scene, random_normal_map(8, extent, 0.4, 70 + (uint64_t)(number + n)));
        scene_add_square(scene, &material, 1, aside);
    }
    scene_look_down(scene, 2);
    scene_end(scene);
    return scene;
}

/// A few filters whose shaders compile fast; or all except the reference.
static void choose_filters(churn *c, bool all) {
    static const char *const few[FILTERS] = {"lobes", "mipmap", "toksvig", "direct"};
    for (size_t n = 0; n < (all ? lobe_filter_count() : FILTERS); n++) {
        const lobe_filter *filter = all ? lobe_filter_get(n) : filter_named(few[n]);
        if (!lobe_filter_supersamples(filter))
            c->filters[c->filter_count++] = filter;
    }
}

static void open_churn(churn *c, bool validated, bool all_filters) {
    *c = (churn){0};
    choose_filters(c, all_filters);
    if (validated)
        host_device_open(&c->host);
    else
        host_device_open_unvalidated(&c->host);
    counting_allocator_start(&c->counting);
    c->host.recorder.host.allocator = &c->counting.allocator;
    c->device = host_device_import(&c->host);
    assert_int_equal(lobe_renderer_create(c->device, &c->host.recorder.host, &c->renderer),
                     LOBE_OK);
    for (int n = 0; n < SCENES; n++)
        c->scenes[n] = scene_of(n, 8);
    for (int n = 0; n < SIZES; n++)
        c->targets[n] = host_image_create(&c->host, VK_FORMAT_R16G16B16A16_SFLOAT, sizes[n],
                                          sizes[n], VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT);
}

static void close_churn(churn *c) {
    lobe_device_memory memory;
    lobe_renderer_destroy(&c->renderer);
    lobe_device_memory_query(c->device, &memory);
    assert_int_equal(memory.used_bytes, 0);
    assert_int_equal(memory.allocated_bytes, 0);
    for (int n = 0; n < SIZES; n++)
        host_image_destroy(&c->host, &c->targets[n]);
    for (int n = 0; n < SCENES; n++)
        lobe_scene_destroy(&c->scenes[n]);
    lobe_device_destroy(&c->device);
    assert_nothing_left(&c->counting);
    assert_int_equal(c->host.recorder.errors, 0);
    host_device_close(&c->host);
}

// ---------------------------------------------------------------------------------------------
// Changes

/// Switches to another scene, or replaces it by a new one with maps of another extent.
static void change_scene(churn *c) {
    const uint32_t number = pick(c, SCENES);
    if (c->scenes[number] != c->set && pick(c, 3) == 0) {
        lobe_scene_destroy(&c->scenes[number]);
        c->scenes[number] = scene_of((int)number, 1u << pick(c, 5));
    }
    if (c->scenes[number] != c->set)
        assert_int_equal(lobe_renderer_set_scene(c->renderer, c->scenes[number]), LOBE_OK);
    c->set = c->scenes[number];
}

static void change_material(churn *c) {
    for (int n = 0; n < SCENES; n++)
        if (c->scenes[n] == c->set) {
            uint32_t changed = pick(c, (uint32_t)c->set->material_count);
            lobe_material *material = &c->scenes[n]->materials[changed];
            material->roughness = (float)scenes_random_between(&c->sequence, 0.2, 1);
            material->lobes[0].width = (float)scenes_random_between(&c->sequence, 5, 50);
            float *texels = c->scenes[n]->images[changed].image.texels;
            texels[0] = (float)scenes_random_between(&c->sequence, 0.4, 0.6);
            const lobe_scene_changes changes = {.materials = &changed,
                                                .material_count = 1,
                                                .images = &changed,
                                                .image_count = pick(c, 2)};
            assert_int_equal(lobe_renderer_update_scene(c->renderer, &changes), LOBE_OK);
        }
}

static void render(churn *c, const lobe_render_parameters *parameters) {
    lobe_frame frame;
    if (lobe_renderer_render(c->renderer, parameters, &frame) != LOBE_OK)
        fail_msg("%s", c->host.recorder.last_error);
    lobe_frame_free(&frame);
}

/// Delivered, drawn into an image, submitted without waiting, or recorded into commands.
static void draw_somehow(churn *c) {
    const uint32_t size = pick(c, SIZES), how = pick(c, 4);
    const lobe_vulkan_image image = {.image = c->targets[size].image,
                                     .format = c->targets[size].format,
                                     .width = sizes[size],
                                     .height = sizes[size],
                                     .usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT};
    const lobe_render_target target = {.radiance = &image};
    lobe_vulkan_submission submission = {0};
    lobe_render_parameters parameters = {.filter = c->filters[pick(c, c->filter_count)],
                                         .width = sizes[size],
                                         .height = sizes[size],
                                         .host.frames_in_flight = 1 + pick(c, 3)};
    if (how == 0)
        (void)pick(c, 24);
    else
        parameters.host.target = &target;
    if (how > 1)
        parameters.host.submission = &submission;
    if (how > 2)
        submission.commands = host_begin(&c->host);
    render(c, &parameters);
    if (submission.commands)
        host_finish(&c->host, submission.commands);
}

static void change_and_draw(churn *c) {
    if (pick(c, 4) == 0)
        change_scene(c);
    if (pick(c, 2) == 0)
        change_material(c);
    draw_somehow(c);
}

// ---------------------------------------------------------------------------------------------
// Memory

/// Bytes of the host's memory in use.
static size_t host_bytes(void) {
    struct mallinfo2 memory = mallinfo2();
    return memory.uordblks + memory.hblkhd;
}

/// The same frames in every round: what is kept for them is created in the first.
static void go_round(churn *c) {
    c->sequence = scenes_random_start(5);
    c->set = c->scenes[0];
    assert_int_equal(lobe_renderer_set_scene(c->renderer, c->set), LOBE_OK);
    for (int n = 0; n < FRAMES; n++)
        change_and_draw(c);
    assert_int_equal(lobe_renderer_set_scene(c->renderer, NULL), LOBE_OK);
    lobe_device_memory memory;
    lobe_device_memory_query(c->device, &memory);
    assert_int_equal(memory.used_bytes, 0);
}

static void changes_are_valid(void **state) {
    (void)state;
    churn c;
    open_churn(&c, true, false);
    go_round(&c);
    close_churn(&c);
}

/// lobe's own memory is the same after each round, to the byte. The driver's varies by a kilobyte
/// and fills its pools in some rounds; a leak grows in every stretch of rounds.
static void memory_stays(void **state) {
    (void)state;
    churn c;
    ptrdiff_t bytes[ROUNDS], least_growth = PTRDIFF_MAX;
    size_t own = 0;
    open_churn(&c, false, false);
    for (int round = 0; round < ROUNDS; round++) {
        go_round(&c);
        bytes[round] = (ptrdiff_t)host_bytes();
        own = round > 0 ? own : c.counting.bytes;
        assert_int_equal(c.counting.bytes, own);
        if (round >= STRETCH && bytes[round] - bytes[round - STRETCH] < least_growth)
            least_growth = bytes[round] - bytes[round - STRETCH];
    }
    if (least_growth > 2 << 10)
        fail_msg("host memory grows by %td bytes in %d frames", least_growth, STRETCH * FRAMES);
    close_churn(&c);
}

// ---------------------------------------------------------------------------------------------
// Many frames

static uint32_t many;

/// All memory of this process, shared libraries included.
static size_t resident_bytes(void) {
    size_t pages = 0, resident = 0;
    FILE *file = fopen("/proc/self/statm", "r");
    assert_non_null(file);
    assert_int_equal(fscanf(file, "%zu %zu", &pages, &resident), 2);
    fclose(file);
    return resident * (size_t)sysconf(_SC_PAGESIZE);
}

/// Without a scene, only what the device keeps is left. Returns the host's bytes.
static ptrdiff_t report(churn *c, uint32_t drawn, time_t start) {
    lobe_device_memory memory;
    assert_int_equal(lobe_renderer_set_scene(c->renderer, NULL), LOBE_OK);
    c->set = NULL;
    lobe_device_memory_query(c->device, &memory);
    assert_int_equal(memory.used_bytes, 0);
    assert_int_equal(c->host.mistakes, 0);
    const size_t bytes = host_bytes();
    print_message("%6u frames %5ld s: device %llu bytes in use, %llu kept, at most %llu at once; "
                  "host %zu KiB, of these %zu lobe's own, resident %zu KiB\n",
                  drawn, (long)(time(NULL) - start), (unsigned long long)memory.used_bytes,
                  (unsigned long long)memory.allocated_bytes,
                  (unsigned long long)memory.peak_used_bytes, bytes >> 10, c->counting.bytes >> 10,
                  resident_bytes() >> 10);
    return (ptrdiff_t)bytes;
}

/// Shaders are created in the first quarter; after that a leak grows from quarter to quarter.
/// Returns the smallest growth.
static ptrdiff_t draw_many(churn *c) {
    const time_t start = time(NULL);
    ptrdiff_t bytes[QUARTERS + 1], least_growth = PTRDIFF_MAX;
    c->sequence = scenes_random_start(6);
    bytes[0] = report(c, 0, start);
    for (uint32_t n = 1; n <= many; n++) {
        if (!c->set)
            change_scene(c);
        change_and_draw(c);
        if (n * QUARTERS / many == (n - 1) * QUARTERS / many)
            continue;
        const uint32_t quarter = n * QUARTERS / many;
        bytes[quarter] = report(c, n, start);
        if (quarter > 1 && bytes[quarter] - bytes[quarter - 1] < least_growth)
            least_growth = bytes[quarter] - bytes[quarter - 1];
    }
    return least_growth;
}

static void many_changes_are_valid(void **state) {
    (void)state;
    churn c;
    open_churn(&c, true, true);
    draw_many(&c);
    close_churn(&c);
}

static void memory_stays_for_many(void **state) {
    (void)state;
    churn c;
    open_churn(&c, false, true);
    const ptrdiff_t growth = draw_many(&c);
    if (growth > 64 << 10)
        fail_msg("host memory grows by %td bytes in %u frames", growth, many / QUARTERS);
    close_churn(&c);
}

static int run_many(const char *frames) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(memory_stays_for_many),
        cmocka_unit_test(many_changes_are_valid),
    };
    many = (uint32_t)strtoul(frames, NULL, 10);
    if (many < QUARTERS) {
        fprintf(stderr, "test_renderer_churn [FRAMES, at least %d]\n", QUARTERS);
        return 1;
    }
    return cmocka_run_group_tests(tests, NULL, NULL);
}

int main(int count, char **arguments) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(changes_are_valid),
        cmocka_unit_test(memory_stays),
    };
    return count > 1 ? run_many(arguments[1]) : cmocka_run_group_tests(tests, NULL, NULL);
}
