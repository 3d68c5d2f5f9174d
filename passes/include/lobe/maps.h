#ifndef LOBE_MAPS_H
#define LOBE_MAPS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include <lobe/api.h>
#include <lobe/device.h>
#include <lobe/filter.h>
#include <lobe/graph.h>
#include <lobe/host.h>
#include <lobe/renderer.h>
#include <lobe/result.h>
#include <lobe/scene.h>

#ifdef __cplusplus
extern "C" {
#endif

/// The filtering alone, for a host that draws with Vulkan pipelines of its own: the maps of
/// materials and of an environment, recorded into the host's command buffer. The host's shaders
/// include the GLSL that reads them (lobe/moments.glsl and so on; docs/own-shading.md).
/// Not thread-safe: use an object in one thread at a time.
typedef struct lobe_maps lobe_maps;

/// All but `scene` may be zero.
typedef struct lobe_maps_parameters {
    /// Only its images, materials and environment are read: a host need not fill in the rest. It
    /// must live as long as the maps.
    const lobe_scene *scene;
    const lobe_filter *filter;     ///< not one that supersamples; NULL: "moments"
    const lobe_settings *settings; ///< copied; NULL: the filter's defaults
    /// The host's surfaces have colours that tint the materials, and by whose alpha masks may cut.
    bool vertex_colours;
    /// For how many lights the host's shader fetches at once, [1, 4]; 0: 1.
    uint32_t lights_at_once;
    uint32_t frames_in_flight; ///< see lobe_graph_set_frames_in_flight; 0: 1
    /// Gives the texels of images that are `on_device`, and the maps of waves, in every recording,
    /// as for a renderer: retained resources, or images of the host with a view. `vertices` is
    /// NULL.
    lobe_content_giver give_content;
    void *user; ///< passed to it
} lobe_maps_parameters;

/// Uploads the images, and waits for what the device finds in their texels, as far as that decides
/// which maps there are. `host` is copied; NULL: silent. Errors: LOBE_ERROR_INVALID_ARGUMENT,
/// LOBE_ERROR_MALFORMED, LOBE_ERROR_LIMIT, LOBE_ERROR_UNSUPPORTED,
/// LOBE_ERROR_OUT_OF_DEVICE_MEMORY, as for lobe_renderer_set_scene and lobe_renderer_render; the
/// line names the material or image.
LOBE_API lobe_result lobe_maps_create(lobe_device *device, const lobe_maps_parameters *parameters,
                                      const lobe_host *host, lobe_maps **maps);
/// The device must have finished what reads the maps. Clears the pointer; NULL is allowed.
LOBE_API void lobe_maps_destroy(lobe_maps **maps);

/// Takes over what the host changed in the scene, of which `changes` lists images, materials and
/// the environment alone; the rotation and intensity of the environment need not be listed, but
/// only an update takes them over, too. Nothing is submitted or waited for. Errors: as
/// lobe_renderer_update_scene; after one that is not LOBE_ERROR_INVALID_ARGUMENT or
/// LOBE_ERROR_MALFORMED, the maps may have to be made anew, which lobe_maps_record says.
LOBE_API lobe_result lobe_maps_update(lobe_maps *maps, const lobe_scene_changes *changes);

/// Records what must be built into the host's command buffer, or submits it, as for
/// lobe_graph_submit. Nothing is recorded (or submitted) if nothing has changed since the last
/// recording, no image is on the device, no material has waves, and nothing made of texels that
/// moved still comes to rest (lobe_graph_settles). Whatever the host records or
/// submits later may read the maps. Errors: as lobe_renderer_render; the command buffer must not be
/// submitted then.
LOBE_API lobe_result lobe_maps_record(lobe_maps *maps, const lobe_vulkan_submission *submission);

/// What the host's shader reads of a material.
typedef struct lobe_material_maps {
    /// Images in the layout in which they are read, with samplers, and uniform and storage blocks;
    /// those of the environment are the same for all materials. `binding` is to be added to
    /// LOBE_BINDING_BASE.
    const lobe_vulkan_descriptor *descriptors;
    size_t descriptor_count;
    /// For VkSpecializationInfo: 4 bytes each; `id` is to be added to LOBE_CONSTANT_BASE. Shaders
    /// need not have all of them.
    const lobe_specialisation *constants;
    size_t constant_count;
    bool closed_surface; ///< the shader is to be compiled with LOBE_CLOSED_SURFACE
    bool waves;          ///< the same with LOBE_WAVES
} lobe_material_maps;

/// What was recorded last; valid until the next recording. Handles and constants then stay the same
/// unless an update listed a material, or changed an image's extent or format. Where only texels
/// change, neither descriptors nor pipelines need be made anew, with two exceptions, both for maps
/// in host memory: constants become others, once, where metal that was the same in all texels
/// begins to vary; and constants and descriptors do, once, where a mask that kept all texels begins
/// to cut. LOBE_ERROR_INVALID_ARGUMENT: nothing has been recorded, or there is no such material.
LOBE_API lobe_result lobe_maps_get(const lobe_maps *maps, uint32_t material,
                                   lobe_material_maps *result);

/// The graph of the last recording, for reports.
LOBE_API lobe_graph *lobe_maps_graph(lobe_maps *maps);

#ifdef __cplusplus
}
#endif

#endif
