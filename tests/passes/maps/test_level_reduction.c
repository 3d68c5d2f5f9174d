// Per-level reduction against exact means in double precision.

#include "tests/passes/support/fixture.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "engine/image/half.h"
#include "passes/maps/level_reduction.h"
#include "scenes/builtin/random.h"
#include "tests/reference/map/box_reduction.h"

typedef struct extent {
    uint32_t width, height, layers;
} extent;

/// Numbers from -1 to 1 in the precision of the format, and a huge one.
static reference_layers random_layers(extent size, lobe_format format) {
    reference_layers layers = reference_layers_allocate(size.width, size.height, size.layers);
    size_t count = (size_t)4 * size.width * size.height * size.layers;
    random_sequence sequence = scenes_random_start(size.width * 1000 + size.height);
    for (size_t i = 0; i < count; i++) {
        float value = (float)scenes_random_between(&sequence, -1, 1);
        if (i == count / 3)
            value = format == LOBE_FORMAT_RGBA16_FLOAT ? 3e4f : 1e9f;
        layers.texels[i] = format == LOBE_FORMAT_RGBA16_FLOAT
                               ? (double)engine_half_to_float(engine_half_from_float(value))
                               : (double)value;
    }
    return layers;
}

static lobe_texture *upload_layer(lobe_device *device, const reference_layers *layers,
                                  uint32_t layer, lobe_format format) {
    lobe_image image;
    assert_int_equal(lobe_image_allocate(&image, format, layers->width, layers->height, NULL),
                     LOBE_OK);
    const double *texels = reference_texel(layers, 0, 0, layer);
    for (size_t i = 0; i < (size_t)4 * layers->width * layers->height; i++) {
        if (format == LOBE_FORMAT_RGBA16_FLOAT)
            ((uint16_t *)image.texels)[i] = engine_half_from_float((float)texels[i]);
        else
            ((float *)image.texels)[i] = (float)texels[i];
    }
    lobe_texture *texture;
    assert_int_equal(
        lobe_texture_create(device, &(lobe_texture_parameters){.image = &image}, &texture),
        LOBE_OK);
    lobe_image_free(&image);
    return texture;
}

static double value_at(const void *data, size_t index, lobe_format format) {
    return format == LOBE_FORMAT_RGBA16_FLOAT
               ? (double)engine_half_to_float(((const uint16_t *)data)[index])
               : (double)((const float *)data)[index];
}

/// The same numbers without their signs: their means bound the rounding errors.
static reference_layers magnitudes(const reference_layers *layers) {
    reference_layers result =
        reference_layers_allocate(layers->width, layers->height, layers->layers);
    for (size_t i = 0; i < (size_t)4 * layers->width * layers->height * layers->layers; i++)
        result.texels[i] = fabs(layers->texels[i]);
    return result;
}

static void replace(reference_layers *layers) {
    reference_layers next = reference_reduce(layers);
    reference_layers_free(layers);
    *layers = next;
}

/// Compares levels `first` to `last` of the chain that starts with `exact`, which is freed.
static void check_chain(const void *data, reference_layers exact, uint32_t first, uint32_t last,
                        lobe_format format) {
    // A few roundings per level: of float32, or of float16 at the end of each level.
    double rounding = format == LOBE_FORMAT_RGBA16_FLOAT ? 6e-4 : 4e-7;
    reference_layers bound = magnitudes(&exact);
    size_t index = 0;
    for (uint32_t level = 0; level <= last; level++) {
        if (level > 0) {
            replace(&exact);
            replace(&bound);
        }
        if (level < first)
            continue;
        size_t count = (size_t)4 * exact.width * exact.height * exact.layers;
        for (size_t i = 0; i < count; i++, index++) {
            double error = fabs(value_at(data, index, format) - exact.texels[i]);
            if (!(error <= rounding * (level + 1) * bound.texels[i]))
                fail_msg("level %u of %ux%u: %g instead of %g", level, exact.width, exact.height,
                         value_at(data, index, format), exact.texels[i]);
        }
    }
    reference_layers_free(&bound);
    reference_layers_free(&exact);
}

static lobe_resource copy_layers(lobe_graph *graph, lobe_resource target, lobe_texture **textures,
                                 uint32_t count) {
    lobe_pass *pass = lobe_graph_add_pass(graph, LOBE_PASS_TRANSFER, "copy");
    for (uint32_t i = 0; i < count; i++)
        target = lobe_pass_copy(pass, lobe_graph_import_texture(graph, textures[i]),
                                (lobe_range){0, 1, 0, 1}, target, (lobe_range){0, 1, i, 1});
    return target;
}

/// level_reduction: levels 1 and up from level 0. Returns how many passes it took.
static size_t reduce_in_place(fixture *f, extent size, lobe_format format) {
    reference_layers exact = random_layers(size, format);
    lobe_texture *textures[8] = {NULL};
    for (uint32_t i = 0; i < size.layers; i++)
        textures[i] = upload_layer(f->device, &exact, i, format);
    lobe_graph_begin(f->graph);
    reduced_map map = {.width = size.width,
                       .height = size.height,
                       .layers = size.layers,
                       .levels = passes_level_count(size.width, size.height)};
    map.resource = lobe_graph_image(f->graph, &(lobe_image_description){.name = "map",
                                                                        .format = format,
                                                                        .width = size.width,
                                                                        .height = size.height,
                                                                        .layers = size.layers,
                                                                        .levels = map.levels});
    map.resource = copy_layers(f->graph, map.resource, textures, size.layers);
    passes_level_reduction(f->graph, &map);
    lobe_graph_read_back(f->graph, map.resource, (lobe_range){0});
    if (lobe_graph_execute(f->graph) != LOBE_OK)
        fail_msg("%ux%u: %s", size.width, size.height, f->error);
    size_t bytes;
    const void *data = lobe_graph_data(f->graph, map.resource, &bytes);
    assert_int_equal(bytes, passes_reduced_map_bytes(&map, format));
    check_chain(data, exact, 0, map.levels - 1, format);
    size_t passes = count_passes(f->graph, "level_reduction", LOBE_PASS_RUN);
    for (uint32_t i = 0; i < size.layers; i++)
        lobe_texture_destroy(&textures[i]);
    return passes;
}

/// passes_level_reduction_from: all levels from a texture twice as large.
static size_t reduce_texture(fixture *f, uint32_t width, uint32_t height, lobe_format format) {
    extent size = {width, height, 1};
    reference_layers exact = random_layers(size, format);
    lobe_texture *texture = upload_layer(f->device, &exact, 0, format);
    lobe_graph_begin(f->graph);
    reduced_map map = passes_reduced_map_declare(f->graph, "half", format, width, height, 1, true);
    passes_level_reduction_from(f->graph, &map, lobe_graph_import_texture(f->graph, texture), width,
                                height);
    lobe_graph_read_back(f->graph, map.resource, (lobe_range){0});
    if (lobe_graph_execute(f->graph) != LOBE_OK)
        fail_msg("%ux%u: %s", width, height, f->error);
    size_t bytes;
    const void *data = lobe_graph_data(f->graph, map.resource, &bytes);
    assert_int_equal(bytes, passes_reduced_map_bytes(&map, format));
    assert_int_equal(map.width, passes_half_extent(width));
    assert_int_equal(map.height, passes_half_extent(height));
    check_chain(data, exact, 1, map.levels, format);
    size_t passes = count_passes(f->graph, "level_reduction", LOBE_PASS_RUN);
    lobe_texture_destroy(&texture);
    return passes;
}

static void any_size_is_reduced_exactly(void **state) {
    static const extent sizes[] = {{1, 1, 1}, {1, 7, 2},   {7, 1, 2},     {2, 2, 3},
                                   {3, 3, 1}, {8, 8, 1},   {16, 8, 2},    {24, 40, 2},
                                   {8, 1, 2}, {40, 24, 8}, {671, 457, 2}, {1024, 64, 3}};
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++)
        reduce_in_place(*state, sizes[i], LOBE_FORMAT_RGBA32_FLOAT);
}

static void half_floats_are_reduced_to_their_precision(void **state) {
    reduce_in_place(*state, (extent){64, 64, 2}, LOBE_FORMAT_RGBA16_FLOAT);
    reduce_in_place(*state, (extent){67, 45, 2}, LOBE_FORMAT_RGBA16_FLOAT);
}

static void a_texture_is_reduced_exactly(void **state) {
    static const uint32_t sizes[][2] = {{1, 1},  {2, 1},   {1, 7},     {7, 1},    {2, 2},    {8, 8},
                                        {16, 8}, {16, 16}, {671, 457}, {457, 64}, {1024, 64}};
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++)
        reduce_texture(*state, sizes[i][0], sizes[i][1], LOBE_FORMAT_RGBA32_FLOAT);
}

/// Three levels per dispatch if the size allows it.
static void dispatches_are_few(void **state) {
    size_t square = reduce_in_place(*state, (extent){1024, 1024, 1}, LOBE_FORMAT_RGBA32_FLOAT);
    assert_in_range(square, 1, 4);
    assert_in_range(reduce_texture(*state, 512, 512, LOBE_FORMAT_RGBA32_FLOAT), 1, 3);
    // No size takes more than one per level.
    assert_in_range(reduce_in_place(*state, (extent){67, 45, 1}, LOBE_FORMAT_RGBA32_FLOAT), 1, 6);
}

/// The single texel at the end is the mean of all texels at the start, computed in one go.
static void the_mean_is_kept(void **state) {
    fixture *f = *state;
    static const extent sizes[] = {{671, 457, 1}, {1, 7, 1}, {13, 1, 1}, {96, 64, 1}};
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
        reference_layers layers = random_layers(sizes[i], LOBE_FORMAT_RGBA32_FLOAT);
        reference_layers sizeless = magnitudes(&layers);
        double mean[4], scale[4];
        reference_mean(&layers, mean);
        reference_mean(&sizeless, scale);
        lobe_texture *texture = upload_layer(f->device, &layers, 0, LOBE_FORMAT_RGBA32_FLOAT);
        lobe_graph_begin(f->graph);
        reduced_map map = passes_reduced_map_declare(f->graph, "half", LOBE_FORMAT_RGBA32_FLOAT,
                                                     sizes[i].width, sizes[i].height, 1, true);
        passes_level_reduction_from(f->graph, &map, lobe_graph_import_texture(f->graph, texture),
                                    sizes[i].width, sizes[i].height);
        lobe_graph_read_back(f->graph, map.resource, (lobe_range){map.levels - 1, 1, 0, 1});
        assert_int_equal(lobe_graph_execute(f->graph), LOBE_OK);
        const float *data = lobe_graph_data(f->graph, map.resource, NULL);
        for (int channel = 0; channel < 4; channel++)
            assert_true(fabs(data[channel] - mean[channel]) <= 4e-6 * scale[channel]);
        lobe_texture_destroy(&texture);
        reference_layers_free(&layers);
        reference_layers_free(&sizeless);
    }
}

static void a_still_map_is_not_reduced_again(void **state) {
    fixture *f = *state;
    extent size = {96, 40, 1};
    reference_layers layers = random_layers(size, LOBE_FORMAT_RGBA32_FLOAT);
    lobe_texture *texture = upload_layer(f->device, &layers, 0, LOBE_FORMAT_RGBA32_FLOAT);
    float first[4] = {0};
    for (int frame = 0; frame < 2; frame++) {
        lobe_graph_begin(f->graph);
        reduced_map map = passes_reduced_map_declare(f->graph, "still", LOBE_FORMAT_RGBA32_FLOAT,
                                                     96, 40, 1, true);
        passes_level_reduction_from(f->graph, &map, lobe_graph_import_texture(f->graph, texture),
                                    96, 40);
        lobe_graph_read_back(f->graph, map.resource, (lobe_range){map.levels - 1, 1, 0, 1});
        assert_int_equal(lobe_graph_execute(f->graph), LOBE_OK);
        const float *data = lobe_graph_data(f->graph, map.resource, NULL);
        if (frame == 0) {
            assert_true(count_passes(f->graph, "level_reduction", LOBE_PASS_RUN) > 0);
            memcpy(first, data, sizeof first);
        } else {
            assert_int_equal(count_passes(f->graph, "level_reduction", LOBE_PASS_RUN), 0);
            assert_memory_equal(first, data, sizeof first);
        }
    }
    lobe_texture_destroy(&texture);
    reference_layers_free(&layers);
}

static void sizes_halve_to_one(void **state) {
    (void)state;
    assert_int_equal(passes_level_count(1, 1), 1);
    assert_int_equal(passes_level_count(1, 7), 3);
    assert_int_equal(passes_level_count(671, 457), 10);
    assert_int_equal(passes_level_count(1024, 2), 11);
    assert_int_equal(passes_half_extent(1), 1);
    assert_int_equal(passes_half_extent(7), 3);
    // 5x3, 2x1 and 1x1 texels of two layers of eight bytes.
    reduced_map map = {.width = 5, .height = 3, .layers = 2, .levels = 3};
    assert_int_equal(passes_reduced_map_bytes(&map, LOBE_FORMAT_RGBA16_FLOAT),
                     (15 + 2 + 1) * 2 * 8);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sizes_halve_to_one),
        cmocka_unit_test(any_size_is_reduced_exactly),
        cmocka_unit_test(half_floats_are_reduced_to_their_precision),
        cmocka_unit_test(a_texture_is_reduced_exactly),
        cmocka_unit_test(the_mean_is_kept),
        cmocka_unit_test(dispatches_are_few),
        cmocka_unit_test(a_still_map_is_not_reduced_again),
    };
    return cmocka_run_group_tests(tests, fixture_create, fixture_destroy);
}
