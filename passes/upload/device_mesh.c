#include "passes/upload/device_mesh.h"

#include <math.h>
#include <stdio.h>

#include "passes/upload/device_scene_parts.h"
#include "shaders/interface/vertex.h"

#define ONE_PLACE(member)                                                                          \
    static_assert(offsetof(struct vertex, member) == offsetof(lobe_scene_vertex, member),          \
                  "one vertex, two descriptions")

static_assert(sizeof(struct vertex) == sizeof(lobe_scene_vertex), "one vertex, two descriptions");
ONE_PLACE(position);
ONE_PLACE(normal);
ONE_PLACE(tangent);
ONE_PLACE(texture_coordinates);
ONE_PLACE(colour);

static double triangle_area(const lobe_scene_vertex *corners[3]) {
    double a[3], b[3];
    for (int i = 0; i < 3; i++) {
        a[i] = (double)corners[1]->position[i] - corners[0]->position[i];
        b[i] = (double)corners[2]->position[i] - corners[0]->position[i];
    }
    double x = a[1] * b[2] - a[2] * b[1], y = a[2] * b[0] - a[0] * b[2],
           z = a[0] * b[1] - a[1] * b[0];
    return 0.5 * sqrt(x * x + y * y + z * z);
}

static double coordinates_area(const lobe_scene_vertex *corners[3], int set) {
    const float *a = corners[0]->texture_coordinates[set];
    const float *b = corners[1]->texture_coordinates[set];
    const float *c = corners[2]->texture_coordinates[set];
    return 0.5 * fabs(((double)b[0] - a[0]) * ((double)c[1] - a[1]) -
                      ((double)b[1] - a[1]) * ((double)c[0] - a[0]));
}

static void measure_alpha(const lobe_mesh *mesh, mesh_measures *measures) {
    for (size_t i = 0; i < mesh->vertex_count; i++) {
        float alpha = mesh->vertices[i].colour[3];
        measures->least_alpha = fminf(measures->least_alpha, alpha);
        measures->largest_alpha = fmaxf(measures->largest_alpha, alpha);
    }
}

/// Vertices that the host gives on the device may be anywhere.
static void measure_coordinates(const lobe_mesh *mesh, mesh_measures *measures) {
    for (int i = 0; i < 4; i++) {
        measures->coordinates[i / 2][0][i % 2] = mesh->on_device ? -INFINITY : INFINITY;
        measures->coordinates[i / 2][1][i % 2] = mesh->on_device ? INFINITY : -INFINITY;
    }
    for (size_t i = 0; !mesh->on_device && i < 4 * mesh->vertex_count; i++) {
        const size_t set = i % 4 / 2, axis = i % 2;
        const float value = mesh->vertices[i / 4].texture_coordinates[set][axis];
        float(*bounds)[2] = measures->coordinates[set];
        bounds[0][axis] = fminf(bounds[0][axis], value);
        bounds[1][axis] = fmaxf(bounds[1][axis], value);
    }
}

static void measure_bounds(const lobe_mesh *mesh, mesh_measures *measures) {
    for (int axis = 0; axis < 3; axis++) {
        measures->minimum[axis] = INFINITY;
        measures->maximum[axis] = -INFINITY;
    }
    for (size_t i = 0; i < mesh->vertex_count; i++) {
        for (int axis = 0; axis < 3; axis++) {
            const float position = mesh->vertices[i].position[axis];
            measures->minimum[axis] = fminf(measures->minimum[axis], position);
            measures->maximum[axis] = fmaxf(measures->maximum[axis], position);
        }
    }
}

static void measure_density(const lobe_mesh *mesh, mesh_measures *measures) {
    for (size_t i = 0; i + 2 < mesh->index_count; i += 3) {
        const lobe_scene_vertex *corners[3];
        for (size_t corner = 0; corner < 3; corner++)
            corners[corner] = &mesh->vertices[mesh->indices[i + corner]];
        double area = triangle_area(corners);
        for (int set = 0; area > 0 && set < 2; set++)
            measures->least_density[set] = fminf(
                measures->least_density[set], (float)sqrt(coordinates_area(corners, set) / area));
    }
}

/// Vertices that the host gives on the device may differ in each frame.
static bool has_equal_sets(const lobe_mesh *mesh) {
    bool equal =
        mesh->has_texture_coordinates[0] && mesh->has_texture_coordinates[1] && !mesh->on_device;
    for (size_t i = 0; equal && i < mesh->vertex_count; i++) {
        const float(*sets)[2] = mesh->vertices[i].texture_coordinates;
        equal = sets[0][0] == sets[1][0] && sets[0][1] == sets[1][1];
    }
    return equal;
}

static mesh_measures measure(const lobe_mesh *mesh, uint32_t version) {
    mesh_measures measures = {.least_density = {INFINITY, INFINITY},
                              .equal_sets = has_equal_sets(mesh),
                              .least_alpha = INFINITY,
                              .largest_alpha = -INFINITY,
                              .vertex_count = mesh->vertex_count,
                              .index_count = mesh->index_count,
                              .version = version};
    measure_density(mesh, &measures);
    measure_alpha(mesh, &measures);
    measure_bounds(mesh, &measures);
    measure_coordinates(mesh, &measures);
    return measures;
}

/// `kept`: the buffer, if there is one, has the right size.
static lobe_result store(lobe_graph *graph, const char *name, size_t size, const void *data,
                         bool kept, lobe_buffer **buffer) {
    if (*buffer && kept)
        return lobe_buffer_update(*buffer, data);
    lobe_buffer_destroy(buffer);
    return lobe_graph_create_buffer(
        graph, &(lobe_buffer_parameters){.name = name, .size = size, .data = data}, buffer);
}

static lobe_result store_vertices(device_scene *scene, uint32_t index) {
    const lobe_mesh *mesh = &scene->scene->meshes[index];
    if (mesh->on_device) {
        lobe_buffer_destroy(&scene->vertices[index]);
        return LOBE_OK;
    }
    return store(scene->graph, mesh->name, mesh->vertex_count * sizeof *mesh->vertices,
                 mesh->vertices, mesh->vertex_count == scene->measures[index].vertex_count,
                 &scene->vertices[index]);
}

lobe_result passes_device_scene_upload_mesh(device_scene *scene, uint32_t index) {
    const lobe_mesh *mesh = &scene->scene->meshes[index];
    const mesh_measures before = scene->measures[index];
    char name[128];
    snprintf(name, sizeof name, "indices of %s", mesh->name);
    lobe_result status = store_vertices(scene, index);
    if (status == LOBE_OK)
        status = passes_device_deformation_upload(scene->graph, mesh, &scene->deformations[index]);
    if (status != LOBE_OK)
        return status;
    scene->measures[index] = measure(mesh, before.version + 1);
    return store(scene->graph, name, mesh->index_count * sizeof *mesh->indices, mesh->indices,
                 mesh->index_count == before.index_count, &scene->indices[index]);
}

lobe_resource passes_device_mesh_import(lobe_graph *graph, const device_scene *scene,
                                        uint32_t mesh) {
    const lobe_resource deformed = scene->deformed[mesh];
    return deformed.version > 0 ? deformed : passes_device_mesh_import_base(graph, scene, mesh);
}

lobe_resource passes_device_mesh_import_base(lobe_graph *graph, const device_scene *scene,
                                             uint32_t mesh) {
    if (scene->scene->meshes[mesh].on_device)
        return scene->given_vertices[mesh];
    return lobe_graph_import_buffer(graph, scene->vertices[mesh]);
}

lobe_resource passes_device_mesh_import_previous(lobe_graph *graph, const device_scene *scene,
                                                 uint32_t mesh) {
    if (scene->previous_vertices[mesh].version > 0)
        return scene->previous_vertices[mesh];
    return passes_device_mesh_import(graph, scene, mesh);
}
