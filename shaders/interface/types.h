#ifndef INTERFACE_TYPES_H
#define INTERFACE_TYPES_H

// One description of each structure for C and GLSL. Only types whose layout is the same in C,
// std140 and std430 are used: 4-byte scalars in groups of four, uint4, float4 and float4x4.

#ifdef VULKAN // GLSL
#define uint4    uvec4
#define float4   vec4
#define float4x4 mat4
#define INTERFACE_SIZE(type, bytes)
#define INTERFACE_OFFSET(type, member, bytes)
#else // C
#include <assert.h>
#include <stddef.h>
#include <stdint.h>
typedef uint32_t uint;
typedef uint uint4[4];
typedef float float4[4];
typedef float float4x4[16]; // columns
#define INTERFACE_SIZE(type, bytes)                                                                \
    static_assert(sizeof(struct type) == (bytes), "layout of " #type " differs from GLSL");
#define INTERFACE_OFFSET(type, member, bytes)                                                      \
    static_assert(offsetof(struct type, member) == (bytes), "layout of " #type "." #member);
#endif

#endif
