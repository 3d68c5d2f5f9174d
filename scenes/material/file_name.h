#ifndef SCENES_MATERIAL_FILE_NAME_H
#define SCENES_MATERIAL_FILE_NAME_H

#include <stdbool.h>
#include <stddef.h>

#include "scenes/material/map_word.h"

/// Longer names, which common file systems do not allow, are not recognised.
enum { MATERIAL_NAME_LENGTH = 512, MATERIAL_NAME_WORDS = 64 };

/// A file name as lower-case words, without its extension. Words end at punctuation, before a
/// capital that follows a small letter, and between two words for maps that are written as one
/// ("metallicsmoothness"). Numbers and resolutions at the end of a word for a map are dropped
/// ("normal3", "albedo2k").
typedef struct material_name {
    char text[4 * MATERIAL_NAME_LENGTH];
    const char *words[MATERIAL_NAME_WORDS];
    bool joined[MATERIAL_NAME_WORDS]; ///< to the word before, without punctuation
    size_t count;
} material_name;

void scenes_material_name_split(const char *name, material_name *split);

/// What a name says about its file.
typedef struct material_file_content {
    /// What the whole file is; MATERIAL_MAP_COUNT: a packed file, or unknown.
    material_map map;
    /// Of a packed file, what its red, green, blue and alpha hold; else all MATERIAL_MAP_COUNT.
    material_map channels[4];
    /// What it holds of which lobe makes no use ("specular"); NULL: nothing like that.
    const char *unused;
    size_t first, end; ///< the words that say this; those before them name the material
} material_file_content;

/// Recognises a file by the last words of its name that name a map, not before word `first`.
/// "rusty_metal_col_1_1k.jpg" and "RustyMetal-BaseColor.png" are albedo, "nor_dx_1k.png" and
/// "NormalDX.png" DirectX normals, "wall_arm.png" and "wallOcclusionRoughnessMetallic.png" packed.
/// Follows the names that ambientCG, Poly Haven, Quixel, Poliigon, freepbr, Substance, Unity and
/// Unreal give their files.
material_file_content scenes_material_name_parse(const material_name *name, size_t first);

/// Whether a file is known to be a map, or a packed one.
bool scenes_material_file_is_map(const material_file_content *content);
bool scenes_material_file_is_packed(const material_file_content *content);
/// Whether a packed file has the channels that glTF defines: green roughness, blue metallic; and in
/// red, if anything, occlusion.
bool scenes_material_file_is_gltf(const material_file_content *content);

/// Whether the extension is that of PNG, JPEG or OpenEXR.
bool scenes_material_file_is_readable(const char *name);
bool scenes_material_file_is_exr(const char *name);

/// Whether the extension is of an image format that lobe does not read.
bool scenes_material_file_is_other_image(const char *name);

#endif
