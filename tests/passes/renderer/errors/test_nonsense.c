// Every public function survives nonsense: NULL for what it needs, and values outside of their
// types. Those with a result return an error and log one line if they know the host; the others do
// nothing. tests/nonsense.py checks that no public function is missing here.

#include "tests/passes/support/fixture.h"

#include <math.h>
#include <string.h>

#include <lobe/environment_maps.h>
#include <lobe/lobe.h>
#include <lobe/vulkan.h>

#include "tests/passes/support/misuse.h"

/// Asserts that a call is refused with this code and one line that contains `words`.
#define REFUSED(f, expected, words, call)                                                          \
    do {                                                                                           \
        fixture_forget_messages(f);                                                                \
        lobe_result refused = (call);                                                              \
        assert_failure(f, refused, expected, words);                                               \
    } while (0)
/// The same for a call without a host, which cannot log.
#define REFUSED_SILENTLY(call) assert_int_equal((call), LOBE_ERROR_INVALID_ARGUMENT)

static void memory_and_files(void **state) {
    fixture *f = *state;
    const lobe_host *host = &f->host;
    uint8_t *data;
    size_t size;
    assert_null(lobe_allocate(NULL, SIZE_MAX, SIZE_MAX));
    assert_null(lobe_reallocate(NULL, NULL, SIZE_MAX, 2));
    assert_null(lobe_copy_text(NULL, NULL));
    lobe_release(NULL);
    assert_null(lobe_host_allocator(NULL));
    lobe_host_log(NULL, LOBE_LOG_ERROR, "%s", "nobody hears");
    assert_int_equal(lobe_host_fail(NULL, LOBE_ERROR_READ, "%s", "nobody hears"), LOBE_ERROR_READ);
    assert_non_null(lobe_result_name((lobe_result)-1));
    assert_non_null(lobe_result_message((lobe_result)1000));
    assert_non_null(lobe_version());
    REFUSED(f, LOBE_ERROR_INVALID_ARGUMENT, "lobe_file_read: path",
            lobe_file_read(NULL, NULL, host, &data, &size));
    REFUSED(f, LOBE_ERROR_INVALID_ARGUMENT, "lobe_file_read: path",
            lobe_file_read("file", NULL, host, NULL, NULL));
    REFUSED(f, LOBE_ERROR_INVALID_ARGUMENT, "lobe_file_write: path",
            lobe_file_write(NULL, "", 0, host));
    REFUSED(f, LOBE_ERROR_INVALID_ARGUMENT, "lobe_file_write: path",
            lobe_file_write("file", NULL, 9, host));
}

static void images(void **state) {
    fixture *f = *state;
    const lobe_host *host = &f->host;
    float texel[4] = {NAN, -1, INFINITY, 0};
    uint8_t *data, colour[3];
    size_t size;
    lobe_image empty = {0}, other, image = {LOBE_FORMAT_RGBA32_FLOAT, 1, 1, texel};
    assert_true(lobe_srgb_encode(NAN) == 0 && lobe_srgb_decode(INFINITY) == 1);
    assert_true(lobe_luminance(NULL) == 0);
    assert_false(lobe_image_to_rec709(NULL, NULL));
    lobe_heat_colour(NAN, colour);
    lobe_heat_colour(0, NULL);
    assert_int_equal(lobe_format_size((lobe_format)-1), 0);
    assert_int_equal(lobe_format_channels((lobe_format)1000), 0);
    assert_non_null(lobe_format_name((lobe_format)1000));
    lobe_image_free(NULL);
    assert_false(lobe_rectangle_lies_within(NULL, 1, 1));
    REFUSED(f, LOBE_ERROR_INVALID_ARGUMENT, "lobe_image_allocate: image",
            lobe_image_allocate(NULL, LOBE_FORMAT_R8_UNORM, 1, 1, host));
    REFUSED(f, LOBE_ERROR_INVALID_ARGUMENT, "format",
            lobe_image_allocate(&other, (lobe_format)99, 1, 1, host));
    REFUSED(f, LOBE_ERROR_LIMIT, "0x5",
            lobe_image_allocate(&other, LOBE_FORMAT_R8_UNORM, 0, 5, host));
    REFUSED(f, LOBE_ERROR_INVALID_ARGUMENT, "lobe_display_encode",
            lobe_display_encode(NULL, NULL, host, &other));
    REFUSED(f, LOBE_ERROR_INVALID_ARGUMENT, "lobe_display_encode",
            lobe_display_encode(&empty, NULL, host, &other));
    REFUSED(f, LOBE_ERROR_INVALID_ARGUMENT, "lobe_display_encode",
            lobe_display_encode(&image, NULL, host, NULL));
    REFUSED(f, LOBE_ERROR_INVALID_ARGUMENT, "lobe_png_write", lobe_png_write("a.png", NULL, host));
    REFUSED(f, LOBE_ERROR_INVALID_ARGUMENT, "lobe_png_encode",
            lobe_png_encode("a", &empty, host, &data, &size));
    image = (lobe_image){LOBE_FORMAT_RGBA8_UNORM, 0, 1, texel};
    REFUSED(f, LOBE_ERROR_INVALID_ARGUMENT, "0x1",
            lobe_png_encode("a", &image, host, &data, &size));
    REFUSED(f, LOBE_ERROR_INVALID_ARGUMENT, "lobe_png_read", lobe_png_read(NULL, host, &other));
}

static void openexr(void **state) {
    fixture *f = *state;
    const lobe_host *host = &f->host;
    lobe_exr_contents contents;
    lobe_image image, empty = {.format = LOBE_FORMAT_RGBA32_FLOAT};
    lobe_exr_layer layer = {0};
    REFUSED(f, LOBE_ERROR_INVALID_ARGUMENT, "lobe_exr_write", lobe_exr_write("a.exr", NULL, host));
    REFUSED(f, LOBE_ERROR_INVALID_ARGUMENT, "no layer",
            lobe_exr_write("a.exr", &(lobe_exr_parameters){.layer_count = 1}, host));
    const lobe_exr_parameters parameters = {.layers = &layer, .layer_count = 1};
    REFUSED(f, LOBE_ERROR_INVALID_ARGUMENT, "no image", lobe_exr_write("a.exr", &parameters, host));
    layer.image = &empty;
    REFUSED(f, LOBE_ERROR_INVALID_ARGUMENT, "no texels",
            lobe_exr_write("a.exr", &parameters, host));
    REFUSED(f, LOBE_ERROR_INVALID_ARGUMENT, "lobe_exr_read",
            lobe_exr_read(NULL, NULL, host, &image));
    REFUSED(f, LOBE_ERROR_INVALID_ARGUMENT, "lobe_exr_read_contents",
            lobe_exr_read_contents("a.exr", NULL, host, NULL));
    REFUSED(f, LOBE_ERROR_INVALID_ARGUMENT, "lobe_exr_decode_contents",
            lobe_exr_decode_contents("a.exr", NULL, 4, NULL, host, &contents));
    assert_null(lobe_exr_find_attribute(NULL, NULL, LOBE_EXR_TEXT));
    lobe_exr_contents_free(NULL);
}

static void devices(void **state) {
    fixture *f = *state;
    lobe_device_information *list;
    lobe_device_memory memory;
    const lobe_device_parameters parameters = {.host = &f->host};
    assert_non_null(lobe_device_type_name((lobe_device_type)99));
    REFUSED(f, LOBE_ERROR_INVALID_ARGUMENT, "lobe_device_create",
            lobe_device_create(&parameters, NULL));
    REFUSED(f, LOBE_ERROR_INVALID_ARGUMENT, "lobe_device_list",
            lobe_device_list(&parameters, &list, NULL));
    lobe_device_destroy(NULL);
    lobe_device_list_free(NULL, 3);
    assert_null(lobe_device_allocator(NULL));
    assert_null(lobe_device_describe(NULL));
    lobe_device_memory_query(NULL, &memory);
    lobe_device_memory_query(f->device, NULL);
    lobe_device_memory_reset_peak(NULL);
    assert_int_equal(lobe_device_validation_count(NULL), 0);
    REFUSED(f, LOBE_ERROR_INVALID_ARGUMENT, "lobe_device_add_shader",
            lobe_device_add_shader(f->device, NULL));
    REFUSED(f, LOBE_ERROR_INVALID_ARGUMENT, "a name and whole words",
            lobe_device_add_shader(f->device, &(lobe_shader){.name = "a", .size = 3}));
}

static void textures_and_buffers(void **state) {
    fixture *f = *state;
    lobe_texture *texture;
    lobe_buffer *buffer;
    lobe_image empty = {0};
    REFUSED(f, LOBE_ERROR_INVALID_ARGUMENT, "no image given",
            lobe_texture_create(f->device, &(lobe_texture_parameters){0}, &texture));
    assert_null(texture);
    REFUSED(f, LOBE_ERROR_INVALID_ARGUMENT, "texture",
            lobe_texture_create(f->device, &(lobe_texture_parameters){.image = &empty}, &texture));
    REFUSED_SILENTLY(lobe_texture_create(NULL, NULL, NULL));
    REFUSED_SILENTLY(lobe_texture_update(NULL, &empty));
    REFUSED_SILENTLY(lobe_texture_update_part(NULL, &empty, NULL));
    assert_false(lobe_texture_takes(NULL, NULL));
    REFUSED(f, LOBE_ERROR_INVALID_ARGUMENT, "lobe_graph_create_texture",
            lobe_graph_create_texture(f->graph, NULL, &texture));
    REFUSED(f, LOBE_ERROR_INVALID_ARGUMENT, "no image given",
            lobe_graph_create_texture(f->graph, &(lobe_texture_parameters){0}, &texture));
    assert_null(texture);
    REFUSED_SILENTLY(lobe_graph_create_texture(NULL, NULL, NULL));
    lobe_texture_destroy(NULL);
    REFUSED(f, LOBE_ERROR_INVALID_ARGUMENT, "size of 0",
            lobe_buffer_create(f->device, &(lobe_buffer_parameters){0}, &buffer));
    REFUSED(f, LOBE_ERROR_INVALID_ARGUMENT, "lobe_buffer_create",
            lobe_buffer_create(f->device, NULL, &buffer));
    REFUSED(f, LOBE_ERROR_INVALID_ARGUMENT, "lobe_graph_create_buffer",
            lobe_graph_create_buffer(f->graph, NULL, &buffer));
    REFUSED_SILENTLY(lobe_graph_create_buffer(NULL, NULL, NULL));
    REFUSED_SILENTLY(lobe_graph_submit_content(NULL));
    REFUSED_SILENTLY(lobe_buffer_update(NULL, NULL));
    lobe_buffer_destroy(NULL);
}

static void hosts_with_vulkan(void **state) {
    fixture *f = *state;
    lobe_device *device;
    const lobe_device_parameters parameters = {.host = &f->host};
    assert_non_null(lobe_vulkan_feature_list(NULL));
    assert_non_null(lobe_vulkan_extension_list(NULL));
    lobe_vulkan_features_fill(NULL, NULL);
    assert_int_equal(lobe_vulkan_extensions_fill(NULL, NULL, NULL), 0);
    assert_int_equal(lobe_vulkan_queue_family(NULL), UINT32_MAX);
    assert_true(lobe_vulkan_missing(NULL, NULL, NULL, 0) > 0);
    assert_int_equal(lobe_vulkan_format((VkFormat)-5), LOBE_FORMAT_NONE);
    lobe_vulkan_export_device(NULL, NULL);
    REFUSED(f, LOBE_ERROR_INVALID_ARGUMENT, "lobe_vulkan_import_device",
            lobe_vulkan_import_device(NULL, &parameters, &device));
    REFUSED(f, LOBE_ERROR_INVALID_ARGUMENT, "imported device",
            lobe_vulkan_import_device(&(lobe_vulkan_device){0}, &parameters, &device));
}

// ---------------------------------------------------------------------------------------------
// Graphs

static void graphs_that_are_none(void **state) {
    (void)state;
    lobe_resource none = {0};
    lobe_range all = {0};
    REFUSED_SILENTLY(lobe_graph_create(NULL, NULL));
    lobe_graph_destroy(NULL);
    lobe_graph_begin(NULL);
    lobe_graph_begin_aside(NULL);
    lobe_graph_keep_apart(NULL);
    assert_int_equal(lobe_graph_image(NULL, NULL).version, 0);
    assert_int_equal(lobe_graph_buffer(NULL, NULL).version, 0);
    assert_int_equal(lobe_graph_import_texture(NULL, NULL).version, 0);
    assert_int_equal(lobe_graph_import_buffer(NULL, NULL).version, 0);
    assert_int_equal(lobe_graph_import_image(NULL, NULL).version, 0);
    assert_int_equal(lobe_graph_import_host_buffer(NULL, NULL).version, 0);
    assert_int_equal(lobe_graph_buffer_size(NULL, none), 0);
    assert_false(lobe_graph_has_content(NULL, none));
    assert_int_equal(lobe_graph_upload(NULL, NULL, NULL, 5).version, 0);
    assert_int_equal(lobe_graph_describe_image(NULL, none).width, 0);
    assert_null(lobe_graph_add_pass(NULL, LOBE_PASS_COMPUTE, NULL));
    lobe_pass_read(NULL, NULL);
    assert_int_equal(lobe_pass_write(NULL, NULL).version, 0);
    assert_int_equal(lobe_pass_modify(NULL, NULL).version, 0);
    lobe_pass_dispatch(NULL, NULL);
    assert_int_equal(lobe_pass_colour(NULL, 0, NULL).version, 0);
    assert_int_equal(lobe_pass_resolve(NULL, 0, none).version, 0);
    assert_int_equal(lobe_pass_depth(NULL, NULL).version, 0);
    lobe_pass_draw(NULL, NULL);
    assert_int_equal(lobe_pass_copy(NULL, none, all, none, all).version, 0);
    assert_int_equal(lobe_pass_copy_part(NULL, none, NULL, none, 0, 0).version, 0);
    assert_int_equal(lobe_pass_fill(NULL, none, all, NULL).version, 0);
    lobe_pass_keep(NULL);
    lobe_pass_export(NULL, NULL);
    assert_null(lobe_graph_exported(NULL, 0, NULL));
    assert_int_equal(lobe_graph_fail(NULL, LOBE_ERROR_READ, "%s", "nobody hears"), LOBE_ERROR_READ);
    lobe_graph_output(NULL, none);
    lobe_graph_read_back(NULL, none, all);
    assert_int_equal(lobe_graph_read_back_late(NULL, none, all), 0);
    REFUSED_SILENTLY(lobe_graph_compile(NULL));
    REFUSED_SILENTLY(lobe_graph_prepare(NULL, NULL, NULL));
    REFUSED_SILENTLY(lobe_graph_execute(NULL));
    REFUSED_SILENTLY(lobe_graph_submit(NULL, NULL));
    REFUSED_SILENTLY(lobe_graph_wait(NULL));
    lobe_graph_set_frames_in_flight(NULL, 2);
    assert_null(lobe_graph_data(NULL, none, NULL));
    assert_null(lobe_graph_late_data(NULL, 1, NULL));
    lobe_graph_invalidate(NULL);
    lobe_graph_invalidate_except(NULL, NULL);
    lobe_graph_forget_buffer(NULL, NULL);
    assert_false(lobe_graph_settles(NULL));
    assert_null(lobe_graph_describe(NULL));
    assert_null(lobe_graph_dump_text(NULL));
    assert_null(lobe_graph_dump_graphviz(NULL));
}

/// Mistakes in a declaration fail the frame, with a line of their own.
static void declare_nonsense(lobe_graph *graph, int which) {
    const lobe_pass_kind kinds[] = {LOBE_PASS_COMPUTE, LOBE_PASS_RASTER, LOBE_PASS_TRANSFER};
    lobe_pass *pass = lobe_graph_add_pass(graph, kinds[which % 3], NULL);
    switch (which) {
    case 0:
        lobe_pass_dispatch(pass, NULL);
        break;
    case 1:
        lobe_pass_draw(pass, NULL);
        break;
    case 2: {
        const lobe_buffer_description numbers = {.name = "numbers", .size = 16};
        lobe_pass_fill(pass, lobe_graph_buffer(graph, &numbers), (lobe_range){0}, NULL);
        break;
    }
    case 3:
        lobe_pass_read(pass, NULL);
        break;
    case 4:
        lobe_pass_colour(pass, 0, NULL);
        break;
    case 5:
        lobe_graph_image(graph, NULL);
        break;
    case 6:
        lobe_graph_buffer(graph, NULL);
        break;
    case 7:
        lobe_graph_import_texture(graph, NULL);
        break;
    case 8:
        lobe_graph_import_buffer(graph, NULL);
        break;
    case 9:
        lobe_graph_import_image(graph, NULL);
        break;
    case 10:
        lobe_pass_export(lobe_graph_add_pass(graph, LOBE_PASS_EXPORT, NULL), NULL);
        break;
    default:
        lobe_graph_upload(graph, "numbers", NULL, 16);
    }
}

static void declarations_without_arguments(void **state) {
    fixture *f = *state;
    for (int which = 0; which <= 11; which++) {
        fixture_forget_messages(f);
        lobe_graph_begin(f->graph);
        declare_nonsense(f->graph, which);
        assert_failure(f, lobe_graph_compile(f->graph), LOBE_ERROR_GRAPH, "NULL");
    }
    lobe_graph_begin(f->graph);
    REFUSED(f, LOBE_ERROR_INVALID_ARGUMENT, "lobe_graph_submit", lobe_graph_submit(f->graph, NULL));
    lobe_graph_begin(f->graph);
    lobe_graph_invalidate_except(f->graph, NULL);
    lobe_graph_forget_buffer(f->graph, NULL);
}

static void profiles(void **state) {
    fixture *f = *state;
    lobe_profile *profile;
    lobe_profile_summary summary;
    REFUSED(f, LOBE_ERROR_INVALID_ARGUMENT, "lobe_profile_create",
            lobe_profile_create(&f->host, NULL));
    REFUSED_SILENTLY(lobe_profile_statistics(NULL, &summary));
    assert_int_equal(lobe_profile_create(&f->host, &profile), LOBE_OK);
    REFUSED(f, LOBE_ERROR_INVALID_ARGUMENT, "lobe_profile_add", lobe_profile_add(profile, NULL));
    lobe_profile_destroy(&profile);
    lobe_profile_destroy(NULL);
}

// ---------------------------------------------------------------------------------------------
// Scenes

static void environments(void **state) {
    fixture *f = *state;
    lobe_environment *environment;
    double position[2];
    assert_false(lobe_environment_position(NULL, NULL, position));
    lobe_environment_shrink(NULL, 8);
    lobe_environment_turn(NULL, 90);
    lobe_environment_destroy(NULL);
    REFUSED(f, LOBE_ERROR_INVALID_ARGUMENT, "lobe_environment_open",
            lobe_environment_open_with(NULL, &f->host, &environment));
    REFUSED(f, LOBE_ERROR_INVALID_ARGUMENT, "lobe_environment_open",
            lobe_environment_open(NULL, &f->host, &environment));
    REFUSED(f, LOBE_ERROR_INVALID_ARGUMENT, "lobe_environment_open",
            lobe_environment_open("sky", &f->host, NULL));
}

static void scenes(void **state) {
    fixture *f = *state;
    lobe_scene *scene;
    lobe_camera camera = {0};
    lobe_material_default(NULL);
    lobe_scene_frame(NULL, 1, &camera);
    lobe_scene_path(NULL, 0.5, &camera);
    lobe_scene_set_environment(NULL, NULL);
    lobe_scene_destroy(NULL);
    assert_null(lobe_builtin_scene_get(lobe_builtin_scene_count()));
    REFUSED(f, LOBE_ERROR_INVALID_ARGUMENT, "lobe_scene_open",
            lobe_scene_open_with(NULL, &f->host, &scene));
    REFUSED(f, LOBE_ERROR_INVALID_ARGUMENT, "lobe_scene_open",
            lobe_scene_open(NULL, &f->host, &scene));
    REFUSED(f, LOBE_ERROR_INVALID_ARGUMENT, "lobe_scene_open_with",
            lobe_scene_open_material(NULL, LOBE_CARRIER_PLANE, &f->host, &scene));
    REFUSED(f, LOBE_ERROR_INVALID_ARGUMENT, "no carrier 9",
            lobe_scene_open_material(".", (lobe_carrier)9, &f->host, &scene));
    scene = small_scene();
    static const double aspects[] = {0, -1, NAN, INFINITY};
    for (size_t i = 0; i < sizeof aspects / sizeof *aspects; i++) {
        lobe_scene_frame(scene, aspects[i], &camera);
        assert_true(isfinite(camera.eye[0]) && isfinite(camera.near_plane));
    }
    size_t animation;
    REFUSED(f, LOBE_ERROR_INVALID_ARGUMENT, "lobe_scene_set_pose",
            lobe_scene_set_pose(NULL, NULL, &f->host));
    REFUSED(f, LOBE_ERROR_INVALID_ARGUMENT, "a pose at nan s",
            lobe_scene_set_pose(scene, &(lobe_pose){.seconds = NAN}, &f->host));
    REFUSED(f, LOBE_ERROR_INVALID_ARGUMENT, "there is no animation 7",
            lobe_scene_set_pose(scene, &(lobe_pose){.animation = 7}, &f->host));
    REFUSED(f, LOBE_ERROR_INVALID_ARGUMENT, "lobe_scene_find_animation",
            lobe_scene_find_animation(NULL, "walk", &f->host, &animation));
    REFUSED(f, LOBE_ERROR_NOT_FOUND, "it has: none",
            lobe_scene_find_animation(scene, "walk", &f->host, &animation));
    lobe_scene_path(scene, NAN, &camera);
    assert_true(isfinite(camera.eye[0]));
    lobe_scene_destroy(&scene);
}

// ---------------------------------------------------------------------------------------------
// Filters and the renderer

static void filters(void **state) {
    fixture *f = *state;
    const lobe_host *host = &f->host;
    const lobe_filter *filter = lobe_filter_get(0);
    lobe_settings settings;
    char text[16] = "as before";
    double value;
    assert_null(lobe_filter_get(lobe_filter_count()));
    assert_string_equal(lobe_filter_name(NULL), "");
    assert_string_equal(lobe_filter_summary(NULL), "");
    assert_string_equal(lobe_filter_paper(NULL), "");
    assert_false(lobe_filter_supersamples(NULL));
    assert_false(lobe_filter_fits(NULL));
    assert_false(lobe_filter_shares(NULL));
    assert_false(lobe_filter_draws_waves(NULL));
    assert_int_equal(lobe_filter_knob_count(NULL), 0);
    assert_null(lobe_filter_knob(NULL, 0));
    assert_null(lobe_filter_knob(filter, LOBE_MAXIMUM_KNOBS));
    REFUSED(f, LOBE_ERROR_INVALID_ARGUMENT, "lobe_filter_find",
            lobe_filter_find(NULL, host, &filter));
    lobe_settings_default(NULL, &settings);
    lobe_settings_default(filter, NULL);
    REFUSED(f, LOBE_ERROR_INVALID_ARGUMENT, "lobe_settings_set",
            lobe_settings_set(filter, &settings, NULL, host));
    REFUSED(f, LOBE_ERROR_INVALID_ARGUMENT, "lobe_settings_get",
            lobe_settings_get(filter, &settings, NULL, &value, host));
    lobe_settings_print(filter, &settings, LOBE_MAXIMUM_KNOBS, text, sizeof text);
    assert_string_equal(text, "");
    lobe_settings_print(filter, &settings, 0, NULL, 0);
}

static void environment_maps(void **state) {
    fixture *f = *state;
    lobe_environment_maps *maps;
    lobe_image image;
    const lobe_environment_maps_parameters parameters = {.host = &f->host};
    REFUSED(f, LOBE_ERROR_INVALID_ARGUMENT, "lobe_environment_maps_create",
            lobe_environment_maps_create(f->device, &parameters, &maps));
    REFUSED_SILENTLY(lobe_environment_maps_update(NULL, NULL));
    REFUSED_SILENTLY(lobe_environment_maps_read(NULL, LOBE_ENVIRONMENT_GGX, 0, 0, &image));
    assert_null(lobe_environment_maps_describe(NULL));
    lobe_environment_maps_destroy(NULL);
    assert_true(lobe_environment_level_concentration(0, 99) >= 0);
}

static void maps_of_materials(void **state) {
    fixture *f = *state;
    lobe_maps *maps;
    lobe_material_maps material;
    REFUSED(f, LOBE_ERROR_INVALID_ARGUMENT, "lobe_maps_create",
            lobe_maps_create(f->device, NULL, &f->host, &maps));
    const lobe_scene empty = {.name = "empty"}, hollow = {.name = "hollow", .material_count = 2};
    REFUSED(f, LOBE_ERROR_MALFORMED, "no materials",
            lobe_maps_create(f->device, &(lobe_maps_parameters){.scene = &empty}, &f->host, &maps));
    REFUSED(
        f, LOBE_ERROR_MALFORMED, "2 materials, but no array",
        lobe_maps_create(f->device, &(lobe_maps_parameters){.scene = &hollow}, &f->host, &maps));
    REFUSED_SILENTLY(lobe_maps_update(NULL, NULL));
    REFUSED_SILENTLY(lobe_maps_record(NULL, NULL));
    REFUSED_SILENTLY(lobe_maps_get(NULL, 0, &material));
    assert_null(lobe_maps_graph(NULL));
    lobe_maps_destroy(NULL);
}

static void oceans(void **state) {
    fixture *f = *state;
    lobe_ocean *ocean;
    lobe_ocean_slopes slopes;
    const lobe_ocean_parameters parameters = {.wind_speed = NAN};
    lobe_ocean_default(NULL);
    REFUSED(f, LOBE_ERROR_INVALID_ARGUMENT, "parameters must not be NULL",
            lobe_ocean_measure(NULL, &f->host, &slopes));
    REFUSED(f, LOBE_ERROR_INVALID_ARGUMENT, "slopes must not be NULL",
            lobe_ocean_measure(&parameters, &f->host, NULL));
    REFUSED(f, LOBE_ERROR_INVALID_ARGUMENT, "wind_speed is nan",
            lobe_ocean_measure(&parameters, &f->host, &slopes));
    REFUSED(f, LOBE_ERROR_INVALID_ARGUMENT, "device and ocean",
            lobe_ocean_create(NULL, &parameters, &f->host, &ocean));
    REFUSED(f, LOBE_ERROR_INVALID_ARGUMENT, "device and ocean",
            lobe_ocean_create(f->device, &parameters, &f->host, NULL));
    REFUSED(f, LOBE_ERROR_INVALID_ARGUMENT, "parameters must not be NULL",
            lobe_ocean_create(f->device, NULL, &f->host, &ocean));
    assert_int_equal(lobe_ocean_add(NULL, NULL, NAN).version, 0);
    lobe_ocean_destroy(NULL);
}

static void renderers(void **state) {
    fixture *f = *state;
    lobe_renderer *renderer;
    lobe_frame frame;
    REFUSED(f, LOBE_ERROR_INVALID_ARGUMENT, "lobe_renderer_create",
            lobe_renderer_create(NULL, &f->host, &renderer));
    REFUSED_SILENTLY(lobe_renderer_set_scene(NULL, NULL));
    REFUSED_SILENTLY(lobe_renderer_update_scene(NULL, NULL));
    lobe_renderer_set_content_giver(NULL, NULL, NULL);
    REFUSED_SILENTLY(lobe_renderer_render(NULL, NULL, &frame));
    REFUSED_SILENTLY(lobe_renderer_fit(NULL, NULL, NULL));
    lobe_fitting_parameters fitting = {.filter = lobe_filter_get(0)};
    REFUSED(f, LOBE_ERROR_INVALID_ARGUMENT, "fits no maps",
            lobe_renderer_fit(f->renderer, &fitting, NULL));
    (void)lobe_filter_find("wu", &f->host, &fitting.filter);
    REFUSED(f, LOBE_ERROR_INVALID_ARGUMENT, "no folder",
            lobe_renderer_fit(f->renderer, &fitting, NULL));
    fitting.cache = "/nonexistent";
    fitting.part = fitting.part_count = 1;
    REFUSED(f, LOBE_ERROR_UNSUPPORTED, "not shared by parts",
            lobe_renderer_fit(f->renderer, &fitting, NULL));
    fitting.part = 2;
    REFUSED(f, LOBE_ERROR_INVALID_ARGUMENT, "part 2 of 1",
            lobe_renderer_fit(f->renderer, &fitting, NULL));
    fitting.part = fitting.part_count = 0;
    REFUSED(f, LOBE_ERROR_INVALID_ARGUMENT, "no scene is set",
            lobe_renderer_fit(f->renderer, &fitting, NULL));
    REFUSED_SILENTLY(lobe_renderer_prepare(NULL, NULL));
    REFUSED(f, LOBE_ERROR_INVALID_ARGUMENT, "lobe_renderer_prepare",
            lobe_renderer_prepare(f->renderer, NULL));
    REFUSED(f, LOBE_ERROR_INVALID_ARGUMENT, "no scene is set",
            lobe_renderer_prepare(f->renderer, &(lobe_render_parameters){0}));
    REFUSED(f, LOBE_ERROR_INVALID_ARGUMENT, "lobe_renderer_render",
            lobe_renderer_render(f->renderer, NULL, &frame));
    REFUSED(f, LOBE_ERROR_INVALID_ARGUMENT, "lobe_renderer_update_scene",
            lobe_renderer_update_scene(f->renderer, NULL));
    lobe_preparation *preparation;
    REFUSED(f, LOBE_ERROR_INVALID_ARGUMENT, "lobe_preparation_begin",
            lobe_preparation_begin(f->device, &(lobe_preparation_parameters){0}, &f->host,
                                   &preparation));
    assert_null(preparation);
    assert_false(lobe_preparation_is_done(NULL, NULL));
    lobe_preparation_destroy(NULL);
    lobe_preparation_destroy(&preparation);
    assert_null(lobe_renderer_graph(NULL));
    lobe_renderer_destroy(NULL);
    lobe_frame_free(NULL);
    lobe_scene *scene = small_scene();
    assert_int_equal(lobe_renderer_set_scene(f->renderer, scene), LOBE_OK);
    REFUSED(f, LOBE_ERROR_INVALID_ARGUMENT, "3 changes of kind 'mesh'",
            lobe_renderer_update_scene(f->renderer, &(lobe_scene_changes){.mesh_count = 3}));
    const size_t count = scene->instance_count;
    scene->instance_count = SIZE_MAX / 2;
    REFUSED(f, LOBE_ERROR_OUT_OF_MEMORY, "out of memory",
            lobe_renderer_update_scene(f->renderer, &(lobe_scene_changes){0}));
    REFUSED(f, LOBE_ERROR_INVALID_ARGUMENT, "instances, but the renderer was told",
            lobe_renderer_render(f->renderer, &(lobe_render_parameters){0}, &frame));
    scene->instance_count = count;
    assert_int_equal(lobe_renderer_set_scene(f->renderer, NULL), LOBE_OK);
    lobe_scene_destroy(&scene);
    REFUSED(f, LOBE_ERROR_MALFORMED, "nothing to draw",
            lobe_renderer_set_scene(f->renderer, &(lobe_scene){.name = "empty"}));
    REFUSED(
        f, LOBE_ERROR_MALFORMED, "2 instances, but no array",
        lobe_renderer_set_scene(f->renderer, &(lobe_scene){.name = "hollow", .instance_count = 2}));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(memory_and_files),
        cmocka_unit_test(images),
        cmocka_unit_test(openexr),
        cmocka_unit_test(devices),
        cmocka_unit_test(textures_and_buffers),
        cmocka_unit_test(hosts_with_vulkan),
        cmocka_unit_test(graphs_that_are_none),
        cmocka_unit_test(declarations_without_arguments),
        cmocka_unit_test(profiles),
        cmocka_unit_test(environments),
        cmocka_unit_test(scenes),
        cmocka_unit_test(filters),
        cmocka_unit_test(environment_maps),
        cmocka_unit_test(maps_of_materials),
        cmocka_unit_test(oceans),
        cmocka_unit_test(renderers),
    };
    return cmocka_run_group_tests(tests, fixture_create, fixture_destroy);
}
