#include "passes/renderer/renderer.h"

#include <string.h>

#include "passes/context/given_content.h"
#include "passes/context/knob_values.h"
#include "passes/context/shared_knobs.h"
#include "passes/renderer/deform.h"
#include "passes/renderer/shadows/shadow_maps.h"
#include "passes/renderer/tile_marking.h"

static bool has_own_maps(const filter_context *context, size_t instance) {
    const lobe_filter *filter = context->filter;
    return filter->for_each_instance && filter->for_each_instance(context, instance);
}

static const filtered_appearance *build_counted(rendering *r, size_t instance, lobe_frame *frame) {
    filtered_appearance *appearance = &r->renderer->appearances[instance];
    passes_filter_slots_build(&r->renderer->slots, &r->context, instance, appearance);
    frame->filtered_bytes += appearance->bytes;
    frame->base_texels += appearance->base_texels;
    return appearance;
}

/// Adds the instances of a material to the list, with maps that they share where they can.
static void add_instances(rendering *r, const device_material *material, lobe_frame *frame) {
    const device_scene *scene = r->context.scene;
    const filtered_appearance *shared = NULL;
    for (uint32_t next = material->first_instance; next > 0;
         next = scene->instances[next - 1].next_of_material) {
        const size_t instance = next - 1;
        if (scene->scene->instances[instance].hidden)
            continue;
        const bool own = has_own_maps(&r->context, instance);
        const filtered_appearance *appearance = own ? NULL : shared;
        if (!appearance)
            appearance = build_counted(r, instance, frame);
        if (!own)
            shared = appearance;
        passes_draw_list_add(&r->renderer->draws, scene, instance, appearance, !own);
    }
}

void passes_fits_save(rendering *r) {
    if (r->renderer->fits_are_read_back)
        passes_filter_slots_save(r->renderer->slots, r->renderer->graph,
                                 r->fits.saves ? r->fits.cache : NULL, r->context.host);
    r->renderer->fits_are_read_back = r->fits.reads_back = false;
}

void passes_instance_maps_build(rendering *r, lobe_frame *frame) {
    const lobe_scene *scene = r->context.scene->scene;
    passes_given_content_take(&r->context, r->renderer->give_content, r->renderer->giver);
    passes_deform(&r->context);
    passes_displacement(r->renderer->displacement, &r->context, r->renderer->scene,
                        r->context.device->type == LOBE_DEVICE_CPU);
    passes_tile_marking(r);
    memset(r->images.resources, 0,
           passes_filtered_images_count(scene) * sizeof *r->images.resources);
    r->images.bytes = 0;
    frame->filtered_bytes = frame->base_texels = 0;
    r->fits.parts_left = 0;
    r->fits.outcome = (fit_outcome){0};
    passes_draw_list_begin(&r->renderer->draws, r->context.scene);
    for (size_t i = 0; i < scene->material_count; i++)
        add_instances(r, &r->context.scene->materials[i], frame);
    passes_draw_list_end(&r->renderer->draws, &r->context);
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
