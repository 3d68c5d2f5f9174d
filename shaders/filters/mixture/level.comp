#version 460
#extension GL_GOOGLE_include_directive : require

// One level of a map of mixtures: each texel's components, from its parent's by a few steps of
// expectation maximisation over all lobes under the texel; and the sums that the components have of
// these, as they are, so that all components together have the lobes' moments exactly. Without
// steps, the sums for given components.

#include "filters/mixture/parents.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(constant_id = SPECIALISE_MIXTURE_PLANE) const uint PLANE = MIXTURE_PLANE_LAMBERT;

const bool PROJECTED = PLANE == MIXTURE_PLANE_PROJECTED;

// Of another size than the level where no finer level needs the components.
layout(set = 0, binding = 15) uniform writeonly image2DArray component_map;
layout(set = 0, binding = 16) uniform writeonly image2DArray moment_map;

struct level_box {
    uvec2 texel, size; // of the level
    uvec2 low, high;
};

// What the components have of the lobes under a texel.
struct level_sums {
    component_sums moments[MIXTURE_MAXIMUM_COMPONENTS]; // d from the components' means
    vec2 widths[MIXTURE_MAXIMUM_COMPONENTS];            // m / sqrt(v), m v
    vec4 colour[MIXTURE_MAXIMUM_COMPONENTS];
    vec4 diffuse; // and how much all lobes count
};

float weight_of(level_box box, uvec2 at) {
    return box_weight(at.x, box.texel.x, box.size.x, constants.width) *
           box_weight(at.y, box.texel.y, box.size.y, constants.height);
}

// Tan et al. 2005, section 4.1: the mean between a component's samples and the like components of
// its neighbours, each of which counts as `prior` samples times its part. Of the neighbours these
// are the parent and the four beside it, because texels of one level are fitted at the same time.
vec2 drawn_to_neighbours(level_box box, int index, mixture_component own) {
    const ivec2 offsets[5] =
        ivec2[](ivec2(0), ivec2(1, 0), ivec2(-1, 0), ivec2(0, 1), ivec2(0, -1));
    ivec2 parent = parent_of(box.texel, box.size), end = textureSize(parent_map, 0).xy - 1;
    float samples = own.part * float(constants.width * constants.height) /
                    float(box.size.x * box.size.y);
    vec3 sum = samples * vec3(own.mean.xy, 1.0);
    for (int i = 0; i < 5; ++i) {
        mixture_component other =
            parent_component(clamp(parent + offsets[i], ivec2(0), end), index);
        sum += constants.prior * other.part * vec3(other.mean.xy, 1.0);
    }
    return sum.xy / sum.z;
}

void add_lobe(inout level_sums sums, ivec2 texel, int i, float weight, bool nearest,
              mixture_units units, component_density densities[MIXTURE_MAXIMUM_COMPONENTS]) {
    mixture_sample lobe = read_sample(texel, i, units);
    float shares[MIXTURE_MAXIMUM_COMPONENTS];
    if (nearest)
        find_nearest(densities, lobe, units, shares);
    else
        find_shares(densities, lobe, shares);
    vec4 colour = vec4(0.0);
    if (BIN_COLOUR)
        colour = texelFetch(sample_map, ivec3(texel, LAYERS * i + 2), 0);
    for (int j = 0; j < BINS; ++j) {
        float mass = shares[j] * weight * lobe.mass;
        add_share(sums.moments[j], densities[j].mean, lobe, mass);
        sums.widths[j] += mass * lobe.widths;
        if (BIN_COLOUR)
            sums.colour[j] += mass * colour;
    }
}

// Shared out by densities or, `nearest`, by distance.
level_sums sum_lobes(level_box box, bool nearest, mixture_units units,
                     mixture_component components[MIXTURE_MAXIMUM_COMPONENTS]) {
    component_density densities[MIXTURE_MAXIMUM_COMPONENTS];
    level_sums sums;
    sums.diffuse = vec4(0.0);
    for (int j = 0; j < BINS; ++j) {
        densities[j] = density_of(components[j]);
        sums.moments[j] = component_sums(vec4(0.0), vec4(0.0));
        sums.widths[j] = vec2(0.0);
        sums.colour[j] = vec4(0.0);
    }
    for (uint y = box.low.y; y < box.high.y; ++y) {
        for (uint x = box.low.x; x < box.high.x; ++x) {
            float weight = weight_of(box, uvec2(x, y));
            for (int i = 0; i < LOBE_COUNT; ++i)
                add_lobe(sums, ivec2(x, y), i, weight, nearest, units, densities);
            if (BIN_COLOUR || MASKED_LOBES)
                sums.diffuse +=
                    weight * texelFetch(sample_map, ivec3(x, y, LAYERS * LOBE_COUNT), 0);
        }
    }
    return sums;
}

void improve(level_box box, level_sums sums, bool by_distance, mixture_units units,
             inout mixture_component components[MIXTURE_MAXIMUM_COMPONENTS]) {
    float whole = 0.0;
    for (int j = 0; j < BINS; ++j)
        whole += sums.moments[j].first.x;
    for (int j = 0; j < BINS; ++j) {
        components[j] = improved(components[j], sums.moments[j], whole, units);
        if (PROJECTED && constants.prior > 0.0 && !by_distance)
            components[j].mean.xy = drawn_to_neighbours(box, j, components[j]);
    }
}

// Components at samples far apart.
void start_apart(level_box box, mixture_units units,
                 inout mixture_component components[MIXTURE_MAXIMUM_COMPONENTS]) {
    for (int count = 0; count < BINS; ++count) {
        float farthest = -1.0;
        vec3 place = vec3(0.0);
        for (uint y = box.low.y; y < box.high.y; ++y) {
            for (uint x = box.low.x; x < box.high.x; ++x) {
                mixture_sample lobe = read_sample(ivec2(x, y), int((x + y) % LOBE_COUNT), units);
                float nearest = count == 0 ? squared_distance(lobe, vec3(0.0), units) : 1e30;
                for (int j = 0; j < count; ++j)
                    nearest = min(nearest, squared_distance(lobe, components[j].mean, units));
                if (MASKED_LOBES)
                    nearest *= lobe.mass;
                if (nearest > farthest) {
                    farthest = nearest;
                    place = lobe.place;
                }
            }
        }
        components[count] = first_component(place, units);
    }
}

// What Tan et al. store of the fit. Base lobes have the material's usual variance.
vec4 printed_layer(mixture_component component, mixture_units units) {
    vec2 mean = component.mean.xy + units.origin;
    float variance = component.covariance.x + units.deviation * units.deviation;
    return component.part * vec4(1.0, mean, variance + dot(mean, mean));
}

// About a point at `offset` from the mean: m, m p and m p p (xx, yy, xy).
component_sums moved(component_sums sums, vec2 offset) {
    float mass = sums.first.x;
    vec2 place = sums.first.yz;
    vec3 square = sums.second.xyz + vec3(2.0 * place * offset + mass * offset * offset,
                                         place.x * offset.y + place.y * offset.x +
                                             mass * offset.x * offset.y);
    return component_sums(vec4(mass, place + mass * offset, 0.0), vec4(square, 0.0));
}

void write_layers(uvec2 texel, level_sums sums, mixture_units units,
                  mixture_component components[MIXTURE_MAXIMUM_COMPONENTS]) {
    for (int j = 0; j < BINS; ++j) {
        component_sums own = moved(sums.moments[j], components[j].mean.xy + units.origin);
        vec4 layer = vec4(own.first.xyz, own.second.x + own.second.y + 2.0 * sums.widths[j].y);
        imageStore(moment_map, ivec3(texel, j),
                   PRINTED ? printed_layer(components[j], units) : layer);
    }
}

void write_sums(uvec2 texel, level_sums sums,
                mixture_component components[MIXTURE_MAXIMUM_COMPONENTS]) {
    vec4 range = binning.bins[0].range; // of all components alike
    float unit = 1.0 / binning.largest.x;
    vec4 colour_unit = vec4(vec3(1.0 / binning.largest.y), 1.0);
    for (int j = 0; j < BINS; ++j) {
        component_sums own = moved(sums.moments[j], components[j].mean.xy);
        imageStore(moment_map, ivec3(texel, LAYERS * j),
                   unit * vec4(own.first.x, own.first.yz / range.z, sums.widths[j].x / range.w));
        imageStore(moment_map, ivec3(texel, LAYERS * j + 1),
                   unit * vec4(own.second.xyz / (range.z * range.z),
                               sums.widths[j].y / binning.bins[0].shape.w));
        if (BIN_COLOUR)
            imageStore(moment_map, ivec3(texel, LAYERS * j + 2),
                       unit * sums.colour[j] * colour_unit);
    }
    if (BIN_COLOUR || MASKED_LOBES)
        imageStore(moment_map, ivec3(texel, LAYERS * BINS), sums.diffuse * colour_unit);
}

// Where finer levels start: one step further than what the sums were found with.
void keep_components(level_box box, level_sums sums, mixture_units units,
                     mixture_component components[MIXTURE_MAXIMUM_COMPONENTS]) {
    improve(box, sums, false, units, components);
    for (int j = 0; j < BINS; ++j) {
        imageStore(component_map, ivec3(box.texel, 2 * j),
                   vec4(components[j].part, components[j].mean));
        imageStore(component_map, ivec3(box.texel, 2 * j + 1), components[j].covariance);
    }
}

void main() {
    uvec2 texel = gl_GlobalInvocationID.xy + uvec2(0u, constants.first_row);
    uvec2 size = uvec2(imageSize(moment_map).xy);
    if (any(greaterThanEqual(texel, size)))
        return;
    level_box box = level_box(texel, size, box_low(texel, size), box_high(texel, size));
    mixture_units units = units_of_map();
    mixture_component components[MIXTURE_MAXIMUM_COMPONENTS];
    for (int j = 0; j < BINS; ++j)
        components[j] = parent_component(parent_of(texel, size), j);
    uint rounds = 0;
    if (START == MIXTURE_START_K_MEANS && constants.steps > 0) {
        start_apart(box, units, components);
        rounds = MIXTURE_ROUNDS_OF_K_MEANS;
    }
    level_sums sums;
    for (uint step = 0;; ++step) {
        sums = sum_lobes(box, step < rounds, units, components);
        if (step == rounds + constants.steps)
            break;
        improve(box, sums, step < rounds, units, components);
    }
    if (imageSize(component_map).xy == ivec2(size))
        keep_components(box, sums, units, components);
    if (PROJECTED)
        write_layers(texel, sums, units, components);
    else
        write_sums(texel, sums, components);
}
