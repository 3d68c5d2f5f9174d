#include <math.h>
#include <string.h>

#include "passes/context/filter.h"
#include "passes/context/knob_values.h"
#include "passes/filters/lobes/clustering.h"
#include "passes/filters/lobes/subdivision_choice.h"
#include "passes/filters/lobes/width_colours.h"
#include "passes/maps/colours/mirrored_luminance.h"
#include "passes/maps/filtered_maps.h"
#include "passes/maps/lobe_map.h"
#include "passes/maps/tile_knobs.h"
#include "passes/upload/material_lobes.h"
#include "passes/upload/material_maps.h"
#include "passes/upload/transform.h"
#include "shaders/interface/mixture.h"
#include "shaders/interface/specialisation.h"

static const char *const spaces[] = {"auto", "tangent", "object", "camera", NULL};
static const char *const subdivisions[] = {"auto", "0", "1", "2", NULL};
static const char *const clusters[] = {"turned", "paper", NULL};
static const char *const widths[] = {"two", "one", NULL};
static const char *const thresholds[] = {"dispersion", "length", NULL};

static const filter_knob space_knob = {
    .description = {.name = "space",
                    .summary = "where mixtures are built, if each texel belongs to one place of "
                               "the mesh; auto: as the material says, tangent by default",
                    .kind = LOBE_KNOB_CHOICE,
                    .maximum = 3,
                    .choices = spaces},
};
static const filter_knob subdivision_knob = {
    .description = {.name = "subdivision",
                    .summary = "finest level of clusters: 0, 1 or 2 for one, four or eight lobes; "
                               "auto: as few as serve the material's maps as well",
                    .kind = LOBE_KNOB_CHOICE,
                    .maximum = 3,
                    .choices = subdivisions,
                    .sweep = "0,1,2"},
};
static const filter_knob clusters_knob = {
    .description = {.name = "clusters",
                    .summary = "how directions are divided: sectors about the map's axes, split 12 "
                               "degrees off the pole; or, as in the paper, between the axes, split "
                               "at 45 degrees",
                    .kind = LOBE_KNOB_CHOICE,
                    .maximum = 1,
                    .choices = clusters},
    .decides_slots = true,
};
static const filter_knob threshold_knob = {
    .description = {.name = "threshold",
                    .summary =
                        "what is compared with epsilon: the base lobes' share of the breadth; "
                        "or, as in the paper, the length |r|, which tells nothing of how "
                        "sharp the base lobes are",
                    .kind = LOBE_KNOB_CHOICE,
                    .maximum = 1,
                    .choices = thresholds,
                    .sweep = "length"},
    .feeds = KNOB_FEEDS_CONSTANT(SPECIALISE_THRESHOLD),
    .decides_slots = true,
};
static const filter_knob widths_knob = {
    .description = {.name = "widths",
                    .summary =
                        "how many widths of base lobes a cluster stands for where they vary: "
                        "two, with the moments of those in the footprint; or, as in the "
                        "paper, one",
                    .kind = LOBE_KNOB_CHOICE,
                    .maximum = 1,
                    .choices = widths,
                    .sweep = "one"},
    .decides_slots = true,
};
static const filter_knob epsilon0_knob = {
    .description = {.name = "epsilon0",
                    .summary = "below this, one lobe becomes four",
                    .maximum = 1,
                    .initial = 0.95,
                    .sweep = "0.85,0.99"},
    .feeds = KNOB_FEEDS_FILTER(lobes_knobs, epsilon0),
};
static const filter_knob epsilon1_knob = {
    .description = {.name = "epsilon1",
                    .summary = "below this, each of the four becomes two",
                    .maximum = 1,
                    .initial = 0.85},
    .feeds = KNOB_FEEDS_FILTER(lobes_knobs, epsilon1),
};
static const filter_knob blend_knob = {
    .description = {.name = "blend",
                    .summary = "half width of the transition at a threshold; 0: a switch",
                    .maximum = 0.5,
                    .initial = 0.02},
    .feeds = KNOB_FEEDS_FILTER(lobes_knobs, blend),
};
static const filter_knob *const knobs[] = {
    &space_knob,
    &subdivision_knob,
    &clusters_knob,
    &threshold_knob,
    &widths_knob,
    &epsilon0_knob,
    &epsilon1_knob,
    &blend_knob,
    &passes_knob_probes,
    &passes_knob_anisotropy,
    &passes_knob_bias,
    &passes_knob_level_blend,
    &passes_knob_curvature,
    &passes_knob_storage,
    &passes_knob_built,
    NULL,
};

/// The space that the user chose, or else the material's. Always tangent if the mesh's texture
/// coordinates are not an atlas, or if the instance stretches the mesh.
static lobe_map_space space_of(const filter_context *context, size_t instance) {
    const device_instance *drawn = &context->scene->instances[instance];
    lobe_map_space space = (lobe_map_space)passes_knob_choice(context, &space_knob);
    if (space == LOBE_SPACE_AUTOMATIC)
        space = context->scene->materials[drawn->material].material->space;
    // Tangent space is cheapest, exact where the surface hardly turns under a pixel, and as
    // accurate elsewhere: relative L2 over object and camera space 0.31, 0.31, 0.32 for a helmet
    // and 0.47, 0.44, 0.45 for a tea set, whose maps are atlases.
    if (space == LOBE_SPACE_AUTOMATIC || !drawn->is_atlas ||
        !passes_transform_keeps_angles(context->scene->scene->instances[instance].transform))
        return LOBE_SPACE_TANGENT;
    return space;
}

static bool for_each_instance(const filter_context *context, size_t instance) {
    return space_of(context, instance) != LOBE_SPACE_TANGENT;
}

// ---------------------------------------------------------------------------------------------
// What the texels of a material's maps decide

/// What is kept for a material between frames.
typedef struct prepared_lobes {
    bool has_subdivision;
    uint32_t subdivision; ///< in tangent space
    bool has_width_colours;
    bool width_colours;             ///< sharp and broad lobes differ in colour
    float base_colour[3], metallic; ///< for which that was found
} prepared_lobes;

/// Whether, in tangent space, all lobes point along the normal because no map tilts it: one cluster
/// then has them all.
static bool has_one_direction(const device_material *material) {
    return !material->maps[MAP_NORMAL].use &&
           (material->material->model == LOBE_MATERIAL_MICROFACET ||
            material->material->lobe_count == 1);
}

static bool is_in_tangent_space(const filter_context *context, uint32_t material) {
    const device_scene *scene = context->scene;
    uint32_t next = scene->materials[material].first_instance;
    while (next > 0 && space_of(context, next - 1) != LOBE_SPACE_TANGENT)
        next = scene->instances[next - 1].next_of_material;
    return next > 0;
}

/// Whether the material's maps decide its subdivision.
static bool needs_subdivision(const filter_context *context, uint32_t material) {
    const device_material *uploaded = &context->scene->materials[material];
    const lobe_grid grid = passes_lobe_grid(uploaded);
    return passes_lobe_grid_varies(&grid) && !has_one_direction(uploaded) &&
           passes_knob_choice(context, &subdivision_knob) == 0 &&
           is_in_tangent_space(context, material);
}

/// Whether shading takes two widths in place of the base lobes' mean width.
static bool needs_widths(const filter_context *context, const device_material *material) {
    return material->widths_vary && !passes_widths_lie_apart(material) &&
           passes_knob_choice(context, &widths_knob) == 0;
}

static bool widths_may_have_colours(const filter_context *context,
                                    const device_material *material) {
    return needs_widths(context, material) && passes_mirrored_luminance_varies(material);
}

static uint32_t choose_subdivision(const filter_context *context, const device_material *material) {
    const subdivision_request request = {
        .clusters = passes_knob_choice(context, &clusters_knob),
        .widths = needs_widths(context, material) ? 2 : 1,
        .threshold = passes_knob_choice(context, &threshold_knob),
        // Other values do not decide slots.
        .epsilon0 = epsilon0_knob.description.initial,
        .epsilon1 = epsilon1_knob.description.initial,
        .blend = blend_knob.description.initial,
    };
    return passes_subdivision_choose(context->scene, material, &request);
}

/// Whether the material still has the factors that the answer depends on.
static bool has_factors(const prepared_lobes *prepared, const device_material *material) {
    return prepared->metallic == material->metallic &&
           memcmp(prepared->base_colour, material->material->base_colour,
                  sizeof prepared->base_colour) == 0;
}

static void find_width_colours(const filter_context *context, const device_material *material,
                               prepared_lobes *prepared) {
    prepared->has_width_colours = true;
    prepared->width_colours = passes_widths_have_colours(context->scene, material);
    memcpy(prepared->base_colour, material->material->base_colour, sizeof prepared->base_colour);
    prepared->metallic = material->metallic;
}

static lobe_result prepare(const filter_context *context, uint32_t index, void **slot) {
    const device_material *material = &context->scene->materials[index];
    const bool subdivided = needs_subdivision(context, index),
               coloured = widths_may_have_colours(context, material);
    if (!*slot && (subdivided || coloured))
        *slot = lobe_allocate(lobe_host_allocator(context->host), 1, sizeof(prepared_lobes));
    prepared_lobes *prepared = *slot;
    if (!prepared)
        return subdivided || coloured ? LOBE_ERROR_OUT_OF_MEMORY : LOBE_OK;
    if (subdivided && !prepared->has_subdivision)
        prepared->subdivision = choose_subdivision(context, material);
    prepared->has_subdivision |= subdivided;
    if (coloured && !(prepared->has_width_colours && has_factors(prepared, material)))
        find_width_colours(context, material, prepared);
    return LOBE_OK;
}

/// What the user chose, or else what the material's maps need. In an atlas, the clusters' pole
/// differs from that of the maps, so the choice made for the maps does not apply.
static uint32_t subdivision_of(const filter_context *context, const device_material *material,
                               lobe_map_space space, const prepared_lobes *prepared) {
    if (space == LOBE_SPACE_TANGENT && has_one_direction(material))
        return 0;
    uint32_t choice = passes_knob_choice(context, &subdivision_knob);
    if (choice > 0)
        return choice - 1;
    return space == LOBE_SPACE_TANGENT && prepared && prepared->has_subdivision
               ? prepared->subdivision
               : 2;
}

// ---------------------------------------------------------------------------------------------
// Maps

static bool widths_differ(const lobe_material *material) {
    for (uint32_t i = 1; i < material->lobe_count; i++)
        if (material->lobes[i].width != material->lobes[0].width)
            return true;
    return false;
}

/// Whether shading needs the mean normal or the mean length of the base lobes, and cannot derive it
/// from the mixture because their widths or directions vary.
static bool needs_mean(const filter_context *context, const device_material *material,
                       uint32_t subdivision) {
    const lobe_material *source = material->material;
    bool microfacet = source->model == LOBE_MATERIAL_MICROFACET;
    bool along_normal = true;
    for (uint32_t i = 0; !microfacet && i < source->lobe_count; i++)
        along_normal = along_normal && source->lobes[i].direction[2] > 0.99999f;
    bool one_width = microfacet || !widths_differ(source);
    bool derivable = along_normal && one_width && !material->maps[MAP_WIDTH].use;
    bool diffuse =
        source->base_colour[0] > 0 || source->base_colour[1] > 0 || source->base_colour[2] > 0;
    bool by_dispersion = passes_knob_choice(context, &threshold_knob) == THRESHOLD_DISPERSION;
    return (microfacet || diffuse || (by_dispersion && subdivision > 0)) && !derivable;
}

/// The coarsest subdivision that can suffice: 1 where the base lobes of every texel point so far
/// apart that |r| of all of them stays below epsilon0. The single lobe is never fetched then.
static uint32_t coarsest_of(const filter_context *context, const device_material *material,
                            const mixture_map *mixture) {
    const lobe_material *source = material->material;
    if (source->model == LOBE_MATERIAL_MICROFACET || mixture->subdivision == 0 ||
        passes_knob_choice(context, &threshold_knob) != THRESHOLD_LENGTH)
        return 0;
    float mean[3] = {0};
    for (uint32_t i = 0; i < source->lobe_count; i++) {
        for (int axis = 0; axis < 3; axis++)
            mean[axis] += passes_material_lobe_share(source, i) * source->lobes[i].direction[axis];
    }
    double length = sqrt(mean[0] * mean[0] + mean[1] * mean[1] + mean[2] * mean[2]);
    return length <
           passes_knob_value(context, &epsilon0_knob) - passes_knob_value(context, &blend_knob);
}

static bool has_one_hue(const lobe_material *material) {
    if (material->model != LOBE_MATERIAL_HALF_VECTOR_LOBES)
        return true;
    const float *first = material->lobes[0].colour;
    for (uint32_t i = 1; i < material->lobe_count; i++) {
        const float *colour = material->lobes[i].colour;
        for (int a = 0; a < 3; a++) {
            int b = (a + 1) % 3;
            if (fabsf(colour[a] * first[b] - colour[b] * first[a]) >
                1e-4f * fabsf(colour[a] * first[b]) + 1e-6f)
                return false;
        }
    }
    return true;
}

static void specialise_mixture(const lobe_material *material, const mixture_map *mixture,
                               uint32_t coarsest, filtered_appearance *appearance) {
    passes_appearance_specialise(appearance, SPECIALISE_ONE_HUE, has_one_hue(material));
    passes_appearance_specialise(appearance, SPECIALISE_SUBDIVISION, mixture->subdivision);
    passes_appearance_specialise(appearance, SPECIALISE_COARSEST, coarsest);
    passes_appearance_specialise(appearance, SPECIALISE_MEAN_LAYER, mixture->mean_layer);
    passes_appearance_specialise(appearance, SPECIALISE_WEIGHTED, mixture->weighted);
    passes_appearance_specialise(appearance, SPECIALISE_KEPT_LAYER, mixture->kept_layer);
    passes_appearance_specialise(appearance, SPECIALISE_WIDTH_LAYER, mixture->width_layer);
    passes_appearance_specialise(appearance, SPECIALISE_WIDTH_COLOURS, mixture->width_colours);
    passes_appearance_specialise(appearance, SPECIALISE_SPACE,
                                 mixture->space == LOBE_SPACE_CAMERA   ? SPACE_CAMERA
                                 : mixture->space == LOBE_SPACE_OBJECT ? SPACE_OBJECT
                                                                       : SPACE_TANGENT);
}

static mixture_map build_mixture(const filter_context *context, size_t instance,
                                 const prepared_lobes *prepared, filtered_appearance *appearance) {
    const device_instance *drawn = &context->scene->instances[instance];
    const device_material *material = &context->scene->materials[drawn->material];
    lobe_map_space space = space_of(context, instance);
    const uint32_t subdivision = subdivision_of(context, material, space, prepared);
    const mixture_request request = {
        .space = space,
        .subdivision = subdivision,
        .clusters = passes_knob_choice(context, &clusters_knob),
        .mean = needs_mean(context, material, subdivision) || needs_widths(context, material),
        .widths = needs_widths(context, material),
        .width_colours =
            widths_may_have_colours(context, material) && prepared && prepared->width_colours,
    };
    mixture_map mixture = passes_lobe_clustering(context, instance, &request);
    passes_level_reduction(context->graph, &mixture.map);
    specialise_mixture(material->material, &mixture, coarsest_of(context, material, &mixture),
                       appearance);
    return mixture;
}

static void build(const filter_context *context, size_t instance, const void *prepared,
                  filtered_appearance *appearance) {
    const uint32_t material = context->scene->instances[instance].material;
    const lobe_grid grid = passes_lobe_grid(&context->scene->materials[material]);
    const bool varies = passes_lobe_grid_varies(&grid);
    mixture_map mixture = {0};
    if (varies)
        mixture = build_mixture(context, instance, prepared, appearance);
    passes_lobe_map_bind(context, material, "mixture_map", varies ? &mixture.map : NULL,
                         mixture.format, appearance);
}

/// One mixture represents all lobes of a material, in the colour of their sum.
static const char *ignores(const lobe_scene *scene, const device_material *material) {
    (void)scene;
    if (has_one_hue(material->material))
        return NULL;
    return "lobes of different hues get their mean hue";
}

const lobe_filter passes_filter_lobes = {
    .name = "lobes",
    .summary = "MIP-mapped mixtures of lobes, subdivided where a pixel needs it",
    .paper = "Xu et al. 2017, Real-Time Linear BRDF MIP-Mapping",
    .shading = "lobes",
    .shading_cost = 2.7f,
    .keeps_widths = true,
    .knobs = knobs,
    .fetches_for_lights = true,
    .prepare = prepare,
    .forget = lobe_release,
    .for_each_instance = for_each_instance,
    .build = build,
    .ignores = ignores,
};
