#ifndef ENGINE_GRAPH_RECORD_FLIGHT_H
#define ENGINE_GRAPH_RECORD_FLIGHT_H

#include "engine/graph/graph.h"

/// Gives the graph its first flight.
lobe_result engine_graph_create_flights(lobe_graph *graph);
/// A new frame: takes a flight that is free, or waits for the oldest one.
lobe_result engine_graph_begin_flight(lobe_graph *graph);

/// Waits for all frames of the graph, so that anything they use can be freed; at once where none
/// is under way. On failure they may be under way still.
lobe_result engine_graph_finish_flights(lobe_graph *graph);
/// The device has finished with what is this flight's alone.
void engine_graph_retire_flight(lobe_graph *graph, engine_graph_flight *flight);

/// All must have been finished.
void engine_graph_free_flights(lobe_graph *graph);

#endif
