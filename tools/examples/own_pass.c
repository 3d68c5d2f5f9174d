// A program that adds its own pass to every frame: a compute shader, outline.comp, draws outlines
// around the scene's objects. Its output is delivered instead of lobe's picture.
//
//     own_pass SCENE FILE.png WIDTH HEIGHT

#include <stdio.h>
#include <stdlib.h>

#include <lobe/lobe.h>

#include "outline.h" // outline_words: the shader's SPIR-V, written by glslangValidator --vn

static void print(void *user, lobe_log_level level, const char *message) {
    (void)user;
    if (level <= LOBE_LOG_WARNING)
        fprintf(stderr, "own_pass: %s\n", message);
}

static const lobe_host messages = {.write = print};

/// lobe calls this while it declares the frame. Bindings are named after the shader's variables.
static void add_outlines(void *user, lobe_graph *graph, lobe_render_stage stage,
                         lobe_render_resources *resources) {
    (void)user;
    if (stage != LOBE_RENDER_AFTER_SHADING)
        return;
    lobe_resource outlined =
        lobe_graph_image(graph, &(lobe_image_description){.name = "outlined picture",
                                                          .format = LOBE_FORMAT_RGBA32_FLOAT,
                                                          .width = resources->width,
                                                          .height = resources->height});
    lobe_pass *pass = lobe_graph_add_pass(graph, LOBE_PASS_COMPUTE, "outline");
    lobe_pass_read(pass, &(lobe_binding){.name = "radiance", .resource = resources->radiance});
    lobe_pass_read(pass, &(lobe_binding){.name = "depth", .resource = resources->depth});
    resources->radiance =
        lobe_pass_write(pass, &(lobe_binding){.name = "outlined", .resource = outlined});
    lobe_pass_dispatch(pass, &(lobe_dispatch){.shader = "outline.comp",
                                              .threads = {resources->width, resources->height}});
}

static lobe_result draw(lobe_renderer *renderer, char **argv) {
    lobe_frame frame;
    lobe_result result = lobe_renderer_render(renderer,
                                              &(lobe_render_parameters){
                                                  .width = (uint32_t)strtoul(argv[3], NULL, 10),
                                                  .height = (uint32_t)strtoul(argv[4], NULL, 10),
                                                  .host.add_passes = add_outlines,
                                              },
                                              &frame);
    if (result != LOBE_OK)
        return result;
    for (size_t i = 0; i < frame.pass_count; i++)
        printf("%-24s %8.3f ms\n", frame.passes[i].name, frame.passes[i].milliseconds);
    lobe_image picture = {0};
    result = lobe_display_encode(&frame.radiance, NULL, &messages, &picture);
    result = result ? result : lobe_png_write(argv[2], &picture, &messages);
    lobe_image_free(&picture);
    lobe_frame_free(&frame);
    return result;
}

int main(int argc, char **argv) {
    if (argc != 5) {
        fprintf(stderr, "Usage: own_pass SCENE FILE.png WIDTH HEIGHT\n");
        return 2;
    }
    lobe_device *device = NULL;
    lobe_scene *scene = NULL;
    lobe_renderer *renderer = NULL;
    const lobe_shader outline = {"outline.comp", outline_words, sizeof outline_words};
    lobe_result result = lobe_device_create(&(lobe_device_parameters){.host = &messages}, &device);
    result = result ? result : lobe_device_add_shader(device, &outline);
    result = result ? result : lobe_scene_open(argv[1], &messages, &scene);
    result = result ? result : lobe_renderer_create(device, &messages, &renderer);
    result = result ? result : lobe_renderer_set_scene(renderer, scene);
    result = result ? result : draw(renderer, argv);
    lobe_renderer_destroy(&renderer);
    lobe_scene_destroy(&scene);
    lobe_device_destroy(&device);
    return result != LOBE_OK;
}
