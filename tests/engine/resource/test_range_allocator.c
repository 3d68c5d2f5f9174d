#include "tests/engine/support/cmocka_all.h"

#include <stdbool.h>
#include <string.h>

#include "engine/resource/range_allocator.h"

#define SIZE     4096u
#define REQUESTS 64

static uint32_t next_random(uint32_t *seed) {
    *seed = *seed * 1664525u + 1013904223u;
    return *seed >> 8;
}

static void whole_size_can_be_taken_and_given_back(void **state) {
    (void)state;
    engine_range_allocator allocator;
    uint64_t offset;
    assert_true(engine_range_allocator_create(NULL, SIZE, &allocator));
    assert_true(engine_range_allocate(&allocator, SIZE, 1, &offset));
    assert_int_equal(offset, 0);
    assert_false(engine_range_allocate(&allocator, 1, 1, &offset));
    engine_range_free(&allocator, 0, SIZE);
    assert_true(engine_range_allocate(&allocator, SIZE, SIZE, &offset));
    engine_range_allocator_destroy(&allocator);
}

static void more_than_there_is_is_refused(void **state) {
    (void)state;
    engine_range_allocator allocator;
    uint64_t offset;
    assert_true(engine_range_allocator_create(NULL, SIZE, &allocator));
    assert_false(engine_range_allocate(&allocator, SIZE + 1, 1, &offset));
    assert_false(engine_range_allocate(&allocator, UINT64_MAX, 1, &offset));
    assert_true(engine_range_allocate(&allocator, 1, 1, &offset));
    // 4095 bytes are free, but none of them at a multiple of 4096.
    assert_false(engine_range_allocate(&allocator, 1, SIZE, &offset));
    assert_int_equal(allocator.taken_count, 1);
    engine_range_allocator_destroy(&allocator);
}

static void tightest_gap_is_used(void **state) {
    (void)state;
    engine_range_allocator allocator;
    uint64_t offset[5], found;
    assert_true(engine_range_allocator_create(NULL, SIZE, &allocator));
    const uint64_t sizes[] = {256, 64, 128, 64, 512};
    for (size_t i = 0; i < 5; i++)
        assert_true(engine_range_allocate(&allocator, sizes[i], 1, &offset[i]));
    engine_range_free(&allocator, offset[0], sizes[0]);
    engine_range_free(&allocator, offset[2], sizes[2]);
    assert_true(engine_range_allocate(&allocator, 100, 1, &found));
    assert_int_equal(found, offset[2]);
    engine_range_allocator_destroy(&allocator);
}

static void neighbours_are_joined(void **state) {
    (void)state;
    // Freeing three neighbours in any order leaves one range.
    static const int orders[6][3] = {{0, 1, 2}, {0, 2, 1}, {1, 0, 2},
                                     {1, 2, 0}, {2, 0, 1}, {2, 1, 0}};
    for (size_t order = 0; order < 6; order++) {
        engine_range_allocator allocator;
        uint64_t offset[3];
        assert_true(engine_range_allocator_create(NULL, 300, &allocator));
        for (size_t i = 0; i < 3; i++)
            assert_true(engine_range_allocate(&allocator, 100, 1, &offset[i]));
        for (size_t i = 0; i < 3; i++)
            engine_range_free(&allocator, offset[orders[order][i]], 100);
        assert_int_equal(allocator.free_count, 1);
        assert_int_equal(allocator.free[0].size, 300);
        engine_range_allocator_destroy(&allocator);
    }
}

static void many_gaps_need_no_memory_when_given_back(void **state) {
    (void)state;
    engine_range_allocator allocator;
    uint64_t offset;
    assert_true(engine_range_allocator_create(NULL, SIZE, &allocator));
    for (uint64_t i = 0; i < SIZE; i++)
        assert_true(engine_range_allocate(&allocator, 1, 1, &offset));
    const engine_range *before = allocator.free;
    for (uint64_t i = 0; i < SIZE; i += 2)
        engine_range_free(&allocator, i, 1);
    assert_int_equal(allocator.free_count, SIZE / 2);
    assert_ptr_equal(allocator.free, before);
    for (uint64_t i = 1; i < SIZE; i += 2)
        engine_range_free(&allocator, i, 1);
    assert_int_equal(allocator.free_count, 1);
    engine_range_allocator_destroy(&allocator);
}

typedef struct taken {
    uint64_t offset, size;
} taken;

static void claim(bool used[SIZE], taken range, bool value) {
    for (uint64_t i = range.offset; i < range.offset + range.size; i++) {
        assert_int_equal(used[i], !value);
        used[i] = value;
    }
}

static void random_use_never_overlaps_and_is_fully_returned(void **state) {
    (void)state;
    engine_range_allocator allocator;
    bool used[SIZE] = {false};
    taken live[REQUESTS] = {{0}};
    uint32_t seed = 1;
    size_t served = 0;
    assert_true(engine_range_allocator_create(NULL, SIZE, &allocator));
    for (int step = 0; step < 20000; step++) {
        taken *slot = &live[next_random(&seed) % REQUESTS];
        if (slot->size) {
            claim(used, *slot, false);
            engine_range_free(&allocator, slot->offset, slot->size);
            *slot = (taken){0};
            continue;
        }
        const uint64_t alignment = 1ull << next_random(&seed) % 8;
        taken range = {.size = 1 + next_random(&seed) % 200};
        if (!engine_range_allocate(&allocator, range.size, alignment, &range.offset))
            continue;
        served++;
        assert_int_equal(range.offset % alignment, 0);
        assert_true(range.offset + range.size <= SIZE);
        claim(used, range, true);
        *slot = range;
    }
    assert_true(served > 5000);
    for (size_t i = 0; i < REQUESTS; i++)
        if (live[i].size)
            engine_range_free(&allocator, live[i].offset, live[i].size);
    assert_int_equal(allocator.taken_count, 0);
    assert_int_equal(allocator.free_count, 1);
    assert_int_equal(allocator.free[0].size, SIZE);
    engine_range_allocator_destroy(&allocator);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(whole_size_can_be_taken_and_given_back),
        cmocka_unit_test(more_than_there_is_is_refused),
        cmocka_unit_test(tightest_gap_is_used),
        cmocka_unit_test(neighbours_are_joined),
        cmocka_unit_test(many_gaps_need_no_memory_when_given_back),
        cmocka_unit_test(random_use_never_overlaps_and_is_fully_returned),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
