#include "passes/renderer/renderer.h"

#include <string.h>

#include "passes/context/given_content.h"
#include "passes/context/knob_values.h"
#include "passes/context/shared_knobs.h"
#include "passes/renderer/culling/culling.h"
#include "passes/renderer/deform.h"
#include "passes/renderer/shadows/shadow_maps.h"
#include "passes/renderer/tile_marking.h"

static bool has_own_maps(const filter_context *context, size_t instance) {
    const lobe_filter *filter = context->filter;
    return filter->for_each_instance && filter->for_each_instance(context, instance);
}

/// Adds the instances of a material to the list, with maps that they share where they can: those of
/// the first.
static void list_material(rendering *r, const device_material *material) {
    const device_scene *scene = r->context.scene;
    const filtered_appearance *shared = NULL;
    for (uint32_t next = material->first_instance; next > 0;
         next = scene->instances[next - 1].next_of_material) {
        const size_t instance = next - 1;
        if (scene->scene->instances[instance].hidden)
            continue;
        const bool own = has_own_maps(&r->context, instance);
        const filtered_appearance *appearance =
            own || !shared ? &r->renderer->appearances[instance] : shared;
        if (!own)
            shared = appearance;
        passes_draw_list_add(&r->renderer->draws, scene, instance, appearance, !own);
    }
}

void passes_instances_list(rendering *r) {
    const device_scene *scene = r->context.scene;
    draw_list *draws = &r->renderer->draws;
    passes_given_content_take(&r->context, r->renderer->give_content, r->renderer->giver);
    passes_deform(&r->context);
    passes_displacement(r->renderer->displacement, &r->context, r->renderer->scene,
                        r->context.device->type == LOBE_DEVICE_CPU);
    passes_draw_list_begin(draws, scene);
    for (size_t i = 0; i < scene->scene->material_count; i++)
        list_material(r, &scene->materials[i]);
    passes_draw_list_end(draws, &r->context);
    passes_culling(&r->context, draws);
}

/// Batches come in the order of the instances whose maps they share, which are the first of theirs.
static void build_batch(rendering *r, const instance_batch *batch, lobe_frame *frame) {
    filtered_appearance *own = &r->renderer->appearances[batch->instance];
    if (batch->appearance != own)
        return;
    passes_filter_slots_build(&r->renderer->slots, &r->context, batch->instance, own);
    frame->filtered_bytes += own->bytes;
    frame->base_texels += own->base_texels;
}

void passes_fits_save(rendering *r) {
    if (r->renderer->fits_are_read_back)
        passes_filter_slots_save(r->renderer->slots, r->renderer->graph,
                                 r->fits.saves ? r->fits.cache : NULL, r->context.host);
    r->renderer->fits_are_read_back = r->fits.reads_back = false;
}

void passes_instance_maps_build(rendering *r, shading_targets *targets, lobe_frame *frame) {
    const draw_list *draws = &r->renderer->draws;
    passes_tile_marking(r, targets);
    memset(r->images.resources, 0,
           passes_filtered_images_count(r->context.scene->scene) * sizeof *r->images.resources);
    r->images.bytes = 0;
    frame->filtered_bytes = frame->base_texels = 0;
    r->fits.parts_left = 0;
    r->fits.outcome = (fit_outcome){0};
    for (uint32_t i = 0; i < draws->batch_count; i++)
        build_batch(r, &draws->batches[i], frame);
    frame->filtered_bytes += r->images.bytes;
}

void passes_instance_maps_warn(const rendering *r) {
    const lobe_filter *filter = r->context.filter;
    if (r->renderer->reported_filter != filter)
        passes_filter_warn(filter, r->context.scene, &r->renderer->host);
    r->renderer->reported_filter = filter;
    const uint32_t choice = passes_knob_choice(&r->context, &passes_knob_shadows);
    if (choice != r->renderer->reported_shadows)
        passes_shadow_maps_warn(&r->context);
    r->renderer->reported_shadows = choice;
}
