#include "passes/context/shared_knobs.h"

#include "shaders/interface/environment/environment_light.h"
#include "shaders/interface/specialisation.h"

static const char *const views[] = {"radiance", "lobes", "level", "samples", NULL};
static const char *const sample_counts[] = {"1", "2", "4", "8", "auto", NULL};
static const char *const shadings[] = {"triangles", "deferred", "auto", NULL};
static const char *const bases[] = {"exact", "lobe", NULL};

static const char *const displacements[] = {"none", "geometry", NULL};

static const char *const shadow_extents[] = {"none", "512", "1024", "2048", "4096", NULL};

static const char *const methods[] = {"exact", "mip", "prefiltered", "sampled", NULL};
static const char *const sizes[] = {"16", "32", "64", "128", "256", "512", "1024", "2048", NULL};
static const char *const level_blends[] = {"trilinear", "blended", NULL};
static const char *const horizons[] = {"ignored", "clipped", "faded", NULL};
static const char *const scatterings[] = {"single", "multiple", NULL};
static const char *const normal_mappings[] = {"classic", "microfacet", NULL};

static const char environment_summary[] =
    "how light from an environment is integrated: over all its texels; with one fetch from its MIP "
    "chain; with a few fetches from levels filtered with lobes; or over a grid of samples";

const filter_knob passes_knob_view = {
    .description = {.name = "view",
                    .summary = "what the picture shows: radiance, lobes evaluated, MIP level, or "
                               "samples taken",
                    .kind = LOBE_KNOB_CHOICE,
                    .maximum = 3,
                    .choices = views},
    .feeds = KNOB_FEEDS_CONSTANT(SPECIALISE_VIEW),
};
const filter_knob passes_knob_samples = {
    .description = {.name = "samples",
                    .summary = "filtered samples of each pixel; auto: 8 where one is not enough, "
                               "else 1; the reference ignores it",
                    .kind = LOBE_KNOB_CHOICE,
                    .maximum = 4,
                    .choices = sample_counts},
};
const filter_knob passes_knob_shading = {
    .description = {.name = "shading",
                    .summary = "surfaces are shaded as their triangles are drawn, or afterwards, "
                               "from a picture of what is seen of them; auto: where that is likely "
                               "to be faster",
                    .kind = LOBE_KNOB_CHOICE,
                    .maximum = 2,
                    .initial = 2,
                    .choices = shadings},
};
const filter_knob passes_knob_base = {
    .description =
        {.name = "base",
         .summary = "evaluate base lobes as they are, or turned into von Mises-Fisher lobes first",
         .kind = LOBE_KNOB_CHOICE,
         .maximum = 1,
         .choices = bases},
    .feeds = KNOB_FEEDS_CONSTANT(SPECIALISE_BASE_AS_LOBE),
};

const filter_knob passes_knob_displacement = {
    .description = {.name = "displacement",
                    .summary = "height maps are ignored, or displace the surface's geometry",
                    .kind = LOBE_KNOB_CHOICE,
                    .maximum = 1,
                    .choices = displacements},
};
const filter_knob passes_knob_pixels_per_vertex = {
    .description = {.name = "pixels_per_vertex",
                    .summary = "of displaced geometry: how far vertices are apart, at least 0.5; "
                               "0: 8 on CPUs, 3 on GPUs, 0.5 for the reference",
                    .maximum = 64},
};

const filter_knob passes_knob_shadows = {
    .description = {.name = "shadows",
                    .summary = "texels a side of the maps by which surfaces shadow each other from "
                               "lights; none: they do not",
                    .kind = LOBE_KNOB_CHOICE,
                    .maximum = 4,
                    .choices = shadow_extents},
};

// passes/environment/light.c chooses the shader's method: it also depends on the maps built so far.
const filter_knob passes_knob_environment = {
    .description = {.name = "env",
                    .summary = environment_summary,
                    .kind = LOBE_KNOB_CHOICE,
                    .maximum = 3,
                    .initial = 2,
                    .choices = methods,
                    .sweep = "mip,sampled", // without exact, which takes hours
                    .environment = true},
};
const filter_knob passes_knob_reference_environment = {
    .description = {.name = "env",
                    .summary = environment_summary,
                    .kind = LOBE_KNOB_CHOICE,
                    .maximum = 3,
                    .choices = methods,
                    .environment = true},
};
const filter_knob passes_knob_environment_size = {
    .description = {.name = "env_size",
                    .summary =
                        "texels along an edge of the cube map that the environment is resampled to",
                    .kind = LOBE_KNOB_CHOICE,
                    .maximum = 7,
                    .initial = 4,
                    .choices = sizes,
                    .environment = true},
};
const filter_knob passes_knob_environment_probes = {
    .description = {.name = "env_probes",
                    .summary = "prefiltered: largest number of round lobes per elongated lobe",
                    .kind = LOBE_KNOB_INTEGER,
                    .minimum = 1,
                    .maximum = 8,
                    .initial = 2,
                    .sweep = "1,4,8",
                    .environment = true},
    .feeds = KNOB_FEEDS_CONSTANT(SPECIALISE_ENVIRONMENT_PROBES),
};
const filter_knob passes_knob_environment_levels = {
    .description = {.name = "env_levels",
                    .summary = "prefiltered: lobes between levels are blends of two levels or, "
                               "more accurately, of one level each of two cubes (except GGX lobes)",
                    .kind = LOBE_KNOB_CHOICE,
                    .maximum = 1,
                    .choices = level_blends,
                    .sweep = "blended",
                    .environment = true},
    .feeds = KNOB_FEEDS_CONSTANT(SPECIALISE_ENVIRONMENT_BLENDED),
};
const filter_knob passes_knob_environment_grid = {
    .description = {.name = "env_grid",
                    .summary = "sampled: samples along each side of the grid",
                    .kind = LOBE_KNOB_INTEGER,
                    .minimum = 2,
                    .maximum = 8,
                    .initial = 5,
                    .sweep = "3,7",
                    .sweep_with = "env=sampled",
                    .environment = true},
    .feeds = KNOB_FEEDS_CONSTANT(SPECIALISE_ENVIRONMENT_GRID),
};
const filter_knob passes_knob_environment_window = {
    .description =
        {.name = "env_window",
         .summary =
             "how strongly ringing in the nine harmonics of diffuse light is damped; 0: not at all",
         .maximum = 0.95,
         .environment = true},
};
const filter_knob passes_knob_horizon = {
    .description = {.name = "horizon",
                    .summary = "the part of a lobe below the surface: lit like the rest, cut off, "
                               "or faded with the part above",
                    .kind = LOBE_KNOB_CHOICE,
                    .maximum = 2,
                    .initial = 1,
                    .choices = horizons,
                    .sweep = "ignored,faded",
                    .environment = true},
    .feeds = KNOB_FEEDS_CONSTANT(SPECIALISE_HORIZON),
};
const filter_knob passes_knob_scattering = {
    .description = {.name = "scattering",
                    .summary =
                        "microfacets reflect light once, or also between themselves, without loss",
                    .kind = LOBE_KNOB_CHOICE,
                    .maximum = 1,
                    .choices = scatterings},
    .feeds = KNOB_FEEDS_CONSTANT(SPECIALISE_MULTIPLE_SCATTERING),
};
const filter_knob passes_knob_normal_mapping = {
    .description = {.name = "normal_mapping",
                    .summary = "texels' facets lie in the surface, as in engines, and are black "
                               "where they face away; or they tilt out of it, hide what is behind "
                               "them, and lose no light",
                    .kind = LOBE_KNOB_CHOICE,
                    .maximum = 1,
                    .choices = normal_mappings},
};

const filter_knob *const passes_shared_knobs[] = {
    &passes_knob_view,
    &passes_knob_samples,
    &passes_knob_shading,
    &passes_knob_base,
    &passes_knob_displacement,
    &passes_knob_pixels_per_vertex,
    &passes_knob_shadows,
    &passes_knob_environment,
    &passes_knob_environment_size,
    &passes_knob_environment_probes,
    &passes_knob_environment_levels,
    &passes_knob_environment_grid,
    &passes_knob_environment_window,
    &passes_knob_horizon,
    &passes_knob_scattering,
    NULL,
};
