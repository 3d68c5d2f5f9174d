#include "passes/filters/mixture/mixture_map.h"

#include <stdio.h>

#include "passes/context/material_specialisation.h"
#include "passes/filters/mixture/samples.h"
#include "passes/maps/moment_map.h"
#include "passes/upload/material_maps.h"
#include "shaders/interface/gaussian_mixture.h"
#include "shaders/interface/moment_bins.h"

/// What all passes of a map share.
typedef struct mixture_build {
    lobe_graph *graph;
    const device_material *material;
    uint32_t index; ///< of the material
    const mixture_kind *kind;
    lobe_grid grid;
    bool in_parts; ///< what later parts need is kept between frames
    mixture_samples samples;
    moment_map target;
    lobe_resource components; ///< of the level before
    /// Texels of the maps along a side of a level's texel, above which a group fits each texel to a
    /// sample; and those of the parts whose sums are gathered then.
    uint32_t largest_box;
} mixture_build;

/// How often a thread goes through its texel's lobes to start from them.
static uint32_t rounds_of_start(const mixture_kind *kind) {
    return kind->components + MIXTURE_ROUNDS_OF_K_MEANS;
}

/// The same for components of the texel's own beside those from its parent's, with the errors of
/// both.
static uint32_t rounds_of_own(const mixture_kind *kind) {
    return kind->own_steps > 0 ? rounds_of_start(kind) + kind->own_steps + 2 : 0;
}

/// lavapipe leaves all loops of a thread when it has gone through them 65535 times in all.
static uint32_t find_largest_box(const device_material *material, const mixture_kind *kind) {
    enum { ITERATIONS = 60000 };
    const uint32_t start =
        kind->start == MIXTURE_START_K_MEANS ? rounds_of_start(kind) : rounds_of_own(kind);
    const uint32_t each = (start + kind->steps + 1) * (material->lobe_count + 1);
    uint32_t box = 64;
    while ((box + 2) * (box + 2) * each > ITERATIONS)
        box /= 2;
    return box;
}

static uint32_t level_extent(uint32_t extent, uint32_t level) {
    return extent >> level > 0 ? extent >> level : 1;
}

/// Of the texels of a level, along the longer side.
static uint32_t box_side(const lobe_grid *grid, uint32_t level) {
    const uint32_t x = grid->width / level_extent(passes_half_extent(grid->width), level);
    const uint32_t y = grid->height / level_extent(passes_half_extent(grid->height), level);
    return x > y ? x : y;
}

/// Components of a level's texels: of the root, or of level `level`.
static lobe_resource declare_components(const mixture_build *build, uint32_t width, uint32_t height,
                                        uint32_t level) {
    char name[64];
    snprintf(name, sizeof name, "components %u of material %u", level, build->index);
    return lobe_graph_image(build->graph, &(lobe_image_description){
                                              .name = name,
                                              .format = LOBE_FORMAT_RGBA32_FLOAT,
                                              .width = width,
                                              .height = height,
                                              .layers = 2 * build->kind->components,
                                              .retained = build->in_parts,
                                          });
}

/// Of texels, which the frame's next pass needs, or nobody.
static lobe_resource declare_passing_components(const mixture_build *build, uint32_t width,
                                                uint32_t height) {
    return lobe_graph_image(build->graph, &(lobe_image_description){
                                              .name = "passing components",
                                              .format = LOBE_FORMAT_RGBA32_FLOAT,
                                              .width = width,
                                              .height = height,
                                              .layers = 2 * build->kind->components,
                                          });
}

static lobe_pass *add_pass(const mixture_build *build, const char *name) {
    lobe_pass *pass = lobe_graph_add_pass(build->graph, LOBE_PASS_COMPUTE, name);
    lobe_pass_read(pass, &(lobe_binding){.name = "sample_map", .resource = build->samples.lobes});
    return pass;
}

/// Where nothing reads yet what a pass writes.
static void keep(const mixture_build *build, lobe_pass *pass) {
    if (build->in_parts)
        lobe_pass_keep(pass);
}

static void read_parents(const mixture_build *build, lobe_pass *pass) {
    lobe_pass_read(pass, &(lobe_binding){.name = "parent_map", .resource = build->components});
    lobe_pass_read(pass, &(lobe_binding){.name = "binning_block", .resource = build->target.bins});
}

static lobe_resource write_components(lobe_pass *pass, lobe_resource components) {
    return lobe_pass_write(pass, &(lobe_binding){.name = "component_map", .resource = components});
}

/// Of the rows from `first_row` on.
static void dispatch_rows(const mixture_build *build, const char *shader, uint32_t columns,
                          uint32_t first_row, uint32_t rows, uint32_t steps, uint32_t own_steps,
                          lobe_pass *pass) {
    const device_material *material = build->material;
    specialisation_list list = {.graph = build->graph};
    passes_specialise(&list, SPECIALISE_LOBE_COUNT, material->lobe_count);
    passes_specialise(&list, SPECIALISE_BINS, build->kind->components);
    passes_specialise(&list, SPECIALISE_BIN_COLOUR, build->kind->own_colours);
    passes_specialise(&list, SPECIALISE_BIN_WIDTHS, passes_bin_widths_vary(material));
    passes_specialise(&list, SPECIALISE_MASKED_LOBES, passes_lobes_are_masked(material));
    passes_specialise(&list, SPECIALISE_MIXTURE_SHAPE, build->kind->shape);
    passes_specialise(&list, SPECIALISE_MIXTURE_PLANE, build->kind->plane);
    passes_specialise(&list, SPECIALISE_MIXTURE_START, build->kind->start);
    passes_specialise(&list, SPECIALISE_MIXTURE_PRINTED, build->kind->is_printed);
    const struct mixture_fit_constants constants = {build->samples.width,
                                                    build->samples.height,
                                                    steps,
                                                    build->kind->prior,
                                                    first_row,
                                                    own_steps,
                                                    build->kind->least_gain};
    lobe_pass_dispatch(pass, &(lobe_dispatch){
                                 .shader = shader,
                                 .threads = {columns, rows, 1},
                                 .constants = &constants,
                                 .constants_size = sizeof constants,
                                 .specialisation = list.items,
                                 .specialisation_count = list.count,
                             });
}

static void dispatch(const mixture_build *build, const char *shader, uint32_t columns,
                     uint32_t rows, uint32_t steps, lobe_pass *pass) {
    dispatch_rows(build, shader, columns, 0, rows, steps, 0, pass);
}

static void add_root(mixture_build *build) {
    char name[64];
    snprintf(name, sizeof name, "units of material %u", build->index);
    lobe_resource bins = lobe_graph_buffer(
        build->graph, &(lobe_buffer_description){.name = name,
                                                 .size = sizeof(struct moment_binning_constants),
                                                 .retained = true});
    lobe_pass *pass = add_pass(build, "mixture_root");
    lobe_pass_read(pass,
                   &(lobe_binding){.name = "extremes_block", .resource = build->samples.extremes});
    build->components =
        write_components(pass, declare_components(build, 1, 1, build->target.map.levels));
    build->target.bins =
        lobe_pass_write(pass, &(lobe_binding){.name = "binning_block", .resource = bins});
    dispatch(build, "filters/mixture/root.comp", 1, 1, 0, pass);
    keep(build, pass);
}

/// Components that a search finds for a texel are less like its neighbours' than its parent's are:
/// only at the level whose texels are quarters of the map.
static bool is_searched(const mixture_kind *kind, uint32_t width, uint32_t height) {
    return kind->start != MIXTURE_START_K_MEANS && !kind->is_printed &&
           (width > height ? width : height) == 2;
}

static lobe_pass *add_group_pass(mixture_build *build, const char *name, const char *shader,
                                 lobe_resource components, uint32_t width, uint32_t height) {
    enum { THREADS = 64 };
    lobe_pass *pass = add_pass(build, name);
    read_parents(build, pass);
    build->components = write_components(pass, components);
    dispatch(build, shader, THREADS * width, height, build->kind->steps, pass);
    return pass;
}

/// From the components of the level before to those of a level with few texels, by a group for each
/// texel.
static void add_fit(mixture_build *build, uint32_t level, uint32_t width, uint32_t height) {
    const bool searched = is_searched(build->kind, width, height);
    lobe_pass *pass = add_group_pass(build, "mixture_fit", "filters/mixture/fit.comp",
                                     searched ? declare_passing_components(build, width, height)
                                              : declare_components(build, width, height, level),
                                     width, height);
    if (searched)
        pass = add_group_pass(build, "mixture_search", "filters/mixture/search.comp",
                              declare_components(build, width, height, level), width, height);
    keep(build, pass);
}

static lobe_binding target_level(const mixture_build *build, uint32_t level) {
    return (lobe_binding){"moment_map", build->target.map.resource,
                          .range = {level, 1, 0, build->target.map.layers}};
}

static lobe_resource declare_sums_of_parts(const mixture_build *build, uint32_t columns,
                                           uint32_t rows) {
    return lobe_graph_image(build->graph, &(lobe_image_description){
                                              .name = "sums of parts",
                                              .format = LOBE_FORMAT_RGBA32_FLOAT,
                                              .width = columns,
                                              .height = rows,
                                              .layers = build->target.map.layers,
                                          });
}

/// Sums for the level's components, over parts of its texels.
static lobe_resource add_sums_of_parts(const mixture_build *build, uint32_t columns,
                                       uint32_t rows) {
    lobe_pass *pass = add_pass(build, "mixture_level");
    read_parents(build, pass);
    (void)write_components(pass, declare_passing_components(build, 1, 1));
    const lobe_resource sums = lobe_pass_write(
        pass, &(lobe_binding){.name = "moment_map",
                              .resource = declare_sums_of_parts(build, columns, rows)});
    dispatch(build, "filters/mixture/level.comp", columns, rows, 0, pass);
    return sums;
}

/// Sums over parts of a level's texels, and the level from these.
static void add_gathered_level(mixture_build *build, uint32_t level) {
    const reduced_map *map = &build->target.map;
    const uint32_t width = level_extent(map->width, level);
    const uint32_t height = level_extent(map->height, level);
    add_fit(build, level, width, height);
    const uint32_t box = build->largest_box;
    const uint32_t columns = (build->samples.width + box - 1) / box;
    const uint32_t rows = (build->samples.height + box - 1) / box;
    const lobe_resource sums = add_sums_of_parts(build, columns, rows);
    lobe_pass *pass = lobe_graph_add_pass(build->graph, LOBE_PASS_COMPUTE, "mixture_gather");
    lobe_pass_read(pass, &(lobe_binding){.name = "part_map", .resource = sums});
    const lobe_binding target = target_level(build, level);
    build->target.map.resource = lobe_pass_write(pass, &target);
    lobe_pass_dispatch(pass, &(lobe_dispatch){.shader = "filters/mixture/gather.comp",
                                              .threads = {width, height, map->layers}});
    keep(build, pass);
}

/// At the finest level the parent's components share out what lies under a texel as well as ones
/// fitted to its few lobes. What is printed are the components.
static uint32_t steps_of_level(const mixture_kind *kind, uint32_t level) {
    return level > 0 || kind->is_printed ? kind->steps : 0;
}

/// Bands of a level's rows, so that each takes about a quarter of a second of lavapipe's time at
/// most.
typedef struct level_bands {
    uint32_t count;
    uint32_t rows; ///< of each but the last, a multiple of a group's
} level_bands;

static level_bands bands_of_level(const mixture_kind *kind, uint32_t lobe_count,
                                  const lobe_grid *grid, uint32_t level) {
    enum { GROUP_ROWS = 8 };
    const uint64_t visits = (uint64_t)grid->width * grid->height * lobe_count *
                            (steps_of_level(kind, level) + 1 + rounds_of_own(kind));
    const uint64_t most = (uint64_t)1 << 23;
    const uint32_t groups =
        (level_extent(passes_half_extent(grid->height), level) + GROUP_ROWS - 1) / GROUP_ROWS;
    const uint64_t wanted = (visits + most - 1) / most;
    const uint32_t count = wanted < groups ? (uint32_t)wanted : groups;
    const uint32_t groups_of_band = (groups + count - 1) / count;
    return (level_bands){(groups + groups_of_band - 1) / groups_of_band,
                         GROUP_ROWS * groups_of_band};
}

static lobe_resource bind_band(lobe_pass *pass, const lobe_binding *binding, uint32_t band) {
    return band == 0 ? lobe_pass_write(pass, binding) : lobe_pass_modify(pass, binding);
}

static lobe_pass *add_band(mixture_build *build, uint32_t level, uint32_t band, uint32_t rows,
                           lobe_resource *components) {
    const reduced_map *map = &build->target.map;
    const uint32_t width = level_extent(map->width, level);
    const uint32_t height = level_extent(map->height, level);
    lobe_pass *pass = add_pass(build, "mixture_level");
    read_parents(build, pass);
    *components =
        bind_band(pass, &(lobe_binding){.name = "component_map", .resource = *components}, band);
    const lobe_binding target = target_level(build, level);
    build->target.map.resource = bind_band(pass, &target, band);
    const uint32_t first = band * rows;
    dispatch_rows(build, "filters/mixture/level.comp", width, first,
                  height - first < rows ? height - first : rows, steps_of_level(build->kind, level),
                  build->kind->own_steps, pass);
    return pass;
}

/// Adds up to `most` bands of a level, and returns their number. Nothing needs the components of
/// the finest level. Only the last band is kept: it needs those before it, whose own results are no
/// longer there once it has run.
static uint32_t add_own_level(mixture_build *build, uint32_t level, uint32_t most) {
    const reduced_map *map = &build->target.map;
    const level_bands bands =
        bands_of_level(build->kind, build->material->lobe_count, &build->grid, level);
    lobe_resource components =
        declare_components(build, level > 0 ? level_extent(map->width, level) : 1,
                           level > 0 ? level_extent(map->height, level) : 1, level);
    const uint32_t count = bands.count < most ? bands.count : most;
    lobe_pass *last = NULL;
    for (uint32_t band = 0; band < count; band++)
        last = add_band(build, level, band, bands.rows, &components);
    keep(build, last);
    build->components = components;
    return count;
}

/// Of a level whose texels a group fits, nothing is left out.
static bool is_gathered(uint32_t largest_box, const lobe_grid *grid, uint32_t level) {
    return box_side(grid, level) > largest_box;
}

/// Returns the number of parts that were added.
static uint32_t add_level(mixture_build *build, uint32_t level, uint32_t most) {
    if (!is_gathered(build->largest_box, &build->grid, level))
        return add_own_level(build, level, most);
    add_gathered_level(build, level);
    return 1;
}

static uint32_t layer_count(const device_material *material, const mixture_kind *kind) {
    if (kind->plane == MIXTURE_PLANE_PROJECTED)
        return kind->components;
    return passes_bin_layers(material, kind->components, kind->own_colours);
}

kept_image passes_mixture_extent(const device_material *material, const mixture_kind *kind) {
    const lobe_grid grid = passes_lobe_grid(material);
    kept_image extent = {.format = kind->format,
                         .width = passes_half_extent(grid.width),
                         .height = passes_half_extent(grid.height),
                         .layers = layer_count(material, kind)};
    extent.levels = passes_level_count(extent.width, extent.height);
    return extent;
}

moment_map passes_mixture_map_declare(const filter_context *context, uint32_t index,
                                      const mixture_kind *kind) {
    const device_material *material = &context->scene->materials[index];
    const lobe_grid grid = passes_lobe_grid(material);
    char name[64];
    snprintf(name, sizeof name, "mixtures of material %u", index);
    return (moment_map){.format = kind->format,
                        .map = passes_reduced_map_declare(context->graph, name, kind->format,
                                                          grid.width, grid.height,
                                                          layer_count(material, kind), true)};
}

uint32_t passes_mixture_part_count(const device_material *material, const mixture_kind *kind) {
    const lobe_grid grid = passes_lobe_grid(material);
    const uint32_t largest_box = find_largest_box(material, kind);
    const uint32_t levels =
        passes_level_count(passes_half_extent(grid.width), passes_half_extent(grid.height));
    uint32_t count = 1;
    for (uint32_t level = 0; level < levels; level++)
        count += is_gathered(largest_box, &grid, level)
                     ? 1
                     : bands_of_level(kind, material->lobe_count, &grid, level).count;
    return count;
}

static moment_map add_parts(const filter_context *context, uint32_t index, const mixture_kind *kind,
                            uint32_t parts, bool in_parts) {
    const device_material *material = &context->scene->materials[index];
    mixture_build build = {
        .graph = context->graph,
        .material = material,
        .index = index,
        .kind = kind,
        .grid = passes_lobe_grid(material),
        .in_parts = in_parts,
        .largest_box = find_largest_box(material, kind),
        .samples = passes_mixture_samples(context, index, kind->plane, kind->own_colours, in_parts),
        .target = passes_mixture_map_declare(context, index, kind)};
    if (parts > 0) {
        add_root(&build);
        parts--;
    }
    for (uint32_t level = build.target.map.levels; parts > 0 && level-- > 0;)
        parts -= add_level(&build, level, parts);
    return build.target;
}

moment_map passes_mixture_map_parts(const filter_context *context, uint32_t index,
                                    const mixture_kind *kind, uint32_t parts) {
    return add_parts(context, index, kind, parts, true);
}

moment_map passes_mixture_map(const filter_context *context, uint32_t index,
                              const mixture_kind *kind) {
    return add_parts(context, index, kind,
                     passes_mixture_part_count(&context->scene->materials[index], kind), false);
}
