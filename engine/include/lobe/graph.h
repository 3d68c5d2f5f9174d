#ifndef LOBE_GRAPH_H
#define LOBE_GRAPH_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include <lobe/api.h>
#include <lobe/device.h>
#include <lobe/host.h>
#include <lobe/image.h>
#include <lobe/result.h>

#ifdef __cplusplus
extern "C" {
#endif

/// A render graph: the passes of one frame and the resources they read and write.
///
/// Every frame is declared from scratch: lobe_graph_begin, resources, passes, outputs, then
/// lobe_graph_execute. Declaring is cheap: pipelines, descriptor sets, memory and retained
/// resources are kept between frames. A frame declared like the last one, whatever it uploads,
/// allocates no host memory and creates no Vulkan objects, except views of host images that come
/// without a view.
///
/// Only the first mistake in a declaration counts. One log line names the pass and the resource,
/// later declarations have no effect, and compile or execute return the code: callers need not
/// check each step.
///
/// Not thread-safe: one graph, one thread.
typedef struct lobe_graph lobe_graph;

/// An image and a buffer of a host that uses Vulkan itself, how such a host submits a frame, and
/// what its own shaders read of one: all are defined in lobe/vulkan.h.
typedef struct lobe_vulkan_image lobe_vulkan_image;
typedef struct lobe_vulkan_buffer lobe_vulkan_buffer;
typedef struct lobe_vulkan_submission lobe_vulkan_submission;
typedef struct lobe_vulkan_descriptor lobe_vulkan_descriptor;

/// A pass being declared; valid until the next lobe_graph_begin.
typedef struct lobe_pass lobe_pass;

/// A resource at one version of its content. Each write returns a new version; using a version that
/// has been overwritten (a stale handle) is an error. All zero: no resource.
typedef struct lobe_resource {
    uint32_t index;
    uint32_t version;
} lobe_resource;

/// Levels and layers of an image. A count of 0 means all from the first one on.
typedef struct lobe_range {
    uint32_t first_level, level_count;
    uint32_t first_layer, layer_count;
} lobe_range;

typedef enum lobe_filter_mode { LOBE_SAMPLE_NEAREST, LOBE_SAMPLE_LINEAR } lobe_filter_mode;
typedef enum lobe_wrap_mode { LOBE_WRAP_REPEAT, LOBE_WRAP_MIRROR, LOBE_WRAP_CLAMP } lobe_wrap_mode;

/// How a sampled image is read. All zero: nearest texel, nearest level, repeat.
typedef struct lobe_sampler {
    lobe_filter_mode texels; ///< within a level
    lobe_filter_mode levels; ///< between levels
    lobe_wrap_mode wrap_u, wrap_v;
    float maximum_anisotropy; ///< [1, 16]; 0: off. Clamped to the device's limit.
} lobe_sampler;

LOBE_API lobe_result lobe_graph_create(lobe_device *device, lobe_graph **graph);
/// Waits for the device to finish the last frame and frees everything. Clears the pointer; NULL is
/// allowed.
LOBE_API void lobe_graph_destroy(lobe_graph **graph);

/// Gives the graph memory of its own for all that it makes from now on, also where other graphs of
/// the device have the same. What is shared changes its handles when one of the graphs changes it:
/// a graph whose exports (lobe_pass_export) are to keep theirs is kept apart, before it makes
/// anything.
LOBE_API void lobe_graph_keep_apart(lobe_graph *graph);

/// Starts a new frame: drops the passes of the last one, and waits for it if it is still running
/// (see lobe_graph_set_frames_in_flight). Retained resources that the new frame does not declare
/// again are freed when it is compiled, except for permanent ones.
LOBE_API void lobe_graph_begin(lobe_graph *graph);
/// Starts a frame between the others, which can only be executed, not submitted: for what must be
/// known before the next frame is declared. It has command and staging memory of its own, and what
/// it does not declare stays as the last frame left it.
LOBE_API void lobe_graph_begin_aside(lobe_graph *graph);

// ---------------------------------------------------------------------------------------------
// Resources

typedef struct lobe_image_description {
    const char *name; ///< for errors, dumps and debug labels; for a retained image also its key
    lobe_format format;
    uint32_t width, height; ///< texels, above 0
    uint32_t layers;        ///< 0 means 1. The shader sees an array if its binding is one.
    uint32_t levels;        ///< MIP levels; 0 means 1; at most floor(log2(max extent)) + 1
    uint32_t samples;       ///< 0 or 1: no multisampling; else 2 or 4, with one level and one layer
    /// Keep the content for the next frame. Passes that write only retained resources are skipped
    /// while nothing they depend on changes. If the next frame declares the same name and
    /// description, its passes may also read or modify that content before any pass has written it
    /// (sums over frames). Images that are not retained share memory (aliasing).
    bool retained;
    /// Of a retained image: graphs of one device whose passes would write the same content have it
    /// once, from when the first of them was submitted. A frame that writes the image must write
    /// all of it that the frame reads: content of earlier frames may be lost then.
    bool shared;
    /// Of a retained image: a table that depends on nothing outside the passes that write it. It is
    /// kept as long as the graph, also while frames do not declare it, and never invalidated.
    bool permanent;
} lobe_image_description;

typedef struct lobe_buffer_description {
    const char *name;
    size_t size; ///< bytes, above 0
    bool retained;
    /// Of a retained buffer: what a pass that modifies it leaves for the next time, as a fit that
    /// follows what it is fitted to. What the pass finds there does not count as a change: it runs
    /// when something else that it reads has changed. Passes of other graphs do not share what is
    /// made with it. Marked as out of date, it is empty.
    bool evolves;
    /// Of one that evolves: what needs several frames to come to rest. A pass that modifies it runs
    /// again in as many frames after the last change of something else that it reads; not where it
    /// found nothing, because a pass of the same frame had to write the buffer first.
    uint32_t settles;
    /// Of one that settles: the byte, above 0, from which the pass leaves a number (uint32) that is
    /// 1 where running it again would change nothing. While it settles, lobe reads that back
    /// without waiting for it, and then runs the pass no longer. 0: nowhere.
    size_t rest_offset;
} lobe_buffer_description;

/// Declares an image or buffer that passes of this frame write. It has no content before that,
/// unless it is retained and an earlier frame wrote it.
LOBE_API lobe_resource lobe_graph_image(lobe_graph *graph,
                                        const lobe_image_description *description);
LOBE_API lobe_resource lobe_graph_buffer(lobe_graph *graph,
                                         const lobe_buffer_description *description);

/// Whether passes of this frame may read all of a retained image or buffer before any has written
/// it: all of it has content of earlier frames.
LOBE_API bool lobe_graph_has_content(const lobe_graph *graph, lobe_resource resource);

/// Whether something that the last frame declared still settles (lobe_buffer_description.settles):
/// another frame like it would run passes, and may look different.
LOBE_API bool lobe_graph_settles(const lobe_graph *graph);

/// Creates a texture or buffer of a graph, for content that changes between frames. Only frames of
/// this graph may use it, and only the graph's thread. What it is given, now and by
/// lobe_texture_update, lobe_texture_update_part and lobe_buffer_update, is copied during the call
/// to memory that the graph keeps for that, and to the device at the start of the graph's next
/// frame, in that frame's submission: nothing is waited for, and while frames follow each other no
/// Vulkan object is created. Only what comes before the first frame, what new objects have beyond
/// 16 MiB between two frames, and what is too large for the device memory that is left, is
/// submitted and waited for in steps of 4 MiB. If a frame fails, the next one copies.
/// lobe_texture_destroy and lobe_buffer_destroy do not wait either, and come before
/// lobe_graph_destroy. Content of 4 KiB or more that another graph or the device has, given to a
/// new texture or buffer and submitted (by lobe, not by the host), takes no memory and is not
/// copied again; an update then gives the object memory of its own. Errors: as of
/// lobe_texture_create and lobe_buffer_create. An update that fails leaves the content (a part of
/// it, if the device failed between two steps); one that would need steps fails with
/// LOBE_ERROR_OUT_OF_DEVICE_MEMORY while a frame is in a command buffer of the host, until
/// lobe_graph_wait or the next lobe_graph_begin.
LOBE_API lobe_result lobe_graph_create_texture(lobe_graph *graph,
                                               const lobe_texture_parameters *parameters,
                                               lobe_texture **texture);
LOBE_API lobe_result lobe_graph_create_buffer(lobe_graph *graph,
                                              const lobe_buffer_parameters *parameters,
                                              lobe_buffer **buffer);

/// Submits what textures and buffers were given before the first frame, for other graphs to find;
/// does nothing later. Waits for nothing but memory that content passes through.
LOBE_API lobe_result lobe_graph_submit_content(lobe_graph *graph);

/// Imports a texture or buffer, of the device or of this graph; passes may only read it. The object
/// must live until the frame has executed. Importing the same object twice returns the same
/// resource.
LOBE_API lobe_resource lobe_graph_import_texture(lobe_graph *graph, const lobe_texture *texture);
LOBE_API lobe_resource lobe_graph_import_buffer(lobe_graph *graph, const lobe_buffer *buffer);

/// Imports a Vulkan image of the host. Passes may draw into it, write it as far as its usage
/// allows, and read it. At the end of the frame it is in the layout that the host asked for.
/// `image` is copied. Passes that read the content run in every frame, unless its `content` says
/// that it has not changed.
LOBE_API lobe_resource lobe_graph_import_image(lobe_graph *graph, const lobe_vulkan_image *image);

/// Imports a Vulkan buffer of the host. Passes may use it as far as its usage allows. `buffer` is
/// copied. Passes that read the content run in every frame, unless its `content` says that it has
/// not changed.
LOBE_API lobe_resource lobe_graph_import_host_buffer(lobe_graph *graph,
                                                     const lobe_vulkan_buffer *buffer);

/// Describes any image of this frame, except for its name and whether it is retained. All zero for
/// a buffer or an unknown handle.
LOBE_API lobe_image_description lobe_graph_describe_image(const lobe_graph *graph,
                                                          lobe_resource image);
/// The bytes of any buffer of this frame; 0 for an image or an unknown handle.
LOBE_API size_t lobe_graph_buffer_size(const lobe_graph *graph, lobe_resource buffer);

/// A small buffer with content for this frame (camera, lights): `size` bytes, at most 4 MiB,
/// copied. A pass that reads it counts as unchanged while the bytes stay the same.
LOBE_API lobe_resource lobe_graph_upload(lobe_graph *graph, const char *name, const void *data,
                                         size_t size);

// ---------------------------------------------------------------------------------------------
// Passes

typedef enum lobe_pass_kind {
    LOBE_PASS_COMPUTE,
    LOBE_PASS_RASTER,
    LOBE_PASS_TRANSFER,
    LOBE_PASS_EXPORT, ///< runs nothing, see lobe_pass_export
} lobe_pass_kind;

LOBE_API lobe_pass *lobe_graph_add_pass(lobe_graph *graph, lobe_pass_kind kind, const char *name);

/// A resource bound to a variable of the pass's shaders, by the variable's (or block's) name.
/// Reflection tells which kind it is: uniform or storage block, sampled image, with or without a
/// sampler, or storage image.
typedef struct lobe_binding {
    const char *name;
    lobe_resource resource;
    lobe_range range;     ///< images only
    lobe_sampler sampler; ///< sampled images only
} lobe_binding;

/// Binds a resource for reading in all shaders of the pass. A name that none of them has is an
/// error.
LOBE_API void lobe_pass_read(lobe_pass *pass, const lobe_binding *binding);
/// Binds a resource for writing; returns the new version. The range loses its previous content;
/// subresources outside the range keep theirs.
LOBE_API lobe_resource lobe_pass_write(lobe_pass *pass, const lobe_binding *binding);
/// Binds a resource for reading and writing; returns the new version.
LOBE_API lobe_resource lobe_pass_modify(lobe_pass *pass, const lobe_binding *binding);

/// A value for a specialisation constant, by its constant_id. `bits` holds the int, the uint, the
/// bits of the float, or 0 or 1 for a bool. An id that the shader does not have is ignored.
typedef struct lobe_specialisation {
    uint32_t id;
    uint32_t bits;
} lobe_specialisation;

/// How many groups an indirect dispatch has; as Vulkan's VkDispatchIndirectCommand.
typedef struct lobe_dispatch_arguments {
    uint32_t groups[3]; ///< within the device's limits; 0: nothing is dispatched
} lobe_dispatch_arguments;

typedef struct lobe_dispatch {
    const char *shader; ///< for example "maps/level_reduction.comp"
    /// Invocations in each dimension, rounded up to whole groups of the shader's local size: the
    /// shader must check its bounds. 0 means 1.
    uint32_t threads[3];
    const void *constants;                     ///< push constants, copied
    size_t constants_size;                     ///< bytes, equal to the shader's block; at most 128
    const lobe_specialisation *specialisation; ///< copied
    size_t specialisation_count;
    const lobe_binding *bindings; ///< read by this dispatch only, in addition to the pass's
    size_t binding_count;
    /// A buffer that an earlier pass wrote: the dispatch takes its groups from the
    /// lobe_dispatch_arguments at `indirect_offset` (bytes, a multiple of 4), and ignores
    /// `threads`. All zero: none.
    lobe_resource indirect;
    size_t indirect_offset;
    /// Something of which passes make parts, while the rest stays as earlier frames left it. A
    /// number (uint32, above 0) takes the place of that at `number_offset` (bytes) of `constants`:
    /// another one where the passes that write `numbered` in this frame are others, or do it with
    /// other constants or content. The dispatch can then tell which parts are out of date. What
    /// `numbered` held before does not count, nor the content of what this pass binds, which is for
    /// its shader to see. One dispatch of a frame takes the number of a resource. All zero: none.
    lobe_resource numbered;
    size_t number_offset;
} lobe_dispatch;

/// Adds a dispatch. Dispatches of one pass must not depend on each other.
LOBE_API void lobe_pass_dispatch(lobe_pass *pass, const lobe_dispatch *dispatch);

typedef enum lobe_load {
    LOBE_LOAD_CLEAR,   ///< start from a constant
    LOBE_LOAD_KEEP,    ///< start from the previous content
    LOBE_LOAD_DISCARD, ///< start undefined: draws cover every texel
} lobe_load;

typedef struct lobe_attachment {
    lobe_resource resource;
    uint32_t level, layer;
    lobe_load load;
    float clear[4]; ///< depth uses the first
} lobe_attachment;

/// Attaches a colour output: `location` of the fragment shader, [0, 7] and below the device's
/// maximum_colour_outputs. All attachments of a pass have the same extent and sample count. Returns
/// the new version.
LOBE_API lobe_resource lobe_pass_colour(lobe_pass *pass, uint32_t location,
                                        const lobe_attachment *attachment);
/// Resolves the multisampled colour output `location` (mean of the samples) to `target`. Returns
/// the new version.
LOBE_API lobe_resource lobe_pass_resolve(lobe_pass *pass, uint32_t location, lobe_resource target);
/// Attaches depth, D32_FLOAT. lobe uses reversed depth: 1 at the near plane, 0 at infinity, the
/// greater value is nearer; clear it to 0. Returns the new version.
LOBE_API lobe_resource lobe_pass_depth(lobe_pass *pass, const lobe_attachment *attachment);

typedef enum lobe_cull { LOBE_CULL_NONE, LOBE_CULL_BACK, LOBE_CULL_FRONT } lobe_cull;
typedef enum lobe_blend {
    LOBE_BLEND_OFF,
    LOBE_BLEND_ALPHA, ///< source over target, premultiplied alpha
    LOBE_BLEND_ADD,
} lobe_blend;

/// What an indirect draw draws; as Vulkan's VkDrawIndexedIndirectCommand, and the same for a draw
/// without indices.
typedef struct lobe_draw_arguments {
    uint32_t index_count;    ///< or vertices
    uint32_t instance_count; ///< 0: nothing is drawn
    uint32_t first_index;    ///< or vertex. The graph cannot check that the buffer holds the range.
    uint32_t zero[2];
} lobe_draw_arguments;

typedef struct lobe_draw {
    const char *vertex_shader; ///< "shading/shading.vert". Vertices are read from storage buffers.
    const char *fragment_shader; ///< NULL: depth only
    lobe_resource indices;       ///< buffer of uint32; all zero: vertices are drawn in order
    uint32_t first_index, index_count, instance_count; ///< 0 instances means 1
    lobe_cull cull;                                    ///< counter-clockwise is the front
    bool depth_test, depth_write;
    /// With `depth_test`: draws where the depth is the same as before, instead of nearer. A vertex
    /// shader computes the depths of another one if both declare `invariant gl_Position` and take
    /// the same steps to it.
    bool depth_equal;
    lobe_blend blend;
    const void *constants; ///< push constants of all stages, copied
    size_t constants_size;
    const lobe_specialisation *specialisation; ///< of both stages, copied
    size_t specialisation_count;
    const lobe_binding *bindings; ///< read by this draw only, in addition to the pass's
    size_t binding_count;
    /// A buffer that an earlier pass wrote: the draw takes its counts from the lobe_draw_arguments
    /// at `indirect_offset` (bytes, a multiple of 4), and ignores those above. All zero: none.
    lobe_resource indirect;
    size_t indirect_offset;
} lobe_draw;

/// Adds a draw of triangles; draws execute in order. Clip space is Vulkan's own, without a flip: x
/// to the right, y *down*, both in [-w, w]; 0 <= z <= w with reversed depth (z = w at the near
/// plane). A projection for a world with y up therefore negates y. Viewport and scissor are the
/// attachments' extent. A triangle faces the front if its corners are counter-clockwise in the
/// picture.
LOBE_API void lobe_pass_draw(lobe_pass *pass, const lobe_draw *draw);

/// Transfer passes: copies an image (same extent, texel size and number of levels and layers) or a
/// buffer (same size). Returns the new version of `target`.
LOBE_API lobe_resource lobe_pass_copy(lobe_pass *pass, lobe_resource source,
                                      lobe_range source_range, lobe_resource target,
                                      lobe_range target_range);
/// Transfer passes: copies the texels of `part` to (`x`, `y`) and the following columns and rows of
/// `target`, of which the others stay: of the first level and layer of images whose texels have the
/// same size. Returns the new version of `target`.
LOBE_API lobe_resource lobe_pass_copy_part(lobe_pass *pass, lobe_resource source,
                                           const lobe_rectangle *part, lobe_resource target,
                                           uint32_t x, uint32_t y);
/// Transfer passes: fills with a constant. Depth uses the first value; a buffer is filled with the
/// bits of the first value. Returns the new version.
LOBE_API lobe_resource lobe_pass_fill(lobe_pass *pass, lobe_resource target, lobe_range range,
                                      const float value[4]);

/// Resources for a shader of the host that runs after the frame.
typedef struct lobe_export {
    const char *shader; ///< of lobe, whose variables the bindings name
    const lobe_binding *bindings;
    size_t binding_count;
} lobe_export;

/// Export passes: makes the bindings of `exported` and those that the pass reads visible to all
/// shaders of the host, and gives them as descriptors (lobe_graph_exported).
/// Images must be retained, textures, or of the host with a view. Of buffers, copies are exported.
/// Both keep their handles while later frames export the same, unless other graphs share the image
/// (lobe_graph_keep_apart), and their content until such a frame changes it. The pass and what it
/// depends on is kept.
LOBE_API void lobe_pass_export(lobe_pass *pass, const lobe_export *exported);

/// The descriptors of the frame's export number `index`, in order of declaration; NULL if there is
/// no such export, or the frame has not been submitted. Valid until the next lobe_graph_begin.
LOBE_API const lobe_vulkan_descriptor *lobe_graph_exported(const lobe_graph *graph, size_t index,
                                                           size_t *count);

/// Keeps a pass (and everything it depends on) even if no output depends on it.
LOBE_API void lobe_pass_keep(lobe_pass *pass);

/// Fails the frame, like a mistake in its declaration: for callers that cannot declare a pass. Only
/// a frame's first failure is logged and counts; returns its code.
LOBE_API LOBE_HOST_FORMAT lobe_result lobe_graph_fail(lobe_graph *graph, lobe_result result,
                                                      const char *format, ...);

// ---------------------------------------------------------------------------------------------
// Outputs and execution

/// Marks content as an output of the frame. Passes that no output depends on are culled.
LOBE_API void lobe_graph_output(lobe_graph *graph, lobe_resource resource);
/// Marks content as an output that is copied to host memory, see lobe_graph_data.
LOBE_API void lobe_graph_read_back(lobe_graph *graph, lobe_resource resource, lobe_range range);
/// The same, for a frame that nobody waits for. Returns the number under which lobe_graph_late_data
/// finds the bytes later; 0: the frame has failed.
LOBE_API uint64_t lobe_graph_read_back_late(lobe_graph *graph, lobe_resource resource,
                                            lobe_range range);

/// Validates, orders and culls the passes, places resources in memory and derives barriers, without
/// running anything. lobe_graph_execute and lobe_graph_submit do this if it has not been done.
/// Errors: LOBE_ERROR_GRAPH (the log names pass and resource),
/// LOBE_ERROR_SHADER, LOBE_ERROR_LIMIT, LOBE_ERROR_OUT_OF_DEVICE_MEMORY.
LOBE_API lobe_result lobe_graph_compile(lobe_graph *graph);

/// Creates the pipelines of the passes that would run, and nothing else: no memory, no commands.
/// Later frames of any graph of the device find them. The frame cannot be executed then; begin
/// another. Other graphs, in other threads, go on meanwhile: at most those wait that need a
/// pipeline which is in the making. `progress`: called with the part done, in [0, 1], after each
/// pipeline; returning false stops, with LOBE_OK; NULL: none. Errors: as lobe_graph_compile.
LOBE_API lobe_result lobe_graph_prepare(lobe_graph *graph,
                                        bool (*progress)(void *user, double part), void *user);

/// Compiles if necessary, records, submits, and waits for the device to finish.
LOBE_API lobe_result lobe_graph_execute(lobe_graph *graph);

/// Maximum number of frames in flight.
#define LOBE_MAXIMUM_FRAMES_IN_FLIGHT 4

/// Sets how many frames of this graph may be unfinished at a time, including the one being
/// recorded: clamped to [1, LOBE_MAXIMUM_FRAMES_IN_FLIGHT]; 1 by default. Takes effect at the next
/// lobe_graph_begin. The device executes the frames of a graph one after the other; the host works
/// ahead of it.
LOBE_API void lobe_graph_set_frames_in_flight(lobe_graph *graph, uint32_t count);

/// Compiles if necessary, records, and submits without waiting, or records into the host's command
/// buffer, as `submission` says. lobe_graph_begin waits until fewer frames than allowed are in
/// flight. It cannot wait for frames in command buffers of the host: with N frames in flight, the
/// host must make sure that the frame recorded N frames ago has finished before it begins the next.
/// If a frame needs other memory than the last (images of another extent) and there is not room for
/// both, or it does not declare what was exported, its compilation waits for the queue. After a
/// failure, the host's command buffer must not be submitted. Errors: those of lobe_graph_execute,
/// LOBE_ERROR_INVALID_ARGUMENT (semaphores with a command buffer, or too many).
LOBE_API lobe_result lobe_graph_submit(lobe_graph *graph, const lobe_vulkan_submission *submission);

/// Waits until the device has finished the frame last submitted; then lobe_graph_data has its data
/// and lobe_graph_describe its times. If the frame is in a command buffer of the host, the host
/// must have waited for it already. Does nothing if no frame was submitted.
LOBE_API lobe_result lobe_graph_wait(lobe_graph *graph);

/// The bytes read back from `resource` in the frame last executed or waited for: level by level,
/// within a level layer by layer, rows from top to bottom, tightly packed. Valid until the next
/// lobe_graph_begin. NULL if `resource` was not marked with lobe_graph_read_back. `size` may be
/// NULL.
LOBE_API const void *lobe_graph_data(const lobe_graph *graph, lobe_resource resource, size_t *size);

/// The bytes that lobe_graph_read_back_late asked for, once the device is known to have finished
/// their frame. With several frames in flight, that is when the frame that takes its place is
/// declared. Valid until that frame is executed or submitted. NULL: not there yet, or no longer;
/// `*pending` (may be NULL) says whether they may still come.
LOBE_API const void *lobe_graph_late_data(const lobe_graph *graph, uint64_t number, bool *pending);

/// Marks all retained content as out of date, so that the passes that write it run again, except
/// for permanent images. The memory stays, unless other graphs use it too; from then on they do
/// not.
LOBE_API void lobe_graph_invalidate(lobe_graph *graph);
/// The same for all retained resources whose names do not begin with `prefix`.
LOBE_API void lobe_graph_invalidate_except(lobe_graph *graph, const char *prefix);
/// Empties the retained buffer of this name, if there is one, before the frame declares it.
LOBE_API void lobe_graph_forget_buffer(lobe_graph *graph, const char *name);

// ---------------------------------------------------------------------------------------------
// What happened

typedef enum lobe_pass_state {
    LOBE_PASS_RUN,
    LOBE_PASS_CULLED,  ///< no output depends on it
    LOBE_PASS_SKIPPED, ///< its retained results are still valid
} lobe_pass_state;

typedef struct lobe_pass_report {
    const char *name;
    lobe_pass_kind kind;
    lobe_pass_state state;
    double milliseconds; ///< device time, from timestamps; 0 if it did not run
    /// Memory traffic that the declaration implies, without caches: every level and layer that the
    /// pass declares to read, and to write, counted once each. Modifying counts as both. A shader
    /// may fetch less.
    uint64_t read_bytes, written_bytes;
} lobe_pass_report;

typedef struct lobe_graph_report {
    const lobe_pass_report *passes; ///< in order of execution, then those that did not run
    size_t pass_count;
    double milliseconds; ///< device time of the whole frame, first to last timestamp
    /// CPU time that the calling thread spent compiling the frame and recording its commands;
    /// waiting does not count.
    double host_milliseconds;
    uint64_t transient_bytes; ///< memory of transient resources, aliased
    uint64_t transient_bytes_without_aliasing;
    uint64_t retained_bytes; ///< including what other graphs share
    uint32_t barrier_count;  ///< image and buffer barriers recorded
} lobe_graph_report;

/// Report on the frame last compiled or executed; valid until the next lobe_graph_begin.
LOBE_API const lobe_graph_report *lobe_graph_describe(const lobe_graph *graph);

/// The compiled graph as text or as Graphviz: passes (run, culled, skipped), resources, barriers,
/// memory with and without aliasing. The caller frees it with lobe_release; NULL if out of memory.
LOBE_API char *lobe_graph_dump_text(const lobe_graph *graph);
LOBE_API char *lobe_graph_dump_graphviz(const lobe_graph *graph);

#ifdef __cplusplus
}
#endif

#endif
