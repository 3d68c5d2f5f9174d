#include "tests/passes/filters/mixture/changing_materials.h"

#include <math.h>

#include "tests/passes/support/scene_builder.h"

const char *const changing_material_names[CHANGING_MATERIALS] = {
    "stones in joints", "two bumps",   "scratches", "weave", "rust",
    "bricks",           "rough waves", "leaves",
};

/// At a texel.
typedef struct changing_texel {
    double slope[2];
    double concentration;
    double colour;
} changing_texel;

/// In [0, 1), the same for the same cell.
static double random_of(int x, int y) {
    uint32_t hash = (uint32_t)x * 0x8da6b343u + (uint32_t)y * 0xd8163841u + 0x9e3779b9u;
    hash = (hash ^ hash >> 15) * 0x2c1b3c6du;
    hash = (hash ^ hash >> 12) * 0x297a2d39u;
    return (hash ^ hash >> 15) / 4294967296.0;
}

/// Smooth, about 0.5, with cells of one unit.
static double noise(double x, double y) {
    const int column = (int)floor(x), row = (int)floor(y);
    double u = x - column, v = y - row;
    u = u * u * (3 - 2 * u);
    v = v * v * (3 - 2 * v);
    return (1 - v) * ((1 - u) * random_of(column, row) + u * random_of(column + 1, row)) +
           v * ((1 - u) * random_of(column, row + 1) + u * random_of(column + 1, row + 1));
}

static void add_noise(double x, double y, double slope, changing_texel *texel) {
    const double step = 0.05;
    texel->slope[0] += slope * (noise(x + step, y) - noise(x - step, y)) / (2 * step);
    texel->slope[1] += slope * (noise(x, y + step) - noise(x, y - step)) / (2 * step);
}

/// Polished stones of two sizes, in rough dark joints.
static changing_texel stones(double x, double y) {
    const double pitch = x < 128 ? 9 : 13;
    const double u = fmod(x, pitch) / pitch - 0.5, v = fmod(y, pitch) / pitch - 0.5;
    if (hypot(u, v) > 0.42)
        return (changing_texel){{0, 0}, 20, 0.2};
    return (changing_texel){{1.6 * u, 1.6 * v}, 120, 1};
}

/// Glossy domes in the upper half, dull pyramids in the lower.
static changing_texel bumps(double x, double y) {
    const double u = fmod(x, 8) / 4 - 1, v = fmod(y, 8) / 4 - 1;
    if (y < 128)
        return hypot(u, v) < 0.9 ? (changing_texel){{0.7 * u, 0.7 * v}, 150, 0.9}
                                 : (changing_texel){{0, 0}, 80, 0.5};
    const bool along = fabs(u) > fabs(v);
    return (changing_texel){{along ? copysign(0.5, u) : 0, along ? 0 : copysign(0.5, v)}, 30, 0.3};
}

/// Polished metal with bright scratches, the more the further to the right.
static changing_texel scratches(double x, double y) {
    changing_texel texel = {{0, 0}, 200, 0.5};
    add_noise(x / 16, y / 16, 0.05, &texel);
    const double across = fmod(x + 3 * y, 17);
    if (across > 3 || random_of((int)((x + 3 * y) / 17), (int)(y / 40)) > x / 256)
        return texel;
    return (changing_texel){{across < 1.5 ? 0.5 : -0.5, across < 1.5 ? 0.17 : -0.17}, 40, 1};
}

/// Threads of two kinds, at right angles; a seam of one kind alone.
static changing_texel weave(double x, double y) {
    const bool warp = (x > 100 && x < 140) || ((int)(x / 6) + (int)(y / 6)) % 2 == 0;
    const double u = fmod(warp ? x : y, 6) / 3 - 1, v = fmod(warp ? y : x, 12) / 6 - 1;
    return warp ? (changing_texel){{0.6 * u, 0.2 * v}, 90, 1}
                : (changing_texel){{0.25 * v, 0.8 * u}, 25, 0.25};
}

/// Rust in patches on smooth metal: rough, dark and bumpy.
static changing_texel rust(double x, double y) {
    changing_texel texel = {{0, 0}, 160, 1};
    const bool rusty = noise(x / 24, y / 24) + 0.3 * noise(x / 7 + 50, y / 7) > 0.7;
    if (rusty)
        texel = (changing_texel){{0, 0}, 20, 0.2};
    add_noise(x / 3 + 9, y / 3, rusty ? 0.5 : 0.06, &texel);
    return texel;
}

/// Glazed bricks with round edges, each tilted, between rough mortar.
static changing_texel bricks(double x, double y) {
    const int row = (int)(y / 16), column = (int)((x + 13 * (row % 2)) / 27);
    const double u = fmod(x + 13 * (row % 2), 27) / 13.5 - 1, v = fmod(y, 16) / 8 - 1;
    changing_texel texel = {{0, 0}, 18, 0.35};
    if (fabs(u) > 0.88 || fabs(v) > 0.8) {
        add_noise(x / 2, y / 2, 0.3, &texel);
        return texel;
    }
    const double glaze = random_of(column, row);
    texel = (changing_texel){{0.5 * pow(u, 5) + 0.2 * (random_of(column + 7, row) - 0.5),
                              0.5 * pow(v, 5) + 0.2 * (random_of(column, row + 7) - 0.5)},
                             40 + 120 * glaze,
                             0.4 + 0.6 * glaze};
    add_noise(x / 6, y / 6, 0.1, &texel);
    return texel;
}

/// Waves that steepen to the right, where they become dull and dark.
static changing_texel waves(double x, double y) {
    const double part = x / 256, phase = 0.7 * x + 0.25 * y + 2 * noise(x / 20, y / 20);
    return (changing_texel){
        {(0.1 + 0.6 * part) * cos(phase), 0.3 * (0.1 + 0.6 * part) * cos(phase)},
        exp((1 - part) * log(180) + part * log(20)),
        1 - 0.8 * part};
}

/// Leaves that lie in all directions, waxy above and matt below, on soil.
static changing_texel leaves(double x, double y) {
    const int column = (int)(x / 19), row = (int)(y / 19);
    const double u = fmod(x, 19) / 9.5 - 1, v = fmod(y, 19) / 9.5 - 1;
    const double angle = 6.283 * random_of(column, row);
    const double along = cos(angle) * u + sin(angle) * v, across = cos(angle) * v - sin(angle) * u;
    changing_texel texel = {{0, 0}, 15, 0.15};
    if (along * along + 3 * across * across > 0.9) {
        add_noise(x / 2, y / 2, 0.4, &texel);
        return texel;
    }
    const bool waxy = random_of(column + 3, row + 5) < 0.6;
    const double fold = across > 0 ? 0.35 : -0.35;
    return (changing_texel){
        {-sin(angle) * fold + 0.2 * cos(angle), cos(angle) * fold + 0.2 * sin(angle)},
        waxy ? 140 : 35,
        waxy ? 1 : 0.5};
}

lobe_image changing_material(int which, uint32_t extent, lobe_image *colours) {
    static changing_texel (*const materials[CHANGING_MATERIALS])(double, double) = {
        stones, bumps, scratches, weave, rust, bricks, waves, leaves};
    lobe_image map = map_image(LOBE_FORMAT_RGBA32_FLOAT, extent, extent);
    *colours = map_image(LOBE_FORMAT_R32_FLOAT, extent, extent);
    for (uint32_t i = 0; i < extent * extent; i++) {
        const changing_texel at = materials[which](i % extent + 0.5, i / extent + 0.5);
        const double length = sqrt(1 + at.slope[0] * at.slope[0] + at.slope[1] * at.slope[1]);
        float *texel = (float *)map.texels + (size_t)4 * i;
        texel[0] = (float)(0.5 + 0.5 * at.slope[0] / length);
        texel[1] = (float)(0.5 + 0.5 * at.slope[1] / length);
        texel[2] = (float)(0.5 + 0.5 / length);
        texel[3] = (float)at.concentration;
        ((float *)colours->texels)[i] = (float)at.colour;
    }
    return map;
}
