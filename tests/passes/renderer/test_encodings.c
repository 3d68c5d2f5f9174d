// Normal maps in other encodings: pictures are those of the same normals stored as usual, however
// they come to the device.

#include "tests/passes/support/fixture.h"

#include <math.h>
#include <string.h>

#include "engine/image/half.h"
#include "tests/engine/support/host_device.h"
#include "tests/long_runs.h"
#include "tests/passes/support/picture.h"
#include "tests/passes/support/scene_builder.h"

enum { EXTENT = 16, MAP = 16 };

typedef struct encoding {
    lobe_format format;
    lobe_normal_encoding normals;
} encoding;

// ---------------------------------------------------------------------------------------------
// Maps

/// One channel of a texel: the nearest that the format has.
static void store(lobe_format format, double value, unsigned char *texel, uint32_t channel) {
    const size_t size = lobe_format_size(format) / lobe_format_channels(format);
    const bool is_signed = format == LOBE_FORMAT_RG8_SNORM || format == LOBE_FORMAT_RGBA8_SNORM ||
                           format == LOBE_FORMAT_RG16_SNORM || format == LOBE_FORMAT_RGBA16_SNORM;
    const bool is_half = format == LOBE_FORMAT_RG16_FLOAT || format == LOBE_FORMAT_RGBA16_FLOAT;
    const double steps = (size == 1 ? 255 : 65535) / (is_signed ? 2 : 1);
    unsigned char *place = texel + channel * size;
    const float number = (float)value;
    const int step = (int)lround(value * floor(steps));
    const uint16_t word = is_half ? engine_half_from_float(number) : (uint16_t)step;
    if (size == 1)
        *place = (unsigned char)step;
    else if (size == 2)
        memcpy(place, &word, sizeof word);
    else
        memcpy(place, &number, sizeof number);
}

/// What a shader reads.
static double load(lobe_format format, const unsigned char *texel, uint32_t channel) {
    const size_t size = lobe_format_size(format) / lobe_format_channels(format);
    const unsigned char *place = texel + channel * size;
    uint16_t word;
    float number;
    memcpy(&word, place, size > 1 ? sizeof word : 1);
    switch (format) {
    case LOBE_FORMAT_RG8_SNORM:
    case LOBE_FORMAT_RGBA8_SNORM:
        return fmax((int8_t)*place / 127.0, -1);
    case LOBE_FORMAT_RG16_SNORM:
    case LOBE_FORMAT_RGBA16_SNORM:
        return fmax((int16_t)word / 32767.0, -1);
    case LOBE_FORMAT_RG16_FLOAT:
    case LOBE_FORMAT_RGBA16_FLOAT:
        return (double)engine_half_to_float(word);
    default:
        break;
    }
    if (size == 4)
        memcpy(&number, place, sizeof number);
    return size == 1 ? *place / 255.0 : size == 2 ? word / 65535.0 : (double)number;
}

static bool is_signed(lobe_normal_encoding normals) {
    return normals == LOBE_NORMALS_SIGNED || normals == LOBE_NORMALS_SIGNED_XY;
}

static bool lacks_z(lobe_normal_encoding normals) {
    return normals == LOBE_NORMALS_UNSIGNED_XY || normals == LOBE_NORMALS_SIGNED_XY;
}

/// The normals of a map of RGBA32_FLOAT, (n + 1) / 2, in another encoding; and those normals, after
/// quantisation, again in the first one.
static lobe_image encoded(const lobe_image *plain, const encoding *as, lobe_image *same) {
    lobe_image image = map_image(as->format, plain->width, plain->height);
    *same = map_image(LOBE_FORMAT_RGBA32_FLOAT, plain->width, plain->height);
    const uint32_t channels = lobe_format_channels(as->format);
    const size_t size = lobe_format_size(as->format);
    for (size_t i = 0; i < (size_t)plain->width * plain->height; i++) {
        const float *texel = (const float *)plain->texels + 4 * i;
        unsigned char *stored = (unsigned char *)image.texels + size * i;
        double normal[3] = {0};
        for (uint32_t k = 0; k < channels && k < 3; k++) {
            const double value = 2 * (double)texel[k] - 1;
            store(as->format, is_signed(as->normals) ? value : 0.5 * value + 0.5, stored, k);
            normal[k] = load(as->format, stored, k);
            normal[k] = is_signed(as->normals) ? normal[k] : 2 * normal[k] - 1;
        }
        if (lacks_z(as->normals))
            normal[2] = sqrt(fmax(0, 1 - normal[0] * normal[0] - normal[1] * normal[1]));
        for (int k = 0; k < 3; k++)
            ((float *)same->texels)[4 * i + (size_t)k] = (float)(0.5 * normal[k] + 0.5);
    }
    return image;
}

// ---------------------------------------------------------------------------------------------
// Pictures

/// A bumpy square, from nearby to far away. Takes over the map.
static lobe_scene *scene_with(lobe_image map, lobe_normal_encoding normals, bool nearest,
                              bool lobes) {
    lobe_scene *scene = scene_begin();
    lobe_material material = lobes ? half_vector_material(LOBE_DISTRIBUTION_VMF, 40)
                                   : microfacet_material(LOBE_DISTRIBUTION_GGX, 0.4, 0);
    material.normal_map = scene_add_map(scene, map);
    material.normal_map.nearest = nearest;
    material.normal_scale = 0.8f;
    scene->images[0].normals = normals;
    scene_add_square(scene, &material, 3, NULL);
    scene_look_along(scene);
    scene_end(scene);
    return scene;
}

/// `setting`: NULL: none.
static lobe_frame draw_with(fixture *f, const lobe_scene *scene, const char *filter,
                            const char *setting) {
    picture_request request = {
        .filter = filter, .settings = {setting}, .width = EXTENT, .height = EXTENT, .samples = 4};
    assert_int_equal(lobe_renderer_set_scene(f->renderer, scene), LOBE_OK);
    return draw(f, &request);
}

/// How far the picture of an encoding is from that of the same normals, stored as usual.
static double error_of(fixture *f, const encoding *as, const char *filter, bool nearest, bool lobes,
                       double tilt) {
    lobe_image plain = random_normal_map(MAP, MAP, tilt, 500), same;
    lobe_scene *scene = scene_with(encoded(&plain, as, &same), as->normals, nearest, lobes);
    lobe_scene *usual = scene_with(same, LOBE_NORMALS_UNSIGNED, nearest, lobes);
    lobe_frame expected = draw_with(f, usual, filter, NULL),
               frame = draw_with(f, scene, filter, NULL);
    const double error = relative_l2(&frame.radiance, &expected.radiance);
    assert_true(largest_value(&expected.radiance) > 0.01);
    assert_int_equal(lobe_renderer_set_scene(f->renderer, NULL), LOBE_OK);
    lobe_frame_free(&frame);
    lobe_frame_free(&expected);
    lobe_scene_destroy(&scene);
    lobe_scene_destroy(&usual);
    lobe_image_free(&plain);
    return error;
}

static const encoding one_of_each[] = {
    {LOBE_FORMAT_RGBA8_SNORM, LOBE_NORMALS_SIGNED},
    {LOBE_FORMAT_RG8_UNORM, LOBE_NORMALS_UNSIGNED_XY},
    {LOBE_FORMAT_RG8_SNORM, LOBE_NORMALS_SIGNED_XY},
};

/// Filters that fit to texels take other steps from other roundings.
static double slack_of(const char *filter) {
    return strcmp(filter, "mixture") == 0 || strcmp(filter, "tan") == 0 ||
                   strcmp(filter, "fournier") == 0
               ? 2e-2
               : 1e-3;
}

static void check_error(const encoding *as, const char *filter, double error, double slack) {
    if (!(error < slack))
        fail_msg("%s: %s, encoding %d: off by %g", filter, lobe_format_name(as->format),
                 (int)as->normals, error);
}

static void every_filter_reads_every_encoding(void **state) {
    fixture *f = *state;
    for (size_t n = 0; n < lobe_filter_count(); n++) {
        const char *filter = lobe_filter_name(lobe_filter_get(n));
        for (size_t i = long_runs() ? 0 : n % 3; i < 3; i += long_runs() ? 1 : 3)
            check_error(&one_of_each[i], filter,
                        error_of(f, &one_of_each[i], filter, true, n % 2, 0.5), slack_of(filter));
    }
    assert_int_equal(f->errors, 0);
    assert_int_equal(lobe_device_validation_count(f->device), 0);
}

static void every_format_is_read(void **state) {
    static const encoding encodings[] = {
        {LOBE_FORMAT_RGBA8_UNORM, LOBE_NORMALS_UNSIGNED},
        {LOBE_FORMAT_RGBA16_UNORM, LOBE_NORMALS_UNSIGNED},
        {LOBE_FORMAT_RGBA16_SNORM, LOBE_NORMALS_SIGNED},
        {LOBE_FORMAT_RGBA16_FLOAT, LOBE_NORMALS_SIGNED},
        {LOBE_FORMAT_RGBA32_FLOAT, LOBE_NORMALS_SIGNED},
        {LOBE_FORMAT_RG16_UNORM, LOBE_NORMALS_UNSIGNED_XY},
        {LOBE_FORMAT_RG16_SNORM, LOBE_NORMALS_SIGNED_XY},
        {LOBE_FORMAT_RG16_FLOAT, LOBE_NORMALS_SIGNED_XY},
        {LOBE_FORMAT_RG32_FLOAT, LOBE_NORMALS_SIGNED_XY},
        {LOBE_FORMAT_RG32_FLOAT, LOBE_NORMALS_UNSIGNED_XY},
    };
    fixture *f = *state;
    for (size_t i = 0; i < sizeof encodings / sizeof *encodings; i++) {
        const bool on_host = lobe_format_size(encodings[i].format) !=
                                 2 * lobe_format_channels(encodings[i].format) ||
                             strstr(lobe_format_name(encodings[i].format), "FLOAT") == NULL;
        check_error(&encodings[i], "direct", error_of(f, &encodings[i], "direct", true, false, 0.5),
                    1e-3);
        if (on_host) // otherwise there are other bins
            check_error(&encodings[i], "moments",
                        error_of(f, &encodings[i], "moments", true, true, 0.5), 1e-3);
    }
}

/// Interpolation between texels comes before decoding. Signed normals are the same there, too; of
/// those without z, the mean is longer than that of unit vectors, by the square of the tilt. In 16
/// bits: lavapipe interpolates 8 bits with no more than 8.
static void interpolated_normals_agree_too(void **state) {
    static const char *const filters[] = {"direct", "lean", "moments"};
    static const encoding with_z = {LOBE_FORMAT_RGBA16_SNORM, LOBE_NORMALS_SIGNED},
                          without[] = {{LOBE_FORMAT_RG16_UNORM, LOBE_NORMALS_UNSIGNED_XY},
                                       {LOBE_FORMAT_RG16_SNORM, LOBE_NORMALS_SIGNED_XY}};
    fixture *f = *state;
    for (int n = 0; n < 3; n++) {
        check_error(&with_z, filters[n], error_of(f, &with_z, filters[n], false, false, 0.5), 1e-3);
        for (int i = 0; i < 2; i++)
            check_error(&without[i], filters[n],
                        error_of(f, &without[i], filters[n], false, false, 0.05), 1e-3);
    }
}

/// The encoding matters: read as usual, it is another picture.
static void encodings_are_told_apart(void **state) {
    fixture *f = *state;
    for (int i = 0; i < 3; i++) {
        lobe_image plain = random_normal_map(MAP, MAP, 0.5, 500), same;
        lobe_scene *scene =
            scene_with(encoded(&plain, &one_of_each[i], &same), LOBE_NORMALS_UNSIGNED, true, false);
        lobe_scene *usual = scene_with(same, LOBE_NORMALS_UNSIGNED, true, false);
        lobe_frame expected = draw_with(f, usual, "lean", NULL),
                   frame = draw_with(f, scene, "lean", NULL);
        assert_true(relative_l2(&frame.radiance, &expected.radiance) > 0.1);
        lobe_frame_free(&frame);
        // Announced with its image, the encoding may change alone.
        static const uint32_t map = 0;
        scene->images[0].normals = one_of_each[i].normals;
        const lobe_scene_changes changes = {.images = &map, .image_count = 1};
        assert_int_equal(lobe_renderer_update_scene(f->renderer, &changes), LOBE_OK);
        frame = draw(f, &(picture_request){.filter = "lean", .width = EXTENT, .height = EXTENT});
        assert_true(relative_l2(&frame.radiance, &expected.radiance) < 1e-3);
        lobe_frame_free(&frame);
        lobe_frame_free(&expected);
        assert_int_equal(lobe_renderer_set_scene(f->renderer, NULL), LOBE_OK);
        lobe_scene_destroy(&scene);
        lobe_scene_destroy(&usual);
        lobe_image_free(&plain);
    }
}

// ---------------------------------------------------------------------------------------------
// On the device

static void give(void *user, lobe_graph *graph, const lobe_given_content *content) {
    content->images[0] = lobe_graph_import_texture(graph, user);
}

static void maps_given_on_the_device_have_encodings(void **state) {
    // The device goes on from the host's bins, so that several need not be the same: one is.
    static const struct {
        const char *filter, *setting;
        double slack;
    } cases[] = {{"direct", NULL, 1e-4},
                 {"lean", NULL, 1e-4},
                 {"moments", "bins=1", 1e-4},
                 {"moments", "bins=2", 2e-3}};
    fixture *f = *state;
    for (int i = 0; i < 12; i++) {
        const encoding *as = &one_of_each[i % 3];
        const char *filter = cases[i / 3].filter, *setting = cases[i / 3].setting;
        lobe_image plain = random_normal_map(MAP, MAP, 0.5, 500), same;
        lobe_scene *scene = scene_with(encoded(&plain, as, &same), as->normals, true, false);
        lobe_frame expected = draw_with(f, scene, filter, setting);
        lobe_texture *texture;
        const lobe_texture_parameters parameters = {.image = &scene->images[0].image};
        assert_int_equal(lobe_texture_create(f->device, &parameters, &texture), LOBE_OK);
        scene->images[0].on_device = true;
        lobe_renderer_set_content_giver(f->renderer, give, texture);
        lobe_frame frame = draw_with(f, scene, filter, setting);
        check_error(as, filter, relative_l2(&frame.radiance, &expected.radiance),
                    cases[i / 3].slack);
        lobe_renderer_set_content_giver(f->renderer, NULL, NULL);
        assert_int_equal(lobe_renderer_set_scene(f->renderer, NULL), LOBE_OK);
        lobe_texture_destroy(&texture);
        lobe_frame_free(&frame);
        lobe_frame_free(&expected);
        lobe_scene_destroy(&scene);
        lobe_image_free(&same);
        lobe_image_free(&plain);
    }
}

// ---------------------------------------------------------------------------------------------
// In blocks of 4x4 texels, of the host's Vulkan

enum { BLOCKS = MAP / 4, BLOCK_BYTES = 16 };

/// Blocks of one value each: the first of both ends between which indices of 0 choose (BC5).
static void write_block(bool has_sign, const double normal[2], unsigned char block[BLOCK_BYTES]) {
    memset(block, 0, BLOCK_BYTES);
    for (int channel = 0; channel < 2; channel++)
        block[8 * channel] =
            (unsigned char)(has_sign ? (int)lround(127 * normal[channel])
                                     : (int)lround(255 * (0.5 * normal[channel] + 0.5)));
}

/// The same values in texels of two channels.
static void write_texels(const unsigned char *blocks, lobe_image *image) {
    for (uint32_t y = 0; y < MAP; y++)
        for (uint32_t x = 0; x < MAP; x++)
            for (int channel = 0; channel < 2; channel++)
                ((unsigned char *)image->texels)[2 * (MAP * y + x) + (unsigned)channel] =
                    blocks[BLOCK_BYTES * (BLOCKS * (y / 4) + x / 4) + 8 * (unsigned)channel];
}

static void fill_blocks(bool has_sign, unsigned char blocks[BLOCKS * BLOCKS * BLOCK_BYTES]) {
    for (unsigned i = 0; i < BLOCKS * BLOCKS; i++) {
        const double normal[2] = {0.5 * sin(1 + 2.3 * i), 0.5 * cos(3.1 * i)};
        write_block(has_sign, normal, blocks + BLOCK_BYTES * i);
    }
}

static void upload_blocks(host_device *host, const host_image *image, const unsigned char *blocks) {
    const size_t size = BLOCKS * BLOCKS * BLOCK_BYTES;
    host_buffer buffer = host_buffer_create(
        host, size, VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT);
    VkCommandBuffer commands = host_begin(host);
    const VkBufferImageCopy copy = {.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1},
                                    .imageExtent = {MAP, MAP, 1}};
    host_write(commands, &buffer, 0, blocks, size);
    host_finish(host, commands);
    commands = host_begin(host);
    host_barrier(commands, image, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL);
    vkCmdCopyBufferToImage(commands, buffer.buffer, image->image,
                           VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &copy);
    host_barrier(commands, image, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
                 VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
    host_finish(host, commands);
    host_buffer_destroy(host, &buffer);
}

static void give_image(void *user, lobe_graph *graph, const lobe_given_content *content) {
    content->images[0] = lobe_graph_import_image(graph, user);
}

static void check_blocks(fixture *f, host_device *host, bool has_sign, const char *filter) {
    const encoding as = {has_sign ? LOBE_FORMAT_RG8_SNORM : LOBE_FORMAT_RG8_UNORM,
                         has_sign ? LOBE_NORMALS_SIGNED_XY : LOBE_NORMALS_UNSIGNED_XY};
    const VkFormat format = has_sign ? VK_FORMAT_BC5_SNORM_BLOCK : VK_FORMAT_BC5_UNORM_BLOCK;
    unsigned char blocks[BLOCKS * BLOCKS * BLOCK_BYTES];
    lobe_image texels = map_image(as.format, MAP, MAP);
    fill_blocks(has_sign, blocks);
    write_texels(blocks, &texels);
    lobe_scene *scene = scene_with(texels, as.normals, true, false);
    lobe_frame expected = draw_with(f, scene, filter, NULL);
    host_image image = host_image_create(
        host, format, MAP, MAP, VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT);
    upload_blocks(host, &image, blocks);
    lobe_vulkan_image lent = {.image = image.image,
                              .format = format,
                              .width = MAP,
                              .height = MAP,
                              .usage = VK_IMAGE_USAGE_SAMPLED_BIT,
                              .layout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL,
                              .final_layout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL};
    scene->images[0].on_device = true;
    lobe_renderer_set_content_giver(f->renderer, give_image, &lent);
    lobe_frame frame = draw_with(f, scene, filter, NULL);
    // The device fits the bins of texels that the host cannot read, from other starts.
    check_error(&as, filter, relative_l2(&frame.radiance, &expected.radiance),
                strcmp(filter, "moments") == 0 ? 4e-3 : 1e-3);
    lobe_renderer_set_content_giver(f->renderer, NULL, NULL);
    assert_int_equal(lobe_renderer_set_scene(f->renderer, NULL), LOBE_OK);
    host_image_destroy(host, &image);
    lobe_frame_free(&frame);
    lobe_frame_free(&expected);
    lobe_scene_destroy(&scene);
}

static void compressed_images_of_the_host_are_maps(void **state) {
    fixture *f = *state;
    host_device host = {0};
    lobe_vulkan_export_device(f->device, &host.vulkan);
    const VkCommandPoolCreateInfo pool = {.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO,
                                          .queueFamilyIndex = host.vulkan.queue_family};
    assert_int_equal(vkCreateCommandPool(host.vulkan.device, &pool, NULL, &host.pool), VK_SUCCESS);
    for (int i = 0; i < 4; i++)
        check_blocks(f, &host, i % 2, i / 2 ? "moments" : "lean");
    vkDestroyCommandPool(host.vulkan.device, host.pool, NULL);
    assert_int_equal(f->errors, 0);
    assert_int_equal(lobe_device_validation_count(f->device), 0);
}

static void add_compressed_image(lobe_graph *graph) {
    lobe_graph_image(
        graph, &(lobe_image_description){
                   .name = "blocks", .format = LOBE_FORMAT_BC5_SNORM, .width = 4, .height = 4});
}

/// Nothing of lobe's own is compressed, on the device or in memory.
static void only_the_hosts_images_are_compressed(void **state) {
    fixture *f = *state;
    lobe_image image;
    lobe_scene *scene =
        scene_with(map_image(LOBE_FORMAT_RG8_SNORM, 4, 4), LOBE_NORMALS_SIGNED_XY, true, false);
    fixture_forget_messages(f);
    assert_failure(f, lobe_image_allocate(&image, LOBE_FORMAT_BC7_SRGB, 4, 4, &f->host),
                   LOBE_ERROR_INVALID_ARGUMENT, "no format of single texels");
    fixture_forget_messages(f);
    scene->images[0].image.format = LOBE_FORMAT_BC5_SNORM;
    assert_failure(f, lobe_renderer_set_scene(f->renderer, scene), LOBE_ERROR_MALFORMED,
                   "4x4 texels of BC5_SNORM");
    fixture_forget_messages(f);
    lobe_graph_begin(f->graph);
    add_compressed_image(f->graph);
    assert_failure(f, lobe_graph_compile(f->graph), LOBE_ERROR_GRAPH,
                   "only images of the host are compressed");
    fixture_forget_messages(f);
    lobe_graph_begin(f->graph);
    lobe_scene_destroy(&scene);
}

// ---------------------------------------------------------------------------------------------
// Mistakes

static void impossible_encodings_are_refused(void **state) {
    fixture *f = *state;
    lobe_scene *scene =
        scene_with(map_image(LOBE_FORMAT_RGBA8_UNORM, 4, 4), LOBE_NORMALS_SIGNED, true, false);
    fixture_forget_messages(f);
    assert_failure(f, lobe_renderer_set_scene(f->renderer, scene), LOBE_ERROR_MALFORMED,
                   "signed normals in the format RGBA8_UNORM");
    fixture_forget_messages(f);
    scene->images[0].normals = (lobe_normal_encoding)17;
    assert_failure(f, lobe_renderer_set_scene(f->renderer, scene), LOBE_ERROR_MALFORMED,
                   "no encoding of normals 17");
    fixture_forget_messages(f);
    lobe_scene_destroy(&scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_filter_reads_every_encoding),
        cmocka_unit_test(every_format_is_read),
        cmocka_unit_test(interpolated_normals_agree_too),
        cmocka_unit_test(encodings_are_told_apart),
        cmocka_unit_test(maps_given_on_the_device_have_encodings),
        cmocka_unit_test(compressed_images_of_the_host_are_maps),
        cmocka_unit_test(only_the_hosts_images_are_compressed),
        cmocka_unit_test(impossible_encodings_are_refused),
    };
    return cmocka_run_group_tests(tests, fixture_create_validated, fixture_destroy);
}
