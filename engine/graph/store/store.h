#ifndef ENGINE_GRAPH_STORE_H
#define ENGINE_GRAPH_STORE_H

#include "engine/graph/state.h"

// ---------------------------------------------------------------------------------------------
// Objects (objects.c)

/// Creates the image or buffer that the resource describes, without memory.
lobe_result engine_graph_create_object(lobe_device *device, const engine_graph_resource *resource,
                                       engine_graph_object *object,
                                       VkMemoryRequirements *requirements);
/// Binds it to `allocation`, `offset` bytes from its start.
lobe_result engine_graph_bind_object(lobe_device *device, const char *name,
                                     const engine_graph_object *object,
                                     const engine_allocation *allocation, uint64_t offset);
void engine_graph_free_views(lobe_device *device, engine_graph_object *object);
/// Frees views, image and buffer, not the memory.
void engine_graph_free_object(lobe_device *device, engine_graph_object *object);

/// The view of these levels and layers; created at the first call.
lobe_result engine_graph_get_view(lobe_device *device, const engine_graph_resource *resource,
                                  VkImageViewType type, const lobe_range *range, VkImageView *view);

// ---------------------------------------------------------------------------------------------
// Retained resources (retained.c)

/// New frame: no retained resource is declared yet.
void engine_graph_begin_retained(lobe_graph *graph);
void engine_graph_free_retained(lobe_graph *graph);

/// Keeps the resource with this index from now on; it has neither object nor content yet.
lobe_result engine_graph_add_retained(lobe_graph *graph, uint32_t index);
/// Lets the object and its content go. All frames must have finished.
void engine_graph_drop_retained(lobe_graph *graph, engine_graph_retained *kept);

/// Before it is declared: takes over what the device has said of it (see
/// lobe_buffer_description.rest_offset).
void engine_graph_hear_of_rest(const lobe_graph *graph, engine_graph_retained *kept);
/// Compilation, before anything else: has what settles read back.
lobe_result engine_graph_ask_for_rest(lobe_graph *graph);

/// Frees what the frame after this flight's did not declare. The flight's frame must have finished.
void engine_graph_free_released(lobe_graph *graph, engine_graph_flight *flight);

/// Compilation: drops the content of retained objects that were not created for this frame's uses.
lobe_result engine_graph_check_retained(lobe_graph *graph);
/// Compilation: frees the retained resources that this frame does not declare, once no frame in
/// flight uses them.
lobe_result engine_graph_release_retained(lobe_graph *graph);
/// Compilation: creates the retained objects that running passes need.
lobe_result engine_graph_place_retained(lobe_graph *graph);

/// Execution: marks what running passes write as unreliable until they have finished.
void engine_graph_invalidate_retained(lobe_graph *graph);
/// Execution: stamps each subresource with the content that running passes leave in it.
void engine_graph_stamp_retained(lobe_graph *graph);

// ---------------------------------------------------------------------------------------------
// Retained images that graphs share (sharing.c)

/// Compilation, after the passes that run are known: takes what other graphs have of what these
/// would write, or wrote; objects that they do write belong to this graph alone.
lobe_result engine_graph_share_retained(lobe_graph *graph);
/// Lets other graphs find the images that were written. All frames must have been submitted.
void engine_graph_publish_retained(lobe_graph *graph);

// ---------------------------------------------------------------------------------------------
// Transient resources (transients.c)

/// Compilation: gives the transient resources of running passes their objects; resources that are
/// not alive at the same time share memory. Reuses everything if the last frame needed the same.
lobe_result engine_graph_place_transients(lobe_graph *graph);
/// The frames that use them must have finished.
void engine_graph_free_transients(lobe_graph *graph, engine_graph_transients *transients);

// ---------------------------------------------------------------------------------------------
// What comes from the host (imports.c)

/// Execution: sets the objects of imported resources; copies the uploads.
lobe_result engine_graph_place_imports(lobe_graph *graph);
/// Hands the views of imported images to the flight: the images may be gone by the next frame.
void engine_graph_release_imports(lobe_graph *graph);

// ---------------------------------------------------------------------------------------------
// Frames in flight (flights.c)

/// Creates the graph's first flight.
lobe_result engine_graph_create_flights(lobe_graph *graph);
/// New frame: takes a free flight, or waits for the oldest one.
lobe_result engine_graph_begin_flight(lobe_graph *graph);
/// New frame between the others: takes a flight of its own.
lobe_result engine_graph_begin_aside_flight(lobe_graph *graph);
/// Waits for all frames of the graph, and for what the host submitted since, so that anything they
/// use can be freed, exports too. Returns at once if none is in flight. After a failure they may
/// still be running.
lobe_result engine_graph_finish_flights(lobe_graph *graph);
/// Waits for the frames alone, so that what no export shows to the host can be freed.
lobe_result engine_graph_finish_frames(lobe_graph *graph);
/// Frees what only this flight's frame needed, which the device has finished.
void engine_graph_retire_flight(lobe_graph *graph, engine_graph_flight *flight);
/// All frames must have finished.
void engine_graph_free_flights(lobe_graph *graph);

#endif
