#include "scenes/builtin/hall/hall.h"
#include "scenes/builtin/hall/lathe.h"

enum { COLUMNS = 24 };

// An Attic base (two rings with a hollow between them) and a shaft that narrows upwards with
// entasis, the slight bulge that makes it look straight.
lobe_result scenes_hall_make_column(const lobe_host *host, lobe_mesh *mesh) {
    static const double outline[][2] = {
        {0.305, 4.02}, {0.300, 3.97},  {0.318, 3.30},  {0.338, 2.50},  {0.353, 1.70},
        {0.360, 1.00}, {0.362, 0.56},  {0.385, 0.525}, {0.425, 0.52},  {0.443, 0.485},
        {0.42, 0.455}, {0.395, 0.445}, {0.378, 0.40},  {0.398, 0.355}, {0.45, 0.345},
        {0.485, 0.31}, {0.495, 0.265}, {0.485, 0.22},  {0.47, 0.2}};
    static const lathe_shape shape = {.name = "column",
                                      .outline = outline,
                                      .count = sizeof outline / sizeof *outline,
                                      .cuts = 2,
                                      .columns = COLUMNS,
                                      .tile = HALL_MARBLE_TILE,
                                      .tiles_around = 2};
    return scenes_lathe_make(&shape, host, mesh);
}

// A bell that widens from a ring to the abacus.
lobe_result scenes_hall_make_capital(const lobe_host *host, lobe_mesh *mesh) {
    static const double outline[][2] = {{0.470, 4.24}, {0.478, 4.225}, {0.470, 4.20},
                                        {0.425, 4.17}, {0.38, 4.10},   {0.345, 4.00},
                                        {0.325, 3.90}, {0.318, 3.84},  {0.345, 3.825},
                                        {0.352, 3.80}, {0.345, 3.775}, {0.312, 3.76}};
    static const lathe_shape shape = {.name = "capital",
                                      .outline = outline,
                                      .count = sizeof outline / sizeof *outline,
                                      .cuts = 2,
                                      .columns = COLUMNS,
                                      .tile = HALL_BRONZE_TILE,
                                      .tiles_around = 6};
    return scenes_lathe_make(&shape, host, mesh);
}

lobe_result scenes_hall_make_ring(const lobe_host *host, lobe_mesh *mesh) {
    static const double outline[][2] = {{0.36, 0.74},  {0.378, 0.735}, {0.384, 0.70}, {0.378, 0.66},
                                        {0.384, 0.62}, {0.378, 0.585}, {0.36, 0.58}};
    static const lathe_shape shape = {.name = "ring",
                                      .outline = outline,
                                      .count = sizeof outline / sizeof *outline,
                                      .cuts = 1,
                                      .columns = COLUMNS,
                                      .tile = HALL_BRONZE_TILE,
                                      .tiles_around = 6};
    return scenes_lathe_make(&shape, host, mesh);
}
