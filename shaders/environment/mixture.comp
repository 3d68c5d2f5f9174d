#version 460
#extension GL_GOOGLE_include_directive : require

// Filters a cube with GGX lobes, each approximated by a mixture of von Mises-Fisher lobes of all
// concentrations (see passes/environment/mixture.c): a weighted sum of the cubes filtered with
// those lobes, whose concentrations are a factor of two apart.

#include "interface/environment/environment.h"
#include "lib/light/cube_texel.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

// The faces to fill, of four times the level's concentration; this level and those below.
layout(set = 0, binding = 0) uniform sampler2DArray sharpest;
layout(set = 0, binding = 1) uniform samplerCube between;
layout(set = 0, binding = 2) uniform samplerCube lobes;
layout(set = 0, binding = 3) uniform writeonly image2DArray target;

layout(push_constant) uniform constants_block { environment_mixture_constants constants; };

void main() {
    ivec3 position = ivec3(gl_GlobalInvocationID);
    int width = int(constants.width);
    if (any(greaterThanEqual(position.xy, ivec2(width))))
        return;
    int face = position.z + int(constants.first_face);
    vec3 direction = cube_texel_direction(face, position.xy, width);
    vec3 sum = constants.sharpest * texelFetch(sharpest, position, 0).rgb;
    for (int level = 0; level < int(constants.levels); ++level)
        sum += constants.between[level] * textureLod(between, direction, float(level)).rgb +
               constants.lobes[level] * textureLod(lobes, direction, float(level)).rgb;
    imageStore(target, position, vec4(sum, 1.0));
}
