// Pictures of maps that once went wrong, each for one cause, by "moments" at its defaults against
// the mean of many samples.

#include "tests/passes/support/fixture.h"

#include <math.h>

#include "scenes/builtin/random.h"
#include "tests/passes/support/picture.h"
#include "tests/passes/support/scene_builder.h"

enum { EXTENT = 16 };

/// The tilt of a normal towards +X, as a slope.
static void put_slope(lobe_image *image, uint32_t texel, double slope) {
    float *values = (float *)image->texels + (size_t)4 * texel;
    double length = sqrt(1 + slope * slope);
    values[0] = (float)(0.5 - 0.5 * slope / length);
    values[1] = 0.5f;
    values[2] = (float)(0.5 + 0.5 / length);
    values[3] = 1;
}

static lobe_texture_use add_nearest(lobe_scene *scene, lobe_image image) {
    lobe_texture_use use = scene_add_map(scene, image);
    use.nearest = true;
    return use;
}

static lobe_material metal(float roughness) {
    lobe_material material;
    lobe_material_default(&material);
    material.roughness = roughness;
    material.metallic = 1;
    return material;
}

static void finish(lobe_scene *scene, const lobe_material *material, double tiles, float view) {
    scene_add_square(scene, material, tiles, NULL);
    scene_add_sun(scene, (double[]){0, 1.2, -0.5}, 3);
    scene->camera = (lobe_camera){.eye = {0, 1.2f, 0.5f},
                                  .up = {0, 1, 0},
                                  .vertical_field_of_view = view,
                                  .near_plane = 0.01f};
    scene->has_camera = true;
    scene_end(scene);
}

/// Of each channel: the largest value, the mean; and the relative L2 error.
static void check(fixture *f, lobe_scene *scene, double most, double energy, double peak) {
    picture_request request = {
        .filter = "reference", .width = EXTENT, .height = EXTENT, .samples = 256};
    lobe_frame truth = draw_scene(f, scene, &request);
    request.filter = "moments";
    request.samples = 0;
    lobe_frame frame = draw_scene(f, scene, &request);
    double error = relative_l2(&frame.radiance, &truth.radiance);
    double highest = largest_value(&frame.radiance) / largest_value(&truth.radiance);
    for (uint32_t channel = 0; channel < 3; channel++) {
        double sums[2] = {0};
        for (uint32_t i = 0; i < EXTENT * EXTENT; i++) {
            sums[0] += (double)pixel_at(&frame.radiance, i % EXTENT, i / EXTENT)[channel];
            sums[1] += (double)pixel_at(&truth.radiance, i % EXTENT, i / EXTENT)[channel];
        }
        double mean = sums[0] / sums[1];
        print_message("# error %.3f, channel %u: mean %.3f, peak %.3f\n", error, channel, mean,
                      highest);
        if (!(error <= most && fabs(mean - 1) <= energy && fabs(highest - 1) <= peak))
            fail_msg("error %g, channel %u: %g of the energy; peak %g times as high", error,
                     channel, mean, highest);
    }
    lobe_frame_free(&frame);
    lobe_frame_free(&truth);
    lobe_scene_destroy(&scene);
}

/// Few texels of each period are tilted, and none where a coarse sample in step with it falls.
static void grooves_of_any_pitch(void **state) {
    enum { WIDTH = 768 };
    static const uint32_t pitches[] = {8, 12, 16};
    for (int i = 0; i < 3; i++) {
        lobe_scene *scene = scene_begin();
        lobe_image normals = map_image(LOBE_FORMAT_RGBA32_FLOAT, WIDTH, 64);
        for (uint32_t texel = 0; texel < WIDTH * 64; texel++) {
            uint32_t column = texel % WIDTH % pitches[i];
            put_slope(&normals, texel,
                      column == 3   ? 0.5
                      : column == 4 ? -0.5
                      : column == 1 ? 0.25
                                    : 0);
        }
        lobe_material material = metal(0.3f);
        material.normal_map = add_nearest(scene, normals);
        finish(scene, &material, 4, 0.5f);
        check(*state, scene, 0.08, 0.05, 0.15);
    }
}

/// Independent texels, of which interpolation leaves 4/9 of the variance.
static void interpolated_noise(void **state) {
    enum { WIDTH = 128 };
    static const double slopes[] = {0.2, 0.45};
    for (int i = 0; i < 2; i++) {
        random_sequence sequence = scenes_random_start(5);
        lobe_scene *scene = scene_begin();
        lobe_image normals = map_image(LOBE_FORMAT_RGBA32_FLOAT, WIDTH, WIDTH);
        for (uint32_t texel = 0; texel < WIDTH * WIDTH; texel++)
            put_slope(&normals, texel, scenes_random_between(&sequence, -slopes[i], slopes[i]));
        lobe_material material = metal(0.3f);
        material.normal_map = scene_add_map(scene, normals);
        finish(scene, &material, 4, 0.5f);
        check(*state, scene, 0.15, 0.05, 0.15);
    }
}

/// One texel in 500 is a deep scratch.
static void scratched_polish(void **state) {
    enum { WIDTH = 128 };
    random_sequence sequence = scenes_random_start(77);
    lobe_scene *scene = scene_begin();
    lobe_image normals = map_image(LOBE_FORMAT_RGBA32_FLOAT, WIDTH, WIDTH);
    for (uint32_t texel = 0; texel < WIDTH * WIDTH; texel++) {
        bool scratch = scenes_random_between(&sequence, 0, 1) < 0.002;
        put_slope(&normals, texel, scratch ? scenes_random_between(&sequence, -2, 2) : 0);
    }
    lobe_material material = metal(0.06f);
    material.normal_map = add_nearest(scene, normals);
    finish(scene, &material, 128, 0.06f);
    check(*state, scene, 0.1, 0.05, 0.15);
}

/// Red facets to one side, blue ones to the other, all of them metal.
static void coloured_facets(void **state) {
    enum { WIDTH = 64 };
    lobe_scene *scene = scene_begin();
    lobe_image normals = map_image(LOBE_FORMAT_RGBA32_FLOAT, WIDTH, WIDTH);
    lobe_image colours = constant_map(WIDTH, WIDTH, 0.8f, 0.05f, 0.02f);
    for (uint32_t texel = 0; texel < WIDTH * WIDTH; texel++) {
        bool right = texel % WIDTH / 2 % 2 == 1;
        put_slope(&normals, texel, right ? 0.5 : -0.45);
        float *colour = (float *)colours.texels + (size_t)4 * texel;
        colour[0] = right ? 0.02f : 0.8f;
        colour[2] = right ? 0.9f : 0.02f;
    }
    lobe_material material = metal(0.5f);
    material.normal_map = add_nearest(scene, normals);
    material.base_colour_map = add_nearest(scene, colours);
    finish(scene, &material, 16, 0.5f);
    check(*state, scene, 0.13, 0.05, 0.15);
}

/// Stripes of metal and paint, under the colour of the mesh.
static void tinted_stripes(void **state) {
    enum { WIDTH = 64 };
    lobe_scene *scene = scene_begin();
    lobe_image parameters = constant_map(WIDTH, WIDTH, 1, 0.4f, 0);
    for (uint32_t texel = 0; texel < WIDTH * WIDTH; texel++)
        ((float *)parameters.texels)[4 * texel + 2] = texel % WIDTH / 2 % 3 == 0 ? 1 : 0;
    lobe_material material = metal(1);
    material.metallic_roughness_map = add_nearest(scene, parameters);
    finish(scene, &material, 32, 0.5f);
    static const float tint[3] = {0.08f, 1, 0.3f};
    scene->meshes[0].has_colour = true;
    for (size_t i = 0; i < scene->meshes[0].vertex_count; i++)
        for (int j = 0; j < 3; j++)
            scene->meshes[0].vertices[i].colour[j] = tint[j];
    check(*state, scene, 0.1, 0.05, 0.15);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(grooves_of_any_pitch), cmocka_unit_test(interpolated_noise),
        cmocka_unit_test(scratched_polish),     cmocka_unit_test(coloured_facets),
        cmocka_unit_test(tinted_stripes),
    };
    return cmocka_run_group_tests(tests, fixture_create, fixture_destroy);
}
