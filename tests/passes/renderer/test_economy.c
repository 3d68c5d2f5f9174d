// Only what the scene requires: anything constant, unchanged, absent or switched off costs no pass,
// no map and no shader code.

#include "tests/passes/support/fixture.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "engine/graph/state.h"
#include "passes/maps/level_reduction.h"
#include "scenes/scene/scene.h"
#include "shaders/interface/specialisation.h"
#include "tests/passes/support/picture.h"
#include "tests/passes/support/scene_builder.h"

static const uint32_t extent = 8;

static picture_request request_for(const char *filter, const char *knob) {
    return (picture_request){
        .filter = filter, .settings = {knob, NULL}, .width = extent, .height = extent};
}

/// Every property of a material, with one constant value each.
static lobe_material constant_material(lobe_scene *scene, bool microfacet, uint32_t size) {
    lobe_material material = half_vector_material(LOBE_DISTRIBUTION_VMF, 20);
    if (microfacet)
        lobe_material_default(&material);
    material.distribution = LOBE_DISTRIBUTION_VMF;
    material.roughness = 0.9f;
    material.base_colour[0] = material.base_colour[1] = material.base_colour[2] = 0.8f;
    material.emissive[0] = material.emissive[1] = material.emissive[2] = 0.1f;
    material.normal_map = scene_add_map(scene, constant_map(size, size, 0.62f, 0.34f, 0.96f));
    material.base_colour_map = scene_add_map(scene, constant_map(size, size, 0.5f, 0.75f, 1));
    material.emissive_map = scene_add_map(scene, constant_map(size, size, 1, 0.5f, 0.25f));
    lobe_texture_use half = scene_add_map(scene, constant_map(size, size, 0.5f, 0.75f, 0.5f));
    if (microfacet) {
        material.metallic_roughness_map = half;
    } else {
        material.width_map = half;
        material.specular_map = half;
    }
    return material;
}

static lobe_scene *constant_scene(bool microfacet, uint32_t size) {
    lobe_scene *scene = scene_begin();
    lobe_material material = constant_material(scene, microfacet, size);
    scene_add_square(scene, &material, 1, NULL);
    scene_add_sun(scene, (double[]){0.3, 1, 0.2}, 2);
    scene_look_down(scene, 1);
    scene_end(scene);
    return scene;
}

// ---------------------------------------------------------------------------------------------
// Constants

/// A constant map needs no filtering: all filters agree, in whichever space they build their maps.
static void filters_agree_on_constant_maps(void **state) {
    static const char *const requests[][3] = {
        {"mipmap", "probes=3", NULL},       {"lobes", "space=tangent", NULL},
        {"lobes", "space=object", NULL},    {"lobes", "space=camera", NULL},
        {"lobes", "subdivision=0", NULL},   {"lobes", "epsilon0=1", NULL},
        {"lobes", "storage=float16", NULL}, {"reference", NULL, NULL},
    };
    // Half-vector lobes, and microfacets of two distributions.
    for (int kind = 0; kind < 3; kind++) {
        lobe_scene *scene = constant_scene(kind > 0, 32);
        if (kind == 2)
            scene->materials[0].distribution = LOBE_DISTRIBUTION_GGX;
        picture_request direct = request_for("direct", NULL);
        lobe_frame expected = draw_scene(*state, scene, &direct);
        assert_true(largest_value(&expected.radiance) > 0.05);
        for (size_t i = 0; i < sizeof requests / sizeof *requests; i++) {
            picture_request request = request_for(requests[i][0], requests[i][1]);
            request.samples = 3;
            lobe_frame frame = draw_scene(*state, scene, &request);
            double error = relative_l2(&frame.radiance, &expected.radiance);
            if (!(error < 1e-3))
                fail_msg("%s %s: %g off", requests[i][0], requests[i][1] ? requests[i][1] : "",
                         error);
            lobe_frame_free(&frame);
        }
        lobe_frame_free(&expected);
        lobe_scene_destroy(&scene);
    }
}

/// Texels that cover many pixels need no filtering either: lobes of several hues and widths, and
/// every other property, are those of the maps themselves. The normals are not interpolated; those
/// that are turn inside a pixel.
static void filters_agree_where_maps_are_magnified(void **state) {
    static const char *const filters[] = {"mipmap", "lobes"};
    for (int model = 0; model < 3; model++) {
        lobe_scene *scene = scene_begin();
        lobe_material material = half_vector_material(LOBE_DISTRIBUTION_VMF, 20);
        if (model == 0)
            lobe_material_default(&material);
        if (model == 1)
            material.distribution = LOBE_DISTRIBUTION_BLINN_PHONG;
        material.lobe_count = 2;
        material.lobes[0] = (lobe_base_lobe){{0.28f, 0, 0.96f}, 30, {0.9f, 0.1f, 0.2f}};
        material.lobes[1] = (lobe_base_lobe){{-0.28f, 0, 0.96f}, 60, {0.1f, 0.2f, 0.9f}};
        material.base_colour[0] = 0.25f;
        material.emissive[1] = 0.1f;
        material.normal_map = scene_add_map(scene, random_normal_map(32, 32, 0.3, 73));
        material.normal_map.nearest = true;
        material.base_colour_map = scene_add_map(scene, random_map(32, 32, 0, 1, 74));
        material.emissive_map = scene_add_map(scene, random_map(32, 32, 0, 1, 75));
        scene_add_square(scene, &material, 1, NULL);
        scene_add_sun(scene, (double[]){0.3, 1, 0.2}, 2);
        scene_add_sun(scene, (double[]){-0.5, 1, 0.1}, 1);
        scene_look_down(scene, 0.4); // a texel is two and a half pixels wide
        scene_end(scene);
        picture_request request = request_for("direct", NULL);
        request.width = request.height = 16;
        lobe_frame direct = draw_scene(*state, scene, &request);
        for (int i = 0; i < 2; i++) {
            request.filter = filters[i];
            lobe_frame frame = draw_scene(*state, scene, &request);
            double error = relative_l2(&frame.radiance, &direct.radiance);
            if (!(error < 1e-4))
                fail_msg("%s, model %d: %g off", filters[i], model, error);
            lobe_frame_free(&frame);
        }
        lobe_frame_free(&direct);
        lobe_scene_destroy(&scene);
    }
}

/// Without maps, or with maps of one texel, shading is the only pass.
static void a_constant_material_builds_nothing(void **state) {
    fixture *f = *state;
    static const char *const filters[] = {"direct", "mipmap", "lobes"};
    for (int mapped = 0; mapped < 2; mapped++) {
        lobe_scene *scene = constant_scene(false, 1);
        char *name = scene->materials[0].name;
        if (!mapped)
            scene->materials[0] = half_vector_material(LOBE_DISTRIBUTION_VMF, 20);
        scene->materials[0].name = name;
        assert_int_equal(lobe_renderer_set_scene(f->renderer, scene), LOBE_OK);
        for (size_t i = 0; i < 3; i++) {
            picture_request request = request_for(filters[i], NULL);
            lobe_frame frame = draw(f, &request);
            const lobe_graph_report *report = lobe_graph_describe(lobe_renderer_graph(f->renderer));
            assert_int_equal(report->pass_count, 1);
            assert_string_equal(report->passes[0].name, "shading");
            assert_int_equal(frame.pass_count, 1);
            assert_int_equal(frame.filtered_bytes, 0);
            assert_int_equal(report->retained_bytes, 0);
            lobe_frame_free(&frame);
        }
        assert_int_equal(lobe_renderer_set_scene(f->renderer, NULL), LOBE_OK);
        lobe_scene_destroy(&scene);
    }
}

// ---------------------------------------------------------------------------------------------
// Layers

/// Layers of the mixture in the graph of the last frame.
static uint32_t mixture_layers(fixture *f) {
    const lobe_graph *graph = lobe_renderer_graph(f->renderer);
    for (uint32_t i = 0; i < graph->frame.dependencies.resource_count; i++) {
        if (strncmp(graph->frame.resources[i].name, "mixture of", 10) == 0)
            return graph->frame.resources[i].layers;
    }
    return 0;
}

static uint32_t layers_of_material(fixture *f, lobe_scene *scene, const lobe_material *material,
                                   const char *knob, uint64_t *bytes) {
    scene_end_with_square(scene, material);
    assert_int_equal(lobe_renderer_set_scene(f->renderer, scene), LOBE_OK);
    picture_request request = request_for("lobes", knob);
    lobe_frame frame = draw(f, &request);
    uint32_t layers = mixture_layers(f);
    *bytes = frame.filtered_bytes;
    lobe_frame_free(&frame);
    assert_int_equal(lobe_renderer_set_scene(f->renderer, NULL), LOBE_OK);
    lobe_scene_destroy(&scene);
    return layers;
}

/// Without a normal map one cluster has all lobes: a single layer, with its bytes. Two widths need
/// the lobes' mean length and a layer of their own.
static void no_normal_map_means_one_lobe(void **state) {
    uint64_t bytes;
    lobe_scene *scene = scene_begin();
    lobe_material material = half_vector_material(LOBE_DISTRIBUTION_VMF, 20);
    material.width_map = scene_add_map(scene, random_map(64, 32, 0.5, 2, 61));
    assert_int_equal(layers_of_material(*state, scene, &material, "widths=one", &bytes), 1);
    reduced_map map = {.width = 32, .height = 16, .layers = 1, .levels = 6};
    assert_int_equal(bytes, passes_reduced_map_bytes(&map, LOBE_FORMAT_RGBA32_FLOAT));
    scene = scene_begin();
    material.width_map = scene_add_map(scene, random_map(64, 32, 0.5, 2, 61));
    assert_int_equal(layers_of_material(*state, scene, &material, "storage=float16", &bytes), 3);
    map.layers = 3;
    assert_int_equal(bytes, passes_reduced_map_bytes(&map, LOBE_FORMAT_RGBA16_FLOAT));
}

/// As many layers as the subdivision has, plus one for means only if they cannot be computed from
/// the others, and those of the widths only where these vary.
static void layers_are_those_that_are_read(void **state) {
    static const uint32_t layers[] = {1, 5, 13};
    static const char *const knobs[] = {"subdivision=0", "subdivision=1", "subdivision=2"};
    uint64_t bytes;
    for (int i = 0; i < 3; i++) {
        lobe_scene *scene = scene_begin();
        lobe_material material = half_vector_material(LOBE_DISTRIBUTION_VMF, 20);
        material.normal_map = scene_add_map(scene, random_normal_map(8, 8, 0.3, 62));
        assert_int_equal(layers_of_material(*state, scene, &material, knobs[i], &bytes), layers[i]);
        // Microfacets of varying roughness need the mean of their base lobes, the moments of widths
        // and their means in the clusters.
        scene = scene_begin();
        lobe_material_default(&material);
        material.normal_map = scene_add_map(scene, random_normal_map(8, 8, 0.3, 63));
        material.metallic_roughness_map = scene_add_map(scene, random_map(8, 8, 0.2, 1, 64));
        assert_int_equal(layers_of_material(*state, scene, &material, knobs[i], &bytes),
                         layers[i] + 1 + 1 + (uint32_t)i);
    }
}

/// Channels of a width map that say nothing of widths may vary.
static void maps_of_one_width_need_no_layers_of_widths(void **state) {
    uint64_t bytes;
    for (int i = 0; i < 3; i++) {
        lobe_scene *scene = scene_begin();
        lobe_material material = half_vector_material(LOBE_DISTRIBUTION_VMF, 20);
        lobe_texture_use *use = i == 0 ? &material.width_map : &material.metallic_roughness_map;
        if (i > 0)
            material = microfacet_material(LOBE_DISTRIBUTION_GGX, i == 1 ? 0.5f : 0, 1);
        lobe_image texels = random_map(64, 32, 0.5, 1, 65);
        for (size_t texel = 0; i < 2 && texel < (size_t)64 * 32; texel++)
            ((float *)texels.texels)[4 * texel + (size_t)i] = 0.75f;
        *use = scene_add_map(scene, texels);
        material.normal_map = scene_add_map(scene, random_normal_map(64, 32, 0.3, 66));
        assert_int_equal(layers_of_material(*state, scene, &material, "subdivision=2", &bytes), 14);
    }
}

// ---------------------------------------------------------------------------------------------
// Frames

static lobe_scene *varied_scene(void) {
    lobe_scene *scene = scene_begin();
    lobe_material material;
    lobe_material_default(&material);
    material.roughness = 0.5f;
    material.normal_map = scene_add_map(scene, random_normal_map(32, 24, 0.4, 71));
    material.base_colour_map = scene_add_map(scene, random_map(16, 16, 0, 1, 72));
    scene_add_square(scene, &material, 1, NULL);
    scene_add_sun(scene, (double[]){0.3, 1, 0.2}, 2);
    scene_look_down(scene, 2);
    scene_end(scene);
    return scene;
}

/// Asserts that the next frame runs shading and exactly the passes in `names`, which NULL ends.
static void check_frame(fixture *f, const picture_request *request, const char *const *names,
                        const char *what) {
    lobe_frame frame = draw(f, request);
    for (size_t i = 0; i < frame.pass_count; i++) {
        bool expected = strcmp(frame.passes[i].name, "shading") == 0;
        for (const char *const *name = names; *name; name++)
            expected = expected || strcmp(frame.passes[i].name, *name) == 0;
        if (!expected)
            fail_msg("%s: %s ran", what, frame.passes[i].name);
    }
    for (const char *const *name = names; *name; name++) {
        bool ran = false;
        for (size_t i = 0; i < frame.pass_count; i++)
            ran = ran || strcmp(frame.passes[i].name, *name) == 0;
        if (!ran)
            fail_msg("%s: %s did not run", what, *name);
    }
    lobe_frame_free(&frame);
}

static const char *const nothing[] = {NULL};
static const char *const lobe_maps[] = {"lobe_clustering", "level_reduction", NULL};
static const char *const mean_maps[] = {"parameter_averaging", "level_reduction", NULL};
static const char *const atlas_maps[] = {"surface_atlas", "lobe_clustering", "level_reduction",
                                         NULL};

static void a_still_scene_is_only_shaded(void **state) {
    static const struct {
        const char *filter, *knob;
        const char *const *built;
    } cases[] = {
        {"direct", NULL, nothing},
        {"mipmap", NULL, mean_maps},
        {"lobes", "space=tangent", lobe_maps},
        {"lobes", "space=object", atlas_maps},
        {"lobes", "space=camera", atlas_maps},
    };
    fixture *f = *state;
    lobe_scene *scene = varied_scene();
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        assert_int_equal(lobe_renderer_set_scene(f->renderer, scene), LOBE_OK);
        picture_request request = request_for(cases[i].filter, cases[i].knob);
        check_frame(f, &request, cases[i].built, "first frame");
        lobe_frame first = draw(f, &request);
        check_frame(f, &request, nothing, "third frame");
        lobe_frame fourth = draw(f, &request);
        assert_memory_equal(first.radiance.texels, fourth.radiance.texels,
                            (size_t)extent * extent * 16);
        lobe_frame_free(&first);
        lobe_frame_free(&fourth);
        // Maps do not depend on the picture's size or its outputs.
        request.width = 2 * extent;
        request.outputs = true;
        check_frame(f, &request, nothing, "larger picture");
    }
    assert_int_equal(lobe_renderer_set_scene(f->renderer, NULL), LOBE_OK);
    lobe_scene_destroy(&scene);
}

/// Moving the camera rebuilds only what is built in camera space.
static void a_moved_camera_rebuilds_camera_space_only(void **state) {
    static const char *const camera_maps[] = {"lobe_clustering", "level_reduction", NULL};
    static const struct {
        const char *knob;
        const char *const *rebuilt;
    } cases[] = {
        {"space=tangent", nothing}, {"space=object", nothing}, {"space=camera", camera_maps}};
    fixture *f = *state;
    lobe_scene *scene = varied_scene();
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        scene_look_down(scene, 2);
        assert_int_equal(lobe_renderer_set_scene(f->renderer, scene), LOBE_OK);
        picture_request request = request_for("lobes", cases[i].knob);
        lobe_frame frame = draw(f, &request);
        lobe_frame_free(&frame);
        scene_look_from(scene, (double[]){0.2, 1, 0.1}, 2);
        check_frame(f, &request, cases[i].rebuilt, cases[i].knob);
    }
    assert_int_equal(lobe_renderer_set_scene(f->renderer, NULL), LOBE_OK);
    lobe_scene_destroy(&scene);
}

static void knobs_of_shading_rebuild_nothing(void **state) {
    static const char *const knobs[] = {"epsilon0=0.5", "epsilon1=0.5", "blend=0.3",  "probes=4",
                                        "anisotropy=4", "bias=1",       "view=lobes", "base=lobe"};
    fixture *f = *state;
    lobe_scene *scene = varied_scene();
    assert_int_equal(lobe_renderer_set_scene(f->renderer, scene), LOBE_OK);
    picture_request request = request_for("lobes", NULL);
    check_frame(f, &request, lobe_maps, "first frame");
    for (size_t i = 0; i < sizeof knobs / sizeof *knobs; i++) {
        request = request_for("lobes", knobs[i]);
        check_frame(f, &request, nothing, knobs[i]);
    }
    // Layers that did not exist before are built.
    request = request_for("lobes", "subdivision=0");
    lobe_frame frame = draw(f, &request);
    lobe_frame_free(&frame);
    request = request_for("lobes", "subdivision=1");
    check_frame(f, &request, lobe_maps, "subdivision");
    // Maps that `direct` does not declare were freed, so they are rebuilt.
    request = request_for("direct", NULL);
    check_frame(f, &request, nothing, "direct");
    request = request_for("lobes", "subdivision=1");
    check_frame(f, &request, lobe_maps, "back to lobes");
    assert_int_equal(lobe_renderer_set_scene(f->renderer, NULL), LOBE_OK);
    lobe_scene_destroy(&scene);
}

static void rebuild_runs_everything(void **state) {
    fixture *f = *state;
    lobe_scene *scene = varied_scene();
    assert_int_equal(lobe_renderer_set_scene(f->renderer, scene), LOBE_OK);
    size_t passes[3];
    lobe_frame frames[3];
    for (int i = 0; i < 3; i++) {
        lobe_render_parameters parameters = {.width = extent, .height = extent, .rebuild = i == 2};
        assert_int_equal(lobe_renderer_render(f->renderer, &parameters, &frames[i]), LOBE_OK);
        passes[i] = count_passes(lobe_renderer_graph(f->renderer), NULL, LOBE_PASS_RUN);
    }
    assert_true(passes[0] > 3);
    assert_int_equal(passes[1], 1);
    assert_int_equal(passes[2], passes[0]);
    size_t bytes = (size_t)extent * extent * 16;
    assert_memory_equal(frames[0].radiance.texels, frames[1].radiance.texels, bytes);
    assert_memory_equal(frames[0].radiance.texels, frames[2].radiance.texels, bytes);
    for (int i = 0; i < 3; i++)
        lobe_frame_free(&frames[i]);
    assert_int_equal(lobe_renderer_set_scene(f->renderer, NULL), LOBE_OK);
    lobe_scene_destroy(&scene);
}

static void dusk(const double direction[3], float radiance[3]) {
    for (int i = 0; i < 3; i++)
        radiance[i] = (float)(1 + direction[i]);
}

static void rebuilding_materials_keeps_the_environment(void **state) {
    fixture *f = *state;
    lobe_scene *scene = varied_scene();
    scene_surround(scene, 4, dusk);
    assert_int_equal(lobe_renderer_set_scene(f->renderer, scene), LOBE_OK);
    picture_request request = request_for("mipmap", "env_size=16");
    lobe_frame frame = draw(f, &request);
    const size_t all = count_passes(lobe_renderer_graph(f->renderer), NULL, LOBE_PASS_RUN);
    const char *const prepare[] = {"directional_albedo",       "environment_cube",
                                   "environment_poles",        "environment_level",
                                   "environment_reduction",    "environment_prefiltering",
                                   "environment_mixture",      "irradiance_harmonics",
                                   "irradiance_harmonics_sum", "irradiance_remainder"};
    size_t once = 0;
    for (size_t i = 0; i < sizeof prepare / sizeof *prepare; i++)
        once += count_passes(lobe_renderer_graph(f->renderer), prepare[i], LOBE_PASS_RUN);
    lobe_frame_free(&frame);
    const lobe_filter *filter;
    lobe_settings settings;
    assert_int_equal(lobe_filter_find("mipmap", NULL, &filter), LOBE_OK);
    lobe_settings_default(filter, &settings);
    assert_int_equal(lobe_settings_set(filter, &settings, "env_size=16", NULL), LOBE_OK);
    lobe_render_parameters parameters = {.filter = filter,
                                         .settings = &settings,
                                         .width = extent,
                                         .height = extent,
                                         .rebuild = true,
                                         .environment.keep = true};
    assert_int_equal(lobe_renderer_render(f->renderer, &parameters, &frame), LOBE_OK);
    assert_true(once > 3 && all > once + 1);
    assert_int_equal(count_passes(lobe_renderer_graph(f->renderer), NULL, LOBE_PASS_RUN),
                     all - once);
    lobe_frame_free(&frame);
    assert_int_equal(lobe_renderer_set_scene(f->renderer, NULL), LOBE_OK);
    lobe_scene_destroy(&scene);
}

/// A new scene with the same names does not get the maps of the old one.
static void a_new_scene_gets_its_own_maps(void **state) {
    fixture *f = *state;
    lobe_scene *first = varied_scene(), *second = varied_scene();
    float *texels = second->images[0].image.texels;
    for (size_t i = 0; i < (size_t)32 * 24 * 4; i += 4)
        texels[i] = 0.9f;
    picture_request request = request_for("lobes", NULL);
    lobe_frame expected = draw_scene(f, second, &request);
    assert_int_equal(lobe_renderer_set_scene(f->renderer, first), LOBE_OK);
    lobe_frame frame = draw(f, &request);
    assert_true(relative_l2(&frame.radiance, &expected.radiance) > 0.01);
    lobe_frame_free(&frame);
    assert_int_equal(lobe_renderer_set_scene(f->renderer, second), LOBE_OK);
    frame = draw(f, &request);
    assert_true(largest_difference(&frame.radiance, &expected.radiance) == 0);
    lobe_frame_free(&frame);
    lobe_frame_free(&expected);
    assert_int_equal(lobe_renderer_set_scene(f->renderer, NULL), LOBE_OK);
    lobe_scene_destroy(&first);
    lobe_scene_destroy(&second);
}

/// Squares of one material share its maps; in object space each has its own.
static void instances_share_what_they_can(void **state) {
    fixture *f = *state;
    lobe_scene *scene = varied_scene();
    float aside[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0.5f, 0.1f, 0, 1};
    assert_int_equal(scenes_add_instance(scene, 0, 0, aside, NULL), LOBE_OK);
    // Another material of the same images: the colours are filtered once for both.
    lobe_material second = scene->materials[0];
    second.name = NULL;
    second.roughness = 0.25f;
    scene_add_square(scene, &second, 1, NULL);
    static const struct {
        const char *knob;
        size_t clusterings;
    } cases[] = {{"space=tangent", 2}, {"space=object", 3}};
    for (int i = 0; i < 2; i++) {
        assert_int_equal(lobe_renderer_set_scene(f->renderer, scene), LOBE_OK);
        picture_request request = request_for("lobes", cases[i].knob);
        lobe_frame frame = draw(f, &request);
        lobe_graph *graph = lobe_renderer_graph(f->renderer);
        assert_int_equal(count_passes(graph, "lobe_clustering", LOBE_PASS_RUN),
                         cases[i].clusterings);
        size_t filtered_images = 0;
        for (uint32_t j = 0; j < graph->frame.dependencies.resource_count; j++)
            filtered_images += strncmp(graph->frame.resources[j].name, "filtered image", 14) == 0;
        assert_int_equal(filtered_images, 1);
        lobe_frame_free(&frame);
    }
    assert_int_equal(lobe_renderer_set_scene(f->renderer, NULL), LOBE_OK);
    lobe_scene_destroy(&scene);
}

/// What every frame uploads in place of harmonics is no larger than these.
static void methods_without_harmonics_upload_no_map_of_them(void **state) {
    static const char *const methods[] = {"env=mip", "env=exact"};
    fixture *f = *state;
    lobe_scene *scene = constant_scene(true, 16);
    scene_surround(scene, 16, dusk);
    assert_int_equal(lobe_renderer_set_scene(f->renderer, scene), LOBE_OK);
    for (int i = 0; i < 2; i++) {
        picture_request request = request_for("direct", methods[i]);
        request.settings[1] = "env_size=16";
        lobe_frame frame = draw(f, &request);
        const lobe_graph *graph = lobe_renderer_graph(f->renderer);
        size_t found = 0;
        for (uint32_t j = 0; j < graph->frame.dependencies.resource_count; j++) {
            if (strcmp(graph->frame.resources[j].name, "no harmonics") == 0) {
                assert_in_range(graph->frame.resources[j].size, 1, 256);
                found++;
            }
        }
        assert_int_equal(found, 1);
        lobe_frame_free(&frame);
    }
    assert_int_equal(lobe_renderer_set_scene(f->renderer, NULL), LOBE_OK);
    lobe_scene_destroy(&scene);
}

// ---------------------------------------------------------------------------------------------
// Code

/// The first draw of the shading pass in the last frame.
static const engine_graph_command *shading_draw(fixture *f) {
    const lobe_graph *graph = lobe_renderer_graph(f->renderer);
    for (uint32_t i = 0; i < graph->frame.dependencies.pass_count; i++) {
        if (strcmp(graph->frame.passes[i]->name, "shading") == 0)
            return graph->frame.passes[i]->first_command;
    }
    fail_msg("there is no shading pass");
    return NULL;
}

/// The value of a specialisation constant in the last frame's shading.
static uint32_t specialised(fixture *f, uint32_t id) {
    const engine_graph_command *command = shading_draw(f);
    for (size_t i = 0; i < command->draw.specialisation_count; i++) {
        if (command->draw.specialisation[i].id == id)
            return command->draw.specialisation[i].bits;
    }
    fail_msg("constant %u is not set", id);
    return 0;
}

/// Draws a scene of one material under one light; leaves it set.
static void draw_lit(fixture *f, lobe_scene *scene, const lobe_material *material,
                     lobe_light_type type, const picture_request *request) {
    lobe_light light = {.type = type,
                        .position = {0, 1, 0},
                        .direction = {0, -1, 0},
                        .intensity = {1, 1, 1},
                        .outer_cone = 1};
    scene_add_square(scene, material, 1, NULL);
    assert_int_equal(scenes_add_light(scene, &light, NULL), LOBE_OK);
    scene_look_down(scene, 2);
    scene_end(scene);
    assert_int_equal(lobe_renderer_set_scene(f->renderer, scene), LOBE_OK);
    lobe_frame frame = draw(f, request);
    assert_true(largest_value(&frame.radiance) > 0);
    lobe_frame_free(&frame);
}

static void absent_lights_are_compiled_out(void **state) {
    fixture *f = *state;
    static const lobe_light_type types[] = {LOBE_LIGHT_DIRECTIONAL, LOBE_LIGHT_POINT,
                                            LOBE_LIGHT_SPOT};
    static const uint32_t constants[] = {SPECIALISE_DIRECTIONAL_LIGHTS, SPECIALISE_POINT_LIGHTS,
                                         SPECIALISE_SPOT_LIGHTS};
    for (int i = 0; i < 3; i++) {
        lobe_scene *scene = scene_begin();
        lobe_material material;
        lobe_material_default(&material);
        picture_request request = request_for("lobes", NULL);
        draw_lit(f, scene, &material, types[i], &request);
        for (int j = 0; j < 3; j++)
            assert_int_equal(specialised(f, constants[j]), i == j);
        assert_int_equal(lobe_renderer_set_scene(f->renderer, NULL), LOBE_OK);
        lobe_scene_destroy(&scene);
    }
}

/// A mask that keeps all is none.
static void cut_first_texel(const lobe_image *image) {
    assert_int_equal(image->format, LOBE_FORMAT_RGBA32_FLOAT);
    ((float *)image->texels)[3] = 0;
}

static void absent_features_of_a_material_are_compiled_out(void **state) {
    fixture *f = *state;
    for (int all = 0; all < 2; all++) {
        lobe_scene *scene = scene_begin();
        lobe_material material = half_vector_material(LOBE_DISTRIBUTION_VMF, 20);
        if (all) {
            material = constant_material(scene, false, 2);
            material.alpha_mask = true;
            cut_first_texel(&scene->images[material.base_colour_map.image].image);
            material.normal_concentration = 50;
            material.base_colour[3] = 1;
        }
        picture_request request = request_for("lobes", NULL);
        draw_lit(f, scene, &material, LOBE_LIGHT_POINT, &request);
        assert_int_equal(specialised(f, SPECIALISE_MAPS), all ? 31 : 0);
        assert_int_equal(specialised(f, SPECIALISE_DIFFUSE), all);
        assert_int_equal(specialised(f, SPECIALISE_EMISSION), all);
        assert_int_equal(specialised(f, SPECIALISE_ALPHA_MASK), all);
        assert_int_equal(specialised(f, SPECIALISE_NORMAL_CONCENTRATION), all);
        assert_int_equal(specialised(f, SPECIALISE_VERTEX_COLOUR), 0);
        assert_int_equal(lobe_renderer_set_scene(f->renderer, NULL), LOBE_OK);
        lobe_scene_destroy(&scene);
    }
}

/// Outputs that are not requested are not attached, and the shader does not write them.
static void unused_outputs_are_compiled_out(void **state) {
    fixture *f = *state;
    lobe_scene *scene = varied_scene();
    assert_int_equal(lobe_renderer_set_scene(f->renderer, scene), LOBE_OK);
    picture_request request = request_for("lobes", NULL);
    lobe_frame frame = draw(f, &request);
    assert_null(frame.normal_depth.texels);
    assert_null(frame.lobes_level.texels);
    assert_int_equal(shading_draw(f)->pipeline->output_locations, 1);
    uint64_t bytes = lobe_graph_describe(lobe_renderer_graph(f->renderer))->transient_bytes;
    lobe_frame_free(&frame);
    request.outputs = true;
    frame = draw(f, &request);
    assert_non_null(frame.normal_depth.texels);
    assert_non_null(frame.lobes_level.texels);
    assert_int_equal(shading_draw(f)->pipeline->output_locations, 7);
    assert_true(bytes < lobe_graph_describe(lobe_renderer_graph(f->renderer))->transient_bytes);
    lobe_frame_free(&frame);
    assert_int_equal(lobe_renderer_set_scene(f->renderer, NULL), LOBE_OK);
    lobe_scene_destroy(&scene);
}

/// Choices are constants of the shader: another choice, another pipeline; the same choice, the same
/// pipeline. (Of numbers, see test_pipelines.c.)
static void choices_are_constants_of_the_shader(void **state) {
    static const char *const knobs[] = {"subdivision=0", "subdivision=1", "threshold=length",
                                        "probes=4",      "view=lobes",    "base=lobe",
                                        "space=object",  "view=level",    "anisotropy=4"};
    enum { COUNT = sizeof knobs / sizeof *knobs };
    fixture *f = *state;
    lobe_scene *scene = varied_scene();
    assert_int_equal(lobe_renderer_set_scene(f->renderer, scene), LOBE_OK);
    const engine_pipeline *pipelines[COUNT];
    for (size_t i = 0; i < 2 * COUNT; i++) {
        picture_request request = request_for("lobes", knobs[i % COUNT]);
        lobe_frame frame = draw(f, &request);
        lobe_frame_free(&frame);
        const engine_pipeline *pipeline = shading_draw(f)->pipeline;
        if (i >= COUNT)
            assert_ptr_equal(pipeline, pipelines[i - COUNT]);
        for (size_t j = 0; j < i && i < COUNT; j++)
            assert_ptr_not_equal(pipeline, pipelines[j]);
        if (i < COUNT)
            pipelines[i] = pipeline;
    }
    assert_int_equal(lobe_renderer_set_scene(f->renderer, NULL), LOBE_OK);
    lobe_scene_destroy(&scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(filters_agree_on_constant_maps),
        cmocka_unit_test(filters_agree_where_maps_are_magnified),
        cmocka_unit_test(a_constant_material_builds_nothing),
        cmocka_unit_test(no_normal_map_means_one_lobe),
        cmocka_unit_test(layers_are_those_that_are_read),
        cmocka_unit_test(maps_of_one_width_need_no_layers_of_widths),
        cmocka_unit_test(a_still_scene_is_only_shaded),
        cmocka_unit_test(a_moved_camera_rebuilds_camera_space_only),
        cmocka_unit_test(knobs_of_shading_rebuild_nothing),
        cmocka_unit_test(rebuild_runs_everything),
        cmocka_unit_test(rebuilding_materials_keeps_the_environment),
        cmocka_unit_test(a_new_scene_gets_its_own_maps),
        cmocka_unit_test(methods_without_harmonics_upload_no_map_of_them),
        cmocka_unit_test(instances_share_what_they_can),
        cmocka_unit_test(absent_lights_are_compiled_out),
        cmocka_unit_test(absent_features_of_a_material_are_compiled_out),
        cmocka_unit_test(unused_outputs_are_compiled_out),
        cmocka_unit_test(choices_are_constants_of_the_shader),
    };
    return cmocka_run_group_tests(tests, fixture_create, fixture_destroy);
}
