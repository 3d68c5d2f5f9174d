#include "tests/passes/filters/mixture/changing_materials.h"

#include <math.h>

#include "tests/passes/support/scene_builder.h"

const char *const changing_material_names[CHANGING_MATERIALS] = {
    "stones in joints", "two bumps",        "scratches",     "weave",           "rust",
    "bricks",           "rough waves",      "leaves",        "tiles",           "yarn and leather",
    "pebbles",          "stamped metal",    "peeling paint", "gravel and moss", "grooved sheets",
    "planks",           "knurled metal",    "woven carbon",  "cracked paint",   "orange peel",
    "fish scale",       "embossed leather", "rivets",        "turned metal",    "beads",
    "ice and snow",
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

// ---------------------------------------------------------------------------------------------
// Maps that nothing was found on

/// Glazed tiles with bevelled edges and rough grout, a patch of them worn.
static changing_texel tiles(double x, double y) {
    const double u = fmod(x, 21) / 10.5 - 1, v = fmod(y + 5, 21) / 10.5 - 1;
    changing_texel texel = {{0, 0}, 16, 0.3};
    if (fmax(fabs(u), fabs(v)) > 0.88) {
        add_noise(x / 2, y / 2, 0.35, &texel);
        return texel;
    }
    const bool worn = hypot(x - 180, y - 70) < 60;
    texel = (changing_texel){{0, 0}, worn ? 45 : 170, worn ? 0.5 : 0.9};
    if (fabs(u) > 0.7)
        texel.slope[0] = copysign(0.6, u);
    if (fabs(v) > 0.7)
        texel.slope[1] = copysign(0.6, v);
    add_noise(x / 9, y / 9, worn ? 0.15 : 0.03, &texel);
    return texel;
}

/// Loops of yarn beside leather, along a slanted seam.
static changing_texel yarn_and_leather(double x, double y) {
    if (x + 0.4 * y > 170) {
        changing_texel texel = {{0, 0}, 110, 0.8};
        add_noise(x / 5, y / 5, 0.45, &texel);
        return texel;
    }
    const double u = fmod(x, 7) / 3.5 - 1, v = fmod(y + (u > 0 ? 2.5 : 0), 5) / 2.5 - 1;
    return (changing_texel){{0.6 * u + 0.2 * v, 0.7 * v - 0.3 * fabs(u)}, 22, 0.35};
}

/// Wet pebbles of several sizes in dry sand.
static changing_texel pebbles(double x, double y) {
    changing_texel texel = {{0, 0}, 18, 0.4};
    for (int size = 0; size < 3; size++) {
        const double pitch = 11 + 9 * size;
        const int column = (int)(x / pitch), row = (int)(y / pitch);
        const double radius = 0.25 + 0.2 * random_of(column + 50 * size, row);
        const double u = x / pitch - column - 0.5, v = y / pitch - row - 0.5;
        if (random_of(column, row + 40 * size) < 0.4 && hypot(u, v) < radius)
            return (changing_texel){
                {0.8 * u / radius, 0.8 * v / radius}, 150, 0.5 + 0.5 * random_of(column, row)};
    }
    add_noise(x / 1.5, y / 1.5, 0.3, &texel);
    return texel;
}

/// Brushed metal, a third of it stamped with round dents.
static changing_texel stamped_metal(double x, double y) {
    changing_texel texel = {{0, 0}, 130, 0.7};
    add_noise(x / 1.3, y / 60, 0.12, &texel);
    const double u = fmod(x, 15) / 7.5 - 1, v = fmod(y, 15) / 7.5 - 1, r = hypot(u, v);
    if (y > 160 + 0.1 * x && r < 0.8)
        texel = (changing_texel){{-0.7 * u, -0.7 * v}, 60, 1};
    return texel;
}

/// Paint that peels off old wood.
static changing_texel peeling_paint(double x, double y) {
    const double height = noise(x / 31 + 3, y / 31) + 0.4 * noise(x / 9, y / 9 + 20);
    changing_texel texel = {{0, 0}, 140, 0.6};
    if (height > 0.72) {
        texel = (changing_texel){{0, 0}, 15, 0.25};
        texel.slope[0] = 0.35 * sin(2 * x + 0.2 * noise(x / 10, y / 40));
        return texel;
    }
    if (height > 0.66)
        texel.slope[1] = 0.8 * (height - 0.66) / 0.06;
    add_noise(x / 12, y / 12, 0.08, &texel);
    return texel;
}

/// Gravel, moss, and water in between.
static changing_texel gravel_and_moss(double x, double y) {
    const double height = noise(x / 40, y / 40 + 7);
    changing_texel texel = {{0, 0}, 180, 1};
    if (height > 0.58) {
        texel = (changing_texel){{0, 0}, 60, 0.5};
        add_noise(x / 4, y / 4, 0.7, &texel);
    } else if (height > 0.42) {
        texel = (changing_texel){{0, 0}, 16, 0.15};
        add_noise(x / 1.7, y / 1.7, 0.5, &texel);
    } else {
        add_noise(x / 15, y / 15, 0.06, &texel);
    }
    return texel;
}

/// Sheets of metal with grooves of three kinds.
static changing_texel grooved_sheets(double x, double y) {
    if (y < 80)
        return (changing_texel){{0.55 * cos(0.8 * x), 0}, 160, 0.9};
    if (y < 190)
        return (changing_texel){{fmod(x, 9) < 4.5 ? 0.45 : -0.45, 0.1}, 70, 0.5};
    return (changing_texel){{0, 0.6 * cos(0.6 * y + 0.2 * x)}, 25, 0.3};
}

/// Planks with nails, rough grain and a lacquered strip.
static changing_texel planks(double x, double y) {
    const double across = fmod(x, 37);
    changing_texel texel = {{0, 0}, 30, 0.4};
    if (across < 3)
        return (changing_texel){{across < 1.5 ? -0.8 : 0.8, 0}, 15, 0.1};
    const double u = across - 18, v = fmod(y, 64) - 32;
    if (hypot(u, v) < 4)
        return (changing_texel){{0.15 * u, 0.15 * v}, 190, 1};
    const bool lacquered = fabs(y - 0.3 * x - 60) < 45;
    if (lacquered)
        texel = (changing_texel){{0, 0}, 150, 0.8};
    add_noise(x / 1.5, y / 25, lacquered ? 0.1 : 0.3, &texel);
    return texel;
}

// ---------------------------------------------------------------------------------------------
// A third list, made when the first two had been measured: no constant is chosen on it

/// Knurled metal, worn flat in a band, where it shines.
static changing_texel knurled_metal(double x, double y) {
    const double u = fmod(x + y, 10) / 5 - 1, v = fmod(x - y + 260, 10) / 5 - 1;
    const double wear = exp(-pow((x - 0.3 * y - 90) / 40, 2));
    if (fmax(fabs(u), fabs(v)) < wear)
        return (changing_texel){{0, 0}, 190, 1};
    const bool first = fabs(u) > fabs(v);
    const double a = first ? copysign(0.5, u) : 0, b = first ? 0 : copysign(0.5, v);
    return (changing_texel){{a + b, a - b}, 60, 0.6};
}

/// Carbon fibres under resin, woven two over two; resin lacks in one corner.
static changing_texel woven_carbon(double x, double y) {
    const int column = (int)(x / 9), row = (int)(y / 9);
    const bool warp = (column + row) % 4 < 2;
    const double u = fmod(warp ? x : y, 9) / 4.5 - 1, v = fmod(warp ? y : x, 18) / 9 - 1;
    const double round = 0.35 * u + 0.15 * sin(2.2 * (warp ? x : y)), along = 0.2 * v;
    const bool dry = x + y > 390;
    return (changing_texel){{warp ? round : along, warp ? along : round},
                            dry ? 20 : 80,
                            dry ? 0.15 : 0.3 + 0.2 * random_of(column, row)};
}

/// Paint in plates with raised rims; bare metal shows in the cracks.
static changing_texel cracked_paint(double x, double y) {
    double nearest = 1e9, second = 1e9, towards[2] = {0};
    const int column = (int)(x / 22), row = (int)(y / 22);
    for (int i = -1; i <= 1; i++) {
        for (int k = -1; k <= 1; k++) {
            const double u = 22 * (column + i + random_of(column + i, row + k)) - x;
            const double v = 22 * (row + k + random_of(column + i + 90, row + k)) - y;
            const double distance = hypot(u, v);
            second = fmin(second, fmax(distance, nearest));
            if (distance < nearest) {
                nearest = distance;
                towards[0] = u / distance;
                towards[1] = v / distance;
            }
        }
    }
    const double rim = second - nearest;
    if (rim < 2.5)
        return (changing_texel){{0, 0}, 170, 1};
    const double steep = rim < 7 ? 0.45 : 0;
    changing_texel texel = {{steep * towards[0], steep * towards[1]}, 35, 0.35};
    add_noise(x / 8, y / 8, 0.06, &texel);
    return texel;
}

/// Lacquer that runs into small hills, polished on one side.
static changing_texel orange_peel(double x, double y) {
    const double polish = 1 / (1 + exp((x - 128) / 15));
    changing_texel texel = {{0, 0}, 60 + 130 * polish, 0.5 + 0.4 * polish};
    add_noise(x / 5, y / 5, 0.4 - 0.33 * polish, &texel);
    return texel;
}

/// Scales that overlap, silver on the belly and dark on the back.
static changing_texel fish_scale(double x, double y) {
    for (int over = 0; over < 2; over++) {
        const int row = (int)(y / 7) - over;
        const double shift = row % 2 == 0 ? 0 : 7;
        const int column = (int)floor((x + shift) / 14);
        const double u = (x + shift - 14 * column) / 7 - 1, v = (y - 7 * row) / 14;
        if (u * u + v * v > 1)
            continue;
        const bool silver = y > 120 + 12 * sin(x / 30);
        return (changing_texel){{0.35 * u, 0.5 * v + 0.1 * (random_of(column, row) - 0.5)},
                                silver ? 150 : 45,
                                silver ? 0.7 + 0.3 * random_of(column, row + 9) : 0.2};
    }
    return (changing_texel){{0, 0}, 18, 0.1};
}

/// Leather with a pattern of stems pressed into it, where it is smooth.
static changing_texel embossed_leather(double x, double y) {
    changing_texel texel = {{0, 0}, 28, 0.4};
    const double stem = y - 26 * floor(y / 26) - 13 - 6 * sin(x / 9);
    if (fabs(stem) < 4) {
        const double steep = 0.5 * pow(stem / 4, 3), bend = -6.0 / 9 * cos(x / 9);
        return (changing_texel){{steep * bend, steep}, 120, 0.7};
    }
    add_noise(x / 3.5, y / 3.5, 0.5, &texel);
    return texel;
}

/// Plates of steel with rows of rivets, brushed in directions of their own.
static changing_texel rivets(double x, double y) {
    const double u = fmod(x, 32) - 16, v = fmod(y, 16) - 8;
    if (hypot(u, v) < 5)
        return (changing_texel){{0.16 * u, 0.16 * v}, 110, 1};
    changing_texel texel = {{0, 0}, 140, 0.6};
    const bool turned = ((int)(x / 64) + (int)(y / 64)) % 2 == 1;
    add_noise(x / (turned ? 40 : 1.2), y / (turned ? 1.2 : 40), 0.14, &texel);
    if (fmod(x, 64) < 2)
        texel = (changing_texel){{0.7, 0}, 20, 0.1};
    return texel;
}

/// Metal turned on a lathe: grooves around the middle, coarser and duller outside.
static changing_texel turned_metal(double x, double y) {
    const double u = x - 131, v = y - 122, r = fmax(hypot(u, v), 1);
    const double steep = (0.12 + 0.4 * fmin(r / 128, 1)) * sin(2.1 * r + 3 * noise(x / 9, y / 9));
    return (changing_texel){{steep * u / r, steep * v / r}, 180 - 100 * fmin(r / 128, 1), 0.8};
}

/// Beads of glass on cloth, some bare.
static changing_texel beads(double x, double y) {
    const int column = (int)(x / 8), row = (int)(y / 8);
    const double u = fmod(x, 8) / 4 - 1, v = fmod(y, 8) / 4 - 1, r = hypot(u, v);
    if (r < 0.85 && noise(column / 5.0 + 30, row / 5.0) > 0.45)
        return (changing_texel){{0.9 * u, 0.9 * v}, 200, random_of(column, row) < 0.5 ? 1 : 0.3};
    const double thread = (column + row) % 2 == 0 ? u : v;
    return (changing_texel){{(column + row) % 2 == 0 ? 0.5 * thread : 0.1,
                             (column + row) % 2 == 0 ? 0.1 : 0.5 * thread},
                            22,
                            0.25};
}

/// Ice with cracks and snow blown over it.
static changing_texel ice_and_snow(double x, double y) {
    const double drift = noise(x / 33 + 70, y / 19) + 0.25 * noise(x / 6, y / 4);
    changing_texel texel = {{0, 0}, 200, 0.3};
    if (drift > 0.66) {
        texel = (changing_texel){{0, 0}, 15, 1};
        add_noise(x / 2.5, y / 2.5, 0.35, &texel);
    } else {
        add_noise(x / 25, y / 25, 0.15, &texel);
        if (fabs(noise(x / 17, y / 17 + 40) - 0.5) < 0.02)
            texel = (changing_texel){{0.4, -0.3}, 50, 0.9};
    }
    return texel;
}

lobe_image changing_material(int which, uint32_t extent, lobe_image *colours) {
    static changing_texel (*const materials[CHANGING_MATERIALS])(double, double) = {
        stones,         bumps,
        scratches,      weave,
        rust,           bricks,
        waves,          leaves,
        tiles,          yarn_and_leather,
        pebbles,        stamped_metal,
        peeling_paint,  gravel_and_moss,
        grooved_sheets, planks,
        knurled_metal,  woven_carbon,
        cracked_paint,  orange_peel,
        fish_scale,     embossed_leather,
        rivets,         turned_metal,
        beads,          ice_and_snow};
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
