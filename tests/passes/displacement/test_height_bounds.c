// Bounds of heights, against loops over all texels.

#include "passes/displacement/height_bounds.h"

#include <math.h>
#include <string.h>

#include "passes/upload/device_scene_parts.h"
#include "shaders/interface/displacement/displacement.h"
#include "tests/passes/displacement/drawn_geometry.h"
#include "tests/passes/support/pass_run.h"
#include "tests/passes/support/scene_builder.h"

/// As the passes read it.
static double height_at(const lobe_image *map, uint32_t x, uint32_t y) {
    const float *texels = map->texels;
    const double height = texels[4 * ((y % map->height) * map->width + x % map->width)];
    return height > 0 ? fmin(height, 1) : 0;
}

static void check_square(const lobe_image *map, const float *bounds, uint32_t level,
                         uint32_t column, uint32_t row) {
    const uint32_t side = HEIGHT_BOUNDS_TEXELS << level;
    double expected[4] = {1, 0, 0, 0};
    for (uint32_t y = row * side; y < (row + 1) * side && y < map->height; y++)
        for (uint32_t x = column * side; x < (column + 1) * side && x < map->width; x++) {
            const double height = height_at(map, x, y);
            expected[0] = fmin(expected[0], height);
            expected[1] = fmax(expected[1], height);
            expected[2] = fmax(expected[2], fabs(height_at(map, x + 1, y) - height));
            expected[3] = fmax(expected[3], fabs(height_at(map, x, y + 1) - height));
        }
    for (int i = 0; i < 4; i++)
        assert_float_equal(bounds[i], expected[i], 1e-6);
}

static void check_map(fixture *f, uint32_t width, uint32_t height) {
    pass_run run;
    const lobe_image map = random_map(width, height, -0.3, 1.2, 5);
    lobe_scene *scene = plane_with_heights(1, 1, map, 1, 1);
    pass_run_begin(&run, f, scene, "direct", (const char *[]){NULL});
    assert_int_equal(passes_device_scene_upload_image(run.scene, 0, &f->host), LOBE_OK);
    const lobe_resource heights = lobe_graph_import_texture(f->graph, run.scene->images[0]);
    const height_bounds bounds = passes_height_bounds(f->graph, heights, width, height, 0);
    lobe_graph_read_back(f->graph, bounds.buffer, (lobe_range){0});
    pass_run_execute(&run);
    size_t size = 0;
    const float *data = lobe_graph_data(f->graph, bounds.buffer, &size);
    assert_non_null(data);
    size_t checked = 0;
    uint32_t columns = 0, rows = 0;
    for (uint32_t level = 0; level < bounds.levels; level++) {
        const uint32_t side = HEIGHT_BOUNDS_TEXELS << level;
        columns = (width + side - 1) / side;
        rows = (height + side - 1) / side;
        for (uint32_t i = 0; i < columns * rows; i++)
            check_square(&scene->images[0].image, data + 4 * checked++, level, i % columns,
                         i / columns);
    }
    assert_int_equal(columns * rows, 1);
    assert_int_equal(size, checked * 4 * sizeof(float));
    pass_run_end(&run);
    lobe_scene_destroy(&scene);
}

static void bounds_are_those_of_the_texels(void **state) {
    check_map(*state, 64, 64);
    check_map(*state, 1, 1);
    check_map(*state, 203, 9);
    check_map(*state, 37, 131);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(bounds_are_those_of_the_texels)};
    return cmocka_run_group_tests(tests, fixture_create_validated, fixture_destroy);
}
