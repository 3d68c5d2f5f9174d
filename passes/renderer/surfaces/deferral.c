#include "passes/renderer/surfaces/deferral.h"

#include "passes/context/knob_values.h"
#include "passes/context/shared_knobs.h"
#include "passes/upload/material_maps.h"
#include "shaders/interface/picture/surfaces.h"

/// Choices of the knob.
enum { WITH_TRIANGLES, DEFERRED, AUTOMATIC };

/// Smaller pictures take less time than their pipelines.
#define LEAST_PIXELS (128u * 128u)
/// Of a picture of surfaces, unless the knob asks for it.
#define MOST_BYTES (256ull << 20)
/// Each of them is a draw over the whole picture.
#define MOST_BATCHES 64u
/// Where triangles are larger than that on average, shading with them wastes little.
#define LARGEST_TRIANGLE 100.0 ///< pixels

bool passes_surfaces_hold(const filter_context *context, const instance_batch *batch) {
    const device_material *material =
        &context->scene->materials[context->scene->instances[batch->instance].material];
    return !material->masked && passes_second_coordinates(material) == 0;
}

static bool fits(const filter_context *context) {
    const uint64_t pixels = (uint64_t)context->view.width * context->view.height;
    return pixels >= LEAST_PIXELS && pixels * SURFACES_LAYERS * 4 * sizeof(float) <= MOST_BYTES;
}

/// Displaced triangles have about the size that they are asked to have, and the device counts them.
static bool has_small_triangles(const filter_context *context, const draw_list *draws) {
    double triangles = 0;
    for (uint32_t i = 0; i < draws->batch_count; i++) {
        const instance_batch *batch = &draws->batches[i];
        if (!passes_surfaces_hold(context, batch))
            continue;
        if (batch->displaced.vertices.version > 0)
            return true;
        triangles += passes_batch_index_count(context->scene, batch) / 3.0 * batch->count;
    }
    return triangles * LARGEST_TRIANGLE > (double)context->view.width * context->view.height;
}

static bool is_worth_it(const filter_context *context, const draw_list *draws) {
    return context->filter->shades_long && context->device->type == LOBE_DEVICE_CPU &&
           fits(context) && draws->batch_count <= MOST_BATCHES &&
           has_small_triangles(context, draws);
}

bool passes_defers_shading(const filter_context *context, const draw_list *draws) {
    const uint32_t choice = passes_knob_choice(context, &passes_knob_shading);
    if (draws->batch_count == 0 || context->device->maximum_colour_outputs < SURFACES_LAYERS)
        return false;
    return choice == AUTOMATIC ? is_worth_it(context, draws) : choice == DEFERRED;
}
