#include "passes/renderer/surfaces/masks.h"

#include <string.h>

#include "passes/filters/material_shading.h"

static const device_material *material_of(const filter_context *context,
                                          const instance_batch *batch) {
    return &context->scene->materials[context->scene->instances[batch->instance].material];
}

/// What the filter bound to a name. Filters that do not filter masks bind nothing, and the shader
/// reads nothing.
static lobe_binding binding_of(const filtered_appearance *appearance, const char *name,
                               lobe_resource otherwise) {
    for (size_t i = 0; i < appearance->binding_count; i++)
        if (strcmp(appearance->bindings[i].name, name) == 0)
            return appearance->bindings[i];
    return (lobe_binding){.name = name, .resource = otherwise};
}

void passes_surface_mask_bind(const filter_context *context, const instance_batch *batch,
                              lobe_binding bindings[SURFACE_MASK_BINDINGS]) {
    lobe_graph *graph = context->graph;
    const device_material *material = material_of(context, batch);
    const lobe_resource white = lobe_graph_import_texture(graph, context->scene->white);
    const lobe_resource constants = lobe_graph_import_buffer(graph, material->constants);
    *bindings++ = (lobe_binding){.name = "material_block", .resource = constants};
    passes_material_maps_bind(context, material, bindings);
    bindings += MAP_SHADING;
    // Declared for pictures, and not read of triangles.
    *bindings++ = (lobe_binding){.name = "surfaces", .resource = white};
    *bindings++ = binding_of(batch->appearance, "base_colour_filtered", white);
    *bindings++ = binding_of(batch->appearance, "mask_layers", white);
    *bindings++ = binding_of(batch->appearance, "mask_block", constants);
}

void passes_surface_mask_specialise(const filter_context *context, const instance_batch *batch,
                                    specialisation_list *list) {
    passes_material_specialise(material_of(context, batch), list);
    for (size_t i = 0; i < batch->appearance->specialisation_count; i++)
        passes_specialise(list, batch->appearance->specialisation[i].id,
                          batch->appearance->specialisation[i].bits);
}
