#version 460
#extension GL_GOOGLE_include_directive : require

// The waves of each layer at one time, as Fourier coefficients of the fields of interface/ocean.h.
// Tessendorf 2001, Simulating Ocean Water, Eq. 43, with e^(-i omega t) for the waves that travel
// along k. Two real fields take one complex transform: coefficients A + iB of the coefficients A
// and B of both.

#include "interface/ocean.h"
#include "lib/number/complex.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(set = 0, binding = 0, std430) readonly buffer amplitude_block { vec2 amplitudes[]; };
layout(set = 0, binding = 1, std430) writeonly buffer field_block { vec4 fields[]; };

layout(push_constant) uniform constants_block { ocean_spectrum_constants constants; };

const float GRAVITY = 9.81;
const float CAPILLARY_NUMBER = 370.0; // rad/m

// Turns since time 0, in units of 2^-32. Dispersion of gravity and surface tension in deep water.
uint phase_of(float k) {
    float relative = k / CAPILLARY_NUMBER;
    float frequency = sqrt(GRAVITY * k * (1.0 + relative * relative)) * (0.5 * INVERSE_PI);
    return uint(round(frequency * float(OCEAN_TICKS))) * constants.time;
}

vec2 amplitude(uvec2 place, uint layer) {
    return amplitudes[(layer * constants.size + place.y) * constants.size + place.x];
}

void store_field(uvec3 place, uint field, vec2 a, vec2 b, vec2 c, vec2 d) {
    uint plane = OCEAN_FIELDS * place.z + field;
    fields[(plane * constants.size + place.y) * constants.size + place.x] =
        vec4(a + times_i(b), c + times_i(d));
}

void main() {
    uvec3 place = gl_GlobalInvocationID;
    if (any(greaterThanEqual(place.xy, uvec2(constants.size))))
        return;
    ivec2 whole = ivec2(place.xy);
    whole -= int(constants.size) * ivec2(greaterThanEqual(place.xy, uvec2(constants.size / 2u)));
    vec2 wave = constants.step[place.z] * vec2(whole);
    float k = length(wave);
    vec2 turning = turned(phase_of(k));
    uvec2 opposite = (constants.size - place.xy) % constants.size;
    vec2 height = times(amplitude(place.xy, place.z), conjugate(turning)) +
                  times(conjugate(amplitude(opposite, place.z)), turning);
    vec2 direction = wave / max(k, 1e-30);
    // Points move by i k/|k| of the height: towards crests, where they are closer together.
    vec2 moved = constants.step.w * times_i(height), slope = times_i(height);
    vec2 gradient = -constants.step.w * k * height;
    store_field(place, OCEAN_FIELD_PLACE, height, direction.x * moved, direction.y * moved,
                direction.x * direction.y * gradient);
    store_field(place, OCEAN_FIELD_GRADIENTS, wave.x * slope, wave.y * slope,
                direction.x * direction.x * gradient, direction.y * direction.y * gradient);
}
