// Filtered cubes that are loaded from a cache folder: the same, texel by texel, as newly made ones;
// made again if the environment or the file differs.

#include "tests/passes/support/fixture.h"

#include <string.h>

#include <lobe/environment_maps.h>

#include "tests/engine/support/temporary_folder.h"

#define SIZE 16

/// Faces of 16 texels, below one another; `seed` makes the difference.
static lobe_environment make_environment(uint32_t seed) {
    lobe_environment environment = {.name = "cached",
                                    .layout = LOBE_ENVIRONMENT_CUBE_COLUMN,
                                    .world_from_environment = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                                    .intensity = 1};
    assert_int_equal(
        lobe_image_allocate(&environment.image, LOBE_FORMAT_RGBA32_FLOAT, SIZE, 6 * SIZE, NULL),
        LOBE_OK);
    for (size_t i = 0; i < 4 * 6 * SIZE * SIZE; i++) {
        seed = seed * 1664525u + 1013904223u;
        ((float *)environment.image.texels)[i] = (float)(seed >> 8) * 0x1p-24f;
    }
    return environment;
}

static lobe_environment_maps *make(fixture *f, const lobe_environment *environment,
                                   const char *cache) {
    lobe_environment_maps *maps;
    lobe_result result = lobe_environment_maps_create(
        f->device,
        &(lobe_environment_maps_parameters){
            .environment = environment,
            .size = SIZE,
            .wanted = {[LOBE_ENVIRONMENT_VON_MISES_FISHER] = true, [LOBE_ENVIRONMENT_GGX] = true},
            .cache = cache,
            .host = &f->host},
        &maps);
    if (result != LOBE_OK)
        fail_msg("%s", f->error);
    return maps;
}

static bool is_cached(const lobe_environment_maps *maps) {
    return lobe_environment_maps_describe(maps)->cached;
}

/// Whether all levels of both filtered cubes are the same bits.
static bool same_cubes(lobe_environment_maps *a, lobe_environment_maps *b) {
    bool same = true;
    for (int map = LOBE_ENVIRONMENT_VON_MISES_FISHER; map < LOBE_ENVIRONMENT_MAP_COUNT; map++) {
        uint32_t levels = lobe_environment_maps_describe(a)->levels[map];
        assert_int_equal(levels, lobe_environment_maps_describe(b)->levels[map]);
        for (uint32_t i = 0; i < 6 * levels; i++) {
            lobe_image faces[2];
            for (int k = 0; k < 2; k++)
                assert_int_equal(lobe_environment_maps_read(k == 0 ? a : b,
                                                            (lobe_environment_map)map, i / 6, i % 6,
                                                            &faces[k]),
                                 LOBE_OK);
            assert_int_equal(faces[0].width, faces[1].width);
            same = same && memcmp(faces[0].texels, faces[1].texels,
                                  (size_t)16 * faces[0].width * faces[0].width) == 0;
            lobe_image_free(&faces[0]);
            lobe_image_free(&faces[1]);
        }
    }
    return same;
}

static void cached_cubes_are_the_same(void **state) {
    fixture *f = *state;
    temporary_folder folder;
    temporary_folder_create(&folder);
    lobe_environment environment = make_environment(1);
    lobe_environment_maps *plain = make(f, &environment, NULL);
    lobe_environment_maps *first = make(f, &environment, folder.path);
    assert_int_equal(temporary_folder_count(&folder), 2);
    lobe_environment_maps *second = make(f, &environment, folder.path);
    assert_false(is_cached(plain));
    assert_false(is_cached(first));
    assert_true(is_cached(second));
    assert_true(same_cubes(plain, first));
    assert_true(same_cubes(plain, second));
    // Restored cubes can be restored again.
    assert_int_equal(lobe_environment_maps_update(second, NULL), LOBE_OK);
    assert_true(same_cubes(plain, second));
    lobe_environment_maps_destroy(&plain);
    lobe_environment_maps_destroy(&first);
    lobe_environment_maps_destroy(&second);
    lobe_image_free(&environment.image);
    temporary_folder_remove(&folder);
}

/// Back and forth between two environments: each is filtered once.
static void updates_load_from_the_folder(void **state) {
    fixture *f = *state;
    temporary_folder folder;
    temporary_folder_create(&folder);
    lobe_environment environments[2] = {make_environment(1), make_environment(2)};
    lobe_environment_maps *plain[2] = {make(f, &environments[0], NULL),
                                       make(f, &environments[1], NULL)};
    lobe_environment_maps *maps = make(f, &environments[0], folder.path);
    for (int i = 1; i < 4; i++) {
        assert_int_equal(lobe_environment_maps_update(maps, &environments[i % 2]), LOBE_OK);
        assert_int_equal(is_cached(maps), i > 1);
        assert_true(same_cubes(maps, plain[i % 2]));
        assert_false(same_cubes(maps, plain[1 - i % 2]));
    }
    assert_int_equal(temporary_folder_count(&folder), 4);
    lobe_environment_maps_destroy(&maps);
    for (int i = 0; i < 2; i++) {
        lobe_environment_maps_destroy(&plain[i]);
        lobe_image_free(&environments[i].image);
    }
    temporary_folder_remove(&folder);
}

static void an_unwritable_folder_is_no_failure(void **state) {
    fixture *f = *state;
    fixture_forget_messages(f);
    lobe_environment environment = make_environment(3);
    lobe_environment_maps *maps = make(f, &environment, "/nonexistent/folder");
    assert_false(is_cached(maps));
    assert_int_equal(f->warnings, 1);
    assert_int_equal(f->errors, 0);
    lobe_environment_maps_destroy(&maps);
    lobe_image_free(&environment.image);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(cached_cubes_are_the_same),
        cmocka_unit_test(updates_load_from_the_folder),
        cmocka_unit_test(an_unwritable_folder_is_no_failure),
    };
    return cmocka_run_group_tests(tests, fixture_create_validated, fixture_destroy);
}
