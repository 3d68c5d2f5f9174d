#ifndef LOBE_RENDERER_H
#define LOBE_RENDERER_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include <lobe/device.h>
#include <lobe/filter.h>
#include <lobe/graph.h>
#include <lobe/image.h>
#include <lobe/scene.h>

#ifdef __cplusplus
extern "C" {
#endif

/// Draws scenes with filters. Owns a render graph and the device copy of one scene.
/// Not thread-safe: one renderer, one thread.
typedef struct lobe_renderer lobe_renderer;

/// `host` is copied; NULL: silent. Memory comes from where the device gets it: see
/// lobe_device_allocator.
lobe_result lobe_renderer_create(lobe_device *device, const lobe_host *host,
                                 lobe_renderer **renderer);
/// Clears the pointer; NULL is fine. The device stays.
void lobe_renderer_destroy(lobe_renderer **renderer);

/// Uploads a scene and forgets the one before. The scene must live as long as it is set; NULL
/// only forgets. Errors: LOBE_ERROR_LIMIT, LOBE_ERROR_OUT_OF_DEVICE_MEMORY, LOBE_ERROR_MALFORMED
/// (no triangles, an index out of range, a vertex or texel that is not finite).
lobe_result lobe_renderer_set_scene(lobe_renderer *renderer, const lobe_scene *scene);

/// What of a scene has changed, by indices into its arrays; each array may be NULL where its count
/// is 0, and name what no instance uses.
typedef struct lobe_scene_changes {
    const uint32_t *images; ///< texels; also extent or format
    size_t image_count;
    const uint32_t *materials; ///< anything of them
    size_t material_count;
    const uint32_t *meshes; ///< vertices and indices; also their numbers
    size_t mesh_count;
    const uint32_t *instances; ///< transform, mesh or material
    size_t instance_count;
    /// The environment's image, layout or whether there is one. Its rotation and intensity are read
    /// in each frame.
    bool environment;
} lobe_scene_changes;

/// Takes over what the host changed in the scene that is set; uploads no more than that, and in the
/// next frame maps are built again only where they depend on it. The scene's arrays must have as
/// many elements as before. Lights, their number, the scene's camera, background and bounds are
/// read in each frame: they may change without a word, as may instances that only move.
/// Errors: LOBE_ERROR_INVALID_ARGUMENT (no scene is set, an index out of range),
/// LOBE_ERROR_MALFORMED, as for lobe_renderer_set_scene: all is then as before. After others, such
/// as LOBE_ERROR_OUT_OF_DEVICE_MEMORY, no scene is set any more.
lobe_result lobe_renderer_update_scene(lobe_renderer *renderer, const lobe_scene_changes *changes);

/// Largest number of samples a pixel of the reference.
#define LOBE_MAXIMUM_SAMPLES 4096

/// Images of the host's Vulkan that a picture is drawn into.
typedef struct lobe_render_target {
    /// A colour attachment. Gets linear radiance, as its format keeps it (an _SRGB format encodes
    /// it; neither exposure nor tone map is applied), and coverage as alpha.
    const lobe_vulkan_image *radiance;
    /// D32_FLOAT, reversed: 1 at the near plane, 0 at infinity. NULL: one of lobe's own, which the
    /// reference asks for.
    const lobe_vulkan_image *depth;
    /// Draw over what they hold: the background stays the host's, and what it drew into `depth`
    /// hides what lies behind it. Otherwise both are cleared. The reference is blended over it by
    /// its coverage, for which the format must be one that the device blends.
    bool keep;
} lobe_render_target;

/// The resources of a frame, for passes of the host.
typedef struct lobe_render_resources {
    uint32_t width, height; ///< pixels
    lobe_resource radiance; ///< RGBA32_FLOAT, or the target's
    lobe_resource depth;    ///< D32_FLOAT, reversed
    /// As in lobe_frame; none unless asked for.
    lobe_resource normal_depth, lobes_level;
} lobe_render_resources;

/// Where in a frame passes of the host are added.
typedef enum lobe_render_stage {
    /// Nothing is drawn yet. Of radiance and depth, what the host's passes write here is drawn
    /// over and not cleared.
    LOBE_RENDER_BEFORE_SHADING,
    /// The picture is drawn. `radiance` may become another image of the same extent and format:
    /// that one is delivered then.
    LOBE_RENDER_AFTER_SHADING,
} lobe_render_stage;

typedef struct lobe_render_parameters {
    const lobe_filter *filter;     ///< NULL: "lobes"
    const lobe_settings *settings; ///< NULL: the filter's defaults
    const lobe_camera *camera;     ///< NULL: the scene's
    uint32_t width, height;        ///< pixels; 0: 1280, 720
    /// Samples a pixel, [1, LOBE_MAXIMUM_SAMPLES]; 0: 64. Used by the reference alone.
    uint32_t samples;
    /// Which of many patterns the samples lie in: pictures of different patterns have errors of
    /// their own, by which noise can be told from what is true. Used by the reference alone.
    uint32_t pattern;
    /// Parts of the work on an environment's filtered maps (levels, or faces of large levels) to do
    /// in this frame at most; until all is done, frames are lit by the maps of the environment
    /// before, or else by its plain MIP chain. 0: all at once.
    uint32_t environment_parts;
    /// An existing folder where the environment's filtered maps are kept, as OpenEXR files named
    /// after what they were made from: it is looked into when maps are first needed, and again when
    /// the environment has changed. Those that are there are not made; others are added in the
    /// frame in which they are complete, which takes longer for it (with `submission`: in the next
    /// one; never where several are in flight). A damaged or foreign file is passed over with a
    /// notice and replaced; a folder that takes no files is told in a warning. Files may be removed
    /// at any time. Pictures are the same with and without. Read during the call. NULL: none.
    const char *environment_cache;
    /// Also deliver depth, normal, lobe count and level (one sample, at the pixel's centre).
    bool arbitrary_output_variables;
    /// Build every map again, as if the scene had changed.
    bool rebuild;
    /// With `rebuild`: but not those of the environment, as if the materials alone had changed.
    bool keep_environment;
    /// Leave the result on the device: no image is delivered. For timing.
    bool discard;
    /// Called between submissions with the part done, [0, 1]; returning false stops the
    /// rendering with LOBE_OK and an empty frame. NULL: none.
    bool (*progress)(void *user, double part);
    /// Called once a stage while the frame's graph is declared: adds passes of the host's to it.
    /// New versions of what they write go back into `resources`. Mistakes stay in the graph.
    /// NULL: none.
    void (*add_passes)(void *user, lobe_graph *graph, lobe_render_stage stage,
                       lobe_render_resources *resources);
    void *user; ///< handed to both
    /// Where to draw to. NULL: an image of lobe's own, delivered in the frame. Otherwise no
    /// radiance is delivered, and `width` and `height` are 0 or the target's.
    const lobe_render_target *target;
    /// How the frame gets to the device, see lobe_graph_submit. Nothing is waited for and nothing
    /// delivered then: lobe_graph_wait on the renderer's graph waits. NULL: lobe submits it, waits
    /// and delivers. The reference's samples are taken and waited for before, whatever this says:
    /// it is how their mean then gets into the target.
    const lobe_vulkan_submission *submission;
    /// With `submission`: see lobe_graph_set_frames_in_flight; 0: 1.
    uint32_t frames_in_flight;
} lobe_render_parameters;

/// Device time of all passes of one name.
typedef struct lobe_pass_time {
    char name[64];
    double milliseconds;
    uint32_t count; ///< how many of the name ran
    /// What they must read and write together: see lobe_pass_report.
    uint64_t read_bytes, written_bytes;
} lobe_pass_time;

/// A finished frame. Images are owned by the frame; free with lobe_frame_free.
typedef struct lobe_frame {
    lobe_image radiance; ///< RGBA32_FLOAT, linear RGB radiance and coverage
    /// RGBA32_FLOAT: world-space unit shading normal, and distance along the view axis in metres
    /// (0 where nothing is hit). Empty unless asked for.
    lobe_image normal_depth;
    /// RG32_FLOAT: lobes evaluated, and MIP level of the filtered maps (0: the maps themselves).
    /// Empty unless asked for.
    lobe_image lobes_level;
    double milliseconds;      ///< device time of all submissions
    double host_milliseconds; ///< CPU time to compile and record them: see lobe_graph_report
    uint32_t submissions;     ///< how many frames of the graph it took
    /// Of the work on the environment's filtered maps: left to do in frames to come, which are lit
    /// otherwise than this one then. See `environment_parts`.
    uint32_t environment_parts_left;
    lobe_pass_time *passes; ///< those that ran, in order of their first run
    size_t pass_count;
    /// Size of the maps that the filter built: device bytes, and texels of the base maps they
    /// stand for. Their ratio is the memory a filter costs a texel.
    uint64_t filtered_bytes, base_texels;
} lobe_frame;

void lobe_frame_free(lobe_frame *frame);

/// Renders one image. On failure `*frame` is zero, and a command buffer of the host's must not be
/// submitted. Errors: LOBE_ERROR_INVALID_ARGUMENT (no scene, a value out of range, another extent
/// than the target's), LOBE_ERROR_UNSUPPORTED (the reference, which takes many submissions, with
/// passes of the host's, a target's depth, or a submission without a target), LOBE_ERROR_LIMIT
/// (size), LOBE_ERROR_OUT_OF_DEVICE_MEMORY, ...
lobe_result lobe_renderer_render(lobe_renderer *renderer, const lobe_render_parameters *parameters,
                                 lobe_frame *frame);

/// The graph of the last frame (of a reference: its last submission), for dumps and reports.
lobe_graph *lobe_renderer_graph(lobe_renderer *renderer);

#ifdef __cplusplus
}
#endif

#endif
