#include "passes/filters/wu/build.h"

/// What paths' starts see, and which of a level's coarse facets do.
static lobe_resource add_sights(const wu_build *build, uint32_t level) {
    const uint32_t threads = passes_wu_path_count(build) * passes_wu_row(build) / 4;
    lobe_pass *pass = passes_wu_pass(build, "low_visibility");
    lobe_pass_read(pass, &(lobe_binding){.name = "cell_block", .resource = build->models.cells});
    lobe_pass_read(pass, &(lobe_binding){.name = "first_block", .resource = build->first});
    const lobe_resource sights = lobe_pass_write(
        pass, &(lobe_binding){.name = "sight_block",
                              .resource = passes_wu_buffer(build, "sights",
                                                           (uint64_t)threads * sizeof(uint32_t))});
    passes_wu_dispatch(build, pass, "filters/wu/low_visibility.comp", (uint32_t[]){threads, 1},
                       &(struct wu_step){.level = level});
    return sights;
}

static lobe_resource add_pairs(const wu_build *build, uint32_t level) {
    const struct wu_constants *constants = &build->models.constants;
    const uint32_t directions = constants->angular * constants->angular;
    const uint32_t patches = constants->patches * constants->patches;
    const uint32_t pairs = patches * directions * directions, blocks = passes_wu_row(build) / 4;
    const lobe_resource sights = add_sights(build, level);
    lobe_pass *pass = passes_wu_pass(build, "mirror_pairs");
    lobe_pass_read(pass, &(lobe_binding){.name = "vertex_block", .resource = build->vertices});
    lobe_pass_read(pass, &(lobe_binding){.name = "sight_block", .resource = sights});
    const lobe_resource means = lobe_pass_write(
        pass, &(lobe_binding){.name = "mirror_pair_block",
                              .resource = passes_wu_buffer(build, "mirrored light",
                                                           (uint64_t)pairs * 2 * sizeof(float))});
    lobe_pass_dispatch(pass, &(lobe_dispatch){.shader = "filters/wu/mirror_pairs.comp",
                                              .threads = {patches * blocks * blocks}});
    return means;
}

void passes_wu_add_mirrors(wu_build *build, uint32_t level) {
    const lobe_resource pairs = add_pairs(build, level);
    lobe_pass *pass = passes_wu_pass(build, "mirror_scaling");
    lobe_pass_read(pass, &(lobe_binding){.name = "mirror_pair_block", .resource = pairs});
    build->models.whole = lobe_pass_modify(
        pass, &(lobe_binding){.name = "whole_block", .resource = build->models.whole});
    passes_wu_dispatch(build, pass, "filters/wu/mirror_scaling.comp", (uint32_t[]){1, 1},
                       &(struct wu_step){.level = level});
}
