// A compute pipeline of a host evaluates what lobe filters, on the host's device: lights at once
// are as one by one, changed texels reach a pipeline and descriptors that stay as they are, masks
// cut by the host's own vertex colours, and maps of one material wrap each by itself.

#include "tests/passes/support/fixture.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

#include <lobe/maps.h>
#include <lobe/ocean.h>

#include "evaluation_leadr.h"
#include "evaluation_lean.h"
#include "evaluation_moments.h"
#include "tests/engine/support/host_device.h"
#include "tests/long_runs.h"
#include "tests/passes/own_shading/host_evaluation.h"
#include "tests/passes/support/picture.h"
#include "tests/passes/support/scene_builder.h"

enum { MAP = 16, POINTS = 64, CONSTANT_BASE = 7 };

#define CHECK(call) assert_int_equal(call, VK_SUCCESS)

/// Sums over the lights, one by one and at once; the first with whether the mask keeps the point.
typedef struct result {
    float one_by_one[4], at_once[4];
} result;

// ---------------------------------------------------------------------------------------------
// A host with maps

typedef struct subject {
    host_device host;
    lobe_device *device;
    lobe_scene *scene;
    const char *filter;
    const uint32_t *words; ///< of the host's shader
    size_t size;
} subject;

static void open_subject(subject *s, const char *filter, const uint32_t *words, size_t size) {
    host_device_open(&s->host);
    s->device = host_device_import(&s->host);
    s->filter = filter;
    s->words = words;
    s->size = size;
    s->scene = scene_begin();
    lobe_material material = microfacet_material(LOBE_DISTRIBUTION_BECKMANN, 0.6, 0.5);
    material.normal_map = scene_add_map(s->scene, random_normal_map(MAP, MAP, 0.5, 11));
    material.base_colour_map = scene_add_map(s->scene, random_map(MAP, MAP, 0.1, 0.9, 12));
    scene_end_with_square(s->scene, &material);
}

static void close_subject(subject *s) {
    lobe_scene_destroy(&s->scene);
    lobe_device_destroy(&s->device);
    host_device_close(&s->host);
}

/// Gives an image of the host for the first one of the scene.
static void give(void *user, lobe_graph *graph, const lobe_given_content *content) {
    content->images[0] = lobe_graph_import_image(graph, user);
}

/// `given`: what to give if the image is on the device.
static lobe_maps *make_maps(subject *s, lobe_vulkan_image *given) {
    const lobe_maps_parameters parameters = {.scene = s->scene,
                                             .filter = filter_named(s->filter),
                                             .lights_at_once = 4,
                                             .give_content = given ? give : NULL,
                                             .user = given};
    lobe_maps *maps;
    if (lobe_maps_create(s->device, &parameters, &s->host.recorder.host, &maps) != LOBE_OK)
        fail_msg("%s", s->host.recorder.last_error);
    return maps;
}

/// Filtering and evaluation in one command buffer.
static void evaluate(subject *s, lobe_maps *maps, host_evaluation *e, result results[POINTS]) {
    const host_shader shader = {s->words, s->size, CONSTANT_BASE, POINTS / 64};
    host_evaluation_run(e, &s->host, maps, &shader, results, POINTS * sizeof *results);
}

// ---------------------------------------------------------------------------------------------
// Tests

static void lights_at_once_are_as_one_by_one(void **state) {
    (void)state;
    subject s;
    host_evaluation e = {0};
    result results[POINTS];
    open_subject(&s, "moments", evaluation_moments, sizeof evaluation_moments);
    lobe_maps *maps = make_maps(&s, NULL);
    evaluate(&s, maps, &e, results);
    for (int i = 0; i < POINTS; i++)
        for (int channel = 0; channel < 3; channel++) {
            const float expected = results[i].one_by_one[channel];
            assert_true(expected > 0.01f && expected < 100);
            assert_float_equal(results[i].at_once[channel], expected, 1e-6f * expected);
        }
    host_evaluation_end(&e);
    lobe_maps_destroy(&maps);
    close_subject(&s);
}

/// As if the maps had been made of the changed texels, which `lean` prepares nothing for.
static void changed_texels_reach_the_same_pipeline(void **state) {
    (void)state;
    static const uint32_t first = 0;
    subject s;
    host_evaluation e = {0}, fresh = {0};
    result before[POINTS], after[POINTS], unchanged[POINTS], expected[POINTS];
    open_subject(&s, "lean", evaluation_lean, sizeof evaluation_lean);
    lobe_maps *maps = make_maps(&s, NULL);
    evaluate(&s, maps, &e, before);
    float *texels = s.scene->images[0].image.texels;
    for (size_t i = 0; i < 4 * MAP * MAP; i += 4)
        texels[i] = 1 - texels[i];
    evaluate(&s, maps, &e, unchanged); // nobody has said so
    assert_memory_equal(unchanged, before, sizeof before);
    assert_int_equal(
        lobe_maps_update(maps, &(lobe_scene_changes){.images = &first, .image_count = 1}), LOBE_OK);
    evaluate(&s, maps, &e, after);
    assert_memory_not_equal(after, before, sizeof before);
    lobe_maps *others = make_maps(&s, NULL);
    evaluate(&s, others, &fresh, expected);
    assert_memory_equal(after, expected, sizeof after);
    host_evaluation_end(&e);
    host_evaluation_end(&fresh);
    lobe_maps_destroy(&maps);
    lobe_maps_destroy(&others);
    close_subject(&s);
}

/// An image of one colour, which the host has made.
static lobe_vulkan_image clear_image(subject *s, const host_image *image, const float colour[4]) {
    VkCommandBuffer commands = host_begin(&s->host);
    host_barrier(commands, image, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL);
    host_clear(commands, image, colour);
    host_barrier(commands, image, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
                 VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
    host_finish(&s->host, commands);
    const VkImageViewCreateInfo create = {
        .sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO,
        .image = image->image,
        .viewType = VK_IMAGE_VIEW_TYPE_2D,
        .format = image->format,
        .subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1},
    };
    VkImageView view;
    CHECK(vkCreateImageView(s->host.vulkan.device, &create, NULL, &view));
    return (lobe_vulkan_image){.image = image->image,
                               .format = image->format,
                               .width = MAP,
                               .height = MAP,
                               .usage = VK_IMAGE_USAGE_SAMPLED_BIT,
                               .layout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL,
                               .final_layout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL,
                               .view = view};
}

static void an_image_of_the_host_is_read_in_place(void **state) {
    (void)state;
    static const float colour[] = {0.6f, 0.45f, 0.9f, 1};
    subject s;
    host_evaluation e = {0}, uploaded = {0};
    result results[POINTS], expected[POINTS];
    open_subject(&s, "lean", evaluation_lean, sizeof evaluation_lean);
    host_image image =
        host_image_create(&s.host, VK_FORMAT_R32G32B32A32_SFLOAT, MAP, MAP,
                          VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT);
    lobe_vulkan_image given = clear_image(&s, &image, colour);
    for (size_t i = 0; i < MAP * MAP; i++)
        memcpy((float *)s.scene->images[0].image.texels + 4 * i, colour, sizeof colour);
    lobe_maps *maps = make_maps(&s, NULL);
    evaluate(&s, maps, &uploaded, expected);
    s.scene->images[0].on_device = true;
    lobe_maps *others = make_maps(&s, &given);
    for (int recording = 0; recording < 2; recording++) {
        evaluate(&s, others, &e, results);
        assert_memory_equal(results, expected, sizeof expected);
    }
    host_evaluation_end(&e);
    host_evaluation_end(&uploaded);
    lobe_maps_destroy(&maps);
    lobe_maps_destroy(&others);
    vkDestroyImageView(s.host.vulkan.device, given.view, NULL);
    host_image_destroy(&s.host, &image);
    close_subject(&s);
}

/// Two channels of the host's, signed: what its shader sees is the same normal, stored as usual.
static void encodings_reach_the_hosts_shader(void **state) {
    (void)state;
    static const float usual[] = {0.65f, 0.3f, 0.9330127f, 1}, signed_xy[] = {0.3f, -0.4f, 0, 0};
    static const VkFormat formats[] = {VK_FORMAT_R32G32_SFLOAT, VK_FORMAT_R16G16_SNORM};
    for (int i = !long_runs(); i < (long_runs() ? 4 : 3); i++) {
        subject s;
        host_evaluation e = {0}, uploaded = {0};
        result results[POINTS], expected[POINTS];
        if (i % 2)
            open_subject(&s, "moments", evaluation_moments, sizeof evaluation_moments);
        else
            open_subject(&s, "lean", evaluation_lean, sizeof evaluation_lean);
        host_image image =
            host_image_create(&s.host, formats[i / 2], MAP, MAP,
                              VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT);
        lobe_vulkan_image given = clear_image(&s, &image, signed_xy);
        for (size_t t = 0; t < MAP * MAP; t++)
            memcpy((float *)s.scene->images[0].image.texels + 4 * t, usual, sizeof usual);
        lobe_maps *maps = make_maps(&s, NULL);
        evaluate(&s, maps, &uploaded, expected);
        for (size_t t = 0; t < MAP * MAP; t++)
            memcpy((float *)s.scene->images[0].image.texels + 4 * t, signed_xy, sizeof signed_xy);
        s.scene->images[0].normals = LOBE_NORMALS_SIGNED_XY;
        s.scene->images[0].on_device = true;
        lobe_maps *others = make_maps(&s, &given);
        evaluate(&s, others, &e, results);
        for (int n = 0; n < POINTS; n++)
            for (int channel = 0; channel < 3; channel++)
                assert_float_equal(results[n].one_by_one[channel], expected[n].one_by_one[channel],
                                   2e-3f * expected[n].one_by_one[channel]);
        host_evaluation_end(&e);
        host_evaluation_end(&uploaded);
        lobe_maps_destroy(&maps);
        lobe_maps_destroy(&others);
        vkDestroyImageView(s.host.vulkan.device, given.view, NULL);
        host_image_destroy(&s.host, &image);
        close_subject(&s);
    }
}

/// The material alone keeps all of its points. Without colours, their alpha is not read.
static void masks_cut_by_the_alpha_of_vertices(void **state) {
    (void)state;
    subject s;
    open_subject(&s, "lean", evaluation_lean, sizeof evaluation_lean);
    s.scene->materials[0].alpha_mask = true;
    s.scene->materials[0].alpha_cutoff = 0.5f;
    s.scene->materials[0].base_colour_map = LOBE_TEXTURE_NONE;
    for (int colours = 0; colours < 2; colours++) {
        host_evaluation e = {0};
        result results[POINTS];
        const lobe_maps_parameters parameters = {
            .scene = s.scene, .filter = filter_named("lean"), .vertex_colours = colours};
        lobe_maps *maps;
        assert_int_equal(lobe_maps_create(s.device, &parameters, &s.host.recorder.host, &maps),
                         LOBE_OK);
        evaluate(&s, maps, &e, results);
        for (int i = 0; i < POINTS; i++)
            assert_true(results[i].one_by_one[3] == (colours && i % 2 ? 0 : 1));
        host_evaluation_end(&e);
        lobe_maps_destroy(&maps);
    }
    close_subject(&s);
}

/// Beyond the maps' first tile, a mirrored one runs backwards beside one that repeats, as if its
/// transform did so. Away from the tile's edges, where neighbours differ.
static void maps_wrap_each_by_itself(void **state) {
    (void)state;
    subject s;
    host_evaluation e[2] = {{0}};
    result results[2][POINTS];
    open_subject(&s, "lean", evaluation_lean, sizeof evaluation_lean);
    lobe_material *material = &s.scene->materials[0];
    lobe_texture_use *widths = &material->metallic_roughness_map;
    *widths = scene_add_map(s.scene, random_map(MAP, MAP, 0.2, 1, 13));
    material->roughness = material->metallic = 1;
    material->normal_map.transform[0][2] = 1;
    for (int mirrored = 0; mirrored < 2; mirrored++) {
        widths->wrap_u = mirrored ? LOBE_SCENE_WRAP_MIRROR : LOBE_SCENE_WRAP_REPEAT;
        widths->transform[0][0] = mirrored ? 1 : -1;
        widths->transform[0][2] = 1;
        lobe_maps *maps = make_maps(&s, NULL);
        evaluate(&s, maps, &e[mirrored], results[mirrored]);
        host_evaluation_end(&e[mirrored]);
        lobe_maps_destroy(&maps);
    }
    for (int i = 0; i < POINTS; i++)
        for (int channel = 0; i % 8 >= 3 && i % 8 <= 5 && channel < 3; channel++) {
            const float expected = results[0][i].one_by_one[channel];
            assert_float_equal(results[1][i].one_by_one[channel], expected, 1e-4f * expected);
        }
    close_subject(&s);
}

// ---------------------------------------------------------------------------------------------
// Waves

typedef struct sea {
    lobe_ocean *ocean;
    double seconds;
} sea;

static void give_waves(void *user, lobe_graph *graph, const lobe_given_content *content) {
    const sea *s = user;
    content->waves[0] = lobe_ocean_add(s->ocean, graph, s->seconds);
}

/// Smith's Lambda of slopes of this variance each way.
static double lambda(const double direction[3], double variance) {
    const double sine = hypot(direction[0], direction[1]);
    if (sine == 0)
        return 0;
    const double a = direction[2] / (sine * sqrt(2 * variance));
    return 0.5 * (exp(-a * a) / (a * sqrt(M_PI)) - erfc(a));
}

/// The sum over the lights of evaluation.comp, of a white metal with slopes of this variance.
static double white_metal(double variance) {
    static const double lights[4][3] = {
        {0, 0, 1}, {0.6, 0, 0.8}, {0, -0.6, 0.8}, {-0.48, 0.64, 0.6}};
    const double length = sqrt(0.3 * 0.3 + 0.1 * 0.1 + 1);
    const double o[3] = {0.3 / length, -0.1 / length, 1 / length};
    double sum = 0;
    for (int k = 0; k < 4; k++) {
        const double *i = lights[k];
        const double h[3] = {o[0] + i[0], o[1] + i[1], o[2] + i[2]};
        const double square = (h[0] * h[0] + h[1] * h[1]) / (h[2] * h[2]);
        const double density = exp(-square / (2 * variance)) / (2 * M_PI * variance);
        sum += (1 + k) * density * pow(1 + square, 2) /
               (4 * o[2] * (1 + lambda(o, variance) + lambda(i, variance)));
    }
    return sum;
}

/// What the host's shader sees of a calm sea is what its waves are said to have, and of another,
/// other waves at each time.
static void waves_reach_the_hosts_shader(void **state) {
    (void)state;
    const double variance = 0.04;
    for (int windy = 0; windy < 2; windy++) {
        subject s;
        host_evaluation e = {0};
        result results[POINTS], later[POINTS];
        lobe_ocean_parameters parameters;
        lobe_ocean_default(&parameters);
        parameters.size = MAP;
        parameters.layers = 1;
        parameters.lengths[0] = 8;
        parameters.wind_speed = windy ? 8 : 0;
        open_subject(&s, "leadr", evaluation_leadr, sizeof evaluation_leadr);
        lobe_material *material = &s.scene->materials[0];
        lobe_release(material->name);
        *material = microfacet_material(LOBE_DISTRIBUTION_BECKMANN, 0.05, 1);
        material->waves = (lobe_waves){.layers = 1,
                                       .size = MAP,
                                       .lengths = {8},
                                       .choppy = true,
                                       .rest = {(float)variance, (float)variance},
                                       .total = {(float)variance, (float)variance}};
        sea sea = {.seconds = 1};
        assert_int_equal(
            lobe_ocean_create(s.device, &parameters, &s.host.recorder.host, &sea.ocean), LOBE_OK);
        const lobe_maps_parameters making = {.scene = s.scene,
                                             .filter = filter_named("leadr"),
                                             .lights_at_once = 4,
                                             .give_content = give_waves,
                                             .user = &sea};
        lobe_maps *maps;
        lobe_material_maps got;
        assert_int_equal(lobe_maps_create(s.device, &making, &s.host.recorder.host, &maps),
                         LOBE_OK);
        evaluate(&s, maps, &e, results);
        assert_int_equal(lobe_maps_get(maps, 0, &got), LOBE_OK);
        assert_true(got.waves && !got.closed_surface);
        const double expected = white_metal(variance + 0.5 * pow(0.05, 4));
        for (int i = 0; i < POINTS && !windy; i++)
            assert_float_equal(results[i].one_by_one[1], expected, 1e-3 * expected);
        sea.seconds = 2;
        evaluate(&s, maps, &e, later);
        assert_true((memcmp(results, later, sizeof results) != 0) == windy);
        host_evaluation_end(&e);
        lobe_maps_destroy(&maps);
        lobe_ocean_destroy(&sea.ocean);
        close_subject(&s);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lights_at_once_are_as_one_by_one),
        cmocka_unit_test(changed_texels_reach_the_same_pipeline),
        cmocka_unit_test(an_image_of_the_host_is_read_in_place),
        cmocka_unit_test(encodings_reach_the_hosts_shader),
        cmocka_unit_test(masks_cut_by_the_alpha_of_vertices),
        cmocka_unit_test(maps_wrap_each_by_itself),
        cmocka_unit_test(waves_reach_the_hosts_shader),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
