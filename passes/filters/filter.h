#ifndef PASSES_FILTERS_FILTER_H
#define PASSES_FILTERS_FILTER_H

#include <lobe/filter.h>
#include <lobe/graph.h>
#include <lobe/scene.h>

#include "passes/upload/device_scene.h"

#define FILTER_MAXIMUM_BINDINGS        8
#define FILTER_MAXIMUM_SPECIALISATIONS 40

/// What the filter's maps of one instance come to: inputs of its draw in the shading pass.
typedef struct filtered_appearance {
    lobe_binding bindings[FILTER_MAXIMUM_BINDINGS];
    size_t binding_count;
    lobe_specialisation specialisation[FILTER_MAXIMUM_SPECIALISATIONS];
    size_t specialisation_count;
    uint64_t bytes;       ///< device memory of the maps built for this appearance alone
    uint64_t base_texels; ///< texels of the base maps they stand for
} filtered_appearance;

/// Filtered versions of the scene's images in this frame: shared by all materials that use them.
typedef struct filtered_images {
    lobe_resource *resources; ///< one an image of the scene; none where it is not built yet
    uint64_t bytes;
} filtered_images;

/// What a filter may use to build its maps.
typedef struct filter_context {
    lobe_graph *graph;
    const lobe_settings *settings;
    const lobe_filter *filter;
    const device_scene *scene;
    const lobe_camera *camera;
    uint32_t width, height; ///< of the picture, pixels
    filtered_images *images;
    const lobe_host *host;
} filter_context;

struct lobe_filter {
    const char *name;
    const char *summary;
    const char *paper;
    /// File in shaders/filters that shades, without its ending.
    const char *shading;
    const lobe_knob *const *knobs; ///< its own, ended by NULL; NULL: none
    bool supersamples;
    /// True where the maps depend on the instance (its mesh, its transform, the camera) and not
    /// on the material alone. NULL: never.
    bool (*for_each_instance)(const filter_context *context, size_t instance);
    /// Adds the passes that build the maps of an instance's material, and says how they are read.
    /// Mistakes of declaration stay in the graph. NULL: there are none.
    void (*build)(const filter_context *context, size_t instance, filtered_appearance *appearance);
    /// What of a material the filter cannot represent, as a phrase for a warning; NULL: nothing.
    /// The pointer itself may be NULL.
    const char *(*ignores)(const lobe_material *material);
};

/// All filters, ended by NULL: the one place that lists them (passes/filters/table.c).
extern const lobe_filter *const passes_filter_table[];

double passes_filter_setting(const filter_context *context, const char *knob);

void passes_appearance_bind(filtered_appearance *appearance, const char *name,
                            lobe_resource resource, lobe_sampler sampler);
void passes_appearance_specialise(filtered_appearance *appearance, uint32_t id, uint32_t bits);
void passes_appearance_specialise_number(filtered_appearance *appearance, uint32_t id, float value);

#endif
