#include "passes/displacement/welded_mesh.h"

#include <string.h>

/// Of a point no more corners count towards its direction, so that a shader's loop has an end.
enum { MOST_CORNERS = 16384 };

// ---------------------------------------------------------------------------------------------
// Hashing

/// Open addressing; a slot holds an index plus one, 0: none.
typedef struct index_table {
    uint32_t *slots;
    size_t size; ///< a power of two
} index_table;

static bool create_table(const lobe_allocator *allocator, size_t count, index_table *table) {
    table->size = 1;
    while (table->size < 2 * count)
        table->size *= 2;
    table->slots = lobe_allocate(allocator, table->size, sizeof *table->slots);
    return table->slots != NULL;
}

/// Steele, Lea, Flood 2014, "Fast Splittable Pseudorandom Number Generators": a round of its mixing
/// function.
static uint64_t mix(uint64_t hash, uint32_t word) {
    hash = (hash ^ word) * 0xbf58476d1ce4e5b9u;
    return hash ^ hash >> 27;
}

static uint64_t mix_numbers(uint64_t hash, const float *numbers, size_t count) {
    for (size_t i = 0; i < count; i++) {
        const float number = numbers[i] + 0.0f; // -0 equals 0, and must have its bits
        uint32_t bits;
        memcpy(&bits, &number, sizeof bits);
        hash = mix(hash, bits);
    }
    return hash;
}

static bool are_equal(const float *a, const float *b, size_t count) {
    for (size_t i = 0; i < count; i++)
        if (a[i] != b[i])
            return false;
    return true;
}

// ---------------------------------------------------------------------------------------------
// Points and charts

static bool move_alike(const lobe_deformation *deformation, size_t a, size_t b) {
    if (!deformation)
        return true;
    const size_t influences = deformation->influences_per_vertex;
    if (influences > 0 &&
        memcmp(deformation->influences + a * influences, deformation->influences + b * influences,
               influences * sizeof *deformation->influences) != 0)
        return false;
    if (deformation->target_count == 0)
        return true;
    const uint32_t *first = deformation->first_deltas;
    const size_t count = first[a + 1] - first[a];
    if (first[b + 1] - first[b] != count)
        return false;
    for (size_t i = 0; i < count; i++) {
        const lobe_morph_delta *of_a = &deformation->deltas[first[a] + i],
                               *of_b = &deformation->deltas[first[b] + i];
        if (of_a->target != of_b->target || !are_equal(of_a->position, of_b->position, 3))
            return false;
    }
    return true;
}

static bool are_one_point(const lobe_mesh *mesh, size_t a, size_t b) {
    return are_equal(mesh->vertices[a].position, mesh->vertices[b].position, 3) &&
           move_alike(mesh->deformation, a, b);
}

static bool are_one_chart(const lobe_mesh *mesh, size_t a, size_t b) {
    return are_one_point(mesh, a, b) && are_equal(mesh->vertices[a].texture_coordinates[0],
                                                  mesh->vertices[b].texture_coordinates[0], 4);
}

typedef bool (*sameness)(const lobe_mesh *mesh, size_t a, size_t b);

/// Of vertices that no triangle has.
#define UNUSED UINT32_MAX

/// `first[i]`: the first vertex that is the same as vertex i.
static bool find_first(const lobe_mesh *mesh, sameness same, const lobe_allocator *allocator,
                       uint32_t *first) {
    index_table table;
    if (!create_table(allocator, mesh->vertex_count, &table))
        return false;
    memset(first, 0xff, mesh->vertex_count * sizeof *first);
    for (size_t i = 0; i < mesh->index_count; i++)
        first[mesh->indices[i]] = 0;
    for (size_t i = 0; i < mesh->vertex_count; i++) {
        if (first[i] == UNUSED)
            continue;
        uint64_t hash = mix_numbers(0, mesh->vertices[i].position, 3);
        if (same == are_one_chart)
            hash = mix_numbers(hash, mesh->vertices[i].texture_coordinates[0], 4);
        size_t slot = (size_t)hash & (table.size - 1);
        while (table.slots[slot] != 0 && !same(mesh, table.slots[slot] - 1, i))
            slot = (slot + 1) & (table.size - 1);
        if (table.slots[slot] == 0)
            table.slots[slot] = (uint32_t)i + 1;
        first[i] = table.slots[slot] - 1;
    }
    lobe_release(table.slots);
    return true;
}

/// What is known while the arrays are filled.
typedef struct welding {
    const lobe_mesh *mesh;
    const lobe_allocator *allocator;
    uint32_t *point_of; ///< of each vertex; at first the first vertex that is the same
    uint32_t *chart_of;
    welded_mesh *welded;
} welding;

/// Numbers points in the order of their first vertices.
static void number_points(welding *w) {
    uint32_t count = 0;
    for (size_t i = 0; i < w->mesh->vertex_count; i++)
        if (w->point_of[i] != UNUSED)
            w->point_of[i] = w->point_of[i] == i ? count++ : w->point_of[w->point_of[i]];
    w->welded->point_count = count;
}

static void place_charts(welding *w) {
    struct base_point *points = w->welded->points;
    uint32_t next = 0;
    for (size_t i = 0; i < w->mesh->vertex_count; i++)
        if (w->chart_of[i] == i)
            ++points[w->point_of[i]].chart_count;
    for (uint32_t i = 0; i < w->welded->point_count; i++) {
        points[i].first_chart = next;
        next += points[i].chart_count;
        points[i].chart_count = 0;
    }
    w->welded->chart_count = next;
}

/// Numbers charts point by point.
static void number_charts(welding *w) {
    for (size_t i = 0; i < w->mesh->vertex_count; i++) {
        if (w->chart_of[i] == UNUSED)
            continue;
        if (w->chart_of[i] != i) {
            w->chart_of[i] = w->chart_of[w->chart_of[i]];
            continue;
        }
        struct base_point *point = &w->welded->points[w->point_of[i]];
        w->chart_of[i] = point->first_chart + point->chart_count++;
        w->welded->charts[w->chart_of[i]] =
            (struct base_chart){.point = w->point_of[i], .vertex = (uint32_t)i};
    }
    for (uint32_t i = 0; i < w->welded->point_count; i++)
        if (w->welded->points[i].chart_count > WELDED_MOST_CHARTS)
            w->welded->points[i].chart_count = WELDED_MOST_CHARTS;
}

static void list_corners(welding *w) {
    struct base_point *points = w->welded->points;
    const lobe_mesh *mesh = w->mesh;
    uint32_t next = 0;
    for (size_t i = 0; i < mesh->index_count; i++)
        ++points[w->point_of[mesh->indices[i]]].corner_count;
    for (uint32_t i = 0; i < w->welded->point_count; i++) {
        points[i].first_corner = next;
        next += points[i].corner_count;
        points[i].corner_count = 0;
    }
    for (size_t i = 0; i < mesh->index_count; i++) {
        struct base_point *point = &points[w->point_of[mesh->indices[i]]];
        w->welded->corners[point->first_corner + point->corner_count++] = (uint32_t)i;
    }
    for (uint32_t i = 0; i < w->welded->point_count; i++)
        if (points[i].corner_count > MOST_CORNERS)
            points[i].corner_count = MOST_CORNERS;
}

static bool weld_points(welding *w) {
    welded_mesh *welded = w->welded;
    const size_t vertices = w->mesh->vertex_count;
    if (!find_first(w->mesh, are_one_point, w->allocator, w->point_of) ||
        !find_first(w->mesh, are_one_chart, w->allocator, w->chart_of))
        return false;
    number_points(w);
    welded->points = lobe_allocate(w->allocator, welded->point_count, sizeof *welded->points);
    welded->charts = lobe_allocate(w->allocator, vertices, sizeof *welded->charts);
    welded->corners = lobe_allocate(w->allocator, w->mesh->index_count, sizeof *welded->corners);
    if (!welded->points || !welded->charts || !welded->corners)
        return false;
    place_charts(w);
    number_charts(w);
    list_corners(w);
    return true;
}

// ---------------------------------------------------------------------------------------------
// Edges

/// The charts at both ends of a corner's edge; `swapped`: its end is the edge's first.
static void charts_of_edge(const welding *w, size_t corner, uint32_t charts[2], bool *swapped) {
    const size_t next = corner % 3 == 2 ? corner - 2 : corner + 1;
    charts[0] = w->chart_of[w->mesh->indices[corner]];
    charts[1] = w->chart_of[w->mesh->indices[next]];
    *swapped = w->welded->charts[charts[0]].point > w->welded->charts[charts[1]].point;
    if (*swapped) {
        const uint32_t first = charts[0];
        charts[0] = charts[1];
        charts[1] = first;
    }
}

static void number_edges(const welding *w, const index_table *table) {
    welded_mesh *welded = w->welded;
    for (size_t i = 0; i < w->mesh->index_count; i++) {
        uint32_t charts[2];
        bool swapped;
        charts_of_edge(w, i, charts, &swapped);
        const uint32_t ends[2] = {welded->charts[charts[0]].point, welded->charts[charts[1]].point};
        size_t slot = (size_t)mix(mix(0, ends[0]), ends[1]) & (table->size - 1);
        while (table->slots[slot] != 0 &&
               memcmp(welded->edges[table->slots[slot] - 1].points, ends, sizeof ends) != 0)
            slot = (slot + 1) & (table->size - 1);
        if (table->slots[slot] == 0) {
            memcpy(welded->edges[welded->edge_count].points, ends, sizeof ends);
            table->slots[slot] = ++welded->edge_count;
        }
        const uint32_t edge = table->slots[slot] - 1;
        welded->triangles[i / 3].charts[i % 3] = w->chart_of[w->mesh->indices[i]];
        welded->triangles[i / 3].edges[i % 3] = edge;
        ++welded->edges[edge].pair_count;
    }
}

static bool has_pair(const welded_mesh *welded, const struct base_edge *edge,
                     const uint32_t charts[2]) {
    for (uint32_t i = 0; i < edge->pair_count; i++)
        if (memcmp(welded->pairs[edge->first_pair + i], charts, sizeof *welded->pairs) == 0)
            return true;
    return false;
}

static void list_pairs(const welding *w) {
    welded_mesh *welded = w->welded;
    for (uint32_t i = 0; i < welded->edge_count; i++) {
        welded->edges[i].first_pair = welded->pair_count;
        welded->pair_count += welded->edges[i].pair_count;
        welded->edges[i].pair_count = 0;
    }
    for (size_t i = 0; i < w->mesh->index_count; i++) {
        struct base_edge *edge = &welded->edges[welded->triangles[i / 3].edges[i % 3]];
        uint32_t charts[2];
        bool swapped;
        charts_of_edge(w, i, charts, &swapped);
        if (edge->pair_count < WELDED_MOST_CHARTS && !has_pair(welded, edge, charts))
            memcpy(welded->pairs[edge->first_pair + edge->pair_count++], charts,
                   sizeof *welded->pairs);
    }
}

static bool weld_edges(const welding *w) {
    welded_mesh *welded = w->welded;
    const size_t corners = w->mesh->index_count;
    index_table table;
    welded->triangles = lobe_allocate(w->allocator, corners / 3, sizeof *welded->triangles);
    welded->edges = lobe_allocate(w->allocator, corners, sizeof *welded->edges);
    welded->pairs = lobe_allocate(w->allocator, corners, sizeof *welded->pairs);
    if (!welded->triangles || !welded->edges || !welded->pairs ||
        !create_table(w->allocator, corners, &table))
        return false;
    number_edges(w, &table);
    lobe_release(table.slots);
    list_pairs(w);
    return true;
}

// ---------------------------------------------------------------------------------------------

bool passes_welded_mesh_create(const lobe_mesh *mesh, const lobe_allocator *allocator,
                               welded_mesh *welded) {
    *welded = (welded_mesh){.triangle_count = (uint32_t)(mesh->index_count / 3)};
    welding w = {
        .mesh = mesh,
        .allocator = allocator,
        .point_of = lobe_allocate(allocator, mesh->vertex_count, sizeof *w.point_of),
        .chart_of = lobe_allocate(allocator, mesh->vertex_count, sizeof *w.chart_of),
        .welded = welded,
    };
    const bool done = w.point_of && w.chart_of && weld_points(&w) && weld_edges(&w);
    lobe_release(w.point_of);
    lobe_release(w.chart_of);
    if (!done)
        passes_welded_mesh_free(welded);
    return done;
}

void passes_welded_mesh_free(welded_mesh *welded) {
    lobe_release(welded->triangles);
    lobe_release(welded->edges);
    lobe_release(welded->charts);
    lobe_release(welded->points);
    lobe_release(welded->pairs);
    lobe_release(welded->corners);
    *welded = (welded_mesh){0};
}
