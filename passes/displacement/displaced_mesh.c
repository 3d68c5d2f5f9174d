#include "passes/displacement/displaced_mesh.h"

#include <stdio.h>
#include <string.h>

#include "passes/displacement/welded_mesh.h"
#include "passes/upload/device_mesh.h"
#include "shaders/interface/displacement/displacement.h"

/// Threads in a row of a dispatch: groups of 64, within every device's limits.
#define ROW (1u << 20)

// ---------------------------------------------------------------------------------------------
// The copy

static lobe_result store(lobe_graph *graph, const char *what, const char *mesh, const void *data,
                         size_t size, lobe_buffer **buffer) {
    char name[128];
    snprintf(name, sizeof name, "%s of %s", what, mesh);
    lobe_buffer_destroy(buffer);
    return lobe_graph_create_buffer(
        graph, &(lobe_buffer_parameters){.name = name, .size = size, .data = data}, buffer);
}

static lobe_result store_all(const device_scene *scene, const char *name, const welded_mesh *welded,
                             size_t corners, displaced_mesh *mesh) {
    const struct {
        const char *what;
        const void *data;
        size_t size;
        lobe_buffer **buffer;
    } arrays[] = {
        {"welded triangles", welded->triangles, welded->triangle_count * sizeof *welded->triangles,
         &mesh->triangles},
        {"welded edges", welded->edges, welded->edge_count * sizeof *welded->edges, &mesh->edges},
        {"welded charts", welded->charts, welded->chart_count * sizeof *welded->charts,
         &mesh->charts},
        {"welded points", welded->points, welded->point_count * sizeof *welded->points,
         &mesh->points},
        {"pairs of charts", welded->pairs, welded->pair_count * sizeof *welded->pairs,
         &mesh->pairs},
        {"corners of points", welded->corners, corners * sizeof *welded->corners, &mesh->corners},
    };
    lobe_result result = LOBE_OK;
    for (size_t i = 0; result == LOBE_OK && i < sizeof arrays / sizeof *arrays; i++)
        result = store(scene->graph, arrays[i].what, name, arrays[i].data, arrays[i].size,
                       arrays[i].buffer);
    return result;
}

lobe_result passes_displaced_mesh_update(const device_scene *scene, uint32_t index,
                                         displaced_mesh *mesh) {
    const lobe_mesh *source = &scene->scene->meshes[index];
    const uint32_t version = scene->measures[index].version;
    if (mesh->version == version)
        return LOBE_OK;
    welded_mesh welded;
    mesh->version = 0;
    if (!passes_welded_mesh_create(source, scene->allocator, &welded))
        return LOBE_ERROR_OUT_OF_MEMORY;
    const lobe_result result = store_all(scene, source->name, &welded, source->index_count, mesh);
    mesh->point_count = welded.point_count;
    mesh->chart_count = welded.chart_count;
    passes_welded_mesh_free(&welded);
    mesh->version = result == LOBE_OK ? version : 0;
    return result;
}

void passes_displaced_mesh_destroy(displaced_mesh *mesh) {
    lobe_buffer_destroy(&mesh->triangles);
    lobe_buffer_destroy(&mesh->edges);
    lobe_buffer_destroy(&mesh->charts);
    lobe_buffer_destroy(&mesh->points);
    lobe_buffer_destroy(&mesh->pairs);
    lobe_buffer_destroy(&mesh->corners);
    *mesh = (displaced_mesh){0};
}

// ---------------------------------------------------------------------------------------------
// Passes

static void read_mesh(const filter_context *context, uint32_t index, const displaced_mesh *mesh,
                      lobe_resource vertices, lobe_pass *pass) {
    lobe_graph *graph = context->graph;
    const lobe_binding bindings[] = {
        {.name = "base_point_block", .resource = lobe_graph_import_buffer(graph, mesh->points)},
        {.name = "chart_block", .resource = lobe_graph_import_buffer(graph, mesh->charts)},
        {.name = "corner_block", .resource = lobe_graph_import_buffer(graph, mesh->corners)},
        {.name = "index_block",
         .resource = lobe_graph_import_buffer(graph, context->scene->indices[index])},
        {.name = "vertex_block", .resource = vertices},
    };
    for (size_t i = 0; i < sizeof bindings / sizeof *bindings; i++)
        lobe_pass_read(pass, &bindings[i]);
}

static lobe_resource declare(lobe_graph *graph, const char *name, size_t size) {
    return lobe_graph_buffer(
        graph, &(lobe_buffer_description){.name = name, .size = size, .retained = true});
}

static void dispatch(lobe_pass *pass, const char *shader, struct pose_constants constants) {
    constants.row = constants.count < ROW ? constants.count : ROW;
    lobe_pass_dispatch(pass,
                       &(lobe_dispatch){.shader = shader,
                                        .threads = {constants.row, (constants.count - 1) / ROW + 1},
                                        .constants = &constants,
                                        .constants_size = sizeof constants});
}

/// Poses the points as `vertices` are.
static lobe_resource pose(const filter_context *context, uint32_t index, const displaced_mesh *mesh,
                          lobe_resource vertices, const char *what) {
    char name[64];
    snprintf(name, sizeof name, "%s of mesh %u", what, index);
    lobe_pass *pass = lobe_graph_add_pass(context->graph, LOBE_PASS_COMPUTE, "point_pose");
    read_mesh(context, index, mesh, vertices, pass);
    const lobe_resource posed = lobe_pass_write(
        pass, &(lobe_binding){.name = "point_block",
                              .resource = declare(context->graph, name,
                                                  mesh->point_count * sizeof(struct posed_point))});
    dispatch(pass, "displacement/point_pose.comp",
             (struct pose_constants){.count = mesh->point_count});
    return posed;
}

void passes_displaced_mesh_pose(const filter_context *context, uint32_t index,
                                displaced_mesh *mesh) {
    if (mesh->posed.version == 0)
        mesh->posed =
            pose(context, index, mesh,
                 passes_device_mesh_import(context->graph, context->scene, index), "posed points");
}

void passes_displaced_mesh_pose_before(const filter_context *context, uint32_t index,
                                       displaced_mesh *mesh) {
    if (mesh->posed_before.version == 0)
        mesh->posed_before =
            pose(context, index, mesh,
                 passes_device_mesh_import_previous(context->graph, context->scene, index),
                 "previous points");
}

lobe_resource passes_displaced_mesh_measure(const filter_context *context, uint32_t index,
                                            const displaced_mesh *mesh, const lobe_texture_use *use,
                                            size_t number) {
    char name[64];
    const lobe_image *map = &context->scene->scene->images[use->image].image;
    struct pose_constants constants = {.count = mesh->chart_count,
                                       .second_set = use->texture_coordinates,
                                       .width = (float)map->width,
                                       .height = (float)map->height};
    memcpy(constants.map_rows[0], use->transform[0], sizeof use->transform[0]);
    memcpy(constants.map_rows[1], use->transform[1], sizeof use->transform[1]);
    snprintf(name, sizeof name, "chart measures of instance %zu", number);
    lobe_pass *pass = lobe_graph_add_pass(context->graph, LOBE_PASS_COMPUTE, "chart_measures");
    read_mesh(context, index, mesh,
              passes_device_mesh_import(context->graph, context->scene, index), pass);
    const lobe_resource measures = lobe_pass_write(
        pass,
        &(lobe_binding){.name = "measure_block",
                        .resource = declare(context->graph, name,
                                            mesh->chart_count * sizeof(struct chart_measure))});
    dispatch(pass, "displacement/chart_measures.comp", constants);
    return measures;
}
