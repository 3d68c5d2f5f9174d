#include "tools/animation/animation.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include <lobe/ocean.h>

#include "engine/shader/shaders.h"
#include "tools/animation/terrain_maps.h"
#include "tools/scenes/outdoors/ocean_scene.h"

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
    lobe_host host;
    double seconds;
    // A map.
    lobe_texture *base;
    uint32_t image;         ///< of the scene
    const char *shader;     ///< NULL: there is none
    uint32_t width, height; ///< texels
    // Maps of a terrain.
    bool has_terrain;
    terrain_maps terrain;
    // Waves.
    lobe_ocean *ocean;
    uint32_t material; ///< that has them
    // A rig.
    lobe_scene *scene;
    size_t index; ///< of its animation
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
    if (a->has_terrain)
        terrain_maps_give(&a->terrain, graph, content->images);
    else if (a->ocean)
        content->waves[a->material] = lobe_ocean_add(a->ocean, graph, a->seconds);
    else
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

static lobe_result allocate(const lobe_scene *scene, const lobe_host *host, animation **result) {
    *result = lobe_allocate(lobe_host_allocator(host), 1, sizeof **result);
    if (!*result)
        return lobe_host_fail(host, LOBE_ERROR_OUT_OF_MEMORY, "%s: out of memory", scene->name);
    if (host)
        (*result)->host = *host;
    return LOBE_OK;
}

static lobe_result create_map(lobe_device *device, lobe_scene *scene, size_t index,
                              const lobe_host *host, animation **result) {
    const struct generator *generator = find_generator(&scene->images[index]);
    lobe_result status = allocate(scene, host, result);
    if (status != LOBE_OK)
        return status;
    (*result)->image = (uint32_t)index;
    (*result)->shader = generator->shader;
    (*result)->width = scene->images[index].image.width;
    (*result)->height = scene->images[index].image.height;
    return prepare(*result, device, scene, generator);
}

static lobe_result create_waves(lobe_device *device, const lobe_scene *scene, size_t material,
                                const lobe_host *host, animation **result) {
    lobe_result status = allocate(scene, host, result);
    if (status != LOBE_OK)
        return status;
    lobe_ocean_parameters sea;
    ocean_scene_sea(&sea);
    (*result)->material = (uint32_t)material;
    return lobe_ocean_create(device, &sea, host, &(*result)->ocean);
}

/// Its maps stay the same, its camera flies.
static lobe_result create_terrain(lobe_device *device, lobe_scene *scene, const terrain_maps *maps,
                                  const lobe_host *host, animation **result) {
    lobe_result status = allocate(scene, host, result);
    if (status != LOBE_OK)
        return status;
    (*result)->scene = scene;
    (*result)->has_terrain = true;
    (*result)->terrain = *maps;
    status =
        engine_shaders_add(device, animation_shaders, animation_shaders_count, ANIMATION_SHADERS);
    return status ? status : animation_set_time(*result, 0);
}

static lobe_result create_pose(lobe_scene *scene, const lobe_host *host, animation **result) {
    lobe_result status = allocate(scene, host, result);
    if (status != LOBE_OK)
        return status;
    (*result)->scene = scene;
    return animation_set_time(*result, 0);
}

lobe_result animation_create(lobe_device *device, lobe_scene *scene, const lobe_host *host,
                             animation **result) {
    *result = NULL;
    size_t index = 0;
    while (index < scene->image_count && !find_generator(&scene->images[index]))
        ++index;
    size_t material = 0;
    while (material < scene->material_count && scene->materials[material].waves.layers == 0)
        ++material;
    terrain_maps terrain;
    const bool has_map = index < scene->image_count, has_waves = material < scene->material_count,
               has_terrain = terrain_maps_find(scene, &terrain);
    if (!has_map && !has_waves && (!scene->rig || scene->rig->animation_count == 0))
        return LOBE_OK;
    const lobe_result status = has_map       ? create_map(device, scene, index, host, result)
                               : has_waves   ? create_waves(device, scene, material, host, result)
                               : has_terrain ? create_terrain(device, scene, &terrain, host, result)
                                             : create_pose(scene, host, result);
    if (status != LOBE_OK)
        animation_destroy(result);
    return status;
}

void animation_destroy(animation **animation) {
    if (!*animation)
        return;
    lobe_texture_destroy(&(*animation)->base);
    lobe_ocean_destroy(&(*animation)->ocean);
    lobe_release(*animation);
    *animation = NULL;
}

void animation_attach(animation *animation, lobe_renderer *renderer) {
    const bool gives =
        animation && (animation->shader || animation->ocean || animation->has_terrain);
    lobe_renderer_set_content_giver(renderer, gives ? give : NULL, animation);
}

// ---------------------------------------------------------------------------------------------
// Time

static lobe_result set_pose(animation *a, size_t index, double seconds) {
    const lobe_pose pose = {.animation = index, .seconds = seconds};
    const lobe_result result = a->scene ? lobe_scene_set_pose(a->scene, &pose, &a->host) : LOBE_OK;
    if (result != LOBE_OK)
        return result;
    a->index = index;
    a->seconds = seconds;
    return LOBE_OK;
}

lobe_result animation_set_time(animation *animation, double seconds) {
    return animation ? set_pose(animation, animation->index, seconds) : LOBE_OK;
}

double animation_time(const animation *animation) {
    return animation ? animation->seconds : 0;
}

lobe_result animation_set_index(animation *animation, size_t index) {
    return animation && animation->scene ? set_pose(animation, index, animation->seconds) : LOBE_OK;
}

lobe_result animation_find(const lobe_scene *scene, const char *text, const lobe_host *host,
                           size_t *index) {
    const size_t count = scene->rig ? scene->rig->animation_count : 0;
    char *end;
    const unsigned long number = strtoul(text, &end, 10);
    *index = 0;
    // A name may be a number, or "all", too.
    if (count == 0 || lobe_scene_find_animation(scene, text, NULL, index) == LOBE_OK)
        return LOBE_OK;
    const bool all = strcmp(text, "all") == 0;
    if (!all && (text[0] < '0' || text[0] > '9' || *end != '\0' || number >= count))
        return lobe_scene_find_animation(scene, text, host, index);
    *index = all ? LOBE_ANIMATION_ALL : number;
    return LOBE_OK;
}

size_t animation_index(const animation *animation) {
    return animation ? animation->index : 0;
}

double animation_duration(const animation *animation) {
    const lobe_rig *rig = animation && animation->scene ? animation->scene->rig : NULL;
    double longest = 0;
    for (size_t i = 0; rig && i < rig->animation_count; i++)
        if (animation->index == LOBE_ANIMATION_ALL || animation->index == i)
            longest = fmax(longest, rig->animations[i].duration);
    return longest;
}
