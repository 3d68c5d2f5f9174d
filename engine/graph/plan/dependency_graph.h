#ifndef ENGINE_GRAPH_PLAN_DEPENDENCY_GRAPH_H
#define ENGINE_GRAPH_PLAN_DEPENDENCY_GRAPH_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include <lobe/graph.h>

#include "engine/base/arena.h"
#include "engine/base/stamp.h"

/// Which pass must come before which, which passes need not run, and which barriers are needed: the
/// part of the render graph that knows no Vulkan.
///
/// Passes, resources and accesses are added in any order that suits the caller. Content is tracked
/// for each *subresource* (one level of one layer), so that one level can be read while the next is
/// written. Then come these steps, in this order:
///
///     engine_dependency_link             sources of content, hazards between passes  (validate.c)
///     engine_dependency_order            topological order                           (order.c)
///     engine_dependency_number           numbers of content, if a pass wants one     (stamp.c)
///     engine_dependency_cull             which passes run, are culled, are skipped   (cull.c)
///     engine_dependency_find_lifetimes   first and last use of each resource         (lifetime.c)
///     engine_dependency_derive_barriers  transitions and memory dependencies         (barrier.c)
///
/// Functions that return bool return false on failure and leave the reason in `fault`.

#define ENGINE_DEPENDENCY_NONE UINT32_MAX

/// Layout of an image. Buffers stay UNDEFINED.
typedef enum engine_layout {
    ENGINE_LAYOUT_UNDEFINED,
    ENGINE_LAYOUT_GENERAL, ///< allows every use in shaders and copies
    ENGINE_LAYOUT_SAMPLED,
    ENGINE_LAYOUT_COLOUR,
    ENGINE_LAYOUT_DEPTH,
    ENGINE_LAYOUT_COPY_SOURCE,
    ENGINE_LAYOUT_COPY_TARGET,
    ENGINE_LAYOUT_LENT,     ///< of a borrowed image before the frame
    ENGINE_LAYOUT_RETURNED, ///< of a borrowed image after the frame
} engine_layout;

/// Stages and access types are bit masks that the caller defines; here they are only united and
/// compared.
typedef struct engine_access_state {
    uint64_t stages;
    uint64_t access;
    engine_layout layout;
} engine_access_state;

typedef enum engine_access_kind {
    ENGINE_ACCESS_READ,
    ENGINE_ACCESS_WRITE, ///< the range loses its previous content
    ENGINE_ACCESS_MODIFY,
} engine_access_kind;

typedef enum engine_dependency_fault_kind {
    ENGINE_FAULT_NONE,
    ENGINE_FAULT_MEMORY,           ///< out of host memory
    ENGINE_FAULT_UNKNOWN_RESOURCE, ///< a handle that this graph did not create
    ENGINE_FAULT_STALE,            ///< a version that has been overwritten
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
    uint32_t pass, resource, other_pass; ///< ENGINE_DEPENDENCY_NONE if not applicable
    uint32_t level, layer;
} engine_dependency_fault;

/// How far a pass that modifies what evolves is after the last change of something else.
typedef struct engine_settling {
    engine_stamp change; ///< digest of everything else that it reads
    uint32_t runs;       ///< with the same
    bool rests;          ///< running it again would change nothing
} engine_settling;

typedef struct engine_dependency_resource {
    const char *name; ///< borrowed
    uint32_t levels, layers;
    bool imported;    ///< has content from the start and is never written
    bool retained;    ///< its content is kept for the next frame
    bool evolves;     ///< what a pass finds that modifies it does not count as a change
    uint32_t settles; ///< evolves: how often such a pass runs again after the last change
    bool borrowed;    ///< belongs to the host: passes may write it; it is returned after the frame
    bool rests;       ///< what a frame uses of it is in the state `after` between frames
    /// Borrowed: its uses before and after the frame. The layouts are LENT (UNDEFINED: it has no
    /// content) and RETURNED.
    engine_access_state before, after;
    engine_stamp identity; ///< digest of the description (format, extent); imported: of the content
    const engine_stamp *recorded;       ///< retained: stamp of each subresource's content, or NULL
    const engine_layout *start_layouts; ///< of each subresource at the start; NULL: undefined
    engine_settling settled;            ///< settles: what the last pass that modified it left

    // Where a transient resource is in memory, for dependencies between those that share memory.
    bool placed;
    uint32_t block;
    uint64_t offset, size;

    // Derived
    uint32_t version;                       ///< newest
    uint32_t settled_version;               ///< newest before `last_writer` began to write
    uint32_t last_writer;                   ///< pass that made `version`
    uint32_t first_subresource;             ///< index into the graph's arrays by subresource
    uint32_t first_position, last_position; ///< of its lifetime; NONE: no running pass uses it
    uint32_t numbered_by;                   ///< pass that wants `number`, or NONE
    engine_stamp number;      ///< digest of what passes make it from, see engine_dependency_number
    engine_settling settling; ///< what the pass of this frame leaves if it runs
} engine_dependency_resource;

typedef struct engine_dependency_pass {
    const char *name; ///< borrowed
    bool keep;
    bool live;              ///< an output depends on it, whether or not it has to run
    engine_stamp signature; ///< digest of what it does, without what it reads
    engine_stamp stamp;     ///< digest of the signature and everything it reads
    lobe_pass_state state;
    uint32_t position; ///< among the passes that run, or NONE
    uint32_t first_access, last_access;
} engine_dependency_pass;

typedef struct engine_dependency_access {
    uint32_t pass; ///< ENGINE_DEPENDENCY_NONE: an output of the frame
    uint32_t resource;
    lobe_range range; ///< with counts above 0
    engine_access_kind kind;
    engine_access_state state;
    uint64_t part_bytes;   ///< moved where that is a part of the range; 0: all of it
    uint32_t next;         ///< access of the same pass
    uint32_t first_source; ///< index into `sources`: who wrote each subresource before
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

/// A transition or dependency before the pass at `position`, or after the last pass if `position`
/// is the number of passes that run.
typedef struct engine_dependency_barrier {
    uint32_t position;
    uint32_t resource; ///< ENGINE_DEPENDENCY_NONE: all memory
    lobe_range range;
    engine_access_state from, to; ///< `from.layout` UNDEFINED: the content may be dropped
} engine_dependency_barrier;

typedef struct engine_dependency_graph {
    engine_stamp number; ///< that no other graph has
    engine_dependency_resource *resources;
    engine_dependency_pass *passes;
    engine_dependency_access *accesses;  ///< in order of declaration
    uint32_t *sources;                   ///< access that wrote, or NONE
    engine_dependency_edge *edges;       ///< sorted by `to`, then `from`
    uint32_t *order;                     ///< passes in topological order
    uint32_t *running;                   ///< those of `order` that run
    uint32_t *cycle;                     ///< passes of the cycle, if one was found
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
    bool numbers;         ///< some resource is `numbered_by` a pass
    engine_arena scratch; ///< memory for the steps

    engine_dependency_fault fault; ///< the first one
} engine_dependency_graph;

void engine_dependency_graph_free(engine_dependency_graph *graph);
/// Drops all declarations; keeps the memory for the next frame.
void engine_dependency_graph_reset(engine_dependency_graph *graph);

/// Both return the index of what was added, or ENGINE_DEPENDENCY_NONE if out of memory. Derived
/// members are initialised, not copied.
uint32_t engine_dependency_add_resource(engine_dependency_graph *graph,
                                        const engine_dependency_resource *resource);
uint32_t engine_dependency_add_pass(engine_dependency_graph *graph, const char *name);

/// Declares that `pass` uses `range` of `resource`; counts of 0 mean all from the first one on.
/// On success `version` (may be NULL) is the resource's newest version. A pass may name the version
/// before its own writes, to read subresources that it does not write.
/// Returns the index of the access, or ENGINE_DEPENDENCY_NONE on a fault.
uint32_t engine_dependency_add_access(engine_dependency_graph *graph, uint32_t pass,
                                      lobe_resource resource, lobe_range range,
                                      engine_access_kind kind, uint32_t *version);
/// Marks all content of `resource` as an output of the frame.
bool engine_dependency_add_output(engine_dependency_graph *graph, lobe_resource resource);
/// Adds an order between passes that no resource expresses.
bool engine_dependency_add_edge(engine_dependency_graph *graph, uint32_t from, uint32_t to,
                                engine_hazard hazard);

bool engine_dependency_link(engine_dependency_graph *graph);
bool engine_dependency_order(engine_dependency_graph *graph);
/// Gives all passes their stamps; engine_dependency_cull does so, too.
void engine_dependency_stamp(engine_dependency_graph *graph);
/// Gives each resource that is `numbered_by` a pass its number, after the order and before that
/// pass's signature is complete: the same while the passes that write the resource do the same with
/// the same content. What it held before does not count, nor what the pass with the number uses.
void engine_dependency_number(engine_dependency_graph *graph);
bool engine_dependency_cull(engine_dependency_graph *graph);
void engine_dependency_find_lifetimes(engine_dependency_graph *graph);
/// Gives all accesses of a pass that read the same subresource one layout, then derives barriers.
bool engine_dependency_derive_barriers(engine_dependency_graph *graph);

/// Index of a subresource within its resource.
static inline uint32_t engine_subresource_index(const engine_dependency_resource *resource,
                                                uint32_t level, uint32_t layer) {
    return level * resource->layers + layer;
}

static inline bool engine_access_reads(const engine_dependency_access *access) {
    return access->kind != ENGINE_ACCESS_WRITE;
}

static inline bool engine_access_writes(const engine_dependency_access *access) {
    return access->kind != ENGINE_ACCESS_READ;
}

static inline uint32_t engine_access_size(const engine_dependency_access *access) {
    return access->range.level_count * access->range.layer_count;
}

/// The n-th subresource of an access, as an index within its resource.
uint32_t engine_access_subresource(const engine_dependency_graph *graph,
                                   const engine_dependency_access *access, uint32_t n);

/// The access that last wrote the n-th subresource of `access` before it, or NONE.
static inline uint32_t engine_access_source(const engine_dependency_graph *graph,
                                            const engine_dependency_access *access, uint32_t n) {
    return graph->sources[access->first_source + n];
}

/// Digest of the content that `writer` (an access; NONE: the start of the frame) left in a
/// subresource.
engine_stamp engine_dependency_content(const engine_dependency_graph *graph, uint32_t writer,
                                       uint32_t resource, uint32_t subresource);

/// Stores the fault if it is the first one. Returns false.
bool engine_dependency_fail(engine_dependency_graph *graph, engine_dependency_fault fault);

/// Describes the fault in one line, with the names of passes and resources.
void engine_dependency_explain(const engine_dependency_graph *graph, char *text, size_t size);

#endif
