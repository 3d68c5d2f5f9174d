#version 460
#extension GL_GOOGLE_include_directive : require

// The functions of direction of a map (interface/displacement/relief.h): the cosine, and the
// leading eigenvectors of P (sum of C^2) P, with the C of basis_cells and P the projection on what
// is orthogonal to the cosine. They minimise the sum of squares of what all C lose. By Jacobi's
// rotations; one group, a thread for each polynomial.

#include "interface/displacement/relief.h"
#include "lib/displacement/transfer_basis.glsl"

layout(local_size_x = TRANSFER_BASIS_TERMS) in;

layout(set = 0, binding = 0, std430) readonly buffer cell_block { vec4 cells[]; };
layout(set = 0, binding = 1, std430) writeonly buffer basis_block {
    transfer_basis_constants basis;
};

layout(push_constant) uniform count_block { uint cell_count; };

const int TERMS = TRANSFER_BASIS_TERMS;
const uint SWEEPS = 8u;

shared float matrix[TERMS][TERMS];
shared float vectors[TERMS][TERMS]; // columns: eigenvectors
shared uint chosen[TRANSFER_MAXIMUM_ORDER];

// A row of the sum of squares. The cosine is the first polynomial, so that P drops that.
void sum_squares(uint row) {
    float sums[TERMS];
    for (int i = 0; i < TERMS; ++i)
        sums[i] = 0.0;
    for (uint cell = 0u; cell < cell_count; ++cell) {
        uint first = 4u * TERMS * cell;
        for (int i = 0; i < TERMS; ++i)
            for (uint part = 0u; part < 4u; ++part)
                sums[i] += dot(cells[first + 4u * row + part], cells[first + 4u * i + part]);
    }
    for (int i = 0; i < TERMS; ++i) {
        matrix[row][i] = row == 0u || i == 0 ? 0.0 : sums[i];
        vectors[row][i] = row == uint(i) ? 1.0 : 0.0;
    }
}

// Makes the entry (p, q) zero.
void rotate(uint own, int p, int q) {
    float entry = matrix[p][q], difference = matrix[q][q] - matrix[p][p];
    barrier();
    float sine = 0.0, cosine = 1.0;
    if (abs(entry) > 1e-12 * abs(difference) && abs(entry) > 1e-30) {
        float ratio = difference / (2.0 * entry);
        float tangent = (ratio < 0.0 ? -1.0 : 1.0) / (abs(ratio) + sqrt(1.0 + ratio * ratio));
        cosine = inversesqrt(1.0 + tangent * tangent);
        sine = tangent * cosine;
    }
    float first = matrix[own][p], second = matrix[own][q];
    matrix[own][p] = cosine * first - sine * second;
    matrix[own][q] = sine * first + cosine * second;
    first = vectors[own][p];
    second = vectors[own][q];
    vectors[own][p] = cosine * first - sine * second;
    vectors[own][q] = sine * first + cosine * second;
    barrier();
    first = matrix[p][own];
    second = matrix[q][own];
    matrix[p][own] = cosine * first - sine * second;
    matrix[q][own] = sine * first + cosine * second;
    barrier();
}

void choose_largest() {
    uint taken = 1u;
    chosen[0] = 0u;
    for (int k = 1; k < TRANSFER_MAXIMUM_ORDER; ++k) {
        int best = -1;
        for (int i = 1; i < TERMS; ++i)
            if ((taken & (1u << i)) == 0u && (best < 0 || matrix[i][i] > matrix[best][best]))
                best = i;
        taken |= 1u << best;
        chosen[k] = uint(best);
    }
}

// One of the functions; its largest factor is positive.
void write_function(uint k) {
    float largest = 0.0, integral = 0.0;
    for (int i = 0; i < TERMS; ++i)
        if (abs(vectors[i][chosen[k]]) > abs(largest))
            largest = vectors[i][chosen[k]];
    float sign = largest < 0.0 ? -1.0 : 1.0;
    for (int i = 0; i < TERMS; ++i) {
        float factor = sign * vectors[i][chosen[k]];
        basis.functions[4u * k + uint(i) / 4u][i % 4] = factor;
        integral += factor * TRANSFER_INTEGRAL[i];
    }
    basis.integrals[k / 4u][k % 4u] = integral;
}

void main() {
    uint own = gl_LocalInvocationID.x;
    sum_squares(own);
    barrier();
    for (uint sweep = 0u; sweep < SWEEPS; ++sweep)
        for (int p = 1; p < TERMS; ++p)
            for (int q = p + 1; q < TERMS; ++q)
                rotate(own, p, q);
    if (own == 0u)
        choose_largest();
    barrier();
    if (own < TRANSFER_MAXIMUM_ORDER)
        write_function(own);
    else if (own < 12u)
        basis.integrals[own / 4u][own % 4u] = 0.0;
}
