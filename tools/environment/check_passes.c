#include "tools/environment/check_passes.h"

#include <math.h>

#include "engine/shader/shaders.h"

extern const engine_shader_code environment_shaders[];
extern const size_t environment_shaders_count;

lobe_result environment_check_add_shaders(lobe_device *device) {
    return engine_shaders_add(device, environment_shaders, environment_shaders_count,
                              ENVIRONMENT_SHADERS);
}

void environment_check_directions(uint32_t count, float (*directions)[4]) {
    const double golden_ratio = (1 + sqrt(5)) / 2;
    for (uint32_t i = 0; i < count; i++) {
        double height = 1 - (2.0 * i + 1) / count;
        double radius = sqrt(1 - height * height);
        double longitude = 2 * M_PI * fmod(i / golden_ratio, 1);
        directions[i][0] = (float)(radius * cos(longitude));
        directions[i][1] = (float)height;
        directions[i][2] = (float)(radius * sin(longitude));
        directions[i][3] = 0;
    }
}

double environment_check_peak(double concentration) {
    return concentration / (-2 * M_PI * expm1(-2 * concentration));
}

static lobe_resource declare_lights(lobe_graph *graph, uint32_t count) {
    return lobe_graph_buffer(graph, &(lobe_buffer_description){
                                        .name = "lights", .size = (size_t)count * sizeof(float4)});
}

lobe_resource environment_check_look_up(lobe_graph *graph, const environment_maps *maps,
                                        const environment_check_request *request) {
    const lobe_sampler sampler = {LOBE_SAMPLE_LINEAR, LOBE_SAMPLE_LINEAR, LOBE_WRAP_CLAMP,
                                  LOBE_WRAP_CLAMP, 0};
    const lobe_specialisation method = {CHECK_METHOD, request->method};
    const lobe_resource filtered = maps->cubes[LOBE_ENVIRONMENT_VON_MISES_FISHER];
    const lobe_resource between = maps->cubes[LOBE_ENVIRONMENT_BETWEEN];
    const struct environment_check_constants constants = {
        .concentration = (float)request->concentration,
        .count = request->count,
        .samples = request->samples,
    };
    lobe_resource lights = declare_lights(graph, request->count * request->rounds);
    lobe_pass *pass = lobe_graph_add_pass(graph, LOBE_PASS_COMPUTE, "environment_check");
    lobe_pass_read(pass, &(lobe_binding){.name = "radiance",
                                         .resource = maps->cubes[LOBE_ENVIRONMENT_RADIANCE],
                                         .sampler = sampler});
    lobe_pass_read(pass,
                   &(lobe_binding){.name = "filtered", .resource = filtered, .sampler = sampler});
    lobe_pass_read(
        pass, &(lobe_binding){.name = "between",
                              .resource = request->method == METHOD_BLENDED ? between : filtered,
                              .sampler = sampler});
    lobe_pass_read(pass,
                   &(lobe_binding){.name = "directions_block", .resource = request->directions});
    lights = lobe_pass_write(pass, &(lobe_binding){.name = "lights_block", .resource = lights});
    lobe_pass_dispatch(pass, &(lobe_dispatch){.shader = "check.comp",
                                              .threads = {request->count, request->rounds, 1},
                                              .constants = &constants,
                                              .constants_size = sizeof constants,
                                              .specialisation = &method,
                                              .specialisation_count = 1});
    return lights;
}

lobe_resource environment_check_exact(lobe_graph *graph, const environment_maps *maps,
                                      const environment_check_request *request,
                                      const double concentrations[CHECK_LOBES],
                                      uint32_t first_texel, uint32_t texel_count) {
    struct environment_check_exact_constants constants = {
        .count = request->count, .first_texel = first_texel, .texel_count = texel_count};
    for (int lobe = 0; lobe < CHECK_LOBES; lobe++)
        constants.concentrations[lobe] = (float)concentrations[lobe];
    lobe_resource sums = declare_lights(graph, request->count * CHECK_LOBES);
    lobe_pass *pass = lobe_graph_add_pass(graph, LOBE_PASS_COMPUTE, "environment_check_exact");
    lobe_pass_read(pass, &(lobe_binding){.name = "radiance",
                                         .resource = maps->cubes[LOBE_ENVIRONMENT_RADIANCE],
                                         .range = {0, 1, 0, 6}});
    lobe_pass_read(pass,
                   &(lobe_binding){.name = "directions_block", .resource = request->directions});
    sums = lobe_pass_write(pass, &(lobe_binding){.name = "sums_block", .resource = sums});
    lobe_pass_dispatch(pass, &(lobe_dispatch){.shader = "check_exact.comp",
                                              .threads = {request->count},
                                              .constants = &constants,
                                              .constants_size = sizeof constants});
    return sums;
}
