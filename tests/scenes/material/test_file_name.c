#include "tests/engine/support/cmocka_all.h"

#include <string.h>

#include "scenes/material/file_name.h"

static material_file_content parse(const char *name) {
    material_name split;
    scenes_material_name_split(name, &split);
    return scenes_material_name_parse(&split, 0);
}

typedef struct expected_map {
    const char *name;
    material_map map;
} expected_map;

static void check_maps(const expected_map *expected, size_t count) {
    for (size_t i = 0; i < count; i++) {
        const material_file_content content = parse(expected[i].name);
        if (content.map != expected[i].map || scenes_material_file_is_packed(&content))
            fail_msg("%s: %s", expected[i].name, scenes_material_map_name(content.map));
    }
}

static void names_tell_the_map(void **state) {
    (void)state;
    static const expected_map expected[] = {
        {"albedo.jpg", MATERIAL_MAP_ALBEDO},
        {"ALBEDO.PNG", MATERIAL_MAP_ALBEDO},
        {"col_1_1k.jpg", MATERIAL_MAP_ALBEDO},
        {"brick_base_gray.jpg", MATERIAL_MAP_ALBEDO},
        {"RustyMetalBaseColor.png", MATERIAL_MAP_ALBEDO},
        {"normal.png", MATERIAL_MAP_NORMAL},
        {"tile_anti_slip_metal_normal.png", MATERIAL_MAP_NORMAL},
        {"wall normal directx.jpeg", MATERIAL_MAP_NORMAL_DIRECTX},
        {"WallNormalDirectX.png", MATERIAL_MAP_NORMAL_DIRECTX},
        {"WallNormalOpenGL.png", MATERIAL_MAP_NORMAL},
        {"wall-normalmap.png", MATERIAL_MAP_NORMAL},
        {"brick_roughness.jpg", MATERIAL_MAP_ROUGHNESS},
        {"metal_plate_rough_2k.png", MATERIAL_MAP_ROUGHNESS},
        {"metal_rough.png", MATERIAL_MAP_ROUGHNESS},
        {"RustyMetalRoughness.png", MATERIAL_MAP_ROUGHNESS},
        {"metallic.jpg", MATERIAL_MAP_METALLIC},
        {"ao.png", MATERIAL_MAP_OCCLUSION},
        {"AmbientOcclusion.png", MATERIAL_MAP_OCCLUSION},
        {"ambient_occlusion.png", MATERIAL_MAP_OCCLUSION},
        {"emissive.png", MATERIAL_MAP_EMISSIVE},
        {"Emissive_Color.png", MATERIAL_MAP_EMISSIVE},
        {"displacement.jpg", MATERIAL_MAP_DISPLACEMENT},
        {"depth.png", MATERIAL_MAP_DISPLACEMENT},
        {"wall_gloss.png", MATERIAL_MAP_GLOSS},
        // Numbers of versions, bits and resolutions.
        {"metallic3.png", MATERIAL_MAP_METALLIC},
        {"normal3.png", MATERIAL_MAP_NORMAL},
        {"DISP16.png", MATERIAL_MAP_DISPLACEMENT},
        {"albedo4k.png", MATERIAL_MAP_ALBEDO},
        // Parts of words do not count, nor does the extension.
        {"Metal053C.png", MATERIAL_MAP_COUNT},
        {"Metal053.png", MATERIAL_MAP_COUNT},
        {"charm.png", MATERIAL_MAP_COUNT},
        {"abnormal.jpg", MATERIAL_MAP_COUNT},
        {"colorful.jpg", MATERIAL_MAP_COUNT},
        {"picture.normal", MATERIAL_MAP_COUNT},
        {"T_x.png", MATERIAL_MAP_COUNT},
        {"Brick_N.png", MATERIAL_MAP_COUNT},
        {"", MATERIAL_MAP_COUNT},
        {".png", MATERIAL_MAP_COUNT},
        {"..", MATERIAL_MAP_COUNT},
        {"___.jpg", MATERIAL_MAP_COUNT},
        {"map.jpg", MATERIAL_MAP_COUNT},
        {"\xff\xfe\xf0normal.png", MATERIAL_MAP_NORMAL},
    };
    check_maps(expected, sizeof expected / sizeof *expected);
}

/// Names as their makers write them.
static void names_of_many_makers_are_known(void **state) {
    (void)state;
    static const expected_map expected[] = {
        // ambientCG
        {"Bark014_1K-JPG_Color.jpg", MATERIAL_MAP_ALBEDO},
        {"Bark014_1K-JPG_NormalGL.jpg", MATERIAL_MAP_NORMAL},
        {"Bark014_1K-JPG_NormalDX.jpg", MATERIAL_MAP_NORMAL_DIRECTX},
        {"Metal053C_1K-PNG_Metalness.png", MATERIAL_MAP_METALLIC},
        {"Bark014_1K-JPG_AmbientOcclusion.jpg", MATERIAL_MAP_OCCLUSION},
        // Poly Haven
        {"rusty_metal_02_diff_1k.jpg", MATERIAL_MAP_ALBEDO},
        {"nor_gl_1k.jpg", MATERIAL_MAP_NORMAL},
        {"nor_dx_1k.jpg", MATERIAL_MAP_NORMAL_DIRECTX},
        {"rusty_metal_02_metal_1k.jpg", MATERIAL_MAP_METALLIC},
        // Quixel
        {"tgfmbhyn_2K_Albedo.jpg", MATERIAL_MAP_ALBEDO},
        {"tgfmbhyn_2K_AO.jpg", MATERIAL_MAP_OCCLUSION},
        {"tgfmbhyn_2K_Displacement.jpg", MATERIAL_MAP_DISPLACEMENT},
        // Poliigon
        {"Bricks01_COL_VAR1_3K.jpg", MATERIAL_MAP_ALBEDO},
        {"Bricks01_NRM_3K.jpg", MATERIAL_MAP_NORMAL},
        {"Bricks01_GLOSS_3K.jpg", MATERIAL_MAP_GLOSS},
        // freepbr
        {"rusty-metal_albedo.png", MATERIAL_MAP_ALBEDO},
        {"copper-rock1-alb.png", MATERIAL_MAP_ALBEDO},
        {"rusty-metal_normal-ogl.png", MATERIAL_MAP_NORMAL},
        {"rusty-metal_normal-dx.png", MATERIAL_MAP_NORMAL_DIRECTX},
        {"rustediron2_metallic.png", MATERIAL_MAP_METALLIC},
        // Substance
        {"Wall_Base_Color.png", MATERIAL_MAP_ALBEDO},
        {"Wall_Normal_OpenGL.png", MATERIAL_MAP_NORMAL},
        {"Wall_Mixed_AO.png", MATERIAL_MAP_OCCLUSION},
        {"Wall_Glossiness.png", MATERIAL_MAP_GLOSS},
        // Unity
        {"Wall_AlbedoTransparency.png", MATERIAL_MAP_ALBEDO},
        {"wall_albedotransparency.png", MATERIAL_MAP_ALBEDO},
        {"Wall_BaseMap.png", MATERIAL_MAP_ALBEDO},
        // Unreal
        {"T_Brick_D.png", MATERIAL_MAP_ALBEDO},
        {"T_Brick_N.png", MATERIAL_MAP_NORMAL_DIRECTX},
        {"T_Brick_BC.png", MATERIAL_MAP_ALBEDO},
        // Abbreviations of no one in particular
        {"wall_rgh.png", MATERIAL_MAP_ROUGHNESS},
        {"wall_met.png", MATERIAL_MAP_METALLIC},
        {"wall_occ.png", MATERIAL_MAP_OCCLUSION},
        {"wall_nrml.png", MATERIAL_MAP_NORMAL},
    };
    check_maps(expected, sizeof expected / sizeof *expected);
}

static void packed_files_name_their_channels(void **state) {
    (void)state;
    enum {
        O = MATERIAL_MAP_OCCLUSION,
        R = MATERIAL_MAP_ROUGHNESS,
        G = MATERIAL_MAP_GLOSS,
        M = MATERIAL_MAP_METALLIC,
        D = MATERIAL_MAP_DISPLACEMENT,
        X = MATERIAL_MAP_COUNT
    };
    static const struct {
        const char *name;
        int channels[4];
        bool gltf;
    } expected[] = {
        {"arm_1k.jpg", {O, R, M, X}, true},
        {"floor-ORM.png", {O, R, M, X}, true},
        {"Wall_occlusionRoughnessMetallic.png", {O, R, M, X}, true},
        {"wall_occlusionroughnessmetallic.png", {O, R, M, X}, true},
        {"Wall_OcclusionRoughnessMetallic1.png", {O, R, M, X}, true},
        {"Helmet_OcclusionRoughMetal.png", {O, R, M, X}, true},
        {"wall_ao_rough_metal.png", {O, R, M, X}, true},
        {"helmet_metallicRoughness.png", {X, R, M, X}, true},
        {"helmet_metallic_roughness.png", {X, R, M, X}, true},
        {"metalRoughness.png", {X, R, M, X}, true},
        {"wall_MRA.png", {M, R, O, X}, false},
        {"wall_metallic_roughness_ao.png", {M, R, O, X}, false},
        {"T_Wall_RMA.png", {R, M, O, X}, false},
        {"tgfmbhyn_2K_ORD.png", {O, R, D, X}, false},
        {"Wall_MetallicSmoothness.png", {M, X, X, G}, false},
        {"wall_metallicsmoothness.png", {M, X, X, G}, false},
        {"Wall_Metallic_Gloss.png", {M, X, X, G}, false},
        {"Wall_SpecularSmoothness.png", {X, X, X, G}, false},
        {"Wall_MaskMap.png", {M, O, X, G}, false},
        {"Wall_mask_map.png", {M, O, X, G}, false},
        {"AORoughness.png", {O, R, X, X}, false},
    };
    for (size_t i = 0; i < sizeof expected / sizeof *expected; i++) {
        const material_file_content content = parse(expected[i].name);
        for (int channel = 0; channel < 4; channel++)
            if (content.channels[channel] != (material_map)expected[i].channels[channel])
                fail_msg("%s, channel %d: %s", expected[i].name, channel,
                         scenes_material_map_name(content.channels[channel]));
        assert_int_equal(content.map, MATERIAL_MAP_COUNT);
        assert_int_equal(scenes_material_file_is_gltf(&content), expected[i].gltf);
    }
}

static void maps_without_use_are_named(void **state) {
    (void)state;
    static const char *const names[][2] = {
        {"wall_Specular.png", "specular"},
        {"wall_spec_color.png", "spec"},
        {"Bark014_1K-JPG_Opacity.jpg", "opacity"},
        {"wall_cavity.png", "cavity"},
        {"wall_color_preview.png", "preview"},
        {"Bricks01_REFL_3K.jpg", "refl"},
        {"wall_mask.png", "mask"},
        {"wall_bump.png", "bump"},
    };
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        const material_file_content content = parse(names[i][0]);
        assert_false(scenes_material_file_is_map(&content));
        assert_string_equal(content.unused, names[i][1]);
    }
    assert_null(parse("holiday.png").unused);
}

/// Words of the material's name are not looked at.
static void a_common_beginning_can_be_skipped(void **state) {
    (void)state;
    material_name name;
    scenes_material_name_split("Corrugated_Metallic_Roughness.png", &name);
    material_file_content content = scenes_material_name_parse(&name, 0);
    assert_true(scenes_material_file_is_packed(&content));
    content = scenes_material_name_parse(&name, 2);
    assert_int_equal(content.map, MATERIAL_MAP_ROUGHNESS);
    content = scenes_material_name_parse(&name, 3);
    assert_false(scenes_material_file_is_map(&content));
}

static void absurd_names_are_not_recognised(void **state) {
    (void)state;
    char name[2000];
    memset(name, 'a', sizeof name);
    strcpy(name + sizeof name - 12, "_normal.png");
    assert_int_equal(parse(name).map, MATERIAL_MAP_COUNT);
    // As many words as a name of 512 bytes can contain: aB aB ...
    for (int i = 0; i < 512; i++)
        name[i] = i % 2 ? 'B' : 'a';
    name[512] = 0;
    assert_int_equal(parse(name).map, MATERIAL_MAP_COUNT);
    // And as many known ones, which could be split in more ways than there is time for.
    for (int i = 0; i < 500; i++)
        name[i] = "basecolor"[i % 9];
    strcpy(name + 500, "x.png");
    assert_int_equal(parse(name).map, MATERIAL_MAP_COUNT);
    for (int i = 0; i < 510; i++)
        name[i] = "ao_"[i % 3];
    strcpy(name + 508, ".png");
    assert_int_equal(parse(name).map, MATERIAL_MAP_OCCLUSION);
}

static void extensions_tell_the_format(void **state) {
    (void)state;
    assert_true(scenes_material_file_is_readable("a.png") &&
                scenes_material_file_is_readable("a.b.JPG"));
    assert_true(scenes_material_file_is_readable("a.Jpeg"));
    assert_true(scenes_material_file_is_readable("a.exr"));
    assert_false(scenes_material_file_is_readable("png"));
    assert_false(scenes_material_file_is_readable("a.png.txt"));
    assert_true(scenes_material_file_is_other_image("a.tga") &&
                scenes_material_file_is_other_image("a.TIF"));
    assert_false(scenes_material_file_is_other_image("a.exr") ||
                 scenes_material_file_is_other_image("a.txt"));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(names_tell_the_map),
        cmocka_unit_test(names_of_many_makers_are_known),
        cmocka_unit_test(packed_files_name_their_channels),
        cmocka_unit_test(maps_without_use_are_named),
        cmocka_unit_test(a_common_beginning_can_be_skipped),
        cmocka_unit_test(absurd_names_are_not_recognised),
        cmocka_unit_test(extensions_tell_the_format),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
