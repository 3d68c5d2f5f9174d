#ifndef PASSES_FILTERS_WU_BUILD_H
#define PASSES_FILTERS_WU_BUILD_H

#include "passes/filters/displaced/relief.h"
#include "shaders/interface/displacement/wu.h"

/// How models are made.
typedef struct wu_kind {
    uint32_t lobes;   ///< of a cell [1, WU_MAXIMUM_LOBES]
    uint32_t angular; ///< directions of a table: the square of this
    uint32_t patches; ///< of the map: the square of this
    uint32_t points;  ///< of the map at which paths start
    uint32_t bounces; ///< facets that a path meets, at most
    uint32_t printed; ///< WU_PRINTED_...
    bool mirrors;     ///< the facets have microfacets
} wu_kind;

/// The models of a material's relief, see shaders/interface/displacement/wu.h.
typedef struct wu_models {
    struct wu_constants constants;
    lobe_resource block; ///< of the constants
    lobe_resource cells;
    lobe_resource ratios;
    lobe_resource whole; ///< what is of the whole map
    uint64_t bytes;
} wu_models;

/// What the passes of the models share.
typedef struct wu_build {
    lobe_graph *graph;
    uint32_t material;
    bool in_parts; ///< what later parts need is kept between frames
    relief relief;
    wu_models models;
    lobe_specialisation lobes;
    lobe_resource vertices;         ///< of paths
    lobe_resource first;            ///< what their starts get from each direction
    lobe_resource direct, indirect; ///< of each patch and pair of directions: the relief's light
} wu_build;

/// The levels of a map: cells of 8, 16, 64, 256 ... texels, up to one cell.
void passes_wu_place_levels(uint32_t width, uint32_t height, const wu_kind *kind,
                            struct wu_constants *constants);

/// What the models take: cells, ratios, and what is of the whole map.
void passes_wu_model_bytes(const device_map *heights, const wu_kind *kind, uint32_t bytes[3]);

/// Declares the models of a material alone.
wu_models passes_wu_models_declare(const filter_context *context, uint32_t material,
                                   const wu_kind *kind);
/// Declares the relief and the models of a material, which the passes below make. `in_parts`: over
/// several frames.
wu_build passes_wu_begin(const filter_context *context, uint32_t material, const wu_kind *kind,
                         bool in_parts);

/// Adds a pass that reads the constants.
lobe_pass *passes_wu_pass(const wu_build *build, const char *name);
/// Adds a pass's only dispatch, of the shader of its name.
void passes_wu_dispatch(const wu_build *build, lobe_pass *pass, const char *shader,
                        const uint32_t threads[2], const struct wu_step *step);
lobe_resource passes_wu_buffer(const wu_build *build, const char *name, uint64_t bytes);
/// One that later parts of the work read, too.
lobe_resource passes_wu_shared_buffer(const wu_build *build, const char *name, uint64_t bytes);
uint32_t passes_wu_path_count(const wu_build *build);
/// Directions that are kept of each sample: those of the table, filled up to a multiple of eight.
uint32_t passes_wu_row(const wu_build *build);

/// The paths of light over the relief, and what they bring from each direction to each.
void passes_wu_add_paths(wu_build *build);
/// What samples of each patch get from a light's direction, times what they send to a viewer's.
typedef struct wu_samples {
    lobe_resource left, right;
    uint32_t count; ///< of each patch
    bool one_way;   ///< light and viewer may not change places
} wu_samples;

/// Means of the products, into `means`: see passes_wu_pair_bytes.
lobe_resource passes_wu_add_pairs(const wu_build *build, lobe_resource means,
                                  const wu_samples *samples);
/// Of a number for each patch and pair of directions.
uint64_t passes_wu_pair_bytes(const wu_build *build);

/// The coarse relief of a level.
relief passes_wu_add_low_relief(const wu_build *build, uint32_t level);
/// A level's cells: their lobes and horizons.
void passes_wu_add_cells(wu_build *build, uint32_t level, const relief *low);
/// S and T of a level.
void passes_wu_add_scaling(wu_build *build, uint32_t level);
/// The same of what microfacets mirror.
void passes_wu_add_mirrors(wu_build *build, uint32_t level);

#endif
