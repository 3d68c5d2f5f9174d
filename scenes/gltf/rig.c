#include <math.h>
#include <string.h>

#include "scenes/animation/posed_bounds.h"
#include "scenes/animation/rig.h"
#include "scenes/gltf/gltf.h"
#include "scenes/gltf/pointer/animation_pointer.h"
#include "scenes/mesh/vector.h"

static lobe_result out_of_memory(const gltf_import *import) {
    return lobe_host_fail(import->host, LOBE_ERROR_OUT_OF_MEMORY, "%s: out of memory",
                          import->path);
}

// ---------------------------------------------------------------------------------------------
// Nodes

static bool needs_rig(const gltf_document *document) {
    bool skins = false;
    for (size_t i = 0; i < document->node_count; i++)
        skins = skins || (document->nodes[i].skin >= 0 && document->nodes[i].mesh >= 0);
    return skins || document->animation_count > 0;
}

static lobe_result allocate(gltf_import *import) {
    const lobe_allocator *allocator = lobe_host_allocator(import->host);
    const size_t nodes = import->document->node_count + 1;
    const size_t skins = import->document->skin_count + 1;
    lobe_rig *rig = import->scene->rig = lobe_allocate(allocator, 1, sizeof *rig);
    if (!rig)
        return out_of_memory(import);
    rig->camera_node = -1;
    rig->nodes = lobe_allocate(allocator, nodes, sizeof *rig->nodes);
    rig->skins = lobe_allocate(allocator, skins, sizeof *rig->skins);
    import->motions = lobe_allocate(allocator, nodes, sizeof *import->motions);
    import->rig_nodes = lobe_allocate(allocator, nodes, sizeof *import->rig_nodes);
    import->skins = lobe_allocate(allocator, skins, sizeof *import->skins);
    for (size_t i = 0; import->skins && i < skins; i++)
        import->skins[i] = GLTF_NOT_CONVERTED;
    return rig->nodes && rig->skins && import->motions && import->rig_nodes && import->skins
               ? LOBE_OK
               : out_of_memory(import);
}

static void store(const double *from, size_t count, float *to) {
    for (size_t i = 0; i < count; i++)
        to[i] = (float)from[i];
}

static lobe_result convert_weights(const gltf_import *import, int index, lobe_node *node) {
    const int mesh = import->document->nodes[index].mesh;
    if (mesh < 0 || (size_t)mesh >= import->document->mesh_count)
        return LOBE_OK;
    lobe_result result = scenes_gltf_count_targets(import, (size_t)mesh, &node->weight_count);
    if (result != LOBE_OK || node->weight_count == 0)
        return result;
    node->weights =
        lobe_allocate(lobe_host_allocator(import->host), node->weight_count, sizeof *node->weights);
    if (!node->weights)
        return out_of_memory(import);
    return scenes_gltf_read_weights(import, (size_t)mesh, index, node->weight_count, node->weights);
}

static lobe_result convert_node(const gltf_import *import, int index, int parent, lobe_node *node) {
    const gltf_node *from = &import->document->nodes[index];
    node->name = lobe_copy_text(lobe_host_allocator(import->host), from->name);
    if (!node->name)
        return out_of_memory(import);
    node->parent = parent >= 0 ? (int32_t)import->rig_nodes[parent] : -1;
    node->has_matrix = from->has_matrix;
    store(from->matrix, 16, node->matrix);
    store(from->translation, 3, node->translation);
    store(from->rotation, 4, node->rotation);
    store(from->scale, 3, node->scale);
    double local[16];
    lobe_result result = scenes_gltf_local_transform(import, index, local);
    return result == LOBE_OK ? convert_weights(import, index, node) : result;
}

/// What moves a node moves those below it.
static void spread_motion(gltf_import *import, const int *order, const int *parents) {
    for (size_t i = 0; i < import->document->node_count; i++)
        if (parents[order[i]] >= 0 && import->motions[parents[order[i]]].moves)
            import->motions[order[i]].moves = true;
}

lobe_result scenes_gltf_begin_rig(gltf_import *import, const int *order, const int *parents) {
    if (!needs_rig(import->document))
        return LOBE_OK;
    lobe_result result = allocate(import);
    for (size_t i = 0; result == LOBE_OK && i < import->document->node_count; i++) {
        lobe_rig *rig = import->scene->rig;
        import->rig_nodes[order[i]] = (uint32_t)i;
        result = convert_node(import, order[i], parents[order[i]], &rig->nodes[rig->node_count++]);
    }
    if (result == LOBE_OK)
        result = scenes_gltf_begin_numbers(import);
    if (result == LOBE_OK)
        result = scenes_gltf_convert_animations(import);
    if (result == LOBE_OK)
        spread_motion(import, order, parents);
    return result;
}

// ---------------------------------------------------------------------------------------------
// What follows them

/// Makes room for one more in an array whose capacity is the power of two not below its count.
static bool grow(const gltf_import *import, void **array, size_t count, size_t size) {
    if ((count & (count - 1)) != 0)
        return true;
    void *larger =
        lobe_reallocate(lobe_host_allocator(import->host), *array, count ? 2 * count : 1, size);
    if (!larger)
        return false;
    *array = larger;
    return true;
}

static lobe_result add_instance(gltf_import *import, int32_t node, int32_t skinned_mesh,
                                bool reflected, bool flat) {
    lobe_rig *rig = import->scene->rig;
    if (!grow(import, (void **)&rig->instances, rig->instance_count, sizeof *rig->instances))
        return out_of_memory(import);
    rig->instances[rig->instance_count++] =
        (lobe_posed_instance){.instance = (uint32_t)import->scene->instance_count - 1,
                              .node = node,
                              .skinned_mesh = skinned_mesh,
                              .reflected = reflected,
                              .flat = flat};
    return LOBE_OK;
}

lobe_result scenes_gltf_pose_instance(gltf_import *import, int node, bool reflected, bool flat) {
    return add_instance(import, (int32_t)import->rig_nodes[node], -1, reflected, flat);
}

lobe_result scenes_gltf_pose_skinned(gltf_import *import, int32_t posed_mesh) {
    return add_instance(import, -1, posed_mesh, false, false);
}

lobe_result scenes_gltf_pose_mesh(gltf_import *import, uint32_t mesh, int32_t skin,
                                  int64_t weight_node, int32_t *posed_mesh) {
    lobe_rig *rig = import->scene->rig;
    if (!grow(import, (void **)&rig->meshes, rig->mesh_count, sizeof *rig->meshes))
        return out_of_memory(import);
    lobe_posed_mesh *posed = &rig->meshes[rig->mesh_count];
    *posed =
        (lobe_posed_mesh){.mesh = mesh,
                          .skin = skin,
                          .node = weight_node >= 0 ? (int32_t)import->rig_nodes[weight_node] : -1};
    *posed_mesh = (int32_t)rig->mesh_count++;
    return scenes_posed_bounds_measure(&import->scene->meshes[mesh], posed, import->host);
}

lobe_result scenes_gltf_pose_light(gltf_import *import, int node, int light) {
    lobe_rig *rig = import->scene->rig;
    if (!grow(import, (void **)&rig->lights, rig->light_count, sizeof *rig->lights))
        return out_of_memory(import);
    rig->lights[rig->light_count++] = (lobe_posed_light){
        .light = (uint32_t)import->scene->light_count - 1,
        .node = import->motions[node].moves ? (int32_t)import->rig_nodes[node] : -1,
        .numbers = rig->light_number_count > 0 ? light : -1};
    return LOBE_OK;
}

// ---------------------------------------------------------------------------------------------
// The end

lobe_result scenes_gltf_end_rig(gltf_import *import) {
    lobe_scene *scene = import->scene;
    scenes_gltf_end_numbers(import);
    if (scene->rig && scene->rig->animation_count == 0 && scene->rig->mesh_count == 0)
        scenes_rig_free(&scene->rig);
    return lobe_scene_set_pose(scene, &(lobe_pose){.animation = LOBE_ANIMATION_NONE}, import->host);
}

void scenes_gltf_measure_camera(lobe_scene *scene) {
    if (scene->rig)
        scene->rig->camera_distance = vector3_length(
            vector3_subtract(vector3_load(scene->camera.target), vector3_load(scene->camera.eye)));
}
