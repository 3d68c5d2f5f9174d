#include "passes/renderer/renderer.h"

#include <string.h>

static bool is_drawn(const device_scene *scene, uint32_t image) {
    for (size_t i = 0; i < scene->scene->material_count; i++) {
        const device_material *material = &scene->materials[i];
        for (uint32_t map = 0; material->first_instance && map < MAP_COUNT; map++)
            if (material->maps[map].use && material->maps[map].image == (int32_t)image)
                return true;
    }
    return false;
}

static void fail(const rendering *r, uint32_t index, const char *what) {
    const lobe_scene *scene = r->context.scene->scene;
    lobe_graph_fail(r->context.graph, LOBE_ERROR_INVALID_ARGUMENT, "%s: image '%s' %s", scene->name,
                    scene->images[index].name, what);
}

static void check(const rendering *r, uint32_t index) {
    const device_scene *scene = r->context.scene;
    const lobe_scene_image *image = &scene->scene->images[index];
    const lobe_resource given = scene->given[index];
    uint32_t width, height;
    if (given.version == 0) {
        if (image->on_device && is_drawn(scene, index))
            fail(r, index, "is on the device, but the host gave no texels in this frame");
        return;
    }
    lobe_graph_extent(r->context.graph, given, &width, &height);
    if (!image->on_device)
        fail(r, index, "is not on the device, but the host gave texels that are");
    else if (width != image->image.width || height != image->image.height)
        lobe_graph_fail(r->context.graph, LOBE_ERROR_INVALID_ARGUMENT,
                        "%s: image '%s' is of %ux%u texels, but the host gave %ux%u",
                        scene->scene->name, image->name, image->image.width, image->image.height,
                        width, height);
}

void passes_given_images_take(rendering *r) {
    const lobe_renderer *renderer = r->renderer;
    const device_scene *scene = r->context.scene;
    const size_t count = scene->scene->image_count;
    memset(scene->given, 0, count * sizeof *scene->given);
    if (renderer->give_images)
        renderer->give_images(renderer->giver, r->context.graph, scene->given);
    for (uint32_t i = 0; i < count; i++)
        check(r, i);
}
