#ifndef PASSES_ENVIRONMENT_LIGHT_H
#define PASSES_ENVIRONMENT_LIGHT_H

#include "passes/context/filter.h"
#include "passes/context/material_specialisation.h"
#include "passes/environment/cache/cached_cubes.h"
#include "passes/environment/hemispheres/irradiance_harmonics.h"
#include "shaders/interface/specialisation.h"

/// What a renderer keeps of an environment's maps between frames; all zero: nothing.
typedef struct environment_state {
    environment_maps_progress progress;
    environment_maps last; ///< of the last frame
    cached_cubes store;
    bool reads_back; ///< the last frame reads back cubes to save
} environment_state;

/// How one frame makes the environment's maps.
typedef struct environment_work {
    environment_state *state;
    uint32_t parts;    ///< maximum number of parts of the work in this frame; 0: all
    const char *cache; ///< folder of cached maps; NULL: none
    bool saves;        ///< adds missing maps to the cache
} environment_work;

/// The sample of each pixel that a shading pass draws.
typedef struct shading_sample {
    float position[2];        ///< in the pixel, [0, 1] each
    float footprint;          ///< side of the square that it stands for, pixels
    float dither;             ///< [0, 1): added to the thresholds of masks
    uint32_t number, pattern; ///< of the reference: which sample of which pattern
} shading_sample;

/// The scene's environment as the shading pass reads it (shaders/environment/environment.glsl).
/// Only the maps that the method uses are made.
typedef struct environment_light {
    bool present;       ///< false: the scene has no environment
    uint32_t method;    ///< ENVIRONMENT_...
    lobe_resource cube; ///< radiance with all levels
    /// Filtered with lobes; the plain MIP chain where the method does not use them.
    lobe_resource prefiltered, prefiltered_ggx, between;
    irradiance_maps irradiance;
    /// Directional albedo by the distribution of microfacets and that of their masking; none where
    /// no material needs it.
    lobe_resource albedo[DISTRIBUTION_COUNT][DISTRIBUTION_COUNT];
    /// The lobes that microfacets reflect, by the same; what rough ones gather of the light, and
    /// the moments that they gather with; none where no material does.
    lobe_resource lobes[DISTRIBUTION_COUNT][DISTRIBUTION_COUNT];
    lobe_resource broad[DISTRIBUTION_COUNT][DISTRIBUTION_COUNT], moments;
} environment_light;

/// LOBE_ERROR_UNSUPPORTED, with one line, for a method that the filter cannot combine with its
/// other knobs.
lobe_result passes_environment_light_check(const filter_context *context);

/// Loads the maps that this frame needs from the cache, if there is one. Call it before the frame
/// begins. Errors: LOBE_ERROR_OUT_OF_DEVICE_MEMORY, ...
lobe_result passes_environment_light_load(const filter_context *context,
                                          const environment_work *work, lobe_device *device);

/// Parts of the work on the maps that the next frames have to do.
uint32_t passes_environment_light_parts_left(const filter_context *context,
                                             const environment_work *work);

/// Saves the maps that the last frame read back (`reads_back`) to the cache. The device must have
/// finished that frame, and the next must not have begun.
void passes_environment_light_save(const environment_work *work, const lobe_graph *graph,
                                   const lobe_host *host);

/// Rebuilds the maps from the next frame on: the scene's environment has changed.
void passes_environment_light_invalidate(environment_state *state);
/// Frees what belongs to an environment or scene that is gone.
void passes_environment_light_forget(environment_state *state);

/// Adds the passes that make the maps.
environment_light passes_environment_light_build(const filter_context *context,
                                                 const environment_work *work);

/// Binds the maps to all draws of a shading pass.
void passes_environment_light_bind(const environment_light *light, const filter_context *context,
                                   lobe_pass *pass, const shading_sample *sample);

/// How many of `lights` punctual lights the shaders evaluate together.
uint32_t passes_environment_light_lights_at_once(const environment_light *light, uint32_t lights);

void passes_environment_light_specialise(const environment_light *light,
                                         const filter_context *context,
                                         const device_material *material,
                                         specialisation_list *list);

/// Most bindings of a material.
#define ENVIRONMENT_MATERIAL_BINDINGS 7

/// Binds the tables of a material's reflection for its draws; returns how many bindings there are.
size_t passes_environment_light_bind_material(const environment_light *light,
                                              const filter_context *context,
                                              const lobe_material *material,
                                              lobe_binding bindings[ENVIRONMENT_MATERIAL_BINDINGS]);

#endif
