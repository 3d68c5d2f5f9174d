#include "passes/upload/deformation/device_deformation.h"

#include <stdio.h>

#include "shaders/interface/deformation.h"

#define ONE_PLACE(type, member)                                                                    \
    static_assert(offsetof(struct type, member) == offsetof(lobe_##type, member),                  \
                  "one " #type ", two descriptions")

static_assert(sizeof(struct joint_influence) == sizeof(lobe_joint_influence), "two descriptions");
static_assert(sizeof(struct morph_delta) == sizeof(lobe_morph_delta), "two descriptions");
ONE_PLACE(joint_influence, joint);
ONE_PLACE(joint_influence, weight);
ONE_PLACE(morph_delta, target);
ONE_PLACE(morph_delta, position);
ONE_PLACE(morph_delta, normal);
ONE_PLACE(morph_delta, tangent);

static void drop(stored_array *array) {
    lobe_buffer_destroy(&array->buffer);
    array->size = 0;
}

/// `size` of 0: nothing to store.
static lobe_result store(lobe_graph *graph, const char *what, const char *mesh, const void *data,
                         size_t size, stored_array *array) {
    if (array->buffer && array->size == size)
        return lobe_buffer_update(array->buffer, data);
    drop(array);
    if (size == 0)
        return LOBE_OK;
    char name[128];
    snprintf(name, sizeof name, "%s of %s", what, mesh);
    const lobe_result result = lobe_graph_create_buffer(
        graph, &(lobe_buffer_parameters){.name = name, .size = size, .data = data}, &array->buffer);
    array->size = result == LOBE_OK ? size : 0;
    return result;
}

lobe_result passes_device_deformation_upload(lobe_graph *graph, const lobe_mesh *mesh,
                                             device_deformation *deformation) {
    static const lobe_deformation none = {0};
    const lobe_deformation *from = mesh->deformation ? mesh->deformation : &none;
    const size_t influences = mesh->vertex_count * from->influences_per_vertex;
    // Deltas that no target moves need neither.
    const size_t deltas = from->target_count > 0 ? from->first_deltas[mesh->vertex_count] : 0;
    lobe_result result = store(graph, "influences", mesh->name, from->influences,
                               influences * sizeof *from->influences, &deformation->influences);
    if (result == LOBE_OK)
        result = store(graph, "first deltas", mesh->name, from->first_deltas,
                       deltas > 0 ? (mesh->vertex_count + 1) * sizeof *from->first_deltas : 0,
                       &deformation->first_deltas);
    if (result == LOBE_OK)
        result = store(graph, "deltas", mesh->name, from->deltas, deltas * sizeof *from->deltas,
                       &deformation->deltas);
    return result;
}

void passes_device_deformation_destroy(device_deformation *deformation) {
    drop(&deformation->influences);
    drop(&deformation->first_deltas);
    drop(&deformation->deltas);
}
