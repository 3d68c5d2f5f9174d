// Normals that are made from height maps: those of an independent formula, in pictures of every
// filter, also after changes; and displaced geometry lit as a mesh that was displaced on the host.

#include "passes/upload/heights/height_normals.h"

#include <math.h>
#include <string.h>

#include "scenes/mesh/mesh.h"
#include "scenes/mesh/shape.h"
#include "scenes/scene/scene.h"
#include "tests/passes/support/picture.h"
#include "tests/passes/support/scene_builder.h"

enum { WIDTH = 48, HEIGHT = 24 };

/// A smooth relief of two waves, which repeats; between 0 and 1.
static double wave(double u, double v) {
    return 0.5 + 0.25 * sin(2 * M_PI * (2 * u + v)) + 0.2 * cos(2 * M_PI * (u - 2 * v));
}

static lobe_image wave_heights(double factor) {
    lobe_image image = map_image(LOBE_FORMAT_RGBA32_FLOAT, WIDTH, HEIGHT);
    for (int i = 0; i < WIDTH * HEIGHT; i++)
        ((float *)image.texels)[4 * i] =
            (float)(factor * wave((i % WIDTH + 0.5) / WIDTH, (i / WIDTH + 0.5) / HEIGHT));
    return image;
}

/// The same relief's normals: differences of neighbours, in double precision.
static lobe_image wave_normals(double scale) {
    lobe_image image = map_image(LOBE_FORMAT_RGBA32_FLOAT, WIDTH, HEIGHT);
    float *texel = image.texels;
    for (int i = 0; i < WIDTH * HEIGHT; i++, texel += 4) {
        const double u = (i % WIDTH + 0.5) / WIDTH, v = (i / WIDTH + 0.5) / HEIGHT;
        const double across = 0.5 * WIDTH * (wave(u + 1.0 / WIDTH, v) - wave(u - 1.0 / WIDTH, v));
        const double down = 0.5 * WIDTH * (wave(u, v + 1.0 / HEIGHT) - wave(u, v - 1.0 / HEIGHT));
        const double length = sqrt(1 + scale * scale * (across * across + down * down));
        texel[0] = (float)(0.5 - 0.5 * scale * across / length);
        texel[1] = (float)(0.5 + 0.5 * scale * down / length);
        texel[2] = (float)(0.5 + 0.5 / length);
    }
    return image;
}

/// Two tiles across the square, whose texels are square.
static void add_square(lobe_scene *scene, const lobe_material *material) {
    scene_add_square(scene, material, 2, NULL);
    for (int i = 0; i < 4; i++)
        scene->meshes[0].vertices[i].texture_coordinates[0][1] *= (float)WIDTH / HEIGHT;
}

static void light_and_look(lobe_scene *scene) {
    scene_add_sun(scene, (double[]){0.5, 1, 0.3}, 2);
    scene_look_down(scene, 2);
    scene_end(scene);
}

static lobe_scene *height_scene(float scale) {
    lobe_scene *scene = scene_begin();
    lobe_material material = microfacet_material(LOBE_DISTRIBUTION_GGX, 0.5, 0.3);
    material.height_map = scene_add_map(scene, wave_heights(1));
    material.height_scale = scale;
    add_square(scene, &material);
    light_and_look(scene);
    return scene;
}

static lobe_scene *normal_scene(double scale) {
    lobe_scene *scene = scene_begin();
    lobe_material material = microfacet_material(LOBE_DISTRIBUTION_GGX, 0.5, 0.3);
    material.normal_map = scene_add_map(scene, wave_normals(scale));
    add_square(scene, &material);
    light_and_look(scene);
    return scene;
}

/// From the picture of a normal map; frees the frame.
static double difference_of(fixture *f, lobe_frame *frame, const picture_request *request,
                            double scale) {
    lobe_scene *expected_scene = normal_scene(scale);
    lobe_frame expected = draw_scene(f, expected_scene, request);
    const double difference = relative_l2(&frame->radiance, &expected.radiance);
    lobe_frame_free(&expected);
    lobe_frame_free(frame);
    lobe_scene_destroy(&expected_scene);
    return difference;
}

static void filters_see_the_normals_of_heights(void **state) {
    fixture *f = *state;
    static const char *const filters[] = {"direct", "mipmap", "leadr", "moments", "lobes"};
    for (int i = 0; i < 5; i++) {
        const picture_request request = {.filter = filters[i], .width = 24, .height = 24};
        for (int sign = -1; sign <= 1; sign += 2) {
            lobe_scene *scene = height_scene((float)sign * 0.08f);
            lobe_frame frame = draw_scene(f, scene, &request);
            const double same = difference_of(f, &frame, &request, sign * 0.08);
            // Between texels z is interpolated there, and follows from x and y here.
            if (same > 4e-3)
                fail_msg("%s: %g", filters[i], same);
            lobe_scene_destroy(&scene);
        }
    }
    lobe_scene *scene = height_scene(0.08f);
    const picture_request request = {.filter = "direct", .width = 24, .height = 24};
    lobe_frame frame = draw_scene(f, scene, &request);
    assert_true(difference_of(f, &frame, &request, 0.04) > 0.02);
    lobe_scene_destroy(&scene);
}

static void changes_reach_the_normals(void **state) {
    fixture *f = *state;
    const picture_request request = {.filter = "leadr", .width = 24, .height = 24};
    lobe_scene *scene = height_scene(0.08f);
    assert_int_equal(lobe_renderer_set_scene(f->renderer, scene), LOBE_OK);
    lobe_frame frame = draw_silently(f, scene->name, &request);
    lobe_frame_free(&frame);
    // Another factor.
    const uint32_t zero = 0;
    scene->materials[0].height_scale = 0.03f;
    assert_int_equal(
        lobe_renderer_update_scene(f->renderer,
                                   &(lobe_scene_changes){.materials = &zero, .material_count = 1}),
        LOBE_OK);
    frame = draw_silently(f, scene->name, &request);
    lobe_renderer *renderer = f->renderer;
    assert_int_equal(lobe_renderer_create(f->device, &f->host, &f->renderer), LOBE_OK);
    assert_true(difference_of(f, &frame, &request, 0.03) < 4e-3);
    // Other texels: half as high.
    for (int i = 0; i < 4 * WIDTH * HEIGHT; i++)
        ((float *)scene->images[0].image.texels)[i] *= 0.5f;
    assert_int_equal(lobe_renderer_update_scene(
                         renderer, &(lobe_scene_changes){.images = &zero, .image_count = 1}),
                     LOBE_OK);
    lobe_renderer *other = f->renderer;
    f->renderer = renderer;
    frame = draw_silently(f, scene->name, &request);
    assert_int_equal(lobe_renderer_set_scene(f->renderer, NULL), LOBE_OK);
    assert_true(difference_of(f, &frame, &request, 0.015) < 4e-3);
    lobe_renderer_destroy(&other);
    lobe_scene_destroy(&scene);
}

static void heights_that_are_no_numbers_are_errors(void **state) {
    fixture *f = *state;
    lobe_scene *scene = height_scene(0.08f);
    ((float *)scene->images[0].image.texels)[8] = NAN;
    fixture_forget_messages(f);
    assert_failure(f, lobe_renderer_set_scene(f->renderer, scene), LOBE_ERROR_MALFORMED, "map");
    lobe_scene_destroy(&scene);
}

static void edges_of_maps_are_wrapped(void **state) {
    (void)state;
    lobe_scene_image heights = {.image = map_image(LOBE_FORMAT_R32_FLOAT, 4, 1)};
    const float row[] = {0.1f, 0.5f, 0.3f, 0.9f};
    memcpy(heights.image.texels, row, sizeof row);
    static const double first[] = {0.5 - 0.9, 0.5 - 0.1, 0.5 - 0.1}; // before the first: 3, 0, 0
    for (int wrap = 0; wrap < 3; wrap++) {
        lobe_texture_use use = LOBE_TEXTURE_NONE;
        use.wrap_u = (lobe_scene_wrap)wrap;
        lobe_image normals;
        assert_int_equal(passes_height_normals_make(&heights, &use, 0.5f, NULL, &normals), LOBE_OK);
        const double slope = 0.5 * 4 * 0.5 * first[wrap];
        const int16_t *texel = normals.texels;
        assert_float_equal(texel[0] / 32767.0, -slope / sqrt(1 + slope * slope), 2e-5);
        assert_int_equal(texel[1], 0);
        lobe_image_free(&normals);
    }
    // However steep, a normal has a length.
    const lobe_texture_use use = LOBE_TEXTURE_NONE;
    lobe_image normals;
    assert_int_equal(passes_height_normals_make(&heights, &use, 3e38f, NULL, &normals), LOBE_OK);
    assert_int_equal(((int16_t *)normals.texels)[0], 32767);
    lobe_image_free(&normals);
    lobe_image_free(&heights.image);
}

/// A byte of each channel, of which only red is the height.
static lobe_image byte_heights(lobe_format format) {
    const bool is_bgra = format == LOBE_FORMAT_BGRA8_UNORM || format == LOBE_FORMAT_BGRA8_SRGB;
    lobe_image image = map_image(format, WIDTH, HEIGHT);
    unsigned char *texel = image.texels;
    for (int i = 0; i < WIDTH * HEIGHT; i++, texel += 4) {
        const double height = wave((i % WIDTH + 0.5) / WIDTH, (i / WIDTH + 0.5) / HEIGHT);
        for (int channel = 0; channel < 4; channel++)
            texel[channel] = (unsigned char)(37 * i + 11 * channel);
        texel[is_bgra ? 2 : 0] = (unsigned char)lround(255 * height);
    }
    return image;
}

/// IEC 61966-2-1, written again.
static double linear_of(double encoded) {
    return encoded <= 0.04045 ? encoded / 12.92 : pow((encoded + 0.055) / 1.055, 2.4);
}

/// What the device reads of such a map.
static lobe_image heights_of_bytes(bool is_srgb) {
    lobe_image image = map_image(LOBE_FORMAT_RGBA32_FLOAT, WIDTH, HEIGHT);
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        const double height = wave((i % WIDTH + 0.5) / WIDTH, (i / WIDTH + 0.5) / HEIGHT),
                     read = (double)lround(255 * height) / 255;
        ((float *)image.texels)[4 * i] = (float)(is_srgb ? linear_of(read) : read);
    }
    return image;
}

static lobe_frame draw_heights(fixture *f, lobe_image heights, const picture_request *request) {
    lobe_scene *scene = height_scene(0.08f);
    lobe_image_free(&scene->images[0].image);
    scene->images[0].image = heights;
    lobe_frame frame = draw_scene(f, scene, request);
    lobe_scene_destroy(&scene);
    return frame;
}

static void bytes_in_any_order_are_heights(void **state) {
    static const lobe_format formats[] = {LOBE_FORMAT_RGBA8_UNORM, LOBE_FORMAT_RGBA8_SRGB,
                                          LOBE_FORMAT_BGRA8_UNORM, LOBE_FORMAT_BGRA8_SRGB};
    static const picture_request request = {.filter = "leadr", .width = 24, .height = 24};
    fixture *f = *state;
    for (int i = 0; i < 4; i++) {
        lobe_frame expected = draw_heights(f, heights_of_bytes(i % 2), &request);
        lobe_frame frame = draw_heights(f, byte_heights(formats[i]), &request);
        const double error = relative_l2(&frame.radiance, &expected.radiance);
        if (!(error < 1e-4))
            fail_msg("%s: off by %g", lobe_format_name(formats[i]), error);
        lobe_frame_free(&expected);
        lobe_frame_free(&frame);
    }
}

// ---------------------------------------------------------------------------------------------
// The same surface as a mesh

/// A square of 2 m with two tiles of the waves, displaced on the host, each vertex with its normal.
static lobe_scene *displaced_scene(double scale) {
    enum { CELLS = 160 };
    lobe_scene *scene = scene_begin();
    lobe_material material = microfacet_material(LOBE_DISTRIBUTION_GGX, 0.5, 0.3);
    lobe_mesh mesh;
    uint32_t mesh_index, material_index;
    const uint32_t side = CELLS + 1;
    assert_int_equal(scenes_mesh_allocate(&mesh, "waves", side * side, 6 * CELLS * CELLS, NULL),
                     LOBE_OK);
    for (uint32_t i = 0; i < side * side; i++) {
        const double x = 2.0 * (i % side) / CELLS - 1, z = 2.0 * (i / side) / CELLS - 1;
        const double u = x + 1, v = z + 1, step = 1e-4; // a tile is a metre wide
        const double dx = scale * (wave(u + step, v) - wave(u - step, v)) / (2 * step),
                     dz = scale * (wave(u, v + step) - wave(u, v - step)) / (2 * step);
        const double length = sqrt(1 + dx * dx + dz * dz);
        mesh.vertices[i] = (lobe_scene_vertex){
            .position = {(float)x, (float)(scale * wave(u, v)), (float)z},
            .normal = {(float)(-dx / length), (float)(1 / length), (float)(-dz / length)},
            .tangent = {1, 0, 0, 1},
            .colour = {1, 1, 1, 1}};
    }
    scenes_shape_grid_indices(CELLS, CELLS, mesh.indices);
    scenes_mesh_compute_bounds(&mesh);
    assert_int_equal(scenes_add_mesh(scene, &mesh, NULL, &mesh_index), LOBE_OK);
    assert_int_equal(scenes_add_material(scene, "waves", &material, NULL, &material_index),
                     LOBE_OK);
    assert_int_equal(scenes_add_instance(scene, mesh_index, material_index, NULL, NULL), LOBE_OK);
    return scene;
}

/// Seen and lit at an angle, so that waves hide each other, and light comes from below the plane.
static void look_across(lobe_scene *scene) {
    scene_add_sun(scene, (double[]){1, 0.2, 0.3}, 2);
    scene_add_sun(scene, (double[]){-1, -0.1, 0.4}, 1);
    scene->camera = (lobe_camera){.eye = {0.3f, 0.7f, 1.6f},
                                  .target = {0, 0.05f, 0},
                                  .up = {0, 1, 0},
                                  .vertical_field_of_view = 0.9f,
                                  .near_plane = 0.01f};
    scene->has_camera = true;
    scene_end(scene);
}

static void displaced_geometry_is_lit_as_a_mesh(void **state) {
    fixture *f = *state;
    const float scale = 0.15f;
    lobe_scene *mesh = displaced_scene((double)scale);
    look_across(mesh);
    lobe_scene *scene = scene_begin();
    lobe_material material = microfacet_material(LOBE_DISTRIBUTION_GGX, 0.5, 0.3);
    lobe_image heights = map_image(LOBE_FORMAT_RGBA32_FLOAT, 256, 256);
    for (int i = 0; i < 256 * 256; i++)
        ((float *)heights.texels)[4 * i] =
            (float)wave((i % 256 + 0.5) / 256, (i / 256 + 0.5) / 256);
    material.height_map = scene_add_map(scene, heights);
    material.height_scale = scale;
    scene_add_square(scene, &material, 2, NULL);
    look_across(scene);
    picture_request request = {.filter = "reference", .width = 96, .height = 64, .samples = 16};
    lobe_frame expected = draw_scene(f, mesh, &request);
    request.settings[0] = "displacement=geometry";
    lobe_frame displaced = draw_scene(f, scene, &request);
    request.settings[0] = NULL;
    lobe_frame flat = draw_scene(f, scene, &request);
    const double error = relative_l2(&displaced.radiance, &expected.radiance),
                 flat_error = relative_l2(&flat.radiance, &expected.radiance);
    if (error > 0.03 || flat_error < 5 * error)
        fail_msg("displaced: %g, flat: %g", error, flat_error);
    lobe_frame_free(&expected);
    lobe_frame_free(&displaced);
    lobe_frame_free(&flat);
    lobe_scene_destroy(&scene);
    lobe_scene_destroy(&mesh);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(edges_of_maps_are_wrapped),
        cmocka_unit_test(filters_see_the_normals_of_heights),
        cmocka_unit_test(changes_reach_the_normals),
        cmocka_unit_test(bytes_in_any_order_are_heights),
        cmocka_unit_test(heights_that_are_no_numbers_are_errors),
        cmocka_unit_test(displaced_geometry_is_lit_as_a_mesh),
    };
    return cmocka_run_group_tests(tests, fixture_create_validated, fixture_destroy);
}
