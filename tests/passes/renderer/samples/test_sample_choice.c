// Which pixels take several samples, and what the passes that take them are told.

#include <string.h>

#include "passes/renderer/samples/sample_choice.h"
#include "passes/renderer/shading.h"
#include "tests/passes/support/pass_run.h"
#include "tests/passes/support/scene_builder.h"

enum { WIDTH = 70, HEIGHT = 11, STEP = 33 }; // more than one tile of the key

/// A picture whose columns from STEP on have another radiance and depth.
typedef struct step {
    float left, right;             ///< radiance
    float left_depth, right_depth; ///< 0: nothing is hit
} step;

typedef struct chosen {
    float counts[HEIGHT][WIDTH];
    uint32_t listed, pixels[WIDTH * HEIGHT];
    lobe_dispatch_arguments dispatch;
    lobe_draw_arguments draws[3]; ///< mask, background, the only instance
} chosen;

static lobe_texture *step_texture(fixture *f, const step *step) {
    lobe_image image = map_image(LOBE_FORMAT_RGBA32_FLOAT, WIDTH, HEIGHT);
    for (uint32_t i = 0; i < WIDTH * HEIGHT; i++) {
        const bool left = i % WIDTH < STEP;
        float *texel = (float *)image.texels + (size_t)4 * i;
        texel[0] = 0.25f * (left ? step->left : step->right);
        texel[1] = left ? step->left : step->right;
        texel[3] = left ? step->left_depth : step->right_depth;
    }
    lobe_texture *texture;
    assert_int_equal(
        lobe_texture_create(f->device, &(lobe_texture_parameters){.image = &image}, &texture),
        LOBE_OK);
    lobe_image_free(&image);
    return texture;
}

static void read(const lobe_graph *graph, lobe_resource resource, size_t offset, void *target,
                 size_t size) {
    size_t available = 0;
    const char *data = lobe_graph_data(graph, resource, &available);
    assert_non_null(data);
    assert_true(offset + size <= available);
    memcpy(target, data + offset, size);
}

/// Runs the passes on a picture, for an orthographic camera 2 m high. `samples`: the knob's value.
static void choose(fixture *f, const step *step, const char *samples, bool blended,
                   chosen *result) {
    lobe_scene *scene = scene_begin();
    lobe_material material;
    lobe_material_default(&material);
    scene_end_with_square(scene, &material);
    lobe_texture *texture = step_texture(f, step);
    pass_run run;
    pass_run_begin(&run, f, scene, "lobes", (const char *[]){samples, NULL});
    run.context.view.width = WIDTH;
    run.context.view.height = HEIGHT;
    instance_batch batch = {.count = 5};
    const draw_list draws = {.batches = &batch, .batch_count = 1};
    const sample_choice choice = passes_sample_choice(
        &run.context, &draws, lobe_graph_import_texture(f->graph, texture), blended);
    lobe_graph_read_back(f->graph, choice.counts, (lobe_range){0});
    lobe_graph_read_back(f->graph, choice.list, (lobe_range){0});
    lobe_graph_read_back(f->graph, choice.arguments, (lobe_range){0});
    pass_run_execute(&run);
    read(f->graph, choice.counts, 0, result->counts, sizeof result->counts);
    read(f->graph, choice.list, 0, &result->listed, 4);
    read(f->graph, choice.list, 4, result->pixels, sizeof result->pixels);
    read(f->graph, choice.arguments, 0, &result->dispatch, sizeof result->dispatch);
    assert_int_equal(passes_shading_draw_count(&draws), 3);
    read(f->graph, choice.arguments, sizeof *result->draws, result->draws, sizeof result->draws);
    pass_run_end(&run);
    lobe_texture_destroy(&texture);
    lobe_scene_destroy(&scene);
    assert_int_equal(f->errors, 0);
    assert_int_equal(lobe_device_validation_count(f->device), 0);
}

/// Every pixel of the columns on both sides of the step is chosen, or none; each is listed once,
/// and the arguments fit.
static void check_columns(const chosen *c, bool chosen_ones) {
    bool seen[HEIGHT][WIDTH] = {{false}};
    assert_int_equal(c->listed, chosen_ones ? 2 * HEIGHT : 0);
    for (uint32_t i = 0; i < c->listed; i++) {
        const uint32_t x = c->pixels[i] & 0xffff, y = c->pixels[i] >> 16;
        assert_true(x < WIDTH && y < HEIGHT && !seen[y][x]);
        seen[y][x] = true;
    }
    for (int y = 0; y < HEIGHT; y++)
        for (int x = 0; x < WIDTH; x++) {
            const bool takes_more = chosen_ones && (x == STEP - 1 || x == STEP);
            assert_true(c->counts[y][x] == (takes_more ? 8 : 1));
            assert_int_equal(seen[y][x], takes_more);
        }
    assert_int_equal(c->dispatch.groups[0], chosen_ones ? 1 : 0);
    for (int i = 0; i < 3; i++) {
        assert_int_equal(c->draws[i].index_count, i < 2 ? 3 : 6);
        assert_int_equal(c->draws[i].instance_count, !chosen_ones ? 0 : i < 2 ? 1 : 5);
        assert_int_equal(c->draws[i].first_index, 0);
    }
}

/// The key is the square of the mean root, 0.433 and 0.787: the limits are 0.8 and, where depths
/// break, 0.3 of it.
static void contrast_is_measured_in_keys(void **state) {
    static const struct {
        step step;
        bool chosen;
    } cases[] = {
        {{1, 0.1f, 0.5f, 0.5f}, true},    // 0.9 > 0.346
        {{1, 0.6f, 0.5f, 0.5f}, false},   // 0.4 < 0.63
        {{1, 0.6f, 0.5f, 0.25f}, true},   // 0.4 > 0.236
        {{1, 0.8f, 0.5f, 0.25f}, false},  // 0.2 < 0.269
        {{1e4f, 1e3f, 0.5f, 0.5f}, true}, // the unit of radiance does not matter
        {{1e-4f, 6e-5f, 0.5f, 0.5f}, false},
        {{0, 0, 0.5f, 0.25f}, false}, // black
        {{1, 0, 0.5f, 0}, true},      // black does not lower the key, which is 1
        {{1, 0.79f, 0.5f, 0}, false}, // 0.21 < 0.268
    };
    chosen result;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        choose(*state, &cases[i].step, "samples=auto", false, &result);
        check_columns(&result, cases[i].chosen);
    }
}

/// What is behind the outline is unknown.
static void outlines_are_chosen_where_the_picture_is_blended(void **state) {
    static const step outline = {0.01f, 0, 0.5f, 0};
    chosen result;
    choose(*state, &outline, "samples=auto", true, &result);
    check_columns(&result, true);
}

static void a_fixed_number_chooses_all(void **state) {
    static const step even = {1, 1, 0.5f, 0.5f};
    chosen result;
    choose(*state, &even, "samples=4", false, &result);
    assert_int_equal(result.listed, WIDTH * HEIGHT);
    assert_int_equal(result.dispatch.groups[0], (WIDTH * HEIGHT + 63) / 64);
    assert_true(result.counts[5][60] == 4);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(contrast_is_measured_in_keys),
        cmocka_unit_test(outlines_are_chosen_where_the_picture_is_blended),
        cmocka_unit_test(a_fixed_number_chooses_all),
    };
    return cmocka_run_group_tests(tests, fixture_create_validated, fixture_destroy);
}
