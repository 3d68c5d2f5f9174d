#include "tools/compare/flip_colour.h"

#include <math.h>

// IEC 61966-2-1: linear sRGB to XYZ, each row divided by the white point's X, Y or Z, so that
// white is (1, 1, 1). From the primaries (0.64, 0.33), (0.30, 0.60), (0.15, 0.06) and the white
// point (0.3127, 0.3290) in exact arithmetic.
static const float to_white_relative[3][3] = {
    {0.43388735f, 0.37622401f, 0.18988865f},
    {0.21263901f, 0.71516868f, 0.07219232f},
    {0.01775004f, 0.10944762f, 0.87280234f},
};
static const float from_white_relative[3][3] = {
    {3.08039909f, -1.53738318f, -0.54301591f},
    {-0.92122336f, 1.87596750f, 0.04525586f},
    {0.05287394f, -0.20397696f, 1.15110302f},
};

static void multiply(const float matrix[3][3], const float vector[3], float result[3]) {
    for (int row = 0; row < 3; row++)
        result[row] =
            matrix[row][0] * vector[0] + matrix[row][1] * vector[1] + matrix[row][2] * vector[2];
}

// Flohr, Kolpatzik, Balasubramanian, Carrara, Bouman, Allebach, 1993, "Model-based color image
// quantization": YCxCz is CIELAB without the cube root.
void flip_colour_to_opponent(const float rgb[3], float opponent[3]) {
    float xyz[3];
    multiply(to_white_relative, rgb, xyz);
    opponent[0] = 116.0f * xyz[1] - 16.0f;
    opponent[1] = 500.0f * (xyz[0] - xyz[1]);
    opponent[2] = 200.0f * (xyz[1] - xyz[2]);
}

void flip_colour_from_opponent(const float opponent[3], float rgb[3]) {
    float y = (opponent[0] + 16.0f) / 116.0f;
    float xyz[3] = {y + opponent[1] / 500.0f, y, y - opponent[2] / 200.0f};
    multiply(from_white_relative, xyz, rgb);
}

// CIE 15:2004, the function f of CIELAB.
static float lab_curve(float value) {
    const float knee = 6.0f / 29.0f;
    return value > knee * knee * knee ? cbrtf(value) : value / (3.0f * knee * knee) + 4.0f / 29.0f;
}

void flip_colour_to_hunt_lab(const float rgb[3], float lab[3]) {
    float xyz[3];
    multiply(to_white_relative, rgb, xyz);
    float x = lab_curve(xyz[0]), y = lab_curve(xyz[1]), z = lab_curve(xyz[2]);
    lab[0] = 116.0f * y - 16.0f;
    lab[1] = 0.01f * lab[0] * 500.0f * (x - y);
    lab[2] = 0.01f * lab[0] * 200.0f * (y - z);
}

// Abasi, Amani Tehran, Fairchild, 2020, "Distance metrics for very large color differences".
float flip_colour_distance(const float lab1[3], const float lab2[3]) {
    return fabsf(lab1[0] - lab2[0]) + hypotf(lab1[1] - lab2[1], lab1[2] - lab2[2]);
}
