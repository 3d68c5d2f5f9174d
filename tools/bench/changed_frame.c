#include "tools/bench/changed_frame.h"

#include <stdlib.h>
#include <string.h>
#include <time.h>

static void move_row(unsigned char *row, size_t texel, size_t width) {
    unsigned char first[16]; // the largest texel
    memcpy(first, row, texel);
    memmove(row, row + texel, (width - 1) * texel);
    memcpy(row + (width - 1) * texel, first, texel);
}

static void move_texels(const lobe_image *image) {
    size_t texel = lobe_format_size(image->format);
    for (size_t y = 0; y < image->height; y++)
        move_row((unsigned char *)image->texels + y * image->width * texel, texel, image->width);
}

static double milliseconds(clockid_t clock) {
    struct timespec now;
    clock_gettime(clock, &now);
    return 1e3 * (double)now.tv_sec + 1e-6 * (double)now.tv_nsec;
}

static changed_cost cost_until_now(void) {
    return (changed_cost){milliseconds(CLOCK_MONOTONIC), milliseconds(CLOCK_THREAD_CPUTIME_ID),
                          milliseconds(CLOCK_PROCESS_CPUTIME_ID)};
}

lobe_result changed_frame_render(lobe_renderer *renderer, lobe_scene *scene, animation *animation,
                                 const lobe_render_parameters *parameters, const lobe_host *host,
                                 lobe_frame *frame, changed_cost *cost) {
    uint32_t *images = calloc(scene->image_count + 1, sizeof *images);
    *frame = (lobe_frame){0};
    if (!images)
        return lobe_host_fail(host, LOBE_ERROR_OUT_OF_MEMORY, "changed texels: out of memory");
    size_t count = 0;
    for (uint32_t i = 0; i < scene->image_count; i++) {
        if (scene->images[i].on_device)
            continue;
        images[count++] = i;
        move_texels(&scene->images[i].image);
    }
    const lobe_scene_changes changes = {.images = images, .image_count = count};
    lobe_result result = animation_set_time(animation, animation_time(animation) + 1.0 / 30);
    const changed_cost before = cost_until_now();
    if (result == LOBE_OK)
        result = lobe_renderer_update_scene(renderer, &changes);
    if (result == LOBE_OK)
        result = lobe_renderer_render(renderer, parameters, frame);
    const changed_cost after = cost_until_now();
    *cost = (changed_cost){after.wall - before.wall, after.caller_cpu - before.caller_cpu,
                           after.process_cpu - before.process_cpu};
    free(images);
    return result;
}

lobe_result changed_cost_add(lobe_profile *profile, const changed_cost *cost) {
    const lobe_pass_report parts[CHANGED_COSTS] = {
        [CHANGED_WALL] = {.name = "wall", .state = LOBE_PASS_RUN, .milliseconds = cost->wall},
        [CHANGED_CALLER_CPU] = {.name = "caller's CPU",
                                .state = LOBE_PASS_RUN,
                                .milliseconds = cost->caller_cpu},
        [CHANGED_PROCESS_CPU] = {.name = "process's CPU",
                                 .state = LOBE_PASS_RUN,
                                 .milliseconds = cost->process_cpu},
    };
    const lobe_graph_report report = {
        .passes = parts, .pass_count = CHANGED_COSTS, .milliseconds = cost->wall};
    return lobe_profile_add(profile, &report);
}
