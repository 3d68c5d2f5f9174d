#version 460
#extension GL_EXT_control_flow_attributes : require
#extension GL_GOOGLE_include_directive : require

// One level of a map of mixtures: each texel's components, from its parent's by a few steps of
// expectation maximisation over all lobes under the texel, or from the texel's own lobes where that
// leads closer to them; and the sums that the components have of these, as they are, so that all
// components together have the lobes' moments exactly. Without steps, the sums for given
// components.

#include "filters/mixture/level_error.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

// Of another size than the level where no finer level needs the components.
layout(set = 0, binding = 15) uniform writeonly image2DArray component_map;
layout(set = 0, binding = 16) uniform writeonly image2DArray moment_map;

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

// Steps from components that are there: first `rounds` by distance. Unless only these are wanted,
// the sums for what they lead to.
level_sums fit(level_box box, uint rounds, uint steps, bool wants_sums, mixture_units units,
               inout mixture_component components[MIXTURE_MAXIMUM_COMPONENTS]) {
    level_sums sums;
    for (uint step = 0; wants_sums || step < rounds + steps; ++step) {
        sums = sum_lobes(box, step < rounds, units, components);
        if (step == rounds + steps)
            break;
        improve(box, sums, step < rounds, units, components);
    }
    return sums;
}

// A texel's own components are unlike its neighbours', so that shading evaluates them one by one
// (filters/mixture/likeness.comp): they must gain something. In turns, so that the code for a loop
// over lobes exists once: compilers take seconds for it.
const uint FROM_PARENT = 0, FROM_OWN_LOBES = 1, CHOSEN = 2;

level_sums fit_closest(level_box box, mixture_units units,
                       inout mixture_component components[MIXTURE_MAXIMUM_COMPONENTS]) {
    mixture_component from_parent[MIXTURE_MAXIMUM_COMPONENTS];
    float least = 0.0;
    level_sums sums;
    for (uint turn = constants.own_steps > 0u ? FROM_PARENT : CHOSEN; turn <= CHOSEN; ++turn) {
        uint rounds = 0u, steps = turn == CHOSEN ? 0u : constants.steps;
        if (turn == FROM_OWN_LOBES) {
            from_parent = components;
            if (!start_apart(box, units, components)) {
                components = from_parent;
                continue;
            }
            rounds = MIXTURE_ROUNDS_OF_K_MEANS;
            steps = constants.own_steps;
        }
        sums = fit(box, rounds, steps, turn == CHOSEN, units, components);
        if (turn == CHOSEN)
            break;
        float error = squared_error(box, units, components);
        if (turn == FROM_PARENT)
            least = error - constants.least_gain * abs(error);
        else if (error >= least)
            components = from_parent;
    }
    return sums;
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
    uint rounds = 0u;
    if (START == MIXTURE_START_K_MEANS && constants.steps > 0u) {
        start_apart(box, units, components);
        rounds = MIXTURE_ROUNDS_OF_K_MEANS;
    }
    level_sums sums;
    if (START == MIXTURE_START_CLOSEST)
        sums = fit_closest(box, units, components);
    else
        sums = fit(box, rounds, constants.steps, true, units, components);
    if (imageSize(component_map).xy == ivec2(size))
        keep_components(box, sums, units, components);
    if (PROJECTED)
        write_layers(texel, sums, units, components);
    else
        write_sums(texel, sums, components);
}
