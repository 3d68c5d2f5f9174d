#version 460
#extension GL_GOOGLE_include_directive : require

// Evaluates points of a material under four lights, one light at a time and all at once, and says
// which the mask keeps. Every other point has an alpha of a quarter.

#define LOBE_SET           1
#define LOBE_CONSTANT_BASE 7

#ifdef LEADR
#define LOBE_WAVES
#include "lobe/leadr.glsl"
#elif defined(MOMENTS)
#include "lobe/moments.glsl"
#else
#include "lobe/lean.glsl"
#endif

layout(local_size_x = 64) in;

layout(set = 0, binding = 0, std430) writeonly buffer result_block { vec4 results[]; };

void main() {
    uint i = gl_GlobalInvocationID.x;
    vec2 uv = vec2(i % 8u, i / 8u) / 8.0;
    lobe_surface surface = lobe_surface_at(mat3(1.0), vec3(0.3, -0.1, 1.0), uv, vec2(0.11, 0.0),
                                           vec2(0.02, 0.13));
    surface.colour.a = i % 2u == 0u ? 1.0 : 0.25;
    lobe_appearance fetched = lobe_fetch(surface);
    vec3 towards[4] = vec3[4](vec3(0.0, 0.0, 1.0), vec3(0.6, 0.0, 0.8), vec3(0.0, -0.6, 0.8),
                              vec3(-0.48, 0.64, 0.6));
    vec3 one_by_one = vec3(0.0), at_once = vec3(0.0);
    for (int k = 0; k < 4; ++k)
        one_by_one += float(1 + k) * lobe_evaluate(fetched, surface, towards[k]);
    lobe_gather(fetched, surface, towards);
    for (int k = 0; k < 4; ++k)
        at_once += float(1 + k) * lobe_evaluate_gathered(fetched, surface, towards[k], uint(k));
    results[2u * i] = vec4(one_by_one, fetched.kept ? 1.0 : 0.0);
    results[2u * i + 1u] = vec4(at_once, 1.0);
}
