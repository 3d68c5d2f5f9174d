// The ring never hands out memory that a frame in flight reads, and takes new memory only where
// what it has is too small.

#include "tests/engine/support/cmocka_all.h"

#include <string.h>

#include "engine/device/device.h"
#include "engine/resource/staging_ring.h"
#include "tests/engine/support/counting_allocator.h"
#include "tests/engine/support/log_recorder.h"

enum { FIRST = 64 << 10 }; // the smallest ring

static log_recorder recorder;
static lobe_device *device;
static engine_staging_ring ring;

static int open_ring(void **state) {
    (void)state;
    log_recorder_start(&recorder);
    ring = (engine_staging_ring){0};
    return lobe_device_create(&(lobe_device_parameters){.validation = true, .host = &recorder.host},
                              &device) != LOBE_OK;
}

/// After every test, the validation layer has reported nothing and all memory has been freed.
static int close_ring(void **state) {
    (void)state;
    lobe_device_memory memory;
    engine_staging_ring_free(device, &ring);
    lobe_device_memory_query(device, &memory);
    const uint64_t mistakes = lobe_device_validation_count(device);
    lobe_device_destroy(&device);
    return mistakes || memory.used_bytes;
}

static engine_staged reserve(size_t size, int value) {
    engine_staged staged;
    assert_int_equal(engine_staging_ring_reserve(device, &ring, size, &staged), LOBE_OK);
    assert_int_equal(staged.offset % 16, 0);
    memset(staged.mapped, value, size);
    return staged;
}

static void assert_holds(const engine_staged *staged, size_t size, int value) {
    for (size_t i = 0; i < size; i++)
        assert_int_equal(((unsigned char *)staged->mapped)[i], value);
}

/// One frame in flight after the other: the second one's memory is not the first one's, which the
/// third one may have again.
static void frames_take_turns(void **state) {
    (void)state;
    enum { SIZE = 20000, FRAMES = 50 };
    engine_staged staged[FRAMES];
    uint64_t ends[FRAMES];
    for (int n = 0; n < FRAMES; n++) {
        if (n >= 2)
            engine_staging_ring_release(device, &ring, ends[n - 2]);
        staged[n] = reserve(SIZE, n);
        if (n >= 1)
            assert_holds(&staged[n - 1], SIZE, n - 1);
        ends[n] = engine_staging_ring_end_frame(device, &ring);
        assert_ptr_equal(staged[n].buffer, staged[0].buffer);
    }
    // It went around: more went through it than it has.
    assert_int_equal(ring.memory.size, FIRST);
}

/// Parts stay in one piece where they reach the end, and frames of any size fit behind each other.
static void parts_do_not_wrap(void **state) {
    (void)state;
    uint64_t last = 0;
    for (size_t n = 0; n < 300; n++) {
        const size_t size = 1 + n * 7919 % 21000;
        const engine_staged staged = reserve(size, (int)(n % 256));
        assert_true(staged.offset + size <= ring.memory.size);
        const uint64_t end = engine_staging_ring_end_frame(device, &ring);
        engine_staging_ring_release(device, &ring, last);
        assert_holds(&staged, size, (int)(n % 256));
        last = end;
    }
    assert_int_equal(ring.memory.size, FIRST);
}

/// Maps often have a power of two of texels: where frames end needs no second ring.
static void two_large_frames_need_twice_their_size(void **state) {
    (void)state;
    enum { SIZE = 16 * FIRST };
    uint64_t last = 0;
    for (int n = 0; n < 10; n++) {
        reserve(SIZE, n);
        const uint64_t end = engine_staging_ring_end_frame(device, &ring);
        engine_staging_ring_release(device, &ring, last);
        last = end;
    }
    assert_in_range(ring.memory.size, 2 * SIZE, 2 * SIZE + 2 * FIRST);
}

/// The former memory stays until the frames that read it are done; the larger one then suffices.
static void a_ring_that_is_too_small_grows(void **state) {
    (void)state;
    const engine_staged first = reserve(FIRST - 16, 1);
    const uint64_t one = engine_staging_ring_end_frame(device, &ring);
    const engine_staged second = reserve(FIRST, 2), third = reserve(FIRST, 3);
    assert_ptr_not_equal(second.buffer, first.buffer);
    assert_ptr_equal(third.buffer, second.buffer);
    assert_int_equal(ring.discards.count, 1);
    assert_holds(&first, FIRST - 16, 1);
    engine_staging_ring_release(device, &ring, one);
    assert_int_equal(ring.discards.count, 0);
    const uint64_t two = engine_staging_ring_end_frame(device, &ring);
    assert_holds(&second, FIRST, 2);
    engine_staging_ring_release(device, &ring, two);
    assert_ptr_equal(reserve(2 * FIRST, 4).buffer, second.buffer);
}

/// Content for the next frame that is in the former memory stays, too.
static void what_the_next_frame_reads_outlives_growth(void **state) {
    (void)state;
    const uint64_t one = engine_staging_ring_end_frame(device, &ring);
    const engine_staged first = reserve(100, 1);
    reserve(FIRST, 2);
    engine_staging_ring_release(device, &ring, one);
    assert_int_equal(ring.discards.count, 1);
    assert_holds(&first, 100, 1);
    engine_staging_ring_release(device, &ring, engine_staging_ring_end_frame(device, &ring));
    assert_int_equal(ring.discards.count, 0);
}

static void a_ring_without_frames_in_flight_starts_again(void **state) {
    (void)state;
    for (int n = 0; n < 5; n++) {
        assert_int_equal(reserve(FIRST - 16, n).offset, 0);
        engine_staging_ring_release(device, &ring, engine_staging_ring_end_frame(device, &ring));
    }
    assert_int_equal(ring.memory.size, FIRST);
}

static void memory_that_nobody_uses_goes(void **state) {
    (void)state;
    for (int used = 0; used < 2; used++) {
        reserve(100, used);
        for (int n = 0; n <= ENGINE_STAGING_UNUSED_FRAMES; n++) {
            assert_true(ring.memory.size > 0);
            engine_staging_ring_release(device, &ring,
                                        engine_staging_ring_end_frame(device, &ring));
        }
        assert_int_equal(ring.memory.size, 0);
        lobe_device_memory memory;
        lobe_device_memory_query(device, &memory);
        assert_int_equal(memory.used_bytes, 0);
    }
}

static void a_ring_that_cannot_grow_is_as_it_was(void **state) {
    (void)state;
    engine_staged staged;
    lobe_device *small = NULL;
    engine_staging_ring own = {0};
    assert_int_equal(
        lobe_device_create(
            &(lobe_device_parameters){.memory_limit = 1 << 20, .host = &recorder.host}, &small),
        LOBE_OK);
    assert_int_equal(engine_staging_ring_reserve(small, &own, 1000, &staged), LOBE_OK);
    memset(staged.mapped, 7, 1000);
    const engine_staging_ring before = own;
    engine_staged none;
    assert_int_equal(engine_staging_ring_reserve(small, &own, 64 << 20, &none),
                     LOBE_ERROR_OUT_OF_DEVICE_MEMORY);
    assert_int_equal(recorder.errors, 0); // the caller may have another way
    assert_memory_equal(&own, &before, sizeof own);
    assert_holds(&staged, 1000, 7);
    assert_int_equal(engine_staging_ring_reserve(small, &own, 1000, &none), LOBE_OK);
    assert_int_equal(none.offset, 1008);
    engine_staging_ring_free(small, &own);
    lobe_device_destroy(&small);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(frames_take_turns, open_ring, close_ring),
        cmocka_unit_test_setup_teardown(parts_do_not_wrap, open_ring, close_ring),
        cmocka_unit_test_setup_teardown(two_large_frames_need_twice_their_size, open_ring,
                                        close_ring),
        cmocka_unit_test_setup_teardown(a_ring_that_is_too_small_grows, open_ring, close_ring),
        cmocka_unit_test_setup_teardown(what_the_next_frame_reads_outlives_growth, open_ring,
                                        close_ring),
        cmocka_unit_test_setup_teardown(a_ring_without_frames_in_flight_starts_again, open_ring,
                                        close_ring),
        cmocka_unit_test_setup_teardown(memory_that_nobody_uses_goes, open_ring, close_ring),
        cmocka_unit_test_setup_teardown(a_ring_that_cannot_grow_is_as_it_was, open_ring,
                                        close_ring),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
