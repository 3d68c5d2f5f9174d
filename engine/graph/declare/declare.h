#ifndef ENGINE_GRAPH_DECLARE_H
#define ENGINE_GRAPH_DECLARE_H

#include "engine/graph/graph.h"

/// Whether the frame still takes declarations: nothing failed, nothing was compiled. Fails the
/// frame where `what` (a pass or resource) comes too late.
bool engine_graph_may_declare(lobe_graph *graph, const char *what);

/// Adds the resource under the same index to both tables; all zero after a failure.
lobe_resource engine_graph_add_resource(lobe_graph *graph, const engine_graph_resource *resource,
                                        const engine_dependency_resource *dependency);

/// Adds a pass that the caller did not ask for; NULL after a failure.
lobe_pass *engine_graph_add_pass(lobe_graph *graph, lobe_pass_kind kind, const char *name);

/// Declares an access of the pass and its state; the index, or NONE after a failure. `resource`
/// is replaced by its newest version.
uint32_t engine_graph_access(lobe_pass *pass, lobe_resource *resource, lobe_range range,
                             engine_access_kind kind, engine_access_state state);

/// The resource a handle stands for; fails the frame and gives NULL where there is none.
engine_graph_resource *engine_graph_find_resource(lobe_pass *pass, lobe_resource handle);

/// Whether the pass may take a call that is for passes of this kind.
bool engine_graph_pass_is(lobe_pass *pass, lobe_pass_kind kind, const char *call);

/// A command at the end of the pass; NULL after a failure.
engine_graph_command *engine_graph_add_command(lobe_pass *pass, engine_graph_command_kind kind);

/// Copies a binding and declares its access. Returns the resource's newest version.
lobe_resource engine_graph_bind(lobe_pass *pass, engine_graph_binding_list *list,
                                const lobe_binding *binding, engine_access_kind kind);

#endif
