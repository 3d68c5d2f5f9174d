#include "passes/upload/colours/material_colours.h"

#include "passes/upload/colours/colour_texel.h"
#include "shaders/interface/mirrored.h"

double passes_reflectance_of(double albedo, double metallic) {
    return DIELECTRIC_F0 * (1 - metallic) + albedo * metallic;
}

static bool read_map(const lobe_scene *scene, const device_material *material, uint32_t map,
                     uint32_t x, uint32_t y, float value[4]) {
    const lobe_texture_use *use = material->maps[map].use;
    for (int i = 0; i < 4; i++)
        value[i] = 1;
    if (!use)
        return true;
    const lobe_grid grid = passes_lobe_grid(material);
    return passes_colour_texel(&scene->images[use->image].image, &grid, x, y, value);
}

bool passes_material_colours_read(const lobe_scene *scene, const device_material *material,
                                  uint32_t x, uint32_t y, material_colours *colours) {
    const bool microfacet = material->material->model == LOBE_MATERIAL_MICROFACET;
    float albedo[4], width[4], specular[4];
    if (!read_map(scene, material, MAP_BASE_COLOUR, x, y, albedo) ||
        !read_map(scene, material, MAP_WIDTH, x, y, width) ||
        !read_map(scene, material, MAP_SPECULAR, x, y, specular))
        return false;
    colours->metallic = 0;
    if (microfacet)
        colours->metallic =
            (double)material->metallic * (material->metallic_varies ? (double)width[2] : 1);
    for (int i = 0; i < 3; i++) {
        colours->albedo[i] = (double)albedo[i];
        colours->specular[i] = microfacet
                                   ? passes_reflectance_of(colours->albedo[i], colours->metallic)
                                   : (double)specular[i];
    }
    return true;
}
