// Maps of reliefs that are made in windows, kept on disk as a file of each window's tile: what
// several processes make, or what was interrupted, becomes what one process makes, bit for bit.

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <lobe/file.h>

#include "passes/context/fit_work.h"
#include "passes/filters/displaced/kept_transfer.h"
#include "tests/engine/support/counting_allocator.h"
#include "tests/engine/support/log_recorder.h"
#include "tests/engine/support/temporary_folder.h"
#include "tests/passes/filters/displaced/relief_windows.h"

enum { TILES = 4, TILE_PARTS = 3, FACETS = WINDOWS_FACETS(64) };

/// A process with its own log.
typedef struct process {
    relief_windows windows;
    log_recorder recorder;
    void *slot;
    fit_work work; ///< of the last frame
    uint64_t free_bytes;
    transfer_map map;
    size_t transfers; ///< windows whose facets were looked at
    size_t restored;  ///< images of tiles that were put into the map
} process;

static void start(fixture *f, bool coloured, process *process) {
    *process = (struct process){.free_bytes = UINT64_MAX};
    relief_windows_begin(&process->windows, f, coloured, FACETS);
    log_recorder_start(&process->recorder);
    process->windows.run.context.host = &process->recorder.host;
    process->windows.run.context.work = &process->work;
}

static void stop(process *process) {
    if (process->slot)
        passes_kept_forget(process->slot);
    relief_windows_end(&process->windows);
    assert_int_equal(process->recorder.errors, 0);
}

/// Declares a frame. Whether it has the map.
static bool declare(process *process, fit_work work) {
    const filter_context *context = &process->windows.run.context;
    const transfer_kind *kind = &process->windows.kind;
    relief relief;
    process->work = work;
    process->work.most_texels = 16384;
    process->work.free_bytes = process->free_bytes;
    assert_int_equal(passes_kept_transfer_prepare(context, 0, kind, &process->slot), LOBE_OK);
    return passes_kept_transfer_build(context, 0, kind, process->slot, false, &process->map,
                                      &relief);
}

static size_t count_run(const process *process, const char *pass) {
    return count_passes(process->windows.run.context.graph, pass, LOBE_PASS_RUN);
}

/// What comes after the execution of a frame, and the next one's beginning.
static void save(process *process) {
    lobe_graph *graph = process->windows.run.context.graph;
    process->transfers += count_run(process, "facet_transfer");
    process->restored += count_run(process, "map_restoring");
    if (process->slot)
        passes_kept_save(process->slot, graph, process->work.cache, &process->recorder.host);
    lobe_graph_begin(graph);
}

static fit_work work_of(uint32_t parts, uint32_t share, uint32_t shares) {
    return (fit_work){.parts = parts,
                      .cache = test_folder.path,
                      .saves = true,
                      .draws_nothing = shares > 0,
                      .share = share,
                      .shares = shares};
}

/// Makes files, part by part.
static void fit(process *process, fit_work work, uint32_t parts) {
    for (uint32_t left = parts; left-- > 0;) {
        assert_false(declare(process, work));
        assert_int_equal(process->work.parts_left, left);
        pass_run_execute(&process->windows.run);
        save(process);
    }
    assert_false(declare(process, work));
    pass_run_execute(&process->windows.run);
    assert_int_equal(count_run(process, NULL), 0);
    save(process);
}

/// Draws, all at once, and returns what the map has.
static float *draw(process *process, const char *folder) {
    fit_work work = work_of(UINT32_MAX, 0, 0);
    work.cache = folder;
    assert_true(declare(process, work));
    lobe_graph_output(process->windows.run.context.graph, process->map.closure);
    float *numbers = relief_windows_read(&process->windows, &process->map);
    save(process);
    return numbers;
}

/// What one window makes.
static float *draw_whole(fixture *f, bool coloured) {
    process whole;
    start(f, coloured, &whole);
    whole.windows.kind.most_facets = 0;
    float *numbers = draw(&whole, NULL);
    stop(&whole);
    return numbers;
}

static void check_numbers(const process *process, float *found, const float *expected) {
    assert_memory_equal(found, expected, relief_windows_count(&process->map) * sizeof *found);
    free(found);
}

/// Draws with what the folder has, of which so many tiles are made.
static void check_drawn(fixture *f, bool coloured, const float *expected, size_t made,
                        int notices) {
    process process;
    start(f, coloured, &process);
    float *found = draw(&process, test_folder.path);
    check_numbers(&process, found, expected);
    assert_int_equal(process.transfers, made);
    assert_int_equal(process.recorder.notices, notices);
    assert_int_equal(process.recorder.warnings, 0);
    assert_int_equal(temporary_folder_count(&test_folder), TILES);
    // What was loaded stays.
    check_numbers(&process, draw(&process, NULL), expected);
    assert_int_equal(count_run(&process, NULL), 0);
    stop(&process);
}

/// While a picture is drawn part by part, each tile is saved when it is made.
static void tiles_are_saved_one_by_one(void **state) {
    for (int coloured = 0; coloured < 2; coloured++) {
        float *expected = draw_whole(*state, coloured);
        process process;
        start(*state, coloured, &process);
        for (uint32_t done = 1; done < TILES * TILE_PARTS; done++) {
            assert_false(declare(&process, work_of(1, 0, 0)));
            pass_run_execute(&process.windows.run);
            save(&process);
            assert_int_equal(temporary_folder_count(&test_folder), done / TILE_PARTS);
        }
        assert_true(declare(&process, work_of(1, 0, 0)));
        check_numbers(&process, relief_windows_read(&process.windows, &process.map), expected);
        save(&process);
        assert_int_equal(process.transfers, TILES);
        stop(&process);
        check_drawn(*state, coloured, expected, 0, 0);
        test_folder_teardown(NULL);
        test_folder_setup(NULL);
        free(expected);
    }
}

/// Where nothing is drawn, no image of the whole map is made, and the work may be shared.
static void shares_consist_of_tiles(void **state) {
    float *expected = draw_whole(*state, false);
    process process;
    for (uint32_t share = 3; share > 0; share--) {
        const uint32_t tiles = share == 1 ? 2 : 1; // the first and the fourth
        for (int again = 0; again < 2; again++) {
            start(*state, false, &process);
            fit(&process, work_of(1, share, 3), again ? 0 : tiles * TILE_PARTS);
            assert_int_equal(process.work.outcome.made, !again);
            assert_int_equal(process.work.outcome.found, again);
            assert_int_equal(process.transfers, again ? 0 : tiles);
            stop(&process);
        }
        if (share == 1)
            continue;
        start(*state, false, &process);
        fixture_forget_messages(*state);
        (void)declare(&process, work_of(1, 0, 3));
        assert_failure(*state, lobe_graph_execute(process.windows.run.context.graph),
                       LOBE_ERROR_NOT_FOUND, "-tile-1-of-4: part 1 of 3");
        stop(&process);
    }
    start(*state, false, &process);
    fit(&process, work_of(1, 0, 3), 0);
    assert_int_equal(process.work.outcome.found, 1);
    stop(&process);
    start(*state, false, &process); // there are more shares than tiles
    assert_false(declare(&process, work_of(1, TILES + 1, TILES + 1)));
    assert_null(process.slot);
    stop(&process);
    check_drawn(*state, false, expected, 0, 0);
    free(expected);
}

static void shares_take_no_map(void **state) {
    uint64_t bytes[2];
    for (int alone = 0; alone < 2; alone++) {
        process process;
        start(*state, false, &process);
        fit_work work = work_of(TILE_PARTS, 0, 0);
        work.draws_nothing = alone;
        (void)declare(&process, work);
        pass_run_execute(&process.windows.run);
        bytes[alone] = lobe_graph_describe(process.windows.run.context.graph)->retained_bytes;
        assert_int_equal(count_run(&process, "cell_transfer"), 1);
        assert_int_equal(count_run(&process, "map_cutting"), alone ? 0 : 2);
        save(&process);
        assert_int_equal(temporary_folder_count(&test_folder), 1);
        stop(&process);
        test_folder_teardown(NULL);
        test_folder_setup(NULL);
    }
    assert_true(bytes[1] + WINDOWS_WIDTH / 2 * WINDOWS_HEIGHT / 2 * 20 * 16 < bytes[0]);
}

/// What was saved without drawing is not made again to be drawn, by the same renderer either.
static void what_was_saved_is_drawn(void **state) {
    float *expected = draw_whole(*state, false);
    process process;
    start(*state, false, &process);
    fit_work work = work_of(1, 0, 0);
    work.draws_nothing = true;
    fit(&process, work, TILES * TILE_PARTS);
    float *found = draw(&process, test_folder.path);
    check_numbers(&process, found, expected);
    assert_int_equal(process.transfers, TILES);
    stop(&process);
    free(expected);
}

/// The path of a tile's file, counted from 1 on.
static const char *tile_path(unsigned tile) {
    char ending[64];
    snprintf(ending, sizeof ending, ".relief-tile-%u-of-4", tile);
    return temporary_folder_find(&test_folder, ending);
}

typedef struct tile_file {
    uint8_t *data;
    size_t size;
} tile_file;

static tile_file read_tile(unsigned tile) {
    tile_file file;
    assert_int_equal(lobe_file_read(tile_path(tile), NULL, NULL, &file.data, &file.size), LOBE_OK);
    return file;
}

static void write_tile(unsigned tile, const tile_file *file, size_t size) {
    assert_int_equal(lobe_file_write(tile_path(tile), file->data, size, NULL), LOBE_OK);
}

/// What is missing, cut off, changed, or another tile under a wrong name is made again, and nothing
/// else.
static void bad_tiles_are_replaced(void **state) {
    float *expected = draw_whole(*state, false);
    process process;
    start(*state, false, &process);
    fit(&process, work_of(1, 1, 1), TILES * TILE_PARTS);
    stop(&process);
    tile_file files[TILES];
    for (unsigned i = 0; i < TILES; i++)
        files[i] = read_tile(i + 1);
    assert_int_equal(remove(tile_path(1)), 0);
    check_drawn(*state, false, expected, 1, 0);
    write_tile(2, &files[1], files[1].size - 100);
    check_drawn(*state, false, expected, 1, 1);
    write_tile(3, &files[0], files[0].size);
    write_tile(4, &files[1], files[1].size);
    check_drawn(*state, false, expected, 2, 2);
    for (unsigned i = 0; i < TILES; i++) {
        tile_file again = read_tile(i + 1);
        assert_int_equal(again.size, files[i].size);
        assert_memory_equal(again.data, files[i].data, again.size);
        lobe_release(again.data);
        lobe_release(files[i].data);
    }
    free(expected);
}

static kept_layout tile_layout(const process *process, unsigned tile) {
    const device_material *material = &process->windows.run.context.scene->materials[0];
    return passes_transfer_tile(material, &process->windows.kind, tile - 1).layout;
}

/// Puts other functions of directions into a tile's file.
static void forge(process *process, unsigned tile) {
    const kept_layout layout = tile_layout(process, tile);
    const uint64_t key = strtoull(strrchr(tile_path(tile), '/') + 1, NULL, 16);
    kept_content content;
    assert_true(passes_kept_file_load(test_folder.path, key, &layout, NULL, &content));
    float *functions = (float *)content.buffers[0];
    functions[0] *= 1.0001f;
    const void *images[] = {content.rows[0].texels, content.rows[1].texels};
    assert_true(
        passes_kept_file_save(test_folder.path, key, &layout, images, content.buffers, NULL));
    passes_kept_content_free(&content);
}

/// Tiles that do not fit together are not put together.
static void tiles_of_another_device_are_replaced(void **state) {
    float *expected = draw_whole(*state, false);
    process process;
    start(*state, false, &process);
    fit(&process, work_of(1, 1, 1), TILES * TILE_PARTS);
    forge(&process, 3);
    stop(&process);
    start(*state, false, &process);
    fixture_forget_messages(*state);
    (void)declare(&process, work_of(1, 0, 2));
    assert_failure(*state, lobe_graph_execute(process.windows.run.context.graph),
                   LOBE_ERROR_NOT_FOUND, "-tile-3-of-4: part 1 of 2");
    stop(&process);
    check_drawn(*state, false, expected, 1, 1);
    free(expected);
}

static void check_loaded(fixture *f, uint64_t free_bytes, size_t loaded, const float *expected) {
    process process;
    start(f, false, &process);
    process.free_bytes = free_bytes;
    float *found = draw(&process, test_folder.path);
    check_numbers(&process, found, expected);
    assert_int_equal(process.transfers, TILES - loaded);
    assert_int_equal(process.recorder.notices, loaded < TILES);
    assert_int_equal(process.recorder.warnings, 0);
    assert_int_equal(temporary_folder_count(&test_folder), TILES);
    check_numbers(&process, draw(&process, test_folder.path), expected);
    assert_int_equal(count_run(&process, NULL), 0);
    assert_int_equal(process.work.outcome.unsaved, 0);
    stop(&process);
}

/// As many are loaded as the device has memory for beside what it needs; the others are made again.
static void tiles_are_loaded_beside_the_map(void **state) {
    float *expected = draw_whole(*state, false);
    process process;
    start(*state, false, &process);
    fit(&process, work_of(1, 1, 1), TILES * TILE_PARTS);
    const device_material *material = &process.windows.run.context.scene->materials[0];
    const transfer_kind *kind = &process.windows.kind;
    const kept_tile tile = passes_transfer_tile(material, kind, 0);
    const uint64_t tile_bytes = passes_kept_bytes(&tile.layout),
                   map = passes_transfer_bytes(material, kind),
                   making = passes_transfer_making_bytes(material, kind);
    stop(&process);
    check_loaded(*state, map + TILES * tile_bytes, TILES, expected);
    assert_true(making + tile_bytes < TILES * tile_bytes);
    check_loaded(*state, map + making + tile_bytes, 1, expected);
    check_loaded(*state, map, 0, expected);
    assert_int_equal(remove(tile_path(4)), 0);
    check_loaded(*state, map + making + 2 * tile_bytes, 2, expected);
    free(expected);
}

static uint64_t used_bytes(const fixture *f) {
    lobe_device_memory memory;
    lobe_device_memory_query(f->device, &memory);
    return memory.used_bytes;
}

/// A frame that declares nothing of the relief, whose map is then lost.
static void draw_something_else(process *process) {
    pass_run_execute(&process->windows.run);
    save(process);
}

static void check_again(process *process, const char *folder, const float *expected,
                        size_t restored) {
    check_numbers(process, draw(process, folder), expected);
    assert_int_equal(process->restored, restored);
    assert_int_equal(process->work.outcome.unsaved, 0);
    process->restored = 0;
}

/// What was loaded takes no memory once it is part of the map, and is loaded again if that is lost.
static void tiles_are_freed_when_they_are_placed(void **state) {
    float *expected = draw_whole(*state, false);
    process process;
    start(*state, false, &process);
    fit(&process, work_of(1, 1, 1), TILES * TILE_PARTS);
    stop(&process);
    start(*state, false, &process);
    fit_work work = work_of(UINT32_MAX, 0, 0);
    assert_true(declare(&process, work)); // but not drawn, so that nothing is placed
    pass_run_execute(&process.windows.run);
    assert_int_equal(count_run(&process, NULL), 0);
    save(&process);
    const uint64_t loaded = used_bytes(*state);
    check_again(&process, test_folder.path, expected, 2 * TILES);
    const lobe_graph_report *report = lobe_graph_describe(process.windows.run.context.graph);
    const kept_layout layout = tile_layout(&process, 1);
    const uint64_t tile_bytes = passes_kept_bytes(&layout);
    assert_true(used_bytes(*state) + TILES * tile_bytes <= loaded + report->retained_bytes);
    check_again(&process, test_folder.path, expected, 0);
    draw_something_else(&process);
    check_again(&process, test_folder.path, expected, 2 * TILES);
    draw_something_else(&process);
    assert_int_equal(remove(tile_path(2)), 0);
    check_again(&process, test_folder.path, expected, 2 * (TILES - 1));
    assert_int_equal(process.transfers, 1);
    draw_something_else(&process);
    check_again(&process, NULL, expected, 0);
    assert_int_equal(process.transfers, 1 + TILES);
    stop(&process);
    free(expected);
}

/// One warning, and the map is drawn all the same.
static void tiles_that_cannot_be_saved_are_warned_of_once(void **state) {
    float *expected = draw_whole(*state, false);
    char none[256];
    snprintf(none, sizeof none, "%s/none", test_folder.path);
    process process;
    start(*state, false, &process);
    float *found = draw(&process, none);
    check_numbers(&process, found, expected);
    assert_int_equal(process.recorder.warnings, 1);
    check_numbers(&process, draw(&process, none), expected);
    assert_int_equal(count_run(&process, NULL), 0);
    assert_int_equal(process.work.outcome.unsaved, 1);
    assert_int_equal(process.recorder.warnings, 1);
    stop(&process);
    free(expected);
}

/// Each allocation of a frame that loads tiles fails once.
static void a_lack_of_memory_is_survived(void **state) {
    process process;
    start(*state, false, &process);
    fit(&process, work_of(1, 1, 1), TILES * TILE_PARTS);
    stop(&process);
    counting_allocator counting;
    size_t failing = 0;
    do {
        start(*state, false, &process);
        counting_allocator_start(&counting);
        counting.failing = ++failing;
        process.recorder.host.allocator = &counting.allocator;
        process.work = work_of(1, 0, 0);
        process.work.most_texels = 16384;
        process.work.free_bytes = UINT64_MAX;
        const lobe_result result = passes_kept_transfer_prepare(
            &process.windows.run.context, 0, &process.windows.kind, &process.slot);
        assert_true(result == LOBE_OK || result == LOBE_ERROR_OUT_OF_MEMORY);
        stop(&process);
        assert_nothing_left(&counting);
    } while (counting.taken >= failing);
    assert_true(failing > 2 * TILES);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        IN_TEST_FOLDER(tiles_are_saved_one_by_one),
        IN_TEST_FOLDER(shares_consist_of_tiles),
        IN_TEST_FOLDER(shares_take_no_map),
        IN_TEST_FOLDER(what_was_saved_is_drawn),
        IN_TEST_FOLDER(bad_tiles_are_replaced),
        IN_TEST_FOLDER(tiles_of_another_device_are_replaced),
        IN_TEST_FOLDER(tiles_are_loaded_beside_the_map),
        IN_TEST_FOLDER(tiles_are_freed_when_they_are_placed),
        IN_TEST_FOLDER(tiles_that_cannot_be_saved_are_warned_of_once),
        IN_TEST_FOLDER(a_lack_of_memory_is_survived),
    };
    return cmocka_run_group_tests(tests, fixture_create_validated, fixture_destroy);
}
