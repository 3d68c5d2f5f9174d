// Materials, textures and images of glTF files.

#include "tests/scenes/gltf/gltf_fixture.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <png.h>

#define NEAR 1e-6f

static const float coordinates[] = {0, 0, 1, 0, 0, 1};

// One triangle with the first set of coordinates and material 0, which `root` defines.
static void write_material(const gltf_fixture *fixture, const char *name, const char *root) {
    const gltf_fixture_accessor accessors[] = {
        gltf_fixture_triangle,
        {"TEXCOORD_0", GLTF_FLOAT, "VEC2", false, 3, coordinates, sizeof coordinates}};
    const gltf_fixture_mesh mesh = {
        .accessors = accessors, .accessor_count = 2, .primitive = ",\"material\":0", .root = root};
    gltf_fixture_write_mesh(fixture, name, &mesh);
}

static lobe_scene *open_material(gltf_fixture *fixture, const char *root) {
    write_material(fixture, "material.glb", root);
    return gltf_fixture_must_open(fixture, "material.glb");
}

// Encodes RGBA with 8 or 16 bits per channel (big-endian, as in PNG); to be freed.
static uint8_t *encode_png(uint32_t width, uint32_t height, int bits, const void *texels,
                           size_t *size) {
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, NULL, NULL, NULL);
    png_infop info = png_create_info_struct(png);
    char *bytes = NULL;
    FILE *memory = open_memstream(&bytes, size);
    png_init_io(png, memory);
    png_set_IHDR(png, info, width, height, bits, PNG_COLOR_TYPE_RGBA, PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    png_write_info(png, info);
    for (uint32_t y = 0; y < height; y++)
        png_write_row(png, (png_const_bytep)texels + y * width * (size_t)bits / 2);
    png_write_end(png, NULL);
    png_destroy_write_struct(&png, &info);
    fclose(memory);
    return (uint8_t *)bytes;
}

static const uint8_t texels[] = {1, 2, 3, 4, 50, 60, 70, 80};
static const uint8_t deep_texels[] = {1, 2, 3, 4, 5, 6, 7, 8, 0xff, 0xee, 0, 1, 0, 0, 0xff, 0xff};

static void write_png(const gltf_fixture *fixture, const char *name) {
    size_t size;
    uint8_t *bytes = encode_png(2, 1, 8, texels, &size);
    gltf_fixture_write(fixture, name, bytes, size);
    free(bytes);
}

static void factors_are_read(void **state) {
    lobe_scene *scene = open_material(
        *state,
        ",\"extensionsUsed\":[\"KHR_materials_emissive_strength\"],\"materials\":[{"
        "\"name\":\"paint\",\"pbrMetallicRoughness\":{\"baseColorFactor\":[0.1,0.2,0.3,0.4],"
        "\"metallicFactor\":0.5,\"roughnessFactor\":0.25},\"emissiveFactor\":[1,0.5,0],"
        "\"alphaMode\":\"MASK\",\"alphaCutoff\":0.75,\"doubleSided\":true,\"extensions\":{"
        "\"KHR_materials_emissive_strength\":{\"emissiveStrength\":8}}}]");
    const lobe_material *m = &scene->materials[scene->instances[0].material];
    assert_string_equal(m->name, "paint");
    assert_int_equal(m->model, LOBE_MATERIAL_MICROFACET);
    assert_int_equal(m->distribution, LOBE_DISTRIBUTION_GGX);
    gltf_fixture_assert_near(m->base_colour, (const float[]){0.1f, 0.2f, 0.3f, 0.4f}, 4, 0);
    gltf_fixture_assert_near(m->emissive, (const float[]){8, 4, 0}, 3, NEAR);
    assert_true(m->metallic == 0.5f && m->roughness == 0.25f && m->alpha_cutoff == 0.75f);
    assert_true(m->double_sided && m->alpha_mask);
    assert_int_equal(m->base_colour_map.image, -1);
    assert_int_equal(m->normal_map.image, -1);
    lobe_scene_destroy(&scene);
}

static void material_of_the_format_stands_in_for_none(void **state) {
    const gltf_fixture_mesh mesh = {.accessors = &gltf_fixture_triangle, .accessor_count = 1};
    gltf_fixture_write_mesh(*state, "none.glb", &mesh);
    lobe_scene *scene = gltf_fixture_must_open(*state, "none.glb");
    assert_int_equal(scene->material_count, 1);
    assert_true(scene->materials[0].metallic == 1 && scene->materials[0].roughness == 1);
    assert_false(scene->materials[0].double_sided || scene->materials[0].alpha_mask);
    lobe_scene_destroy(&scene);
}

static void factors_out_of_range_are_clamped_and_counted(void **state) {
    gltf_fixture *fixture = *state;
    lobe_scene *scene = open_material(
        fixture, ",\"materials\":[{\"pbrMetallicRoughness\":{\"baseColorFactor\":[2,1,-1,1],"
                 "\"roughnessFactor\":7}}]");
    const lobe_material *m = &scene->materials[0];
    gltf_fixture_assert_near(m->base_colour, (const float[]){1, 1, 0, 1}, 4, 0);
    assert_true(m->roughness == 1);
    assert_int_equal(fixture->warnings, 1);
    assert_non_null(strstr(fixture->warnings_text, "3 material factors"));
    lobe_scene_destroy(&scene);
}

static void blending_is_drawn_opaque_and_named(void **state) {
    gltf_fixture *fixture = *state;
    lobe_scene *scene = open_material(fixture, ",\"materials\":[{\"alphaMode\":\"BLEND\"}]");
    assert_false(scene->materials[0].alpha_mask);
    assert_non_null(strstr(fixture->warnings_text, "blending"));
    lobe_scene_destroy(&scene);
    write_material(fixture, "mode.glb", ",\"materials\":[{\"alphaMode\":\"GLASS\"}]");
    gltf_fixture_must_fail(fixture, "mode.glb", LOBE_ERROR_MALFORMED, "GLASS");
}

static void images_become_colour_or_data_by_their_use(void **state) {
    write_png(*state, "both.png");
    write_png(*state, "unused.png");
    lobe_scene *scene = open_material(
        *state,
        ",\"materials\":[{\"pbrMetallicRoughness\":{\"baseColorTexture\":{\"index\":0},"
        "\"metallicRoughnessTexture\":{\"index\":0}},\"occlusionTexture\":{\"index\":0,"
        "\"strength\":0.5},\"normalTexture\":{\"index\":1,\"scale\":-2},"
        "\"emissiveTexture\":{\"index\":2}}],"
        "\"textures\":[{\"source\":0},{\"source\":0},{\"source\":1}],"
        "\"images\":[{\"uri\":\"both.png\"},{\"uri\":\"unused.png\"},{\"uri\":\"absent.png\"}]");
    const lobe_material *m = &scene->materials[0];
    // The emissive factor is black, so its map is not read; both uses as data share one image.
    assert_int_equal(scene->image_count, 2);
    assert_int_equal(m->emissive_map.image, -1);
    assert_int_equal(m->occlusion_map.image, m->normal_map.image);
    assert_int_equal(m->occlusion_map.image, m->metallic_roughness_map.image);
    assert_int_not_equal(m->occlusion_map.image, m->base_colour_map.image);
    assert_true(m->occlusion_strength == 0.5f && m->normal_scale == -2);
    const lobe_scene_image *colour = &scene->images[m->base_colour_map.image];
    const lobe_scene_image *data = &scene->images[m->normal_map.image];
    assert_string_equal(colour->name, "both.png");
    assert_int_equal(colour->image.format, LOBE_FORMAT_RGBA8_SRGB);
    assert_int_equal(data->image.format, LOBE_FORMAT_RGBA8_UNORM);
    assert_int_equal(data->image.width, 2);
    assert_int_equal(data->image.height, 1);
    assert_memory_equal(data->image.texels, texels, sizeof texels);
    assert_memory_equal(colour->image.texels, texels, sizeof texels);
    lobe_scene_destroy(&scene);
}

static void sixteen_bits_are_kept_for_data(void **state) {
    size_t size;
    uint8_t *bytes = encode_png(2, 1, 16, deep_texels, &size);
    gltf_fixture_write(*state, "deep.png", bytes, size);
    free(bytes);
    lobe_scene *scene = open_material(
        *state, ",\"materials\":[{\"pbrMetallicRoughness\":{\"baseColorTexture\":{\"index\":0}},"
                "\"normalTexture\":{\"index\":0}}],\"textures\":[{\"source\":0}],"
                "\"images\":[{\"uri\":\"deep.png\"}]");
    const lobe_material *m = &scene->materials[0];
    const lobe_image *normals = &scene->images[m->normal_map.image].image;
    const lobe_image *colours = &scene->images[m->base_colour_map.image].image;
    assert_int_equal(normals->format, LOBE_FORMAT_RGBA16_UNORM);
    for (int i = 0; i < 8; i++)
        assert_int_equal(((const uint16_t *)normals->texels)[i],
                         deep_texels[2 * i] << 8 | deep_texels[2 * i + 1]);
    assert_int_equal(colours->format, LOBE_FORMAT_RGBA8_SRGB);
    assert_memory_equal(colours->texels, ((const uint8_t[]){1, 3, 5, 7, 255, 0, 0, 255}), 8);
    lobe_scene_destroy(&scene);
}

static const char sampled[] =
    ",\"materials\":[{\"pbrMetallicRoughness\":{\"baseColorTexture\":{\"index\":0}},"
    "\"normalTexture\":{\"index\":1},\"occlusionTexture\":{\"index\":2}}],"
    "\"textures\":[{\"source\":0},{\"source\":0,\"sampler\":0},{\"source\":0,\"sampler\":1}],"
    "\"images\":[{\"uri\":\"wrap.png\"}],\"samplers\":[{\"wrapS\":33071,\"wrapT\":33648,"
    "\"magFilter\":9728},{\"magFilter\":9729,\"wrapS\":%d}]";

static void samplers_say_wrap_and_filter(void **state) {
    char root[1024];
    write_png(*state, "wrap.png");
    snprintf(root, sizeof root, sampled, 10497);
    lobe_scene *scene = open_material(*state, root);
    const lobe_material *m = &scene->materials[0];
    assert_int_equal(m->base_colour_map.wrap_u, LOBE_SCENE_WRAP_REPEAT);
    assert_int_equal(m->base_colour_map.wrap_v, LOBE_SCENE_WRAP_REPEAT);
    assert_false(m->base_colour_map.nearest);
    assert_int_equal(m->normal_map.wrap_u, LOBE_SCENE_WRAP_CLAMP);
    assert_int_equal(m->normal_map.wrap_v, LOBE_SCENE_WRAP_MIRROR);
    assert_true(m->normal_map.nearest);
    assert_false(m->occlusion_map.nearest);
    lobe_scene_destroy(&scene);
    snprintf(root, sizeof root, sampled, 10498);
    write_material(*state, "wrap.glb", root);
    gltf_fixture_must_fail(*state, "wrap.glb", LOBE_ERROR_MALFORMED, "10498");
}

static void coordinates_are_transformed(void **state) {
    write_png(*state, "turned.png");
    lobe_scene *scene = open_material(
        *state,
        ",\"extensionsRequired\":[\"KHR_texture_transform\"],\"materials\":[{"
        "\"pbrMetallicRoughness\":{\"baseColorTexture\":{\"index\":0,\"extensions\":{"
        "\"KHR_texture_transform\":{\"offset\":[0,1],\"rotation\":1.57079632679,"
        "\"scale\":[0.5,0.5]}}}},\"normalTexture\":{\"index\":0,\"extensions\":{"
        "\"KHR_texture_transform\":{\"offset\":[0.1,0.2],\"rotation\":0.3,\"scale\":[4,5]}}},"
        "\"occlusionTexture\":{\"index\":0,\"texCoord\":0,\"extensions\":{"
        "\"KHR_texture_transform\":{\"texCoord\":1,\"scale\":[2,3]}}}}],"
        "\"textures\":[{\"source\":0}],\"images\":[{\"uri\":\"turned.png\"}]");
    const lobe_material *m = &scene->materials[0];
    // The example from the extension: the lower left quarter of the image, turned clockwise.
    const float quarter[6] = {0, 0.5f, 0, -0.5f, 0, 1};
    gltf_fixture_assert_near(&m->base_colour_map.transform[0][0], quarter, 6, NEAR);
    const float c = cosf(0.3f), s = sinf(0.3f);
    const float general[6] = {4 * c, 5 * s, 0.1f, -4 * s, 5 * c, 0.2f};
    gltf_fixture_assert_near(&m->normal_map.transform[0][0], general, 6, NEAR);
    const float scaled[6] = {2, 0, 0, 0, 3, 0};
    gltf_fixture_assert_near(&m->occlusion_map.transform[0][0], scaled, 6, 0);
    assert_int_equal(m->occlusion_map.texture_coordinates, 1);
    assert_int_equal(m->normal_map.texture_coordinates, 0);
    // Tangents follow the normal map's own u, which its transform turns by 0.3.
    gltf_fixture_assert_near(
        scene->meshes[0].vertices[0].tangent,
        (const float[]){5 * c / hypotf(5 * c, 4 * s), 4 * s / hypotf(5 * c, 4 * s), 0, -1}, 4,
        1e-5f);
    lobe_scene_destroy(&scene);
}

static void missing_coordinates_are_said(void **state) {
    gltf_fixture *fixture = *state;
    write_png(fixture, "bare.png");
    const gltf_fixture_mesh mesh = {
        .accessors = &gltf_fixture_triangle,
        .accessor_count = 1,
        .primitive = ",\"material\":0",
        .root = ",\"materials\":[{\"normalTexture\":{\"index\":0}}],"
                "\"textures\":[{\"source\":0}],\"images\":[{\"uri\":\"bare.png\"}]"};
    gltf_fixture_write_mesh(fixture, "bare.glb", &mesh);
    lobe_scene *scene = gltf_fixture_must_open(fixture, "bare.glb");
    assert_int_equal(fixture->warnings, 1);
    assert_non_null(strstr(fixture->warnings_text, "lack texture coordinates"));
    lobe_scene_destroy(&scene);
}

static void third_set_of_coordinates_is_left_out(void **state) {
    gltf_fixture *fixture = *state;
    lobe_scene *scene = open_material(
        fixture, ",\"materials\":[{\"normalTexture\":{\"index\":0,\"texCoord\":2},"
                 "\"occlusionTexture\":{\"index\":1}}],\"textures\":[{\"source\":0},{}],"
                 "\"images\":[{\"uri\":\"absent.png\"}]");
    assert_int_equal(scene->materials[0].normal_map.image, -1);
    assert_int_equal(scene->materials[0].occlusion_map.image, -1);
    assert_int_equal(fixture->warnings, 1);
    assert_non_null(strstr(fixture->warnings_text, "third set"));
    assert_non_null(strstr(fixture->warnings_text, "without a PNG or JPEG"));
    lobe_scene_destroy(&scene);
}

static void encode_base64(const uint8_t *bytes, size_t size, char *text) {
    static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for (size_t i = 0; i < size; i += 3) {
        uint32_t group = (uint32_t)bytes[i] << 16;
        group |= i + 1 < size ? (uint32_t)bytes[i + 1] << 8 : 0;
        group |= i + 2 < size ? bytes[i + 2] : 0;
        for (int k = 0; k < 4; k++)
            *text++ = i + k > size ? '=' : digits[group >> (18 - 6 * k) & 63];
    }
    *text = 0;
}

// Buffer and image inside the text, and the image again inside the buffer.
static void everything_may_be_embedded(void **state) {
    size_t size;
    uint8_t *png = encode_png(2, 1, 8, texels, &size);
    uint8_t buffer[1024];
    char buffer_text[2048], png_text[2048], json[8192];
    memcpy(buffer, gltf_fixture_triangle.data, 36);
    memcpy(buffer + 36, png, size);
    encode_base64(buffer, 36 + size, buffer_text);
    encode_base64(png, size, png_text);
    free(png);
    snprintf(json, sizeof json,
             "{\"asset\":{\"version\":\"2.0\"},\"nodes\":[{\"mesh\":0}],\"meshes\":[{"
             "\"primitives\":[{\"attributes\":{\"POSITION\":0},\"material\":0}]}],"
             "\"materials\":[{\"normalTexture\":{\"index\":0},\"occlusionTexture\":{\"index\":1}}],"
             "\"textures\":[{\"source\":0},{\"source\":1}],\"images\":["
             "{\"uri\":\"data:image/png;base64,%s\"},{\"bufferView\":1,"
             "\"mimeType\":\"image/png\"}],\"buffers\":[{\"byteLength\":%zu,"
             "\"uri\":\"data:application/octet-stream;base64,%s\"}],"
             "\"bufferViews\":[{\"buffer\":0,\"byteLength\":36},"
             "{\"buffer\":0,\"byteOffset\":36,\"byteLength\":%zu}],"
             "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"type\":\"VEC3\","
             "\"count\":3}]}",
             png_text, 36 + size, buffer_text, size);
    gltf_fixture_write_text(*state, "embedded.gltf", json);
    lobe_scene *scene = gltf_fixture_must_open(*state, "embedded.gltf");
    assert_int_equal(scene->image_count, 2);
    for (int i = 0; i < 2; i++)
        assert_memory_equal(scene->images[i].image.texels, texels, sizeof texels);
    gltf_fixture_assert_near(scene->meshes[0].vertices[1].position, (const float[]){1, 0, 0}, 3, 0);
    lobe_scene_destroy(&scene);
}

static void names_of_files_are_percent_encoded(void **state) {
    gltf_fixture_write(*state, "with space+plus.bin", gltf_fixture_triangle.data, 36);
    gltf_fixture_write(*state, "a+b.bin", gltf_fixture_triangle.data, 36);
    write_png(*state, "with space+plus.png");
    const char *names[] = {"with%20space%2Bplus.bin", "a+b.bin"};
    for (int i = 0; i < 2; i++) {
        char json[1024];
        snprintf(json, sizeof json,
                 "{\"asset\":{\"version\":\"2.0\"},\"nodes\":[{\"mesh\":0}],\"meshes\":[{"
                 "\"primitives\":[{\"attributes\":{\"POSITION\":0},\"material\":0}]}],"
                 "\"materials\":[{\"normalTexture\":{\"index\":0}}],"
                 "\"textures\":[{\"source\":0}],"
                 "\"images\":[{\"uri\":\"with%%20space+plus.png\"}],"
                 "\"buffers\":[{\"byteLength\":36,\"uri\":\"%s\"}],"
                 "\"bufferViews\":[{\"buffer\":0,\"byteLength\":36}],"
                 "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"type\":\"VEC3\","
                 "\"count\":3}]}",
                 names[i]);
        gltf_fixture_write_text(*state, "names.gltf", json);
        lobe_scene *scene = gltf_fixture_must_open(*state, "names.gltf");
        assert_int_equal(scene->image_count, 1);
        lobe_scene_destroy(&scene);
    }
}

static void bad_images_name_file_and_cause(void **state) {
    const char *root = ",\"materials\":[{\"normalTexture\":{\"index\":0}}],"
                       "\"textures\":[{\"source\":0}],\"images\":[{\"uri\":\"bad.png\"}]";
    write_material(*state, "bad.glb", root);
    gltf_fixture_must_fail(*state, "bad.glb", LOBE_ERROR_NOT_FOUND, "bad.png: no such file");
    gltf_fixture_write_text(*state, "bad.png", "not an image at all");
    gltf_fixture_must_fail(*state, "bad.glb", LOBE_ERROR_UNSUPPORTED,
                           "bad.png: neither PNG nor JPEG");
    gltf_fixture_write_text(*state, "bad.png", "");
    gltf_fixture_must_fail(*state, "bad.glb", LOBE_ERROR_MALFORMED, "bad.png");
    size_t size;
    uint8_t *png = encode_png(2, 1, 8, texels, &size);
    gltf_fixture_write(*state, "bad.png", png, size - 20);
    free(png);
    gltf_fixture_must_fail(*state, "bad.glb", LOBE_ERROR_MALFORMED, "bad.png: broken PNG");
}

static void unused_images_need_not_exist(void **state) {
    gltf_fixture_write_text(
        *state, "unused.gltf",
        "{\"asset\":{\"version\":\"2.0\"},\"images\":[{\"uri\":\"absent.png\"}],"
        "\"textures\":[{\"source\":0}]}");
    lobe_scene *scene = gltf_fixture_must_open(*state, "unused.gltf");
    assert_int_equal(scene->image_count, 0);
    lobe_scene_destroy(&scene);
}

static void dangling_references_are_named(void **state) {
    static const struct {
        const char *root, *cause;
    } cases[] = {
        {"", "there is no material 0"},
        {",\"materials\":[{\"normalTexture\":{\"index\":7}}]", "there is no texture 7"},
        {",\"materials\":[{\"normalTexture\":{\"index\":0}}],\"textures\":[{\"source\":3}]",
         "there is no image 3"},
        {",\"materials\":[{\"normalTexture\":{\"index\":0}}],"
         "\"textures\":[{\"source\":0,\"sampler\":2}],\"images\":[{\"uri\":\"a.png\"}]",
         "there is no sampler 2"},
        {",\"materials\":[{\"normalTexture\":{\"index\":0}}],\"textures\":[{\"source\":0}],"
         "\"images\":[{\"bufferView\":9}]",
         "9"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        write_material(*state, "dangling.glb", cases[i].root);
        gltf_fixture_must_fail(*state, "dangling.glb", LOBE_ERROR_MALFORMED, cases[i].cause);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(factors_are_read),
        cmocka_unit_test(material_of_the_format_stands_in_for_none),
        cmocka_unit_test(factors_out_of_range_are_clamped_and_counted),
        cmocka_unit_test(blending_is_drawn_opaque_and_named),
        cmocka_unit_test(images_become_colour_or_data_by_their_use),
        cmocka_unit_test(sixteen_bits_are_kept_for_data),
        cmocka_unit_test(samplers_say_wrap_and_filter),
        cmocka_unit_test(coordinates_are_transformed),
        cmocka_unit_test(missing_coordinates_are_said),
        cmocka_unit_test(third_set_of_coordinates_is_left_out),
        cmocka_unit_test(everything_may_be_embedded),
        cmocka_unit_test(names_of_files_are_percent_encoded),
        cmocka_unit_test(bad_images_name_file_and_cause),
        cmocka_unit_test(unused_images_need_not_exist),
        cmocka_unit_test(dangling_references_are_named),
    };
    return cmocka_run_group_tests_name("glTF materials", tests, gltf_fixture_setup,
                                       gltf_fixture_teardown);
}
