#include "tests/passes/support/map_reference.h"

#include <math.h>

#include "tests/reference/map/normal_map.h"

void reference_image_texel(const lobe_image *image, uint32_t x, uint32_t y, double texel[4]) {
    uint32_t channels = lobe_format_channels(image->format);
    size_t index = ((size_t)y * image->width + x) * channels;
    texel[0] = texel[1] = texel[2] = 0;
    texel[3] = 1;
    for (uint32_t i = 0; i < channels; i++) {
        if (image->format == LOBE_FORMAT_RGBA8_UNORM)
            texel[i] = ((const uint8_t *)image->texels)[index + i] / 255.0;
        else
            texel[i] = (double)((const float *)image->texels)[index + i];
    }
}

/// A place of a row of `size` texels for one beyond its ends: the coordinate itself is wrapped.
static uint32_t texel_at(double place, uint32_t size, lobe_scene_wrap wrap) {
    double part = (floor(place) + 0.5) / size;
    if (wrap == LOBE_SCENE_WRAP_REPEAT)
        part -= floor(part);
    if (wrap == LOBE_SCENE_WRAP_MIRROR)
        part = 1 - fabs(part - 2 * floor(part / 2) - 1);
    return (uint32_t)fmin(fmax(floor(part * size), 0), size - 1);
}

const lobe_image *image_of_map(const lobe_scene *scene, const lobe_texture_use *use) {
    return use->image >= 0 ? &scene->images[use->image].image : NULL;
}

void reference_map_value(const lobe_scene *scene, const lobe_texture_use *use, double u, double v,
                         double value[4]) {
    const lobe_image *image = image_of_map(scene, use);
    for (int i = 0; i < 4; i++)
        value[i] = image ? 0 : 1;
    if (!image)
        return;
    // The area of each texel in a square of one texel about the place, or the texel at the place.
    double x = u * image->width, y = v * image->height, half = use->nearest ? 0 : 0.5;
    double left = floor(x - half), top = floor(y - half);
    for (int i = 0; i < (use->nearest ? 1 : 4); i++) {
        double column = left + (i & 1), row = top + (i >> 1), texel[4];
        double weight = 1;
        if (!use->nearest)
            weight = (1 - fabs(x - column - 0.5)) * (1 - fabs(y - row - 0.5));
        reference_image_texel(image, texel_at(column, image->width, use->wrap_u),
                              texel_at(row, image->height, use->wrap_v), texel);
        for (int channel = 0; channel < 4; channel++)
            value[channel] += weight * texel[channel];
    }
}

const lobe_texture_use *width_map_of(const lobe_material *material) {
    return material->model == LOBE_MATERIAL_MICROFACET ? &material->metallic_roughness_map
                                                       : &material->width_map;
}

void read_surface(const lobe_scene *scene, const lobe_material *material, double u, double v,
                  double normal[3], double width[4]) {
    double value[4];
    normal[0] = normal[1] = 0;
    normal[2] = 1;
    if (material->normal_map.image >= 0) {
        reference_map_value(scene, &material->normal_map, u, v, value);
        reference_decode_normal(value, (double)material->normal_scale, normal);
    }
    reference_map_value(scene, width_map_of(material), u, v, width);
}

static bool is_interpolated(const lobe_scene *scene, const lobe_texture_use *use) {
    const lobe_image *image = image_of_map(scene, use);
    return image && !use->nearest && image->width * image->height > 1;
}

texel_points texel_points_of(const lobe_scene *scene, const lobe_material *material) {
    if (!is_interpolated(scene, &material->normal_map) &&
        !is_interpolated(scene, width_map_of(material)))
        return (texel_points){1, {{0}}};
    double gauss = 0.5 - 0.5 / sqrt(3);
    return (texel_points){2, {{gauss, gauss}, {-gauss, -gauss}}};
}

texel_points many_texel_points(void) {
    texel_points points = {.count = 16};
    for (int i = 0; i < 16; i++) {
        points.offsets[i][0] = (i + 0.5) / 16 - 0.5;
        points.offsets[i][1] = fmod((3 * i + 5.5) / 16, 1) - 0.5;
    }
    return points;
}
