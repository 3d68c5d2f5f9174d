#include "tests/shaders/support/samples.h"

#include <math.h>

double random_number(uint64_t *state) {
    // Steele, Lea, Flood, 2014, Fast Splittable Pseudorandom Number Generators: SplitMix64.
    uint64_t bits = *state += 0x9e3779b97f4a7c15u;
    bits = (bits ^ (bits >> 30)) * 0xbf58476d1ce4e5b9u;
    bits = (bits ^ (bits >> 27)) * 0x94d049bb133111ebu;
    return (double)((bits ^ (bits >> 31)) >> 11) * 0x1p-53;
}

double scenes_random_between(uint64_t *state, double low, double high) {
    return low + (high - low) * random_number(state);
}

void random_direction(uint64_t *state, float direction[3]) {
    double z = scenes_random_between(state, -1, 1);
    double azimuth = scenes_random_between(state, 0, 2 * M_PI);
    double radius = sqrt(1 - z * z);
    direction[0] = (float)(radius * cos(azimuth));
    direction[1] = (float)(radius * sin(azimuth));
    direction[2] = (float)z;
}

static void normalised_cross(const double a[3], const double b[3], double cross[3]) {
    for (int i = 0; i < 3; i++)
        cross[i] = a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3];
    double length = sqrt(cross[0] * cross[0] + cross[1] * cross[1] + cross[2] * cross[2]);
    for (int i = 0; i < 3; i++)
        cross[i] /= length;
}

void direction_at(const float mean[3], double angle, double azimuth, float direction[3]) {
    const double axis[3] = {mean[0], mean[1], mean[2]};
    const double helper[3] = {fabs(axis[0]) < 0.5, fabs(axis[0]) >= 0.5, 0};
    double tangent[3], bitangent[3];
    normalised_cross(axis, helper, tangent);
    normalised_cross(axis, tangent, bitangent);
    for (int i = 0; i < 3; i++)
        direction[i] = (float)(cos(angle) * axis[i] + sin(angle) * (cos(azimuth) * tangent[i] +
                                                                    sin(azimuth) * bitangent[i]));
}

double geometric(double low, double high, size_t i, size_t count) {
    return low * pow(high / low, (double)i / (double)(count - 1));
}
