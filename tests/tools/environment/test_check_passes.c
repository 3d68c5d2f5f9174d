// The passes that measure light from an environment: the exact sum against one in double precision,
// the fast methods against what they must preserve.

#include "tests/passes/support/fixture.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "passes/environment/standalone_maps.h"
#include "tests/reference/light/cube_texel.h"
#include "tools/environment/check_passes.h"

#define SIZE       16
#define DIRECTIONS 100

static const double concentrations[CHECK_LOBES] = {1, 4, 16, 64, 256, 1024, 4096};

typedef struct checked {
    fixture *f;
    lobe_environment environment;
    lobe_environment_maps *maps;
    float directions[DIRECTIONS][4];
} checked;

/// Six faces below one another: a gradient with a bright texel, or constant.
static void start(fixture *f, bool constant, uint32_t size, checked *c) {
    *c = (checked){.f = f};
    c->environment = (lobe_environment){.name = "test",
                                        .layout = LOBE_ENVIRONMENT_CUBE_COLUMN,
                                        .world_from_environment = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                                        .intensity = 1};
    assert_int_equal(lobe_image_allocate(&c->environment.image, LOBE_FORMAT_RGBA32_FLOAT, SIZE,
                                         6 * SIZE, &f->host),
                     LOBE_OK);
    float *texels = c->environment.image.texels;
    for (int i = 0; i < 6 * SIZE * SIZE; i++) {
        texels[4 * i] = constant ? 3 : 1 + 0.01f * (float)(i % SIZE);
        texels[4 * i + 1] = constant ? 2 : 1 + 0.5f * (float)(i / SIZE / SIZE % 2);
        texels[4 * i + 2] = constant ? 1 : i == 777 ? 500.0f : 0.25f;
        texels[4 * i + 3] = 1;
    }
    lobe_result result = lobe_environment_maps_create(
        f->device,
        &(lobe_environment_maps_parameters){
            .environment = &c->environment,
            .size = size,
            .wanted =
                {[LOBE_ENVIRONMENT_VON_MISES_FISHER] = true, [LOBE_ENVIRONMENT_BETWEEN] = true},
            .host = &f->host},
        &c->maps);
    if (result != LOBE_OK)
        fail_msg("%s", f->error);
    environment_check_directions(DIRECTIONS, c->directions);
}

static void stop(checked *c) {
    lobe_environment_maps_destroy(&c->maps);
    lobe_image_free(&c->environment.image);
}

static environment_check_request begin(checked *c, lobe_graph **graph, environment_maps *cubes) {
    *graph = passes_standalone_maps_begin(c->maps, cubes);
    return (environment_check_request){
        .directions = lobe_graph_upload(*graph, "directions", c->directions, sizeof c->directions),
        .count = DIRECTIONS,
        .rounds = 1,
    };
}

/// The caller frees the result.
static float *take(checked *c, lobe_graph *graph, lobe_resource lights) {
    size_t size;
    lobe_graph_read_back(graph, lights, (lobe_range){0});
    if (lobe_graph_execute(graph) != LOBE_OK)
        fail_msg("%s", c->f->error);
    const void *data = lobe_graph_data(graph, lights, &size);
    float *copy = malloc(size);
    assert_non_null(copy);
    return memcpy(copy, data, size);
}

static float *look_up(checked *c, uint32_t method, double kappa, uint32_t samples,
                      uint32_t rounds) {
    lobe_graph *graph;
    environment_maps cubes;
    environment_check_request request = begin(c, &graph, &cubes);
    request.method = method;
    request.concentration = kappa;
    request.samples = samples;
    request.rounds = rounds;
    return take(c, graph, environment_check_look_up(graph, &cubes, &request));
}

static float *add_up(checked *c, uint32_t first, uint32_t count) {
    lobe_graph *graph;
    environment_maps cubes;
    environment_check_request request = begin(c, &graph, &cubes);
    return take(c, graph,
                environment_check_exact(graph, &cubes, &request, concentrations, first, count));
}

// ---------------------------------------------------------------------------------------------

static void directions_cover_the_sphere_evenly(void **state) {
    (void)state;
    static float directions[1000][4];
    double second[3][3] = {{0}}, first[3] = {0};
    environment_check_directions(1000, directions);
    for (int i = 0; i < 1000; i++) {
        const float *d = directions[i];
        double length = sqrt((double)d[0] * d[0] + (double)d[1] * d[1] + (double)d[2] * d[2]);
        assert_true(fabs(length - 1) < 1e-6);
        for (int a = 0; a < 3; a++) {
            first[a] += d[a] / 1000.0;
            for (int b = 0; b < 3; b++)
                second[a][b] += (double)d[a] * d[b] / 1000.0;
        }
    }
    for (int a = 0; a < 3; a++) {
        assert_true(fabs(first[a]) < 1e-3);
        for (int b = 0; b < 3; b++)
            assert_true(fabs(second[a][b] - (a == b ? 1.0 / 3 : 0)) < 1e-3);
    }
}

static void add_reference(const checked *c, const lobe_image *face, int number, int direction,
                          double sums[CHECK_LOBES][3]) {
    const float *texel = face->texels;
    for (int i = 0; i < SIZE * SIZE; i++, texel += 4) {
        double towards[3], distance = 0;
        reference_cube_texel_direction(number, i % SIZE, i / SIZE, SIZE, towards);
        for (int k = 0; k < 3; k++)
            distance += pow((double)c->directions[direction][k] - towards[k], 2);
        double solid_angle = reference_cube_texel_solid_angle(i % SIZE, i / SIZE, SIZE);
        for (int lobe = 0; lobe < CHECK_LOBES; lobe++)
            for (int k = 0; k < 3; k++)
                sums[lobe][k] +=
                    solid_angle * (double)texel[k] * exp(-0.5 * concentrations[lobe] * distance);
    }
}

static void the_sum_is_exact(void **state) {
    checked c;
    start(*state, false, SIZE, &c);
    lobe_image faces[6];
    for (uint32_t i = 0; i < 6; i++)
        assert_int_equal(
            lobe_environment_maps_read(c.maps, LOBE_ENVIRONMENT_RADIANCE, 0, i, &faces[i]),
            LOBE_OK);
    float *found = add_up(&c, 0, 6 * SIZE * SIZE);
    for (int direction = 0; direction < DIRECTIONS; direction++) {
        double sums[CHECK_LOBES][3] = {{0}};
        for (int i = 0; i < 6; i++)
            add_reference(&c, &faces[i], i, direction, sums);
        for (int lobe = 0; lobe < CHECK_LOBES; lobe++)
            for (int k = 0; k < 3; k++) {
                double expected = sums[lobe][k];
                double value = (double)found[4 * (lobe * DIRECTIONS + direction) + k];
                assert_true(fabs(value - expected) <= 3e-5 * expected);
            }
    }
    free(found);
    for (int i = 0; i < 6; i++)
        lobe_image_free(&faces[i]);
    stop(&c);
}

static void parts_add_up(void **state) {
    checked c;
    start(*state, false, SIZE, &c);
    const uint32_t total = 6 * SIZE * SIZE, first = 5 * CHECK_GROUP_SIZE;
    float *all = add_up(&c, 0, total), *a = add_up(&c, 0, first);
    float *b = add_up(&c, first, total - first);
    for (int i = 0; i < 4 * DIRECTIONS * CHECK_LOBES; i++)
        assert_true(fabsf(a[i] + b[i] - all[i]) <= 1e-5f * all[i]);
    free(all);
    free(a);
    free(b);
    stop(&c);
}

/// Every lobe receives uniform light unchanged.
static void constant_light_is_preserved(void **state) {
    checked c;
    start(*state, true, 64, &c);
    const uint32_t methods[] = {METHOD_PREFILTERED, METHOD_BLENDED, METHOD_MIP, METHOD_SAMPLED,
                                METHOD_SAMPLED};
    for (int method = 0; method < 5; method++) {
        for (int lobe = 0; lobe < CHECK_LOBES; lobe++) {
            float *lights =
                look_up(&c, methods[method], concentrations[lobe], method == 4 ? 1 : 32, 2);
            for (int i = 0; i < 2 * DIRECTIONS; i++)
                for (int k = 0; k < 3; k++)
                    assert_true(fabsf(lights[4 * i + k] - (float)(3 - k)) < 1e-5f * (float)(3 - k));
            free(lights);
        }
    }
    stop(&c);
}

/// Many samples are closer to the exact light than few.
static void samples_converge(void **state) {
    checked c;
    start(*state, false, SIZE, &c);
    float *sums = add_up(&c, 0, 6 * SIZE * SIZE);
    for (int lobe = 0; lobe < 4; lobe++) {
        double errors[2] = {0}, total = 0;
        for (int i = 0; i < 2; i++) {
            float *lights =
                look_up(&c, METHOD_SAMPLED, concentrations[lobe], i == 0 ? 32 : 8192, 1);
            for (int k = 0; k < 4 * DIRECTIONS; k++) {
                double exact = environment_check_peak(concentrations[lobe]) *
                               (double)sums[4 * lobe * DIRECTIONS + k];
                errors[i] += pow((double)lights[k] - exact, 2);
                total += i == 0 ? exact * exact : 0;
            }
            free(lights);
        }
        double few = sqrt(errors[0] / total), many = sqrt(errors[1] / total);
        if (!(many < 0.05 && many < few))
            fail_msg("kappa %g: %g with 32 samples, %g with many", concentrations[lobe], few, many);
    }
    free(sums);
    stop(&c);
}

static int create(void **state) {
    fixture_create(state);
    fixture *f = *state;
    return environment_check_add_shaders(f->device) == LOBE_OK ? 0 : 1;
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(directions_cover_the_sphere_evenly),
        cmocka_unit_test(the_sum_is_exact),
        cmocka_unit_test(parts_add_up),
        cmocka_unit_test(constant_light_is_preserved),
        cmocka_unit_test(samples_converge),
    };
    return cmocka_run_group_tests(tests, create, fixture_destroy);
}
