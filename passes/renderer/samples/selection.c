#include "passes/renderer/samples/selection.h"

void passes_selection_count(const shading_selection *selection, size_t number, lobe_draw *draw) {
    if (!selection)
        return;
    draw->indirect = selection->arguments;
    draw->indirect_offset = (selection->first_argument + number) * sizeof(lobe_draw_arguments);
}

void passes_selection_mask(lobe_pass *pass, const shading_selection *selection,
                           const char *shader) {
    const bool occluded = selection->occluder.version != 0;
    const lobe_binding bindings[] = {
        {.name = "counts", .resource = selection->counts},
        {.name = "occluder", .resource = occluded ? selection->occluder : selection->counts}};
    const uint32_t constants = occluded;
    lobe_draw draw = {
        .vertex_shader = "shading/background.vert",
        .fragment_shader = shader,
        .index_count = 3,
        .depth_write = true,
        .constants = &constants,
        .constants_size = sizeof constants,
        .bindings = bindings,
        .binding_count = 2,
    };
    passes_selection_count(selection, MASK_DRAW, &draw);
    lobe_pass_draw(pass, &draw);
}
