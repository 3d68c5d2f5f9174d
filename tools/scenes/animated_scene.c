#include "tools/scenes/animated_scene.h"

#include <string.h>

#include "scenes/scene/scene.h"

static lobe_result rename(char **name, const char *text, const lobe_host *host) {
    char *copy = lobe_copy_text(lobe_host_allocator(host), text);
    if (!copy)
        return lobe_host_fail(host, LOBE_ERROR_OUT_OF_MEMORY, "%s: out of memory", text);
    lobe_release(*name);
    *name = copy;
    return LOBE_OK;
}

/// Adds a copy of an image under its own name; the image itself becomes the one that materials get
/// from the device.
static lobe_result put_on_device(lobe_scene *scene, size_t index, const char *name,
                                 const lobe_host *host) {
    const lobe_image *image = &scene->images[index].image;
    lobe_image copy;
    lobe_result result =
        lobe_image_allocate(&copy, image->format, image->width, image->height, host);
    if (result != LOBE_OK)
        return result;
    memcpy(copy.texels, image->texels,
           (size_t)image->width * image->height * lobe_format_size(image->format));
    result = scenes_add_image(scene, scene->images[index].name, &copy, host, NULL);
    if (result == LOBE_OK)
        result = rename(&scene->images[index].name, name, host);
    scene->images[index].on_device = true;
    return result;
}

/// A built-in scene under another name, which its image of `map` gets too.
static lobe_result animate(const char *name, const char *still, const char *map,
                           const lobe_host *host, lobe_scene **scene) {
    lobe_result result = lobe_scene_open(still, host, scene);
    size_t index = 0;
    while (result == LOBE_OK && strcmp((*scene)->images[index].name, map) != 0)
        ++index;
    if (result == LOBE_OK)
        result = put_on_device(*scene, index, name, host);
    if (result == LOBE_OK)
        result = rename(&(*scene)->name, name, host);
    if (result != LOBE_OK)
        lobe_scene_destroy(scene);
    return result;
}

lobe_result animated_scene_rain(const char *assets, const lobe_host *host, lobe_scene **scene) {
    static const float eye[3] = {0.3f, 1.1f, 3.6f}, target[3] = {-0.1f, 0.3f, -1.5f};
    (void)assets;
    lobe_result result = animate("rain", "hall", "floor normals", host, scene);
    // Nearer to the floor than in the hall.
    if (result == LOBE_OK) {
        memcpy((*scene)->camera.eye, eye, sizeof eye);
        memcpy((*scene)->camera.target, target, sizeof target);
    }
    return result;
}

lobe_result animated_scene_cloth(const char *assets, const lobe_host *host, lobe_scene **scene) {
    (void)assets;
    return animate("cloth", "tablecloth", "tablecloth normals", host, scene);
}
