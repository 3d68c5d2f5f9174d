#version 460
#extension GL_GOOGLE_include_directive : require

// What moment_refit must know of a material's lobes: the extremes of those of all texels, and a
// sample of them, one group for each cell of the lobe grid. Reads all texels: what few of them
// have, a sample at regular distances misses. Of large maps that change often it may read a part,
// one at random in each square of a grid: the time then does not grow with the map. Texels are
// drawn with a probability proportional to a density, and stand for the inverse of it; as it grows
// with the squared distance from what is usual, the sample also has what is rare (Bachem, Lucic,
// Krause 2018, Scalable k-Means Clustering via Lightweight Coresets). What a mask cuts away is in
// the sample as little as it counts in the maps. All sums are in a fixed order.

#include "interface/moment_bins.h"
#include "interface/moment_refit.h"
#include "lib/lobe/half_vector_lobe.glsl"
#include "lib/lobe/lambert_plane.glsl"
#include "lib/lobe/plane_lobe.glsl"
#include "lib/number/hash.glsl"
#include "maps/base_maps.glsl"

const uint THREADS = 64; // and as many texels of all the maps tell what is usual, 8 by 8

layout(local_size_x = THREADS) in;

layout(constant_id = SPECIALISE_BRIGHT_TEXELS) const bool BRIGHT_TEXELS = false;

layout(set = 0, binding = 7) uniform sampler2D specular_map;
layout(set = 0, binding = 16, std430) writeonly buffer extremes_block {
    survey_extremes extremes[];
};
layout(set = 0, binding = 17, std430) writeonly buffer lobes_block { vec4 lobes[]; };

layout(push_constant) uniform constants_block { cell_survey_constants constants; };

// One number or two of each thread, for what the group makes of them.
shared vec4 first[THREADS];
shared vec4 second[THREADS];

// ---------------------------------------------------------------------------------------------
// Texels

struct grid_texel {
    vec3 normal;
    float factor; // of the widths
    float weight; // how much it counts, see base_maps.glsl
};

// A map's texel at one of the grid.
vec4 fetch_texel(sampler2D map, uvec2 position) {
    uvec2 size = uvec2(textureSize(map, 0));
    return texelFetch(map, ivec2(position * size / uvec2(constants.width, constants.height)), 0);
}

grid_texel stored_texel(uvec2 position) {
    grid_texel texel = grid_texel(vec3(0.0, 0.0, 1.0), material.width_factor, 1.0);
    if (has_map(MAP_NORMAL))
        texel.normal =
            decode_normal(fetch_texel(normal_map, position).xyz, material.normal_scale, NORMALS);
    if (has_map(MAP_WIDTH)) {
        vec4 value = finite_or_zero(fetch_texel(width_map, position));
        texel.factor = MODEL == MODEL_MICROFACET ? value.g : value.r;
    }
    if (MASKED_LOBES)
        texel.weight = weight_of_alpha(finite_or_zero(fetch_texel(base_colour_map, position)).a,
                                       constants.alpha, constants.cutoff);
    if (!MANY_POINTS && texel.weight < 1.0)
        texel.normal = vec3(0.0, 0.0, 1.0); // as normal_at
    return texel;
}

// What stands for a texel: itself or, where a mask may cut a part of it away, one of its points at
// random.
grid_texel read_texel(uvec2 position) {
    if (!MANY_POINTS)
        return stored_texel(position);
    uint index = hash(position.x + hash(position.y)) % uint(POINTS);
    vec2 point = map_point(ivec2(position), int(index), ivec2(constants.width, constants.height));
    return grid_texel(normal_at(point, constants.alpha, constants.cutoff), width_at(point),
                      weight_of_point(point, constants.alpha, constants.cutoff));
}

// The largest of its colours.
float brightness_of_texel(uvec2 position) {
    vec3 colour = max(finite_or_zero(fetch_texel(base_colour_map, position)).rgb,
                      finite_or_zero(fetch_texel(specular_map, position)).rgb);
    return max(max(colour.r, colour.g), max(colour.b, 1.0));
}

float logarithm_of_width(grid_texel texel) {
    return log2(clamp(texel.factor, 1e-37, 1e37));
}

// ---------------------------------------------------------------------------------------------
// What most texels have, to find those that differ

struct usual_texel {
    vec2 place;
    float spread; // variance of places and base lobes, summed over both axes
    float width;  // mean logarithm of the factor of widths
    float varies; // its variance
};

// Sums of both numbers over the group.
void add_up(uint thread) {
    for (uint half_size = THREADS / 2; half_size > 0; half_size /= 2) {
        barrier();
        if (thread < half_size) {
            first[thread] += first[thread + half_size];
            second[thread] += second[thread + half_size];
        }
    }
    barrier();
}

// All groups find the same.
usual_texel find_usual(uint thread) {
    uvec2 cell = uvec2(thread % 8u, thread / 8u);
    vec2 part = (vec2(cell) + vec2(hashed_number(2u * thread), hashed_number(2u * thread + 1u))) /
                8.0;
    uvec2 size = uvec2(constants.width, constants.height);
    grid_texel texel = read_texel(min(uvec2(part * vec2(size)), size - 1u));
    vec2 place = plane_from_direction(texel.normal);
    float width = logarithm_of_width(texel);
    first[thread] = texel.weight *
                    vec4(place, dot(place, place),
                         plane_variance(DISTRIBUTION, base_parameter(0, texel.factor)));
    second[thread] = texel.weight * vec4(width, width * width, 1.0, 0.0);
    add_up(thread);
    vec4 mean = first[0] / second[0].z, widths = second[0] / second[0].z;
    barrier();
    return usual_texel(mean.xy, max(mean.z - dot(mean.xy, mean.xy), 0.0) + 2.0 * mean.w, widths.x,
                       max(widths.y - widths.x * widths.x, 0.01));
}

// Half of the texels are drawn everywhere alike, the others by how much they differ from what is
// usual, in squares of the usual differences.
float density_of(grid_texel texel, usual_texel usual) {
    vec2 d = plane_from_direction(texel.normal) - usual.place;
    float width = logarithm_of_width(texel) - usual.width;
    return texel.weight *
           min(0.5 + 0.25 * dot(d, d) / usual.spread + 0.25 * width * width / usual.varies, 1e6);
}

// ---------------------------------------------------------------------------------------------
// The cell

// Its texels, and how many of them are read along each axis, row by row.
struct grid_cell {
    uvec2 low, size, read;
};

grid_cell find_cell(uint index) {
    uvec2 position = uvec2(index % constants.columns, index / constants.columns);
    uvec2 size = uvec2(constants.width, constants.height);
    uvec2 count = uvec2(constants.columns, constants.rows);
    uvec2 low = position * size / count;
    size = (position + 1u) * size / count - low;
    return grid_cell(low, size, constants.part > 0u ? min(size, constants.part) : size);
}

uvec2 texel_of_cell(grid_cell cell, uint index) {
    uvec2 position = uvec2(index % cell.read.x, index / cell.read.x);
    if (cell.read == cell.size)
        return cell.low + position;
    uint number = gl_WorkGroupID.x * SURVEY_PART * SURVEY_PART + index;
    vec2 place = vec2(hashed_number(2u * number), hashed_number(2u * number + 1u));
    uvec2 begin = position * cell.size / cell.read;
    uvec2 count = (position + 1u) * cell.size / cell.read - begin;
    return cell.low + begin + min(uvec2(place * vec2(count)), count - 1u);
}

uint read_count(grid_cell cell) {
    return cell.read.x * cell.read.y;
}

// How many texels one that is read stands for.
float weight_of_read(grid_cell cell) {
    return float(cell.size.x * cell.size.y) / float(read_count(cell));
}

vec3 direction_of_lobe(int i, grid_texel texel) {
    return MODEL == MODEL_MICROFACET
               ? texel.normal
               : rotate_from_pole(texel.normal, material.lobe_direction[i].xyz);
}

void extend(inout survey_extremes least, grid_texel texel) {
    for (int i = 0; i < LOBE_COUNT; ++i) {
        vec3 direction = direction_of_lobe(i, texel);
        vec2 place = plane_from_direction(direction), reach = reach_from_direction(direction);
        least.places = min(least.places, vec4(min(place, reach), min(-place, -reach)));
    }
    least.factors.xy = min(least.factors.xy, vec2(texel.factor, -texel.factor));
}

// Leaves the group's in the first thread's numbers.
void write_extremes(uint thread, survey_extremes own) {
    first[thread] = own.places;
    second[thread] = own.factors;
    for (uint half_size = THREADS / 2; half_size > 0; half_size /= 2) {
        barrier();
        if (thread < half_size) {
            first[thread] = min(first[thread], first[thread + half_size]);
            second[thread] = min(second[thread], second[thread + half_size]);
        }
    }
    if (thread == 0)
        extremes[gl_WorkGroupID.x] = survey_extremes(first[0], second[0]);
}

// ---------------------------------------------------------------------------------------------
// The sample

// Turns the threads' sums of densities into where each one's part of the cell's ends.
void line_up(uint thread, float sum) {
    barrier();
    first[thread].x = sum;
    barrier();
    if (thread == 0) {
        for (uint i = 1; i < THREADS; ++i)
            first[i].x += first[i - 1].x;
    }
    barrier();
}

void write_lobes(uint draw, grid_texel texel, float weight) {
    for (int i = 0; i < LOBE_COUNT; ++i) {
        float variance = plane_variance(DISTRIBUTION, base_parameter(i, texel.factor));
        float share = MODEL == MODEL_MICROFACET ? 1.0 : material.lobe_colour[i].w;
        lobes[(gl_WorkGroupID.x * SURVEY_DRAWS + draw) * LOBE_COUNT + i] =
            vec4(plane_from_direction(direction_of_lobe(i, texel)), variance, weight * share);
    }
}

// The texel of this thread's at which its sum of densities exceeds `target`.
grid_texel find_texel(uint thread, grid_cell cell, usual_texel usual, float target,
                      out float density) {
    grid_texel texel;
    float sum = 0.0;
    for (uint i = thread; i < read_count(cell) && sum <= target; i += THREADS) {
        texel = read_texel(texel_of_cell(cell, i));
        density = density_of(texel, usual);
        sum += density;
    }
    return texel;
}

// Equal parts of the cell's density each give a texel, at a place hashed from the part's number.
void draw_texels(uint thread, grid_cell cell, usual_texel usual, float sum) {
    line_up(thread, sum);
    float begin = thread == 0 ? 0.0 : first[thread - 1].x, end = first[thread].x;
    float part = first[THREADS - 1].x / float(SURVEY_DRAWS);
    for (uint draw = 0; draw < SURVEY_DRAWS; ++draw) {
        float number = hashed_number(gl_WorkGroupID.x * SURVEY_DRAWS + draw);
        // Below the sum of all, however it is rounded.
        float target = (float(draw) + min(number, 0.9999)) * part;
        if (target < begin || target >= end)
            continue;
        float density;
        grid_texel texel = find_texel(thread, cell, usual, target - begin, density);
        write_lobes(draw, texel, weight_of_read(cell) * texel.weight * part / density);
    }
}

void main() {
    uint thread = gl_LocalInvocationID.x;
    usual_texel usual = find_usual(thread);
    grid_cell cell = find_cell(gl_WorkGroupID.x);
    survey_extremes least = survey_extremes(vec4(1e30), vec4(1e30, 1e30, -1.0, 0.0));
    float sum = 0.0;
    for (uint i = thread; i < read_count(cell); i += THREADS) {
        uvec2 position = texel_of_cell(cell, i);
        grid_texel texel = read_texel(position);
        sum += density_of(texel, usual);
        // Whatever is interpolated lies between the texels themselves.
        if (MANY_POINTS)
            texel = stored_texel(position);
        extend(least, texel);
        if (BRIGHT_TEXELS)
            least.factors.z = min(least.factors.z, -brightness_of_texel(position));
    }
    write_extremes(thread, least);
    draw_texels(thread, cell, usual, sum);
}
