#include "passes/environment/light.h"

#include <string.h>

#include "passes/context/knob_values.h"
#include "passes/context/shared_knobs.h"
#include "passes/environment/broad_reflection.h"
#include "passes/environment/directional_albedo.h"
#include "passes/environment/hemispheres/hemisphere_moments.h"
#include "passes/environment/maps.h"
#include "passes/environment/reflected_lobes.h"
#include "passes/environment/reflection_table.h"
#include "passes/maps/filtered_maps.h"
#include "shaders/interface/environment/broad_reflection.h"
#include "shaders/interface/environment/environment_light.h"
#include "shaders/interface/environment/irradiance_harmonics.h"
#include "shaders/interface/environment/reflected_lobes.h"

/// Maximum number of texels along a face that the exact integral sums. Lavapipe silently ends the
/// loops of a shader after 65535 iterations in total, and filters have loops of their own: a closed
/// surface, for instance, two dozen for each texel, and all texels of a map around a pixel 56.
#define EXACT_WIDTH               64
#define EXACT_WIDTH_OF_MANY_LOOPS 16

static const lobe_sampler trilinear = {LOBE_SAMPLE_LINEAR, LOBE_SAMPLE_LINEAR, LOBE_WRAP_CLAMP,
                                       LOBE_WRAP_CLAMP, 0};

static uint32_t method_of(const filter_context *context) {
    uint32_t method = passes_knob_choice(context, &passes_knob_environment);
    // With many samples per pixel, each may sample the environment once: just as exact, and faster.
    return method == ENVIRONMENT_EXACT && context->filter->supersamples ? ENVIRONMENT_REFERENCE
                                                                        : method;
}

/// Whether light is reflected more than once: by microfacets, or by the facets of texels.
static bool scatters(const filter_context *context) {
    return passes_knob_choice(context, &passes_knob_scattering) > 0 ||
           passes_closes_surfaces(context);
}

/// Whether lobes between two levels are blended from two cubes.
static bool blends(const filter_context *context) {
    return passes_knob_choice(context, &passes_knob_environment_levels) > 0;
}

/// Whether any instance has microfacets of this distribution.
static bool uses_distribution(const filter_context *context, uint32_t distribution) {
    const device_scene *scene = context->scene;
    for (size_t i = 0; i < scene->scene->material_count; i++) {
        const lobe_material *material = scene->materials[i].material;
        if (scene->materials[i].first_instance && material->model == LOBE_MATERIAL_MICROFACET &&
            (uint32_t)material->distribution == distribution)
            return true;
    }
    return false;
}

/// Whether any instance is shaded with GGX lobes.
static bool uses_ggx(const filter_context *context) {
    bool as_lobes = passes_knob_choice(context, &passes_knob_base) > 0;
    return !as_lobes && uses_distribution(context, LOBE_DISTRIBUTION_GGX);
}

/// REFLECTED_AS_...: how light of a material's roughnesses is found, beside a lobe: that of metal
/// that is rough, or that normals may make so.
static uint32_t broad_reflection_of(const filter_context *context, const environment_light *light,
                                    const device_material *material) {
    const lobe_material *source = material->material;
    const bool metal = material->metallic_varies || material->metallic > 0;
    if (!light->present || light->method != ENVIRONMENT_PREFILTERED ||
        passes_knob_choice(context, &passes_knob_base) > 0 ||
        source->model != LOBE_MATERIAL_MICROFACET || !metal)
        return 0;
    const bool bumpy = material->map_bits & 1u << MAP_NORMAL;
    const bool blurred = source->normal_concentration > 0;
    const float least = material->map_bits & 1u << MAP_WIDTH ? 0 : source->roughness;
    const float greatest = bumpy || blurred ? 1 : source->roughness;
    const float roughest = context->filter->keeps_widths && !blurred ? source->roughness : greatest;
    uint32_t ways = 0;
    // Also for level 0, whose lobes normals widen.
    if (greatest > REFLECTED_LOBES_LEAST_ROUGHNESS && least < BROAD_FULL_ROUGHNESS)
        ways |= REFLECTED_AS_LOBES;
    if (roughest > BROAD_LEAST_ROUGHNESS)
        ways |= REFLECTED_AS_POLYNOMIAL;
    return ways;
}

static lobe_resource albedo_table(lobe_graph *graph, environment_light *light,
                                  lobe_distribution distribution, lobe_distribution masking) {
    lobe_resource *table = &light->albedo[distribution][masking];
    if (!table->version)
        *table = passes_directional_albedo(graph, distribution, masking);
    return *table;
}

/// The masking of a filter's slopes.
static lobe_distribution slope_masking(const filter_context *context,
                                       lobe_distribution distribution) {
    return context->filter->slopes == FILTER_SLOPES_MASKED_AS_MATERIAL ? distribution
                                                                       : LOBE_DISTRIBUTION_BECKMANN;
}

static void build_albedo(const filter_context *context, environment_light *light) {
    for (uint32_t i = 0; i < DISTRIBUTION_COUNT; i++) {
        if (!uses_distribution(context, i))
            continue;
        lobe_distribution distribution = (lobe_distribution)i;
        albedo_table(context->graph, light, distribution, distribution);
        if (context->filter->slopes)
            albedo_table(context->graph, light, LOBE_DISTRIBUTION_BECKMANN,
                         slope_masking(context, distribution));
    }
}

/// `ways`: REFLECTED_AS_...
static void build_reflection_tables(const filter_context *context, environment_light *light,
                                    uint32_t ways, lobe_distribution distribution,
                                    lobe_distribution masking) {
    lobe_resource *lobes = &light->lobes[distribution][masking];
    lobe_resource *broad = &light->broad[distribution][masking];
    if ((ways & REFLECTED_AS_LOBES) && !lobes->version)
        *lobes = passes_reflected_lobes(context->graph, distribution, masking);
    if ((ways & REFLECTED_AS_POLYNOMIAL) && !broad->version)
        *broad = passes_broad_reflection(
            context->graph, distribution, masking,
            (uint32_t)passes_knob_value(context, &passes_knob_environment_probes));
}

/// Whether a material's shader reads the moments of the environment, by what it finds with
/// REFLECTED_AS_... `ways`.
static bool gathers_moments(const filter_context *context, const device_material *material,
                            uint32_t ways) {
    return (ways & REFLECTED_AS_POLYNOMIAL) ||
           (context->filter->gathers_moments && material->maps[MAP_HEIGHT].use);
}

/// The moments and the tables that materials need.
static void build_moments_and_tables(const filter_context *context, environment_light *light,
                                     const environment_means *means) {
    const device_scene *scene = context->scene;
    for (size_t i = 0; i < scene->scene->material_count; i++) {
        const device_material *material = &scene->materials[i];
        const lobe_distribution distribution = material->material->distribution;
        if (!material->first_instance)
            continue;
        const uint32_t ways = broad_reflection_of(context, light, material);
        if (gathers_moments(context, material, ways) && !light->moments.version)
            light->moments = passes_hemisphere_moments(context->graph, means);
        build_reflection_tables(context, light, ways, distribution, distribution);
        if (context->filter->slopes && (material->map_bits & (1u << MAP_NORMAL | 1u << MAP_WIDTH)))
            build_reflection_tables(context, light, ways, LOBE_DISTRIBUTION_BECKMANN,
                                    slope_masking(context, distribution));
    }
}

/// Placeholders for methods that use none.
static irradiance_maps no_harmonics(const filter_context *context) {
    static const struct irradiance_harmonics none;
    return (irradiance_maps){lobe_graph_upload(context->graph, "no harmonics", &none, sizeof none),
                             lobe_graph_import_texture(context->graph, context->scene->white)};
}

/// Texels along a face of the cube.
static uint32_t environment_width(const filter_context *context) {
    return 16u << passes_knob_choice(context, &passes_knob_environment_size);
}

static environment_maps_request request_of(const filter_context *context,
                                           const environment_work *work) {
    bool prefiltered = method_of(context) == ENVIRONMENT_PREFILTERED;
    environment_maps_request request = {
        .environment = context->scene->scene->environment,
        .texture = context->scene->environment,
        .size = environment_width(context),
        .wanted = {[LOBE_ENVIRONMENT_VON_MISES_FISHER] = prefiltered,
                   [LOBE_ENVIRONMENT_BETWEEN] = prefiltered && blends(context),
                   [LOBE_ENVIRONMENT_GGX] = prefiltered && uses_ggx(context)},
        .parts = work->parts,
    };
    request.cached = passes_cached_cubes_find(&work->state->store, &request);
    return request;
}

/// Reads back finished cubes that the cache lacks.
static void read_back_missing(lobe_graph *graph, environment_state *state,
                              const environment_maps *maps) {
    for (uint32_t map = 0; map < LOBE_ENVIRONMENT_MAP_COUNT; map++) {
        if (!passes_cached_cubes_lack(&state->store, maps, map))
            continue;
        lobe_graph_read_back(graph, maps->cubes[map], (lobe_range){0});
        state->reads_back = true;
    }
}

/// Until the filtered cubes are complete, the plain MIP chain takes their place.
static environment_maps build_cubes(const filter_context *context, const environment_work *work,
                                    environment_light *light) {
    bool prefiltered = light->method == ENVIRONMENT_PREFILTERED;
    environment_maps_request request = request_of(context, work);
    environment_maps maps =
        passes_environment_maps_declare(context->graph, &request, &work->state->progress);
    work->state->last = maps;
    if (work->saves && maps.up_to_date)
        read_back_missing(context->graph, work->state, &maps);
    if (prefiltered && !maps.complete)
        light->method = ENVIRONMENT_MIP;
    light->cube = maps.cubes[LOBE_ENVIRONMENT_RADIANCE];
    light->prefiltered = light->prefiltered_ggx = light->between = light->cube;
    if (light->method == ENVIRONMENT_PREFILTERED) {
        light->prefiltered = maps.cubes[LOBE_ENVIRONMENT_VON_MISES_FISHER];
        light->prefiltered_ggx =
            uses_ggx(context) ? maps.cubes[LOBE_ENVIRONMENT_GGX] : light->prefiltered;
        light->between =
            blends(context) ? maps.cubes[LOBE_ENVIRONMENT_BETWEEN] : light->prefiltered;
    }
    return maps;
}

static void build_maps(const filter_context *context, const environment_work *work,
                       environment_light *light) {
    environment_maps maps = build_cubes(context, work, light);
    // The harmonics are those of the filtered cubes: both change at the same time.
    bool filtered = light->method == ENVIRONMENT_PREFILTERED;
    lobe_environment_map map =
        filtered ? LOBE_ENVIRONMENT_VON_MISES_FISHER : LOBE_ENVIRONMENT_RADIANCE;
    irradiance_source source = {maps.cubes[map], maps.width[map], maps.levels[map], filtered};
    bool harmonics = filtered || light->method == ENVIRONMENT_SAMPLED;
    const environment_means means = passes_environment_means(context->graph, &source);
    light->irradiance = harmonics ? passes_irradiance_harmonics(
                                        context->graph, source, &means,
                                        passes_knob_value(context, &passes_knob_environment_window))
                                  : no_harmonics(context);
    build_moments_and_tables(context, light, &means);
}

static lobe_result refuse_exact(const filter_context *context, const char *where,
                                const char *cause) {
    return lobe_host_fail(context->host, LOBE_ERROR_UNSUPPORTED,
                          "filter '%s': knob 'env' must not be exact where %s: %s for each of the "
                          "environment's texels exceed what a device computes",
                          lobe_filter_name(context->filter), where, cause);
}

lobe_result passes_environment_light_check(const filter_context *context) {
    if (method_of(context) != ENVIRONMENT_EXACT || !context->scene->scene->environment)
        return LOBE_OK;
    if (passes_closes_surfaces(context) && context->filter->build)
        return refuse_exact(context, "'normal_mapping' is microfacet", "sums of all facets");
    if (context->filter->fetches_for_lights && passes_knob_choice(context, &passes_knob_probes) > 1)
        return refuse_exact(context, "'probes' is above 1", "fetches");
    return LOBE_OK;
}

lobe_result passes_environment_light_load(const filter_context *context,
                                          const environment_work *work, lobe_device *device) {
    if (!work->cache || !context->scene->environment)
        return LOBE_OK;
    environment_maps_request request = request_of(context, work);
    return passes_cached_cubes_load(&work->state->store, device, work->cache, &request,
                                    context->host);
}

uint32_t passes_environment_light_parts_left(const filter_context *context,
                                             const environment_work *work) {
    if (!context->scene->environment)
        return 0;
    const environment_maps_request request = request_of(context, work);
    return passes_environment_maps_parts_left(&request, &work->state->progress);
}

void passes_environment_light_save(const environment_work *work, const lobe_graph *graph,
                                   const lobe_host *host) {
    environment_state *state = work->state;
    for (uint32_t map = 0; state->reads_back && map < LOBE_ENVIRONMENT_MAP_COUNT; map++) {
        if (passes_cached_cubes_lack(&state->store, &state->last, map))
            passes_cached_cubes_save(&state->store, work->cache, graph, &state->last, map, host);
    }
    state->reads_back = false;
}

void passes_environment_light_invalidate(environment_state *state) {
    passes_environment_maps_invalidate(&state->last, &state->progress);
    passes_cached_cubes_forget(&state->store);
    state->reads_back = false;
}

void passes_environment_light_forget(environment_state *state) {
    passes_cached_cubes_forget(&state->store);
    *state = (environment_state){0};
}

environment_light passes_environment_light_build(const filter_context *context,
                                                 const environment_work *work) {
    environment_light light = {.method = method_of(context)};
    light.present = context->scene->environment != NULL;
    bool split = light.present &&
                 (light.method == ENVIRONMENT_MIP || light.method == ENVIRONMENT_PREFILTERED ||
                  light.method == ENVIRONMENT_SAMPLED);
    if (split || scatters(context) || context->filter->reads_albedo)
        build_albedo(context, &light);
    if (!light.present) {
        passes_environment_light_forget(work->state);
        return light;
    }
    build_maps(context, work, &light);
    return light;
}

static struct environment_constants constants_of(const filter_context *context,
                                                 const shading_sample *sample) {
    const lobe_environment *environment = context->scene->scene->environment;
    struct environment_constants constants = {
        .intensity = environment->intensity,
        .sample_number = sample->number,
        .pattern = sample->pattern,
    };
    for (int row = 0; row < 3; row++)
        memcpy(constants.environment_from_world[row], environment->world_from_environment[row],
               3 * sizeof(float));
    return constants;
}

/// All levels; for the exact integral, the finest one with few enough texels: all have the same
/// energy.
static lobe_range levels_read(const environment_light *light, const filter_context *context) {
    if (light->method != ENVIRONMENT_EXACT)
        return (lobe_range){0};
    const bool many_loops = passes_closes_surfaces(context) || context->filter->loops_for_lights;
    const uint32_t width = many_loops ? EXACT_WIDTH_OF_MANY_LOOPS : EXACT_WIDTH;
    uint32_t level = 0;
    while (environment_width(context) >> level > width)
        ++level;
    return (lobe_range){.first_level = level, .level_count = 1};
}

void passes_environment_light_bind(const environment_light *light, const filter_context *context,
                                   lobe_pass *pass, const shading_sample *sample) {
    if (!light->present)
        return;
    struct environment_constants constants = constants_of(context, sample);
    const lobe_range range = levels_read(light, context);
    const lobe_binding bindings[] = {
        {.name = "environment_texels", .resource = light->cube, .range = range},
        {.name = "environment_cube", .resource = light->cube, .range = range, .sampler = trilinear},
        {.name = "environment_faces", .resource = light->cube, .range = range},
        {.name = "prefiltered_environment",
         .resource = light->prefiltered,
         .range = range,
         .sampler = trilinear},
        {.name = "prefiltered_environment_ggx",
         .resource = light->prefiltered_ggx,
         .range = range,
         .sampler = trilinear},
        {.name = "environment_between",
         .resource = light->between,
         .range = range,
         .sampler = trilinear},
        {.name = "irradiance_block", .resource = light->irradiance.harmonics},
        {.name = "irradiance_remainder_map",
         .resource = light->irradiance.remainder,
         .sampler = passes_hemispheres_sampler},
        {.name = "environment_block",
         .resource =
             lobe_graph_upload(context->graph, "environment", &constants, sizeof constants)},
    };
    for (size_t i = 0; i < sizeof bindings / sizeof *bindings; i++)
        lobe_pass_read(pass, &bindings[i]);
}

uint32_t passes_environment_light_lights_at_once(const environment_light *light, uint32_t lights) {
    if (light->present && light->method == ENVIRONMENT_EXACT)
        return 4; // every texel of the environment is a light
    return lights < 1 ? 1 : lights < 4 ? lights : 4;
}

void passes_environment_light_specialise(const environment_light *light,
                                         const filter_context *context,
                                         const device_material *material,
                                         specialisation_list *list) {
    if (!light->present)
        return;
    passes_specialise(list, SPECIALISE_ENVIRONMENT_METHOD, light->method);
    passes_specialise(list, SPECIALISE_BROAD_REFLECTION,
                      broad_reflection_of(context, light, material));
}

/// A table, or white if there is none.
static lobe_binding bind_table(const char *name, lobe_resource table, lobe_sampler sampler,
                               const filter_context *context) {
    if (!table.version)
        table = lobe_graph_import_texture(context->graph, context->scene->white);
    return (lobe_binding){.name = name, .resource = table, .sampler = sampler};
}

size_t
passes_environment_light_bind_material(const environment_light *light,
                                       const filter_context *context, const lobe_material *material,
                                       lobe_binding bindings[ENVIRONMENT_MATERIAL_BINDINGS]) {
    const lobe_distribution own = material->distribution;
    const lobe_distribution masking = slope_masking(context, own);
    const bool slopes = context->filter->slopes;
    size_t count = 0;
    bindings[count++] = bind_table("directional_albedo_table", light->albedo[own][own],
                                   passes_reflection_table_sampler, context);
    if (slopes)
        bindings[count++] =
            bind_table("slope_albedo_table", light->albedo[LOBE_DISTRIBUTION_BECKMANN][masking],
                       passes_reflection_table_sampler, context);
    // Shaders for scenes without an environment have no such tables.
    if (!light->present)
        return count;
    bindings[count++] = bind_table("broad_reflection_table", light->broad[own][own],
                                   passes_reflection_table_sampler, context);
    bindings[count++] = bind_table("reflected_lobes_table", light->lobes[own][own],
                                   passes_reflection_table_sampler, context);
    bindings[count++] =
        bind_table("hemisphere_moments_map", light->moments, passes_hemispheres_sampler, context);
    if (!slopes)
        return count;
    bindings[count++] = bind_table("slope_broad_reflection_table",
                                   light->broad[LOBE_DISTRIBUTION_BECKMANN][masking],
                                   passes_reflection_table_sampler, context);
    bindings[count++] =
        bind_table("slope_reflected_lobes_table", light->lobes[LOBE_DISTRIBUTION_BECKMANN][masking],
                   passes_reflection_table_sampler, context);
    return count;
}
