// Pictures drawn into the images of a host with its own Vulkan device: the same bits as delivered
// pictures, however they are submitted, and over what the host drew.

#include "tests/passes/support/fixture.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include <lobe/colour.h>

#include "tests/engine/support/host_device.h"
#include "tests/passes/host/host_renderer.h"
#include "tests/passes/support/picture.h"
#include "tests/passes/support/scene_builder.h"

enum { SIZE = 16 };

typedef struct host_fixture {
    fixture passes;
    host_device host;
    lobe_scene *scene;
    host_image colour, depth;
} host_fixture;

static const VkImageUsageFlags colour_usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT |
                                              VK_IMAGE_USAGE_TRANSFER_SRC_BIT |
                                              VK_IMAGE_USAGE_TRANSFER_DST_BIT;
static const VkImageUsageFlags depth_usage = VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT |
                                             VK_IMAGE_USAGE_TRANSFER_SRC_BIT |
                                             VK_IMAGE_USAGE_TRANSFER_DST_BIT;

/// A square surrounded by background.
static lobe_scene *small_scene(void) {
    lobe_scene *scene = scene_begin();
    lobe_material material = half_vector_material(LOBE_DISTRIBUTION_VMF, 50);
    material.base_colour[1] = 0.5f;
    material.normal_map = scene_add_map(scene, random_normal_map(32, 32, 0.4, 131));
    scene_add_square(scene, &material, 1, NULL);
    scene_add_sun(scene, (double[]){0.2, 1, 0.1}, 2);
    scene_look_down(scene, 3);
    scene->background[2] = 0.75f;
    scene_end(scene);
    return scene;
}

static int open_host(void **state) {
    host_fixture *f = calloc(1, sizeof *f);
    *state = f;
    f->passes.renderer = host_renderer_open(&f->host, &f->passes.device);
    f->scene = small_scene();
    f->colour =
        host_image_create(&f->host, VK_FORMAT_R32G32B32A32_SFLOAT, SIZE, SIZE, colour_usage);
    f->depth = host_image_create(&f->host, VK_FORMAT_D32_SFLOAT, SIZE, SIZE, depth_usage);
    return lobe_renderer_set_scene(f->passes.renderer, f->scene) != LOBE_OK;
}

static int close_host(void **state) {
    host_fixture *f = *state;
    lobe_renderer_destroy(&f->passes.renderer);
    lobe_device_destroy(&f->passes.device);
    host_image_destroy(&f->host, &f->colour);
    host_image_destroy(&f->host, &f->depth);
    host_device_close(&f->host);
    lobe_scene_destroy(&f->scene);
    free(f);
    return 0;
}

static lobe_vulkan_image lend(const host_image *image, VkImageUsageFlags usage,
                              VkImageLayout layout) {
    return (lobe_vulkan_image){.image = image->image,
                               .format = image->format,
                               .width = image->width,
                               .height = image->height,
                               .usage = usage,
                               .layout = layout,
                               .final_layout = VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL};
}

static lobe_frame render(host_fixture *f, const lobe_render_parameters *parameters) {
    lobe_frame frame;
    if (lobe_renderer_render(f->passes.renderer, parameters, &frame) != LOBE_OK)
        fail_msg("%s", f->host.recorder.last_error);
    return frame;
}

/// The picture that the renderer delivers without a target.
static lobe_frame delivered(host_fixture *f, const lobe_camera *camera) {
    return render(f, &(lobe_render_parameters){.camera = camera, .width = SIZE, .height = SIZE});
}

static lobe_image host_texels(const host_fixture *f, const host_image *image) {
    lobe_image texels;
    assert_int_equal(
        lobe_image_allocate(&texels, lobe_vulkan_format(image->format), SIZE, SIZE, NULL), LOBE_OK);
    host_read(&f->host, image, texels.texels,
              (size_t)SIZE * SIZE * lobe_format_size(texels.format));
    return texels;
}

static void assert_same_bits(const lobe_image *a, const lobe_image *b) {
    assert_int_equal(a->format, b->format);
    assert_memory_equal(a->texels, b->texels, (size_t)SIZE * SIZE * lobe_format_size(a->format));
}

static void fill(host_fixture *f, const float colour[4], float depth) {
    const VkImageSubresourceRange range = {VK_IMAGE_ASPECT_DEPTH_BIT, 0, 1, 0, 1};
    const VkClearDepthStencilValue value = {.depth = depth};
    VkCommandBuffer commands = host_begin(&f->host);
    host_barrier(commands, &f->colour, VK_IMAGE_LAYOUT_UNDEFINED,
                 VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL);
    host_clear(commands, &f->colour, colour);
    host_barrier(commands, &f->depth, VK_IMAGE_LAYOUT_UNDEFINED,
                 VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL);
    vkCmdClearDepthStencilImage(commands, f->depth.image, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
                                &value, 1, &range);
    host_finish(&f->host, commands);
}

// ---------------------------------------------------------------------------------------------
// Targets

static void the_hosts_image_gets_the_same_bits(void **state) {
    host_fixture *f = *state;
    lobe_frame expected = delivered(f, NULL);
    for (int given = 0; given < 2; given++) {
        lobe_vulkan_image colour = lend(&f->colour, colour_usage, VK_IMAGE_LAYOUT_UNDEFINED);
        lobe_vulkan_image depth = lend(&f->depth, depth_usage, VK_IMAGE_LAYOUT_UNDEFINED);
        const lobe_render_target target = {.radiance = &colour, .depth = given ? &depth : NULL};
        lobe_frame frame = render(f, &(lobe_render_parameters){.host.target = &target});
        assert_null(frame.radiance.texels);
        assert_int_equal(frame.pass_count, 1); // maps are reused
        lobe_image image = host_texels(f, &f->colour);
        assert_same_bits(&image, &expected.radiance);
        lobe_image_free(&image);
        lobe_frame_free(&frame);
    }
    lobe_frame_free(&expected);
}

/// A host draws what lies before and behind with the same depths.
static void depths_follow_from_the_camera(void **state) {
    host_fixture *f = *state;
    lobe_camera camera = f->scene->camera; // 4 m above the square, which is level
    camera.near_plane = 0.5f;
    for (int perspective = 0; perspective < 2; perspective++) {
        camera.vertical_field_of_view = perspective ? 0.5f : 0;
        lobe_vulkan_image colour = lend(&f->colour, colour_usage, VK_IMAGE_LAYOUT_UNDEFINED);
        lobe_vulkan_image depth = lend(&f->depth, depth_usage, VK_IMAGE_LAYOUT_UNDEFINED);
        const lobe_render_target target = {.radiance = &colour, .depth = &depth};
        lobe_frame frame =
            render(f, &(lobe_render_parameters){.camera = &camera, .host.target = &target});
        float texels[SIZE * SIZE];
        host_read(&f->host, &f->depth, texels, sizeof texels);
        assert_float_equal(texels[SIZE / 2 * SIZE + SIZE / 2],
                           perspective ? 0.5 / 4 : 1 - (4 - 0.5) / (1.01 * 4 - 0.5), 1e-5);
        lobe_frame_free(&frame);
    }
}

static void other_outputs_are_still_delivered(void **state) {
    host_fixture *f = *state;
    lobe_vulkan_image colour = lend(&f->colour, colour_usage, VK_IMAGE_LAYOUT_UNDEFINED);
    const lobe_render_target target = {.radiance = &colour};
    lobe_frame frame = render(f, &(lobe_render_parameters){.host.target = &target, .aov = true});
    assert_null(frame.radiance.texels);
    assert_true(pixel_at(&frame.normal_depth, SIZE / 2, SIZE / 2)[1] > 0.5f);
    lobe_frame_free(&frame);
}

/// The host's colour stays where nothing is hit, and where the host's depth is nearer.
static void check_over_what_the_host_drew(host_fixture *f, const lobe_settings *settings) {
    static const float green[4] = {0, 0.5f, 0, 1};
    lobe_render_parameters parameters = {.settings = settings, .width = SIZE, .height = SIZE};
    lobe_frame expected = render(f, &parameters);
    for (int nearer = 0; nearer < 2; nearer++) {
        fill(f, green, nearer ? 1 : 0);
        lobe_vulkan_image colour =
            lend(&f->colour, colour_usage, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL);
        lobe_vulkan_image depth =
            lend(&f->depth, depth_usage, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL);
        const lobe_render_target target = {.radiance = &colour, .depth = &depth, .keep = true};
        parameters.host.target = &target;
        lobe_frame frame = render(f, &parameters);
        lobe_image image = host_texels(f, &f->colour);
        unsigned covered = 0;
        for (uint32_t n = 0; n < SIZE * SIZE; n++) {
            const float *own = pixel_at(&expected.radiance, n % SIZE, n / SIZE);
            bool visible = own[3] > 0 && !nearer;
            covered += visible;
            assert_memory_equal(pixel_at(&image, n % SIZE, n / SIZE), visible ? own : green, 16);
        }
        assert_true(nearer ? covered == 0 : covered > 50 && covered < 200);
        lobe_image_free(&image);
        lobe_frame_free(&frame);
    }
    lobe_frame_free(&expected);
}

static void lobe_draws_over_what_the_host_drew(void **state) {
    check_over_what_the_host_drew(*state, NULL);
}

/// More than one pass draws.
static void many_lights_are_drawn_over_what_the_host_drew(void **state) {
    static const char *const closed[] = {"normal_mapping=microfacet", NULL};
    host_fixture *f = *state;
    const size_t before = f->scene->light_count;
    const lobe_settings settings = settings_of(filter_named("moments"), closed);
    for (int i = 0; i < 20; i++)
        scene_add_sun(f->scene, (const double[]){0.1 * i, 1, 0.2}, 0.1);
    check_over_what_the_host_drew(f, &settings);
    f->scene->light_count = before;
}

/// Further samples (knob samples) are blended by the part of the pixel that they cover, once.
static void several_samples_are_drawn_over_what_the_host_drew(void **state) {
    static const float green[4] = {0, 0.5f, 0, 1};
    static const char *const several[] = {"samples=8", NULL};
    host_fixture *f = *state;
    const lobe_settings settings = settings_of(filter_named("moments"), several);
    lobe_render_parameters parameters = {.settings = &settings, .width = SIZE, .height = SIZE};
    lobe_frame expected = render(f, &parameters);
    for (int nearer = 0; nearer < 2; nearer++) {
        fill(f, green, nearer ? 1 : 0);
        lobe_vulkan_image colour =
            lend(&f->colour, colour_usage, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL);
        lobe_vulkan_image depth =
            lend(&f->depth, depth_usage, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL);
        const lobe_render_target target = {.radiance = &colour, .depth = &depth, .keep = true};
        parameters.host.target = &target;
        lobe_frame frame = render(f, &parameters);
        lobe_image image = host_texels(f, &f->colour);
        unsigned parts = 0;
        for (uint32_t n = 0; n < SIZE * SIZE; n++) {
            const float *own = pixel_at(&expected.radiance, n % SIZE, n / SIZE);
            const float part = nearer ? 0 : own[3];
            parts += part > 0 && part < 1;
            for (int channel = 0; channel < 4; channel++) {
                // What the delivered picture has behind the square is its background.
                float background = channel < 3 ? f->scene->background[channel] : 0;
                float value = (own[channel] - (1 - own[3]) * background) * (part > 0) +
                              (1 - part) * green[channel];
                assert_float_equal(pixel_at(&image, n % SIZE, n / SIZE)[channel], value, 1e-5);
            }
        }
        assert_true(nearer ? parts == 0 : parts > 10);
        lobe_image_free(&image);
        lobe_frame_free(&frame);
    }
    lobe_frame_free(&expected);
}

static lobe_scene *masked_scene(void) {
    lobe_scene *scene = scene_begin();
    scene_add_masked_squares(scene, 1);
    scene_look_down(scene, 3);
    scene_end(scene);
    return scene;
}

/// The mask is shaded with its triangles, over the depth of the surfaces that are shaded before, in
/// an image that can only be drawn into.
static void tiles_are_marked_over_the_hosts_depth(void **state) {
    static const char *const deferred[] = {"built=seen", "shading=deferred", NULL};
    host_fixture *f = *state;
    lobe_scene *scene = masked_scene();
    const lobe_settings settings = settings_of(filter_named("lean"), deferred);
    lobe_render_parameters parameters = {
        .filter = filter_named("lean"), .settings = &settings, .width = SIZE, .height = SIZE};
    assert_int_equal(lobe_renderer_set_scene(f->passes.renderer, scene), LOBE_OK);
    lobe_vulkan_image colour = lend(&f->colour, colour_usage, VK_IMAGE_LAYOUT_UNDEFINED);
    lobe_vulkan_image depth =
        lend(&f->depth, VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT, VK_IMAGE_LAYOUT_UNDEFINED);
    depth.final_layout = VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL;
    const lobe_render_target target = {.radiance = &colour, .depth = &depth};
    parameters.host.target = &target;
    lobe_frame frame = render(f, &parameters);
    lobe_image image = host_texels(f, &f->colour);
    lobe_frame_free(&frame);
    parameters.host.target = NULL;
    parameters.settings = NULL;
    frame = render(f, &parameters);
    assert_same_bits(&image, &frame.radiance);
    lobe_frame_free(&frame);
    lobe_image_free(&image);
    assert_int_equal(lobe_renderer_set_scene(f->passes.renderer, f->scene), LOBE_OK);
    lobe_scene_destroy(&scene);
}

/// A visible environment is treated like any background.
static void the_environment_stays_behind_the_hosts_background(void **state) {
    static const float green[4] = {0, 0.5f, 0, 1};
    static const char *const quick[] = {"env=mip", "env_size=16", NULL};
    host_fixture *f = *state;
    const lobe_settings settings = settings_of(filter_named("moments"), quick);
    scene_set_environment(f->scene, constant_map(8, 4, 0.25f, 0.25f, 0.25f));
    f->scene->environment_visible = true;
    const lobe_scene_changes changes = {.environment = true};
    assert_int_equal(lobe_renderer_update_scene(f->passes.renderer, &changes), LOBE_OK);
    lobe_render_parameters parameters = {.settings = &settings, .width = SIZE, .height = SIZE};
    lobe_frame expected = render(f, &parameters);
    assert_float_equal(pixel_at(&expected.radiance, 0, 0)[1], 0.25f, 1e-3);
    fill(f, green, 0);
    lobe_vulkan_image colour = lend(&f->colour, colour_usage, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL);
    const lobe_render_target target = {.radiance = &colour, .keep = true};
    parameters.host.target = &target;
    lobe_frame frame = render(f, &parameters);
    lobe_image image = host_texels(f, &f->colour);
    const uint32_t middle = SIZE / 2;
    assert_memory_equal(pixel_at(&image, 0, 0), green, 16);
    assert_memory_equal(pixel_at(&image, middle, middle),
                        pixel_at(&expected.radiance, middle, middle), 16);
    lobe_scene_set_environment(f->scene, NULL);
    assert_int_equal(lobe_renderer_update_scene(f->passes.renderer, &changes), LOBE_OK);
    lobe_image_free(&image);
    lobe_frame_free(&frame);
    lobe_frame_free(&expected);
}

/// An image for displays: encoded, rounded to 256 steps.
static void formats_of_displays_are_encoded(void **state) {
    host_fixture *f = *state;
    host_image image =
        host_image_create(&f->host, VK_FORMAT_B8G8R8A8_SRGB, SIZE, SIZE, colour_usage);
    lobe_frame expected = delivered(f, NULL);
    lobe_vulkan_image colour = lend(&image, colour_usage, VK_IMAGE_LAYOUT_UNDEFINED);
    const lobe_render_target target = {.radiance = &colour};
    lobe_frame frame = render(f, &(lobe_render_parameters){.host.target = &target});
    lobe_image texels = host_texels(f, &image);
    for (uint32_t n = 0; n < SIZE * SIZE; n++)
        for (int channel = 0; channel < 3; channel++) {
            float linear = pixel_at(&expected.radiance, n % SIZE, n / SIZE)[channel];
            int stored = ((const uint8_t *)texels.texels)[4 * n + 2 - (uint32_t)channel];
            assert_float_equal(stored, 255 * lobe_srgb_encode(linear), 1);
        }
    lobe_image_free(&texels);
    lobe_frame_free(&frame);
    lobe_frame_free(&expected);
    host_image_destroy(&f->host, &image);
}

/// `bits` from the lowest on `shift`: a number without sign of five bits of exponent.
static float small_float(uint32_t texel, int shift, int bits) {
    const uint32_t value = texel >> shift & ((1u << bits) - 1);
    const int mantissa_bits = bits - 5;
    const uint32_t exponent = value >> mantissa_bits,
                   mantissa = value & ((1u << mantissa_bits) - 1);
    const float fraction = (float)mantissa / (float)(1 << mantissa_bits);
    return exponent > 0 ? ldexpf(1 + fraction, (int)exponent - 15) : ldexpf(fraction, -14);
}

static float packed_channel(VkFormat format, uint32_t texel, int channel) {
    if (format == VK_FORMAT_B10G11R11_UFLOAT_PACK32)
        return small_float(texel, 11 * channel, channel < 2 ? 11 : 10);
    const int place = format == VK_FORMAT_A2R10G10B10_UNORM_PACK32 ? 2 - channel : channel;
    return (float)(texel >> 10 * place & 1023) / 1023;
}

/// High dynamic range in 32 bits, and displays of more than 256 steps; also over what was there.
static void formats_with_packed_channels_are_drawn_into(void **state) {
    static const VkFormat formats[] = {VK_FORMAT_B10G11R11_UFLOAT_PACK32,
                                       VK_FORMAT_A2B10G10R10_UNORM_PACK32,
                                       VK_FORMAT_A2R10G10B10_UNORM_PACK32};
    static const char *const several[] = {"samples=8", NULL};
    host_fixture *f = *state;
    const lobe_settings settings = settings_of(filter_named("moments"), several);
    const float *behind = f->scene->background;
    const float background[4] = {behind[0], behind[1], behind[2], 1};
    lobe_render_parameters parameters = {.settings = &settings, .width = SIZE, .height = SIZE};
    lobe_frame expected = render(f, &parameters);
    for (int n = 0; n < 6; n++) {
        const bool over = n % 2;
        host_image image = host_image_create(&f->host, formats[n / 2], SIZE, SIZE, colour_usage);
        VkCommandBuffer commands = host_begin(&f->host);
        host_barrier(commands, &image, VK_IMAGE_LAYOUT_UNDEFINED,
                     VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL);
        host_clear(commands, &image, background);
        host_finish(&f->host, commands);
        lobe_vulkan_image colour = lend(&image, colour_usage, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL);
        const lobe_render_target target = {.radiance = &colour, .keep = over};
        parameters.host.target = &target;
        lobe_frame frame = render(f, &parameters);
        uint32_t texels[SIZE * SIZE];
        host_read(&f->host, &image, texels, sizeof texels);
        for (uint32_t i = 0; i < SIZE * SIZE; i++)
            for (int channel = 0; channel < 3; channel++) {
                const float value = pixel_at(&expected.radiance, i % SIZE, i / SIZE)[channel];
                const float most = n < 2 ? value : fminf(value, 1);
                assert_float_equal(packed_channel(image.format, texels[i], channel), most,
                                   n < 2 ? 0.035f * value + 1e-4f : 2.0f / 1023);
            }
        lobe_frame_free(&frame);
        host_image_destroy(&f->host, &image);
    }
    lobe_frame_free(&expected);
}

// ---------------------------------------------------------------------------------------------
// Submission

/// A camera that moves a little with each frame.
static lobe_camera camera_of(const host_fixture *f, int number) {
    lobe_camera camera = f->scene->camera;
    camera.orthographic_height *= 1 + 0.1f * (float)number;
    return camera;
}

static void frames_in_flight_are_those_delivered(void **state) {
    enum { FRAMES = 6 };
    host_fixture *f = *state;
    host_image images[FRAMES];
    VkSemaphore timeline = host_semaphore(&f->host, true);
    for (int n = 0; n < FRAMES; n++) {
        images[n] =
            host_image_create(&f->host, VK_FORMAT_R32G32B32A32_SFLOAT, SIZE, SIZE, colour_usage);
        lobe_camera camera = camera_of(f, n);
        lobe_vulkan_image colour = lend(&images[n], colour_usage, VK_IMAGE_LAYOUT_UNDEFINED);
        const lobe_render_target target = {.radiance = &colour};
        const lobe_vulkan_semaphore wait = {.semaphore = timeline, .value = (uint64_t)n};
        const lobe_vulkan_semaphore signal = {.semaphore = timeline, .value = (uint64_t)n + 1};
        const lobe_vulkan_submission submission = {
            .waits = &wait, .wait_count = 1, .signals = &signal, .signal_count = 1};
        lobe_frame frame = render(
            f, &(lobe_render_parameters){
                   .camera = &camera,
                   .host = {.target = &target, .submission = &submission, .frames_in_flight = 2}});
        assert_int_equal(frame.pass_count, 0);
        assert_int_equal(frame.submissions, 1);
        assert_true(frame.host_milliseconds > 0);
        lobe_frame_free(&frame);
    }
    assert_int_equal(lobe_graph_wait(lobe_renderer_graph(f->passes.renderer)), LOBE_OK);
    for (int n = 0; n < FRAMES; n++) {
        lobe_camera camera = camera_of(f, n);
        lobe_frame expected = delivered(f, &camera);
        lobe_image image = host_texels(f, &images[n]);
        assert_same_bits(&image, &expected.radiance);
        lobe_image_free(&image);
        lobe_frame_free(&expected);
        host_image_destroy(&f->host, &images[n]);
    }
    vkDestroySemaphore(f->host.vulkan.device, timeline, NULL);
}

/// The first picture's maps are built in the same command buffer, the second reuses them.
static void pictures_are_recorded_into_the_hosts_commands(void **state) {
    host_fixture *f = *state;
    lobe_image images[2];
    for (int n = 0; n < 2; n++) {
        VkCommandBuffer commands = host_begin(&f->host);
        lobe_vulkan_image colour = lend(&f->colour, colour_usage, VK_IMAGE_LAYOUT_UNDEFINED);
        const lobe_render_target target = {.radiance = &colour};
        const lobe_vulkan_submission submission = {.commands = commands};
        lobe_frame frame = render(
            f, &(lobe_render_parameters){.host = {.target = &target, .submission = &submission}});
        assert_true(frame.host_milliseconds > 0 && frame.milliseconds == 0);
        host_finish(&f->host, commands);
        lobe_frame_free(&frame);
        images[n] = host_texels(f, &f->colour);
    }
    assert_true(count_passes(lobe_renderer_graph(f->passes.renderer), NULL, LOBE_PASS_SKIPPED) > 0);
    lobe_frame expected = delivered(f, NULL);
    for (int n = 0; n < 2; n++) {
        assert_same_bits(&images[n], &expected.radiance);
        lobe_image_free(&images[n]);
    }
    lobe_frame_free(&expected);
}

// ---------------------------------------------------------------------------------------------
// Passes of the host

typedef struct added {
    unsigned calls[2];
    bool replace; ///< replaces the picture by a constant one
    bool shrink;  ///< replaces it by one of another extent
} added;

static void add_passes(void *user, lobe_graph *graph, lobe_render_stage stage,
                       lobe_render_resources *resources) {
    added *what = user;
    what->calls[stage]++;
    assert_int_equal(resources->width, SIZE);
    assert_int_equal(resources->height, SIZE);
    lobe_resource *radiance = &resources->radiance;
    if (stage == LOBE_RENDER_AFTER_SHADING && !what->replace)
        return;
    if (stage == LOBE_RENDER_AFTER_SHADING)
        *radiance = lobe_graph_image(
            graph, &(lobe_image_description){.name = "mine",
                                             .format = LOBE_FORMAT_RGBA32_FLOAT,
                                             .width = what->shrink ? SIZE / 2 : SIZE,
                                             .height = SIZE});
    float value = stage == LOBE_RENDER_BEFORE_SHADING ? 0.25f : 8;
    lobe_pass *pass = lobe_graph_add_pass(graph, LOBE_PASS_TRANSFER, "mine");
    *radiance =
        lobe_pass_fill(pass, *radiance, (lobe_range){0}, (float[4]){value, value, value, value});
}

static void hosts_add_passes_before_and_after(void **state) {
    host_fixture *f = *state;
    lobe_frame expected = delivered(f, NULL);
    added what = {0};
    lobe_render_parameters parameters = {
        .width = SIZE, .height = SIZE, .host = {.add_passes = add_passes, .user = &what}};
    lobe_frame frame = render(f, &parameters);
    assert_int_equal(what.calls[LOBE_RENDER_BEFORE_SHADING], 1);
    assert_int_equal(what.calls[LOBE_RENDER_AFTER_SHADING], 1);
    static const float quarter[4] = {0.25f, 0.25f, 0.25f, 0.25f};
    const uint32_t middle = SIZE / 2;
    assert_memory_equal(pixel_at(&frame.radiance, 0, 0), quarter, 16);
    assert_memory_equal(pixel_at(&frame.radiance, middle, middle),
                        pixel_at(&expected.radiance, middle, middle), 16);
    lobe_frame_free(&frame);
    what.replace = true;
    frame = render(f, &parameters);
    assert_float_equal(pixel_at(&frame.radiance, 5, 5)[0], 8, 0);
    lobe_frame_free(&frame);
    what.shrink = true;
    assert_int_equal(lobe_renderer_render(f->passes.renderer, &parameters, &frame),
                     LOBE_ERROR_INVALID_ARGUMENT);
    assert_null(frame.radiance.texels);
    assert_int_equal(f->host.recorder.errors, 1);
    lobe_frame_free(&expected);
}

// ---------------------------------------------------------------------------------------------
// The reference

enum { SAMPLES = 12 };

static lobe_render_parameters reference_parameters(const lobe_render_target *target) {
    return (lobe_render_parameters){.filter = filter_named("reference"),
                                    .width = SIZE,
                                    .height = SIZE,
                                    .reference.samples = SAMPLES,
                                    .host.target = target};
}

/// Waited for by lobe, by the host, or recorded into the host's commands.
static void the_reference_gets_into_the_hosts_image(void **state) {
    host_fixture *f = *state;
    lobe_render_parameters parameters = reference_parameters(NULL);
    lobe_frame expected = render(f, &parameters);
    lobe_vulkan_image colour = lend(&f->colour, colour_usage, VK_IMAGE_LAYOUT_UNDEFINED);
    const lobe_render_target target = {.radiance = &colour};
    for (int way = 0; way < 3; way++) {
        lobe_vulkan_submission submission = {.commands = way == 2 ? host_begin(&f->host) : NULL};
        parameters = reference_parameters(&target);
        parameters.host.submission = way > 0 ? &submission : NULL;
        lobe_frame frame = render(f, &parameters);
        assert_null(frame.radiance.texels);
        assert_int_equal(lobe_graph_wait(lobe_renderer_graph(f->passes.renderer)), LOBE_OK);
        if (submission.commands)
            host_finish(&f->host, submission.commands);
        lobe_image image = host_texels(f, &f->colour);
        assert_same_bits(&image, &expected.radiance);
        lobe_image_free(&image);
        lobe_frame_free(&frame);
        fill(f, (float[4]){0}, 0);
    }
    lobe_frame_free(&expected);
}

/// Where half of a pixel is covered, half of the host's colour shows.
static void the_reference_is_laid_over_what_the_host_drew(void **state) {
    host_fixture *f = *state;
    const float drawn[4] = {0.25f, 1, 0.5f, 1};
    lobe_render_parameters parameters = reference_parameters(NULL);
    lobe_frame expected = render(f, &parameters);
    fill(f, drawn, 0);
    lobe_vulkan_image colour = lend(&f->colour, colour_usage, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL);
    const lobe_render_target target = {.radiance = &colour, .keep = true};
    parameters = reference_parameters(&target);
    lobe_frame frame = render(f, &parameters);
    lobe_image image = host_texels(f, &f->colour);
    int partly = 0;
    for (uint32_t n = 0; n < SIZE * SIZE; n++) {
        const float *over = pixel_at(&image, n % SIZE, n / SIZE);
        const float *alone = pixel_at(&expected.radiance, n % SIZE, n / SIZE);
        partly += alone[3] > 0 && alone[3] < 1;
        for (int i = 0; i < 3; i++)
            assert_float_equal(over[i] - (1 - alone[3]) * drawn[i],
                               alone[i] - (1 - alone[3]) * f->scene->background[i], 1e-5f);
        assert_float_equal(over[3], 1, 1e-6f);
    }
    assert_true(partly > 4);
    lobe_image_free(&image);
    lobe_frame_free(&frame);
    lobe_frame_free(&expected);
}

// ---------------------------------------------------------------------------------------------
// Mistakes

static void assert_refused(host_fixture *f, const lobe_render_parameters *parameters,
                           lobe_result expected, const char *words) {
    lobe_frame frame;
    log_recorder_start(&f->host.recorder);
    assert_int_equal(lobe_renderer_render(f->passes.renderer, parameters, &frame), expected);
    assert_int_equal(f->host.recorder.errors, 1);
    if (!strstr(f->host.recorder.last_error, words))
        fail_msg("%s", f->host.recorder.last_error);
}

static void mistakes_are_refused(void **state) {
    host_fixture *f = *state;
    lobe_vulkan_image colour = lend(&f->colour, colour_usage, VK_IMAGE_LAYOUT_UNDEFINED);
    lobe_render_target target = {.radiance = &colour};
    assert_refused(f, &(lobe_render_parameters){.host.target = &target, .width = 2 * SIZE},
                   LOBE_ERROR_INVALID_ARGUMENT, "32x16 pixels for a target of 16x16");
    lobe_render_parameters reference = {.filter = filter_named("reference"),
                                        .reference.samples = 2};
    const lobe_vulkan_submission submission = {0};
    reference.host.submission = &submission;
    assert_refused(f, &reference, LOBE_ERROR_UNSUPPORTED, "reference");
    reference.host.target = &target;
    reference.width = 2 * SIZE;
    assert_refused(f, &reference, LOBE_ERROR_INVALID_ARGUMENT,
                   "32x16 pixels for a target of 16x16");
    lobe_vulkan_image depth = lend(&f->depth, depth_usage, VK_IMAGE_LAYOUT_UNDEFINED);
    target.depth = &depth;
    assert_refused(f, &reference, LOBE_ERROR_UNSUPPORTED, "target's depth");
    target.depth = NULL;
    colour.format = VK_FORMAT_UNDEFINED;
    reference.width = 0;
    assert_refused(f, &reference, LOBE_ERROR_UNSUPPORTED, "host image");
    colour.format = f->colour.format;
    target.keep = true;
    assert_refused(f, &(lobe_render_parameters){.host.target = &target}, LOBE_ERROR_GRAPH,
                   "host image");
    target.radiance = NULL;
    assert_refused(f, &(lobe_render_parameters){.host.target = &target},
                   LOBE_ERROR_INVALID_ARGUMENT, "without radiance");
    lobe_frame frame = delivered(f, NULL);
    assert_true(largest_value(&frame.radiance) > 0);
    lobe_frame_free(&frame);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_hosts_image_gets_the_same_bits),
        cmocka_unit_test(depths_follow_from_the_camera),
        cmocka_unit_test(other_outputs_are_still_delivered),
        cmocka_unit_test(lobe_draws_over_what_the_host_drew),
        cmocka_unit_test(many_lights_are_drawn_over_what_the_host_drew),
        cmocka_unit_test(several_samples_are_drawn_over_what_the_host_drew),
        cmocka_unit_test(tiles_are_marked_over_the_hosts_depth),
        cmocka_unit_test(the_environment_stays_behind_the_hosts_background),
        cmocka_unit_test(formats_of_displays_are_encoded),
        cmocka_unit_test(formats_with_packed_channels_are_drawn_into),
        cmocka_unit_test(frames_in_flight_are_those_delivered),
        cmocka_unit_test_setup_teardown(pictures_are_recorded_into_the_hosts_commands, open_host,
                                        close_host),
        cmocka_unit_test(hosts_add_passes_before_and_after),
        cmocka_unit_test(the_reference_gets_into_the_hosts_image),
        cmocka_unit_test(the_reference_is_laid_over_what_the_host_drew),
        cmocka_unit_test(mistakes_are_refused),
    };
    return cmocka_run_group_tests(tests, open_host, close_host);
}
