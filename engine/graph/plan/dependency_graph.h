#ifndef ENGINE_GRAPH_PLAN_DEPENDENCY_GRAPH_H
#define ENGINE_GRAPH_PLAN_DEPENDENCY_GRAPH_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include <lobe/graph.h>

#include "engine/base/arena.h"
#include "engine/base/stamp.h"

/// Which pass must come before which, what need not run, and which barriers lie between: the
/// part of the render graph that knows no Vulkan.
///
/// Passes, resources and accesses are declared in the order in which the caller thinks of them;
/// content is tracked for each *subresource* (one level of one layer), so that a level can be
/// read while the next is written. The steps after the declaration are, in this order:
///
///     engine_dependency_link       sources of content, hazards between passes   (graph_validate.c)
///     engine_dependency_order      topological order                            (graph_order.c)
///     engine_dependency_cull       which passes run, are culled, are skipped    (graph_cull.c)
///     engine_dependency_find_lifetimes  first and last use of each resource (graph_lifetime.c)
///     engine_dependency_derive_barriers   transitions and memory dependencies (graph_barrier.c)
///
/// Each returns false on failure and leaves the reason in `fault`.

#define ENGINE_DEPENDENCY_NONE UINT32_MAX

/// How the memory of an image is arranged for its use. Buffers stay UNDEFINED.
typedef enum engine_layout {
    ENGINE_LAYOUT_UNDEFINED,
    ENGINE_LAYOUT_GENERAL, ///< fits every use in shaders and copies
    ENGINE_LAYOUT_SAMPLED,
    ENGINE_LAYOUT_COLOUR,
    ENGINE_LAYOUT_DEPTH,
    ENGINE_LAYOUT_COPY_SOURCE,
    ENGINE_LAYOUT_COPY_TARGET,
    ENGINE_LAYOUT_LENT,     ///< the one that a borrowed image comes in
    ENGINE_LAYOUT_RETURNED, ///< the one that it is given back in
} engine_layout;

/// Stages and access types are masks of the caller's: only united and compared here.
typedef struct engine_access_state {
    uint64_t stages;
    uint64_t access;
    engine_layout layout;
} engine_access_state;

typedef enum engine_access_kind {
    ENGINE_ACCESS_READ,
    ENGINE_ACCESS_WRITE, ///< former content of the range is lost
    ENGINE_ACCESS_MODIFY,
} engine_access_kind;

typedef enum engine_dependency_fault_kind {
    ENGINE_FAULT_NONE,
    ENGINE_FAULT_MEMORY,           ///< the host has none left
    ENGINE_FAULT_UNKNOWN_RESOURCE, ///< a handle that this graph never gave out
    ENGINE_FAULT_STALE,            ///< a version that was overwritten since
    ENGINE_FAULT_RANGE,            ///< levels or layers that the resource does not have
    ENGINE_FAULT_IMPORTED_WRITTEN,
    ENGINE_FAULT_NEVER_WRITTEN, ///< read before any pass wrote it
    ENGINE_FAULT_CONFLICT,      ///< read and written by one pass through different accesses
    ENGINE_FAULT_WRITTEN_TWICE, ///< written twice by one pass
    ENGINE_FAULT_OVERWRITTEN,   ///< an output that a later pass overwrites
    ENGINE_FAULT_CYCLE,
} engine_dependency_fault_kind;

typedef struct engine_dependency_fault {
    engine_dependency_fault_kind kind;
    uint32_t pass, resource, other_pass; ///< ENGINE_DEPENDENCY_NONE where it says nothing
    uint32_t level, layer;
} engine_dependency_fault;

typedef struct engine_dependency_resource {
    const char *name; ///< borrowed
    uint32_t levels, layers;
    bool imported; ///< has content from the start, is never written
    bool retained; ///< its content stays for the next frame
    bool borrowed; ///< the host's: passes may write it, and it is given back
    /// Borrowed: what was done to it before the frame, and will be after it. The layouts are LENT
    /// (UNDEFINED: it has no content) and RETURNED.
    engine_access_state before, after;
    engine_stamp identity; ///< digest of the description (format, extent); imported: of the content
    const engine_stamp *recorded;       ///< retained: stamp of what each subresource holds, or NULL
    const engine_layout *start_layouts; ///< of each subresource at the start; NULL: undefined

    // Where a transient resource lies in memory, for dependencies between those that share it.
    bool placed;
    uint32_t block;
    uint64_t offset, size;

    // Derived
    uint32_t version;                       ///< newest
    uint32_t settled_version;               ///< newest from before `last_writer` began to write
    uint32_t last_writer;                   ///< pass that made `version`
    uint32_t first_subresource;             ///< of the graph's arrays by subresource
    uint32_t first_position, last_position; ///< of its life; NONE where nothing that runs uses it
} engine_dependency_resource;

typedef struct engine_dependency_pass {
    const char *name; ///< borrowed
    bool keep;
    bool live;              ///< something wanted depends on it, whether or not it must run
    engine_stamp signature; ///< digest of what it does, apart from what it reads
    engine_stamp stamp;     ///< signature and all it reads
    lobe_pass_state state;
    uint32_t position; ///< among the passes that run, or NONE
    uint32_t first_access, last_access;
} engine_dependency_pass;

typedef struct engine_dependency_access {
    uint32_t pass; ///< ENGINE_DEPENDENCY_NONE: wanted after the frame
    uint32_t resource;
    lobe_range range; ///< with counts above 0
    engine_access_kind kind;
    engine_access_state state;
    uint32_t next;         ///< of the same pass
    uint32_t first_source; ///< of `sources`: for each subresource, who wrote it before
} engine_dependency_access;

typedef enum engine_hazard {
    ENGINE_HAZARD_READ_AFTER_WRITE = 1,
    ENGINE_HAZARD_WRITE_AFTER_READ = 2,
    ENGINE_HAZARD_WRITE_AFTER_WRITE = 4,
} engine_hazard;

typedef struct engine_dependency_edge {
    uint32_t from, to; ///< passes
    uint32_t hazards;  ///< engine_hazard
} engine_dependency_edge;

/// A transition or dependency before the pass at `position`; after the last where it equals the
/// number of passes that run.
typedef struct engine_dependency_barrier {
    uint32_t position;
    uint32_t resource; ///< ENGINE_DEPENDENCY_NONE: all memory
    lobe_range range;
    engine_access_state from, to; ///< `from.layout` is undefined where content may be dropped
} engine_dependency_barrier;

typedef struct engine_dependency_graph {
    engine_dependency_resource *resources;
    engine_dependency_pass *passes;
    engine_dependency_access *accesses;  ///< in order of declaration
    uint32_t *sources;                   ///< access that wrote, or NONE
    engine_dependency_edge *edges;       ///< sorted by `to`, then `from`
    uint32_t *order;                     ///< passes in topological order
    uint32_t *running;                   ///< those of `order` that run
    uint32_t *cycle;                     ///< passes of the cycle found
    engine_dependency_barrier *barriers; ///< sorted by position
    engine_layout *end_layouts; ///< by subresource, after engine_dependency_derive_barriers

    uint32_t resource_count, resource_capacity;
    uint32_t pass_count, pass_capacity;
    uint32_t access_count, access_capacity;
    uint32_t source_count, source_capacity;
    uint32_t edge_count, edge_capacity;
    uint32_t order_count, order_capacity;
    uint32_t running_count, running_capacity;
    uint32_t cycle_count, cycle_capacity;
    uint32_t barrier_count, barrier_capacity;
    uint32_t subresource_count, end_layout_capacity;
    engine_arena scratch; ///< of the steps

    engine_dependency_fault fault; ///< the first
} engine_dependency_graph;

void engine_dependency_graph_free(engine_dependency_graph *graph);
/// Forgets all declarations; keeps the memory for the next frame.
void engine_dependency_graph_reset(engine_dependency_graph *graph);

/// Both copy the structure's first part and set up the derived one; the index of what was added,
/// or ENGINE_DEPENDENCY_NONE without memory.
uint32_t engine_dependency_add_resource(engine_dependency_graph *graph,
                                        const engine_dependency_resource *resource);
uint32_t engine_dependency_add_pass(engine_dependency_graph *graph, const char *name);

/// Declares that `pass` uses `range` of `resource`. Counts of 0 mean all from the first on.
/// On success the resource's newest version comes back in `version` (may be NULL). A pass may
/// name the version from before its own writes, for the subresources that it does not write.
/// Returns the index of the access, or ENGINE_DEPENDENCY_NONE on a fault.
uint32_t engine_dependency_add_access(engine_dependency_graph *graph, uint32_t pass,
                                      lobe_resource resource, lobe_range range,
                                      engine_access_kind kind, uint32_t *version);
/// Marks all content that `resource` has as wanted after the frame.
bool engine_dependency_add_output(engine_dependency_graph *graph, lobe_resource resource);
/// Adds an order between passes that no resource expresses.
bool engine_dependency_add_edge(engine_dependency_graph *graph, uint32_t from, uint32_t to,
                                engine_hazard hazard);

bool engine_dependency_link(engine_dependency_graph *graph);
bool engine_dependency_order(engine_dependency_graph *graph);
bool engine_dependency_cull(engine_dependency_graph *graph);
void engine_dependency_find_lifetimes(engine_dependency_graph *graph);
/// Gives every access of one pass that reads one subresource one layout, then derives barriers.
bool engine_dependency_derive_barriers(engine_dependency_graph *graph);

/// Index of a subresource within its resource.
static inline uint32_t engine_subresource_index(const engine_dependency_resource *resource,
                                                uint32_t level, uint32_t layer) {
    return level * resource->layers + layer;
}

static inline uint32_t engine_access_size(const engine_dependency_access *access) {
    return access->range.level_count * access->range.layer_count;
}

/// The n-th subresource of an access, as an index within its resource.
uint32_t engine_access_subresource(const engine_dependency_graph *graph,
                                   const engine_dependency_access *access, uint32_t n);

/// The access that wrote what the n-th subresource of `access` held before it, or NONE.
static inline uint32_t engine_access_source(const engine_dependency_graph *graph,
                                            const engine_dependency_access *access, uint32_t n) {
    return graph->sources[access->first_source + n];
}

/// Digest of what `writer` (an access, or NONE: the import) left in a subresource.
engine_stamp engine_dependency_content(const engine_dependency_graph *graph, uint32_t writer,
                                       uint32_t resource, uint32_t subresource);

/// Remembers the first fault and returns false.
bool engine_dependency_fail(engine_dependency_graph *graph, engine_dependency_fault fault);

/// One line that says what is wrong, with the names of passes and resources.
void engine_dependency_explain(const engine_dependency_graph *graph, char *text, size_t size);

#endif
