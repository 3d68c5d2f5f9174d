// Both forms of the Fourier transform against double precision.

#include "tests/passes/support/fixture.h"

#include <complex.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "passes/ocean/fft.h"
#include "scenes/builtin/random.h"

#define PI 3.14159265358979323846
enum { PLANES = 2 };

typedef double complex number;

/// Of `count` numbers, `stride` apart, with e^(+i); `scratch` of the same size.
static void transform(number *values, uint32_t count, uint32_t stride, number *scratch) {
    if (count == 1)
        return;
    transform(values, count / 2, 2 * stride, scratch);
    transform(values + stride, count / 2, 2 * stride, scratch);
    for (uint32_t i = 0; i < count / 2; i++) {
        const number even = values[2 * i * stride];
        const number odd = values[(2 * i + 1) * stride] * cexp(2 * PI * I * i / count);
        scratch[i] = even + odd;
        scratch[i + count / 2] = even - odd;
    }
    for (uint32_t i = 0; i < count; i++)
        values[i * stride] = scratch[i];
}

static void transform_plane(number *plane, uint32_t size) {
    number *scratch = calloc(size, sizeof *scratch);
    for (uint32_t i = 0; i < size; i++)
        transform(plane + (size_t)i * size, size, 1, scratch);
    for (uint32_t i = 0; i < size; i++)
        transform(plane + i, size, size, scratch);
    free(scratch);
}

static float *random_planes(uint32_t size) {
    const size_t count = (size_t)4 * PLANES * size * size;
    float *values = calloc(count, sizeof *values);
    random_sequence sequence = scenes_random_start(size);
    for (size_t i = 0; i < count; i++)
        values[i] = (float)scenes_random_between(&sequence, -1, 1);
    return values;
}

/// Transforms planes on the device; the result belongs to the graph.
static const float *run(fixture *f, fft_form form, uint32_t size, const float *values) {
    float roots[2 * FFT_LARGEST];
    lobe_buffer *source, *root_buffer;
    passes_fft_roots(size, roots);
    const lobe_buffer_parameters planes = {
        .size = (size_t)4 * PLANES * size * size * sizeof *values, .data = values};
    const lobe_buffer_parameters few = {.size = 2 * size * sizeof *roots, .data = roots};
    assert_int_equal(lobe_buffer_create(f->device, &planes, &source), LOBE_OK);
    assert_int_equal(lobe_buffer_create(f->device, &few, &root_buffer), LOBE_OK);
    lobe_graph_begin(f->graph);
    const lobe_resource image =
        lobe_graph_image(f->graph, &(lobe_image_description){.name = "transformed",
                                                             .format = LOBE_FORMAT_RGBA32_FLOAT,
                                                             .width = size,
                                                             .height = size,
                                                             .layers = PLANES});
    const lobe_resource result =
        passes_fft(f->graph, form, size, PLANES, lobe_graph_import_buffer(f->graph, source),
                   lobe_graph_import_buffer(f->graph, root_buffer), image);
    lobe_graph_read_back(f->graph, result, (lobe_range){0});
    assert_int_equal(lobe_graph_execute(f->graph), LOBE_OK);
    lobe_buffer_destroy(&source);
    lobe_buffer_destroy(&root_buffer);
    return lobe_graph_data(f->graph, result, NULL);
}

/// One of the two numbers of each texel of a plane.
static number *extract(const float *values, uint32_t size, uint32_t plane, uint32_t half) {
    const size_t texels = (size_t)size * size;
    number *result = calloc(texels, sizeof *result);
    for (size_t i = 0; i < texels; i++) {
        const float *texel = values + 4 * (plane * texels + i) + 2 * half;
        result[i] = texel[0] + I * texel[1];
    }
    return result;
}

/// The largest error relative to the root mean square; and Parseval's theorem.
static void compare(const float *values, const float *found, uint32_t size, uint32_t plane,
                    uint32_t half) {
    const size_t texels = (size_t)size * size;
    number *before = extract(values, size, plane, half);
    number *after = extract(found, size, plane, half);
    double squares = 0, transformed = 0, worst = 0;
    for (size_t i = 0; i < texels; i++)
        squares += pow(cabs(before[i]), 2);
    transform_plane(before, size);
    for (size_t i = 0; i < texels; i++) {
        worst = fmax(worst, cabs(before[i] - after[i]));
        transformed += pow(cabs(after[i]), 2);
    }
    assert_true(worst <= 4e-6 * sqrt(squares));
    assert_true(fabs(transformed / (double)texels / squares - 1) <= 1e-5);
    free(before);
    free(after);
}

static void check(fixture *f, fft_form form) {
    for (uint32_t size = FFT_SMALLEST; size <= FFT_LARGEST; size *= 2) {
        float *values = random_planes(size);
        const float *found = run(f, form, size, values);
        // Of the largest, the last: the reference takes its time.
        for (uint32_t i = size > 256 ? 2 * PLANES - 1 : 0; i < 2 * PLANES; i++)
            compare(values, found, size, i / 2, i % 2);
        free(values);
    }
    assert_int_equal(lobe_device_validation_count(f->device), 0);
}

static void steps_through_memory_are_exact(void **state) {
    check(*state, FFT_THROUGH_MEMORY);
}

static void steps_in_groups_are_exact(void **state) {
    check(*state, FFT_IN_GROUPS);
}

// The reference itself, against the definition.
static void reference_is_the_definition(void **state) {
    (void)state;
    enum { SIZE = 8 };
    float *values = random_planes(SIZE);
    number *plane = extract(values, SIZE, 0, 0), *given = extract(values, SIZE, 0, 0);
    transform_plane(plane, SIZE);
    for (int y = 0; y < SIZE; y++)
        for (int x = 0; x < SIZE; x++) {
            number sum = 0;
            for (int m = 0; m < SIZE; m++)
                for (int n = 0; n < SIZE; n++)
                    sum += given[m * SIZE + n] * cexp(2 * PI * I * (n * x + m * y) / SIZE);
            assert_true(cabs(sum - plane[y * SIZE + x]) < 1e-12);
        }
    free(values);
    free(plane);
    free(given);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(reference_is_the_definition),
        cmocka_unit_test(steps_through_memory_are_exact),
        cmocka_unit_test(steps_in_groups_are_exact),
    };
    return cmocka_run_group_tests(tests, fixture_create_validated, fixture_destroy);
}
