#ifndef SCENES_MATERIAL_FILE_NAME_H
#define SCENES_MATERIAL_FILE_NAME_H

#include <stdbool.h>

/// The contents of a material's image files, according to their names.
typedef enum material_map {
    MATERIAL_MAP_ALBEDO,
    MATERIAL_MAP_NORMAL,         ///< +Y: OpenGL, or not stated
    MATERIAL_MAP_NORMAL_DIRECTX, ///< -Y
    MATERIAL_MAP_ROUGHNESS,
    MATERIAL_MAP_METALLIC,
    MATERIAL_MAP_METALLIC_ROUGHNESS,           ///< green: roughness, blue: metallic
    MATERIAL_MAP_OCCLUSION_ROUGHNESS_METALLIC, ///< red: occlusion; green, blue as above
    MATERIAL_MAP_OCCLUSION,
    MATERIAL_MAP_EMISSIVE,
    MATERIAL_MAP_DISPLACEMENT,
    MATERIAL_MAP_COUNT ///< none of these
} material_map;

/// Recognises a map by the last word of its file name that names one, in upper or lower case. Words
/// end at punctuation and before a capital that follows a small letter. "rusty_metal_col_1_1k.jpg"
/// and "RustyMetal-BaseColor.png" are albedo, "nor_dx_1k.png" and "NormalDX.png" are DirectX
/// normals. The extension does not matter.
material_map scenes_material_file_map(const char *name);

/// Whether the extension is that of PNG or JPEG.
bool scenes_material_file_is_readable(const char *name);

/// Whether the extension is of an image format that lobe does not read.
bool scenes_material_file_is_other_image(const char *name);

#endif
