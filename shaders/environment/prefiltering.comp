#version 460
#extension GL_GOOGLE_include_directive : require

// Filters a cube with a von Mises-Fisher lobe about each texel's direction: sums all texels of the
// source within the lobe's cap, weighted by the lobe and their solid angles, and divides by the sum
// of the weights, so that a constant stays constant.

#include "interface/environment/environment.h"
#include "lib/light/cube_texel.glsl"
#include "lib/lobe/spherical_cap.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(set = 0, binding = 0) uniform sampler2DArray source;
layout(set = 0, binding = 1) uniform writeonly image2DArray target;

layout(push_constant) uniform constants_block { environment_prefiltering_constants constants; };

// The lobe is cut off where it has fallen to a thousandth of its peak, exp(-6.9). What is cut off
// is a thousandth of its energy, and of its L2 norm.
const float CUT_OFF = 9.0;

// Solid angle of a texel relative to one in the middle of a face, by the midpoint rule and the next
// term of its series. `square`: 1/(x^2 + y^2 + 1) at the texel's centre. Error 1e-5 on faces 16
// wide.
float relative_solid_angle(float square, float extent) {
    return square * sqrt(square) *
           (1.0 + extent * extent / 24.0 * square * (9.0 - 15.0 * square));
}

vec4 filter_row(spherical_cap cap, int face, int row, float concentration) {
    int size = int(constants.source_width);
    float extent = 2.0 / float(size), y = extent * (float(row) + 0.5) - 1.0;
    ivec2 columns = texels_between(cap_columns(cap, y), size);
    vec4 sum = vec4(0.0);
    for (int column = columns.x; column <= columns.y; ++column) {
        float x = extent * (float(column) + 0.5) - 1.0;
        float square = 1.0 / (x * x + y * y + 1.0);
        vec3 difference = vec3(x, y, 1.0) * sqrt(square) - cap.axis;
        float weight = relative_solid_angle(square, extent) *
                       exp(-0.5 * concentration * dot(difference, difference));
        sum += weight * vec4(texelFetch(source, ivec3(column, row, face), 0).rgb, 1.0);
    }
    return sum;
}

vec4 filter_face(int face, vec3 direction, float concentration) {
    float cosine = 1.0 - CUT_OFF / max(concentration, 1e-6);
    spherical_cap cap = spherical_cap(cube_face_coordinates(face, direction),
                                      sqrt(max(1.0 - cosine * cosine, 0.0)), cosine);
    ivec2 rows = texels_between(cap_rows(cap), int(constants.source_width));
    vec4 sum = vec4(0.0);
    for (int row = rows.x; row <= rows.y; ++row)
        sum += filter_row(cap, face, row, concentration);
    return sum;
}

// The variances of successive filters add up. Linear interpolation between texels t apart is a
// filter of variance t^2/6 along each axis, averaged over positions between the texels.
float remaining_concentration(ivec2 texel) {
    float interpolation =
        constants.interpolation * cube_texel_solid_angle(texel, int(constants.width)) / 6.0;
    float share = constants.concentration * (constants.source_variance + interpolation);
    return constants.concentration / (1.0 - min(share, 0.9));
}

void main() {
    ivec3 position = ivec3(gl_GlobalInvocationID);
    int width = int(constants.width);
    if (any(greaterThanEqual(position.xy, ivec2(width))))
        return;
    int target_face = position.z + int(constants.first_face);
    vec3 direction = cube_texel_direction(target_face, position.xy, width);
    float concentration = remaining_concentration(position.xy);
    vec4 sum = vec4(0.0);
    for (int face = 0; face < 6; ++face)
        sum += filter_face(face, direction, concentration);
    imageStore(target, position, vec4(sum.rgb / sum.a, 1.0));
}
