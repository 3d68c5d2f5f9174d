#ifndef LIB_CONSTANTS_GLSL
#define LIB_CONSTANTS_GLSL

const float PI = 3.14159265358979324;
const float INVERSE_PI = 0.318309886183790672;

// Sharpest lobe that is handled: a von Mises-Fisher lobe 1 milliradian wide. Sharper ones cannot
// be told apart through a characteristic vector in float32, where 1 - |r| = 1/kappa is rounded
// to 1e-7, and are nothing but fireflies under punctual lights.
const float CONCENTRATION_MAXIMUM = 1e6;

// The same limit for the roughness alpha of a microfacet distribution, kappa = 2 / alpha^2.
const float ALPHA_MINIMUM = 1.41421356e-3;

// Directions closer to the horizon than a microradian are treated as that close: 1/cos^4 then
// stays within float32.
const float COSINE_MINIMUM = 1e-6;

#endif
