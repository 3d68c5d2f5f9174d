#ifndef LOBE_RENDERER_H
#define LOBE_RENDERER_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include <lobe/api.h>
#include <lobe/device.h>
#include <lobe/filter.h>
#include <lobe/graph.h>
#include <lobe/image.h>
#include <lobe/scene.h>

#ifdef __cplusplus
extern "C" {
#endif

/// Draws scenes with filters. Owns a render graph and the device copy of one scene.
/// Not thread-safe: use a renderer in one thread at a time.
typedef struct lobe_renderer lobe_renderer;

/// `host` is copied; NULL: silent. Memory comes from the device's allocator, see
/// lobe_device_allocator.
LOBE_API lobe_result lobe_renderer_create(lobe_device *device, const lobe_host *host,
                                          lobe_renderer **renderer);
/// Clears the pointer; NULL is allowed. The device is not destroyed.
LOBE_API void lobe_renderer_destroy(lobe_renderer **renderer);

/// Uploads a scene, in place of the current one. The scene must live as long as it is set; NULL
/// only removes the current one. What other renderers of the device have already (texels, meshes,
/// maps) is not uploaded and built again, but used together until somebody changes it.
/// Errors: LOBE_ERROR_LIMIT, LOBE_ERROR_OUT_OF_DEVICE_MEMORY, LOBE_ERROR_MALFORMED (nothing to
/// draw, no triangles, an index out of range, a number that is not finite or outside of its range;
/// the line names the object and the value).
LOBE_API lobe_result lobe_renderer_set_scene(lobe_renderer *renderer, const lobe_scene *scene);

/// Which parts of a scene changed, by indices into its arrays. An array may be NULL where its count
/// is 0, and may list elements that no instance uses.
typedef struct lobe_scene_changes {
    const uint32_t *images; ///< texels; also extent, format or encoding of normals
    size_t image_count;
    /// One for each of `images`: which of its texels changed; all zero: any. NULL: any of all. Only
    /// these are checked, copied and uploaded, unless extent or format changed. An image may be
    /// listed again for another part.
    const lobe_rectangle *image_parts;
    const uint32_t *materials; ///< any of their members
    size_t material_count;
    const uint32_t *meshes; ///< vertices and indices; also how many there are
    size_t mesh_count;
    /// Mesh or material, or another instance at that place. If the scene's array of instances has
    /// more elements than at the last update, those at its end are new, and need not be listed; if
    /// it has fewer, those are gone.
    const uint32_t *instances;
    size_t instance_count;
    /// The environment's image, its layout, or whether there is one. Its rotation and intensity are
    /// read in every frame.
    bool environment;
} lobe_scene_changes;

/// Takes over changes that the host made to the current scene. Uploads only what is listed; the
/// next frame rebuilds only the maps that depend on it.
///
/// Instances are added at the end of the scene's array, which may move, and removed from its end
/// (others by moving the last one to their place, which is then listed); all of them may go. Meshes
/// and materials on the device, and maps of materials that the last frame drew, are used as they
/// are. A mesh or material that had no instance before is uploaded, and stays on the device until
/// another scene is set. The scene's other arrays must keep their lengths. Frames are refused while
/// the number of instances differs from that of the last update that succeeded.
///
/// What the device needs is copied during the call, and reaches it at the start of the next frame,
/// in that frame's submission: nothing is submitted or waited for, whatever frames are in flight.
/// Only what new images and meshes have beyond 16 MiB, what comes before the first frame, and what
/// is too large for the memory that is left, is submitted and waited for in steps of 4 MiB.
/// Where extents, formats and counts stay the same, no Vulkan object is created, once there is
/// memory for as much as frames copy; only of what other renderers use too, this one gets its own.
/// Constants of materials that are equal to those of the device are not written.
///
/// Lights (and their number), the scene's camera, background and bounds, the transforms of
/// instances and whether they are hidden, and the poses and bounds of meshes are read in every
/// frame and need not be listed.
///
/// Errors: LOBE_ERROR_INVALID_ARGUMENT (no scene is set, an index out of range, a part outside),
/// LOBE_ERROR_MALFORMED (as for lobe_renderer_set_scene); nothing has changed then. After any other
/// error, such as LOBE_ERROR_OUT_OF_DEVICE_MEMORY, the scene can still be drawn, with some of the
/// new texels, and updated again, if it failed for texels of images that keep their extents and
/// formats; otherwise no scene is set.
LOBE_API lobe_result lobe_renderer_update_scene(lobe_renderer *renderer,
                                                const lobe_scene_changes *changes);

/// Where a host stores what it gives in a frame.
typedef struct lobe_given_content {
    lobe_resource *images;   ///< one for each image of the scene
    lobe_resource *vertices; ///< one for each mesh
    /// One for each mesh: the vertices of the previous frame, in the same order, for motion (see
    /// lobe_render_motion). None: those of this frame, so that only transforms and the camera move
    /// them. Ignored where no motion is asked for.
    lobe_resource *previous_vertices;
    /// One for each material: the maps of its `waves`, an image of RGBA32_FLOAT with one level and
    /// two layers for each layer of waves, as lobe_ocean_add makes it.
    lobe_resource *waves;
} lobe_given_content;

/// Gives the texels of those images of the scene, and the vertices of those meshes, that are
/// `on_device`, and the maps of waves: adds passes that write them, or imports images and buffers
/// of the host's Vulkan (lobe_graph_import_image, lobe_graph_import_host_buffer), and stores the
/// resources in `content`.
/// Each image has its image's extent, one level, one layer, and a format that is read the same way
/// (linear or sRGB; normals as the scene's image says). A buffer has a lobe_scene_vertex for each
/// vertex of its mesh. Called while a graph is declared, before anything reads a map. A frame may
/// take several graphs, for all of which the content must be the same: one for every eight samples
/// of the reference, and one for each step of `environment_progress` and `fits_progress`. Filtered
/// maps are rebuilt where the texels can have changed: from an image of the host's Vulkan in every
/// frame, or if its `content` has changed; otherwise if the passes that write them read something
/// that changed.
typedef void (*lobe_content_giver)(void *user, lobe_graph *graph,
                                   const lobe_given_content *content);

/// Sets what gives content in all frames from now on, whatever scene is set. NULL: nothing.
LOBE_API void lobe_renderer_set_content_giver(lobe_renderer *renderer, lobe_content_giver give,
                                              void *user);

/// Largest number of samples per pixel of the reference.
#define LOBE_MAXIMUM_SAMPLES 4096

/// Vulkan images of the host that a picture is drawn into.
typedef struct lobe_render_target {
    /// A colour attachment. Receives linear radiance, converted to its format (an _SRGB format
    /// encodes it; neither exposure nor tone mapping is applied), and coverage as alpha.
    const lobe_vulkan_image *radiance;
    /// D32_FLOAT, reversed: near_plane / distance along the view, so 1 at the near plane and 0 at
    /// infinity. Of an orthographic camera it falls linearly, from 1 at the near plane to 0 at 1.01
    /// times the distance of the farthest corner of the scene's bounds, which displaced geometry
    /// widens on all sides by its largest height. More than 64 lights (16, with
    /// normal_mapping=microfacet) need it to have VK_IMAGE_USAGE_TRANSFER_SRC_BIT. NULL: an image
    /// of lobe's own; the reference requires that.
    const lobe_vulkan_image *depth;
    /// Receives motion, converted to its format of two or more channels (R16G16_SFLOAT), and makes
    /// lobe compute it: see lobe_render_motion. NULL: none; the reference requires that.
    const lobe_vulkan_image *motion;
    /// Draw over the contents of the images: the host's background and its motion stay, and what
    /// the host drew into `depth` hides what lies behind it. Otherwise all are cleared, `motion` to
    /// that of what is infinitely far away. The reference, and
    /// several samples of a pixel (knob `samples`), are blended over `radiance` by their coverage,
    /// so the device must be able to blend that format; several samples also need `depth` to have
    /// VK_IMAGE_USAGE_TRANSFER_SRC_BIT.
    bool keep;
    /// The pixels of all of these images that are drawn, from the upper left; the others are left
    /// as they are, if the image's `layout` says that it has content. All zero: the whole images,
    /// which then have one extent. The picture is the same to the bit as one of this size alone,
    /// wherever the viewport is: of a part, lobe draws it into images of its own, of these formats,
    /// and copies it. The images then need VK_IMAGE_USAGE_TRANSFER_DST_BIT, and with `keep`
    /// VK_IMAGE_USAGE_TRANSFER_SRC_BIT, and no other.
    lobe_rectangle viewport;
} lobe_render_target;

/// The resources of a frame, for passes of the host.
typedef struct lobe_render_resources {
    uint32_t width, height; ///< pixels: those of the target's viewport
    /// RGBA32_FLOAT, or the target's. Of a viewport that is a part of the target, these three are
    /// images of its size, which are copied to their place after the host's last passes.
    lobe_resource radiance;
    lobe_resource depth; ///< D32_FLOAT, reversed
    /// As in lobe_frame; none without `aov`.
    lobe_resource normal_depth, lobes_level;
    lobe_resource motion; ///< RG32_FLOAT, or the target's; none without motion
} lobe_render_resources;

/// Where in a frame passes of the host are added.
typedef enum lobe_render_stage {
    /// Nothing is drawn yet. If the host's passes write radiance, depth or motion here, lobe draws
    /// over that image instead of clearing it.
    LOBE_RENDER_BEFORE_SHADING,
    /// The picture is drawn. `radiance` may be replaced by another image of the same extent and
    /// format, which is then delivered instead.
    LOBE_RENDER_AFTER_SHADING,
} lobe_render_stage;

/// How the reference takes samples. Other filters ignore it.
typedef struct lobe_render_reference {
    uint32_t samples; ///< per pixel, [1, LOBE_MAXIMUM_SAMPLES]; 0: 64
    /// Which of many sample patterns to use. Pictures with different patterns have independent
    /// errors, so their difference measures the noise.
    uint32_t pattern;
} lobe_render_reference;

/// How the filtered maps of the scene's environment are made.
typedef struct lobe_render_environment {
    /// Largest number of parts of the work (levels, or faces of large levels) done in this frame.
    /// Until all parts are done, frames are lit by the maps of the previous environment, or else
    /// by the plain MIP chain of this one. 0: all parts at once.
    uint32_t parts;
    /// An existing folder that caches the filtered maps, as OpenEXR files named after what they
    /// were made from. It is searched when maps are first needed and after the environment changed;
    /// maps that are found are not made. Others are saved in the frame that completes them, which
    /// makes that frame slower (with `host.submission`: in the next frame; with several frames in
    /// flight: never). A damaged or foreign file is replaced, with a notice. Logs a warning if the
    /// folder is not writable. Files may be removed at any time. Pictures do not depend on the
    /// cache. Read during the call. NULL: none. (Compiled pipelines have a cache of their own, see
    /// lobe_device_parameters.)
    const char *cache;
    /// With `rebuild`: keep the environment's maps, as if only the materials had changed.
    bool keep;
} lobe_render_environment;

/// How maps are made that are fitted to materials (filters `mixture`, `tan`, `fournier` and
/// `multi_leadr`) or to their reliefs (`displaced`, `wu`), which can take seconds to minutes.
typedef struct lobe_render_fits {
    /// Largest number of parts of the work (levels of a map, bands of rows of large levels, bands
    /// of facets) done in this frame. Until all parts of a material's map are done, the material is
    /// drawn unfiltered, as `direct` does (`displaced`, `wu`: without its relief). Texels that
    /// replace others, and those that are given on the device, are fitted at once. 0: all parts.
    uint32_t parts;
    /// An existing folder that caches the maps, in files named after what they were made from. It
    /// is searched when a material's map is first needed; a map that is found is not fitted. Others
    /// are saved in the frame that completes them, which makes that frame slower (with
    /// `host.submission`: in the next frame; with several frames in flight: never). Maps of
    /// texels that replace others, or are given on the device, are neither searched for nor saved.
    /// A file has the size of the map; while it is used, the device holds it twice. A damaged or
    /// foreign file is replaced, with a notice. Logs a warning if the folder is not writable. Files
    /// may be removed at any time. Pictures do not depend on the cache. May be the folder of
    /// `environment.cache`. Read during the call. NULL: none.
    const char *cache;
} lobe_render_fits;

/// What the host contributes to a frame: callbacks, images and the submission.
typedef struct lobe_render_host {
    /// Called between submissions with the fraction done, [0, 1]; returning false stops the
    /// rendering with LOBE_OK and an empty frame. NULL: none.
    bool (*progress)(void *user, double part);
    /// The same for the environment's filtered maps, if they have to be made: then that takes
    /// submissions of its own, before those of the picture, with one part of the work in each.
    /// Ignored with `submission`, where `environment.parts` spreads the work over frames, and for
    /// maps that only `rebuild` asks for. NULL: none. Maps without progress are made in the
    /// picture's first submission.
    bool (*environment_progress)(void *user, double part);
    /// The same for maps that are fitted to materials, with `fits.parts` and `submission` as above,
    /// after the environment's.
    bool (*fits_progress)(void *user, double part);
    /// Called once for each stage while the frame's graph is declared; adds the host's passes to
    /// it. New versions of resources that they write go back into `resources`. Errors in their
    /// declaration are reported by the graph. NULL: none.
    void (*add_passes)(void *user, lobe_graph *graph, lobe_render_stage stage,
                       lobe_render_resources *resources);
    void *user; ///< passed to all callbacks
    /// Images to draw into. NULL: an image of lobe's own, delivered in the frame. Otherwise no
    /// radiance is delivered, and `width` and `height` are 0 or those of the target's viewport.
    const lobe_render_target *target;
    /// How the frame is submitted to the device, see lobe_graph_submit. Nothing is waited for and
    /// nothing is delivered; lobe_graph_wait on the renderer's graph waits. NULL: lobe submits,
    /// waits and delivers. The reference always takes its samples and waits for them first; the
    /// submission then draws their mean into the target.
    const lobe_vulkan_submission *submission;
    /// With `submission`: see lobe_graph_set_frames_in_flight; 0: 1. For frames in command buffers
    /// of the host, the host itself waits: see lobe_graph_submit.
    uint32_t frames_in_flight;
} lobe_render_host;

/// Motion vectors, as temporal antialiasing, upscalers and denoisers expect them: in pixels of this
/// picture, to the right and down; added to the position of a pixel, the position at which the
/// previous frame showed the same point of the surface. Jitter of both cameras is left out; their
/// shifts are not. Of each pixel, the surface at its centre (plus jitter) counts, as in `depth`. It
/// is moved by the cameras, by the transforms of its instance and by the poses of its mesh (see
/// lobe_deformation); of vertices that change otherwise, only those that the host gives on the
/// device with `previous_vertices` move. What was behind the previous camera's eye gets
/// (32768, 32768); other motion is clamped to +-32768.
///
/// What is not given here is taken from the last frame of this renderer that had motion, whatever
/// its extent. Where that has nothing, what is drawn stood still: in the first frame after
/// lobe_renderer_set_scene, everything; later, instances that were not there or hidden, and
/// instances and meshes listed in lobe_scene_changes, which therefore should not list those that
/// only moved. Poses are always those of that frame.
typedef struct lobe_render_motion {
    bool deliver; ///< deliver it in the frame; a target's `motion` is computed without that, too
    const lobe_camera *previous_camera;     ///< NULL: as said above
    const float (*previous_transforms)[16]; ///< one for each instance, affine; NULL: as said above
} lobe_render_motion;

/// All members may be zero.
typedef struct lobe_render_parameters {
    const lobe_filter *filter;     ///< NULL: "moments"
    const lobe_settings *settings; ///< NULL: the filter's defaults
    const lobe_camera *camera;     ///< NULL: the scene's
    uint32_t width, height;        ///< pixels; both 0: 1280, 720
    /// Arbitrary output variables: also deliver depth, normal, number of lobes and MIP level, from
    /// one sample at the pixel's centre.
    bool aov;
    bool rebuild; ///< rebuild every map, as if the whole scene had changed
    bool discard; ///< deliver no images; for timing
    lobe_render_reference reference;
    lobe_render_environment environment;
    lobe_render_fits fits;
    lobe_render_motion motion;
    lobe_render_host host;
} lobe_render_parameters;

/// Device time of all passes of one name.
typedef struct lobe_pass_time {
    char name[64];
    double milliseconds;
    uint32_t count; ///< how many passes of this name ran
    /// The bytes that they must read and write in total: see lobe_pass_report.
    uint64_t read_bytes, written_bytes;
} lobe_pass_time;

/// A finished frame. Images are owned by the frame; free with lobe_frame_free.
typedef struct lobe_frame {
    lobe_image radiance; ///< RGBA32_FLOAT, linear RGB radiance and coverage
    /// RGBA32_FLOAT: world-space unit shading normal, and distance along the view axis in metres
    /// (0 where nothing is hit). Empty without `aov`.
    lobe_image normal_depth;
    /// RG32_FLOAT: lobes evaluated, and MIP level of the filtered maps (0: the maps themselves).
    /// Empty without `aov`.
    lobe_image lobes_level;
    /// RG32_FLOAT: see lobe_render_motion. Empty unless it is to be delivered and there is no
    /// target for it.
    lobe_image motion;
    double milliseconds;      ///< device time of all submissions that were waited for
    double host_milliseconds; ///< CPU time to compile and record them: see lobe_graph_report
    uint32_t submissions;     ///< how many frames of the graph it took
    /// Parts of the work on the environment's filtered maps that later frames still have to do. If
    /// not 0, later frames are lit differently. See `environment.parts`.
    uint32_t environment_parts_left;
    /// The same of the maps that are fitted to materials. See `fits.parts`.
    uint32_t fit_parts_left;
    lobe_pass_time *passes; ///< those that ran and were waited for, in order of their first run
    size_t pass_count;
    /// Size of the maps that the filter built: bytes on the device, and texels of the base maps
    /// that they replace. Their ratio is the filter's memory per texel.
    uint64_t filtered_bytes, base_texels;
} lobe_frame;

LOBE_API void lobe_frame_free(lobe_frame *frame);

/// Renders one image. On failure `*frame` is zero, and the host's command buffer must not be
/// submitted. Errors: LOBE_ERROR_INVALID_ARGUMENT (no scene, a value or a camera's number out of
/// range, a viewport that exceeds its target, an extent that differs from the target's),
/// LOBE_ERROR_MALFORMED (a light, a transform or another part of the scene that is read in every
/// frame, as for lobe_renderer_set_scene), LOBE_ERROR_UNSUPPORTED (the reference, which takes many
/// submissions, with the host's passes, with a target's depth or motion, or with a submission but
/// no target; a knob that needs a feature which the device lacks; env=exact in a filter that has
/// maps with normal_mapping=microfacet, or in one that fetches them for each light with probes
/// above 1), LOBE_ERROR_LIMIT (size), LOBE_ERROR_OUT_OF_DEVICE_MEMORY, ...
LOBE_API lobe_result lobe_renderer_render(lobe_renderer *renderer,
                                          const lobe_render_parameters *parameters,
                                          lobe_frame *frame);

/// Creates the pipelines that frames with these parameters need and the device does not have, as if
/// no map were built yet, and nothing else: no map, no picture, no device memory beyond the
/// scene's. Compiling takes a driver up to seconds; frames then create none. The images of a target
/// are not touched; their formats decide which pipelines are needed. What only changes of the scene
/// need (other texels, other materials) is not included, except where images are given on the
/// device. Where texels decide which pipelines there are, one submission asks the device about them
/// and is waited for.
///
/// To prepare something new while renderers of the device draw, see lobe/preparation.h, which calls
/// this in a thread of lobe's.
///
/// `parameters->host.progress` is called with the part done after each pipeline (of the reference,
/// several times from 0 to 1); returning false stops, with LOBE_OK. Returning is the sign that all
/// is done. Errors: as lobe_renderer_render.
LOBE_API lobe_result lobe_renderer_prepare(lobe_renderer *renderer,
                                           const lobe_render_parameters *parameters);

/// The graph of the last frame (of a reference: its last submission), for dumps and reports.
LOBE_API lobe_graph *lobe_renderer_graph(lobe_renderer *renderer);

#ifdef __cplusplus
}
#endif

#endif
