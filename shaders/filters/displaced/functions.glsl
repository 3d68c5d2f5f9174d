#ifndef FUNCTIONS_GLSL
#define FUNCTIONS_GLSL

// The functions of direction of a map (interface/displacement/relief.h).

// Four factors of transfer_basis_constants.functions, from the buffer that has them.
vec4 function_factors(uint place);

// Function `k` of a direction, or a coefficient in it, from all polynomials of the direction, or
// the coefficients in these.
float function_of(uint k, float polynomials[16]) {
    float sum = 0.0;
    for (uint i = 0u; i < 4u; ++i)
        sum += dot(function_factors(4u * k + i),
                   vec4(polynomials[4u * i], polynomials[4u * i + 1u], polynomials[4u * i + 2u],
                        polynomials[4u * i + 3u]));
    return sum;
}

#endif
