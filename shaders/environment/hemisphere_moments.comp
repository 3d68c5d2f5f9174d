#version 460
#extension GL_GOOGLE_include_directive : require

// The moments of an environment's light over the hemisphere of each normal
// (interface/environment/hemisphere_moments.h): the sum over the texels of a cube, each a light in
// the direction of its centre.

#include "interface/environment/hemisphere_moments.h"
#include "lib/light/cube_texel.glsl"
#include "lib/light/octahedron.glsl"

layout(local_size_x = 64) in;

layout(set = 0, binding = 0) uniform sampler2DArray environment;
layout(set = 0, binding = 1) uniform writeonly image2DArray moments;

layout(push_constant) uniform constants_block { hemisphere_moments_constants constants; };

void main() {
    const int width = HEMISPHERE_MOMENTS_SIZE + 2;
    int index = int(gl_GlobalInvocationID.x);
    ivec2 place = ivec2(index % width, index / width);
    vec3 normal = octahedron_texel_direction(place, HEMISPHERE_MOMENTS_SIZE);
    int size = int(constants.size);
    mat4 sums[4] = mat4[4](mat4(0.0), mat4(0.0), mat4(0.0), mat4(0.0)); // of uniform light, too
    vec4 mean = vec4(0.0);
    for (ivec3 texel = ivec3(0); texel.z < 6; texel = next_cube_texel(texel, size)) {
        vec3 d = cube_texel_direction(texel.z, texel.xy, size);
        vec4 power = cube_texel_solid_angle(texel.xy, size) *
                     vec4(texelFetch(environment, texel, 0).rgb, 1.0);
        vec4 light = max(dot(normal, d), 0.0) * power;
        mean += power;
        float xx = d.x * d.x, yy = d.y * d.y, zz = d.z * d.z, xy = d.x * d.y;
        mat4 monomials = mat4(vec4(xx * d.x, xx * d.y, xx * d.z, d.x * yy),
                              vec4(xy * d.z, d.x * zz, d.y * yy, yy * d.z),
                              vec4(d.y * zz, d.z * zz, xx, xy),
                              vec4(d.x * d.z, yy, d.y * d.z, zz));
        for (int c = 0; c < 4; ++c)
            sums[c] += light[c] * monomials;
    }
    if (place.y >= width)
        return;
    mean /= mean.w;
    const int last = HEMISPHERE_MOMENT_LAYERS - 1;
    for (int layer = 0; layer < last; ++layer)
        imageStore(moments, ivec3(place, layer),
                   sums[layer / 4][layer % 4] - mean[layer / 4] * sums[3][layer % 4]);
    imageStore(moments, ivec3(place, last), mean);
}
