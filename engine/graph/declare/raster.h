#ifndef ENGINE_GRAPH_DECLARE_RASTER_H
#define ENGINE_GRAPH_DECLARE_RASTER_H

#include "engine/graph/graph.h"

/// Compilation: attachments of each raster pass have one extent and one sample count.
lobe_result engine_graph_check_rasters(lobe_graph *graph);

/// Parameters of a draw's pipeline.
engine_raster_parameters engine_graph_raster_parameters(const lobe_pass *pass,
                                                        const lobe_draw *draw);

#endif
