#include "passes/renderer/renderer.h"

#include <string.h>

/// `kind`: "image" or "mesh".
static void fail(const rendering *r, const char *kind, const char *name, const char *what) {
    lobe_graph_fail(r->context.graph, LOBE_ERROR_INVALID_ARGUMENT, "%s: %s '%s' %s",
                    r->context.scene->scene->name, kind, name, what);
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

static void check_given(const rendering *r, uint32_t index, const lobe_image_description *given) {
    const lobe_scene *scene = r->context.scene->scene;
    const lobe_scene_image *image = &scene->images[index];
    if (!image->on_device)
        fail(r, "image", image->name, "is not on the device, but the host gave texels that are");
    else if (given->width == 0)
        fail(r, "image", image->name, "is given by something that is no image of this frame");
    else if (given->width != image->image.width || given->height != image->image.height)
        lobe_graph_fail(r->context.graph, LOBE_ERROR_INVALID_ARGUMENT,
                        "%s: image '%s' is of %ux%u texels, but the host gave %ux%u", scene->name,
                        image->name, image->image.width, image->image.height, given->width,
                        given->height);
    else if (!can_be_sampled(given))
        lobe_graph_fail(r->context.graph, LOBE_ERROR_INVALID_ARGUMENT,
                        "%s: image '%s' is given with %u levels, %u layers, %u samples of %s; "
                        "expected one each, of colours",
                        scene->name, image->name, given->levels, given->layers,
                        given->samples > 0 ? given->samples : 1, lobe_format_name(given->format));
}

static void check_image(const rendering *r, uint32_t index) {
    const device_scene *scene = r->context.scene;
    const lobe_resource given = scene->given[index];
    if (given.version > 0) {
        const lobe_image_description description =
            lobe_graph_describe_image(r->context.graph, given);
        check_given(r, index, &description);
    } else if (scene->scene->images[index].on_device && is_drawn(scene, index)) {
        fail(r, "image", scene->scene->images[index].name,
             "is on the device, but the host gave no texels in this frame");
    }
}

// ---------------------------------------------------------------------------------------------
// Vertices

static bool is_mesh_drawn(const device_scene *scene, uint32_t mesh) {
    return scene->indices[mesh] != NULL;
}

static void check_vertices(const rendering *r, uint32_t index) {
    const device_scene *scene = r->context.scene;
    const lobe_mesh *mesh = &scene->scene->meshes[index];
    const lobe_resource given = scene->given_vertices[index];
    const size_t expected = mesh->vertex_count * sizeof *mesh->vertices,
                 found = lobe_graph_buffer_size(r->context.graph, given);
    if (given.version == 0 && mesh->on_device && is_mesh_drawn(scene, index))
        fail(r, "mesh", mesh->name,
             "is on the device, but the host gave no vertices in this frame");
    else if (given.version > 0 && !mesh->on_device)
        fail(r, "mesh", mesh->name, "is not on the device, but the host gave vertices that are");
    else if (given.version > 0 && found < expected)
        lobe_graph_fail(r->context.graph, LOBE_ERROR_INVALID_ARGUMENT,
                        "%s: mesh '%s' has %zu bytes of vertices, but the host gave %zu",
                        scene->scene->name, mesh->name, expected, found);
}

// ---------------------------------------------------------------------------------------------
// Both

void passes_given_content_take(rendering *r) {
    const lobe_renderer *renderer = r->renderer;
    const device_scene *scene = r->context.scene;
    const lobe_scene *source = scene->scene;
    const lobe_given_content content = {scene->given, scene->given_vertices};
    memset(scene->given, 0, source->image_count * sizeof *scene->given);
    memset(scene->given_vertices, 0, source->mesh_count * sizeof *scene->given_vertices);
    if (renderer->give_content)
        renderer->give_content(renderer->giver, r->context.graph, &content);
    for (uint32_t i = 0; i < source->image_count; i++)
        check_image(r, i);
    for (uint32_t i = 0; i < source->mesh_count; i++)
        check_vertices(r, i);
}
