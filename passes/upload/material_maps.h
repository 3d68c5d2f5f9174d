#ifndef PASSES_UPLOAD_MATERIAL_MAPS_H
#define PASSES_UPLOAD_MATERIAL_MAPS_H

#include "passes/upload/device_scene.h"

/// Whether a material takes its normals from its height map: it has one with a factor, whose texels
/// the host can read, and no normal map.
bool passes_has_height_normals(const lobe_scene *scene, const lobe_material *material);

/// How a material uses a map (MAP_...); NULL: it has none, or the scene does not need it.
const lobe_texture_use *passes_material_map_use(const lobe_scene *scene,
                                                const lobe_material *material, uint32_t map);

/// Bit MAP_...: the map is read by the second set of texture coordinates. Where both sets are
/// equal, all maps are read by the first.
uint32_t passes_second_coordinates(const device_material *material);

/// Whether heights lie on other texture coordinates than those that tangents follow: the normal
/// map's, without one the first set.
bool passes_heights_have_own_set(const device_material *material);

/// The texture of a material's map, or the texels that the host gives in this frame; one white
/// texel if it has no such map.
lobe_resource passes_device_map_import(lobe_graph *graph, const device_scene *scene,
                                       const device_material *material, uint32_t map);
/// Whether a map may make the specular colour differ from texel to texel.
bool passes_specular_colour_varies(const device_material *material);
/// How a map's texels are read, without interpolation between levels.
lobe_sampler passes_device_map_sampler(const device_material *material, uint32_t map);
/// Whether the material has the map, with more than one texel.
bool passes_device_map_has_texels(const device_map *map);
/// Whether it also reads it interpolated.
bool passes_device_map_is_interpolated(const device_material *material, uint32_t map);

/// The grid of texels that a material's lobes come from: its normal map and its width map, unless
/// that lies apart; the coarser one is read at the texels of the finer one.
typedef struct lobe_grid {
    /// The map whose texture coordinates and wrapping the grid has: the normal map, or the width
    /// map of a material without one.
    uint32_t map;
    const lobe_texture_use *use; ///< of that map; NULL: the material has neither
    uint32_t width, height;      ///< texels: the larger of these maps; 0: neither exists
} lobe_grid;

lobe_grid passes_lobe_grid(const device_material *material);
/// Whether lobes can differ from texel to texel, so that there is something to filter.
bool passes_lobe_grid_varies(const lobe_grid *grid);
/// Whether microfacets have widths that vary over the surface otherwise than their normals do, by
/// other texture coordinates. Maps of lobes then hold lobes of one width, and shading takes their
/// own from another map (passes/maps/colours/width_means.h).
bool passes_widths_lie_apart(const device_material *material);
/// The same, as it may be with other meshes.
bool passes_widths_may_lie_apart(const device_material *material);
/// Whether two maps that a material has are laid out on the surface alike, whatever their numbers
/// of texels: by one set of texture coordinates, or by two equal ones, with the same transform; and
/// wrapped alike, unless all meshes lie within both.
bool passes_maps_share_coordinates(const device_material *material, uint32_t a, uint32_t b);
/// Whether a map that a material has is laid out on the surface as its grid is.
bool passes_lobe_grid_shares_coordinates(const device_material *material, uint32_t map);
/// Whether the material has a mask that lies as the grid does: maps of lobes leave out what it cuts
/// away.
bool passes_lobes_are_masked(const device_material *material);
/// Whether in texels of the grid only a part of what their maps hold may be kept by such a mask.
bool passes_mask_cuts_texels(const device_material *material);
/// Whether a map of a material, if it has that, lies as the grid does, and is no finer.
bool passes_lies_under_lobes(const device_material *material, uint32_t map);
/// Whether all maps of specular colour do, so that lobes can have colours of their own.
bool passes_colours_lie_under_lobes(const device_material *material);

/// Reads a texel on the host as the device would, except that sRGB is not decoded: missing channels
/// are 0, alpha is 1. False for formats that no map of lobes has (half floats, sRGB, depth), and
/// for images without texels.
bool passes_image_texel(const lobe_image *image, uint32_t x, uint32_t y, float value[4]);

/// Red, read on the host as the device would: sRGB is decoded, and values outside [0, 1] count as
/// its ends. False for images without texels, half floats and depth, of which no host reads
/// heights.
bool passes_height_texel(const lobe_image *image, uint32_t x, uint32_t y, double *height);

/// Whether texels are normals as they are, not (n + 1) / 2, and whether z follows from x and y.
bool passes_normals_are_signed(lobe_normal_encoding encoding);
bool passes_normals_lack_z(lobe_normal_encoding encoding);

/// Filtered maps are made texel by texel, wherever the map lies on the surface: of the transforms
/// of texture coordinates only that matters which maps of lobes lie alike. Clears the rest of them,
/// except those of heights, whose widths say how steep they are.
void passes_map_places_forget(struct material_constants *constants);

#endif
