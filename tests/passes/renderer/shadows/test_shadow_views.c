// How lights see the scene: what is received fills their pictures.

#include "passes/renderer/shadows/shadow_views.h"

#include <math.h>

#include "tests/engine/support/cmocka_all.h"

enum { EXTENT = 1024 };

/// Bounds in clip space of a box's corners.
static void bounds_in_view(const lobe_light *light, const shadow_receivers *receivers,
                           const float place[2], float low[2], float high[2]) {
    mat4 matrix;
    const shadow_camera view = passes_shadow_view(light, 0, receivers, EXTENT);
    passes_shadow_projection(&view, receivers, EXTENT, place, matrix);
    low[0] = low[1] = INFINITY;
    high[0] = high[1] = -INFINITY;
    for (int i = 0; i < 8; i++) {
        vec4 clip, corner = {receivers->corners[i][0], receivers->corners[i][1],
                             receivers->corners[i][2], 1};
        glm_mat4_mulv(matrix, corner, clip);
        assert_true(clip[3] == 1 && clip[2] >= 0 && clip[2] <= 1);
        for (int k = 0; k < 2; k++) {
            low[k] = fminf(low[k], clip[k]);
            high[k] = fmaxf(high[k], clip[k]);
        }
    }
}

static shadow_receivers box(const float minimum[3], const float maximum[3]) {
    shadow_receivers result;
    for (int i = 0; i < 3; i++) {
        result.minimum[i] = minimum[i];
        result.maximum[i] = maximum[i];
        for (int k = 0; k < 8; k++)
            result.corners[k][i] = k >> i & 1 ? maximum[i] : minimum[i];
    }
    return result;
}

/// Each way, but for a border and the step to the next size, 9 %, and centred to a texel.
static void pictures_are_full(void **state) {
    static const float directions[][3] = {
        {0, -1, 0}, {1, -1, 0}, {1, -0.05f, 0.3f}, {-0.2f, -1e-3f, 1}, {0.4f, 0.7f, -0.3f}};
    static const float boxes[][2][3] = {{{-3, 0, -2}, {5, 0.1f, 4}},
                                        {{-300, -1, 20}, {100, 40, 21}},
                                        {{0.001f, 0.002f, 0.003f}, {0.002f, 0.0021f, 0.004f}}};
    (void)state;
    for (size_t i = 0; i < sizeof directions / sizeof *directions; i++)
        for (size_t k = 0; k < sizeof boxes / sizeof *boxes; k++) {
            lobe_light light = {.type = LOBE_LIGHT_DIRECTIONAL};
            for (int n = 0; n < 3; n++)
                light.direction[n] = directions[i][n];
            const shadow_receivers receivers = box(boxes[k][0], boxes[k][1]);
            float low[2], high[2];
            bounds_in_view(&light, &receivers, (float[]){0.5f, 0.5f}, low, high);
            for (int n = 0; n < 2; n++) {
                const float texel = 2.0f / EXTENT;
                if (!(low[n] > -1 + 2 * texel && high[n] < 1 - 2 * texel && //
                      high[n] - low[n] > 1.8f && fabsf(low[n] + high[n]) < 3 * texel))
                    fail_msg("light %zu, box %zu, axis %d: from %g to %g", i, k, n, (double)low[n],
                             (double)high[n]);
            }
        }
}

/// A place within a texel moves all by as much of a texel, each way.
static void places_move_by_parts_of_texels(void **state) {
    const lobe_light light = {.type = LOBE_LIGHT_DIRECTIONAL, .direction = {1, -0.05f, 0.3f}};
    const shadow_receivers receivers = box((float[]){-3, 0, -2}, (float[]){5, 0.1f, 4});
    float low[2][2], high[2];
    (void)state;
    bounds_in_view(&light, &receivers, (float[]){0.5f, 0.5f}, low[0], high);
    bounds_in_view(&light, &receivers, (float[]){0.25f, 0.875f}, low[1], high);
    assert_float_equal(fabsf(low[1][0] - low[0][0]), 0.25 * 2 / EXTENT, 2e-6);
    assert_float_equal(fabsf(low[1][1] - low[0][1]), 0.375 * 2 / EXTENT, 2e-6);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pictures_are_full),
        cmocka_unit_test(places_move_by_parts_of_texels),
    };
    return cmocka_run_group_tests_name("shadow_views", tests, NULL, NULL);
}
