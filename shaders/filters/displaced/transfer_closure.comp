#version 460
#extension GL_GOOGLE_include_directive : require

// What the mean of a whole map of transfer lacks of reflecting all light, if it were white, and how
// much of the light between facets goes on. One thread. Nothing where colours vary.

#include "interface/displacement/relief.h"
#include "lib/displacement/transfer_basis.glsl"

layout(constant_id = SPECIALISE_TRANSFER_ORDER) const uint ORDER = 9;
layout(constant_id = SPECIALISE_TRANSFER_COLOURED) const bool COLOURED = false;
layout(constant_id = SPECIALISE_TRANSFER_EMISSION) const bool EMISSIVE = false;

layout(local_size_x = 1) in;

layout(set = 0, binding = 0) uniform sampler2DArray transfer_map;
layout(set = 0, binding = 1, std430) writeonly buffer closure_block {
    transfer_closure_constants closure;
};
layout(set = 0, binding = 2, std430) readonly buffer basis_block {
    transfer_basis_constants basis;
};

const uint DIRECT = TRANSFER_DIRECT_COUNT(ORDER);
const uint LAYERS = TRANSFER_CHANNEL_LAYERS(ORDER, COLOURED);
const uint EMISSION = 4u * LAYERS; // the first of its entries

float entry(uint i) {
    return texelFetch(transfer_map, ivec3(0, 0, i / 4u), 0)[i % 4u];
}

float of_matrix(uint first, uint i, uint j) {
    uint row = max(i, j), column = min(i, j);
    return entry(first + row * (row + 1u) / 2u + column);
}

float integral_of(uint k) {
    return basis.integrals[k / 4u][k % 4u];
}

void main() {
    float lacking[16], functions[9], visible[16];
    float direct = 0.0, lost = 0.0;
    for (uint i = 0u; i < ORDER; ++i) {
        functions[i] = 0.0;
        for (uint j = 0u; j < ORDER; ++j)
            functions[i] += of_matrix(0u, i, j) * integral_of(j);
        direct += INVERSE_PI * integral_of(i) * functions[i];
    }
    for (uint i = 0u; i < 16u; ++i) {
        lacking[i] = i == 0u ? TRANSFER_COSINE : 0.0;
        visible[i] = 0.0;
        for (uint k = 0u; k < ORDER; ++k) {
            float factor = basis.functions[4u * k + i / 4u][i % 4u];
            lacking[i] -= factor * functions[k];
            visible[i] += factor * entry(TRANSFER_ENTRIES(ORDER) + k);
        }
        for (uint j = 0u; i < TRANSFER_INDIRECT && j < TRANSFER_INDIRECT; ++j)
            lacking[i] -= of_matrix(DIRECT, i, j) * TRANSFER_INTEGRAL[j];
        if (COLOURED)
            lacking[i] = 0.0;
        lost += lacking[i] * TRANSFER_INTEGRAL[i];
    }
    for (int i = 0; i < 4; ++i) {
        closure.lacking[i] =
            vec4(lacking[4 * i], lacking[4 * i + 1], lacking[4 * i + 2], lacking[4 * i + 3]);
        closure.visible[i] =
            vec4(visible[4 * i], visible[4 * i + 1], visible[4 * i + 2], visible[4 * i + 3]);
    }
    float rest = 1.0 - direct, next = entry(DIRECT + TRANSFER_INDIRECT_COUNT);
    closure.lost = lost;
    closure.persistence = !COLOURED && rest > 1e-4 ? clamp(1.0 - next / rest, 0.0, 0.999) : 0.0;
    closure.direct = direct;
    closure.basis = basis;
    for (uint i = 0u; i < LAYERS; ++i)
        closure.mean[i] = texelFetch(transfer_map, ivec3(0, 0, i), 0);
    for (uint k = 0u; k < ORDER; ++k) {
        vec4 sum = vec4(0.0);
        for (uint channel = 0u; EMISSIVE && channel < 3u; ++channel)
            sum[channel] = entry(EMISSION + channel * TRANSFER_EMISSION(ORDER) + k);
        closure.emission[k] = sum;
    }
}
