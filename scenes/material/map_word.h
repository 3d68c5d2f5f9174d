#ifndef SCENES_MATERIAL_MAP_WORD_H
#define SCENES_MATERIAL_MAP_WORD_H

#include <stdbool.h>
#include <stddef.h>

/// What the texels of a material's image files, or single channels of them, hold.
typedef enum material_map {
    MATERIAL_MAP_ALBEDO,
    MATERIAL_MAP_NORMAL,         ///< +Y: OpenGL, or not stated
    MATERIAL_MAP_NORMAL_DIRECTX, ///< -Y
    MATERIAL_MAP_EMISSIVE,
    // Values, one channel each.
    MATERIAL_MAP_OCCLUSION,
    MATERIAL_MAP_ROUGHNESS,
    MATERIAL_MAP_GLOSS, ///< 1 - roughness
    MATERIAL_MAP_METALLIC,
    MATERIAL_MAP_DISPLACEMENT,
    MATERIAL_MAP_COUNT ///< none of these
} material_map;

/// "base colour", "normals (DirectX)" and so on.
const char *scenes_material_map_name(material_map map);

/// What a word says.
typedef enum word_kind {
    WORD_UNKNOWN,
    WORD_MAP,    ///< names the map
    WORD_PACKED, ///< names the channels
    WORD_UNUSED, ///< names a map that lobe does not use
    WORD_ALPHA,  ///< the same; after albedo: its alpha
    WORD_FILLER, ///< says nothing ("map")
    WORD_OPENGL,
    WORD_DIRECTX,
} word_kind;

typedef struct map_word {
    const char *word;
    word_kind kind;
    material_map map;
    /// Spelt out: it means the map also where the word before it is another map's, as in
    /// "metallic_roughness", while "metal_rough" is the roughness of a metal.
    bool full;
    const char *channels; ///< packed: a letter for each, '-' for none
} map_word;

/// The word of the first `length` bytes, in lower case; NULL if it says nothing.
const map_word *scenes_material_map_word(const char *word, size_t length);

/// What a letter of `channels` stands for; MATERIAL_MAP_COUNT for none.
material_map scenes_material_map_channel(char letter);

/// What the last letter of Unreal's names stands for ("T_Brick_N"), in lower case;
/// MATERIAL_MAP_COUNT if nothing. Unreal's normals point down.
material_map scenes_material_map_letter(char letter);

#endif
