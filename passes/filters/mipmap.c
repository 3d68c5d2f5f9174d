#include "passes/filtered_maps.h"
#include "passes/filters/filters.h"
#include "passes/parameter_averaging.h"
#include "shaders/interface/mixture.h"

static const lobe_knob *const knobs[] = {&knob_probes, &knob_bias, &knob_storage, NULL};

static void build(const filter_context *context, size_t instance, filtered_appearance *appearance) {
    uint32_t index = context->scene->instances[instance].material;
    const device_material *material = &context->scene->materials[index];
    uint32_t width, height;
    bool averaged = lobe_map_extent(material, &width, &height) && width * height > 1;
    uint32_t map = material->maps[MAP_NORMAL].use ? MAP_NORMAL : MAP_WIDTH;
    lobe_resource resource;
    if (averaged) {
        reduced_map reduced = parameter_averaging(context, index);
        resource = reduced.resource;
        appearance->bytes = reduced_map_bytes(&reduced, filtered_map_format(context));
        appearance->base_texels = (uint64_t)width * height;
    } else {
        resource = lobe_graph_import_texture(context->graph, context->scene->white);
    }
    appearance_bind(appearance, "parameter_map", resource, filtered_map_sampler(material, map));
    appearance_specialise(appearance, SPECIALISE_MIXTURE, averaged);
    filtered_maps_build(context, index, appearance);
}

const lobe_filter filter_mipmap = {
    .name = "mipmap",
    .summary = "normals and widths averaged like colours: fast, and wrong",
    .paper = "Xu et al. 2017, section 5.2 (naive MIP-mapping)",
    .shading = "mipmap",
    .knobs = knobs,
    .build = build,
};
