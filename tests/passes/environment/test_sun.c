// A sun of two texels, 1e5 times as bright as its surroundings: through the whole renderer, no
// method loses or adds light, and none shows a pixel that is too bright.

#include "tests/passes/support/fixture.h"

#include <math.h>
#include <string.h>

#include "scenes/environment/direction.h"
#include "tests/passes/support/picture.h"
#include "tests/passes/support/scene_builder.h"

enum { WIDTH = 64, HEIGHT = 32, EXTENT = 12 };

/// Towards the sun; the camera sees its reflection in the middle of the picture.
static const double sun[3] = {0, 0.8, -0.6};
static const double albedo = 0.7;

static void surround(lobe_scene *scene) {
    lobe_image image = map_image(LOBE_FORMAT_RGBA32_FLOAT, WIDTH, HEIGHT);
    float *texels = image.texels;
    for (size_t i = 0; i < (size_t)4 * WIDTH * HEIGHT; i++)
        texels[i] = 1;
    scene_set_environment(scene, image);
    double position[2];
    assert_true(lobe_environment_position(scene->environment, sun, position));
    size_t first = (size_t)position[1] * WIDTH + ((size_t)position[0] + WIDTH - 1) % WIDTH;
    size_t second = (size_t)position[1] * WIDTH + (size_t)position[0] % WIDTH;
    assert_true(first != second);
    for (int i = 0; i < 3; i++)
        texels[4 * first + i] = texels[4 * second + i] = 1e5f;
}

/// A square under that sun, near and far at once.
static lobe_scene *square(const lobe_material *material) {
    lobe_scene *scene = scene_begin();
    scene_add_square(scene, material, 1, NULL);
    surround(scene);
    scene->camera = (lobe_camera){.eye = {0, 0.96f, 0.72f},
                                  .up = {0, 1, 0},
                                  .vertical_field_of_view = 0.7f,
                                  .near_plane = 0.01f};
    scene->has_camera = true;
    scene_end(scene);
    return scene;
}

static lobe_scene *metal_square(float roughness) {
    lobe_material material;
    lobe_material_default(&material);
    material.roughness = roughness;
    material.metallic = 1;
    return square(&material);
}

static lobe_scene *diffuse_square(void) {
    lobe_material material = half_vector_material(LOBE_DISTRIBUTION_VMF, 20);
    for (int i = 0; i < 3; i++) {
        material.base_colour[i] = (float)albedo;
        material.lobes[0].colour[i] = 0;
    }
    return square(&material);
}

typedef struct method {
    const char *filter, *knob;
    /// Largest relative deviation of all light in the picture, of diffuse surfaces and of metal;
    /// largest excess of a pixel over the brightest of the exact picture, of both.
    double diffuse, metal, diffuse_excess, metal_excess;
} method;

// Measured: of diffuse surfaces -0.002, -0.009, -0.009 and -0.001, pixels of the reference at most
// 0.014 brighter. Metal of roughness 0.35 and 0.5: prefiltered -0.056 and +0.120, its brightest
// pixel +0.020 and +0.073: lobes that keep the mean of all light are not exact for a sun alone;
// sampled -0.045 and -0.027, -0.018 and -0.071; the reference -0.002 and -0.001, -0.020 and +0.001.
static const method methods[] = {
    {"direct", "env=exact", 0.005, 0, 0, 0},
    {"direct", "env=prefiltered", 0.02, 0.14, 0, 0.09},
    {"direct", "env=sampled", 0.02, 0.07, 0, 0.02},
    {"reference", "env=exact", 0.005, 0.01, 0.03, 0.02},
};

static lobe_frame draw_by(fixture *f, const lobe_scene *scene, const method *method) {
    picture_request request = {.filter = method->filter,
                               .settings = {method->knob, "env_size=64"},
                               .width = EXTENT,
                               .height = EXTENT,
                               .samples = 256};
    return draw_scene(f, scene, &request);
}

static double light_of(const lobe_frame *frame) {
    double sum = 0;
    for (uint32_t i = 0; i < EXTENT * EXTENT; i++)
        sum += (double)pixel_at(&frame->radiance, i % EXTENT, i / EXTENT)[1];
    return sum / (EXTENT * EXTENT);
}

/// What a Lambertian surface that faces up reflects: the sum over the image's texels.
static double lambert(const lobe_environment *environment) {
    double irradiance = 0;
    for (uint32_t y = 0; y < HEIGHT; y++) {
        for (uint32_t x = 0; x < WIDTH; x++) {
            double direction[3];
            assert_true(scenes_environment_direction(LOBE_ENVIRONMENT_LATITUDE_LONGITUDE, WIDTH,
                                                     HEIGHT, (double[]){x + 0.5, y + 0.5},
                                                     direction));
            irradiance += (double)((float *)environment->image.texels)[4 * (y * WIDTH + x)] *
                          fmax(direction[1], 0) *
                          scenes_environment_solid_angle(LOBE_ENVIRONMENT_LATITUDE_LONGITUDE, WIDTH,
                                                         HEIGHT, x, y, x + 1, y + 1);
        }
    }
    return albedo * irradiance / 3.14159265358979323846;
}

static void diffuse_surfaces_lose_no_light(void **state) {
    lobe_scene *scene = diffuse_square();
    double expected = lambert(scene->environment);
    assert_true(expected > 50 * albedo);
    for (size_t i = 0; i < sizeof methods / sizeof *methods; i++) {
        lobe_frame frame = draw_by(*state, scene, &methods[i]);
        double found = light_of(&frame) / expected - 1;
        double excess = largest_value(&frame.radiance) / expected - 1;
        print_message("# diffuse, %s, %s: %+.4f, brightest %+.4f\n", methods[i].filter,
                      methods[i].knob, found, excess);
        if (!(fabs(found) <= methods[i].diffuse && excess <= methods[i].diffuse_excess))
            fail_msg("%s, %s: %+g, brightest %+g", methods[i].filter, methods[i].knob, found,
                     excess);
        lobe_frame_free(&frame);
    }
    lobe_scene_destroy(&scene);
}

static void check_metal(fixture *f, float roughness) {
    lobe_scene *scene = metal_square(roughness);
    lobe_frame exact = draw_by(f, scene, &methods[0]);
    double light = light_of(&exact), brightest = largest_value(&exact.radiance);
    assert_true(brightest > 1.5 * light);
    for (size_t i = 1; i < sizeof methods / sizeof *methods; i++) {
        lobe_frame frame = draw_by(f, scene, &methods[i]);
        double found = light_of(&frame) / light - 1;
        double excess = largest_value(&frame.radiance) / brightest - 1;
        print_message("# roughness %g, %s, %s: %+.4f, brightest %+.4f, %.4f off\n",
                      (double)roughness, methods[i].filter, methods[i].knob, found, excess,
                      relative_l2(&frame.radiance, &exact.radiance));
        if (!(fabs(found) <= methods[i].metal && excess <= methods[i].metal_excess))
            fail_msg("roughness %g, %s, %s: %+g, brightest %+g", (double)roughness,
                     methods[i].filter, methods[i].knob, found, excess);
        lobe_frame_free(&frame);
    }
    lobe_frame_free(&exact);
    lobe_scene_destroy(&scene);
}

static void rough_metal_shows_no_fireflies(void **state) {
    check_metal(*state, 0.35f);
    check_metal(*state, 0.5f);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(diffuse_surfaces_lose_no_light),
        cmocka_unit_test(rough_metal_shows_no_fireflies),
    };
    return cmocka_run_group_tests(tests, fixture_create, fixture_destroy);
}
