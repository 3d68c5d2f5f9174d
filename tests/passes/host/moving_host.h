#ifndef TESTS_PASSES_HOST_MOVING_HOST_H
#define TESTS_PASSES_HOST_MOVING_HOST_H

#include "tests/passes/support/fixture.h"

#include "tests/engine/support/counting_allocator.h"
#include "tests/engine/support/host_device.h"

/// A program as those that lobe is made for: it has its own Vulkan device, draws two frames at a
/// time, and its compute shader writes the maps of some materials in every frame: their normals,
/// and colours that may go with these.

enum {
    MOVING_INSTANCES = 1000,
    MOVING_MATERIALS = 24,
    MOVING_COLOURS = 2,               ///< maps that change, of the second material and the third
    MOVING_MAPS = MOVING_COLOURS + 6, ///< with normals; the first materials have them
    MOVING_FLIGHT = 2,
    MOVING_MAP = 16, ///< texels wide and high
};

typedef struct moving_host {
    host_device host;
    counting_allocator counting; ///< of everything in lobe except the scene
    lobe_device *device;
    lobe_renderer *renderer;
    lobe_scene *scene;
    const lobe_filter *filter;
    const lobe_settings *settings; ///< NULL: the filter's defaults
    host_image maps[MOVING_MAPS], pictures[MOVING_FLIGHT];
    VkImageView views[MOVING_MAPS];
    VkDescriptorSetLayout set_layout;
    VkDescriptorPool descriptors;
    VkDescriptorSet sets[MOVING_MAPS];
    VkPipelineLayout layout;
    VkPipeline ripples;
    VkCommandPool pool;
    VkCommandBuffer commands[MOVING_FLIGHT];
    VkSemaphore timeline;
    uint64_t value, done[MOVING_FLIGHT]; ///< of the timeline: so far; when a slot is free again
    uint32_t frame, slot;                ///< frames so far, and the last one's slot
    float colours;                       ///< how much they go with normals, [0, 1]
} moving_host;

/// `validated`: under the validation layer, whose memory grows with each call.
void moving_host_open(moving_host *m, const char *filter, bool validated);
/// Asserts that nothing is left, and that nobody complained.
void moving_host_close(moving_host *m);

/// Of another size, after what is in flight. Also before the first frame.
void moving_host_resize(moving_host *m, uint32_t width, uint32_t height);
/// Writes the maps and draws a frame, without waiting for it. The maps depend on `phase` and
/// `colours` alone.
void moving_host_draw(moving_host *m, float phase);
/// Waits for all frames.
void moving_host_finish(moving_host *m);
/// The last frame's picture, RGBA32_FLOAT; the caller frees it.
float *moving_host_picture(moving_host *m);

#endif
