#include "passes/maps/base_maps.h"

void passes_base_maps_read(const filter_context *context, const device_material *material,
                           bool colours, lobe_pass *pass) {
    static const char *const names[] = {[MAP_NORMAL] = "normal_map", [MAP_WIDTH] = "width_map"};
    for (uint32_t map = MAP_NORMAL; map <= MAP_WIDTH; ++map)
        lobe_pass_read(pass, &(lobe_binding){.name = names[map],
                                             .resource = passes_device_map_import(
                                                 context->graph, context->scene, material, map)});
    lobe_pass_read(pass, &(lobe_binding){.name = "material_block",
                                         .resource = lobe_graph_import_buffer(
                                             context->graph, colours ? material->constants
                                                                     : material->map_constants)});
}
