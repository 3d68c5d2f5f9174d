#ifndef WU_CELLS_GLSL
#define WU_CELLS_GLSL

// Models of a relief (interface/displacement/wu.h): what their cells see and reflect.

#include "interface/displacement/wu.h"
#include "lib/number/constants.glsl"

#ifndef LOBE_DESCRIPTOR
#define LOBE_DESCRIPTOR(number) set = 0, binding = number
#endif
#ifndef CELL_ACCESS
#define CELL_ACCESS readonly
#endif

layout(constant_id = SPECIALISE_WU_LOBES) const uint WU_LOBES = 6;

layout(LOBE_DESCRIPTOR(36), std140) uniform wu_block { wu_constants wu; };
layout(LOBE_DESCRIPTOR(37), std430) CELL_ACCESS buffer cell_block { wu_cell cells[]; };

bool is_printed(uint formula) {
    return (wu.printed & formula) != 0u;
}

// The cell of a point of the relief.
uint cell_at(wu_level level, vec2 position) {
    ivec2 size = ivec2(level.width, level.height);
    ivec2 cell = ivec2(floor(position / vec2(level.spacing_x, level.spacing_y)));
    cell -= size * ivec2(floor(vec2(cell) / vec2(size)));
    cell = clamp(cell, ivec2(0), size - 1);
    return level.first_cell + uint(cell.y * size.x + cell.x);
}

// Of the mirrors' numbers, those of one level: S, then T's numerator and denominator of each patch.
uint mirror_stride() {
    uint directions = wu.angular * wu.angular;
    return directions * directions + 2u * wu.patches * wu.patches;
}

// The patches that a cell covers, or, if it is smaller than these, the two by two whose middles are
// around its own, by their distances: a number for each patch would show the patches' borders.
struct patch_range {
    ivec2 first, last; // may lie beyond the map
    vec2 between;
};

patch_range patches_of_cell(uint level_index, uint cell) {
    wu_level level = wu.levels[level_index];
    uint index = cell - level.first_cell;
    ivec2 place = ivec2(index % level.width, index / level.width),
          size = ivec2(level.width, level.height);
    int patches = int(wu.patches);
    patch_range range;
    for (int k = 0; k < 2; ++k) {
        bool within = size[k] >= patches;
        float middle = (float(place[k]) + 0.5) * float(patches) / float(size[k]) - 0.5;
        range.first[k] = within ? int(floor(middle)) : place[k] * patches / size[k];
        range.last[k] = within ? range.first[k] + 1
                               : ((place[k] + 1) * patches + size[k] - 1) / size[k] - 1;
        range.between[k] = within ? fract(middle) : 0.5;
    }
    return range;
}

uint patch_index(ivec2 place) {
    ivec2 wrapped = (place + int(wu.patches)) % int(wu.patches);
    return uint(wrapped.y) * wu.patches + uint(wrapped.x);
}

float patch_weight(patch_range range, ivec2 place) {
    vec2 weights = mix(1.0 - range.between, range.between, greaterThan(place, range.first));
    return weights.x * weights.y;
}

// ---------------------------------------------------------------------------------------------
// Visibility of the coarse relief

// What a direction sees of both facets of a cell.
struct seen_facets {
    vec2 parts; // of each facet
    vec2 areas; // of these parts as they appear from there, over that of the cell's base
};

seen_facets facets_seen(uint cell, vec3 direction) {
    vec4 slopes = cells[cell].slopes;
    vec2 areas = direction.z - vec2(dot(slopes.xy, direction.xy), dot(slopes.zw, direction.xy));
    float place = atan(direction.y, direction.x) * (float(WU_AZIMUTHS) / (2.0 * PI));
    if (direction.x == 0.0 && direction.y == 0.0)
        place = 0.0;
    place += place < 0.0 ? float(WU_AZIMUTHS) : 0.0;
    uint first = min(uint(place), uint(WU_AZIMUTHS - 1)), next = (first + 1u) % WU_AZIMUTHS;
    vec4 horizons = mix(unpackUnorm4x8(cells[cell].horizons[first]),
                        unpackUnorm4x8(cells[cell].horizons[next]), fract(place));
    vec2 parts = clamp((direction.z - horizons.xz) / max(horizons.yw - horizons.xz, 1e-4), 0.0,
                       1.0);
    return seen_facets(parts, parts * max(areas, 0.0));
}

float part_seen(seen_facets seen) {
    return 0.5 * (seen.parts.x + seen.parts.y);
}

// The part of a cell that both directions see: what is high is seen by both.
float seen_by_both(seen_facets one, seen_facets other) {
    vec2 both = min(one.parts, other.parts);
    return 0.5 * (both.x + both.y);
}

// The same for Eq. 5 as it is printed: light on the coarse relief's facets, by their areas that the
// viewer sees, over the cosine to the base.
float seen_by_both_printed(uint cell, seen_facets seen, seen_facets lit, float cosine) {
    vec4 slopes = cells[cell].slopes;
    vec2 normals = inversesqrt(1.0 + vec2(dot(slopes.xy, slopes.xy), dot(slopes.zw, slopes.zw)));
    return 0.5 * dot(seen.areas * lit.areas, normals) / max(cosine, 1e-3);
}

// ---------------------------------------------------------------------------------------------
// Lobes of normals

// Fisher, 1953, Dispersion on a Sphere: the cosine to the axis that a part of the normals exceeds.
float lobe_cosine(float concentration, float part) {
    return max(1.0 + log(part + (1.0 - part) * exp(-2.0 * concentration)) / concentration, -1.0);
}

// A frame whose z is the axis. Duff et al., 2017, Building an Orthonormal Basis, Revisited.
mat3 frame_of_axis(vec3 axis) {
    float sign_z = axis.z < 0.0 ? -1.0 : 1.0;
    float a = -1.0 / (sign_z + axis.z), b = axis.x * axis.y * a;
    return mat3(vec3(1.0 + sign_z * axis.x * axis.x * a, sign_z * b, -sign_z * axis.x),
                vec3(b, sign_z + axis.y * axis.y * a, -axis.y), axis);
}

// Of the inner and outer half of a narrow lobe, the normals of mean distance: exp(ln 2 - 1) and
// exp(-ln 2 - 1).
const float INNER_PART = 0.735758882;
const float OUTER_PART = 0.183939721;

// Eight normals that stand for a lobe.
struct lobe_normals {
    vec3 normals[8];
};

lobe_normals normals_of_lobe(vec3 axis, float concentration) {
    mat3 frame = frame_of_axis(axis);
    lobe_normals result;
    for (int ring = 0; ring < 2; ++ring) {
        float cosine = lobe_cosine(concentration, ring == 0 ? INNER_PART : OUTER_PART);
        float sine = sqrt(max(1.0 - cosine * cosine, 0.0));
        // Eighths of a turn, the odd ones in the outer ring.
        vec2 along = ring == 0 ? vec2(1.0, 0.0) : vec2(0.707106781, 0.707106781);
        for (int i = 0; i < 4; ++i) {
            result.normals[4 * ring + i] = frame * vec3(sine * along, cosine);
            along = vec2(-along.y, along.x);
        }
    }
    return result;
}

// Of a lobe as cells keep it.
lobe_normals normals_of_weighted(vec4 lobe, float weight) {
    return normals_of_lobe(weight > 0.0 ? lobe.xyz / weight : vec3(0.0, 0.0, 1.0), lobe.w);
}

#endif
