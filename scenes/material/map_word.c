#include "scenes/material/map_word.h"

#include <string.h>

#define A    MATERIAL_MAP_ALBEDO
#define N    MATERIAL_MAP_NORMAL
#define E    MATERIAL_MAP_EMISSIVE
#define O    MATERIAL_MAP_OCCLUSION
#define R    MATERIAL_MAP_ROUGHNESS
#define G    MATERIAL_MAP_GLOSS
#define M    MATERIAL_MAP_METALLIC
#define D    MATERIAL_MAP_DISPLACEMENT
#define NONE MATERIAL_MAP_COUNT

static const map_word map_words[] = {
    {"alb", WORD_MAP, A, false, NULL},
    {"albedo", WORD_MAP, A, true, NULL},
    {"base", WORD_MAP, A, false, NULL},
    {"basecolor", WORD_MAP, A, true, NULL},
    {"basecolour", WORD_MAP, A, true, NULL},
    {"bc", WORD_MAP, A, false, NULL},
    {"col", WORD_MAP, A, false, NULL},
    {"color", WORD_MAP, A, true, NULL},
    {"colour", WORD_MAP, A, true, NULL},
    {"diff", WORD_MAP, A, false, NULL},
    {"diffuse", WORD_MAP, A, true, NULL},
    {"nml", WORD_MAP, N, false, NULL},
    {"nor", WORD_MAP, N, false, NULL},
    {"norm", WORD_MAP, N, false, NULL},
    {"normal", WORD_MAP, N, true, NULL},
    {"normals", WORD_MAP, N, true, NULL},
    {"nrm", WORD_MAP, N, false, NULL},
    {"nrml", WORD_MAP, N, false, NULL},
    {"emis", WORD_MAP, E, false, NULL},
    {"emission", WORD_MAP, E, true, NULL},
    {"emissive", WORD_MAP, E, true, NULL},
    {"emit", WORD_MAP, E, false, NULL},
    {"ambientocclusion", WORD_MAP, O, true, NULL},
    {"ao", WORD_MAP, O, false, NULL},
    {"occ", WORD_MAP, O, false, NULL},
    {"occlusion", WORD_MAP, O, true, NULL},
    {"rgh", WORD_MAP, R, false, NULL},
    {"rough", WORD_MAP, R, false, NULL},
    {"roughness", WORD_MAP, R, true, NULL},
    {"gloss", WORD_MAP, G, true, NULL},
    {"glossiness", WORD_MAP, G, true, NULL},
    {"gls", WORD_MAP, G, false, NULL},
    {"smoothness", WORD_MAP, G, true, NULL},
    {"met", WORD_MAP, M, false, NULL},
    {"metal", WORD_MAP, M, false, NULL},
    {"metallic", WORD_MAP, M, true, NULL},
    {"metallness", WORD_MAP, M, true, NULL},
    {"metalness", WORD_MAP, M, true, NULL},
    {"depth", WORD_MAP, D, false, NULL},
    {"disp", WORD_MAP, D, false, NULL},
    {"displacement", WORD_MAP, D, true, NULL},
    {"height", WORD_MAP, D, true, NULL},
    {"amr", WORD_PACKED, NONE, false, "omr"},
    {"ard", WORD_PACKED, NONE, false, "ord"},
    {"arm", WORD_PACKED, NONE, false, "orm"},
    {"mra", WORD_PACKED, NONE, false, "mro"},
    {"mrao", WORD_PACKED, NONE, false, "mro"},
    {"mro", WORD_PACKED, NONE, false, "mro"},
    {"omr", WORD_PACKED, NONE, false, "omr"},
    {"ord", WORD_PACKED, NONE, false, "ord"},
    {"ordp", WORD_PACKED, NONE, false, "ord"},
    {"orm", WORD_PACKED, NONE, false, "orm"},
    {"rma", WORD_PACKED, NONE, false, "rmo"},
    {"rmao", WORD_PACKED, NONE, false, "rmo"},
    {"rmo", WORD_PACKED, NONE, false, "rmo"},
    {"maskmap", WORD_PACKED, NONE, false, "mo-g"}, // Unity's HDRP; blue masks details
    {"mods", WORD_PACKED, NONE, false, "mo-g"},
    {"alpha", WORD_ALPHA, NONE, false, NULL},
    {"opacity", WORD_ALPHA, NONE, false, NULL},
    {"transparency", WORD_ALPHA, NONE, false, NULL},
    {"anisotropy", WORD_UNUSED, NONE, false, NULL},
    {"bump", WORD_UNUSED, NONE, false, NULL},
    {"cavity", WORD_UNUSED, NONE, false, NULL},
    {"clearcoat", WORD_UNUSED, NONE, false, NULL},
    {"curvature", WORD_UNUSED, NONE, false, NULL},
    {"detail", WORD_UNUSED, NONE, false, NULL},
    {"fuzz", WORD_UNUSED, NONE, false, NULL},
    {"mask", WORD_UNUSED, NONE, false, NULL},
    {"preview", WORD_UNUSED, NONE, false, NULL},
    {"refl", WORD_UNUSED, NONE, false, NULL},
    {"reflection", WORD_UNUSED, NONE, false, NULL},
    {"render", WORD_UNUSED, NONE, false, NULL},
    {"sheen", WORD_UNUSED, NONE, false, NULL},
    {"spec", WORD_UNUSED, NONE, false, NULL},
    {"specular", WORD_UNUSED, NONE, false, NULL},
    {"specularity", WORD_UNUSED, NONE, false, NULL},
    {"sss", WORD_UNUSED, NONE, false, NULL},
    {"subsurface", WORD_UNUSED, NONE, false, NULL},
    {"thickness", WORD_UNUSED, NONE, false, NULL},
    {"thumb", WORD_UNUSED, NONE, false, NULL},
    {"thumbnail", WORD_UNUSED, NONE, false, NULL},
    {"translucency", WORD_UNUSED, NONE, false, NULL},
    {"translucent", WORD_UNUSED, NONE, false, NULL},
    {"ambient", WORD_FILLER, NONE, false, NULL},
    {"baked", WORD_FILLER, NONE, false, NULL},
    {"direct", WORD_FILLER, NONE, false, NULL},
    {"map", WORD_FILLER, NONE, false, NULL},
    {"mixed", WORD_FILLER, NONE, false, NULL},
    {"open", WORD_FILLER, NONE, false, NULL},
    {"tex", WORD_FILLER, NONE, false, NULL},
    {"texture", WORD_FILLER, NONE, false, NULL},
    {"gl", WORD_OPENGL, NONE, false, NULL},
    {"ogl", WORD_OPENGL, NONE, false, NULL},
    {"opengl", WORD_OPENGL, NONE, false, NULL},
    {"d3d", WORD_DIRECTX, NONE, false, NULL},
    {"directx", WORD_DIRECTX, NONE, false, NULL},
    {"dx", WORD_DIRECTX, NONE, false, NULL},
    {"x", WORD_DIRECTX, NONE, false, NULL}, // of "DirectX"
};

#undef A
#undef N
#undef E
#undef O
#undef R
#undef G
#undef M
#undef D
#undef NONE

const map_word *scenes_material_map_word(const char *word, size_t length) {
    for (size_t i = 0; i < sizeof map_words / sizeof *map_words; i++)
        if (strncmp(map_words[i].word, word, length) == 0 && map_words[i].word[length] == 0)
            return &map_words[i];
    return NULL;
}

material_map scenes_material_map_channel(char letter) {
    switch (letter) {
    case 'o':
        return MATERIAL_MAP_OCCLUSION;
    case 'r':
        return MATERIAL_MAP_ROUGHNESS;
    case 'g':
        return MATERIAL_MAP_GLOSS;
    case 'm':
        return MATERIAL_MAP_METALLIC;
    case 'd':
        return MATERIAL_MAP_DISPLACEMENT;
    default:
        return MATERIAL_MAP_COUNT;
    }
}

material_map scenes_material_map_letter(char letter) {
    switch (letter) {
    case 'b':
    case 'c':
    case 'd':
        return MATERIAL_MAP_ALBEDO;
    case 'n':
        return MATERIAL_MAP_NORMAL_DIRECTX;
    case 'e':
        return MATERIAL_MAP_EMISSIVE;
    case 'r':
        return MATERIAL_MAP_ROUGHNESS;
    case 'm':
        return MATERIAL_MAP_METALLIC;
    case 'h':
        return MATERIAL_MAP_DISPLACEMENT;
    default:
        return MATERIAL_MAP_COUNT;
    }
}

const char *scenes_material_map_name(material_map map) {
    static const char *const names[MATERIAL_MAP_COUNT + 1] = {
        [MATERIAL_MAP_ALBEDO] = "base colour",
        [MATERIAL_MAP_NORMAL] = "normals",
        [MATERIAL_MAP_NORMAL_DIRECTX] = "normals (DirectX)",
        [MATERIAL_MAP_EMISSIVE] = "emission",
        [MATERIAL_MAP_OCCLUSION] = "occlusion",
        [MATERIAL_MAP_ROUGHNESS] = "roughness",
        [MATERIAL_MAP_GLOSS] = "roughness (1 - gloss)",
        [MATERIAL_MAP_METALLIC] = "metallic",
        [MATERIAL_MAP_DISPLACEMENT] = "height",
        [MATERIAL_MAP_COUNT] = "nothing",
    };
    return names[map];
}
