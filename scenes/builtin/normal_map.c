#include "scenes/builtin/normal_map.h"

#include <math.h>

static uint8_t encode(double component) {
    return (uint8_t)floor(component * 127.5 + 128);
}

void scenes_normal_map_store(uint8_t texel[4], double x, double y, double z) {
    double length = sqrt(x * x + y * y + z * z);
    texel[0] = encode(x / length);
    texel[1] = encode(y / length);
    texel[2] = encode(z / length);
    texel[3] = 255;
}

// A height field's normal is (-dh/dx, -dh/dy, 1); rows run against y.
void scenes_normal_map_store_slope(uint8_t texel[4], double along_column, double along_row) {
    scenes_normal_map_store(texel, -along_column, along_row, 1);
}
