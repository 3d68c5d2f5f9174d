#ifndef FACET_WORDS_GLSL
#define FACET_WORDS_GLSL

// What facet_transfer.comp has found.

layout(constant_id = SPECIALISE_TRANSFER_ORDER) const uint ORDER = 9;

layout(set = 0, binding = 4, std430) readonly buffer transfer_words { uint words[]; };

float facet_coefficient(uint index, uint k) {
    return unpackHalf2x16(words[index * TRANSFER_WORDS(ORDER) + k / 2u])[k % 2u];
}

// In the first four polynomials.
vec4 smooth_coefficients(uint index) {
    return vec4(facet_coefficient(index, 0u), facet_coefficient(index, ORDER),
                facet_coefficient(index, ORDER + 1u), facet_coefficient(index, ORDER + 2u));
}

#endif
