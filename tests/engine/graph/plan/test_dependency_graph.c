#include "tests/engine/support/cmocka_all.h"

#include <stdio.h>
#include <string.h>

#include "engine/graph/plan/dependency_graph.h"

// States of an imaginary device.
#define STAGE_A 1
#define STAGE_B 2
#define STAGE_C 4
#define READ    1
#define WRITE   2

static const engine_access_state written_in_a = {STAGE_A, WRITE, ENGINE_LAYOUT_GENERAL};
static const engine_access_state read_in_b = {STAGE_B, READ, ENGINE_LAYOUT_SAMPLED};
static const engine_access_state read_in_c = {STAGE_C, READ, ENGINE_LAYOUT_SAMPLED};

static engine_dependency_graph graph;

static int forget(void **state) {
    (void)state;
    engine_dependency_graph_free(&graph);
    return 0;
}

static lobe_resource resource_of(engine_dependency_resource description) {
    if (description.levels == 0)
        description.levels = 1;
    if (description.layers == 0)
        description.layers = 1;
    uint32_t index = engine_dependency_add_resource(&graph, &description);
    assert_int_not_equal(index, ENGINE_DEPENDENCY_NONE);
    return (lobe_resource){index, 1};
}

static lobe_resource transient(const char *name, uint32_t levels) {
    return resource_of((engine_dependency_resource){.name = name, .levels = levels});
}

static uint32_t pass_of(const char *name) {
    return engine_dependency_add_pass(&graph, name);
}

static uint32_t access_of(uint32_t pass, lobe_resource *resource, lobe_range range,
                          engine_access_kind kind, engine_access_state state) {
    uint32_t access =
        engine_dependency_add_access(&graph, pass, *resource, range, kind,
                                     kind == ENGINE_ACCESS_READ ? NULL : &resource->version);
    if (access != ENGINE_DEPENDENCY_NONE)
        graph.accesses[access].state = state;
    return access;
}

static void reads(uint32_t pass, lobe_resource resource) {
    assert_int_not_equal(access_of(pass, &resource, (lobe_range){0}, ENGINE_ACCESS_READ, read_in_b),
                         ENGINE_DEPENDENCY_NONE);
}

static void reads_level(uint32_t pass, lobe_resource resource, uint32_t level) {
    assert_int_not_equal(
        access_of(pass, &resource, (lobe_range){level, 1, 0, 0}, ENGINE_ACCESS_READ, read_in_b),
        ENGINE_DEPENDENCY_NONE);
}

static lobe_resource writes(uint32_t pass, lobe_resource resource) {
    assert_int_not_equal(
        access_of(pass, &resource, (lobe_range){0}, ENGINE_ACCESS_WRITE, written_in_a),
        ENGINE_DEPENDENCY_NONE);
    return resource;
}

static lobe_resource modifies(uint32_t pass, lobe_resource resource) {
    assert_int_not_equal(
        access_of(pass, &resource, (lobe_range){0}, ENGINE_ACCESS_MODIFY, written_in_a),
        ENGINE_DEPENDENCY_NONE);
    return resource;
}

static lobe_resource writes_level(uint32_t pass, lobe_resource resource, uint32_t level) {
    assert_int_not_equal(
        access_of(pass, &resource, (lobe_range){level, 1, 0, 0}, ENGINE_ACCESS_WRITE, written_in_a),
        ENGINE_DEPENDENCY_NONE);
    return resource;
}

static void wants(lobe_resource resource) {
    assert_true(engine_dependency_add_output(&graph, resource));
}

static void compile(void) {
    assert_true(engine_dependency_link(&graph));
    assert_true(engine_dependency_order(&graph));
    assert_true(engine_dependency_cull(&graph));
    engine_dependency_find_lifetimes(&graph);
    assert_true(engine_dependency_derive_barriers(&graph));
}

/// The hazards between two passes, as bits.
static uint32_t hazards(uint32_t from, uint32_t to) {
    for (uint32_t i = 0; i < graph.edge_count; i++)
        if (graph.edges[i].from == from && graph.edges[i].to == to)
            return graph.edges[i].hazards;
    return 0;
}

static void assert_running(const char *expected) {
    char names[256] = "";
    for (uint32_t i = 0; i < graph.running_count; i++) {
        strcat(names, i ? " " : "");
        strcat(names, graph.passes[graph.running[i]].name);
    }
    assert_string_equal(names, expected);
}

static void assert_fault(engine_dependency_fault_kind kind, const char *pass,
                         const char *resource) {
    char text[512];
    assert_int_equal(graph.fault.kind, kind);
    engine_dependency_explain(&graph, text, sizeof text);
    if (!strstr(text, pass) || !strstr(text, resource))
        fail_msg("neither '%s' nor '%s' may be missing: %s", pass, resource, text);
}

// ---------------------------------------------------------------------------------------------
// Hazards

static void hazards_are_told_apart(void **state) {
    (void)state;
    lobe_resource x = transient("x", 1);
    uint32_t a = pass_of("a"), b = pass_of("b"), c = pass_of("c"), d = pass_of("d");
    x = writes(a, x);
    reads(b, x);
    x = writes(c, x);
    x = writes(d, x);
    wants(x);
    compile();
    assert_int_equal(hazards(a, b), ENGINE_HAZARD_READ_AFTER_WRITE);
    assert_int_equal(hazards(a, c), ENGINE_HAZARD_WRITE_AFTER_WRITE);
    assert_int_equal(hazards(b, c), ENGINE_HAZARD_WRITE_AFTER_READ);
    assert_int_equal(hazards(c, d), ENGINE_HAZARD_WRITE_AFTER_WRITE);
    assert_int_equal(hazards(a, d), 0);
    assert_int_equal(graph.edge_count, 4);
}

static void modifying_reads_and_writes(void **state) {
    (void)state;
    lobe_resource x = transient("x", 1);
    uint32_t a = pass_of("a"), b = pass_of("b");
    x = writes(a, x);
    access_of(b, &x, (lobe_range){0}, ENGINE_ACCESS_MODIFY, written_in_a);
    assert_int_equal(x.version, 3);
    wants(x);
    compile();
    assert_int_equal(hazards(a, b),
                     ENGINE_HAZARD_READ_AFTER_WRITE | ENGINE_HAZARD_WRITE_AFTER_WRITE);
    assert_running("a b");
}

static void levels_are_apart(void **state) {
    (void)state;
    lobe_resource x = transient("x", 3);
    uint32_t base = pass_of("base"), half = pass_of("half"), quarter = pass_of("quarter");
    uint32_t view = pass_of("view");
    x = writes_level(base, x, 0);
    reads_level(half, x, 0);
    x = writes_level(half, x, 1);
    reads_level(quarter, x, 1);
    x = writes_level(quarter, x, 2);
    lobe_resource seen = transient("seen", 1);
    reads_level(view, x, 0);
    seen = writes(view, seen);
    wants(seen);
    compile();
    assert_int_equal(hazards(base, half), ENGINE_HAZARD_READ_AFTER_WRITE);
    assert_int_equal(hazards(half, quarter), ENGINE_HAZARD_READ_AFTER_WRITE);
    assert_int_equal(hazards(base, quarter), 0);
    // A pass that reads only level 0 does not need the others.
    assert_int_equal(hazards(base, view), ENGINE_HAZARD_READ_AFTER_WRITE);
    assert_int_equal(hazards(quarter, view), 0);
    assert_running("base view");
}

static void layers_are_apart(void **state) {
    (void)state;
    lobe_resource x =
        resource_of((engine_dependency_resource){.name = "x", .levels = 2, .layers = 3});
    uint32_t a = pass_of("a"), b = pass_of("b");
    access_of(a, &x, (lobe_range){1, 1, 0, 2}, ENGINE_ACCESS_WRITE, written_in_a);
    access_of(b, &x, (lobe_range){0, 0, 2, 1}, ENGINE_ACCESS_WRITE, written_in_a);
    wants(x);
    compile();
    assert_int_equal(graph.edge_count, 0);
    assert_running("a b");
}

/// Two passes write half of a resource each; one of them wrote before a third overwrote both.
static void a_range_has_several_sources(void **state) {
    (void)state;
    lobe_resource x = transient("x", 2);
    uint32_t both = pass_of("both"), second = pass_of("second"), reader = pass_of("reader");
    x = writes(both, x);
    x = writes_level(second, x, 1);
    lobe_resource y = transient("y", 1);
    reads(reader, x);
    y = writes(reader, y);
    wants(y);
    compile();
    assert_int_equal(hazards(both, reader), ENGINE_HAZARD_READ_AFTER_WRITE);
    assert_int_equal(hazards(second, reader), ENGINE_HAZARD_READ_AFTER_WRITE);
    assert_running("both second reader");
}

// ---------------------------------------------------------------------------------------------
// Order

static void order_is_that_of_declaration_where_it_can_be(void **state) {
    (void)state;
    char names[8][12];
    for (int i = 0; i < 8; i++) {
        snprintf(names[i], sizeof names[i], "%d", i);
        lobe_resource x = transient(names[i], 1);
        wants(writes(pass_of(names[i]), x));
    }
    compile();
    assert_running("0 1 2 3 4 5 6 7");
}

/// Passes may be added before those they need, as long as the accesses are added in order.
static void a_pass_waits_for_what_it_needs(void **state) {
    (void)state;
    lobe_resource x = transient("x", 1), y = transient("y", 1);
    uint32_t late = pass_of("late"), early = pass_of("early");
    x = writes(early, x);
    reads(late, x);
    y = writes(late, y);
    wants(y);
    compile();
    assert_running("early late");
}

static void cycles_are_found_and_named(void **state) {
    (void)state;
    lobe_resource x = transient("x", 1), y = transient("y", 1);
    uint32_t before = pass_of("before"), a = pass_of("a"), b = pass_of("b"), c = pass_of("c");
    lobe_resource z = transient("z", 1);
    z = writes(before, z);
    reads(a, z);
    x = writes(a, x);
    reads(b, x);
    lobe_resource w = transient("w", 1);
    w = writes(b, w);
    reads(c, w);
    y = writes(c, y);
    reads(a, y);
    wants(y);
    assert_true(engine_dependency_link(&graph));
    assert_false(engine_dependency_order(&graph));
    assert_fault(ENGINE_FAULT_CYCLE, "'a' before 'b' before 'c' before 'a'", "'x'");
    assert_int_equal(graph.cycle_count, 3);
}

static void an_explicit_order_can_close_a_cycle(void **state) {
    (void)state;
    lobe_resource x = transient("x", 1);
    uint32_t a = pass_of("a"), b = pass_of("b");
    x = writes(a, x);
    reads(b, x);
    assert_true(engine_dependency_add_edge(&graph, b, a, ENGINE_HAZARD_WRITE_AFTER_READ));
    assert_true(engine_dependency_link(&graph));
    assert_false(engine_dependency_order(&graph));
    assert_fault(ENGINE_FAULT_CYCLE, "'a'", "'x'");
}

/// For any accesses, the order respects every edge.
static void every_edge_is_respected(void **state) {
    (void)state;
    uint32_t seed = 1;
    for (int round = 0; round < 50; round++) {
        engine_dependency_graph_reset(&graph);
        lobe_resource resources[6];
        uint32_t passes[12];
        for (int i = 0; i < 6; i++)
            resources[i] = transient("r", 3);
        for (int i = 0; i < 12; i++)
            passes[i] = pass_of("p");
        for (int i = 0; i < 6; i++)
            resources[i] = writes(passes[i], resources[i]);
        for (int i = 6; i < 12; i++)
            for (int j = 0; j < 4; j++) {
                seed = seed * 1664525u + 1013904223u;
                uint32_t which = (seed >> 8) % 6, level = (seed >> 16) % 3;
                if (seed >> 31)
                    resources[which] = writes_level(passes[i], resources[which], level);
                else
                    reads_level(passes[i], resources[which], level);
            }
        if (!engine_dependency_link(&graph)) {
            assert_true(graph.fault.kind == ENGINE_FAULT_CONFLICT ||
                        graph.fault.kind == ENGINE_FAULT_WRITTEN_TWICE);
            continue;
        }
        assert_true(engine_dependency_order(&graph));
        uint32_t place[12];
        for (uint32_t i = 0; i < 12; i++)
            place[graph.order[i]] = i;
        for (uint32_t i = 0; i < graph.edge_count; i++)
            assert_true(place[graph.edges[i].from] < place[graph.edges[i].to]);
    }
}

// ---------------------------------------------------------------------------------------------
// Misuse

static void stale_versions_are_refused(void **state) {
    (void)state;
    lobe_resource x = transient("x", 1);
    uint32_t a = pass_of("a"), b = pass_of("b"), c = pass_of("c");
    lobe_resource first = writes(a, x);
    writes(b, first);
    assert_int_equal(access_of(c, &first, (lobe_range){0}, ENGINE_ACCESS_READ, read_in_b),
                     ENGINE_DEPENDENCY_NONE);
    assert_fault(ENGINE_FAULT_STALE, "'c'", "'x'");
    assert_fault(ENGINE_FAULT_STALE, "'b'", "'x'");
}

static void versions_of_the_future_are_refused(void **state) {
    (void)state;
    lobe_resource x = transient("x", 1);
    lobe_resource future = {x.index, 7}, foreign = {99, 1}, none = {0};
    uint32_t a = pass_of("a");
    lobe_resource wrong[] = {future, foreign, none};
    for (int i = 0; i < 3; i++) {
        graph.fault = (engine_dependency_fault){0};
        assert_int_equal(access_of(a, &wrong[i], (lobe_range){0}, ENGINE_ACCESS_READ, read_in_b),
                         ENGINE_DEPENDENCY_NONE);
        assert_fault(ENGINE_FAULT_UNKNOWN_RESOURCE, "'a'", i == 0 ? "x" : "");
    }
}

/// A pass may name either version of what it does not write itself.
static void a_pass_may_use_the_version_it_started_from(void **state) {
    (void)state;
    lobe_resource x = transient("x", 3);
    uint32_t a = pass_of("a"), b = pass_of("b");
    lobe_resource before = writes_level(a, x, 0);
    lobe_resource after = writes_level(b, before, 1);
    reads_level(b, before, 0);
    reads_level(b, after, 0);
    after = writes_level(b, before, 2);
    wants(after);
    compile();
    assert_running("a b");
    assert_int_equal(access_of(b, &x, (lobe_range){0, 1, 0, 1}, ENGINE_ACCESS_READ, read_in_b),
                     ENGINE_DEPENDENCY_NONE);
    assert_fault(ENGINE_FAULT_STALE, "'b'", "'x'");
}

static void ranges_are_checked(void **state) {
    (void)state;
    const lobe_range wrong[] = {{2, 1, 0, 1}, {0, 3, 0, 1}, {0, 1, 3, 1},
                                {0, 1, 0, 4}, {1, 2, 0, 1}, {0, UINT32_MAX, 0, 1}};
    lobe_resource x =
        resource_of((engine_dependency_resource){.name = "x", .levels = 2, .layers = 3});
    uint32_t a = pass_of("a");
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        graph.fault = (engine_dependency_fault){0};
        assert_int_equal(access_of(a, &x, wrong[i], ENGINE_ACCESS_WRITE, written_in_a),
                         ENGINE_DEPENDENCY_NONE);
        assert_fault(ENGINE_FAULT_RANGE, "'a'", "'x'");
    }
    assert_int_equal(graph.access_count, 0);
}

static void what_was_brought_in_is_not_written(void **state) {
    (void)state;
    lobe_resource x = resource_of((engine_dependency_resource){.name = "x", .imported = true});
    uint32_t a = pass_of("a");
    reads(a, x);
    assert_int_equal(access_of(a, &x, (lobe_range){0}, ENGINE_ACCESS_MODIFY, written_in_a),
                     ENGINE_DEPENDENCY_NONE);
    assert_fault(ENGINE_FAULT_IMPORTED_WRITTEN, "'a'", "'x'");
}

static void what_was_never_written_is_not_read(void **state) {
    (void)state;
    lobe_resource x = transient("x", 2);
    uint32_t a = pass_of("a"), b = pass_of("b");
    x = writes_level(a, x, 0);
    reads(b, x);
    assert_false(engine_dependency_link(&graph));
    assert_fault(ENGINE_FAULT_NEVER_WRITTEN, "'b'", "'x' (level 1, layer 0)");
}

static void an_output_without_content_is_refused(void **state) {
    (void)state;
    wants(transient("x", 2));
    assert_false(engine_dependency_link(&graph));
    assert_fault(ENGINE_FAULT_NEVER_WRITTEN, "output", "'x'");
}

static void an_output_is_not_overwritten(void **state) {
    (void)state;
    lobe_resource x = transient("x", 2);
    uint32_t a = pass_of("a"), b = pass_of("b"), c = pass_of("c");
    x = writes_level(a, x, 0);
    wants(x);
    x = writes_level(b, x, 1); // adds to it: allowed
    x = writes_level(c, x, 0);
    assert_false(engine_dependency_link(&graph));
    assert_fault(ENGINE_FAULT_OVERWRITTEN, "'c'", "'x'");
}

/// Reading and writing one subresource through two accesses of one pass, in either order.
static void conflicts_within_a_pass_are_refused(void **state) {
    (void)state;
    for (int order = 0; order < 2; order++) {
        engine_dependency_graph_reset(&graph);
        lobe_resource x = transient("x", 3);
        uint32_t a = pass_of("a"), b = pass_of("b");
        x = writes(a, x);
        if (order == 0)
            reads_level(b, x, 2);
        lobe_resource next = writes_level(b, x, 2);
        if (order == 1)
            reads(b, next);
        assert_false(engine_dependency_link(&graph));
        assert_fault(ENGINE_FAULT_CONFLICT, "'b'", "'x' (level 2, layer 0)");
    }
}

static void writing_twice_in_a_pass_is_refused(void **state) {
    (void)state;
    lobe_resource x = transient("x", 1);
    uint32_t a = pass_of("a");
    x = writes(a, x);
    writes(a, x);
    assert_false(engine_dependency_link(&graph));
    assert_fault(ENGINE_FAULT_WRITTEN_TWICE, "'a'", "'x'");
}

static void only_the_first_fault_counts(void **state) {
    (void)state;
    lobe_resource x = transient("x", 1), none = {0};
    uint32_t a = pass_of("a");
    access_of(a, &x, (lobe_range){5, 1, 0, 1}, ENGINE_ACCESS_WRITE, written_in_a);
    access_of(a, &none, (lobe_range){0}, ENGINE_ACCESS_WRITE, written_in_a);
    assert_fault(ENGINE_FAULT_RANGE, "'a'", "'x'");
}

// ---------------------------------------------------------------------------------------------
// What runs

static void what_nothing_wants_is_culled(void **state) {
    (void)state;
    lobe_resource x = transient("x", 1), y = transient("y", 1), z = transient("z", 1);
    uint32_t a = pass_of("a"), b = pass_of("b"), c = pass_of("c"), d = pass_of("d");
    x = writes(a, x);
    reads(b, x);
    y = writes(b, y);
    reads(c, x);
    z = writes(c, z);
    wants(z);
    compile();
    assert_running("a c");
    assert_int_equal(graph.passes[b].state, LOBE_PASS_CULLED);
    assert_int_equal(graph.passes[d].state, LOBE_PASS_CULLED);
    assert_int_equal(graph.passes[b].position, ENGINE_DEPENDENCY_NONE);
    assert_int_equal(graph.passes[c].position, 1);
}

/// A pass that only overwrites needs no previous content.
static void overwritten_content_is_not_wanted(void **state) {
    (void)state;
    lobe_resource x = transient("x", 1);
    uint32_t a = pass_of("a"), b = pass_of("b");
    x = writes(a, x);
    x = writes(b, x);
    wants(x);
    compile();
    assert_running("b");
}

static void kept_passes_run(void **state) {
    (void)state;
    lobe_resource x = transient("x", 1), y = transient("y", 1);
    uint32_t a = pass_of("a"), b = pass_of("b"), c = pass_of("c");
    x = writes(a, x);
    reads(b, x);
    y = writes(b, y);
    graph.passes[b].keep = true;
    graph.passes[c].keep = true;
    compile();
    assert_running("a b c");
}

/// Content of retained resources after the passes of the graph have run.
static void record(uint32_t resource, engine_stamp *stamps) {
    for (uint32_t i = 0; i < graph.running_count; i++)
        for (uint32_t a = graph.passes[graph.running[i]].first_access; a != ENGINE_DEPENDENCY_NONE;
             a = graph.accesses[a].next)
            for (uint32_t s = 0; s < engine_access_size(&graph.accesses[a]); s++)
                if (graph.accesses[a].resource == resource &&
                    graph.accesses[a].kind != ENGINE_ACCESS_READ) {
                    uint32_t subresource = engine_access_subresource(&graph, &graph.accesses[a], s);
                    stamps[subresource] =
                        engine_dependency_content(&graph, a, resource, subresource);
                }
}

/// import -> base (level 0) -> half (level 1), retained; half -> look -> seen, an output.
static void retained_frame(engine_stamp *stamps, uint64_t content, uint64_t half_signature) {
    engine_dependency_graph_reset(&graph);
    lobe_resource given = resource_of(
        (engine_dependency_resource){.name = "given", .imported = true, .identity = content});
    lobe_resource kept = resource_of((engine_dependency_resource){
        .name = "kept", .levels = 2, .retained = true, .recorded = stamps});
    lobe_resource seen = transient("seen", 1);
    uint32_t base = pass_of("base"), half = pass_of("half"), look = pass_of("look");
    graph.passes[base].signature = 1;
    graph.passes[half].signature = half_signature;
    graph.passes[look].signature = 3;
    reads(base, given);
    kept = writes_level(base, kept, 0);
    reads_level(half, kept, 0);
    kept = writes_level(half, kept, 1);
    reads_level(look, kept, 1);
    seen = writes(look, seen);
    wants(seen);
    compile();
    record(kept.index, stamps);
}

static void valid_content_stops_demand(void **state) {
    (void)state;
    engine_stamp stamps[2] = {0};
    retained_frame(stamps, 100, 2);
    assert_running("base half look");
    retained_frame(stamps, 100, 2);
    assert_running("look");
    assert_int_equal(graph.passes[0].state, LOBE_PASS_SKIPPED);
    assert_int_equal(graph.passes[1].state, LOBE_PASS_SKIPPED);
    retained_frame(stamps, 100, 22); // half does something else
    assert_running("half look");
    retained_frame(stamps, 101, 22); // other content is imported
    assert_running("base half look");
    stamps[1] = ENGINE_STAMP_NONE; // level 1 was lost
    retained_frame(stamps, 101, 22);
    assert_running("half look");
}

/// The stamp of a pass that modifies a retained resource.
static engine_stamp stamp_of_modification(bool evolves, engine_stamp found, engine_stamp number) {
    engine_dependency_graph_reset(&graph);
    graph.number = number;
    lobe_resource kept = resource_of((engine_dependency_resource){
        .name = "kept", .retained = true, .evolves = evolves, .recorded = &found});
    const uint32_t a = pass_of("a");
    kept = modifies(a, kept);
    wants(kept);
    compile();
    graph.number = 0;
    return graph.passes[a].stamp;
}

static void what_evolves_counts_by_its_graph(void **state) {
    (void)state;
    assert_true(stamp_of_modification(false, 5, 1) == stamp_of_modification(false, 5, 2));
    assert_true(stamp_of_modification(false, 5, 1) != stamp_of_modification(false, 6, 1));
    assert_true(stamp_of_modification(true, 5, 1) == stamp_of_modification(true, 6, 1));
    assert_true(stamp_of_modification(true, 5, 1) != stamp_of_modification(true, 5, 2));
}

static void ranges_kinds_and_shapes_are_part_of_the_stamp(void **state) {
    (void)state;
    engine_stamp stamps[6];
    for (int i = 0; i < 6; i++) {
        engine_dependency_graph_reset(&graph);
        lobe_resource given = resource_of((engine_dependency_resource){
            .name = "given", .levels = 2, .imported = true, .identity = i == 1 ? 8 : 7});
        lobe_resource x = resource_of(
            (engine_dependency_resource){.name = "x", .levels = 2, .identity = i == 2 ? 1 : 2});
        uint32_t a = pass_of("a");
        graph.passes[a].signature = i == 3 ? 5 : 6;
        reads_level(a, given, i == 4 ? 1 : 0);
        x = writes_level(a, x, i == 5 ? 1 : 0);
        wants(x);
        compile();
        stamps[i] = graph.passes[a].stamp;
        for (int j = 0; j < i; j++)
            assert_true(stamps[j] != stamps[i]);
    }
}

// ---------------------------------------------------------------------------------------------
// Lifetimes

static void lifetimes_span_first_to_last_use(void **state) {
    (void)state;
    lobe_resource x = transient("x", 1), y = transient("y", 1), unused = transient("unused", 1);
    uint32_t a = pass_of("a"), culled = pass_of("culled"), b = pass_of("b"), c = pass_of("c");
    x = writes(a, x);
    unused = writes(culled, unused);
    y = writes(b, y);
    lobe_resource z = transient("z", 1);
    reads(c, x);
    reads(c, y);
    z = writes(c, z);
    wants(z);
    compile();
    assert_int_equal(graph.resources[x.index].first_position, 0);
    assert_int_equal(graph.resources[x.index].last_position, 2);
    assert_int_equal(graph.resources[y.index].first_position, 1);
    // Outputs live until the end of the frame.
    assert_int_equal(graph.resources[z.index].last_position, 3);
    assert_int_equal(graph.resources[unused.index].first_position, ENGINE_DEPENDENCY_NONE);
}

// ---------------------------------------------------------------------------------------------
// Barriers

static const engine_dependency_barrier *only_barrier(uint32_t position, uint32_t resource) {
    const engine_dependency_barrier *found = NULL;
    for (uint32_t i = 0; i < graph.barrier_count; i++)
        if (graph.barriers[i].position == position && graph.barriers[i].resource == resource) {
            assert_null(found);
            found = &graph.barriers[i];
        }
    return found;
}

static void a_first_write_drops_former_content(void **state) {
    (void)state;
    lobe_resource x = transient("x", 3);
    wants(writes(pass_of("a"), x));
    compile();
    const engine_dependency_barrier *barrier = only_barrier(0, x.index);
    assert_non_null(barrier);
    assert_int_equal(graph.barrier_count, 1);
    assert_int_equal(barrier->from.layout, ENGINE_LAYOUT_UNDEFINED);
    assert_int_equal(barrier->to.layout, ENGINE_LAYOUT_GENERAL);
    assert_int_equal(barrier->from.stages, 0);
    assert_int_equal(barrier->range.level_count, 3); // in one barrier
}

/// Three readers after one write, in two stages: one transition makes it visible to all.
static void readers_share_one_barrier(void **state) {
    (void)state;
    lobe_resource x = transient("x", 1);
    uint32_t a = pass_of("a");
    x = writes(a, x);
    for (int i = 0; i < 3; i++) {
        lobe_resource y = transient("y", 1);
        uint32_t reader = pass_of("reader");
        access_of(reader, &x, (lobe_range){0}, ENGINE_ACCESS_READ, i == 1 ? read_in_c : read_in_b);
        wants(writes(reader, y));
    }
    compile();
    const engine_dependency_barrier *barrier = only_barrier(1, x.index);
    assert_non_null(barrier);
    assert_int_equal(barrier->from.stages, STAGE_A);
    assert_int_equal(barrier->from.access, WRITE);
    assert_int_equal(barrier->to.stages, STAGE_B | STAGE_C);
    assert_int_equal(barrier->to.access, READ);
    assert_int_equal(barrier->to.layout, ENGINE_LAYOUT_SAMPLED);
    assert_null(only_barrier(2, x.index));
    assert_null(only_barrier(3, x.index));
}

static void every_hazard_of_a_buffer_has_its_barrier(void **state) {
    (void)state;
    const engine_access_state read_block = {STAGE_B, READ, ENGINE_LAYOUT_UNDEFINED};
    const engine_access_state write_block = {STAGE_A, WRITE, ENGINE_LAYOUT_UNDEFINED};
    lobe_resource x = transient("buffer", 1);
    uint32_t a = pass_of("a"), b = pass_of("b"), c = pass_of("c");
    access_of(a, &x, (lobe_range){0}, ENGINE_ACCESS_WRITE, write_block);
    access_of(b, &x, (lobe_range){0}, ENGINE_ACCESS_READ, read_block);
    access_of(c, &x, (lobe_range){0}, ENGINE_ACCESS_WRITE, write_block);
    for (uint32_t pass = a; pass <= c; pass++)
        wants(writes(pass, transient("out", 1)));
    wants(x);
    compile();
    assert_running("a b c");
    assert_null(only_barrier(0, x.index)); // it had no content
    const engine_dependency_barrier *read = only_barrier(1, x.index);
    assert_int_equal(read->from.access, WRITE);
    assert_int_equal(read->to.stages, STAGE_B);
    const engine_dependency_barrier *write = only_barrier(2, x.index);
    assert_int_equal(write->from.stages, STAGE_A | STAGE_B);
    assert_int_equal(write->to.stages, STAGE_A);
}

static void only_the_levels_concerned_are_moved(void **state) {
    (void)state;
    lobe_resource x =
        resource_of((engine_dependency_resource){.name = "x", .levels = 4, .layers = 6});
    uint32_t a = pass_of("a"), b = pass_of("b");
    x = writes(a, x);
    lobe_resource y = transient("y", 1);
    access_of(b, &x, (lobe_range){1, 2, 0, 0}, ENGINE_ACCESS_READ, read_in_b);
    y = writes(b, y);
    wants(y);
    compile();
    const engine_dependency_barrier *barrier = only_barrier(1, x.index);
    const lobe_range expected = {1, 2, 0, 6};
    assert_memory_equal(&barrier->range, &expected, sizeof expected);
    assert_int_equal(graph.end_layouts[graph.resources[x.index].first_subresource],
                     ENGINE_LAYOUT_GENERAL);
    assert_int_equal(graph.end_layouts[graph.resources[x.index].first_subresource + 6],
                     ENGINE_LAYOUT_SAMPLED);
}

/// One pass reads it both sampled and as a storage image: one layout for both.
static void reads_of_one_pass_agree_on_a_layout(void **state) {
    (void)state;
    lobe_resource x = transient("x", 2), y = transient("y", 1);
    uint32_t a = pass_of("a"), b = pass_of("b");
    x = writes(a, x);
    uint32_t sampled = access_of(b, &x, (lobe_range){0}, ENGINE_ACCESS_READ, read_in_b);
    uint32_t stored = access_of(b, &x, (lobe_range){1, 1, 0, 1}, ENGINE_ACCESS_READ,
                                (engine_access_state){STAGE_C, READ, ENGINE_LAYOUT_GENERAL});
    y = writes(b, y);
    wants(y);
    compile();
    assert_int_equal(graph.accesses[sampled].state.layout, ENGINE_LAYOUT_GENERAL);
    assert_int_equal(graph.accesses[stored].state.layout, ENGINE_LAYOUT_GENERAL);
}

static void what_was_brought_in_goes_back_to_its_layout(void **state) {
    (void)state;
    static const engine_layout layout = ENGINE_LAYOUT_SAMPLED;
    lobe_resource x = resource_of(
        (engine_dependency_resource){.name = "x", .imported = true, .start_layouts = &layout});
    lobe_resource y = transient("y", 1);
    uint32_t a = pass_of("a");
    access_of(a, &x, (lobe_range){0}, ENGINE_ACCESS_READ,
              (engine_access_state){STAGE_C, READ, ENGINE_LAYOUT_COPY_SOURCE});
    wants(writes(a, y));
    compile();
    const engine_dependency_barrier *there = only_barrier(0, x.index);
    const engine_dependency_barrier *back = only_barrier(1, x.index);
    assert_int_equal(there->from.layout, ENGINE_LAYOUT_SAMPLED);
    assert_int_equal(there->to.layout, ENGINE_LAYOUT_COPY_SOURCE);
    assert_int_equal(back->from.layout, ENGINE_LAYOUT_COPY_SOURCE);
    assert_int_equal(back->from.stages, STAGE_C);
    assert_int_equal(back->to.layout, ENGINE_LAYOUT_SAMPLED);
}

static void retained_content_keeps_its_layout(void **state) {
    (void)state;
    static const engine_layout layout = ENGINE_LAYOUT_SAMPLED;
    engine_stamp stamp = 77;
    lobe_resource x = resource_of((engine_dependency_resource){
        .name = "x", .retained = true, .recorded = &stamp, .start_layouts = &layout});
    lobe_resource y = transient("y", 1);
    uint32_t a = pass_of("a");
    reads(a, x);
    wants(writes(a, y));
    compile();
    assert_null(only_barrier(0, x.index));
}

/// A resource in memory that another used waits for the last uses of that other one.
static void shared_memory_is_waited_for(void **state) {
    (void)state;
    lobe_resource x = transient("x", 1), y = transient("y", 1), z = transient("z", 1);
    uint32_t a = pass_of("a"), b = pass_of("b"), c = pass_of("c");
    x = writes(a, x);
    reads(b, x);
    y = writes(b, y);
    reads(c, y);
    z = writes(c, z);
    wants(z);
    // z uses the memory of x; y is elsewhere.
    const uint64_t offsets[] = {0, 64, 32};
    for (int i = 0; i < 3; i++) {
        graph.resources[i].placed = true;
        graph.resources[i].offset = offsets[i];
        graph.resources[i].size = i == 1 ? 64 : 48;
    }
    graph.resources[1].block = 1;
    compile();
    const engine_dependency_barrier *memory = only_barrier(2, ENGINE_DEPENDENCY_NONE);
    assert_non_null(memory);
    assert_int_equal(memory->from.stages & STAGE_B, STAGE_B); // x's reader
    assert_int_equal(memory->to.stages, STAGE_A);
    const engine_dependency_barrier *transition = only_barrier(2, z.index);
    assert_int_equal(transition->from.stages & STAGE_B, STAGE_B);
    assert_int_equal(transition->from.layout, ENGINE_LAYOUT_UNDEFINED);
    assert_null(only_barrier(0, ENGINE_DEPENDENCY_NONE));
    assert_null(only_barrier(1, ENGINE_DEPENDENCY_NONE));
}

#define TEST(function) cmocka_unit_test_teardown(function, forget)

int main(void) {
    const struct CMUnitTest tests[] = {
        TEST(hazards_are_told_apart),
        TEST(modifying_reads_and_writes),
        TEST(levels_are_apart),
        TEST(layers_are_apart),
        TEST(a_range_has_several_sources),
        TEST(order_is_that_of_declaration_where_it_can_be),
        TEST(a_pass_waits_for_what_it_needs),
        TEST(cycles_are_found_and_named),
        TEST(an_explicit_order_can_close_a_cycle),
        TEST(every_edge_is_respected),
        TEST(stale_versions_are_refused),
        TEST(versions_of_the_future_are_refused),
        TEST(a_pass_may_use_the_version_it_started_from),
        TEST(ranges_are_checked),
        TEST(what_was_brought_in_is_not_written),
        TEST(what_was_never_written_is_not_read),
        TEST(an_output_without_content_is_refused),
        TEST(an_output_is_not_overwritten),
        TEST(conflicts_within_a_pass_are_refused),
        TEST(writing_twice_in_a_pass_is_refused),
        TEST(only_the_first_fault_counts),
        TEST(what_nothing_wants_is_culled),
        TEST(overwritten_content_is_not_wanted),
        TEST(kept_passes_run),
        TEST(valid_content_stops_demand),
        TEST(what_evolves_counts_by_its_graph),
        TEST(ranges_kinds_and_shapes_are_part_of_the_stamp),
        TEST(lifetimes_span_first_to_last_use),
        TEST(a_first_write_drops_former_content),
        TEST(readers_share_one_barrier),
        TEST(every_hazard_of_a_buffer_has_its_barrier),
        TEST(only_the_levels_concerned_are_moved),
        TEST(reads_of_one_pass_agree_on_a_layout),
        TEST(what_was_brought_in_goes_back_to_its_layout),
        TEST(retained_content_keeps_its_layout),
        TEST(shared_memory_is_waited_for),
    };
    return cmocka_run_group_tests_name("dependency_graph", tests, NULL, NULL);
}
