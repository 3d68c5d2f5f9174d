#ifndef ENGINE_GRAPH_DECLARE_BINDING_H
#define ENGINE_GRAPH_DECLARE_BINDING_H

#include "engine/graph/graph.h"

/// Compilation: matches the bindings of each pass with its shaders' variables by name, checks
/// that they fit, and derives from that how each resource is used.
lobe_result engine_graph_resolve_bindings(lobe_graph *graph);

/// Compilation: gets the pipelines of the passes that run.
lobe_result engine_graph_find_pipelines(lobe_graph *graph);

/// What a command binds to a name: its own binding before the pass's; NULL where neither has it.
engine_graph_binding *engine_graph_bound(const lobe_pass *pass, const engine_graph_command *command,
                                         const char *name);

#endif
