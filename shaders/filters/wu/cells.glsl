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

// The patches that a cell covers, or is in.
struct patch_range {
    uvec2 first, last;
};

patch_range patches_of_cell(uint level_index, uint cell) {
    wu_level level = wu.levels[level_index];
    uint index = cell - level.first_cell;
    uvec2 place = uvec2(index % level.width, index / level.width),
          size = uvec2(level.width, level.height);
    patch_range range;
    for (int k = 0; k < 2; ++k) {
        bool within = size[k] >= wu.patches;
        range.first[k] = within ? (2u * place[k] + 1u) * wu.patches / (2u * size[k])
                                : place[k] * wu.patches / size[k];
        range.last[k] = within ? range.first[k]
                               : ((place[k] + 1u) * wu.patches + size[k] - 1u) / size[k] - 1u;
    }
    return range;
}

// ---------------------------------------------------------------------------------------------
// Visibility of the coarse relief

// The area of both facets of a cell that is seen from a direction, over that of the cell's base.
// 0: nothing is seen.
vec2 seen_areas(uint cell, vec3 direction) {
    vec4 slopes = cells[cell].slopes;
    vec2 areas = direction.z - vec2(dot(slopes.xy, direction.xy), dot(slopes.zw, direction.xy));
    float place = atan(direction.y, direction.x) * (float(WU_AZIMUTHS) / (2.0 * PI));
    if (direction.x == 0.0 && direction.y == 0.0)
        place = 0.0;
    place += place < 0.0 ? float(WU_AZIMUTHS) : 0.0;
    uint first = min(uint(place), uint(WU_AZIMUTHS - 1)), next = (first + 1u) % WU_AZIMUTHS;
    vec2 horizon = mix(unpackHalf2x16(cells[cell].horizons[first]),
                       unpackHalf2x16(cells[cell].horizons[next]), fract(place));
    vec2 above = direction.z - horizon * length(direction.xy);
    return vec2(above.x > 0.0 ? max(areas.x, 0.0) : 0.0, above.y > 0.0 ? max(areas.y, 0.0) : 0.0);
}

// The part of a cell that both directions see.
float seen_by_both(vec2 areas, vec2 others) {
    return 0.5 * ((areas.x > 0.0 && others.x > 0.0 ? 1.0 : 0.0) +
                  (areas.y > 0.0 && others.y > 0.0 ? 1.0 : 0.0));
}

// The same for Eq. 5 as it is printed: light on the coarse relief's facets, by their areas that the
// viewer sees, over the cosine to the base.
float seen_by_both_printed(uint cell, vec2 seen, vec2 lit, float cosine) {
    vec4 slopes = cells[cell].slopes;
    vec2 normals = inversesqrt(1.0 + vec2(dot(slopes.xy, slopes.xy), dot(slopes.zw, slopes.zw)));
    return 0.5 * dot(seen * lit, normals) / max(cosine, 1e-3);
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

#endif
