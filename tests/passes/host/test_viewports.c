// Pictures drawn into a part of a host's images, under synchronisation validation: the bits of a
// picture that has the viewport's size, and nothing else.

#include "tests/passes/support/fixture.h"

#include <stdlib.h>
#include <string.h>

#include "tests/engine/support/host_device.h"
#include "tests/passes/host/host_renderer.h"
#include "tests/passes/support/picture.h"
#include "tests/passes/support/scene_builder.h"

/// Of the targets, and the viewport: odd numbers, so that no tile of pixels begins where it does.
enum { WIDTH = 37, HEIGHT = 26 };
static const lobe_rectangle viewport = {11, 7, 19, 13};

typedef struct host_fixture {
    fixture passes;
    host_device host;
    lobe_scene *scene;
    lobe_camera other; ///< another view of the scene
} host_fixture;

static const VkImageUsageFlags transfers =
    VK_IMAGE_USAGE_TRANSFER_SRC_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;

static lobe_scene *masked_scene(void) {
    lobe_scene *scene = scene_begin();
    scene_add_masked_squares(scene, 2);
    scene_add_sun(scene, (double[]){0.2, 1, 0.1}, 2);
    scene_look_along(scene);
    scene->background[2] = 0.75f;
    scene_end(scene);
    return scene;
}

static int open_host(void **state) {
    host_fixture *f = calloc(1, sizeof *f);
    *state = f;
    f->passes.renderer = host_renderer_open(&f->host, &f->passes.device);
    f->scene = masked_scene();
    f->other = f->scene->camera;
    f->other.eye[0] += 0.3f;
    f->other.eye[1] += 0.2f;
    return lobe_renderer_set_scene(f->passes.renderer, f->scene) != LOBE_OK;
}

static int close_host(void **state) {
    host_fixture *f = *state;
    lobe_renderer_destroy(&f->passes.renderer);
    lobe_device_destroy(&f->passes.device);
    host_device_close(&f->host);
    lobe_scene_destroy(&f->scene);
    free(f);
    return 0;
}

static void render(host_fixture *f, lobe_renderer *renderer,
                   const lobe_render_parameters *parameters) {
    lobe_frame frame;
    if (lobe_renderer_render(renderer, parameters, &frame) != LOBE_OK)
        fail_msg("%s", f->host.recorder.last_error);
    lobe_frame_free(&frame);
}

// ---------------------------------------------------------------------------------------------
// Targets

enum { RADIANCE, DEPTH, MOTION, IMAGES };

typedef struct targets {
    host_image images[IMAGES];
    lobe_vulkan_image lent[IMAGES];
    size_t texel[IMAGES]; ///< bytes
    lobe_render_target target;
} targets;

/// `part`: a level of a layer, of an image with two of each.
static void create_targets(host_fixture *f, VkFormat format, uint32_t width, uint32_t height,
                           bool part, targets *t) {
    static const VkFormat other[] = {
        [DEPTH] = VK_FORMAT_D32_SFLOAT, [MOTION] = VK_FORMAT_R16G16_SFLOAT};
    for (int i = 0; i < IMAGES; i++) {
        const VkImageUsageFlags usage =
            transfers | (i == DEPTH ? VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT
                                    : VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT);
        const VkFormat own = i == RADIANCE ? format : other[i];
        host_image *image = &t->images[i];
        *image = part ? host_image_create_array(&f->host, own, 2 * width, 2 * height, 2, 2, usage)
                      : host_image_create(&f->host, own, width, height, usage);
        image->layer = image->level = part;
        t->texel[i] = lobe_format_size(lobe_vulkan_format(own));
        t->lent[i] = (lobe_vulkan_image){.image = image->image,
                                         .format = own,
                                         .width = width,
                                         .height = height,
                                         .first_layer = part,
                                         .first_level = part,
                                         .usage = usage,
                                         .final_layout = VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL};
    }
    t->target = (lobe_render_target){
        .radiance = &t->lent[RADIANCE], .depth = &t->lent[DEPTH], .motion = &t->lent[MOTION]};
}

static void destroy_targets(host_fixture *f, targets *t) {
    for (int i = 0; i < IMAGES; i++)
        host_image_destroy(&f->host, &t->images[i]);
}

static void *read_texels(host_fixture *f, const targets *t, int image) {
    const size_t size = (size_t)t->lent[image].width * t->lent[image].height * t->texel[image];
    void *texels = calloc(1, size);
    assert_non_null(texels);
    host_read(&f->host, &t->images[image], texels, size);
    return texels;
}

/// What the viewport of `whole` shows becomes the content of `part`.
static void copy_viewport(host_fixture *f, const targets *whole, targets *part) {
    VkCommandBuffer commands = host_begin(&f->host);
    for (int i = 0; i < IMAGES; i++) {
        const VkImageAspectFlags aspect =
            i == DEPTH ? VK_IMAGE_ASPECT_DEPTH_BIT : VK_IMAGE_ASPECT_COLOR_BIT;
        const host_image *from = &whole->images[i], *to = &part->images[i];
        const VkImageCopy copy = {.srcSubresource = {aspect, from->level, from->layer, 1},
                                  .srcOffset = {(int)viewport.x, (int)viewport.y, 0},
                                  .dstSubresource = {aspect, 0, 0, 1},
                                  .extent = {viewport.width, viewport.height, 1}};
        host_barrier(commands, to, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL);
        vkCmdCopyImage(commands, from->image, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, to->image,
                       VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &copy);
        part->lent[i].layout = VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL;
    }
    host_finish(&f->host, commands);
}

/// Texels of `after` in the viewport are those of `alone`, and others those of `before`. Returns in
/// how many pixels of the viewport something was drawn.
static unsigned compare_texels(const char *after, const char *alone, const char *before,
                               size_t texel) {
    unsigned drawn = 0;
    for (uint32_t y = 0; y < HEIGHT; y++)
        for (uint32_t x = 0; x < WIDTH; x++) {
            const size_t at = ((size_t)y * WIDTH + x) * texel;
            // Of pixels to the left of or above the viewport, columns and rows wrap around.
            const uint32_t column = x - viewport.x, row = y - viewport.y;
            const bool inside = column < viewport.width && row < viewport.height;
            const char *expected =
                inside ? alone + ((size_t)row * viewport.width + column) * texel : before + at;
            if (memcmp(after + at, expected, texel) != 0)
                fail_msg("pixel (%u, %u)", x, y);
            drawn += inside && memcmp(before + at, expected, texel) != 0;
        }
    return drawn;
}

// ---------------------------------------------------------------------------------------------
// The picture

typedef struct viewport_case {
    const char *filter, *settings[4];
    VkFormat format;
    bool keep, part, alone; ///< `alone`: radiance without depth and motion
} viewport_case;

static const viewport_case cases[] = {
    {"moments", {NULL}, VK_FORMAT_R32G32B32A32_SFLOAT, .keep = false},
    {"moments", {"samples=auto", NULL}, VK_FORMAT_B8G8R8A8_SRGB, .keep = true},
    {"mipmap", {"samples=4", NULL}, VK_FORMAT_B10G11R11_UFLOAT_PACK32, .part = true},
    {"lean", {"built=seen", "shading=deferred", NULL}, VK_FORMAT_R16G16B16A16_SFLOAT, .keep = true},
    {"direct", {NULL}, VK_FORMAT_A2B10G10R10_UNORM_PACK32, .keep = true, .part = true},
    {"reference", {NULL}, VK_FORMAT_R8G8B8A8_UNORM, .keep = true, .alone = true},
};

/// Over what another view drew, and the host takes from its place for the picture alone.
static void compare_case(host_fixture *f, const viewport_case *c) {
    const lobe_filter *filter = filter_named(c->filter);
    const lobe_settings settings = settings_of(filter, c->settings);
    lobe_render_parameters parameters = {.filter = filter,
                                         .settings = &settings,
                                         .reference.samples = 4,
                                         .motion.previous_camera = &f->other};
    targets whole, alone;
    create_targets(f, c->format, WIDTH, HEIGHT, c->part, &whole);
    create_targets(f, c->format, viewport.width, viewport.height, false, &alone);
    render(f, f->passes.renderer,
           &(lobe_render_parameters){.filter = filter_named("direct"),
                                     .camera = &f->other,
                                     .motion.previous_camera = &f->scene->camera,
                                     .host.target = &whole.target});
    void *before[IMAGES], *after, *expected;
    for (int i = 0; i < IMAGES; i++) {
        before[i] = read_texels(f, &whole, i);
        whole.lent[i].layout = VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL;
    }
    copy_viewport(f, &whole, &alone);
    whole.target.viewport = viewport;
    for (int n = 0; n < 2; n++) {
        lobe_render_target *target = n ? &whole.target : &alone.target;
        target->keep = c->keep;
        if (c->alone)
            target->depth = target->motion = NULL;
        parameters.host.target = target;
        render(f, f->passes.renderer, &parameters);
    }
    for (int i = 0; i < (c->alone ? 1 : IMAGES); i++) {
        after = read_texels(f, &whole, i);
        expected = read_texels(f, &alone, i);
        const unsigned drawn = compare_texels(after, expected, before[i], whole.texel[i]);
        if (drawn < 10)
            fail_msg("%s: image %d: %u pixels drawn", c->filter, i, drawn);
        free(after);
        free(expected);
    }
    for (int i = 0; i < IMAGES; i++)
        free(before[i]);
    destroy_targets(f, &whole);
    destroy_targets(f, &alone);
}

static void a_viewport_shows_the_picture_of_its_size(void **state) {
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        compare_case(*state, &cases[i]);
}

/// Two renderers, and one of them again, in one command buffer; the first of them finds no content.
static void views_share_a_target(void **state) {
    host_fixture *f = *state;
    lobe_renderer *second = NULL;
    targets whole;
    float *texels;
    assert_int_equal(lobe_renderer_create(f->passes.device, &f->host.recorder.host, &second),
                     LOBE_OK);
    assert_int_equal(lobe_renderer_set_scene(second, f->scene), LOBE_OK);
    create_targets(f, VK_FORMAT_R32G32B32A32_SFLOAT, WIDTH, HEIGHT, false, &whole);
    VkCommandBuffer commands = host_begin(&f->host);
    const lobe_vulkan_submission submission = {.commands = commands};
    lobe_render_parameters parameters = {
        .host = {.target = &whole.target, .submission = &submission, .frames_in_flight = 2}};
    const lobe_rectangle places[] = {{0, 0, 19, 13}, {19, 0, 18, 26}, {0, 13, 19, 13}};
    for (int n = 0; n < 3; n++) {
        whole.target.viewport = places[n];
        parameters.camera = n == 0 ? &f->scene->camera : &f->other;
        render(f, n == 1 ? second : f->passes.renderer, &parameters);
        for (int i = 0; i < IMAGES; i++)
            whole.lent[i].layout = VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL;
    }
    host_finish(&f->host, commands);
    texels = read_texels(f, &whole, RADIANCE);
    for (int n = 0; n < 3; n++) {
        lobe_frame frame;
        parameters = (lobe_render_parameters){.camera = n == 0 ? &f->scene->camera : &f->other,
                                              .width = places[n].width,
                                              .height = places[n].height};
        assert_int_equal(lobe_renderer_render(second, &parameters, &frame), LOBE_OK);
        const float *alone = frame.radiance.texels;
        for (uint32_t y = 0; y < places[n].height; y++)
            assert_memory_equal(texels + 4 * ((size_t)(places[n].y + y) * WIDTH + places[n].x),
                                alone + 4 * (size_t)y * places[n].width,
                                16 * (size_t)places[n].width);
        lobe_frame_free(&frame);
    }
    free(texels);
    destroy_targets(f, &whole);
    lobe_renderer_destroy(&second);
}

/// What the host's passes see, and draw over.
static void look_at_resources(void *user, lobe_graph *graph, lobe_render_stage stage,
                              lobe_render_resources *resources) {
    const lobe_image_description image = lobe_graph_describe_image(graph, resources->radiance);
    (void)stage;
    assert_int_equal(resources->width, viewport.width);
    assert_int_equal(resources->height, viewport.height);
    *(unsigned *)user += image.width == viewport.width && image.height == viewport.height;
}

static void passes_of_the_host_get_the_viewport(void **state) {
    host_fixture *f = *state;
    unsigned seen = 0;
    targets whole;
    create_targets(f, VK_FORMAT_R32G32B32A32_SFLOAT, WIDTH, HEIGHT, false, &whole);
    whole.target.viewport = viewport;
    render(f, f->passes.renderer,
           &(lobe_render_parameters){
               .host = {.target = &whole.target, .add_passes = look_at_resources, .user = &seen}});
    assert_int_equal(seen, 2);
    destroy_targets(f, &whole);
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

static bool count_calls(void *user, double part) {
    (void)part;
    ++*(unsigned *)user;
    return true;
}

/// Before it takes any of its samples.
static void the_reference_refuses_at_once(host_fixture *f, const lobe_render_target *target) {
    unsigned calls = 0;
    const lobe_render_target alone = {.radiance = target->radiance, .viewport = target->viewport};
    assert_refused(f,
                   &(lobe_render_parameters){
                       .filter = filter_named("reference"),
                       .reference.samples = 2,
                       .host = {.target = &alone, .progress = count_calls, .user = &calls}},
                   LOBE_ERROR_GRAPH, "transfer destination");
    assert_int_equal(calls, 0);
}

static void mistakes_are_refused(void **state) {
    static const lobe_rectangle beyond[] = {{30, 0, 8, 8}, {0, 20, 8, 7},         {0, 0, 38, 26},
                                            {37, 0, 1, 1}, {UINT32_MAX, 0, 2, 2}, {4, 4, 0, 0},
                                            {0, 0, 0, 5},  {0, 0, 5, UINT32_MAX}};
    host_fixture *f = *state;
    targets whole;
    create_targets(f, VK_FORMAT_R32G32B32A32_SFLOAT, WIDTH, HEIGHT, false, &whole);
    lobe_render_parameters parameters = {.host.target = &whole.target};
    for (size_t i = 0; i < sizeof beyond / sizeof *beyond; i++) {
        whole.target.viewport = beyond[i];
        assert_refused(f, &parameters, LOBE_ERROR_INVALID_ARGUMENT, "within a target of 37x26");
    }
    whole.target.viewport = viewport;
    whole.lent[DEPTH].height = 19;
    assert_refused(f, &parameters, LOBE_ERROR_INVALID_ARGUMENT,
                   "a viewport of 19x13 pixels at (11, 7) does not lie within a target of 37x19");
    whole.lent[DEPTH].height = HEIGHT;
    parameters.width = WIDTH;
    assert_refused(f, &parameters, LOBE_ERROR_INVALID_ARGUMENT,
                   "37x13 pixels for a viewport of 19x13");
    parameters.width = 0;
    whole.lent[RADIANCE].usage &= ~(VkImageUsageFlags)VK_IMAGE_USAGE_TRANSFER_DST_BIT;
    assert_refused(f, &parameters, LOBE_ERROR_GRAPH, "transfer destination");
    the_reference_refuses_at_once(f, &whole.target);
    whole.lent[RADIANCE].usage = transfers; // it is only copied to
    render(f, f->passes.renderer, &parameters);
    destroy_targets(f, &whole);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_viewport_shows_the_picture_of_its_size),
        cmocka_unit_test(views_share_a_target),
        cmocka_unit_test(passes_of_the_host_get_the_viewport),
        cmocka_unit_test(mistakes_are_refused),
    };
    return cmocka_run_group_tests(tests, open_host, close_host);
}
