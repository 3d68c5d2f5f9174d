#version 460
#extension GL_GOOGLE_include_directive : require

// The lobes of a cell: a mixture of von Mises-Fisher lobes of the normals of the facets under it,
// weighted with their areas, by expectation maximisation. A thread a cell.
//
// Han, Sun, Ramamoorthi, Grinspun, 2007, Frequency Domain Normal Map Filtering, section 4.2;
// Banerjee et al., 2005, Clustering on the Unit Hypersphere, Eq. 4.4 for the concentration.

#define CELL_ACCESS
#include "filters/displaced/height_field.glsl"
#include "filters/wu/cells.glsl"
#include "lib/number/hash.glsl"

layout(local_size_x = 64) in;

layout(push_constant) uniform step_block { wu_step stage; };

const int ITERATIONS = 16;
const int QUADS = 32; // of a cell that are looked at, along each axis
const float LEAST_CONCENTRATION = 0.1, MOST_CONCENTRATION = 1e4;

// Facets of a cell.
struct facet_range {
    ivec2 first, count; // quads
    ivec2 looked;       // at most QUADS
};

// A facet's normal over its z, of squared length a^2; w: a, its area.
vec4 facet_sample(facet_range range, ivec2 place, bool upper) {
    ivec2 low = place * range.count / range.looked, high = (place + 1) * range.count / range.looked;
    uint seed = uint(place.y * QUADS + place.x);
    vec2 within = vec2(hashed_number(2u * seed), hashed_number(2u * seed + 1u));
    ivec2 quad = range.first + low + ivec2(vec2(high - low) * within);
    vec3 normal = vec3(-facet_slope(quad_heights(quad), upper), 1.0);
    float area = length(normal);
    return vec4(normal / area, area);
}

vec4 lobes[WU_MAXIMUM_LOBES];
vec4 sums[WU_MAXIMUM_LOBES];

// Around the mean slope: one lobe there, the others on an ellipse as wide as the slopes.
void guess(facet_range range) {
    vec2 mean = vec2(0.0), square = vec2(0.0);
    float count = 2.0 * float(range.looked.x * range.looked.y), area = 0.0;
    for (int y = 0; y < range.looked.y; ++y)
        for (int x = 0; x < range.looked.x; ++x)
            for (int k = 0; k < 2; ++k) {
                vec4 facet = facet_sample(range, ivec2(x, y), k == 1);
                vec2 slope = -facet.xy / facet.z;
                mean += slope / count;
                square += slope * slope / count;
                area += facet.w / count;
            }
    vec2 width = sqrt(max(square - mean * mean, vec2(1e-8)));
    float spread = 0.5 * dot(width, width);
    for (uint i = 0u; i < WU_LOBES; ++i) {
        float angle = 2.0 * PI * float(i) / float(max(WU_LOBES - 1u, 1u));
        vec2 slope = mean + (i == 0u ? vec2(0.0) : 1.2 * width * vec2(cos(angle), sin(angle)));
        lobes[i] = vec4(normalize(vec3(-slope, 1.0)) * area / float(WU_LOBES),
                        clamp(1.0 / spread, LEAST_CONCENTRATION, MOST_CONCENTRATION));
    }
}

// The logarithm of a lobe's density, up to a constant.
float log_density(vec4 lobe, vec3 normal) {
    float weight = length(lobe.xyz);
    return weight > 0.0 ? log(weight * lobe.w / (1.0 - exp(-2.0 * lobe.w))) +
                              lobe.w * (dot(lobe.xyz / weight, normal) - 1.0)
                        : -1e30;
}

void share_out(vec4 facet, float count) {
    float densities[WU_MAXIMUM_LOBES];
    float largest = -1e30, sum = 0.0;
    for (uint i = 0u; i < WU_LOBES; ++i) {
        densities[i] = log_density(lobes[i], facet.xyz);
        largest = max(largest, densities[i]);
    }
    for (uint i = 0u; i < WU_LOBES; ++i) {
        densities[i] = exp(densities[i] - largest);
        sum += densities[i];
    }
    for (uint i = 0u; i < WU_LOBES; ++i)
        sums[i] += facet.w * densities[i] / (sum * count) * vec4(facet.xyz, 1.0);
}

float concentration_of(float mean_length) {
    float square = min(mean_length * mean_length, 1.0);
    return clamp(mean_length * (3.0 - square) / max(1.0 - square, 1e-6), LEAST_CONCENTRATION,
                 MOST_CONCENTRATION);
}

void fit(facet_range range) {
    float count = 2.0 * float(range.looked.x * range.looked.y);
    for (uint i = 0u; i < WU_LOBES; ++i)
        sums[i] = vec4(0.0);
    for (int y = 0; y < range.looked.y; ++y)
        for (int x = 0; x < range.looked.x; ++x) {
            share_out(facet_sample(range, ivec2(x, y), false), count);
            share_out(facet_sample(range, ivec2(x, y), true), count);
        }
    for (uint i = 0u; i < WU_LOBES; ++i) {
        float size = length(sums[i].xyz);
        lobes[i] = size > 1e-6 ? vec4(sums[i].xyz * (sums[i].w / size),
                                      concentration_of(size / sums[i].w))
                               : vec4(0.0, 0.0, 0.0, LEAST_CONCENTRATION);
    }
}

// Facets cover the base once: the sum of weights times the mean cosine to it is 1.
float covered() {
    float sum = 0.0;
    for (uint i = 0u; i < WU_LOBES; ++i)
        sum += lobes[i].z * (1.0 / tanh(min(lobes[i].w, 40.0)) - 1.0 / lobes[i].w);
    return sum;
}

void main() {
    wu_level level = wu.levels[stage.level];
    uint index = gl_GlobalInvocationID.x;
    if (index >= level.width * level.height)
        return;
    ivec2 cell = ivec2(index % level.width, index / level.width);
    ivec2 size = ivec2(level.width, level.height);
    facet_range range;
    range.first = cell * relief_size() / size;
    range.count = (cell + 1) * relief_size() / size - range.first;
    range.looked = min(range.count, ivec2(QUADS));
    guess(range);
    for (int i = 0; i < ITERATIONS; ++i)
        fit(range);
    float scale = 1.0 / max(covered(), 1e-3);
    for (uint i = 0u; i < WU_MAXIMUM_LOBES; ++i)
        cells[level.first_cell + index].lobes[i] =
            i < WU_LOBES ? vec4(scale * lobes[i].xyz, lobes[i].w) : vec4(0.0);
}
