#include "passes/context/given_content.h"

#include <string.h>

#include "passes/upload/material_maps.h"
#include "passes/upload/scene_check.h"

/// `kind`: "image" or "mesh".
static void fail(const filter_context *context, const char *kind, const char *name,
                 const char *what) {
    lobe_graph_fail(context->graph, LOBE_ERROR_INVALID_ARGUMENT, "%s: %s '%s' %s",
                    context->scene->scene->name, kind, name, what);
}

// ---------------------------------------------------------------------------------------------
// Images

static bool is_drawn(const device_scene *scene, uint32_t image) {
    for (size_t i = 0; i < scene->scene->material_count; i++) {
        const device_material *material = &scene->materials[i];
        for (uint32_t map = 0; material->first_instance && map < MAP_COUNT; map++)
            if (material->maps[map].use && material->maps[map].image == (int32_t)image)
                return true;
    }
    return false;
}

static bool can_be_sampled(const lobe_image_description *image) {
    return image->levels <= 1 && image->layers <= 1 && image->samples <= 1 &&
           image->format != LOBE_FORMAT_D32_FLOAT;
}

/// As for uploaded images, whatever map a material has it as.
static bool lacks_sign(const lobe_scene_image *image, lobe_format given) {
    return passes_normals_are_signed(image->normals) && !passes_format_has_sign(given);
}

static bool lacks_channel(const lobe_scene *scene, uint32_t index, lobe_format given) {
    return lobe_format_channels(given) < passes_normal_channels(scene->images[index].normals) &&
           passes_scene_has_normals_in(scene, index);
}

static void check_given(const filter_context *context, uint32_t index,
                        const lobe_image_description *given) {
    const lobe_scene *scene = context->scene->scene;
    const lobe_scene_image *image = &scene->images[index];
    if (!image->on_device)
        fail(context, "image", image->name,
             "is not on the device, but the host gave texels that are");
    else if (given->width == 0)
        fail(context, "image", image->name, "is given by something that is no image of this frame");
    else if (given->width != image->image.width || given->height != image->image.height)
        lobe_graph_fail(context->graph, LOBE_ERROR_INVALID_ARGUMENT,
                        "%s: image '%s' is of %ux%u texels, but the host gave %ux%u", scene->name,
                        image->name, image->image.width, image->image.height, given->width,
                        given->height);
    else if (!can_be_sampled(given))
        lobe_graph_fail(context->graph, LOBE_ERROR_INVALID_ARGUMENT,
                        "%s: image '%s' is given with %u levels, %u layers, %u samples of %s; "
                        "expected one each, of colours",
                        scene->name, image->name, given->levels, given->layers,
                        given->samples > 0 ? given->samples : 1, lobe_format_name(given->format));
    else if (lacks_sign(image, given->format))
        lobe_graph_fail(context->graph, LOBE_ERROR_INVALID_ARGUMENT,
                        "%s: image '%s' has signed normals, but the host gave the format %s, which "
                        "has no sign",
                        scene->name, image->name, lobe_format_name(given->format));
    else if (passes_format_is_srgb(given->format) && passes_scene_has_normals_in(scene, index))
        lobe_graph_fail(context->graph, LOBE_ERROR_INVALID_ARGUMENT,
                        "%s: image '%s' has normals, but the host gave the format %s, which is for "
                        "colours",
                        scene->name, image->name, lobe_format_name(given->format));
    else if (lacks_channel(scene, index, given->format))
        lobe_graph_fail(context->graph, LOBE_ERROR_INVALID_ARGUMENT,
                        "%s: image '%s' has normals of %u channels, but the host gave the format "
                        "%s, which has %u",
                        scene->name, image->name, passes_normal_channels(image->normals),
                        lobe_format_name(given->format), lobe_format_channels(given->format));
}

static void check_image(const filter_context *context, uint32_t index) {
    const device_scene *scene = context->scene;
    const lobe_resource given = scene->given[index];
    if (given.version > 0) {
        const lobe_image_description description = lobe_graph_describe_image(context->graph, given);
        check_given(context, index, &description);
    } else if (scene->scene->images[index].on_device && is_drawn(scene, index)) {
        fail(context, "image", scene->scene->images[index].name,
             "is on the device, but the host gave no texels in this frame");
    }
}

// ---------------------------------------------------------------------------------------------
// Vertices

static bool is_mesh_drawn(const device_scene *scene, uint32_t mesh) {
    return scene->measures[mesh].has_instances;
}

/// `when`: " for the previous frame", or nothing.
static void check_given_vertices(const filter_context *context, uint32_t index, lobe_resource given,
                                 const char *when) {
    const lobe_scene *scene = context->scene->scene;
    const lobe_mesh *mesh = &scene->meshes[index];
    const size_t expected = mesh->vertex_count * sizeof *mesh->vertices,
                 found = lobe_graph_buffer_size(context->graph, given);
    if (!mesh->on_device)
        fail(context, "mesh", mesh->name,
             "is not on the device, but the host gave vertices that are");
    else if (found < expected)
        lobe_graph_fail(context->graph, LOBE_ERROR_INVALID_ARGUMENT,
                        "%s: mesh '%s' has %zu bytes of vertices, but the host gave %zu%s",
                        scene->name, mesh->name, expected, found, when);
}

static void check_vertices(const filter_context *context, uint32_t index) {
    const device_scene *scene = context->scene;
    const lobe_mesh *mesh = &scene->scene->meshes[index];
    const lobe_resource given = scene->given_vertices[index],
                        previous = scene->previous_vertices[index];
    if (given.version == 0 && mesh->on_device && is_mesh_drawn(scene, index))
        fail(context, "mesh", mesh->name,
             "is on the device, but the host gave no vertices in this frame");
    if (given.version > 0)
        check_given_vertices(context, index, given, "");
    if (previous.version > 0)
        check_given_vertices(context, index, previous, " for the previous frame");
}

// ---------------------------------------------------------------------------------------------
// Waves

static void check_waves(const filter_context *context, uint32_t index) {
    const device_scene *scene = context->scene;
    const lobe_material *material = &scene->scene->materials[index];
    const lobe_waves *waves = &material->waves;
    const lobe_resource given = scene->given_waves[index];
    if (given.version == 0) {
        if (waves->layers > 0 && scene->materials[index].first_instance)
            fail(context, "material", material->name,
                 "has waves, but the host gave none in this frame");
        return;
    }
    const lobe_image_description image = lobe_graph_describe_image(context->graph, given);
    if (waves->layers == 0)
        fail(context, "material", material->name, "has no waves, but the host gave some");
    else if (image.format != LOBE_FORMAT_RGBA32_FLOAT || image.width != waves->size ||
             image.height != waves->size || image.layers != 2 * waves->layers || image.levels > 1)
        lobe_graph_fail(context->graph, LOBE_ERROR_INVALID_ARGUMENT,
                        "%s: the waves of material '%s' are given as %ux%u texels of %s with %u "
                        "layers and %u levels; expected %ux%u of RGBA32_FLOAT, %u layers, 1 level",
                        scene->scene->name, material->name, image.width, image.height,
                        lobe_format_name(image.format), image.layers, image.levels, waves->size,
                        waves->size, 2 * waves->layers);
}

// ---------------------------------------------------------------------------------------------
// All

/// Those of images and waves.
static void take_maps(const filter_context *context, const lobe_given_content *content,
                      lobe_content_giver give, void *giver) {
    const device_scene *scene = context->scene;
    memset(scene->given, 0, scene->scene->image_count * sizeof *scene->given);
    memset(scene->given_waves, 0, scene->scene->material_count * sizeof *scene->given_waves);
    if (give)
        give(giver, context->graph, content);
    for (uint32_t i = 0; i < scene->scene->image_count; i++)
        check_image(context, i);
    for (uint32_t i = 0; i < scene->scene->material_count; i++)
        check_waves(context, i);
}

void passes_given_maps_take(const filter_context *context, lobe_content_giver give, void *giver) {
    const lobe_given_content content = {.images = context->scene->given,
                                        .waves = context->scene->given_waves};
    take_maps(context, &content, give, giver);
}

void passes_given_content_take(const filter_context *context, lobe_content_giver give,
                               void *giver) {
    const device_scene *scene = context->scene;
    const size_t meshes = scene->scene->mesh_count;
    const lobe_given_content content = {scene->given, scene->given_vertices,
                                        scene->previous_vertices, scene->given_waves};
    memset(scene->given_vertices, 0, meshes * sizeof *scene->given_vertices);
    memset(scene->previous_vertices, 0, meshes * sizeof *scene->previous_vertices);
    take_maps(context, &content, give, giver);
    for (uint32_t i = 0; i < scene->scene->mesh_count; i++)
        check_vertices(context, i);
}
