#version 460
#extension GL_GOOGLE_include_directive : require

// Lights a surface whose appearance lobe filters. Compiled once for each filter, with its name as a
// macro, without and with LOBE_ENVIRONMENT.

#define LOBE_SET           1
#define LOBE_BINDING_BASE  8
#define LOBE_CONSTANT_BASE 100

#if defined TOKSVIG
#include "lobe/toksvig.glsl"
#elif defined LEAN
#include "lobe/lean.glsl"
#elif defined LOBES
#include "lobe/lobes.glsl"
#else
#include "lobe/moments.glsl"
#endif

#include "own_shading.glsl"

layout(location = 0) in vec3 world_position;
layout(location = 1) in vec3 world_normal;
layout(location = 2) in vec4 world_tangent;
layout(location = 3) in vec4 both_coordinates;
layout(location = 4) in vec4 tint;

layout(location = 0) out vec4 radiance;

lobe_surface own_surface() {
    mat3 frame = lobe_frame(world_normal, world_tangent);
    if (!gl_FrontFacing)
        frame = -frame;
    lobe_surface surface =
        lobe_surface_at(frame, vector(camera.eye) - world_position, both_coordinates.xy,
                        dFdx(both_coordinates.xy), dFdy(both_coordinates.xy));
    surface.coordinates.zw = both_coordinates.zw;
    surface.coordinates_dx.zw = dFdx(both_coordinates.zw);
    surface.coordinates_dy.zw = dFdy(both_coordinates.zw);
    surface.colour = tint;
    surface.curvature = lobe_curvature(dFdx(frame[2]), dFdy(frame[2]), frame);
    // For masks, of which pixels show parts.
    surface.pixel = uvec2(gl_FragCoord.xy);
    surface.depth = dot(normalize(vector(camera.target) - vector(camera.eye)),
                        world_position - vector(camera.eye));
    return surface;
}

void main() {
    lobe_surface surface = own_surface();
    lobe_appearance fetched = lobe_fetch(surface);
    if (!fetched.kept)
        discard;
    vec3 sum = lobe_emission(fetched);
    for (int i = 0; i < lights.length(); ++i) {
        bool point = lights[i].type == POINT;
        vec3 offset = vector(lights[i].position) - world_position;
        vec3 towards = normalize(point ? offset : -vector(lights[i].direction));
        vec3 irradiance = vector(lights[i].intensity) / (point ? dot(offset, offset) : 1.0);
        sum += irradiance * lobe_evaluate(fetched, surface, towards);
    }
#ifdef LOBE_ENVIRONMENT
    sum += lobe_integrate_environment(fetched, surface);
#endif
    radiance = vec4(sum, 1.0);
}
