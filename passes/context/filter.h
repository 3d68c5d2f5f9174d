#ifndef PASSES_CONTEXT_FILTER_H
#define PASSES_CONTEXT_FILTER_H

#include <lobe/device.h>
#include <lobe/filter.h>
#include <lobe/graph.h>
#include <lobe/scene.h>

#include "passes/context/knob.h"
#include "passes/upload/device_scene.h"

#define FILTER_MAXIMUM_BINDINGS        20
#define FILTER_MAXIMUM_SPECIALISATIONS 40

/// What a filter built for one instance: inputs of its draw in the shading pass.
typedef struct filtered_appearance {
    lobe_graph *graph; ///< overflowing lists are reported here
    lobe_binding bindings[FILTER_MAXIMUM_BINDINGS];
    size_t binding_count;
    lobe_specialisation specialisation[FILTER_MAXIMUM_SPECIALISATIONS];
    size_t specialisation_count;
    uint64_t bytes;       ///< device memory of the maps built for this appearance alone
    uint64_t base_texels; ///< texels of the base maps that those replace
} filtered_appearance;

/// Filtered versions of the scene's images in this frame, shared by all that use them.
typedef struct filtered_images {
    lobe_resource *resources; ///< one for each image of the scene; version 0: not built yet
    lobe_resource *masked;    ///< colours of what a mask keeps: one for each material of the scene
    lobe_resource *metal;     ///< where it is metal (passes/maps/colours/metal_means.h): the same
    lobe_resource *normals;   ///< of its colours (passes/maps/colours/colour_normals.h): the same
    lobe_resource *widths;    ///< of its lobes (passes/maps/colours/width_means.h): the same
    /// Whether colours follow these (passes/maps/colours/colour_correlation.h): the same.
    lobe_resource *correlations;
    uint64_t bytes;
} filtered_images;

/// How many resources the arrays of filtered_images have in all.
size_t passes_filtered_images_count(const lobe_scene *scene);
/// Divides `resources`, so many, among these arrays.
filtered_images passes_filtered_images_of(lobe_resource *resources, const lobe_scene *scene);

typedef struct filter_view {
    const lobe_camera *camera;
    uint32_t width, height; ///< of the picture, pixels
} filter_view;

/// What a filter may use.
typedef struct filter_context {
    lobe_graph *graph;
    const lobe_device_information *device; ///< NULL where nothing is drawn
    const device_scene *scene;
    filter_view view;
    const lobe_filter *filter;
    const lobe_settings *settings; ///< of that filter
    filtered_images *images;
    struct fit_work *work; ///< NULL: fitted maps are made whole (passes/context/fit_work.h)
    const struct tile_marks *marks; ///< NULL: maps are made whole (passes/maps/seen_tiles.h)
    const lobe_host *host;          ///< log and memory
} filter_context;

/// Whether a filter turns microfacets into Gaussian slopes (Beckmann's distribution), and how these
/// mask each other.
typedef enum filter_slopes {
    FILTER_NO_SLOPES,
    FILTER_SLOPES_MASKED_AS_MATERIAL,
    FILTER_SLOPES_MASKED_AS_SLOPES,
} filter_slopes;

struct lobe_filter {
    const char *name;
    const char *summary;
    const char *paper;
    /// File in shaders/filters that shades, without its ending.
    const char *shading;
    float shading_cost; ///< about how many times as long as `direct` it shades a pixel; 0: as long
    const filter_knob *const *knobs; ///< its own, NULL-terminated; NULL: none
    bool supersamples;
    bool reads_heights;      ///< of materials, whether they displace geometry or not
    bool stretches_slopes;   ///< those of heights: the shader reads STRETCHED
    bool draws_waves;        ///< the shader has a variant WAVES
    bool fetches_for_lights; ///< the shader fetches maps for each four lights
    bool fetches_texels;     ///< the shader reads the lobes' map texel by texel
    /// The shader reads the environment's moments over hemispheres for materials with heights.
    bool gathers_moments;
    /// Shades reliefs by how much microfacets reflect of light from everywhere, in any light.
    bool reads_albedo;
    /// Microfacets are as rough as the material says: normals that vary widen no base lobe, except
    /// those of level 0 inside a pixel.
    bool keeps_widths;
    bool moves_masks; ///< the shader reads a mask elsewhere than at the surface that is drawn
    /// Shading runs loops for each light, which devices may cut short if there are many.
    bool loops_for_lights;
    filter_slopes slopes;
    /// Computes on the host what the filter keeps of a material from frame to frame, into the
    /// filter's own slot for that material and the current values of the knobs that decide slots;
    /// no other knob may decide what is kept. Called in every frame, before `build`, for each
    /// material that is drawn, so it must return at once if the slot is still valid. `*slot` is
    /// NULL at first, and again after the material's lobes or texels of its maps have changed, but
    /// not after its base colour, emission or occlusion alone. Memory comes from `context->host`.
    /// Logs nothing: a failure fails the frame, with one line. The slot must then still be valid
    /// for `forget` or another attempt. NULL: the filter keeps nothing.
    lobe_result (*prepare)(const filter_context *context, uint32_t material, void **slot);
    /// What is kept of a material serves other texels in the same maps, too: `build` adds passes
    /// that adapt it. The slot then stays valid when nothing but texels has changed.
    bool adapts_to_texels;
    /// The same of the material's numbers, such as its roughness: `prepare` is called when these
    /// have changed, with the slot that there is, and decides.
    bool adapts_to_factors;
    /// Saves in a folder what `build` read back of the last frame, whose execution was waited for;
    /// NULL: drops it. The function itself may be NULL: the filter reads nothing back.
    void (*save)(void *slot, const lobe_graph *graph, const char *folder, const lobe_host *host);
    /// Frames can make a share of what is saved, and join the shares of all (fit_work).
    bool shares;
    /// Frees what `prepare` put into a slot; never called with NULL. Required if there is a
    /// `prepare`.
    void (*forget)(void *slot);
    /// True if the maps depend on the instance (its mesh, its transform, the camera), not only on
    /// the material. NULL: never.
    bool (*for_each_instance)(const filter_context *context, size_t instance);
    /// Adds the passes that build the maps of an instance's material, and binds them to its draw.
    /// `prepared` is what `prepare` left in the slot. The graph keeps errors in the declaration.
    /// NULL: the filter has no maps.
    void (*build)(const filter_context *context, size_t instance, const void *prepared,
                  filtered_appearance *appearance);
    /// What the filter cannot represent of a material that is on the device in this scene, as a
    /// phrase for a warning; NULL: nothing. The pointer itself may be NULL.
    const char *(*ignores)(const lobe_scene *scene, const device_material *material);
};

/// All filters, NULL-terminated: the only list of them (passes/filters/table.c).
extern const lobe_filter *const passes_filter_table[];

// More than FILTER_MAXIMUM_... of either fails the frame.
void passes_appearance_bind(filtered_appearance *appearance, const char *name,
                            lobe_resource resource, lobe_sampler sampler);
void passes_appearance_specialise(filtered_appearance *appearance, uint32_t id, uint32_t bits);

/// Warns about each material on the device that the filter cannot fully represent.
void passes_filter_warn(const lobe_filter *filter, const device_scene *scene,
                        const lobe_host *host);

/// Adds a name to a list for a message, after a comma unless it is the first.
void passes_append_name(char *names, size_t size, const char *name);

#endif
