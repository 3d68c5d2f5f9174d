// A material's relief as it is: each sample of a pixel follows the light along a path over the
// facets, from where the viewer meets the relief. What every filter of reliefs should average. The
// relief lies on the plane of the point at which the viewer meets the carrier, so it is exact where
// the carrier is flat, and locally flat elsewhere. Its carrier's height is the relief's mean.
//
// Facets have the base material without its normal map. At each of their vertices paths are joined
// to the lights; the environment's light is sampled from the environment and from the material, and
// weighted by the balance heuristic (Veach, Guibas, 1995, Optimally Combining Sampling Techniques
// for Monte Carlo Rendering). What facets emit is found where a path meets them.
//
// A material without a relief is shaded as `direct` does.

#include "filters/displaced/seen_relief.glsl"
#include "lib/number/hash.glsl"
#include "shading/base_sample.glsl"
#include "shading/unfiltered_maps.glsl"

#ifdef ENVIRONMENT
#include "environment/reflection.glsl"
#include "environment/sample.glsl"
#endif

layout(constant_id = SPECIALISE_RELIEF) const bool RELIEF = false;
layout(constant_id = SPECIALISE_PATH_VERTICES) const uint PATH_VERTICES = 32;

// From this vertex on, paths end at random.
const uint FIRST_ROULETTE = 4u;

vec2 relief_texels() {
    return vec2(relief_size());
}

// A vertex of a path.
struct path_vertex {
    relief_hit hit;
    mat3 frame;    // the facet's tangent frame, in the relief's; z: its normal
    vec3 outgoing; // in that frame
    base_material base;
};

struct appearance {
    path_vertex first; // of a relief
    base_material base;
    vec3 emission;
    bool kept;
    vec3 normal;
    float lobe_count;
    float level;
};

// ---------------------------------------------------------------------------------------------
// Random numbers

struct random_numbers {
    uint state;
};

random_numbers random_numbers_of(surface_point surface, uint which) {
    return random_numbers(hash(
        surface.pixel.x + hash(surface.pixel.y + hash(frame.seed + hash(which)))));
}

float next_number(inout random_numbers numbers) {
    numbers.state += 0x9e3779b9u;
    return hashed_number(numbers.state);
}

vec2 next_pair(inout random_numbers numbers) {
    float first = next_number(numbers);
    return vec2(first, next_number(numbers));
}

// ---------------------------------------------------------------------------------------------
// Vertices

path_vertex vertex_at(surface_point surface, relief_hit hit, vec3 outgoing) {
    path_vertex vertex;
    vertex.hit = hit;
    vec3 normal = tangent_from_relief(hit.normal);
    vertex.frame = mat3(relief_from_tangent(rotate_from_pole(normal, vec3(1.0, 0.0, 0.0))),
                        relief_from_tangent(rotate_from_pole(normal, vec3(0.0, 1.0, 0.0))),
                        hit.normal);
    vertex.outgoing = outgoing * vertex.frame;
    surface.curvature = vec3(0.0);
    vertex.base = unfiltered_material(surface_at(surface, hit.position), vec3(0.0, 0.0, 1.0));
    return vertex;
}

// Reflectance times cosine at a vertex.
vec3 reflectance_at(path_vertex vertex, vec3 incoming) {
    vec3 local = incoming * vertex.frame;
    return local.z > 0.0 && vertex.outgoing.z > 0.0
               ? evaluate_base_material(vertex.base, vertex.outgoing, local)
               : vec3(0.0);
}

bool sees_sky(path_vertex vertex, vec3 incoming) {
    return dot(vertex.hit.normal, incoming) > 0.0 && sees_sky(vertex.hit.position, incoming);
}

// A path, from the viewer.
struct path {
    path_vertex vertex;
    vec3 throughput;
    vec3 direction; // in which it goes on
    float density;  // per steradian, of that direction
};

// Draws the direction in which a path goes on; false if it ends.
bool choose_direction(inout path walk, uint vertices, inout random_numbers numbers) {
    vec2 place = next_pair(numbers);
    vec3 local = direction_from_material(walk.vertex.base, walk.vertex.outgoing,
                                         vec3(place, next_number(numbers)));
    walk.density = material_density(walk.vertex.base, walk.vertex.outgoing, local);
    walk.direction = walk.vertex.frame * local;
    if (!(local.z > 0.0) || !(walk.density > 0.0))
        return false;
    walk.throughput *= reflectance_at(walk.vertex, walk.direction) / walk.density;
    float largest = max(walk.throughput.r, max(walk.throughput.g, walk.throughput.b));
    float survival = vertices < FIRST_ROULETTE ? 1.0 : clamp(largest, 0.05, 0.95);
    if (!(largest > 0.0) || next_number(numbers) >= survival)
        return false;
    walk.throughput /= survival;
    return true;
}

// To the next vertex; false if the path leaves the relief.
bool go_on(inout path walk, surface_point surface) {
    relief_hit hit = trace_relief(walk.vertex.hit.position, walk.direction);
    if (hit.found)
        walk.vertex = vertex_at(surface, hit, -walk.direction);
    return hit.found;
}

// ---------------------------------------------------------------------------------------------
// A pixel

vec3 emission_at(surface_point surface) {
    return unfiltered_texel(MAP_EMISSIVE, emissive_map, surface).rgb;
}

// What other facets emit, by a path from the one that is seen.
vec3 emission_of_others(path_vertex first, surface_point surface) {
    random_numbers numbers = random_numbers_of(surface, 5u);
    path walk = path(first, vec3(1.0), vec3(0.0), 0.0);
    vec3 sum = vec3(0.0);
    for (uint i = 1u; i < PATH_VERTICES; ++i) {
        if (!choose_direction(walk, i, numbers) || !go_on(walk, surface))
            break;
        sum += walk.throughput * emission_at(surface_at(surface, walk.vertex.hit.position));
    }
    return sum;
}

appearance fetch_appearance(surface_point surface) {
    appearance result;
    surface_point carrier = surface;
    lay_relief_on(surface);
    result.base = unfiltered_material(surface);
    result.normal = result.base.normal;
    if (RELIEF) {
        relief_hit hit = seen_point(surface);
        if (!hit.found) { // beyond the longest walk
            hit.position = vec3(0.0);
            hit.normal = vec3(0.0, 0.0, 1.0);
        }
        result.first = vertex_at(surface, hit, relief_from_tangent(surface.outgoing));
        result.normal = tangent_from_relief(hit.normal);
        if (hit.found)
            surface = surface_at(surface, hit.position);
    }
    result.kept = !ALPHA_MASK || is_kept(unfiltered_base_colour(surface).a, surface);
    result.emission = vec3(0.0);
    if (EMISSION)
        result.emission = emission_at(surface);
    if (EMISSION && RELIEF)
        result.emission += emission_of_others(result.first, carrier);
    result.lobe_count = float(LOBE_COUNT);
    result.level = 0.0;
    return result;
}

#include "shading/lights/no_gathering.glsl"

vec3 evaluate_appearance(appearance fetched, surface_point surface, vec3 incoming, uint light) {
    if (!RELIEF)
        return evaluate_base_material(fetched.base, surface.outgoing, incoming);
    vec3 towards = relief_from_tangent(incoming), sum = vec3(0.0);
    random_numbers numbers = random_numbers_of(surface, light);
    path walk = path(fetched.first, vec3(1.0), vec3(0.0), 0.0);
    for (uint i = 1u; i <= PATH_VERTICES && towards.z > 0.0; ++i) {
        if (sees_sky(walk.vertex, towards))
            sum += walk.throughput * reflectance_at(walk.vertex, towards);
        if (i == PATH_VERTICES || !choose_direction(walk, i, numbers) || !go_on(walk, surface))
            break;
    }
    return sum;
}

float fetch_occlusion(surface_point surface) {
    return RELIEF ? 1.0 : unoccluded(unfiltered_texel(MAP_OCCLUSION, occlusion_map, surface).r);
}

#ifdef ENVIRONMENT
// A direction drawn from the environment: one for all vertices of a path. (lavapipe reads a level
// that it takes from any lane, also one that has left the loop.)
struct drawn_light {
    vec3 incoming;
    vec3 radiance;
    float density;
};

drawn_light draw_light(surface_point surface, float total, inout random_numbers numbers) {
    vec3 drawn = direction_from_environment(next_pair(numbers));
    vec3 world = environment.environment_from_world[0].xyz * drawn.x +
                 environment.environment_from_world[1].xyz * drawn.y +
                 environment.environment_from_world[2].xyz * drawn.z;
    vec3 radiance = texel_radiance(drawn);
    return drawn_light(relief_from_tangent(world * surface.world_from_tangent), radiance,
                       lobe_luminance(radiance) / max(total, 1e-30));
}

vec3 reflected_light(path_vertex vertex, drawn_light light) {
    if (!sees_sky(vertex, light.incoming))
        return vec3(0.0);
    float density = light.density + material_density(vertex.base, vertex.outgoing,
                                                     light.incoming * vertex.frame);
    return density > 0.0 ? reflectance_at(vertex, light.incoming) * light.radiance *
                               (environment.intensity / density)
                         : vec3(0.0);
}

// What a path that has left the relief meets.
vec3 light_behind(path walk, surface_point surface, float total) {
    if (walk.direction.z <= 0.0)
        return vec3(0.0);
    vec3 radiance = texel_radiance(to_environment(surface, tangent_from_relief(walk.direction)));
    float density = lobe_luminance(radiance) / max(total, 1e-30);
    return walk.throughput * radiance *
           (environment.intensity * walk.density / (walk.density + density));
}

vec3 reflect_environment(appearance fetched, surface_point surface) {
    if (!RELIEF && ENVIRONMENT_METHOD == ENVIRONMENT_REFERENCE)
        return sampled_environment(surface, fetched.base);
    if (!RELIEF)
        return reflect_base_material(surface, fetched.base, fetched.base.normal);
    float total = total_luminance();
    vec3 sum = vec3(0.0);
    random_numbers numbers = random_numbers_of(surface, 4u);
    drawn_light drawn = draw_light(surface, total, numbers);
    path walk = path(fetched.first, vec3(1.0), vec3(0.0), 0.0);
    for (uint i = 1u; i <= PATH_VERTICES; ++i) {
        sum += walk.throughput * reflected_light(walk.vertex, drawn);
        if (!choose_direction(walk, i, numbers))
            break;
        if (!go_on(walk, surface)) {
            sum += light_behind(walk, surface, total);
            break;
        }
    }
    return sum;
}
#endif
