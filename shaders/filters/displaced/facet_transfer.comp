#version 460
#extension GL_GOOGLE_include_directive : require

// What each facet sees of the sky: the coefficients b (interface/displacement/relief.h), in the
// map's functions. One thread a quad.

#include "filters/displaced/facet_sky.glsl"

layout(local_size_x = 64) in;

layout(constant_id = SPECIALISE_TRANSFER_ORDER) const uint ORDER = 9;

layout(set = 0, binding = 4, std430) writeonly buffer transfer_words { uint words[]; };
layout(set = 0, binding = 10, std430) readonly buffer basis_block {
    transfer_basis_constants basis;
};

// The coefficient in function `k`, from those in all polynomials.
float function_of(uint k, float polynomials[16]) {
    float sum = 0.0;
    for (uint i = 0u; i < 4u; ++i)
        sum += dot(basis.functions[4u * k + i],
                   vec4(polynomials[4u * i], polynomials[4u * i + 1u], polynomials[4u * i + 2u],
                        polynomials[4u * i + 3u]));
    return sum;
}

float coefficient(uint k, float polynomials[16]) {
    if (k < ORDER)
        return function_of(k, polynomials);
    return polynomials[min(k - ORDER + 1u, 15u)];
}

void store(uint index, float polynomials[16]) {
    uint first = (index - transfer.first_facet) * TRANSFER_WORDS(ORDER);
    for (uint i = 0u; i < TRANSFER_WORDS(ORDER); ++i)
        words[first + i] = packHalf2x16(
            vec2(coefficient(2u * i, polynomials), coefficient(2u * i + 1u, polynomials)));
}

void main() {
    uint quad = transfer.first_thread + gl_GlobalInvocationID.x;
    if (2u * quad >= facet_count())
        return;
    float lower[16], upper[16];
    see_sky(quad, lower, upper);
    store(2u * quad, lower);
    store(2u * quad + 1u, upper);
}
