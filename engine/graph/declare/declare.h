#ifndef ENGINE_GRAPH_DECLARE_H
#define ENGINE_GRAPH_DECLARE_H

#include "engine/graph/state.h"

// ---------------------------------------------------------------------------------------------
// Declaration

/// Whether the frame still takes declarations: nothing failed, nothing was compiled. Fails the
/// frame if `what` (the name of a pass or resource) comes too late. False if there is no graph.
bool engine_graph_can_declare(lobe_graph *graph, const char *what);

/// Adds the resource to the frame and to the dependency graph, under the same index. Returns a
/// zero handle after a failure.
lobe_resource engine_graph_add_resource(lobe_graph *graph, const engine_graph_resource *resource,
                                        const engine_dependency_resource *dependency);

/// Adds a pass to the frame and to the dependency graph; NULL after a failure.
lobe_pass *engine_graph_add_pass(lobe_graph *graph, lobe_pass_kind kind, const char *name);

/// Adds an access of the pass with its state; the index, or NONE after a failure. A write replaces
/// `resource` by its new version.
uint32_t engine_graph_add_access(lobe_pass *pass, lobe_resource *resource, lobe_range range,
                                 engine_access_kind kind, engine_access_state state);

/// The resource of a handle; if there is none, fails the frame and returns NULL.
engine_graph_resource *engine_graph_find_resource(lobe_pass *pass, lobe_resource handle);

/// Bytes of these levels and layers of an image, tightly packed, all samples; or of a whole buffer.
uint64_t engine_graph_range_bytes(const engine_graph_resource *resource, const lobe_range *range);

/// Whether the pass is still being declared and of this kind, and the call has its argument (not
/// NULL); if not, fails the frame.
bool engine_graph_check_pass_kind(lobe_pass *pass, lobe_pass_kind kind, const char *call,
                                  const void *argument);

/// Appends a command to the pass; NULL after a failure.
engine_graph_command *engine_graph_add_command(lobe_pass *pass, engine_graph_command_kind kind);
/// Binds what a command reads alone.
void engine_graph_bind_to_command(lobe_pass *pass, engine_graph_command *command,
                                  const lobe_binding *bindings, size_t count);

/// What an export pass exports in place of a buffer (export.c).
lobe_resource engine_graph_export_buffer(lobe_pass *pass, const char *variable,
                                         lobe_resource buffer);

// ---------------------------------------------------------------------------------------------
// Compilation

/// Checks that the attachments of each raster pass have one extent and one sample count (raster.c).
lobe_result engine_graph_check_rasters(lobe_graph *graph);

/// Matches the bindings of each pass with its shaders' variables by name, checks that they fit, and
/// derives how each resource is used (binding.c).
lobe_result engine_graph_resolve_bindings(lobe_graph *graph);

/// In which a resource of the host is returned after the frame. `stages`: in which the host uses it
/// next; 0: any use is assumed.
engine_access_state engine_graph_returned_state(uint64_t stages, uint64_t access);
/// The stamp of what a host lends: of `size` bytes of numbers that say which object and `content`
/// it is, or, where the host does not number its content, another one in every frame.
engine_stamp engine_graph_lent_content(const lobe_graph *graph, uint64_t content,
                                       const uint64_t *numbers, size_t size);

/// Checks that host images were created for what passes do with them (host_image.c).
lobe_result engine_graph_check_host_images(lobe_graph *graph);
/// The same of buffers.
lobe_result engine_graph_check_host_buffers(lobe_graph *graph);

/// Gives each pass a digest of everything it does, except the content it reads and the resources it
/// names, which the dependency graph adds (signature.c).
lobe_result engine_graph_sign_passes(lobe_graph *graph);

/// Puts numbers of content (lobe_dispatch.numbered) where passes want them, and signs these again
/// (signature.c). Comes after the order of the passes.
void engine_graph_number_content(lobe_graph *graph);

/// Gets the pipelines of the passes that run (binding.c).
lobe_result engine_graph_find_pipelines(lobe_graph *graph);
/// The same, with the callback of lobe_graph_prepare.
lobe_result engine_graph_prepare_pipelines(lobe_graph *graph,
                                           bool (*progress)(void *user, double part), void *user);

/// What a command binds to a name: its own binding before the pass's; NULL if neither has one
/// (binding.c).
engine_graph_binding *engine_graph_find_binding(const lobe_pass *pass,
                                                const engine_graph_command *command,
                                                const char *name);

/// Parameters of a draw's pipeline (raster.c).
engine_raster_parameters engine_graph_raster_parameters(const lobe_pass *pass,
                                                        const lobe_draw *draw);

#endif
