// Values at the ends of their ranges, and outside of what maps should hold, give finite pictures
// without negative light, with every filter: each value is drawn by a third of the filters with
// microfacets and by another with half-vector lobes, because each picture has shaders of its own.

#include "tests/passes/support/fixture.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "scenes/scene/scene.h"
#include "tests/long_runs.h"
#include "tests/passes/support/picture.h"
#include "tests/passes/support/scene_builder.h"

enum { EXTENT = 16 };

/// Makes a scene extreme: before its square is added, or after everything else.
typedef struct extreme {
    const char *name;
    void (*change_material)(lobe_scene *scene, lobe_material *material);
    void (*change_scene)(lobe_scene *scene);
} extreme;

static lobe_material starting_material(lobe_scene *scene, bool microfacet) {
    lobe_material material = half_vector_material(LOBE_DISTRIBUTION_VMF, 50);
    if (microfacet)
        lobe_material_default(&material);
    material.base_colour[0] = material.base_colour[1] = material.base_colour[2] = 0.5f;
    material.roughness = 0.5f;
    material.normal_map = scene_add_map(scene, random_normal_map(32, 32, 0.6, 121));
    return material;
}

static lobe_scene *extreme_scene(const extreme *what, bool microfacet) {
    lobe_scene *scene = scene_begin();
    lobe_material material = starting_material(scene, microfacet);
    if (what->change_material)
        what->change_material(scene, &material);
    scene_add_square(scene, &material, 1, NULL);
    lobe_light lamp = {
        .type = LOBE_LIGHT_POINT, .position = {0.3f, 1, 0.2f}, .intensity = {1, 1, 1}};
    assert_int_equal(scenes_add_light(scene, &lamp, NULL), LOBE_OK);
    scene_add_sun(scene, (double[]){0.2, 1, 0.3}, 1);
    scene_look_from(scene, (double[]){0.3, 1, 0.4}, 2);
    scene_end(scene);
    if (what->change_scene)
        what->change_scene(scene);
    return scene;
}

static void check_values(const lobe_image *image, double least, const char *what) {
    const float *values = image->texels;
    size_t count = (size_t)image->width * image->height * lobe_format_channels(image->format);
    for (size_t i = 0; i < count; i++) {
        if (!isfinite(values[i]) || (double)values[i] < least)
            fail_msg("%s: value %zu is %g", what, i, (double)values[i]);
    }
}

static void check_picture(fixture *f, const extreme *what, bool microfacet, const char *filter,
                          const char *setting) {
    picture_request request = {.filter = filter,
                               .settings = {setting, NULL},
                               .width = EXTENT,
                               .height = EXTENT,
                               .samples = 2,
                               .outputs = true};
    char name[128];
    snprintf(name, sizeof name, "%s, %s, %s", what->name,
             microfacet ? "microfacets" : "half-vector lobes", filter);
    lobe_frame frame = draw(f, &request);
    check_values(&frame.radiance, 0, name);
    check_values(&frame.normal_depth, -1e30, name);
    check_values(&frame.lobes_level, 0, name);
    lobe_frame_free(&frame);
}

/// `turn`: in short runs, with every fifth filter from that one on.
static void check_extreme(fixture *f, const extreme *what, bool microfacet, size_t turn) {
    lobe_scene *scene = extreme_scene(what, microfacet);
    if (lobe_renderer_set_scene(f->renderer, scene) != LOBE_OK)
        fail_msg("%s: %s", what->name, f->error);
    for (size_t i = long_runs() ? 0 : turn % 5; i < lobe_filter_count(); i += long_runs() ? 1 : 5)
        check_picture(f, what, microfacet, lobe_filter_name(lobe_filter_get(i)), NULL);
    check_picture(f, what, microfacet, "lobes", turn % 2 ? "epsilon0=0.999" : "space=camera");
    assert_int_equal(lobe_renderer_set_scene(f->renderer, NULL), LOBE_OK);
    lobe_scene_destroy(&scene);
}

static void check_all(fixture *f, const extreme *extremes, size_t count) {
    for (size_t i = 0; i < count; i++) {
        check_extreme(f, &extremes[i], false, i);
        check_extreme(f, &extremes[i], true, i + 1);
    }
}

// ---------------------------------------------------------------------------------------------
// Materials

static void smooth(lobe_scene *scene, lobe_material *material) {
    (void)scene;
    material->roughness = 0;
    material->lobes[0].width = 1e6f;
}

static void rough(lobe_scene *scene, lobe_material *material) {
    (void)scene;
    material->roughness = 1;
    material->lobes[0].width = 0;
}

static void smooth_metal_without_maps(lobe_scene *scene, lobe_material *material) {
    smooth(scene, material);
    material->metallic = 1;
    material->normal_map = LOBE_TEXTURE_NONE;
}

static void rough_blinn_phong(lobe_scene *scene, lobe_material *material) {
    rough(scene, material);
    material->distribution = LOBE_DISTRIBUTION_BLINN_PHONG;
}

static void smooth_blinn_phong(lobe_scene *scene, lobe_material *material) {
    smooth(scene, material);
    material->distribution = LOBE_DISTRIBUTION_BLINN_PHONG;
}

static void smooth_beckmann(lobe_scene *scene, lobe_material *material) {
    smooth(scene, material);
    if (material->model == LOBE_MATERIAL_MICROFACET)
        material->distribution = LOBE_DISTRIBUTION_BECKMANN;
}

static void normals_of_no_concentration(lobe_scene *scene, lobe_material *material) {
    (void)scene;
    material->normal_concentration = 1e-20f;
}

static void normals_of_all_concentration(lobe_scene *scene, lobe_material *material) {
    (void)scene;
    material->normal_concentration = 1e30f;
}

static void widths_from_none_to_all(lobe_scene *scene, lobe_material *material) {
    static const float widths[] = {0, 1e-30f, 1, 1e6f, 1e30f, -1};
    lobe_image image = map_image(LOBE_FORMAT_RGBA32_FLOAT, 6, 1);
    for (int i = 0; i < 24; i++)
        ((float *)image.texels)[i] = widths[i / 4];
    lobe_texture_use use = scene_add_map(scene, image);
    if (material->model == LOBE_MATERIAL_MICROFACET)
        material->metallic_roughness_map = use;
    else
        material->width_map = use;
}

/// Normals that point sideways, downwards and straight down, and texels without a direction.
static void normals_below_the_horizon(lobe_scene *scene, lobe_material *material) {
    static const float texels[][3] = {{1, 0.5f, 0.5f},    {0.9f, 0.5f, 0.2f}, {0.5f, 0.5f, 0},
                                      {0.5f, 0.5f, 0.5f}, {0, 0, 0},          {0.5f, 0.5f, 1}};
    lobe_image image = map_image(LOBE_FORMAT_RGBA32_FLOAT, 6, 6);
    for (int i = 0; i < 36; i++)
        memcpy((float *)image.texels + 4 * i, texels[i % 6], sizeof texels[0]);
    material->normal_map = scene_add_map(scene, image);
}

static void normals_all_zero(lobe_scene *scene, lobe_material *material) {
    material->normal_map = scene_add_map(scene, map_image(LOBE_FORMAT_RGBA8_UNORM, 8, 8));
}

/// Neighbours that cancel: their mean has no direction.
static void normals_that_cancel(lobe_scene *scene, lobe_material *material) {
    lobe_image image = map_image(LOBE_FORMAT_RGBA32_FLOAT, 8, 8);
    for (int i = 0; i < 64; i++) {
        float *texel = (float *)image.texels + 4 * i;
        texel[0] = i % 2 ? 1 : 0;
        texel[1] = texel[2] = 0.5f;
    }
    material->normal_map = scene_add_map(scene, image);
    material->normal_map.nearest = true;
}

static void normals_of_huge_numbers(lobe_scene *scene, lobe_material *material) {
    material->normal_map = scene_add_map(scene, random_map(8, 8, -3e38, 3e38, 122));
    material->normal_scale = 1e10f;
}

static void black_and_dark(lobe_scene *scene, lobe_material *material) {
    (void)scene;
    memset(material->base_colour, 0, sizeof material->base_colour);
    memset(material->lobes[0].colour, 0, sizeof material->lobes[0].colour);
}

/// A lobe that reflects nothing, of another width than the one that does.
static void black_beside_white(lobe_scene *scene, lobe_material *material) {
    (void)scene;
    material->lobe_count = 2;
    material->lobes[1] = (lobe_base_lobe){{0, 0, 1}, 1, {0, 0, 0}};
}

static void materials_at_their_limits(void **state) {
    static const extreme extremes[] = {
        {"smooth", smooth, NULL},
        {"rough", rough, NULL},
        {"smooth metal without maps", smooth_metal_without_maps, NULL},
        {"rough Blinn-Phong", rough_blinn_phong, NULL},
        {"smooth Blinn-Phong", smooth_blinn_phong, NULL},
        {"smooth Beckmann", smooth_beckmann, NULL},
        {"kappa_N next to nothing", normals_of_no_concentration, NULL},
        {"kappa_N huge", normals_of_all_concentration, NULL},
        {"widths from none to all", widths_from_none_to_all, NULL},
        {"normals below the horizon", normals_below_the_horizon, NULL},
        {"normals all zero", normals_all_zero, NULL},
        {"normals that cancel", normals_that_cancel, NULL},
        {"normals of huge numbers", normals_of_huge_numbers, NULL},
        {"black", black_and_dark, NULL},
        {"black beside white", black_beside_white, NULL},
    };
    check_all(*state, extremes, sizeof extremes / sizeof *extremes);
}

// ---------------------------------------------------------------------------------------------
// Places

static void light_at_the_surface(lobe_scene *scene) {
    scene->lights[0].position[1] = 0;
}

/// The light at the very point that a pixel's centre sees.
static void light_at_a_pixel(lobe_scene *scene) {
    scene_look_down(scene, 2);
    scene->lights[0].position[0] = scene->lights[0].position[2] = 1.0f / EXTENT;
    scene->lights[0].position[1] = 0;
}

static void light_behind(lobe_scene *scene) {
    scene->lights[0].position[1] = -1;
    scene->lights[1].direction[1] *= -1;
}

/// Light from opposite the viewer: half vectors of opposite directions.
static void light_opposite_the_viewer(lobe_scene *scene) {
    scene_look_from(scene, (double[]){1, 1e-4, 0}, 0.5);
    scene->lights[1].direction[0] = 1;
    scene->lights[1].direction[1] = scene->lights[1].direction[2] = 0;
}

static void grazing_view(lobe_scene *scene) {
    scene->camera = (lobe_camera){
        .eye = {0, 1e-4f, 2}, .up = {0, 1, 0}, .vertical_field_of_view = 0.5f, .near_plane = 1e-3f};
}

/// The plane through the eye: visible as a line, or not at all.
static void view_along_the_plane(lobe_scene *scene) {
    grazing_view(scene);
    scene->camera.eye[1] = 0;
}

static void wide_view(lobe_scene *scene) {
    scene->camera.vertical_field_of_view = 3.1f;
}

static void scale_scene(lobe_scene *scene, float scale) {
    for (int i = 0; i < 12; i++)
        scene->instances[0].transform[i] *= scale;
    for (int i = 0; i < 3; i++) {
        scene->camera.eye[i] *= scale;
        scene->lights[0].position[i] *= scale;
        scene->minimum[i] *= scale;
        scene->maximum[i] *= scale;
    }
    scene->camera.near_plane *= scale;
    scene->camera.orthographic_height *= scale;
}

static void huge_scene(lobe_scene *scene) {
    scale_scene(scene, 1e6f);
}

static void tiny_scene(lobe_scene *scene) {
    scale_scene(scene, 1e-4f);
}

static void strong_light(lobe_scene *scene) {
    scene->lights[1].intensity[0] = 1e20f;
}

static void places_at_their_limits(void **state) {
    static const extreme extremes[] = {
        {"light at the surface", NULL, light_at_the_surface},
        {"light at a pixel", NULL, light_at_a_pixel},
        {"light behind", NULL, light_behind},
        {"light opposite the viewer", NULL, light_opposite_the_viewer},
        {"grazing view", NULL, grazing_view},
        {"view along the plane", NULL, view_along_the_plane},
        {"wide view", NULL, wide_view},
        {"huge scene", NULL, huge_scene},
        {"tiny scene", NULL, tiny_scene},
        {"strong light", NULL, strong_light},
        {"smooth and grazing", smooth, grazing_view},
        {"smooth, light opposite the viewer", smooth, light_opposite_the_viewer},
    };
    check_all(*state, extremes, sizeof extremes / sizeof *extremes);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(materials_at_their_limits),
        cmocka_unit_test(places_at_their_limits),
    };
    return cmocka_run_group_tests(tests, fixture_create, fixture_destroy);
}
