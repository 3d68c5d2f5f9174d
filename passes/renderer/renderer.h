#ifndef PASSES_RENDERER_RENDERER_H
#define PASSES_RENDERER_RENDERER_H

#include <lobe/renderer.h>

#include "passes/environment/light.h"
#include "passes/filters/slots.h"

struct lobe_renderer {
    lobe_device *device;
    lobe_host host;
    lobe_graph *graph;
    device_scene *scene;                ///< NULL: none is set
    filtered_appearance *appearances;   ///< one per instance of the scene
    lobe_resource *filtered_images;     ///< one per image of the scene
    filter_slots *slots;                ///< what filters prepared of the scene's materials
    const lobe_filter *reported_filter; ///< whose limits were already reported for this scene
    environment_state environment;
};

/// What one call of lobe_renderer_render works with. `context` points into it: do not copy it.
typedef struct rendering {
    lobe_renderer *renderer;
    const lobe_render_parameters *parameters;
    filter_context context;
    environment_work environment;
    lobe_settings settings;
    filtered_images images;
    uint32_t width, height; ///< pixels
} rendering;

#endif
