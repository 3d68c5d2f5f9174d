#version 460
#extension GL_GOOGLE_include_directive : require

// The heights of a coarse relief, in widths of its cells, whose slopes are nearest to the mean
// slopes of the facets under each cell, by conjugate gradients. One group.
//
// Wu, Zhao, Yan, Ramamoorthi, 2019, Accurate Appearance Preserving Prefiltering for Rendering
// Displacement-Mapped Surfaces, Eq. 9 and 10: the mean over cells of |slope - target|^2 + w
// Laplacian^2. The slopes do not change when a constant is added: the mean height stays 0.

#include "filters/wu/cells.glsl"

const uint THREADS = 128u;
layout(local_size_x = THREADS) in;

layout(push_constant) uniform step_block { wu_step stage; };
layout(set = 0, binding = 4, std430) buffer low_block { float low_heights[]; };
layout(set = 0, binding = 5, std430) readonly buffer slope_block { vec2 slopes[]; };
// Of each vertex: x: residual, y: direction of search, z: its image
layout(set = 0, binding = 6, std430) buffer search_block { vec4 search[]; };
// Of each cell: slopes of what is searched; z: of each vertex: Laplacian
layout(set = 0, binding = 7, std430) buffer product_block { vec4 products[]; };
// Mean and largest height.
layout(set = 0, binding = 8, std430) writeonly buffer low_extent_block { vec4 low_extent; };
layout(set = 0, binding = 9, r32f) uniform writeonly image2D low_map;

const float SMOOTHNESS = 0.01; // w
const int STEPS = 256;
const float TOLERANCE = 1e-12; // of the square of the residual
// Slopes that are this small on average count as so large: of level cells no search would end.
const float LEAST_SLOPE = 1e-3;

shared float partial[THREADS];

wu_level level;
ivec2 size;

int wrapped(int x, int y) {
    x = x < 0 ? x + size.x : x >= size.x ? x - size.x : x;
    y = y < 0 ? y + size.y : y >= size.y ? y - size.y : y;
    return y * size.x + x;
}

float sum_of_all(float own) {
    barrier();
    partial[gl_LocalInvocationIndex] = own;
    barrier();
    float sum = 0.0;
    for (uint i = 0u; i < THREADS; ++i)
        sum += partial[i];
    return sum;
}

void wait_for_all() {
    memoryBarrierBuffer();
    barrier();
}

// What is multiplied: heights in the first product, directions of search later.
float operand(int i, bool first) {
    return first ? low_heights[i] : search[i].y;
}

// Heights are in `unit`, slopes in texels.
vec2 slope_factors() {
    return level.unit / vec2(level.spacing_x, level.spacing_y);
}

vec3 slopes_and_laplacian(int i, bool first) {
    int x = i % size.x, y = i / size.x;
    float h00 = operand(i, first), h10 = operand(wrapped(x + 1, y), first),
          h01 = operand(wrapped(x, y + 1), first), h11 = operand(wrapped(x + 1, y + 1), first);
    float laplacian = h10 + h01 + operand(wrapped(x - 1, y), first) +
                      operand(wrapped(x, y - 1), first) - 4.0 * h00;
    return vec3(0.5 * slope_factors() * vec2(h11 + h10 - h01 - h00, h11 + h01 - h10 - h00),
                laplacian);
}

// The transpose.
float gathered(int i) {
    int x = i % size.x, y = i / size.x;
    vec2 s00 = products[i].xy, s10 = products[wrapped(x - 1, y)].xy,
         s01 = products[wrapped(x, y - 1)].xy, s11 = products[wrapped(x - 1, y - 1)].xy;
    float laplacian = products[wrapped(x + 1, y)].z + products[wrapped(x - 1, y)].z +
                      products[wrapped(x, y + 1)].z + products[wrapped(x, y - 1)].z -
                      4.0 * products[i].z;
    vec2 sums = vec2(s11.x + s10.x - s01.x - s00.x, s11.y + s01.y - s10.y - s00.y);
    return dot(0.5 * slope_factors(), sums) + SMOOTHNESS * laplacian;
}

void multiply(int count, bool first) {
    wait_for_all();
    for (int i = int(gl_LocalInvocationIndex); i < count; i += int(THREADS)) {
        vec3 product = slopes_and_laplacian(i, first);
        if (first)
            product = vec3(slopes[i] - product.xy, -product.z);
        products[i] = vec4(product, 0.0);
    }
    wait_for_all();
}

void start(int count) {
    multiply(count, true);
    for (int i = int(gl_LocalInvocationIndex); i < count; i += int(THREADS)) {
        float residual = gathered(i);
        search[i] = vec4(residual, residual, 0.0, 0.0);
    }
}

float square_of_targets(int count) {
    float sum = 0.0;
    for (int i = int(gl_LocalInvocationIndex); i < count; i += int(THREADS))
        sum += dot(slopes[i], slopes[i]);
    return max(sum_of_all(sum), LEAST_SLOPE * LEAST_SLOPE * float(count));
}

float square_of_residual(int count) {
    float sum = 0.0;
    for (int i = int(gl_LocalInvocationIndex); i < count; i += int(THREADS))
        sum += search[i].x * search[i].x;
    return sum_of_all(sum);
}

// One step; returns the square of the new residual.
float improve(int count, float square) {
    multiply(count, false);
    float curvature = 0.0;
    for (int i = int(gl_LocalInvocationIndex); i < count; i += int(THREADS)) {
        float image = gathered(i);
        search[i].z = image;
        curvature += search[i].y * image;
    }
    float advance = square / max(sum_of_all(curvature), 1e-30);
    for (int i = int(gl_LocalInvocationIndex); i < count; i += int(THREADS)) {
        low_heights[i] += advance * search[i].y;
        search[i].x -= advance * search[i].z;
    }
    float next = square_of_residual(count);
    for (int i = int(gl_LocalInvocationIndex); i < count; i += int(THREADS))
        search[i].y = search[i].x + next / square * search[i].y;
    return next;
}

void finish(int count) {
    float sum = 0.0, largest = -1e30;
    for (int i = int(gl_LocalInvocationIndex); i < count; i += int(THREADS))
        sum += low_heights[i];
    float mean = sum_of_all(sum) / float(count);
    for (int i = int(gl_LocalInvocationIndex); i < count; i += int(THREADS)) {
        float height = low_heights[i] - mean;
        imageStore(low_map, ivec2(i % size.x, i / size.x), vec4(height));
        largest = max(largest, height);
    }
    barrier();
    partial[gl_LocalInvocationIndex] = largest;
    barrier();
    if (gl_LocalInvocationIndex != 0u)
        return;
    for (uint i = 0u; i < THREADS; ++i)
        largest = max(largest, partial[i]);
    low_extent = vec4(0.0, largest, 0.0, 0.0);
}

void main() {
    level = wu.levels[stage.level];
    size = ivec2(level.width, level.height);
    int count = size.x * size.y;
    start(count);
    float square = square_of_residual(count), enough = TOLERANCE * square_of_targets(count);
    for (int i = 0; i < STEPS && square > enough; ++i)
        square = improve(count, square);
    finish(count);
}
