#include "tests/engine/support/cmocka_all.h"

#include <string.h>

#include "scenes/material/file_name.h"

static void names_tell_the_map(void **state) {
    (void)state;
    static const struct {
        const char *name;
        material_map map;
    } expected[] = {
        {"albedo.jpg", MATERIAL_MAP_ALBEDO},
        {"ALBEDO.PNG", MATERIAL_MAP_ALBEDO},
        {"col_1_1k.jpg", MATERIAL_MAP_ALBEDO},
        {"Bark014_1K-JPG_Color.jpg", MATERIAL_MAP_ALBEDO},
        {"brick_base_gray.jpg", MATERIAL_MAP_ALBEDO},
        {"RustyMetalBaseColor.png", MATERIAL_MAP_ALBEDO},
        {"rusty_metal_02_diff_1k.jpg", MATERIAL_MAP_ALBEDO},
        {"normal.png", MATERIAL_MAP_NORMAL},
        {"nor_gl_1k.jpg", MATERIAL_MAP_NORMAL},
        {"Bark014_1K-JPG_NormalGL.jpg", MATERIAL_MAP_NORMAL},
        {"tile_anti_slip_metal_normal.png", MATERIAL_MAP_NORMAL},
        {"nor_dx_1k.jpg", MATERIAL_MAP_NORMAL_DIRECTX},
        {"Bark014_1K-JPG_NormalDX.jpg", MATERIAL_MAP_NORMAL_DIRECTX},
        {"wall normal directx.jpeg", MATERIAL_MAP_NORMAL_DIRECTX},
        {"brick_roughness.jpg", MATERIAL_MAP_ROUGHNESS},
        {"metal_plate_rough_2k.png", MATERIAL_MAP_ROUGHNESS},
        {"metallic.jpg", MATERIAL_MAP_METALLIC},
        {"Metal053C_Metalness.jpg", MATERIAL_MAP_METALLIC},
        {"helmet_metallicRoughness.png", MATERIAL_MAP_METALLIC_ROUGHNESS},
        {"arm_1k.jpg", MATERIAL_MAP_OCCLUSION_ROUGHNESS_METALLIC},
        {"floor-ORM.png", MATERIAL_MAP_OCCLUSION_ROUGHNESS_METALLIC},
        {"ao.png", MATERIAL_MAP_OCCLUSION},
        {"AmbientOcclusion.png", MATERIAL_MAP_OCCLUSION},
        {"emissive.png", MATERIAL_MAP_EMISSIVE},
        {"displacement.jpg", MATERIAL_MAP_DISPLACEMENT},
        {"depth.png", MATERIAL_MAP_DISPLACEMENT},
        // Parts of words do not count, nor does the extension.
        {"Metal053C.png", MATERIAL_MAP_COUNT},
        {"charm.png", MATERIAL_MAP_COUNT},
        {"abnormal.jpg", MATERIAL_MAP_COUNT},
        {"picture.normal", MATERIAL_MAP_COUNT},
        {"", MATERIAL_MAP_COUNT},
        {".png", MATERIAL_MAP_COUNT},
        {"..", MATERIAL_MAP_COUNT},
        {"___.jpg", MATERIAL_MAP_COUNT},
        {"\xff\xfe\xf0normal.png", MATERIAL_MAP_NORMAL},
    };
    for (size_t i = 0; i < sizeof expected / sizeof *expected; i++) {
        if (scenes_material_file_map(expected[i].name) != expected[i].map)
            print_error("%s\n", expected[i].name);
        assert_int_equal(scenes_material_file_map(expected[i].name), expected[i].map);
    }
}

static void absurd_names_are_not_recognised(void **state) {
    (void)state;
    char name[2000];
    memset(name, 'a', sizeof name);
    strcpy(name + sizeof name - 12, "_normal.png");
    assert_int_equal(scenes_material_file_map(name), MATERIAL_MAP_COUNT);
    // As many words as a name of 512 bytes can contain: aB aB ...
    for (int i = 0; i < 512; i++)
        name[i] = i % 2 ? 'B' : 'a';
    name[512] = 0;
    assert_int_equal(scenes_material_file_map(name), MATERIAL_MAP_COUNT);
}

static void extensions_tell_the_format(void **state) {
    (void)state;
    assert_true(scenes_material_file_is_readable("a.png") &&
                scenes_material_file_is_readable("a.b.JPG"));
    assert_true(scenes_material_file_is_readable("a.Jpeg"));
    assert_false(scenes_material_file_is_readable("png") ||
                 scenes_material_file_is_readable("a.exr"));
    assert_false(scenes_material_file_is_readable("a.png.txt"));
    assert_true(scenes_material_file_is_other_image("a.exr") &&
                scenes_material_file_is_other_image("a.TIF"));
    assert_false(scenes_material_file_is_other_image("a.png") ||
                 scenes_material_file_is_other_image("a.txt"));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(names_tell_the_map),
        cmocka_unit_test(absurd_names_are_not_recognised),
        cmocka_unit_test(extensions_tell_the_format),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
