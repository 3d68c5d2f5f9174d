#include "passes/renderer/surfaces/deferral.h"

#include "passes/context/fit_work.h"
#include "passes/context/knob_values.h"
#include "passes/context/shared_knobs.h"
#include "passes/maps/tile_knobs.h"
#include "passes/upload/material_maps.h"
#include "shaders/interface/picture/surfaces.h"

#include <math.h>

/// Choices of the knob.
enum { WITH_TRIANGLES, DEFERRED, AUTOMATIC };

/// Smaller pictures take less time than their pipelines.
#define LEAST_PIXELS (128u * 128u)
/// Of a picture of surfaces, unless the knob asks for it.
#define MOST_BYTES (256ull << 20)
/// Where triangles are larger than that on average, a picture of surfaces takes longer than what
/// `direct` wastes along their edges. Filters that take more time for a pixel waste more.
#define LARGEST_TRIANGLE 60.0 ///< pixels

/// Tiles of filtered maps, among them a mask's, are made after the picture that tells which.
static bool can_cut_masks(const filter_context *context) {
    return !context->filter->moves_masks && !passes_wants_seen_tiles(context);
}

bool passes_surfaces_hold(const filter_context *context, const instance_batch *batch) {
    const device_material *material =
        &context->scene->materials[context->scene->instances[batch->instance].material];
    return passes_second_coordinates(material) == 0 &&
           (!material->masked || can_cut_masks(context));
}

static bool fits(const filter_context *context) {
    const uint64_t pixels = (uint64_t)context->view.width * context->view.height;
    return pixels >= LEAST_PIXELS && pixels * SURFACES_LAYERS * 4 * sizeof(float) <= MOST_BYTES;
}

static bool is_displaced(const draw_list *draws) {
    for (uint32_t i = 0; i < draws->batch_count; i++)
        if (draws->batches[i].displaced.vertices.version > 0)
            return true;
    return false;
}

/// Displaced triangles have about the size that they are asked to have, and the device counts them.
/// Hidden instances count: those that appear must not change the choice, and with it the pipelines.
static bool has_small_triangles(const filter_context *context, const draw_list *draws) {
    const lobe_scene *scene = context->scene->scene;
    const double largest = LARGEST_TRIANGLE * fmax(context->filter->shading_cost, 1.0);
    double triangles = 0;
    for (size_t i = 0; i < scene->instance_count; i++)
        triangles += scene->meshes[scene->instances[i].mesh].index_count / 3.0;
    return triangles * largest > (double)context->view.width * context->view.height ||
           is_displaced(draws);
}

static bool holds_any(const filter_context *context, const draw_list *draws) {
    for (uint32_t i = 0; i < draws->batch_count; i++)
        if (passes_surfaces_hold(context, &draws->batches[i]))
            return true;
    return false;
}

/// Whether what is drawn decides.
static bool may_be_worth_it(const filter_context *context) {
    return context->device->type == LOBE_DEVICE_CPU && fits(context);
}

bool passes_shading_is_open(const filter_context *context) {
    return context->work && context->work->is_dry && may_be_worth_it(context) &&
           passes_knob_choice(context, &passes_knob_shading) == AUTOMATIC;
}

static bool is_worth_it(const filter_context *context, const draw_list *draws) {
    return may_be_worth_it(context) && has_small_triangles(context, draws);
}

static bool is_chosen(const filter_context *context, const draw_list *draws) {
    const uint32_t choice = passes_knob_choice(context, &passes_knob_shading);
    if (choice == AUTOMATIC)
        return passes_shading_is_open(context) || is_worth_it(context, draws);
    return choice == DEFERRED;
}

bool passes_defers_shading(const filter_context *context, const draw_list *draws) {
    return is_chosen(context, draws) && holds_any(context, draws) &&
           context->device->maximum_colour_outputs >= SURFACES_LAYERS;
}
