#include "passes/filters/wu/build.h"

/// The light of a level's lobes where the coarse relief sees it, as that of paths.
static lobe_resource add_low_light(const wu_build *build, uint32_t level) {
    const struct wu_constants *constants = &build->models.constants;
    const uint32_t row = passes_wu_row(build), samples = passes_wu_path_count(build) * WU_DRAWS;
    lobe_pass *pass = passes_wu_pass(build, "low_light");
    lobe_pass_read(pass, &(lobe_binding){.name = "cell_block", .resource = build->models.cells});
    const uint64_t bytes = (uint64_t)row * samples * sizeof(float);
    const bool one_way = (constants->printed & WU_PRINTED_LOBES) != 0;
    const lobe_resource first = lobe_pass_write(
        pass, &(lobe_binding){.name = "first_block",
                              .resource = passes_wu_buffer(build, "light of lobes", bytes)});
    const lobe_resource second = lobe_pass_write(
        pass, &(lobe_binding){.name = "second_block",
                              .resource = passes_wu_buffer(build, "lobes that are seen",
                                                           one_way ? bytes : sizeof(float))});
    passes_wu_dispatch(build, pass, "filters/wu/low_light.comp", (uint32_t[]){row, samples},
                       &(struct wu_step){.level = level});
    return passes_wu_add_pairs(
        build, passes_wu_buffer(build, "light of cells", passes_wu_pair_bytes(build)),
        &(wu_samples){.left = first,
                      .right = one_way ? second : first,
                      .count = constants->points * WU_DRAWS,
                      .one_way = one_way});
}

/// What cells get from one direction times what they get from another.
static lobe_resource add_cell_light(const wu_build *build, uint32_t level) {
    const uint32_t threads = passes_wu_path_count(build) * passes_wu_row(build);
    lobe_pass *pass = passes_wu_pass(build, "cell_light");
    lobe_pass_read(pass, &(lobe_binding){.name = "cell_block", .resource = build->models.cells});
    const lobe_resource light = lobe_pass_write(
        pass, &(lobe_binding){.name = "light_block",
                              .resource = passes_wu_buffer(build, "light that cells get",
                                                           (uint64_t)threads * sizeof(float))});
    passes_wu_dispatch(build, pass, "filters/wu/cell_light.comp", (uint32_t[]){threads, 1},
                       &(struct wu_step){.level = level});
    return passes_wu_add_pairs(
        build,
        passes_wu_buffer(build, "light between facets of cells", passes_wu_pair_bytes(build)),
        &(wu_samples){.left = light, .right = light, .count = build->models.constants.points});
}

/// Of cells: light at once, and what light between facets is scaled from.
typedef struct low_pairs {
    lobe_resource direct, indirect;
} low_pairs;

static void read_light(const wu_build *build, lobe_pass *pass, low_pairs low) {
    lobe_pass_read(pass, &(lobe_binding){.name = "direct_block", .resource = build->direct});
    lobe_pass_read(pass, &(lobe_binding){.name = "indirect_block", .resource = build->indirect});
    lobe_pass_read(pass, &(lobe_binding){.name = "low_pair_block", .resource = low.direct});
    lobe_pass_read(pass, &(lobe_binding){.name = "cell_pair_block", .resource = low.indirect});
}

static lobe_resource add_patches(wu_build *build, uint32_t level, low_pairs low) {
    const uint32_t patches = build->models.constants.patches * build->models.constants.patches;
    lobe_pass *pass = passes_wu_pass(build, "scaling_patches");
    read_light(build, pass, low);
    lobe_pass_read(pass, &(lobe_binding){.name = "ratio_block", .resource = build->models.ratios});
    const lobe_resource quotients = lobe_pass_write(
        pass, &(lobe_binding){.name = "patch_block",
                              .resource = passes_wu_buffer(build, "scaling of patches",
                                                           patches * 8 * sizeof(float))});
    // Groups of 128 threads.
    passes_wu_dispatch(build, pass, "filters/wu/scaling_patches.comp",
                       (uint32_t[]){patches * 128, 1}, &(struct wu_step){.level = level});
    return quotients;
}

void passes_wu_add_scaling(wu_build *build, uint32_t level) {
    const struct wu_level *cells = &build->models.constants.levels[level];
    const low_pairs low = {add_low_light(build, level), add_cell_light(build, level)};
    lobe_pass *pass = passes_wu_pass(build, "scaling_table");
    read_light(build, pass, low);
    const lobe_binding ratios = {.name = "ratio_block", .resource = build->models.ratios};
    build->models.ratios =
        level == 0 ? lobe_pass_write(pass, &ratios) : lobe_pass_modify(pass, &ratios);
    passes_wu_dispatch(build, pass, "filters/wu/scaling_table.comp", (uint32_t[]){1, 1},
                       &(struct wu_step){.level = level});
    const lobe_resource quotients = add_patches(build, level, low);
    pass = passes_wu_pass(build, "scaling_cells");
    lobe_pass_read(pass, &(lobe_binding){.name = "patch_block", .resource = quotients});
    build->models.cells = lobe_pass_modify(
        pass, &(lobe_binding){.name = "cell_block", .resource = build->models.cells});
    passes_wu_dispatch(build, pass, "filters/wu/scaling_cells.comp",
                       (uint32_t[]){cells->width * cells->height, 1},
                       &(struct wu_step){.level = level});
}
