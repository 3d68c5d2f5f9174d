#include "passes/upload/colours/material_colours.h"

#include <lobe/colour.h>

#include "passes/upload/material_maps.h"

double passes_reflectance_of(double albedo, double metallic) {
    return 0.04 * (1 - metallic) + albedo * metallic;
}

/// One texel, linear. Only colour maps have the sRGB curve.
static bool read_image(const lobe_image *image, uint32_t x, uint32_t y, float value[4]) {
    if (!image->texels || image->format != LOBE_FORMAT_RGBA8_SRGB)
        return passes_image_texel(image, x, y, value);
    const unsigned char *texel =
        (const unsigned char *)image->texels + 4 * ((size_t)y * image->width + x);
    for (int i = 0; i < 3; i++)
        value[i] = lobe_srgb_decode((float)texel[i] / 255);
    value[3] = (float)texel[3] / 255;
    return true;
}

static bool read_map(const lobe_scene *scene, const device_material *material, uint32_t map,
                     uint32_t x, uint32_t y, float value[4]) {
    const lobe_texture_use *use = material->maps[map].use;
    for (int i = 0; i < 4; i++)
        value[i] = 1;
    if (!use)
        return true;
    const lobe_grid grid = passes_lobe_grid(material);
    const lobe_image *image = &scene->images[use->image].image;
    return read_image(image, (uint32_t)((uint64_t)x * image->width / grid.width),
                      (uint32_t)((uint64_t)y * image->height / grid.height), value);
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
    colours->alpha = (double)albedo[3];
    for (int i = 0; i < 3; i++) {
        colours->albedo[i] = (double)albedo[i];
        colours->specular[i] = microfacet
                                   ? passes_reflectance_of(colours->albedo[i], colours->metallic)
                                   : (double)specular[i];
    }
    return true;
}
