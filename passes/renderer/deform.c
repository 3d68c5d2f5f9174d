#include "passes/renderer/deform.h"

#include <stdio.h>

#include "passes/upload/device_mesh.h"
#include "shaders/interface/deformation.h"

/// Threads in a row of a dispatch: groups of 64, within every device's limits.
#define ROW (1u << 20)

/// Whether the pose differs from the base mesh.
static bool is_posed(const lobe_mesh *mesh) {
    const lobe_deformation *deformation = mesh->deformation;
    bool posed = deformation && deformation->joint_count > 0;
    for (size_t i = 0; deformation && !posed && i < deformation->target_count; i++)
        posed = deformation->weights[i] != 0;
    return posed;
}

/// What the shader does not read must be bound nevertheless.
static lobe_resource import(lobe_graph *graph, const stored_array *array) {
    static const float none[16] = {0};
    return array->buffer ? lobe_graph_import_buffer(graph, array->buffer)
                         : lobe_graph_upload(graph, "no deformation", none, sizeof none);
}

static lobe_resource upload(lobe_graph *graph, const char *name, const void *data, size_t size) {
    static const float none[16] = {0};
    return size > 0 ? lobe_graph_upload(graph, name, data, size)
                    : lobe_graph_upload(graph, "no pose", none, sizeof none);
}

static void read(lobe_pass *pass, const char *name, lobe_resource resource) {
    lobe_pass_read(pass, &(lobe_binding){.name = name, .resource = resource});
}

static lobe_resource declare(lobe_graph *graph, const lobe_mesh *mesh, uint32_t index) {
    char name[64];
    snprintf(name, sizeof name, "deformed vertices %u", index);
    return lobe_graph_buffer(
        graph, &(lobe_buffer_description){.name = name,
                                          .size = mesh->vertex_count * sizeof *mesh->vertices,
                                          .retained = true});
}

static void dispatch(lobe_pass *pass, const lobe_mesh *mesh, const device_deformation *stored) {
    const uint32_t count = (uint32_t)mesh->vertex_count;
    const struct deform_constants constants = {
        .vertex_count = count,
        .influences = mesh->deformation->influences_per_vertex,
        .targets = stored->deltas.buffer != NULL,
        .faceted = mesh->deformation->flat,
        .row = count < ROW ? count : ROW,
    };
    lobe_pass_dispatch(pass, &(lobe_dispatch){.shader = "deformation/deform.comp",
                                              .threads = {constants.row, (count - 1) / ROW + 1},
                                              .constants = &constants,
                                              .constants_size = sizeof constants});
}

static lobe_resource deform(const filter_context *context, uint32_t index) {
    lobe_graph *graph = context->graph;
    const device_scene *scene = context->scene;
    const lobe_mesh *mesh = &scene->scene->meshes[index];
    const lobe_deformation *deformation = mesh->deformation;
    const device_deformation *stored = &scene->deformations[index];
    lobe_pass *pass = lobe_graph_add_pass(graph, LOBE_PASS_COMPUTE, "deform");
    read(pass, "base_block", passes_device_mesh_import_base(graph, scene, index));
    read(pass, "influence_block", import(graph, &stored->influences));
    read(pass, "joint_block",
         upload(graph, "joint matrices", deformation->joint_matrices,
                deformation->joint_count * sizeof *deformation->joint_matrices));
    read(pass, "first_delta_block", import(graph, &stored->first_deltas));
    read(pass, "delta_block", import(graph, &stored->deltas));
    read(pass, "weight_block",
         upload(graph, "morph weights", deformation->weights,
                deformation->target_count * sizeof *deformation->weights));
    const lobe_resource deformed = lobe_pass_write(
        pass, &(lobe_binding){.name = "deformed_block", .resource = declare(graph, mesh, index)});
    dispatch(pass, mesh, stored);
    return deformed;
}

void passes_deform(const filter_context *context) {
    const device_scene *scene = context->scene;
    for (uint32_t i = 0; i < scene->scene->mesh_count; i++) {
        const bool drawn = scene->indices[i] != NULL;
        scene->deformed[i] =
            drawn && is_posed(&scene->scene->meshes[i]) ? deform(context, i) : (lobe_resource){0};
    }
}
