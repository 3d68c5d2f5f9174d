#version 460
#extension GL_GOOGLE_include_directive : require
#pragma variants LAST

// Fourier transforms of all rows, or all columns, of all fields: one a group, in shared memory. The
// form for GPUs; fft_step.comp has the method.

#include "ocean/butterfly.glsl"

const uint THREADS = 64u;
layout(local_size_x = 64) in;

layout(constant_id = SPECIALISE_LINE) const uint LINE = 512;
layout(constant_id = SPECIALISE_RADIX) const uint LAST_RADIX = 8;

layout(set = 0, binding = 0, std430) readonly buffer source_block { vec4 source[]; };
layout(set = 0, binding = 1, std430) readonly buffer root_block { vec2 roots[]; };
#ifdef LAST
layout(set = 0, binding = 2, rgba32f) writeonly uniform image2DArray target;
#else
layout(set = 0, binding = 2, std430) writeonly buffer target_block { vec4 target[]; };
#endif

layout(push_constant) uniform constants_block { ocean_fft_constants constants; };

// Numbers in a line, at most 1024: 16 KiB.
shared vec4 numbers[LINE];

uint line() {
    return gl_WorkGroupID.x;
}

uint steps_of(uint element) {
    uint field = gl_WorkGroupID.z * LINE * LINE;
    return field + (constants.columns != 0u ? element * LINE + line() : line() * LINE + element);
}

void store(uint element, vec4 value) {
#ifdef LAST
    uvec2 place = constants.columns != 0u ? uvec2(line(), element) : uvec2(element, line());
    imageStore(target, ivec3(place, gl_WorkGroupID.z), value);
#else
    target[steps_of(element)] = value;
#endif
}

// One step over the numbers of the group. All threads read theirs before any writes.
void run_step(uint radix, uint done) {
    uint parts = LINE / radix;
    vec4 v[16]; // of up to two small transforms of eight, or eight of two
    uint rounds = (parts + THREADS - 1u) / THREADS;
    for (uint j = 0u; j < rounds; ++j) {
        uint part = gl_LocalInvocationID.x + j * THREADS;
        for (uint i = 0u; part < parts && i < radix; ++i)
            v[j * radix + i] = numbers[part + i * parts];
    }
    barrier();
    for (uint j = 0u; j < rounds; ++j) {
        uint part = gl_LocalInvocationID.x + j * THREADS;
        if (part < parts) {
            uint within = part % done, turn = within * (parts / done);
            vec4 small[8];
            for (uint i = 0u; i < radix; ++i)
                small[i] = i == 0u ? v[j * radix]
                                   : pair_times(v[j * radix + i], roots[i * turn]);
            transform(radix, small);
            for (uint i = 0u; i < radix; ++i)
                numbers[(part - within) * radix + within + i * done] = small[i];
        }
    }
    barrier();
}

void main() {
    for (uint i = gl_LocalInvocationID.x; i < LINE; i += THREADS)
        numbers[i] = source[steps_of(i)];
    barrier();
    uint done = 1u;
    for (; done * 8u <= LINE; done *= 8u)
        run_step(8u, done);
    if (LAST_RADIX > 1u)
        run_step(LAST_RADIX, done);
    for (uint i = gl_LocalInvocationID.x; i < LINE; i += THREADS)
        store(i, numbers[i]);
}
