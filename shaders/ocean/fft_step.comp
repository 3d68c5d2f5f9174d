#version 460
#extension GL_GOOGLE_include_directive : require
#pragma variants LAST

// One step of Fourier transforms of all rows, or all columns, of all fields, through memory: one
// small transform a thread, without barriers. The form for processors whose groups run one thread
// after the other. Stockham's order: Govindaraju, Lloyd, Dotsenko, Smith, Manferdelli 2008, High
// Performance Discrete Fourier Transforms on Graphics Processors, section 3.
//
// LAST: the step's results go into the layers of an image.

#include "ocean/butterfly.glsl"

layout(local_size_x = 32, local_size_y = 2) in;

layout(constant_id = SPECIALISE_RADIX) const uint RADIX = 8;

layout(set = 0, binding = 0, std430) readonly buffer source_block { vec4 source[]; };
layout(set = 0, binding = 1, std430) readonly buffer root_block { vec2 roots[]; };
#ifdef LAST
layout(set = 0, binding = 2, rgba32f) writeonly uniform image2DArray target;
#else
layout(set = 0, binding = 2, std430) writeonly buffer target_block { vec4 target[]; };
#endif

layout(push_constant) uniform constants_block { ocean_fft_constants constants; };

uint steps_of(uint element, uint line) {
    uint size = constants.size;
    return constants.columns != 0u ? element * size + line : line * size + element;
}

void store(uint element, uint line, uint field, vec4 value) {
#ifdef LAST
    uvec2 place = constants.columns != 0u ? uvec2(line, element) : uvec2(element, line);
    imageStore(target, ivec3(place, field), value);
#else
    target[field * constants.size * constants.size + steps_of(element, line)] = value;
#endif
}

void main() {
    uint size = constants.size, parts = size / RADIX, field = gl_GlobalInvocationID.z;
    // Neighbouring threads read neighbouring numbers.
    uint part = constants.columns != 0u ? gl_GlobalInvocationID.y : gl_GlobalInvocationID.x;
    uint line = constants.columns != 0u ? gl_GlobalInvocationID.x : gl_GlobalInvocationID.y;
    if (part >= parts || line >= size)
        return;
    uint done = part % constants.done;
    uint turn = done * (parts / constants.done);
    vec4 v[8];
    for (uint i = 0u; i < RADIX; ++i) {
        vec4 value =
            source[field * size * size + steps_of(part + i * parts, line)];
        v[i] = i == 0u ? value : pair_times(value, roots[i * turn]);
    }
    transform(RADIX, v);
    uint first = (part - done) * RADIX + done;
    for (uint i = 0u; i < RADIX; ++i)
        store(first + i * constants.done, line, field, v[i]);
}
