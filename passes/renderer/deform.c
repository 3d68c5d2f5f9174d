#include "passes/renderer/deform.h"

#include <stdio.h>

#include "passes/upload/device_mesh.h"
#include "shaders/interface/deformation.h"

/// Threads in a row of a dispatch: groups of 64, within every device's limits.
#define ROW (1u << 20)

/// A mesh in a pose, and the vertices before that.
typedef struct posed_mesh {
    const lobe_mesh *mesh;
    const lobe_deformation *pose;
    const device_deformation *stored;
    lobe_resource base;
} posed_mesh;

/// Whether the pose differs from the base mesh.
static bool is_posed(const lobe_deformation *deformation) {
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

static lobe_resource declare(lobe_graph *graph, const lobe_mesh *mesh, const char *what,
                             uint32_t index, bool retained) {
    char name[64];
    snprintf(name, sizeof name, "%s %u", what, index);
    return lobe_graph_buffer(
        graph, &(lobe_buffer_description){.name = name,
                                          .size = mesh->vertex_count * sizeof *mesh->vertices,
                                          .retained = retained});
}

static void dispatch(lobe_pass *pass, const posed_mesh *posed) {
    const uint32_t count = (uint32_t)posed->mesh->vertex_count;
    const struct deform_constants constants = {
        .vertex_count = count,
        .influences = posed->pose->influences_per_vertex,
        .targets = posed->stored->deltas.buffer != NULL,
        .faceted = posed->pose->flat,
        .row = count < ROW ? count : ROW,
    };
    lobe_pass_dispatch(pass, &(lobe_dispatch){.shader = "deformation/deform.comp",
                                              .threads = {constants.row, (count - 1) / ROW + 1},
                                              .constants = &constants,
                                              .constants_size = sizeof constants});
}

static lobe_resource deform(lobe_graph *graph, const posed_mesh *posed, lobe_resource target) {
    const lobe_deformation *pose = posed->pose;
    const device_deformation *stored = posed->stored;
    lobe_pass *pass = lobe_graph_add_pass(graph, LOBE_PASS_COMPUTE, "deform");
    read(pass, "base_block", posed->base);
    read(pass, "influence_block", import(graph, &stored->influences));
    read(pass, "joint_block",
         upload(graph, "joint matrices", pose->joint_matrices,
                pose->joint_count * sizeof *pose->joint_matrices));
    read(pass, "first_delta_block", import(graph, &stored->first_deltas));
    read(pass, "delta_block", import(graph, &stored->deltas));
    read(pass, "weight_block",
         upload(graph, "morph weights", pose->weights, pose->target_count * sizeof *pose->weights));
    const lobe_resource deformed =
        lobe_pass_write(pass, &(lobe_binding){.name = "deformed_block", .resource = target});
    dispatch(pass, posed);
    return deformed;
}

static posed_mesh mesh_of(const filter_context *context, uint32_t index) {
    const device_scene *scene = context->scene;
    const lobe_mesh *mesh = &scene->scene->meshes[index];
    return (posed_mesh){mesh, mesh->deformation, &scene->deformations[index],
                        passes_device_mesh_import_base(context->graph, scene, index)};
}

void passes_deform(const filter_context *context) {
    const device_scene *scene = context->scene;
    for (uint32_t i = 0; i < scene->scene->mesh_count; i++) {
        const lobe_mesh *mesh = &scene->scene->meshes[i];
        scene->deformed[i] = (lobe_resource){0};
        if (!scene->indices[i] || !is_posed(mesh->deformation))
            continue;
        const posed_mesh posed = mesh_of(context, i);
        scene->deformed[i] = deform(context->graph, &posed,
                                    declare(context->graph, mesh, "deformed vertices", i, true));
    }
}

static void deform_previous(const filter_context *context, const lobe_deformation *pose,
                            uint32_t index) {
    lobe_resource *previous = &context->scene->previous_vertices[index];
    posed_mesh posed = mesh_of(context, index);
    posed.pose = pose;
    if (previous->version > 0)
        posed.base = *previous;
    *previous = is_posed(pose)
                    ? deform(context->graph, &posed,
                             declare(context->graph, posed.mesh, "previous vertices", index, false))
                    : posed.base;
}

void passes_deform_previous(const filter_context *context, const pose_history *history) {
    const device_scene *scene = context->scene;
    lobe_deformation pose;
    for (uint32_t i = 0; i < scene->scene->mesh_count; i++) {
        const lobe_deformation *now = scene->scene->meshes[i].deformation;
        const bool moved = passes_pose_history_find(history, scene->scene, i, &pose);
        if (scene->indices[i] && now && (moved || scene->previous_vertices[i].version > 0))
            deform_previous(context, moved ? &pose : now, i);
    }
}
