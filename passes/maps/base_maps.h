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
/// The same. `many_points`: of each texel, as where a mask cuts it.
void passes_base_maps_specialise_points(const device_material *material, bool many_points,
                                        specialisation_list *list);

/// The base colour map, if the shader `reads` colours or the material's lobes are masked; else
/// white: it then depends on no such map.
void passes_base_colour_read(const filter_context *context, const device_material *material,
                             bool reads, lobe_pass *pass);
/// The same, and the specular map, or white unless the shader reads colours.
void passes_colour_maps_read(const filter_context *context, const device_material *material,
                             bool reads, lobe_pass *pass);

/// Whether normals or widths are interpolated between texels.
bool passes_base_maps_are_interpolated(const device_material *material);

/// For a shader that reads base colours at the points of texels of a grid: in squares, where the
/// map has the grid's texels (shaders/maps/colour_square.glsl). `interpolated`: what the shader has
/// for SPECIALISE_INTERPOLATED.
void passes_colour_square_specialise(const device_material *material,
                                     const struct lobe_grid_constants *grid, bool interpolated,
                                     specialisation_list *list);

/// Push constants of a pass over the material's grid of lobes, with its mask if these are masked.
struct lobe_grid_constants passes_lobe_grid_constants(const filter_context *context,
                                                      const device_material *material);

/// Adds to `pass` the dispatch that makes level 0 of `map` on a grid of `extent` texels, which are
/// its push constants, and then the reduction. `shaders`: for whole maps, and its variant
/// SEEN_TILES (passes/maps/seen_tiles.h).
void passes_grid_map_make(const filter_context *context, const struct lobe_grid_constants *extent,
                          const char *const shaders[2], const specialisation_list *list,
                          lobe_pass *pass, reduced_map *map);

/// A map whose level 0 one compute pass makes from the base maps. Its push constants are the grid's
/// (passes_lobe_grid_constants).
typedef struct lobe_map_kind {
    const char *content;     ///< what it holds; part of its name
    const char *pass;        ///< name of the pass
    const char *shader;      ///< of the pass
    const char *seen_shader; ///< its variant SEEN_TILES, see passes/maps/seen_tiles.h
    const char *binding;     ///< of the map, in that shader and in shading
    uint32_t layers;         ///< of the map
    uint32_t mask_layers;    ///< more of them, where lobes are masked
    bool reads_base_colour;  ///< its shader does, not only as a mask
    bool reads_factors;      ///< its shader reads those of colour and metal
    lobe_resource groups; ///< as in reduced_map, like the next; its first number is 0 without a map
    size_t groups_offset;
    /// Binds and specialises what the shader reads beside the base maps. NULL: nothing.
    void (*read_more)(const filter_context *context, const device_material *material,
                      lobe_pass *pass, specialisation_list *list);
} lobe_map_kind;

/// Adds the pass that makes the map, and the reduction. The material has a normal or a width map.
reduced_map passes_lobe_map(const filter_context *context, uint32_t material,
                            const lobe_map_kind *kind, lobe_format format);

#endif
