// All maps of an environment: made only if wanted, only once, and part by part.

#include <stdlib.h>
#include <string.h>

#include "passes/environment/maps.h"
#include "tests/passes/support/environment_reference.h"

enum { SIZE = 16 };

/// Frames of a graph with an environment's maps.
typedef struct frames {
    fixture *f;
    lobe_environment environment;
    lobe_texture *texture;
    environment_maps_request request;
    environment_maps_progress progress;
} frames;

static void start(frames *s, fixture *f, bool lobes, bool ggx, uint32_t parts) {
    *s = (frames){.f = f, .environment = environment_of_patches(32, 16)};
    lobe_texture_parameters parameters = {.image = &s->environment.image};
    assert_int_equal(lobe_texture_create(f->device, &parameters, &s->texture), LOBE_OK);
    s->request = (environment_maps_request){
        .environment = &s->environment,
        .texture = s->texture,
        .size = SIZE,
        .wanted = {[LOBE_ENVIRONMENT_VON_MISES_FISHER] = lobes, [LOBE_ENVIRONMENT_GGX] = ggx},
        .parts = parts,
    };
}

static void stop(frames *s) {
    // The graph frees retained maps that a frame does not declare.
    lobe_graph_begin(s->f->graph);
    assert_int_equal(lobe_graph_execute(s->f->graph), LOBE_OK);
    lobe_texture_destroy(&s->texture);
    lobe_image_free(&s->environment.image);
}

/// One frame that wants all maps.
static environment_maps run_frame(frames *s) {
    lobe_graph_begin(s->f->graph);
    environment_maps maps = passes_environment_maps_declare(s->f->graph, &s->request, &s->progress);
    for (int i = 0; i < LOBE_ENVIRONMENT_MAP_COUNT; i++)
        if (maps.cubes[i].version != 0)
            lobe_graph_read_back(s->f->graph, maps.cubes[i], (lobe_range){0});
    if (lobe_graph_execute(s->f->graph) != LOBE_OK)
        fail_msg("%s", s->f->error);
    return maps;
}

static size_t passes_run(const frames *s) {
    return count_passes(s->f->graph, NULL, LOBE_PASS_RUN);
}

static size_t run_of(const frames *s, const char *name) {
    return count_passes(s->f->graph, name, LOBE_PASS_RUN);
}

static void only_what_is_asked_is_made(void **state) {
    frames s;
    start(&s, *state, false, false, 0);
    environment_maps maps = run_frame(&s);
    assert_true(maps.complete && maps.up_to_date);
    assert_int_equal(maps.cubes[LOBE_ENVIRONMENT_VON_MISES_FISHER].version, 0);
    assert_int_equal(passes_run(&s),
                     run_of(&s, "environment_cube") + run_of(&s, "environment_reduction"));
    s.request.wanted[LOBE_ENVIRONMENT_VON_MISES_FISHER] = true;
    maps = run_frame(&s);
    assert_true(maps.complete);
    assert_int_equal(run_of(&s, "environment_cube"), 0);
    assert_int_equal(run_of(&s, "environment_prefiltering"), maps.part_count);
    assert_int_equal(run_of(&s, "environment_mixture"), 0);
    assert_int_equal(maps.cubes[LOBE_ENVIRONMENT_GGX].version, 0);
    assert_int_equal(maps.cubes[LOBE_ENVIRONMENT_BETWEEN].version, 0);
    s.request.wanted[LOBE_ENVIRONMENT_BETWEEN] = true;
    maps = run_frame(&s);
    assert_true(maps.cubes[LOBE_ENVIRONMENT_BETWEEN].version != 0);
    assert_int_equal(run_of(&s, "environment_prefiltering"), maps.part_count / 2);
    assert_int_equal(run_of(&s, "environment_mixture"), 0);
    s.request.wanted[LOBE_ENVIRONMENT_GGX] = true;
    maps = run_frame(&s);
    assert_true(maps.complete);
    assert_true(maps.cubes[LOBE_ENVIRONMENT_GGX].version != 0);
    assert_int_equal(run_of(&s, "environment_mixture"), maps.part_count / 3);
    assert_int_equal(run_of(&s, "environment_prefiltering"), maps.part_count / 3);
    stop(&s);
}

static void nothing_is_made_twice(void **state) {
    frames s;
    start(&s, *state, true, true, 0);
    run_frame(&s);
    assert_true(passes_run(&s) > 0);
    run_frame(&s);
    assert_int_equal(passes_run(&s), 0);
    assert_int_equal(lobe_texture_update(s.texture, &s.environment.image), LOBE_OK);
    run_frame(&s);
    assert_true(run_of(&s, "environment_mixture") > 0);
    stop(&s);
}

/// A copy of what the last frame read back; the caller frees it.
static void *content(const frames *s, lobe_resource resource, size_t *size) {
    const void *data = lobe_graph_data(s->f->graph, resource, size);
    assert_non_null(data);
    void *copy = malloc(*size);
    assert_non_null(copy);
    return memcpy(copy, data, *size);
}

static void parts_add_up_to_the_whole(void **state) {
    frames s;
    size_t size, parts_size;
    start(&s, *state, true, true, 0);
    environment_maps maps = run_frame(&s);
    void *whole = content(&s, maps.cubes[LOBE_ENVIRONMENT_GGX], &size);
    stop(&s);
    start(&s, *state, true, true, 4);
    uint32_t count = 0;
    for (maps.up_to_date = false; !maps.up_to_date; count++) {
        maps = run_frame(&s);
        assert_int_equal(maps.complete, maps.up_to_date);
        assert_true(run_of(&s, "environment_prefiltering") <= 4);
        assert_true(count < maps.part_count);
    }
    assert_int_equal(count, (maps.part_count + 3) / 4);
    void *by_parts = content(&s, maps.cubes[LOBE_ENVIRONMENT_GGX], &parts_size);
    assert_int_equal(parts_size, size);
    assert_memory_equal(by_parts, whole, size);
    free(whole);
    free(by_parts);
    stop(&s);
}

/// What the parts are made from.
static void parts_share_the_smoothed_environment(void **state) {
    frames s;
    start(&s, *state, true, false, 0);
    s.request.size = 64;
    run_frame(&s);
    const size_t whole = run_of(&s, "environment_smoothing");
    stop(&s);
    start(&s, *state, true, false, 8);
    s.request.size = 64;
    size_t by_parts = 0;
    for (environment_maps maps = {0}; !maps.up_to_date;) {
        maps = run_frame(&s);
        by_parts += run_of(&s, "environment_smoothing");
    }
    assert_true(whole > 0);
    assert_int_equal(by_parts, whole);
    s.request.parts = 0;
    run_frame(&s);
    assert_int_equal(passes_run(&s), 0);
    stop(&s);
}

/// The former cubes stay until the new ones are finished.
static void a_new_environment_takes_over_when_it_is_finished(void **state) {
    frames s;
    size_t size, now_size;
    start(&s, *state, true, false, 3);
    environment_maps maps = {0};
    while (!maps.up_to_date)
        maps = run_frame(&s);
    void *former = content(&s, maps.cubes[LOBE_ENVIRONMENT_VON_MISES_FISHER], &size);
    for (uint32_t i = 0; i < 32 * 16; i++)
        environment_texel(&s.environment, i, 0)[0] += 1;
    assert_int_equal(lobe_texture_update(s.texture, &s.environment.image), LOBE_OK);
    passes_environment_maps_invalidate(&maps, &s.progress);
    for (maps.up_to_date = false; !maps.up_to_date;) {
        maps = run_frame(&s);
        assert_true(maps.complete);
        void *now = content(&s, maps.cubes[LOBE_ENVIRONMENT_VON_MISES_FISHER], &now_size);
        assert_int_equal(now_size, size);
        assert_int_equal(memcmp(now, former, size) != 0, maps.up_to_date);
        free(now);
    }
    free(former);
    // Another change halfway through starts over, still with the same former cubes.
    passes_environment_maps_invalidate(&maps, &s.progress);
    maps = run_frame(&s);
    assert_true(maps.complete && !maps.up_to_date);
    passes_environment_maps_invalidate(&maps, &s.progress);
    maps = run_frame(&s);
    assert_true(maps.complete && !maps.up_to_date);
    assert_int_equal(maps.parts_done, 3);
    stop(&s);
}

// ---------------------------------------------------------------------------------------------
// lobe_environment_maps

static bool three_times(void *user, double part) {
    assert_true(part > 0 && part <= 1);
    return ++*(int *)user < 3;
}

static void making_can_be_stopped(void **state) {
    fixture *f = *state;
    int calls = 0;
    lobe_environment environment = environment_of_patches(32, 16);
    lobe_environment_maps_parameters parameters = {
        .environment = &environment,
        .size = SIZE,
        .wanted = {[LOBE_ENVIRONMENT_VON_MISES_FISHER] = true},
        .parts_per_submission = 1,
        .progress = three_times,
        .user = &calls,
        .host = &f->host,
    };
    lobe_environment_maps *maps;
    assert_int_equal(lobe_environment_maps_create(f->device, &parameters, &maps), LOBE_OK);
    assert_null(maps);
    assert_int_equal(calls, 3);
    lobe_image_free(&environment.image);
}

static void wrong_arguments_are_told(void **state) {
    fixture *f = *state;
    lobe_environment environment = environment_of_patches(32, 16);
    lobe_environment_maps_parameters parameters = {
        .environment = &environment, .size = 24, .host = &f->host};
    lobe_environment_maps *maps;
    fixture_forget_messages(f);
    assert_failure(f, lobe_environment_maps_create(f->device, &parameters, &maps),
                   LOBE_ERROR_INVALID_ARGUMENT, "24");
    assert_null(maps);
    parameters.size = SIZE;
    environment.layout = LOBE_ENVIRONMENT_VERTICAL_CROSS;
    fixture_forget_messages(f);
    assert_failure(f, lobe_environment_maps_create(f->device, &parameters, &maps),
                   LOBE_ERROR_INVALID_ARGUMENT, "layout");
    environment.layout = LOBE_ENVIRONMENT_LATITUDE_LONGITUDE;
    maps = make_maps(f, &environment, SIZE, false, false);
    lobe_image image;
    fixture_forget_messages(f);
    assert_failure(
        f, lobe_environment_maps_read(maps, LOBE_ENVIRONMENT_VON_MISES_FISHER, 0, 0, &image),
        LOBE_ERROR_INVALID_ARGUMENT, "no level 0");
    lobe_environment other = environment_of_patches(16, 8);
    fixture_forget_messages(f);
    assert_failure(f, lobe_environment_maps_update(maps, &other), LOBE_ERROR_INVALID_ARGUMENT,
                   "extent");
    lobe_image_free(&other.image);
    lobe_environment_maps_destroy(&maps);
    assert_null(maps);
    lobe_environment_maps_destroy(&maps);
    lobe_image_free(&environment.image);
}

static void an_update_makes_all_anew(void **state) {
    fixture *f = *state;
    lobe_environment environment = environment_of_patches(32, 16);
    lobe_environment_maps *maps = make_maps(f, &environment, SIZE, true, false);
    size_t passes = lobe_environment_maps_describe(maps)->pass_count;
    lobe_image before, after;
    assert_int_equal(
        lobe_environment_maps_read(maps, LOBE_ENVIRONMENT_VON_MISES_FISHER, 1, 2, &before),
        LOBE_OK);
    for (uint32_t i = 0; i < 32 * 16; i++)
        environment_texel(&environment, i, 0)[1] *= 2;
    assert_int_equal(lobe_environment_maps_update(maps, &environment), LOBE_OK);
    assert_int_equal(lobe_environment_maps_describe(maps)->pass_count, passes);
    assert_int_equal(
        lobe_environment_maps_read(maps, LOBE_ENVIRONMENT_VON_MISES_FISHER, 1, 2, &after), LOBE_OK);
    for (uint32_t i = 0; i < after.width * after.height; i++) {
        const float *a = (const float *)before.texels + 4 * i, *b = (float *)after.texels + 4 * i;
        assert_true(a[0] == b[0] && b[1] == 2 * a[1]);
    }
    lobe_image_free(&before);
    lobe_image_free(&after);
    assert_int_equal(lobe_environment_maps_update(maps, NULL), LOBE_OK);
    assert_int_equal(lobe_environment_maps_describe(maps)->pass_count, passes);
    lobe_environment_maps_destroy(&maps);
    lobe_image_free(&environment.image);
}

static void nothing_is_reported(void **state) {
    fixture *f = *state;
    assert_int_equal(lobe_device_validation_count(f->device), 0);
    assert_int_equal(f->warnings, 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(only_what_is_asked_is_made),
        cmocka_unit_test(nothing_is_made_twice),
        cmocka_unit_test(parts_add_up_to_the_whole),
        cmocka_unit_test(parts_share_the_smoothed_environment),
        cmocka_unit_test(a_new_environment_takes_over_when_it_is_finished),
        cmocka_unit_test(making_can_be_stopped),
        cmocka_unit_test(wrong_arguments_are_told),
        cmocka_unit_test(an_update_makes_all_anew),
        cmocka_unit_test(nothing_is_reported),
    };
    return cmocka_run_group_tests(tests, fixture_create_validated, fixture_destroy);
}
