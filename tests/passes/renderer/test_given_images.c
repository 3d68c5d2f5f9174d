// Maps whose texels the host gives on the device: pictures equal those of the same texels uploaded,
// they may change in every frame without a wait, and what does not change is not rebuilt.

#include "tests/passes/support/fixture.h"

#include <math.h>
#include <string.h>

#include "tests/passes/host/host_renderer.h"
#include "tests/passes/support/picture.h"
#include "tests/passes/support/scene_builder.h"

enum { EXTENT = 16, MAP = 32, IMAGES = 3 };

/// Maps of normals, of roughness and metal, and of colours; `seed` decides their texels.
static lobe_scene *mapped_scene(uint64_t seed) {
    lobe_scene *scene = scene_begin();
    lobe_material material = microfacet_material(LOBE_DISTRIBUTION_GGX, 0.9, 1);
    material.normal_map = scene_add_map(scene, random_normal_map(MAP, MAP, 0.5, seed));
    material.metallic_roughness_map =
        scene_add_map(scene, random_map(MAP, MAP, 0.3, 0.9, seed + 1));
    material.base_colour_map = scene_add_map(scene, random_map(MAP, MAP, 0.1, 0.9, seed + 2));
    scene_add_square(scene, &material, 2, NULL);
    scene_add_sun(scene, (double[]){0.3, 1, 0.2}, 2);
    scene_add_sun(scene, (double[]){-0.5, 1, 0.1}, 1);
    scene_look_from(scene, (double[]){0.3, 1, 0.4}, 2);
    scene_end(scene);
    return scene;
}

/// What a host keeps to give texels.
typedef struct giver {
    lobe_texture *textures[IMAGES]; ///< NULL: that image is not given
    bool retained;                  ///< the copies stay from frame to frame
    unsigned calls;
} giver;

/// As a host's pass that simulates does: into an image of this frame.
static lobe_resource copied(const giver *g, lobe_graph *graph, size_t image) {
    static const char *const names[IMAGES] = {"copy 0", "copy 1", "copy 2"};
    const lobe_image_description description = {.name = names[image],
                                                .format = LOBE_FORMAT_RGBA32_FLOAT,
                                                .width = MAP,
                                                .height = MAP,
                                                .retained = g->retained};
    lobe_resource target = lobe_graph_image(graph, &description);
    lobe_pass *pass = lobe_graph_add_pass(graph, LOBE_PASS_TRANSFER, "give");
    return lobe_pass_copy(pass, lobe_graph_import_texture(graph, g->textures[image]),
                          (lobe_range){0}, target, (lobe_range){0});
}

static void give(void *user, lobe_graph *graph, const lobe_given_content *content) {
    giver *g = user;
    g->calls++;
    for (size_t i = 0; i < IMAGES; i++)
        if (g->textures[i])
            content->images[i] = copied(g, graph, i);
}

static giver giver_of(fixture *f, const lobe_scene *scene) {
    giver g = {0};
    for (size_t i = 0; i < scene->image_count; i++)
        assert_int_equal(
            lobe_texture_create(f->device,
                                &(lobe_texture_parameters){.image = &scene->images[i].image},
                                &g.textures[i]),
            LOBE_OK);
    return g;
}

static void giver_free(giver *g) {
    for (size_t i = 0; i < IMAGES; i++)
        lobe_texture_destroy(&g->textures[i]);
}

static void put_on_device(lobe_scene *scene, bool on_device) {
    for (size_t i = 0; i < scene->image_count; i++)
        scene->images[i].on_device = on_device;
}

static void set(fixture *f, const lobe_scene *scene) {
    if (lobe_renderer_set_scene(f->renderer, scene) != LOBE_OK)
        fail_msg("%s", f->error);
}

static void unset(fixture *f, lobe_scene **scene) {
    assert_int_equal(lobe_renderer_set_scene(f->renderer, NULL), LOBE_OK);
    lobe_scene_destroy(scene);
    assert_int_equal(f->errors, 0);
    assert_int_equal(lobe_device_validation_count(f->device), 0);
}

static lobe_render_parameters parameters_of(const char *filter) {
    return (lobe_render_parameters){
        .filter = filter_named(filter), .width = EXTENT, .height = EXTENT, .reference.samples = 12};
}

static lobe_frame picture(fixture *f, const char *filter, giver *g) {
    const lobe_render_parameters parameters = parameters_of(filter);
    lobe_frame frame;
    lobe_renderer_set_content_giver(f->renderer, g ? give : NULL, g);
    if (lobe_renderer_render(f->renderer, &parameters, &frame) != LOBE_OK)
        fail_msg("%s: %s", filter, f->error);
    return frame;
}

static uint64_t hash_of(fixture *f, const char *filter, giver *g) {
    lobe_frame frame = picture(f, filter, g);
    const uint64_t hash = image_hash(&frame.radiance);
    assert_true(largest_value(&frame.radiance) > 0.01);
    lobe_frame_free(&frame);
    return hash;
}

// ---------------------------------------------------------------------------------------------
// Pictures

/// Moments has the device fit bins to texels that are given, and the host to those uploaded.
static void check_picture(const char *filter, const lobe_frame *frame, const lobe_frame *expected) {
    const double difference = relative_l2(&frame->radiance, &expected->radiance);
    if (!(difference <= (strcmp(filter, "moments") == 0 ? 0.01 : 0)))
        fail_msg("%s: another picture, by %g", filter, difference);
}

static void every_filter_draws_what_it_draws_of_uploaded_texels(void **state) {
    fixture *f = *state;
    lobe_scene *scene = mapped_scene(300);
    lobe_frame uploaded[16];
    set(f, scene);
    for (size_t i = 0; i < lobe_filter_count(); i++)
        uploaded[i] = picture(f, lobe_filter_name(lobe_filter_get(i)), NULL);
    giver g = giver_of(f, scene);
    put_on_device(scene, true);
    set(f, scene);
    for (size_t i = 0; i < lobe_filter_count(); i++) {
        const char *filter = lobe_filter_name(lobe_filter_get(i));
        g.calls = 0;
        lobe_frame frame = picture(f, filter, &g);
        check_picture(filter, &frame, &uploaded[i]);
        lobe_frame_free(&frame);
        lobe_frame_free(&uploaded[i]);
        // Eight samples of the reference to a graph.
        assert_int_equal(g.calls, lobe_filter_supersamples(lobe_filter_get(i)) ? 2 : 1);
    }
    unset(f, &scene);
    giver_free(&g);
}

/// All filters' pictures are finite, and less than `most` (relative L2) from another.
static void check_filters(fixture *f, giver *g, const lobe_frame *truth, double most) {
    for (size_t i = 0; i < lobe_filter_count(); i++) {
        const char *filter = lobe_filter_name(lobe_filter_get(i));
        lobe_frame frame = picture(f, filter, g);
        const double error = relative_l2(&frame.radiance, &truth->radiance);
        print_message("# %s: error %.3f\n", filter, error);
        if (!all_finite(&frame.radiance) || !(error < most))
            fail_msg("%s: another picture, by %g", filter, error);
        lobe_frame_free(&frame);
    }
}

/// A texel in fifty of each map, one channel or all, as the host's shader might leave them.
static void spoil(const lobe_scene *scene, giver *g) {
    static const float nonsense[3] = {NAN, INFINITY, -INFINITY};
    for (size_t i = 0; i < IMAGES; i++) {
        lobe_image copy = map_image(LOBE_FORMAT_RGBA32_FLOAT, MAP, MAP);
        float *texels = copy.texels;
        memcpy(texels, scene->images[i].image.texels, (size_t)16 * MAP * MAP);
        for (uint32_t n = 0; n < MAP * MAP; n += 50)
            for (uint32_t channel = 0; channel < 4; channel++)
                if (n % 4 == 0 || channel == (n / 50 + i) % 4)
                    texels[4 * n + channel] = nonsense[n / 50 % 3];
        assert_int_equal(lobe_texture_update(g->textures[i], &copy), LOBE_OK);
        lobe_image_free(&copy);
    }
}

/// Texels that are not finite count as 0, or as flat normals.
static void texels_may_be_no_numbers(void **state) {
    fixture *f = *state;
    lobe_scene *scene = mapped_scene(300);
    giver g = giver_of(f, scene);
    set(f, scene);
    lobe_frame sound = picture(f, "reference", NULL);
    spoil(scene, &g);
    put_on_device(scene, true);
    set(f, scene);
    check_filters(f, &g, &sound, 0.7);
    lobe_frame_free(&sound);
    unset(f, &scene);
    giver_free(&g);
}

/// Where no filter has a subdivision that it learnt from an example.
static void texels_may_differ_in_every_frame(void **state) {
    static const char *const filters[] = {"direct", "mipmap", "toksvig", "lean", "leadr"};
    fixture *f = *state;
    lobe_scene *example = mapped_scene(310);
    put_on_device(example, true);
    for (uint64_t seed = 320; seed < 323; seed++) {
        lobe_scene *scene = mapped_scene(seed);
        uint64_t uploaded[5];
        set(f, scene);
        for (size_t i = 0; i < 5; i++)
            uploaded[i] = hash_of(f, filters[i], NULL);
        giver g = giver_of(f, scene);
        set(f, example);
        for (size_t i = 0; i < 5; i++)
            if (hash_of(f, filters[i], &g) != uploaded[i])
                fail_msg("%s: another picture", filters[i]);
        set(f, NULL);
        giver_free(&g);
        lobe_scene_destroy(&scene);
    }
    unset(f, &example);
}

/// Moments' bins follow the texels of each frame, whatever the example was.
static void bins_are_fitted_to_given_texels(void **state) {
    static const char *const filters[] = {"moments", "reference"};
    fixture *f = *state;
    lobe_scene *example = mapped_scene(312);
    lobe_image *normals = &example->images[0].image;
    for (size_t i = 0; i < (size_t)MAP * MAP; i++)
        memcpy((float *)normals->texels + 4 * i, (float[]){0.5f, 0.5f, 1, 1}, 16);
    put_on_device(example, true);
    for (uint64_t seed = 320; seed < 323; seed++) {
        lobe_scene *scene = mapped_scene(seed);
        lobe_frame uploaded[2];
        set(f, scene);
        for (int i = 0; i < 2; i++)
            uploaded[i] = picture(f, filters[i], NULL);
        giver g = giver_of(f, scene);
        set(f, example);
        lobe_frame frame = picture(f, "moments", &g);
        const double error = relative_l2(&frame.radiance, &uploaded[1].radiance),
                     expected = relative_l2(&uploaded[0].radiance, &uploaded[1].radiance);
        if (!(error <= 1.05 * expected))
            fail_msg("an error of %g instead of %g", error, expected);
        lobe_frame_free(&frame);
        for (int i = 0; i < 2; i++)
            lobe_frame_free(&uploaded[i]);
        set(f, NULL);
        giver_free(&g);
        lobe_scene_destroy(&scene);
    }
    unset(f, &example);
}

static void forget_texels(lobe_scene *scene) {
    put_on_device(scene, true);
    for (size_t i = 0; i < scene->image_count; i++) {
        lobe_release(scene->images[i].image.texels);
        scene->images[i].image.texels = NULL;
    }
}

/// Without an example, filters expect everything: some are less precise, but near.
static void no_example_is_needed(void **state) {
    fixture *f = *state;
    lobe_scene *scene = mapped_scene(330);
    giver g = giver_of(f, scene);
    set(f, scene);
    lobe_frame truth = picture(f, "reference", NULL);
    forget_texels(scene);
    set(f, scene);
    check_filters(f, &g, &truth, 0.5);
    lobe_frame_free(&truth);
    unset(f, &scene);
    giver_free(&g);
}

/// A weave: each texel has two lobes, which lean away from each other. One bin for both would draw
/// another picture.
static lobe_scene *woven_scene(uint64_t seed) {
    lobe_scene *scene = scene_begin();
    lobe_material material = half_vector_material(LOBE_DISTRIBUTION_VMF, 200);
    material.lobe_count = 2;
    for (uint32_t i = 0; i < 2; i++)
        material.lobes[i] =
            (lobe_base_lobe){{i ? 0.4f : -0.4f, 0, 0.9165f}, 200, {0.4f, 0.4f, 0.4f}};
    material.normal_map = scene_add_map(scene, random_normal_map(MAP, MAP, 0.3, seed));
    scene_add_square(scene, &material, 2, NULL);
    scene_add_sun(scene, (double[]){0.3, 1, 0.2}, 2);
    scene_look_from(scene, (double[]){0.3, 1, 0.4}, 2);
    scene_end(scene);
    return scene;
}

/// The device fits bins to texels that the host has never seen as well as the host to its own.
static void bins_are_fitted_without_an_example(void **state) {
    fixture *f = *state;
    lobe_scene *scene = woven_scene(335);
    giver g = giver_of(f, scene);
    set(f, scene);
    lobe_frame uploaded = picture(f, "moments", NULL);
    forget_texels(scene);
    set(f, scene);
    lobe_frame given = picture(f, "moments", &g);
    const double difference = relative_l2(&given.radiance, &uploaded.radiance);
    if (!(difference <= 0.01))
        fail_msg("another picture, by %g", difference);
    lobe_frame_free(&uploaded);
    lobe_frame_free(&given);
    unset(f, &scene);
    giver_free(&g);
}

// ---------------------------------------------------------------------------------------------
// Work

static size_t passes_of(fixture *f, lobe_pass_state state) {
    return count_passes(lobe_renderer_graph(f->renderer), NULL, state);
}

/// A pass whose inputs are those of the last frame writes what it wrote then.
static void maps_are_rebuilt_only_where_texels_changed(void **state) {
    fixture *f = *state;
    lobe_scene *scene = mapped_scene(340), *other = mapped_scene(341);
    giver g = giver_of(f, scene);
    put_on_device(scene, true);
    set(f, scene);
    for (int retained = 0; retained < 2; retained++) {
        g.retained = retained;
        const uint64_t first = hash_of(f, "lean", &g);
        assert_true(hash_of(f, "lean", &g) == first);
        // Shading, and what is not kept for it.
        assert_int_equal(passes_of(f, LOBE_PASS_RUN), retained ? 1 : 1 + IMAGES);
        assert_int_equal(lobe_texture_update(g.textures[0], &other->images[0].image), LOBE_OK);
        assert_true(hash_of(f, "lean", &g) != first);
        assert_true(passes_of(f, LOBE_PASS_RUN) > (retained ? 1 : 1 + IMAGES));
        assert_int_equal(lobe_texture_update(g.textures[0], &scene->images[0].image), LOBE_OK);
    }
    lobe_scene_destroy(&other);
    unset(f, &scene);
    giver_free(&g);
}

/// Listing an image uploads it from then on, or no longer.
static void images_may_move_between_host_and_device(void **state) {
    static const uint32_t all[IMAGES] = {0, 1, 2};
    static const char *const filters[] = {"mipmap", "moments"};
    const lobe_scene_changes changes = {.images = all, .image_count = IMAGES};
    fixture *f = *state;
    lobe_scene *scene = mapped_scene(350);
    giver g = giver_of(f, scene);
    set(f, scene);
    lobe_frame expected[2] = {picture(f, "mipmap", NULL), picture(f, "moments", NULL)};
    for (int n = 0; n < 4; n++) {
        const bool on_device = n % 2 == 0;
        put_on_device(scene, on_device);
        assert_int_equal(lobe_renderer_update_scene(f->renderer, &changes), LOBE_OK);
        for (int i = 0; i < 2; i++) {
            lobe_frame frame = picture(f, filters[i], on_device ? &g : NULL);
            check_picture(filters[i], &frame, &expected[i]);
            lobe_frame_free(&frame);
        }
    }
    for (int i = 0; i < 2; i++)
        lobe_frame_free(&expected[i]);
    unset(f, &scene);
    giver_free(&g);
}

/// Metal is looked for in the texels of each frame, not in the example.
static void an_example_without_metal_says_nothing(void **state) {
    fixture *f = *state;
    lobe_scene *scene = mapped_scene(360), *plastic = mapped_scene(360);
    giver g = giver_of(f, scene);
    set(f, scene);
    const uint64_t expected = hash_of(f, "mipmap", NULL);
    lobe_image *map = &plastic->images[1].image;
    for (size_t i = 0; i < (size_t)MAP * MAP; i++)
        ((float *)map->texels)[4 * i + 2] = 0;
    put_on_device(plastic, true);
    set(f, plastic);
    assert_true(hash_of(f, "mipmap", &g) == expected);
    set(f, NULL);
    lobe_scene_destroy(&plastic);
    unset(f, &scene);
    giver_free(&g);
}

// ---------------------------------------------------------------------------------------------
// Images of the host's Vulkan

static void give_vulkan(void *user, lobe_graph *graph, const lobe_given_content *content) {
    content->images[0] = lobe_graph_import_image(graph, user);
}

/// The host clears its image to slopes, and lobe reads it in the same command buffer.
static void images_of_the_hosts_vulkan_are_maps(void **state) {
    static const float normal[4] = {0.7f, 0.4f, 0.9f, 1};
    (void)state;
    host_device host;
    lobe_device *device;
    lobe_renderer *renderer = host_renderer_open(&host, &device);
    lobe_scene *scene = mapped_scene(370);
    for (size_t i = 0; i < (size_t)MAP * MAP; i++)
        memcpy((float *)scene->images[0].image.texels + 4 * i, normal, sizeof normal);
    host_image picture =
        host_image_create(&host, VK_FORMAT_R32G32B32A32_SFLOAT, EXTENT, EXTENT,
                          VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT);
    host_image map =
        host_image_create(&host, VK_FORMAT_R32G32B32A32_SFLOAT, MAP, MAP,
                          VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT);
    float texels[2][EXTENT * EXTENT * 4];
    for (int given = 0; given < 2; given++) {
        scene->images[0].on_device = given;
        assert_int_equal(lobe_renderer_set_scene(renderer, scene), LOBE_OK);
        VkCommandBuffer commands = host_begin(&host);
        host_barrier(commands, &map, VK_IMAGE_LAYOUT_UNDEFINED,
                     VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL);
        host_clear(commands, &map, normal);
        lobe_vulkan_image lent = {.image = map.image,
                                  .format = map.format,
                                  .width = MAP,
                                  .height = MAP,
                                  .usage = VK_IMAGE_USAGE_SAMPLED_BIT,
                                  .layout = VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL};
        const lobe_vulkan_image target = {.image = picture.image,
                                          .format = picture.format,
                                          .width = EXTENT,
                                          .height = EXTENT,
                                          .usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT,
                                          .final_layout = VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL};
        const lobe_render_parameters parameters = {
            .filter = filter_named("lobes"),
            .host = {.target = &(lobe_render_target){.radiance = &target},
                     .submission = &(lobe_vulkan_submission){.commands = commands}}};
        lobe_frame frame;
        lobe_renderer_set_content_giver(renderer, given ? give_vulkan : NULL, &lent);
        if (lobe_renderer_render(renderer, &parameters, &frame) != LOBE_OK)
            fail_msg("%s", host.recorder.last_error);
        host_finish(&host, commands);
        host_read(&host, &picture, texels[given], sizeof texels[given]);
        lobe_frame_free(&frame);
    }
    assert_true(texels[0][4 * (EXTENT / 2 * EXTENT + EXTENT / 2)] > 0);
    assert_memory_equal(texels[0], texels[1], sizeof texels[0]);
    lobe_renderer_destroy(&renderer);
    lobe_device_destroy(&device);
    host_image_destroy(&host, &picture);
    host_image_destroy(&host, &map);
    host_device_close(&host);
    lobe_scene_destroy(&scene);
}

static void clear_map(const host_device *host, const host_image *map, float slope) {
    VkCommandBuffer commands = host_begin(host);
    host_barrier(commands, map, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL);
    host_clear(commands, map, (float[]){0.5f + slope, 0.4f, 0.9f, 1});
    host_finish(host, commands);
}

/// Frames until what the filter makes of the maps rests; the picture of the last one.
static uint64_t draw_until_at_rest(lobe_renderer *renderer, const char *filter,
                                   lobe_vulkan_image *map, unsigned *frames) {
    const lobe_render_parameters parameters = parameters_of(filter);
    uint64_t hash = 0;
    *frames = 0;
    lobe_renderer_set_content_giver(renderer, give_vulkan, map);
    do {
        lobe_frame frame;
        assert_int_equal(lobe_renderer_render(renderer, &parameters, &frame), LOBE_OK);
        hash = image_hash(&frame.radiance);
        lobe_frame_free(&frame);
        map->layout = map->final_layout;
        ++*frames;
    } while (*frames < 100 &&
             (count_passes(lobe_renderer_graph(renderer), NULL, LOBE_PASS_RUN) > 1 ||
              lobe_graph_settles(lobe_renderer_graph(renderer))));
    return hash;
}

/// A scene whose first map is an image of the host's Vulkan, in a renderer on the host's device.
typedef struct host_map {
    host_device host;
    lobe_device *device;
    lobe_renderer *renderer;
    lobe_scene *scene;
    host_image image;
    lobe_vulkan_image lent;
} host_map;

static host_map host_map_open(uint64_t seed) {
    host_map m;
    m.renderer = host_renderer_open(&m.host, &m.device);
    m.scene = mapped_scene(seed);
    m.scene->images[0].on_device = true;
    assert_int_equal(lobe_renderer_set_scene(m.renderer, m.scene), LOBE_OK);
    m.image = host_image_create(&m.host, VK_FORMAT_R32G32B32A32_SFLOAT, MAP, MAP,
                                VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT);
    m.lent = (lobe_vulkan_image){.image = m.image.image,
                                 .format = m.image.format,
                                 .width = MAP,
                                 .height = MAP,
                                 .usage = VK_IMAGE_USAGE_SAMPLED_BIT,
                                 .final_layout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL};
    return m;
}

static void host_map_close(host_map *m) {
    lobe_renderer_destroy(&m->renderer);
    lobe_device_destroy(&m->device);
    host_image_destroy(&m->host, &m->image);
    host_device_close(&m->host);
    lobe_scene_destroy(&m->scene);
}

/// While the host says that its image has not changed, only shading runs. Bins of `moments` follow
/// earlier ones: what they come to rest at depends on these.
static void images_whose_content_stays_are_filtered_once(void **state) {
    static const char *const filters[] = {"lean", "moments"};
    static const float slopes[] = {0.2f, -0.2f, 0.2f};
    (void)state;
    host_map m = host_map_open(375);
    for (size_t i = 0; i < sizeof filters / sizeof *filters; i++) {
        uint64_t pictures[3];
        for (int n = 0; n < 3; n++) {
            unsigned frames;
            clear_map(&m.host, &m.image, slopes[n]);
            m.lent.layout = VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL;
            m.lent.content++;
            pictures[n] = draw_until_at_rest(m.renderer, filters[i], &m.lent, &frames);
            assert_in_range(frames, 2, 99);
            assert_true(draw_until_at_rest(m.renderer, filters[i], &m.lent, &frames) ==
                        pictures[n]);
            assert_int_equal(frames, 1);
        }
        assert_true(pictures[0] != pictures[1]);
        if (i == 0)
            assert_true(pictures[0] == pictures[2]);
    }
    host_map_close(&m);
}

/// With only the tiles made that pixels read. The host writes its image without saying so, which
/// only a tile that is made again can show.
static void tiles_of_content_that_stays_are_made_once(void **state) {
    static const char *const filters[] = {"mipmap", "lean", "lobes", "moments"};
    (void)state;
    host_map m = host_map_open(376);
    m.lent.content = 1;
    lobe_renderer_set_content_giver(m.renderer, give_vulkan, &m.lent);
    for (size_t i = 0; i < sizeof filters / sizeof *filters; i++) {
        static const float slopes[] = {0.2f, -0.2f, -0.2f, -0.2f, 0.2f, -0.2f};
        static const bool said[] = {true, false, false, true, true, false};
        static const bool flat[] = {false, false, true, false, true, false};
        static const uint64_t unnumbered = 5; ///< from this picture on
        const lobe_filter *filter = filter_named(filters[i]);
        const char *const more = i == 3 ? "refit=anew" : "bias=0";
        // Only shading reads the last one.
        const lobe_settings settings[] = {
            settings_of(filter, (const char *[]){"built=seen", more, NULL}),
            settings_of(filter, (const char *[]){"built=seen", more, "curvature=0", NULL})};
        const uint64_t first = m.lent.content;
        uint64_t pictures[6];
        for (size_t n = 0; n < 6; n++) {
            const lobe_render_parameters parameters = {.filter = filter,
                                                       .settings = &settings[flat[n]],
                                                       .width = EXTENT,
                                                       .height = EXTENT};
            clear_map(&m.host, &m.image, slopes[n]);
            m.lent.layout = VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL;
            m.lent.content = n == unnumbered ? 0 : m.lent.content + said[n];
            lobe_frame frame;
            assert_int_equal(lobe_renderer_render(m.renderer, &parameters, &frame), LOBE_OK);
            pictures[n] = image_hash(&frame.radiance);
            lobe_frame_free(&frame);
        }
        if (pictures[1] != pictures[0] || pictures[2] != pictures[4])
            fail_msg("%s: tiles were made again", filters[i]);
        assert_true(pictures[3] != pictures[0]);
        assert_true(pictures[5] == pictures[3]);
        m.lent.content = first + 10;
    }
    host_map_close(&m);
}

/// The host writes one image while lobe reads the other. Each has numbers of its own, which may be
/// equal, and go back to what they were with the content: pictures show the image that is lent.
static void two_images_may_take_turns(void **state) {
    static const float slopes[2] = {0.2f, -0.2f};
    static const struct turn {
        int image;
        uint64_t content;
        float slope; ///< written before, if not 0
    } turns[] = {{0, 5, 0.2f}, {1, 5, -0.2f}, {0, 5, 0},     {1, 5, 0},
                 {1, 6, 0.2f}, {0, 5, 0},     {0, 6, -0.2f}, {0, 5, 0.2f},
                 {1, 6, 0},    {1, 5, -0.2f}, {1, 0, 0.2f},  {1, 5, -0.2f}};
    (void)state;
    host_device host;
    lobe_device *device;
    lobe_renderer *renderer = host_renderer_open(&host, &device);
    lobe_scene *scene = mapped_scene(377);
    scene->images[0].on_device = true;
    assert_int_equal(lobe_renderer_set_scene(renderer, scene), LOBE_OK);
    host_image maps[2];
    lobe_vulkan_image lent[2];
    for (int i = 0; i < 2; i++) {
        maps[i] = host_image_create(&host, VK_FORMAT_R32G32B32A32_SFLOAT, MAP, MAP,
                                    VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT);
        lent[i] = (lobe_vulkan_image){.image = maps[i].image,
                                      .format = maps[i].format,
                                      .width = MAP,
                                      .height = MAP,
                                      .usage = VK_IMAGE_USAGE_SAMPLED_BIT,
                                      .final_layout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL};
    }
    uint64_t expected[2] = {0};
    float slope[2] = {0};
    for (size_t n = 0; n < sizeof turns / sizeof *turns; n++) {
        const struct turn *turn = &turns[n];
        lobe_vulkan_image *image = &lent[turn->image];
        if (turn->slope != 0) {
            clear_map(&host, &maps[turn->image], turn->slope);
            image->layout = VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL;
            slope[turn->image] = turn->slope;
        }
        image->content = turn->content;
        const lobe_render_parameters parameters = parameters_of(n % 2 ? "lean" : "lobes");
        const lobe_render_parameters again = parameters_of("lean");
        lobe_renderer_set_content_giver(renderer, give_vulkan, image);
        lobe_frame frame;
        assert_int_equal(lobe_renderer_render(renderer, &parameters, &frame), LOBE_OK);
        lobe_frame_free(&frame);
        image->layout = image->final_layout;
        assert_int_equal(lobe_renderer_render(renderer, &again, &frame), LOBE_OK);
        const uint64_t hash = image_hash(&frame.radiance);
        lobe_frame_free(&frame);
        const int kind = slope[turn->image] == slopes[1];
        if (expected[kind] == 0)
            expected[kind] = hash;
        if (hash != expected[kind])
            fail_msg("turn %zu shows another image", n);
    }
    assert_true(expected[0] != expected[1]);
    lobe_renderer_destroy(&renderer);
    lobe_device_destroy(&device);
    for (int i = 0; i < 2; i++)
        host_image_destroy(&host, &maps[i]);
    host_device_close(&host);
    lobe_scene_destroy(&scene);
}

// ---------------------------------------------------------------------------------------------
// Mistakes

/// Gives images as `user` describes them.
static void give_described(void *user, lobe_graph *graph, const lobe_given_content *content) {
    for (size_t i = 0; i < IMAGES; i++)
        content->images[i] = lobe_graph_image(graph, user);
}

static void give_buffer(void *user, lobe_graph *graph, const lobe_given_content *content) {
    (void)user;
    content->images[0] = lobe_graph_upload(graph, "buffer", "text", 4);
}

static void assert_refused(fixture *f, lobe_content_giver given, void *user, const char *line) {
    const lobe_render_parameters parameters = parameters_of("moments");
    lobe_frame frame;
    fixture_forget_messages(f);
    lobe_renderer_set_content_giver(f->renderer, given, user);
    assert_failure(f, lobe_renderer_render(f->renderer, &parameters, &frame),
                   LOBE_ERROR_INVALID_ARGUMENT, line);
    assert_null(frame.radiance.texels);
    fixture_forget_messages(f);
}

static void mistakes_are_named(void **state) {
    fixture *f = *state;
    lobe_scene *scene = mapped_scene(380);
    giver g = giver_of(f, scene);
    set(f, scene);
    assert_refused(f, give, &g, "is not on the device");
    put_on_device(scene, true);
    set(f, scene);
    assert_refused(f, NULL, NULL, "the host gave no texels");
    assert_refused(f, give_buffer, NULL, "by something that is no image of this frame");
    lobe_image_description image = {
        .name = "given", .format = LOBE_FORMAT_RGBA32_FLOAT, .width = MAP / 2, .height = MAP};
    assert_refused(f, give_described, &image, "is of 32x32 texels, but the host gave 16x32");
    image.width = MAP;
    image.levels = 3;
    assert_refused(f, give_described, &image, "with 3 levels, 1 layers, 1 samples of RGBA32_FLOAT");
    image.levels = 1;
    image.format = LOBE_FORMAT_D32_FLOAT;
    assert_refused(f, give_described, &image, "1 samples of D32_FLOAT; expected one each");
    scene->images[0].normals = LOBE_NORMALS_SIGNED_XY;
    image.format = LOBE_FORMAT_RG16_UNORM;
    assert_refused(f, give_described, &image,
                   "signed normals, but the host gave the format RG16_UNORM, which has no sign");
    scene->images[0].normals = LOBE_NORMALS_UNSIGNED;
    assert_refused(f, give_described, &image,
                   "normals of 3 channels, but the host gave the format RG16_UNORM, which has 2");
    image.format = LOBE_FORMAT_BGRA8_SRGB;
    assert_refused(f, give_described, &image,
                   "normals, but the host gave the format BGRA8_SRGB, which is for colours");
    hash_of(f, "moments", &g);
    unset(f, &scene);
    giver_free(&g);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_filter_draws_what_it_draws_of_uploaded_texels),
        cmocka_unit_test(texels_may_be_no_numbers),
        cmocka_unit_test(texels_may_differ_in_every_frame),
        cmocka_unit_test(bins_are_fitted_to_given_texels),
        cmocka_unit_test(no_example_is_needed),
        cmocka_unit_test(bins_are_fitted_without_an_example),
        cmocka_unit_test(maps_are_rebuilt_only_where_texels_changed),
        cmocka_unit_test(images_may_move_between_host_and_device),
        cmocka_unit_test(an_example_without_metal_says_nothing),
        cmocka_unit_test(images_of_the_hosts_vulkan_are_maps),
        cmocka_unit_test(images_whose_content_stays_are_filtered_once),
        cmocka_unit_test(tiles_of_content_that_stays_are_made_once),
        cmocka_unit_test(two_images_may_take_turns),
        cmocka_unit_test(mistakes_are_named),
    };
    return cmocka_run_group_tests(tests, fixture_create_validated, fixture_destroy);
}
