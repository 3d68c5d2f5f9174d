// A host whose shader changes the maps of six materials in every frame, two of them with colours
// that begin and cease to go with normals, with 1,000 instances and
// two frames in flight: lobe submits once a frame, waits for nothing, and its memory stays.
// `test_host_moving_host FRAMES` draws that many frames and prints the memory that they take
// (`ninja churn`: 10 000).

#include "tests/passes/host/moving_host.h"

#include <malloc.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "tests/engine/support/vulkan_faults.h"
#include "tests/long_runs.h"

enum { WIDTH = 40, HEIGHT = 25 };

static uint32_t frames;

static float phase_of(uint32_t frame) {
    return 0.1f * (float)(frame % 64);
}

/// How often lobe waited for the device.
static int waits(void) {
    return vulkan_calls("vkWaitSemaphores") + vulkan_calls("vkDeviceWaitIdle") +
           vulkan_calls("vkQueueWaitIdle");
}

static void draw(moving_host *m, uint32_t count) {
    for (uint32_t i = 0; i < count; i++) {
        m->colours = i % 3 > 0;
        moving_host_draw(m, phase_of(i));
    }
}

// ---------------------------------------------------------------------------------------------
// Submissions

static void frames_are_submitted_once_and_waited_for_never(void **state) {
    (void)state;
    moving_host m;
    moving_host_open(&m, "moments", true);
    moving_host_resize(&m, WIDTH, HEIGHT);
    draw(&m, 4);
    const int waited = waits(), submitted = vulkan_calls("vkQueueSubmit2");
    const int alive = faults.alive;
    faults.made = faults.pipelines = 0;
    draw(&m, 20);
    assert_int_equal(vulkan_calls("vkQueueSubmit2") - submitted, 20);
    assert_int_equal(waits() - waited, 0);
    assert_int_equal(faults.pipelines, 0);
    // Views of the host's images, which it may replace at any time: of colours two, as passes that
    // filter images read layers.
    assert_int_equal(faults.made, 20 * (MOVING_MAPS + MOVING_COLOURS + 1));
    assert_int_equal(faults.alive, alive);
    for (int i = 0; i < 2; i++) {
        moving_host_resize(&m, WIDTH + 20 - 30 * (uint32_t)i, HEIGHT + 5);
        const int before = waits();
        draw(&m, 6);
        assert_int_equal(waits() - before, 0);
    }
    assert_int_equal(m.host.mistakes, 0);
    moving_host_close(&m);
}

// ---------------------------------------------------------------------------------------------
// Pictures

static double relative_difference(const float *a, const float *b, size_t count) {
    double square = 0, sum = 0;
    for (size_t i = 0; i < count; i++) {
        square += ((double)a[i] - b[i]) * ((double)a[i] - b[i]);
        sum += (double)b[i] * b[i];
    }
    assert_true(sum > 0);
    return square / sum;
}

static lobe_settings settings_with(const lobe_filter *filter, const char *assignment) {
    lobe_settings settings;
    lobe_settings_default(filter, &settings);
    if (assignment)
        assert_int_equal(lobe_settings_set(filter, &settings, assignment, NULL), LOBE_OK);
    return settings;
}

/// Each picture shows the maps of its own frame, whatever was drawn before, where bins do not
/// follow those of earlier frames.
static void pictures_show_the_maps_of_their_frame(void **state) {
    static const struct {
        const char *filter, *assignment;
        float colours;
    } ways[] = {{"moments", "refit=anew", 0}, {"leadr", NULL, 1}};
    const size_t count = (size_t)WIDTH * HEIGHT * 4;
    (void)state;
    for (size_t n = 0; n < sizeof ways / sizeof *ways; n++) {
        moving_host moving, fresh;
        moving_host_open(&moving, ways[n].filter, false);
        const lobe_settings settings = settings_with(moving.filter, ways[n].assignment);
        moving.settings = &settings;
        moving_host_resize(&moving, WIDTH, HEIGHT);
        draw(&moving, 5);
        float *before = moving_host_picture(&moving);
        moving.colours = ways[n].colours;
        moving_host_draw(&moving, 2.5f);
        float *picture = moving_host_picture(&moving);
        moving_host_close(&moving);
        moving_host_open(&fresh, ways[n].filter, false);
        fresh.settings = &settings;
        moving_host_resize(&fresh, WIDTH, HEIGHT);
        fresh.colours = ways[n].colours;
        moving_host_draw(&fresh, 2.5f);
        float *expected = moving_host_picture(&fresh);
        moving_host_close(&fresh);
        assert_memory_equal(picture, expected, count * sizeof *picture);
        assert_true(relative_difference(before, expected, count) > 1e-3);
        free(before);
        free(picture);
        free(expected);
    }
}

enum { STEPS = 32 };

/// Draws slow ripples while colours begin to go with them: how much each picture differs from the
/// one before. Returns a digest of all.
static uint64_t draw_slowly(double differences[STEPS]) {
    const size_t count = (size_t)WIDTH * HEIGHT * 4;
    uint64_t digest = 0;
    moving_host m;
    moving_host_open(&m, "moments", false);
    moving_host_resize(&m, WIDTH, HEIGHT);
    float *before = NULL;
    for (int i = 0; i <= STEPS; i++) {
        m.colours = (float)i / STEPS;
        moving_host_draw(&m, 1 + 0.01f * (float)i);
        float *picture = moving_host_picture(&m);
        for (size_t k = 0; k < count; k++) {
            uint32_t bits;
            memcpy(&bits, &picture[k], sizeof bits);
            digest = (digest ^ bits) * 1099511628211U; // FNV-1a
        }
        if (before)
            differences[i - 1] = sqrt(relative_difference(picture, before, count));
        free(before);
        before = picture;
    }
    free(before);
    moving_host_close(&m);
    return digest;
}

/// Neither where the map of colours and normals begins to be made, nor where another fit of bins
/// would be the better one (fits of each frame's own make three pictures of which the most differs
/// by seven times as much as most do).
static void slow_changes_do_not_pop(void **state) {
    double differences[STEPS], again[STEPS], mean = 0;
    (void)state;
    const uint64_t digest = draw_slowly(differences);
    for (int i = 0; i < STEPS; i++)
        mean += differences[i] / STEPS;
    assert_true(mean > 1e-4);
    for (int i = 0; i < STEPS; i++)
        if (!(differences[i] < 2 * mean))
            fail_msg("picture %d differs by %g, others by %g", i + 1, differences[i], mean);
    assert_true(draw_slowly(again) == digest);
}

// ---------------------------------------------------------------------------------------------
// Memory

typedef struct memory_use {
    uint64_t used, allocated; ///< on the device
    size_t own, host;         ///< lobe's on the host, and all
} memory_use;

static memory_use memory_of(moving_host *m) {
    lobe_device_memory memory;
    moving_host_finish(m);
    lobe_device_memory_query(m->device, &memory);
    const struct mallinfo2 host = mallinfo2();
    return (memory_use){memory.used_bytes, memory.allocated_bytes, m->counting.bytes,
                        host.uordblks + host.hblkhd};
}

/// Three sizes in turn, the first one again at the end. The driver's memory varies by some
/// kilobytes.
static void memory_stays(void **state) {
    const uint32_t third = frames / 3;
    moving_host m;
    (void)state;
    moving_host_open(&m, "moments", false);
    moving_host_resize(&m, WIDTH, HEIGHT);
    draw(&m, third / 2);
    const memory_use first = memory_of(&m);
    draw(&m, third - third / 2);
    const memory_use second = memory_of(&m);
    moving_host_resize(&m, 2 * WIDTH, 2 * HEIGHT);
    draw(&m, third);
    moving_host_resize(&m, WIDTH, HEIGHT);
    draw(&m, third);
    const memory_use last = memory_of(&m);
    print_message("# %u frames: device %llu bytes in use, %llu allocated; lobe's own %zu; "
                  "host %zu, %zu, %zu KiB\n",
                  3 * third, (unsigned long long)last.used, (unsigned long long)last.allocated,
                  last.own, first.host >> 10, second.host >> 10, last.host >> 10);
    assert_int_equal(second.used, first.used);
    assert_int_equal(second.allocated, first.allocated);
    assert_int_equal(second.own, first.own);
    assert_int_equal(last.used, first.used);
    assert_int_equal(last.own, first.own);
    if (last.host > second.host + (256 << 10))
        fail_msg("host memory grows by %zu bytes", last.host - second.host);
    moving_host_close(&m);
}

int main(int count, char **arguments) {
    frames = long_runs() ? 300 : 60;
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(memory_stays),
        cmocka_unit_test(frames_are_submitted_once_and_waited_for_never),
        cmocka_unit_test(pictures_show_the_maps_of_their_frame),
        cmocka_unit_test(slow_changes_do_not_pop),
    };
    const struct CMUnitTest many[] = {cmocka_unit_test(memory_stays)};
    if (count > 1) {
        frames = (uint32_t)strtoul(arguments[1], NULL, 10);
        if (frames < 6) {
            fprintf(stderr, "test_host_moving_host [FRAMES, at least 6]\n");
            return 1;
        }
        return cmocka_run_group_tests(many, NULL, NULL);
    }
    return cmocka_run_group_tests(tests, NULL, NULL);
}
