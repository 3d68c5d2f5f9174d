#ifndef ENGINE_GRAPH_DECLARE_SIGNATURE_H
#define ENGINE_GRAPH_DECLARE_SIGNATURE_H

#include "engine/graph/graph.h"

/// Compilation: gives each pass a digest of all it does, apart from the content it reads and the
/// resources it names (the dependency graph adds those).
lobe_result engine_graph_sign_passes(lobe_graph *graph);

#endif
