#include <lobe/scene.h>

void lobe_material_default(lobe_material *material) {
    if (!material)
        return;
    *material = (lobe_material){
        .model = LOBE_MATERIAL_MICROFACET,
        .distribution = LOBE_DISTRIBUTION_GGX,
        .space = LOBE_SPACE_AUTOMATIC,
        .base_colour = {1, 1, 1, 1},
        .base_colour_map = LOBE_TEXTURE_NONE,
        .normal_map = LOBE_TEXTURE_NONE,
        .normal_scale = 1,
        .height_map = LOBE_TEXTURE_NONE,
        .emissive_map = LOBE_TEXTURE_NONE,
        .occlusion_map = LOBE_TEXTURE_NONE,
        .occlusion_strength = 1,
        .alpha_cutoff = 0.5f,
        .roughness = 1,
        .metallic_roughness_map = LOBE_TEXTURE_NONE,
        .lobes = {{.direction = {0, 0, 1}, .width = 1, .colour = {1, 1, 1}}},
        .lobe_count = 1,
        .width_map = LOBE_TEXTURE_NONE,
        .specular_map = LOBE_TEXTURE_NONE,
    };
}
