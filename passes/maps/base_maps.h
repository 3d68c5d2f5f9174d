#ifndef PASSES_MAPS_BASE_MAPS_H
#define PASSES_MAPS_BASE_MAPS_H

#include "passes/context/filter.h"
#include "passes/context/material_specialisation.h"
#include "passes/maps/level_reduction.h"
#include "shaders/interface/lobe_grid.h"

/// A material's own maps, for passes that build filtered maps from them.

/// Binds what shaders/maps/base_maps.glsl reads: a material's constants, normal and width map.
/// `colours`: the shader also reads the constants' colours and metal, and depends on them.
void passes_base_maps_read(const filter_context *context, const device_material *material,
                           bool colours, lobe_pass *pass);
/// Binds one map of a material with its sampler, as shading reads it.
void passes_base_map_read(const filter_context *context, const device_material *material,
                          uint32_t map, const char *name, lobe_pass *pass);
/// The constants of the material and of shaders/maps/base_maps.glsl.
void passes_base_maps_specialise(const device_material *material, specialisation_list *list);

/// The colour maps, or white where the shader's constants say that it reads none: it then depends
/// on no map of colours.
void passes_colour_maps_read(const filter_context *context, const device_material *material,
                             bool reads, lobe_pass *pass);

/// Adds to `pass` the dispatch that makes level 0 of `map` on a grid of `extent` texels, which are
/// its push constants, and then the reduction. `shaders`: for whole maps, and its variant
/// SEEN_TILES (passes/maps/seen_tiles.h).
void passes_grid_map_make(const filter_context *context, const struct lobe_grid_constants *extent,
                          const char *const shaders[2], const specialisation_list *list,
                          lobe_pass *pass, reduced_map *map);

/// A map whose level 0 one compute pass makes from the base maps. Its push constants are the grid's
/// width and height, and what of its alpha the material's mask keeps.
typedef struct lobe_map_kind {
    const char *content;     ///< what it holds; part of its name
    const char *pass;        ///< name of the pass
    const char *shader;      ///< of the pass
    const char *seen_shader; ///< its variant SEEN_TILES, see passes/maps/seen_tiles.h
    const char *binding;     ///< of the map, in that shader and in shading
    uint32_t layers;         ///< of the map
    bool masked;             ///< its shader reads the push constants of the mask
    /// Binds and specialises what the shader reads beside the base maps. NULL: nothing.
    void (*read_more)(const filter_context *context, const device_material *material,
                      lobe_pass *pass, specialisation_list *list);
} lobe_map_kind;

/// Adds the pass that makes the map, and the reduction. The material has a normal or a width map.
reduced_map passes_lobe_map(const filter_context *context, uint32_t material,
                            const lobe_map_kind *kind, lobe_format format);

#endif
