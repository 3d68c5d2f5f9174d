#include "tools/animation/animation.h"

#include <string.h>

#include "engine/shader/shaders.h"

extern const engine_shader_code animation_shaders[];
extern const size_t animation_shaders_count;

/// What makes an image that is on the device, from another image of the scene.
static const struct generator {
    const char *image, *base, *shader;
} generators[] = {
    {"rain", "floor normals", "ripples.comp"},
    {"cloth", "tablecloth normals", "stretching.comp"},
};

struct animation {
    lobe_texture *base;
    uint32_t image; ///< of the scene
    const char *shader;
    uint32_t width, height; ///< texels
    double seconds;
};

static lobe_resource add_pass(const animation *a, lobe_graph *graph) {
    const lobe_image_description description = {.name = "animated map",
                                                .format = LOBE_FORMAT_RGBA8_UNORM,
                                                .width = a->width,
                                                .height = a->height,
                                                .retained = true};
    const float time = (float)a->seconds;
    lobe_pass *pass = lobe_graph_add_pass(graph, LOBE_PASS_COMPUTE, "animation");
    lobe_pass_read(pass, &(lobe_binding){.name = "base",
                                         .resource = lobe_graph_import_texture(graph, a->base),
                                         .sampler.texels = LOBE_SAMPLE_LINEAR});
    lobe_resource texels = lobe_pass_write(
        pass, &(lobe_binding){.name = "texels", .resource = lobe_graph_image(graph, &description)});
    lobe_pass_dispatch(pass, &(lobe_dispatch){.shader = a->shader,
                                              .threads = {a->width, a->height},
                                              .constants = &time,
                                              .constants_size = sizeof time});
    return texels;
}

static void give(void *user, lobe_graph *graph, const lobe_given_content *content) {
    const animation *a = user;
    content->images[a->image] = add_pass(a, graph);
}

/// Takes the texels at time 0.
static lobe_result take_example(const animation *a, lobe_device *device, lobe_image *image) {
    lobe_graph *graph;
    lobe_result result = lobe_graph_create(device, &graph);
    if (result != LOBE_OK)
        return result;
    lobe_graph_begin(graph);
    const lobe_resource texels = add_pass(a, graph);
    lobe_graph_read_back(graph, texels, (lobe_range){0});
    result = lobe_graph_execute(graph);
    size_t size;
    const void *data = result == LOBE_OK ? lobe_graph_data(graph, texels, &size) : NULL;
    if (data)
        memcpy(image->texels, data, size);
    lobe_graph_destroy(&graph);
    return result;
}

static const struct generator *find_generator(const lobe_scene_image *image) {
    for (size_t i = 0; image->on_device && i < sizeof generators / sizeof *generators; i++)
        if (strcmp(generators[i].image, image->name) == 0)
            return &generators[i];
    return NULL;
}

static const lobe_image *find_base(const lobe_scene *scene, const char *name) {
    size_t index = 0;
    while (strcmp(scene->images[index].name, name) != 0)
        ++index;
    return &scene->images[index].image;
}

static lobe_result prepare(animation *a, lobe_device *device, lobe_scene *scene,
                           const struct generator *generator) {
    const lobe_texture_parameters base = {.name = generator->base,
                                          .image = find_base(scene, generator->base)};
    lobe_result result =
        engine_shaders_add(device, animation_shaders, animation_shaders_count, ANIMATION_SHADERS);
    if (result == LOBE_OK)
        result = lobe_texture_create(device, &base, &a->base);
    return result == LOBE_OK ? take_example(a, device, &scene->images[a->image].image) : result;
}

lobe_result animation_create(lobe_device *device, lobe_scene *scene, const lobe_host *host,
                             animation **result) {
    *result = NULL;
    size_t index = 0;
    while (index < scene->image_count && !find_generator(&scene->images[index]))
        ++index;
    if (index == scene->image_count)
        return LOBE_OK;
    const struct generator *generator = find_generator(&scene->images[index]);
    animation *a = lobe_allocate(lobe_host_allocator(host), 1, sizeof *a);
    if (!a)
        return lobe_host_fail(host, LOBE_ERROR_OUT_OF_MEMORY, "%s: out of memory", scene->name);
    *a = (animation){.image = (uint32_t)index,
                     .shader = generator->shader,
                     .width = scene->images[index].image.width,
                     .height = scene->images[index].image.height};
    const lobe_result status = prepare(a, device, scene, generator);
    if (status == LOBE_OK)
        *result = a;
    else
        animation_destroy(&a);
    return status;
}

void animation_destroy(animation **animation) {
    if (!*animation)
        return;
    lobe_texture_destroy(&(*animation)->base);
    lobe_release(*animation);
    *animation = NULL;
}

void animation_attach(animation *animation, lobe_renderer *renderer) {
    lobe_renderer_set_content_giver(renderer, animation ? give : NULL, animation);
}

void animation_set_time(animation *animation, double seconds) {
    if (animation)
        animation->seconds = seconds;
}

double animation_time(const animation *animation) {
    return animation ? animation->seconds : 0;
}
