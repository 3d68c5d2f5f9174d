// Image-based lights of glTF files (EXT_lights_image_based).

#include "tests/scenes/gltf/gltf_fixture.h"

#include <math.h>
#include <png.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <lobe/colour.h>

#include "scenes/environment/direction.h"

static void write_png(const gltf_fixture *fixture, const char *name, uint32_t width,
                      uint32_t height, const uint8_t *texels, bool alpha) {
    png_image image = {.version = PNG_IMAGE_VERSION,
                       .width = width,
                       .height = height,
                       .format = alpha ? PNG_FORMAT_RGBA : PNG_FORMAT_RGB};
    assert_true(
        png_image_write_to_file(&image, gltf_fixture_path(fixture, name), 0, texels, 0, NULL));
}

// Face f is 2 x 2 texels: red encodes the face, green the texel.
static void write_faces(const gltf_fixture *fixture) {
    for (uint8_t face = 0; face < 6; face++) {
        uint8_t texels[12];
        char name[16];
        for (uint8_t i = 0; i < 4; i++)
            memcpy(texels + 3 * i, (uint8_t[3]){(uint8_t)(40 * face + 10), (uint8_t)(60 * i), 255},
                   3);
        snprintf(name, sizeof name, "%u.png", face);
        write_png(fixture, name, 2, 2, texels, false);
    }
}

static const char images[] = "{\"uri\":\"0.png\"},{\"uri\":\"1.png\"},{\"uri\":\"2.png\"},"
                             "{\"uri\":\"3.png\"},{\"uri\":\"4.png\"},{\"uri\":\"5.png\"}";
static const char all_faces[] = "\"specularImages\":[[0,1,2,3,4,5],[0,0,0,0,0,0]]";

// A triangle, lit by light `index` of `lights`.
static void write_file(const gltf_fixture *fixture, const char *lights, int index) {
    char json[4096];
    snprintf(json, sizeof json,
             "{\"asset\":{\"version\":\"2.0\"},\"extensionsUsed\":[\"EXT_lights_image_based\"],"
             "\"extensionsRequired\":[\"EXT_lights_image_based\"],\"extensions\":"
             "{\"EXT_lights_image_based\":{\"lights\":[%s]}},\"scenes\":[{\"nodes\":[]},"
             "{\"nodes\":[0],\"extensions\":{\"EXT_lights_image_based\":{\"light\":%d}}}],"
             "\"scene\":1,\"images\":[%s],\"nodes\":[{\"mesh\":0}],\"meshes\":[{\"primitives\":"
             "[{\"attributes\":{\"POSITION\":0}}]}],\"buffers\":[{\"byteLength\":36}],"
             "\"bufferViews\":[{\"buffer\":0,\"byteLength\":36}],\"accessors\":[{"
             "\"bufferView\":0,\"componentType\":5126,\"type\":\"VEC3\",\"count\":3}]}",
             lights, index, images);
    gltf_fixture_write_glb(fixture, "lit.glb", json, gltf_fixture_triangle.data, 36);
}

static lobe_scene *open_lit(gltf_fixture *fixture, const char *members) {
    char light[1024];
    snprintf(light, sizeof light, "{%s%s}", all_faces, members);
    write_file(fixture, light, 0);
    return gltf_fixture_must_open(fixture, "lit.glb");
}

static const float *texel_at(const lobe_environment *environment, const double direction[3]) {
    const lobe_image *image = &environment->image;
    double position[2];
    scenes_environment_position(environment->layout, image->width, image->height, direction,
                                position);
    return (const float *)image->texels +
           4 * ((size_t)position[1] * image->width + (size_t)position[0]);
}

// The first level alone lights the scene, and no light is added.
static void faces_look_where_the_extension_says(void **state) {
    gltf_fixture *fixture = *state;
    write_faces(fixture);
    lobe_scene *scene = open_lit(fixture, "");
    assert_int_equal(fixture->warnings, 0);
    assert_int_equal(fixture->notices, 1); // the camera
    assert_int_equal(scene->light_count, 0);
    assert_int_equal(scene->image_count, 0);
    const lobe_environment *environment = scene->environment;
    assert_non_null(environment);
    assert_true(environment->intensity == 1);
    // The standard orientation of cube maps: the directions in which u and v of each face grow;
    // then the images are flipped about their vertical axis.
    static const double u[6][3] = {{0, 0, -1}, {0, 0, 1}, {1, 0, 0},
                                   {1, 0, 0},  {1, 0, 0}, {-1, 0, 0}};
    static const double v[6][3] = {{0, -1, 0}, {0, -1, 0}, {0, 0, 1},
                                   {0, 0, -1}, {0, -1, 0}, {0, -1, 0}};
    for (int face = 0; face < 6; face++) {
        for (int i = 0; i < 4; i++) {
            double d[3] = {0, 0, 0};
            d[face / 2] = face % 2 ? -1 : 1;
            for (int axis = 0; axis < 3; axis++)
                d[axis] +=
                    0.5 * ((i % 2 ? -1 : 1) * u[face][axis] + (i / 2 ? 1 : -1) * v[face][axis]);
            const float *texel = texel_at(environment, d);
            const float expected[3] = {lobe_srgb_decode((40 * (float)face + 10) / 255),
                                       lobe_srgb_decode(60 * (float)i / 255), 1};
            gltf_fixture_assert_near(texel, expected, 3, 1e-6f);
        }
    }
    lobe_scene_destroy(&scene);
}

static void rotation_and_intensity_are_read(void **state) {
    gltf_fixture *fixture = *state;
    write_faces(fixture);
    // A third of a turn about (1, 1, 1), x -> y -> z -> x, as a quaternion of length 2.
    lobe_scene *scene = open_lit(fixture, ",\"rotation\":[1,1,1,1],\"intensity\":2.5");
    static const float expected[9] = {0, 1, 0, 0, 0, 1, 1, 0, 0};
    gltf_fixture_assert_near(&scene->environment->world_from_environment[0][0], expected, 9, 1e-6f);
    assert_true(scene->environment->intensity == 2.5f);
    lobe_scene_destroy(&scene);
}

static void harmonics_are_named_as_ignored(void **state) {
    gltf_fixture *fixture = *state;
    write_faces(fixture);
    lobe_scene *scene = open_lit(
        fixture, ",\"specularImageSize\":2,\"irradianceCoefficients\":[[1,1,1],[0,0,0],[0,0,0],"
                 "[0,0,0],[0,0,0],[0,0,0],[0,0,0],[0,0,0],[0,0,0]]");
    assert_int_equal(fixture->warnings, 1);
    assert_non_null(strstr(fixture->warnings_text, "irradianceCoefficients"));
    lobe_scene_destroy(&scene);
}

static void alpha_divides(void **state) {
    gltf_fixture *fixture = *state;
    write_faces(fixture);
    const uint8_t texels[16] = {255, 128, 0, 51, 255, 255, 255, 255, 255, 0, 0, 0, 9, 9, 9, 128};
    write_png(fixture, "4.png", 2, 2, texels, true);
    lobe_scene *scene = open_lit(fixture, "");
    const float *bright = texel_at(scene->environment, (double[3]){0.5, 0.5, 1});
    const float expected[3] = {5, 5 * lobe_srgb_decode(128.0f / 255), 0};
    gltf_fixture_assert_near(bright, expected, 3, 1e-5f);
    const float *unbounded = texel_at(scene->environment, (double[3]){0.5, -0.5, 1});
    assert_true(fabsf(unbounded[0] - 255) < 1e-3f && isfinite(unbounded[1]));
    lobe_scene_destroy(&scene);
}

static void only_the_scene_that_has_it_is_lit(void **state) {
    gltf_fixture *fixture = *state;
    gltf_fixture_write_mesh(fixture, "plain.glb",
                            &(gltf_fixture_mesh){.accessors = &gltf_fixture_triangle,
                                                 .accessor_count = 1,
                                                 .root = ",\"extensions\":{"
                                                         "\"EXT_lights_image_based\":{"
                                                         "\"lights\":[]}}"});
    lobe_scene *scene = gltf_fixture_must_open(fixture, "plain.glb");
    assert_string_equal(scene->environment->name, "sky");
    lobe_scene_destroy(&scene);
}

static void broken_lights_are_refused(void **state) {
    gltf_fixture *fixture = *state;
    static const struct {
        const char *light;
        int index;
        const char *cause;
    } bad[] = {
        {"{\"specularImages\":[[0,1,2,3,4,5]]}", 1, "there is no image-based light 1"},
        {"{}", 0, "specularImages"},
        {"{\"specularImages\":[]}", 0, "an element expected"},
        {"{\"specularImages\":[[0,1,2,3,4]]}", 0, "specularImages"},
        {"{\"specularImages\":[[0,1,2,3,4,\"x\"]]}", 0, "specularImages"},
        {"{\"specularImages\":[[0,1,2,3,4,6]]}", 0, "there is no image 6"},
        {"{\"specularImages\":[[0,1,2,3,4,5]],\"rotation\":[0,0,0,0]}", 0, "rotation"},
        {"{\"specularImages\":[[0,1,2,3,4,5]],\"rotation\":[0,0,1]}", 0, "rotation"},
        {"{\"specularImages\":[[0,1,2,3,4,5]],\"intensity\":-1}", 0, "intensity"},
        {"{\"specularImages\":[[0,1,2,3,4,5]],\"intensity\":1e40}", 0, "intensity"},
        {"{\"specularImages\":[[0,1,2,3,4,5]],\"irradianceCoefficients\":[1]}", 0,
         "irradianceCoefficients"},
    };
    write_faces(fixture);
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        write_file(fixture, bad[i].light, bad[i].index);
        gltf_fixture_must_fail(fixture, "lit.glb", LOBE_ERROR_MALFORMED, bad[i].cause);
    }
}

// Whatever changes, the result is a scene or one message, and never a crash.
static void any_byte_may_be_wrong(void **state) {
    gltf_fixture *fixture = *state;
    static const char replacements[] = "0]}\"-,:x";
    char light[256];
    snprintf(light, sizeof light, "{\"rotation\":[0,1,0,0],\"intensity\":2,%s}", all_faces);
    write_faces(fixture);
    const size_t length = strlen(light);
    for (size_t offset = 0; offset < length; offset++) {
        for (size_t i = offset % 2; i < sizeof replacements - 1; i += 2) {
            const char kept = light[offset];
            lobe_scene *scene;
            light[offset] = replacements[i];
            write_file(fixture, light, 0);
            gltf_fixture_open(fixture, "lit.glb", &scene);
            lobe_scene_destroy(&scene);
            light[offset] = kept;
        }
    }
}

static void faces_must_be_squares_of_one_size(void **state) {
    gltf_fixture *fixture = *state;
    const uint8_t texels[48] = {0};
    char light[256];
    snprintf(light, sizeof light, "{%s}", all_faces);
    for (int face = 0; face < 6; face += 5) {
        for (int kind = 0; kind < 2; kind++) {
            char name[16];
            write_faces(fixture);
            snprintf(name, sizeof name, "%d.png", face);
            write_png(fixture, name, 4, kind ? 4 : 2, texels, false);
            write_file(fixture, light, 0);
            gltf_fixture_must_fail(fixture, "lit.glb", LOBE_ERROR_MALFORMED, "squares");
        }
    }
    write_faces(fixture);
    gltf_fixture_write_text(fixture, "3.png", "no image");
    gltf_fixture_must_fail(fixture, "lit.glb", LOBE_ERROR_UNSUPPORTED, "3.png");
    unlink(gltf_fixture_path(fixture, "3.png"));
    lobe_scene *scene;
    assert_int_equal(gltf_fixture_open(fixture, "lit.glb", &scene), LOBE_ERROR_NOT_FOUND);
}

#define WITH_FIXTURE(test)                                                                         \
    cmocka_unit_test_setup_teardown(test, gltf_fixture_setup, gltf_fixture_teardown)

int main(void) {
    const struct CMUnitTest tests[] = {
        WITH_FIXTURE(faces_look_where_the_extension_says),
        WITH_FIXTURE(rotation_and_intensity_are_read),
        WITH_FIXTURE(harmonics_are_named_as_ignored),
        WITH_FIXTURE(alpha_divides),
        WITH_FIXTURE(only_the_scene_that_has_it_is_lit),
        WITH_FIXTURE(broken_lights_are_refused),
        WITH_FIXTURE(any_byte_may_be_wrong),
        WITH_FIXTURE(faces_must_be_squares_of_one_size),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
