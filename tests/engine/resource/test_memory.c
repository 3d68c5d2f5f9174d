#include "tests/engine/support/cmocka_all.h"

#include <string.h>

#include "engine/device/device.h"
#include "engine/resource/memory.h"
#include "tests/engine/support/log_recorder.h"

#define MEBIBYTE ((VkDeviceSize)1 << 20)
#define SLOTS    48

static log_recorder recorder;

static lobe_device *open_device(uint64_t limit) {
    lobe_device *device = NULL;
    log_recorder_start(&recorder);
    assert_int_equal(lobe_device_create(&(lobe_device_parameters){.memory_limit = limit,
                                                                  .validation = true,
                                                                  .host = &recorder.host},
                                        &device),
                     LOBE_OK);
    return device;
}

static lobe_result allocate(lobe_device *device, VkDeviceSize size, VkDeviceSize alignment,
                            engine_memory_place place, bool linear, engine_allocation *allocation) {
    return engine_memory_allocate(device->memory,
                                  &(engine_memory_request){
                                      .name = "piece",
                                      .requirements = {size, alignment, UINT32_MAX},
                                      .place = place,
                                      .linear = linear,
                                  },
                                  allocation);
}

static lobe_device_memory query(const lobe_device *device) {
    lobe_device_memory memory;
    lobe_device_memory_query(device, &memory);
    return memory;
}

static uint32_t next_random(uint32_t *seed) {
    *seed = *seed * 1664525u + 1013904223u;
    return *seed >> 8;
}

static bool overlap(const engine_allocation *first, const engine_allocation *second) {
    return first->memory == second->memory && first->offset < second->offset + second->size &&
           second->offset < first->offset + first->size;
}

static void assert_apart(const engine_allocation *pieces, size_t index) {
    for (size_t i = 0; i < SLOTS; i++)
        if (i != index && pieces[i].size)
            assert_false(overlap(&pieces[i], &pieces[index]));
}

static void random_use_never_overlaps_and_all_returns(void **state) {
    (void)state;
    lobe_device *device = open_device(0);
    engine_allocation pieces[SLOTS] = {{0}};
    uint32_t seed = 7;
    uint64_t used = 0;
    for (int step = 0; step < 4000; step++) {
        const size_t index = next_random(&seed) % SLOTS;
        engine_allocation *piece = &pieces[index];
        if (piece->size) {
            used -= piece->size;
            engine_memory_free(device->memory, piece);
            assert_null(piece->memory);
            continue;
        }
        const VkDeviceSize alignment = (VkDeviceSize)1 << next_random(&seed) % 13;
        const VkDeviceSize size = 1 + next_random(&seed) % (3 * MEBIBYTE);
        const engine_memory_place place = (engine_memory_place)(next_random(&seed) % 3);
        assert_int_equal(allocate(device, size, alignment, place, next_random(&seed) & 1, piece),
                         LOBE_OK);
        assert_int_equal(piece->offset % alignment, 0);
        assert_true((piece->mapped != NULL) == (place != ENGINE_MEMORY_DEVICE));
        assert_apart(pieces, index);
        used += size;
        assert_int_equal(query(device).used_bytes, used);
        assert_true(query(device).allocated_bytes >= used);
    }
    for (size_t i = 0; i < SLOTS; i++)
        engine_memory_free(device->memory, &pieces[i]);
    assert_int_equal(query(device).used_bytes, 0);
    assert_int_equal(query(device).allocated_bytes, 0);
    lobe_device_destroy(&device);
    assert_int_equal(recorder.errors, 0);
}

static void mapped_memory_is_the_pieces_own(void **state) {
    (void)state;
    lobe_device *device = open_device(0);
    engine_allocation first, second;
    assert_int_equal(allocate(device, 1000, 16, ENGINE_MEMORY_UPLOAD, true, &first), LOBE_OK);
    assert_int_equal(allocate(device, 1000, 16, ENGINE_MEMORY_UPLOAD, true, &second), LOBE_OK);
    memset(first.mapped, 1, 1000);
    memset(second.mapped, 2, 1000);
    assert_int_equal(((const char *)first.mapped)[999], 1);
    assert_int_equal(((const char *)second.mapped)[0], 2);
    engine_memory_free(device->memory, &first);
    engine_memory_free(device->memory, &second);
    lobe_device_destroy(&device);
}

static void buffers_and_tiled_images_share_no_page(void **state) {
    (void)state;
    lobe_device *device = open_device(0);
    const VkDeviceSize page = device->limits.bufferImageGranularity;
    engine_allocation pieces[16];
    for (size_t i = 0; i < 16; i++)
        assert_int_equal(allocate(device, 8, 8, ENGINE_MEMORY_DEVICE, i % 2 == 0, &pieces[i]),
                         LOBE_OK);
    for (size_t i = 0; i < 16; i++)
        for (size_t j = 0; j < 16; j++)
            if (i % 2 != j % 2 && pieces[i].memory == pieces[j].memory)
                assert_int_not_equal(pieces[i].offset / page, pieces[j].offset / page);
    for (size_t i = 0; i < 16; i++)
        engine_memory_free(device->memory, &pieces[i]);
    lobe_device_destroy(&device);
}

static void small_pieces_share_blocks(void **state) {
    (void)state;
    lobe_device *device = open_device(0);
    engine_allocation pieces[SLOTS];
    for (size_t i = 0; i < SLOTS; i++)
        assert_int_equal(allocate(device, 4096, 256, ENGINE_MEMORY_DEVICE, true, &pieces[i]),
                         LOBE_OK);
    for (size_t i = 1; i < SLOTS; i++)
        assert_ptr_equal(pieces[i].memory, pieces[0].memory);
    for (size_t i = 0; i < SLOTS; i++)
        engine_memory_free(device->memory, &pieces[i]);
    lobe_device_destroy(&device);
}

/// A small scene takes little, a large one few blocks.
static void blocks_grow_with_use(void **state) {
    (void)state;
    enum { PIECES = 96 };
    lobe_device *device = open_device(0);
    engine_allocation pieces[PIECES];
    assert_int_equal(allocate(device, 4096, 1, ENGINE_MEMORY_DEVICE, true, &pieces[0]), LOBE_OK);
    assert_int_equal(query(device).allocated_bytes, MEBIBYTE);
    size_t blocks = 1;
    for (size_t i = 1; i < PIECES; i++) {
        const uint64_t before = query(device).allocated_bytes;
        assert_int_equal(allocate(device, MEBIBYTE / 2, 1, ENGINE_MEMORY_DEVICE, true, &pieces[i]),
                         LOBE_OK);
        blocks += query(device).allocated_bytes > before;
    }
    assert_in_range(blocks, 5, 8);
    assert_in_range(query(device).allocated_bytes, PIECES / 2 * MEBIBYTE,
                    (PIECES / 2 + 32) * MEBIBYTE);
    for (size_t i = 0; i < PIECES; i++)
        engine_memory_free(device->memory, &pieces[i]);
    assert_int_equal(query(device).allocated_bytes, 0);
    lobe_device_destroy(&device);
}

static void peak_is_the_most_used_at_once(void **state) {
    (void)state;
    lobe_device *device = open_device(0);
    engine_allocation first, second;
    assert_int_equal(allocate(device, MEBIBYTE, 1, ENGINE_MEMORY_DEVICE, true, &first), LOBE_OK);
    assert_int_equal(allocate(device, 2 * MEBIBYTE, 1, ENGINE_MEMORY_DEVICE, true, &second),
                     LOBE_OK);
    engine_memory_free(device->memory, &first);
    assert_int_equal(query(device).peak_used_bytes, 3 * MEBIBYTE);
    lobe_device_memory_reset_peak(device);
    assert_int_equal(query(device).peak_used_bytes, 2 * MEBIBYTE);
    engine_memory_free(device->memory, &second);
    lobe_device_destroy(&device);
}

static void limit_is_kept_to_the_byte(void **state) {
    (void)state;
    const VkDeviceSize limit = 8 * MEBIBYTE;
    lobe_device *device = open_device(limit);
    assert_int_equal(query(device).budget_bytes, limit);
    engine_allocation piece, other;
    assert_int_equal(allocate(device, limit + 1, 1, ENGINE_MEMORY_DEVICE, true, &piece),
                     LOBE_ERROR_OUT_OF_DEVICE_MEMORY);
    assert_null(piece.memory);
    assert_int_equal(recorder.errors, 1);
    assert_non_null(strstr(recorder.last_error, "'piece'"));
    assert_int_equal(allocate(device, limit, 1, ENGINE_MEMORY_DEVICE, true, &piece), LOBE_OK);
    assert_int_equal(allocate(device, 1, 1, ENGINE_MEMORY_DEVICE, true, &other),
                     LOBE_ERROR_OUT_OF_DEVICE_MEMORY);
    engine_memory_free(device->memory, &piece);
    assert_int_equal(allocate(device, 1, 1, ENGINE_MEMORY_DEVICE, true, &other), LOBE_OK);
    engine_memory_free(device->memory, &other);
    lobe_device_destroy(&device);
    assert_int_equal(recorder.errors, 2);
}

static void little_memory_serves_several_kinds(void **state) {
    (void)state;
    lobe_device *device = open_device(8 * MEBIBYTE);
    engine_allocation image, upload, read_back;
    assert_int_equal(allocate(device, MEBIBYTE, 1, ENGINE_MEMORY_DEVICE, false, &image), LOBE_OK);
    assert_int_equal(allocate(device, MEBIBYTE, 1, ENGINE_MEMORY_UPLOAD, true, &upload), LOBE_OK);
    assert_int_equal(allocate(device, MEBIBYTE, 1, ENGINE_MEMORY_READ_BACK, true, &read_back),
                     LOBE_OK);
    engine_memory_free(device->memory, &image);
    engine_memory_free(device->memory, &upload);
    engine_memory_free(device->memory, &read_back);
    lobe_device_destroy(&device);
}

static void more_than_the_device_has_is_refused(void **state) {
    (void)state;
    lobe_device *device = open_device(0);
    engine_allocation piece;
    assert_int_equal(allocate(device, (VkDeviceSize)1 << 50, 1, ENGINE_MEMORY_DEVICE, true, &piece),
                     LOBE_ERROR_OUT_OF_DEVICE_MEMORY);
    assert_int_equal(recorder.errors, 1);
    assert_int_equal(query(device).allocated_bytes, 0);
    lobe_device_destroy(&device);
}

static void unknown_kind_of_memory_is_refused(void **state) {
    (void)state;
    lobe_device *device = open_device(0);
    engine_allocation piece;
    const engine_memory_request request = {.name = "piece", .requirements = {16, 1, 0}};
    assert_int_equal(engine_memory_allocate(device->memory, &request, &piece),
                     LOBE_ERROR_OUT_OF_DEVICE_MEMORY);
    assert_int_equal(recorder.errors, 1);
    lobe_device_destroy(&device);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(random_use_never_overlaps_and_all_returns),
        cmocka_unit_test(mapped_memory_is_the_pieces_own),
        cmocka_unit_test(buffers_and_tiled_images_share_no_page),
        cmocka_unit_test(small_pieces_share_blocks),
        cmocka_unit_test(blocks_grow_with_use),
        cmocka_unit_test(peak_is_the_most_used_at_once),
        cmocka_unit_test(limit_is_kept_to_the_byte),
        cmocka_unit_test(little_memory_serves_several_kinds),
        cmocka_unit_test(more_than_the_device_has_is_refused),
        cmocka_unit_test(unknown_kind_of_memory_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
