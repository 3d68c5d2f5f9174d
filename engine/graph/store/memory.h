#ifndef ENGINE_GRAPH_STORE_MEMORY_H
#define ENGINE_GRAPH_STORE_MEMORY_H

#include "engine/graph/graph.h"

/// Compilation: gives the transient resources that running passes use their objects, in memory
/// that those not alive together share. Keeps all where the last frame needed the very same.
lobe_result engine_graph_place_transients(lobe_graph *graph);

/// Execution: objects for what comes from the host; copies the uploads.
lobe_result engine_graph_place_imports(lobe_graph *graph);
/// Hands views of imported images to the flight: the images may be gone before the next frame.
void engine_graph_forget_imports(lobe_graph *graph);

/// Frees transients. All frames must have been finished.
void engine_graph_free_memory(lobe_graph *graph);

#endif
