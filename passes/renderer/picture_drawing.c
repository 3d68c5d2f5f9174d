#include "passes/renderer/picture_drawing.h"

void passes_picture_drawing(lobe_graph *graph, const float *texels, shading_targets *targets) {
    const size_t size = (size_t)targets->width * targets->height * 4 * sizeof *texels;
    const lobe_binding picture = {.name = "picture_block",
                                  .resource = lobe_graph_upload(graph, "picture", texels, size)};
    lobe_pass *pass = lobe_graph_add_pass(graph, LOBE_PASS_RASTER, "picture_drawing");
    targets->radiance = lobe_pass_colour(
        pass, 0,
        &(lobe_attachment){.resource = targets->radiance,
                           .load = targets->keep_radiance ? LOBE_LOAD_KEEP : LOBE_LOAD_DISCARD});
    lobe_pass_draw(pass, &(lobe_draw){
                             .vertex_shader = "shading/background.vert",
                             .fragment_shader = "shading/picture_drawing.frag",
                             .index_count = 3,
                             .blend = targets->keep_radiance ? LOBE_BLEND_ALPHA : LOBE_BLEND_OFF,
                             .constants = &targets->width,
                             .constants_size = sizeof targets->width,
                             .bindings = &picture,
                             .binding_count = 1,
                         });
}
