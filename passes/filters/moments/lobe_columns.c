#include "passes/filters/moments/lobe_columns.h"

#include <string.h>

#include "shaders/interface/moment_bins.h"

// Sums are kept in lanes, so that their order does not depend on the compiler.
enum { BLOCK = 64, LANES = 8 };

/// Smaller logarithms would make sums of numbers that processors are slow with.
static const float least = -40;

void passes_lobe_columns_fill(const plane_sample *samples, uint32_t count, lobe_columns *columns) {
    double total = 0;
    for (uint32_t i = 0; i < count; i++)
        total += samples[i].weight;
    columns->count = (count + BLOCK - 1) / BLOCK * BLOCK;
    for (uint32_t i = 0; i < columns->count; i++) {
        const plane_sample *sample = &samples[i < count ? i : 0];
        columns->place[0][i] = (float)sample->place[0];
        columns->place[1][i] = (float)sample->place[1];
        columns->variance[i] = (float)sample->variance;
        columns->weight[i] = i < count ? (float)(sample->weight / total) : 0;
    }
}

// ---------------------------------------------------------------------------------------------
// Functions without branches

/// Of x in [least, 0], within 3e-6 of it.
static float exponential(float x) {
    const float power = x * 1.44269504f;
    const float whole = (power + 12582912.0f) - 12582912.0f; // rounds
    const float f = power - whole;
    const int32_t bits = ((int32_t)whole + 127) * (1 << 23);
    float scale;
    memcpy(&scale, &bits, sizeof scale);
    return scale *
           (1 + f * (0.69314718f +
                     f * (0.24022651f + f * (0.05550411f + f * (0.00961813f + f * 0.00133336f)))));
}

/// Of x >= 1, within 2e-6.
static float logarithm(float x) {
    int32_t bits;
    memcpy(&bits, &x, sizeof bits);
    const int32_t exponent = (bits >> 23) - 127, fraction = (bits & 0x7fffff) | 0x3f800000;
    float m;
    memcpy(&m, &fraction, sizeof m);
    const float t = (m - 1) / (m + 1), square = t * t;
    return (float)exponent * 0.69314718f +
           2 * t *
               (1 + square * (1 / 3.0f +
                              square * (1 / 5.0f + square * (1 / 7.0f + square * (1 / 9.0f)))));
}

// ---------------------------------------------------------------------------------------------
// One block

typedef struct column_block {
    const float *x, *y, *variance, *weight;
    float shares[MOMENT_MAXIMUM_BINS][BLOCK]; ///< first, logarithms of chances
    float most[BLOCK], sum[BLOCK];
} column_block;

static void find_chances(const lobe_chance *c, const column_block *block, float *restrict chances) {
    const float *x = block->x, *y = block->y, *variance = block->variance;
    for (uint32_t i = 0; i < BLOCK; i++) {
        float dx = x[i] - c->mean[0], dy = y[i] - c->mean[1];
        chances[i] =
            c->offset -
            (c->squares[0] * dx * dx + c->squares[1] * dy * dy + 2 * c->squares[2] * dx * dy) -
            (c->squares[0] + c->squares[1]) * variance[i];
    }
}

static void find_shares(const lobe_chance *chances, uint32_t count, column_block *block) {
    for (uint32_t k = 0; k < count; k++)
        find_chances(&chances[k], block, block->shares[k]);
    memcpy(block->most, block->shares[0], sizeof block->most);
    memset(block->sum, 0, sizeof block->sum);
    for (uint32_t k = 1; k < count; k++)
        for (uint32_t i = 0; i < BLOCK; i++)
            block->most[i] =
                block->shares[k][i] > block->most[i] ? block->shares[k][i] : block->most[i];
    for (uint32_t k = 0; k < count; k++) {
        float *restrict shares = block->shares[k];
        // In loops of their own, without which compilers branch.
        for (uint32_t i = 0; i < BLOCK; i++)
            shares[i] -= block->most[i];
        for (uint32_t i = 0; i < BLOCK; i++)
            shares[i] = shares[i] > least ? shares[i] : least;
        for (uint32_t i = 0; i < BLOCK; i++)
            shares[i] = exponential(shares[i]);
        for (uint32_t i = 0; i < BLOCK; i++)
            block->sum[i] += shares[i];
    }
    for (uint32_t k = 0; k < count; k++)
        for (uint32_t i = 0; i < BLOCK; i++)
            block->shares[k][i] *= block->weight[i] / block->sum[i];
}

static double sum_of_lanes(const float *lanes) {
    double sum = 0;
    for (uint32_t l = 0; l < LANES; l++)
        sum += (double)lanes[l];
    return sum;
}

static double likelihood_of(const column_block *block) {
    float lanes[LANES] = {0};
    for (uint32_t i = 0; i < BLOCK; i += LANES)
        for (uint32_t l = 0; l < LANES; l++)
            lanes[l] += block->weight[i + l] * (block->most[i + l] + logarithm(block->sum[i + l]));
    return sum_of_lanes(lanes);
}

static void add_shares(const lobe_chance *chance, const column_block *block, const float *shares,
                       plane_sums *sums) {
    float lanes[7][LANES] = {{0}};
    for (uint32_t i = 0; i < BLOCK; i += LANES) {
        for (uint32_t l = 0; l < LANES; l++) {
            float share = shares[i + l];
            float x = block->x[i + l] - chance->mean[0], y = block->y[i + l] - chance->mean[1];
            lanes[0][l] += share;
            lanes[1][l] += share * x;
            lanes[2][l] += share * y;
            lanes[3][l] += share * x * x;
            lanes[4][l] += share * y * y;
            lanes[5][l] += share * x * y;
            lanes[6][l] += share * block->variance[i + l];
        }
    }
    sums->weight += sum_of_lanes(lanes[0]);
    for (int j = 0; j < 2; j++)
        sums->place[j] += sum_of_lanes(lanes[1 + j]);
    for (int j = 0; j < 3; j++)
        sums->moments[j] += sum_of_lanes(lanes[3 + j]);
    sums->variance += sum_of_lanes(lanes[6]);
}

double passes_lobe_columns_share(const lobe_columns *columns, const lobe_chance *chances,
                                 uint32_t count, plane_sums *sums) {
    double likelihood = 0;
    memset(sums, 0, count * sizeof *sums);
    for (uint32_t first = 0; first < columns->count; first += BLOCK) {
        column_block block = {.x = columns->place[0] + first,
                              .y = columns->place[1] + first,
                              .variance = columns->variance + first,
                              .weight = columns->weight + first};
        find_shares(chances, count, &block);
        likelihood += likelihood_of(&block);
        for (uint32_t k = 0; k < count; k++)
            add_shares(&chances[k], &block, block.shares[k], &sums[k]);
    }
    return likelihood;
}
