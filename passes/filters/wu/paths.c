#include "passes/filters/wu/build.h"

uint32_t passes_wu_row(const wu_build *build) {
    const uint32_t angular = build->models.constants.angular;
    return (angular * angular + 7) & ~7u;
}

static void add_vertices(wu_build *build) {
    const uint32_t paths = passes_wu_path_count(build);
    const uint64_t vertices = (uint64_t)paths * build->models.constants.bounces;
    lobe_pass *pass = passes_wu_pass(build, "path_vertices");
    passes_relief_read(&build->relief, pass);
    build->vertices = lobe_pass_write(
        pass, &(lobe_binding){.name = "vertex_block",
                              .resource = passes_wu_shared_buffer(build, "vertices of paths",
                                                                  vertices * 8 * sizeof(float))});
    lobe_pass_dispatch(
        pass, &(lobe_dispatch){.shader = "filters/wu/path_vertices.comp", .threads = {paths}});
}

/// What paths get from each direction.
typedef struct path_light {
    lobe_resource first, second, later;
} path_light;

static path_light add_light(const wu_build *build) {
    const uint32_t threads = passes_wu_path_count(build) * passes_wu_row(build);
    const uint64_t bytes = (uint64_t)threads * sizeof(float);
    lobe_pass *pass = passes_wu_pass(build, "path_light");
    passes_relief_read(&build->relief, pass);
    lobe_pass_read(pass, &(lobe_binding){.name = "vertex_block", .resource = build->vertices});
    path_light light;
    light.first = lobe_pass_write(
        pass, &(lobe_binding){.name = "first_block",
                              .resource = passes_wu_shared_buffer(build, "first light", bytes)});
    light.second = lobe_pass_write(
        pass, &(lobe_binding){.name = "second_block",
                              .resource = passes_wu_buffer(build, "second light", bytes)});
    light.later = lobe_pass_write(
        pass, &(lobe_binding){.name = "later_block",
                              .resource = passes_wu_buffer(build, "later light", bytes)});
    lobe_pass_dispatch(
        pass, &(lobe_dispatch){.shader = "filters/wu/path_light.comp", .threads = {threads}});
    return light;
}

static void add_energy(wu_build *build, const path_light *light) {
    lobe_pass *pass = passes_wu_pass(build, "path_energy");
    lobe_pass_read(pass, &(lobe_binding){.name = "vertex_block", .resource = build->vertices});
    lobe_pass_read(pass, &(lobe_binding){.name = "first_block", .resource = light->first});
    lobe_pass_read(pass, &(lobe_binding){.name = "second_block", .resource = light->second});
    build->models.whole = lobe_pass_write(
        pass, &(lobe_binding){.name = "whole_block", .resource = build->models.whole});
    lobe_pass_dispatch(pass, &(lobe_dispatch){.shader = "filters/wu/path_energy.comp"});
}

uint64_t passes_wu_pair_bytes(const wu_build *build) {
    const uint64_t patches = build->models.constants.patches,
                   angular = build->models.constants.angular;
    return patches * patches * angular * angular * angular * angular * sizeof(float);
}

lobe_resource passes_wu_add_pairs(const wu_build *build, lobe_resource means,
                                  const wu_samples *samples) {
    const uint32_t patches = build->models.constants.patches * build->models.constants.patches;
    const uint32_t blocks = passes_wu_row(build) / 8;
    lobe_pass *pass = passes_wu_pass(build, "pair_means");
    lobe_pass_read(pass, &(lobe_binding){.name = "left_block", .resource = samples->left});
    lobe_pass_read(pass, &(lobe_binding){.name = "right_block", .resource = samples->right});
    means = lobe_pass_write(pass, &(lobe_binding){.name = "pair_block", .resource = means});
    passes_wu_dispatch(build, pass, "filters/wu/pair_means.comp",
                       (uint32_t[]){patches * blocks * blocks, 1},
                       &(struct wu_step){.samples = samples->count,
                                         .one_way = samples->one_way,
                                         .alike = samples->left.index == samples->right.index});
    return means;
}

void passes_wu_add_paths(wu_build *build) {
    const uint32_t points = build->models.constants.points;
    const uint64_t bytes = passes_wu_pair_bytes(build);
    add_vertices(build);
    const path_light light = add_light(build);
    add_energy(build, &light);
    build->first = light.first;
    build->direct = passes_wu_add_pairs(
        build, passes_wu_shared_buffer(build, "light at once", bytes),
        &(wu_samples){.left = light.first, .right = light.first, .count = points});
    build->indirect = passes_wu_add_pairs(
        build, passes_wu_shared_buffer(build, "light between facets", bytes),
        &(wu_samples){.left = light.first, .right = light.later, .count = points});
}
