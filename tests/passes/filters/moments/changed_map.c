#include "tests/passes/filters/moments/changed_map.h"

#include <math.h>
#include <string.h>

#include "tests/passes/support/scene_builder.h"

static void set_slopes(lobe_image *image, uint32_t x, uint32_t y, double u, double v) {
    float *texel = (float *)image->texels + 4 * ((size_t)y * image->width + x);
    double length = sqrt(1 + u * u + v * v);
    texel[0] = (float)(0.5 - 0.5 * u / length);
    texel[1] = (float)(0.5 - 0.5 * v / length);
    texel[2] = (float)(0.5 + 0.5 / length);
    texel[3] = 1;
}

lobe_image round_bumps(uint32_t width, uint32_t height, double amount) {
    lobe_image image = map_image(LOBE_FORMAT_RGBA32_FLOAT, width, height);
    for (uint32_t i = 0; i < width * height; i++) {
        uint32_t x = i % width, y = i / width;
        double u = M_PI / 8 * x, v = M_PI / 8 * y;
        set_slopes(&image, x, y, amount * sin(u) * (1 + cos(v)), amount * sin(v) * (1 + cos(u)));
    }
    return image;
}

lobe_image grooves_along_x(uint32_t width, uint32_t height, double amount) {
    lobe_image image = map_image(LOBE_FORMAT_RGBA32_FLOAT, width, height);
    for (uint32_t i = 0; i < width * height; i++) {
        uint32_t x = i % width, y = i / width;
        set_slopes(&image, x, y, amount * sin(2.7 * y + 0.3 * sin(0.1 * x)), 0.05 * amount);
    }
    return image;
}

lobe_image three_facets(uint32_t width, uint32_t height, double amount) {
    lobe_image image = map_image(LOBE_FORMAT_RGBA32_FLOAT, width, height);
    for (uint32_t i = 0; i < width * height; i++) {
        uint32_t x = i % width, y = i / width, side = (x / 4 + y / 4) % 3;
        double angle = side * 2 * M_PI / 3;
        set_slopes(&image, x, y, amount * cos(angle), amount * sin(angle));
    }
    return image;
}

lobe_image one_slope(uint32_t width, uint32_t height, double amount) {
    lobe_image image = map_image(LOBE_FORMAT_RGBA32_FLOAT, width, height);
    for (uint32_t i = 0; i < width * height; i++)
        set_slopes(&image, i % width, i / width, amount, 0);
    return image;
}

lobe_image one_deviating(uint32_t width, uint32_t height, double amount) {
    lobe_image image = one_slope(width, height, 0);
    set_slopes(&image, width / 3, height / 2, amount, amount);
    return image;
}

lobe_image cracked_bumps(uint32_t width, uint32_t height, double amount) {
    lobe_image image = map_image(LOBE_FORMAT_RGBA32_FLOAT, width, height);
    for (uint32_t i = 0; i < width * height; i++) {
        const uint32_t x = i % width, y = i / width;
        const double u = M_PI / 4 * x, v = M_PI / 4 * y;
        const bool cracked = 37 * i % 256 < 256 * amount;
        set_slopes(&image, x, y, 0.2 * sin(u) * cos(v) + (cracked ? 0.7 * sin(5.0 * i) : 0),
                   cracked ? 0.7 : 0.2 * sin(v));
    }
    return image;
}

lobe_image noisy_normals(uint32_t width, uint32_t height, double amount) {
    return random_normal_map(width, height, amount, 5);
}

void replace_texels(lobe_scene *scene, uint32_t index, lobe_image other) {
    lobe_image *image = &scene->images[index].image;
    assert_int_equal(image->format, other.format);
    assert_int_equal(image->width, other.width);
    assert_int_equal(image->height, other.height);
    memcpy(image->texels, other.texels,
           (size_t)other.width * other.height * lobe_format_size(other.format));
    lobe_image_free(&other);
}

void copy_read_back(const fixture *f, lobe_resource buffer, void *data, size_t size) {
    size_t found;
    const void *bytes = lobe_graph_data(f->graph, buffer, &found);
    assert_non_null(bytes);
    assert_int_equal(found, size);
    memcpy(data, bytes, size);
}
