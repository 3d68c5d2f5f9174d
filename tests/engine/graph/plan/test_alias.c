#include "tests/engine/support/cmocka_all.h"

#include "engine/graph/plan/alias.h"

static uint32_t next_random(uint32_t *seed) {
    *seed = *seed * 1664525u + 1013904223u;
    return *seed >> 8;
}

static void assert_sound(const engine_alias_request *requests, size_t count, uint64_t shared,
                         uint64_t separate) {
    assert_true(shared <= separate);
    for (size_t i = 0; i < count; i++) {
        const engine_alias_request *a = &requests[i];
        assert_int_equal(a->offset % a->alignment, 0);
        assert_true(a->offset + a->size <= shared);
        for (size_t j = 0; j < i; j++) {
            const engine_alias_request *b = &requests[j];
            bool together = a->first <= b->last && b->first <= a->last;
            bool overlap = a->offset < b->offset + b->size && b->offset < a->offset + a->size;
            assert_false(together && overlap);
        }
    }
}

/// The block is never smaller than the bytes alive at one position.
static uint64_t largest_sum(const engine_alias_request *requests, size_t count,
                            uint32_t positions) {
    uint64_t largest = 0;
    for (uint32_t position = 0; position < positions; position++) {
        uint64_t sum = 0;
        for (size_t i = 0; i < count; i++)
            if (requests[i].first <= position && position <= requests[i].last)
                sum += requests[i].size;
        largest = sum > largest ? sum : largest;
    }
    return largest;
}

static void random_requests_never_overlap(void **state) {
    (void)state;
    engine_alias_request requests[60];
    uint64_t shared, separate;
    uint32_t seed = 12;
    for (int round = 0; round < 300; round++) {
        size_t count = next_random(&seed) % 60;
        for (size_t i = 0; i < count; i++) {
            uint32_t first = next_random(&seed) % 40;
            requests[i] = (engine_alias_request){.size = 1 + next_random(&seed) % 100000,
                                                 .alignment = 1u << next_random(&seed) % 17,
                                                 .first = first,
                                                 .last = first + next_random(&seed) % 8};
        }
        assert_true(engine_alias_plan(NULL, requests, count, &shared, &separate));
        assert_sound(requests, count, shared, separate);
        assert_true(shared >= largest_sum(requests, count, 48));
    }
}

static void a_chain_needs_two_places(void **state) {
    (void)state;
    engine_alias_request requests[10];
    uint64_t shared, separate;
    for (uint32_t i = 0; i < 10; i++)
        requests[i] =
            (engine_alias_request){.size = 1000, .alignment = 256, .first = i, .last = i + 1};
    assert_true(engine_alias_plan(NULL, requests, 10, &shared, &separate));
    assert_sound(requests, 10, shared, separate);
    assert_int_equal(shared, 1024 + 1000);
    assert_int_equal(separate, 9 * 1024 + 1000);
}

static void all_alive_at_once_share_nothing(void **state) {
    (void)state;
    engine_alias_request requests[] = {
        {.size = 100, .alignment = 1, .last = 5},
        {.size = 300, .alignment = 64, .last = 5},
        {.size = 200, .alignment = 16, .last = 5},
    };
    uint64_t shared, separate;
    assert_true(engine_alias_plan(NULL, requests, 3, &shared, &separate));
    assert_sound(requests, 3, shared, separate);
    assert_int_equal(shared, separate);
    assert_int_equal(shared, 604); // 300, padded to 304, 200, 100
}

static void nothing_needs_nothing(void **state) {
    (void)state;
    uint64_t shared = 1, separate = 1;
    assert_true(engine_alias_plan(NULL, NULL, 0, &shared, &separate));
    assert_int_equal(shared, 0);
    assert_int_equal(separate, 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(random_requests_never_overlap),
        cmocka_unit_test(a_chain_needs_two_places),
        cmocka_unit_test(all_alive_at_once_share_nothing),
        cmocka_unit_test(nothing_needs_nothing),
    };
    return cmocka_run_group_tests_name("graph_alias", tests, NULL, NULL);
}
