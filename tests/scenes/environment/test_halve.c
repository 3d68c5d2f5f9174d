// Halved images give the same light.

#include "tests/engine/support/cmocka_all.h"

#include <math.h>
#include <string.h>

#include "scenes/builtin/random.h"
#include "scenes/environment/direction.h"
#include "scenes/environment/environment.h"
#include "scenes/environment/halve.h"

typedef struct shape {
    lobe_environment_layout layout;
    uint32_t width, height, halved_width, halved_height;
} shape;

static const shape shapes[] = {
    {LOBE_ENVIRONMENT_LATITUDE_LONGITUDE, 16, 8, 8, 4},
    {LOBE_ENVIRONMENT_LATITUDE_LONGITUDE, 17, 9, 8, 4},
    {LOBE_ENVIRONMENT_LATITUDE_LONGITUDE, 7, 5, 3, 2},
    {LOBE_ENVIRONMENT_LATITUDE_LONGITUDE, 3, 1, 1, 1},
    {LOBE_ENVIRONMENT_LATITUDE_LONGITUDE, 1, 6, 1, 3},
    {LOBE_ENVIRONMENT_CUBE_COLUMN, 8, 48, 4, 24},
    {LOBE_ENVIRONMENT_CUBE_COLUMN, 7, 42, 3, 18},
    {LOBE_ENVIRONMENT_CUBE_ROW, 30, 5, 12, 2},
    {LOBE_ENVIRONMENT_VERTICAL_CROSS, 15, 20, 6, 8},
    {LOBE_ENVIRONMENT_HORIZONTAL_CROSS, 12, 9, 4, 3},
};

static lobe_environment *environment_of(const shape *s) {
    lobe_environment *environment;
    assert_int_equal(scenes_environment_allocate("e", NULL, &environment), LOBE_OK);
    environment->layout = s->layout;
    assert_int_equal(lobe_image_allocate(&environment->image, LOBE_FORMAT_RGBA32_FLOAT, s->width,
                                         s->height, NULL),
                     LOBE_OK);
    random_sequence random = scenes_random_start(3);
    float *texels = environment->image.texels;
    for (size_t i = 0; i < 4 * (size_t)s->width * s->height; i++)
        texels[i] = (float)pow(scenes_random_between(&random, 0.1, 3), 6);
    return environment;
}

// The light of a channel, and the position of its centre.
static void moments(const lobe_environment *environment, int channel, double out[4]) {
    const lobe_image *image = &environment->image;
    memset(out, 0, 4 * sizeof *out);
    for (uint32_t y = 0; y < image->height; y++) {
        for (uint32_t x = 0; x < image->width; x++) {
            const float *texel = (const float *)image->texels + 4 * ((size_t)y * image->width + x);
            double direction[3];
            if (!scenes_environment_direction(environment->layout, image->width, image->height,
                                              (double[2]){x + 0.5, y + 0.5}, direction))
                continue;
            const double light = texel[channel] * scenes_environment_solid_angle(
                                                      environment->layout, image->width,
                                                      image->height, x, y, x + 1.0, y + 1.0);
            out[3] += light;
            for (int i = 0; i < 3; i++)
                out[i] += light * direction[i];
        }
    }
}

static void no_light_is_lost(void **state) {
    (void)state;
    for (size_t i = 0; i < sizeof shapes / sizeof *shapes; i++) {
        lobe_environment *environment = environment_of(&shapes[i]);
        double before[4], after[4];
        for (int channel = 0; channel < 3; channel++) {
            lobe_environment *halved = environment_of(&shapes[i]);
            moments(environment, channel, before);
            scenes_environment_halve(halved);
            moments(halved, channel, after);
            assert_int_equal(halved->image.width, shapes[i].halved_width);
            assert_int_equal(halved->image.height, shapes[i].halved_height);
            assert_true(fabs(after[3] / before[3] - 1) < 1e-6);
            lobe_environment_destroy(&halved);
        }
        lobe_environment_destroy(&environment);
    }
}

// A texel with even extents: the mean of four, written out.
static void four_texels_become_their_mean(void **state) {
    (void)state;
    const shape s = {LOBE_ENVIRONMENT_CUBE_ROW, 24, 4, 12, 2};
    lobe_environment *environment = environment_of(&s);
    double sum = 0, weights = 0;
    for (uint32_t k = 0; k < 4; k++) {
        const uint32_t x = 10 + k % 2, y = 2 + k / 2; // of the third face
        const double weight =
            scenes_environment_solid_angle(s.layout, s.width, s.height, x, y, x + 1.0, y + 1.0);
        sum += weight * ((const float *)environment->image.texels)[4 * (y * s.width + x) + 1];
        weights += weight;
    }
    scenes_environment_halve(environment);
    const float *halved = environment->image.texels;
    assert_true(fabs(halved[4 * (1 * 12 + 5) + 1] / (sum / weights) - 1) < 1e-6);
    lobe_environment_destroy(&environment);
}

static void evenness_stays_even(void **state) {
    (void)state;
    for (size_t i = 0; i < sizeof shapes / sizeof *shapes; i++) {
        lobe_environment *environment = environment_of(&shapes[i]);
        float *texels = environment->image.texels;
        for (size_t k = 0; k < 4 * (size_t)shapes[i].width * shapes[i].height; k++)
            texels[k] = 0.7f;
        scenes_environment_halve(environment);
        const lobe_image *image = &environment->image;
        texels = image->texels;
        for (uint32_t k = 0; k < image->width * image->height; k++) {
            double direction[3];
            const double middle[2] = {k % image->width + 0.5, k / image->width + 0.5};
            if (scenes_environment_direction(environment->layout, image->width, image->height,
                                             middle, direction))
                assert_true(fabsf(texels[4 * k] - 0.7f) < 1e-6f);
            else
                assert_true(texels[4 * k] == 0);
        }
        lobe_environment_destroy(&environment);
    }
}

// Light from one side stays on that side: no other texel gets any.
static void light_stays_in_its_place(void **state) {
    (void)state;
    const shape big[2] = {{LOBE_ENVIRONMENT_LATITUDE_LONGITUDE, 129, 65, 64, 32},
                          {LOBE_ENVIRONMENT_HORIZONTAL_CROSS, 4 * 33, 3 * 33, 64, 48}};
    for (int i = 0; i < 2; i++) {
        lobe_environment *environment = environment_of(&big[i]);
        memset(environment->image.texels, 0, 16 * (size_t)big[i].width * big[i].height);
        const double direction[3] = {0.6, 0.48, 0.64};
        double position[2], after[4];
        scenes_environment_position(big[i].layout, big[i].width, big[i].height, direction,
                                    position);
        ((float *)environment->image
             .texels)[4 * ((size_t)position[1] * big[i].width + (size_t)position[0])] = 1000;
        scenes_environment_halve(environment);
        moments(environment, 0, after);
        double cosine = 0;
        for (int axis = 0; axis < 3; axis++)
            cosine += after[axis] / after[3] * direction[axis];
        assert_true(cosine > cos(0.08));
        lobe_environment_destroy(&environment);
    }
}

static void an_environment_shrinks_to_what_is_allowed(void **state) {
    (void)state;
    for (size_t i = 0; i < sizeof shapes / sizeof *shapes; i++) {
        lobe_environment *environment = environment_of(&shapes[i]);
        lobe_environment_shrink(environment, 65535);
        assert_int_equal(environment->image.width, shapes[i].width);
        lobe_environment_shrink(environment, 8);
        assert_true(environment->image.width <= 8 && environment->image.height <= 8);
        assert_true(scenes_environment_layout_fits(shapes[i].layout, environment->image.width,
                                                   environment->image.height));
        lobe_environment_shrink(environment, 1); // as far as possible
        assert_false(scenes_environment_can_be_halved(environment));
        lobe_environment_destroy(&environment);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(no_light_is_lost),
        cmocka_unit_test(four_texels_become_their_mean),
        cmocka_unit_test(evenness_stays_even),
        cmocka_unit_test(light_stays_in_its_place),
        cmocka_unit_test(an_environment_shrinks_to_what_is_allowed),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
