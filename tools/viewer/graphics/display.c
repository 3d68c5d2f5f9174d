#include "tools/viewer/graphics/display.h"

#include <math.h>
#include <string.h>

#include "engine/shader/shaders.h"
#include "third_party/imgui.h"
#include "tools/viewer/shaders/display.h"
#include "tools/viewer/shaders/panel.h"

extern const engine_shader_code viewer_shaders[];
extern const size_t viewer_shaders_count;

// ---------------------------------------------------------------------------------------------
// Objects that outlive frames

lobe_result viewer_display_renew_font(const viewer_device *device, viewer_display *display) {
    lobe_texture_destroy(&display->font);
    lobe_image image = {.format = LOBE_FORMAT_R8_UNORM};
    image.texels = (void *)imgui_font(&image.width, &image.height);
    return lobe_texture_create(
        device->lobe, &(lobe_texture_parameters){.name = "font", .image = &image}, &display->font);
}

static lobe_result create_blank(const viewer_device *device, viewer_display *display) {
    float black[4] = {0};
    const lobe_image image = {LOBE_FORMAT_RGBA32_FLOAT, 1, 1, black};
    return lobe_texture_create(device->lobe,
                               &(lobe_texture_parameters){.name = "blank", .image = &image},
                               &display->blank);
}

lobe_result viewer_display_open(const viewer_device *device, viewer_display *display) {
    lobe_result result =
        engine_shaders_add(device->lobe, viewer_shaders, viewer_shaders_count, VIEWER_SHADERS);
    if (result == LOBE_OK)
        result = viewer_display_renew_font(device, display);
    if (result == LOBE_OK)
        result = create_blank(device, display);
    if (result == LOBE_OK)
        result = lobe_graph_create(device->lobe, &display->graph);
    if (result != LOBE_OK)
        viewer_display_close(display);
    return result;
}

void viewer_display_close(viewer_display *display) {
    lobe_graph_destroy(&display->graph);
    lobe_texture_destroy(&display->font);
    lobe_texture_destroy(&display->blank);
}

// ---------------------------------------------------------------------------------------------
// Pictures

static lobe_resource picture_of(const viewer_display *display, const viewer_side *side) {
    if (viewer_side_supersamples(side) && side->mean)
        return lobe_graph_import_texture(display->graph, side->mean);
    if (side->target.image.layout != VK_IMAGE_LAYOUT_UNDEFINED)
        return lobe_graph_import_image(display->graph, &side->target.image);
    return lobe_graph_import_texture(display->graph, display->blank);
}

/// The meaning of a picture's numbers, by the knob "view", as in capture_write_png: a mixture
/// rarely has more than 8 lobes, a map of 4096 texels has 12 levels above the base.
static uint kind_of(const viewer_side *side, float *maximum) {
    double view = 0;
    (void)lobe_settings_get(side->filter, &side->settings, "view", &view, NULL); // all have it
    *maximum = view == 1 ? 8.0f : 12.0f;
    if (side->output != VIEWER_RADIANCE)
        return DISPLAY_COLOUR;
    return view == 0 ? DISPLAY_RADIANCE : DISPLAY_COUNT;
}

static struct display_constants constants_of(const viewer_look *look, const viewer_side sides[2],
                                             uint32_t width) {
    struct display_constants constants = {
        .comparison = (uint)look->comparison,
        .divider = (float)(look->divider * width),
        .gain = exp2f((float)look->exposure),
        .error_maximum = (float)look->error_maximum,
    };
    constants.first_kind = kind_of(&sides[0], &constants.first_maximum);
    constants.second_kind = kind_of(&sides[1], &constants.second_maximum);
    return constants;
}

static void draw_pictures(viewer_display *display, const viewer_look *look,
                          const viewer_side sides[2], uint32_t width, lobe_pass *pass) {
    const struct display_constants constants = constants_of(look, sides, width);
    const lobe_resource first = picture_of(display, &sides[0]);
    const lobe_resource second =
        look->comparison == VIEWER_SINGLE ? first : picture_of(display, &sides[1]);
    const lobe_binding bindings[] = {{.name = "first_picture", .resource = first},
                                     {.name = "second_picture", .resource = second}};
    lobe_pass_draw(pass, &(lobe_draw){.vertex_shader = "display.vert",
                                      .fragment_shader = "display.frag",
                                      .index_count = 3,
                                      .constants = &constants,
                                      .constants_size = sizeof constants,
                                      .bindings = bindings,
                                      .binding_count = 2});
}

// ---------------------------------------------------------------------------------------------
// Panels

static void draw_batch(lobe_pass *pass, const imgui_batch *batch, const lobe_binding bindings[2],
                       const viewer_swapchain *swapchain) {
    struct panel_constants constants = {
        .pixel_width = 2.0f / (float)swapchain->width,
        .pixel_height = 2.0f / (float)swapchain->height,
    };
    memcpy(constants.clip, batch->clip, sizeof constants.clip);
    lobe_pass_draw(pass, &(lobe_draw){.vertex_shader = "panel.vert",
                                      .fragment_shader = "panel.frag",
                                      .first_index = batch->first,
                                      .index_count = batch->count,
                                      .blend = LOBE_BLEND_ALPHA,
                                      .constants = &constants,
                                      .constants_size = sizeof constants,
                                      .bindings = bindings,
                                      .binding_count = 2});
}

static void draw_panels(viewer_display *display, const viewer_swapchain *swapchain,
                        lobe_pass *pass) {
    const imgui_vertex *vertices;
    const imgui_batch *batches;
    size_t vertex_count, count = imgui_triangles(&vertices, &vertex_count, &batches);
    if (count == 0)
        return;
    const lobe_binding bindings[2] = {
        {.name = "vertices_block",
         .resource = lobe_graph_upload(display->graph, "panels", vertices,
                                       vertex_count * sizeof *vertices)},
        {.name = "font",
         .resource = lobe_graph_import_texture(display->graph, display->font),
         .sampler = {.texels = LOBE_SAMPLE_LINEAR,
                     .wrap_u = LOBE_WRAP_CLAMP,
                     .wrap_v = LOBE_WRAP_CLAMP}},
    };
    for (size_t i = 0; i < count; i++)
        draw_batch(pass, &batches[i], bindings, swapchain);
}

// ---------------------------------------------------------------------------------------------
// Frame

static lobe_resource import_window(viewer_display *display, const viewer_swapchain *swapchain) {
    return lobe_graph_import_image(display->graph,
                                   &(lobe_vulkan_image){
                                       .name = "window",
                                       .image = swapchain->images[swapchain->current],
                                       .format = swapchain->format,
                                       .width = swapchain->width,
                                       .height = swapchain->height,
                                       .usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT,
                                       .layout = VK_IMAGE_LAYOUT_UNDEFINED,
                                       .final_layout = VK_IMAGE_LAYOUT_PRESENT_SRC_KHR,
                                   });
}

lobe_result viewer_display_record(viewer_display *display, const viewer_look *look,
                                  const viewer_side sides[2], const viewer_swapchain *swapchain,
                                  VkCommandBuffer commands) {
    lobe_graph_begin(display->graph);
    lobe_resource window = import_window(display, swapchain);
    lobe_pass *pass = lobe_graph_add_pass(display->graph, LOBE_PASS_RASTER, "display");
    window = lobe_pass_colour(pass, 0,
                              &(lobe_attachment){.resource = window, .load = LOBE_LOAD_DISCARD});
    draw_pictures(display, look, sides, swapchain->width, pass);
    draw_panels(display, swapchain, pass);
    lobe_graph_output(display->graph, window);
    return lobe_graph_submit(display->graph, &(lobe_vulkan_submission){.commands = commands});
}
