// A program without a window that writes an animation to OpenEXR files: the camera moves along the
// scene's path, a light fades out, and the first material becomes rougher. Only the maps that
// depend on its roughness are rebuilt. Prints how many passes each frame took, and at the end how
// much memory lobe allocated, measured with a counting allocator.
//
//     offscreen_animation SCENE FOLDER FRAMES WIDTH HEIGHT

#include <math.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>

#include <lobe/lobe.h>

static void print(void *user, lobe_log_level level, const char *message) {
    (void)user;
    if (level <= LOBE_LOG_WARNING)
        fprintf(stderr, "offscreen_animation: %s\n", message);
}

// lobe may allocate from several threads at once.
static _Atomic size_t bytes, most_bytes;

static void *allocate(void *user, size_t size) {
    (void)user;
    const size_t now = atomic_fetch_add(&bytes, size) + size;
    if (now > most_bytes)
        most_bytes = now;
    return malloc(size);
}

static void release(void *user, void *memory, size_t size) {
    (void)user;
    bytes -= size;
    free(memory);
}

static const lobe_allocator counted = {.allocate = allocate, .release = release};
static const lobe_host messages = {.write = print, .allocator = &counted};

typedef struct animation {
    lobe_scene *scene; ///< modified in place in every frame
    lobe_renderer *renderer;
    const char *folder;
    uint32_t width, height;
} animation;

/// `part` [0, 1] says how far along the animation is. Lights and cameras are read in every frame;
/// a changed material must be listed for the renderer.
static lobe_result change_scene(animation *a, double part, lobe_camera *camera) {
    static const uint32_t first = 0;
    lobe_material *material = &a->scene->materials[first];
    lobe_scene_path(a->scene, 0.25 * part, camera);
    for (int channel = 0; channel < 3 && a->scene->light_count > 0; channel++)
        a->scene->lights[0].intensity[channel] *= 0.9f;
    // Half-vector lobes have a concentration, microfacets a roughness.
    material->roughness = fminf(1, material->roughness + 0.05f);
    for (uint32_t lobe = 0; lobe < material->lobe_count; lobe++)
        material->lobes[lobe].width *= 0.9f;
    const lobe_scene_changes changes = {.materials = &first, .material_count = 1};
    return lobe_renderer_update_scene(a->renderer, &changes);
}

static lobe_result write_frame(const animation *a, int number, const lobe_frame *frame) {
    char path[4096];
    snprintf(path, sizeof path, "%s/frame%04d.exr", a->folder, number);
    const lobe_exr_layer layer = {.image = &frame->radiance, .depth = LOBE_EXR_HALF};
    const lobe_exr_attribute attribute = {
        .name = "frame", .type = LOBE_EXR_INTEGER, .integer = number};
    return lobe_exr_write(
        path,
        &(lobe_exr_parameters){
            .layers = &layer, .layer_count = 1, .attributes = &attribute, .attribute_count = 1},
        &messages);
}

static lobe_result draw(animation *a, int number, double part) {
    lobe_camera camera = a->scene->camera;
    lobe_frame frame;
    lobe_result result = number > 0 ? change_scene(a, part, &camera) : LOBE_OK;
    result = result ? result
                    : lobe_renderer_render(a->renderer,
                                           &(lobe_render_parameters){.camera = &camera,
                                                                     .width = a->width,
                                                                     .height = a->height},
                                           &frame);
    if (result != LOBE_OK)
        return result;
    uint32_t passes = 0;
    for (size_t i = 0; i < frame.pass_count; i++)
        passes += frame.passes[i].count;
    printf("frame %d: %u passes, %.3f ms\n", number, passes, frame.milliseconds);
    result = write_frame(a, number, &frame);
    lobe_frame_free(&frame);
    return result;
}

int main(int argc, char **argv) {
    if (argc != 6) {
        fprintf(stderr, "Usage: offscreen_animation SCENE FOLDER FRAMES WIDTH HEIGHT\n");
        return 2;
    }
    const int frames = atoi(argv[3]);
    animation a = {.folder = argv[2],
                   .width = (uint32_t)strtoul(argv[4], NULL, 10),
                   .height = (uint32_t)strtoul(argv[5], NULL, 10)};
    lobe_device *device = NULL;
    lobe_result result = lobe_device_create(&(lobe_device_parameters){.host = &messages}, &device);
    result = result ? result : lobe_scene_open(argv[1], &messages, &a.scene);
    result = result ? result : lobe_renderer_create(device, &messages, &a.renderer);
    result = result ? result : lobe_renderer_set_scene(a.renderer, a.scene);
    for (int number = 0; result == LOBE_OK && number < frames; number++)
        result = draw(&a, number, (double)number / frames);
    lobe_renderer_destroy(&a.renderer);
    lobe_scene_destroy(&a.scene);
    lobe_device_destroy(&device);
    printf("memory: %zu bytes at most, %zu are left\n", most_bytes, bytes);
    return result != LOBE_OK;
}
