#include <string.h>

#include "scenes/animation/transform.h"
#include "scenes/gltf/gltf.h"
#include "scenes/scene/scene.h"

// ---------------------------------------------------------------------------------------------
// Transforms, column-major

lobe_result scenes_gltf_local_transform(const gltf_import *import, int index, double out[16]) {
    const gltf_node *node = &import->document->nodes[index];
    memcpy(out, node->matrix, sizeof node->matrix);
    if (node->has_matrix
            ? scenes_transform_is_affine(node->matrix)
            : scenes_transform_compose(node->translation, node->rotation, node->scale, out))
        return LOBE_OK;
    return lobe_host_fail(
        import->host, LOBE_ERROR_MALFORMED, "%s: node %d: %s", import->path, index,
        node->has_matrix ? "its matrix is not affine" : "its rotation has no length");
}

static lobe_result world_transform(const gltf_import *import, int index, const double *parent,
                                   double out[16]) {
    double local[16];
    lobe_result result = scenes_gltf_local_transform(import, index, local);
    if (result != LOBE_OK)
        return result;
    if (parent)
        scenes_transform_multiply(parent, local, out);
    else
        memcpy(out, local, sizeof local);
    if (scenes_transform_is_in_range(out))
        return LOBE_OK;
    return lobe_host_fail(import->host, LOBE_ERROR_LIMIT,
                          "%s: node %d: its transform is out of range", import->path, index);
}

// ---------------------------------------------------------------------------------------------
// The hierarchy

typedef struct node_tree {
    int *parents; // -1: a root
    int *stack;   // nodes still to be visited
    size_t depth; // of the stack
    int *order;   // all nodes, parents first
    bool *visited;
    double (*worlds)[16];
} node_tree;

static lobe_result allocate_tree(const gltf_import *import, node_tree *tree) {
    size_t count = import->document->node_count + 1;
    const lobe_allocator *allocator = lobe_host_allocator(import->host);
    tree->parents = lobe_allocate(allocator, count, sizeof *tree->parents);
    tree->stack = lobe_allocate(allocator, count, sizeof *tree->stack);
    tree->order = lobe_allocate(allocator, count, sizeof *tree->order);
    tree->visited = lobe_allocate(allocator, count, sizeof *tree->visited);
    tree->worlds = lobe_allocate(allocator, count, sizeof *tree->worlds);
    if (tree->parents && tree->stack && tree->order && tree->visited && tree->worlds)
        return LOBE_OK;
    return lobe_host_fail(import->host, LOBE_ERROR_OUT_OF_MEMORY, "%s: out of memory for %zu nodes",
                          import->path, count - 1);
}

static void free_tree(node_tree *tree) {
    lobe_release(tree->parents);
    lobe_release(tree->stack);
    lobe_release(tree->order);
    lobe_release(tree->visited);
    lobe_release(tree->worlds);
}

static lobe_result find_parents(const gltf_import *import, node_tree *tree) {
    const gltf_document *document = import->document;
    for (size_t i = 0; i < document->node_count; i++)
        tree->parents[i] = -1;
    for (size_t i = 0; i < document->node_count; i++) {
        for (size_t k = 0; k < document->nodes[i].child_count; k++) {
            int child = document->nodes[i].children[k];
            if (child < 0 || (size_t)child >= document->node_count)
                return lobe_host_fail(import->host, LOBE_ERROR_MALFORMED,
                                      "%s: node %zu: there is no child node %d", import->path, i,
                                      child);
            if (tree->parents[child] >= 0)
                return lobe_host_fail(import->host, LOBE_ERROR_MALFORMED,
                                      "%s: node %d has two parents", import->path, child);
            tree->parents[child] = (int)i;
        }
    }
    return LOBE_OK;
}

static void push_children(const gltf_import *import, node_tree *tree, int node) {
    const gltf_node *n = &import->document->nodes[node];
    for (size_t k = n->child_count; k > 0; k--)
        tree->stack[tree->depth++] = n->children[k - 1];
}

// Each node has one parent, so nodes that no root reaches are in loops or below loops.
static lobe_result find_order(const gltf_import *import, node_tree *tree) {
    size_t count = import->document->node_count, ordered = 0;
    tree->depth = 0;
    for (size_t i = 0; i < count; i++) {
        if (tree->parents[i] >= 0)
            continue;
        tree->stack[tree->depth++] = (int)i;
        while (tree->depth > 0) {
            int node = tree->stack[--tree->depth];
            tree->visited[node] = true;
            tree->order[ordered++] = node;
            push_children(import, tree, node);
        }
    }
    for (size_t i = 0; i < count; i++) {
        if (!tree->visited[i])
            return lobe_host_fail(import->host, LOBE_ERROR_MALFORMED,
                                  "%s: node %zu is its own ancestor, or below one that is",
                                  import->path, i);
        tree->visited[i] = false;
    }
    return LOBE_OK;
}

// ---------------------------------------------------------------------------------------------
// What nodes carry

static bool moves(const gltf_import *import, int node) {
    return import->motions && import->motions[node].moves;
}

static lobe_result add_instance(gltf_import *import, int64_t mesh, int64_t material,
                                const float transform[16]) {
    if (import->scene->instance_count >= GLTF_MAXIMUM_INSTANCES)
        return lobe_host_fail(import->host, LOBE_ERROR_LIMIT, "%s: more than %zu instances",
                              import->path, GLTF_MAXIMUM_INSTANCES);
    return scenes_add_instance(import->scene, (uint32_t)mesh, (uint32_t)material, transform,
                               import->host);
}

// Scaled to nothing: kept, hidden, if it moves and so may grow.
static lobe_result place_flat(gltf_import *import, const gltf_primitive_state *state, int node) {
    if (!moves(import, node)) {
        import->notes.flat_instances++;
        return LOBE_OK;
    }
    lobe_result result = add_instance(import, state->mesh, state->material, NULL);
    if (result != LOBE_OK)
        return result;
    import->scene->instances[import->scene->instance_count - 1].hidden = true;
    return scenes_gltf_pose_instance(import, node, false, true);
}

// A mirroring transform is split into a mirrored mesh and a transform that does not mirror: then
// winding, normals and tangent frames are right in object space as well as in the world. A mesh
// that is deformed has no mirrored one: its transform mirrors.
static lobe_result place(gltf_import *import, gltf_primitive_state *state, int node,
                         const double world[16]) {
    float transform[16];
    const int handedness = scenes_transform_handedness(world);
    if (handedness == 0)
        return place_flat(import, state, node);
    const bool reflected = handedness < 0 && !import->scene->meshes[state->mesh].deformation;
    scenes_transform_store(world, transform);
    int64_t mesh = state->mesh;
    if (reflected) {
        lobe_result result = scenes_gltf_convert_mirrored(import, state);
        if (result != LOBE_OK)
            return result;
        mesh = state->mirrored_mesh;
        for (int row = 0; row < 3; row++)
            transform[row] = -transform[row];
    }
    lobe_result result = add_instance(import, mesh, state->material, transform);
    if (result != LOBE_OK || !moves(import, node))
        return result;
    return scenes_gltf_pose_instance(import, node, reflected, false);
}

// A skin takes its mesh to the world: the node's own transform does not count.
static lobe_result place_skinned(gltf_import *import, const gltf_primitive_state *state) {
    lobe_result result = add_instance(import, state->mesh, state->material, NULL);
    return result == LOBE_OK ? scenes_gltf_pose_skinned(import, state->posed_mesh) : result;
}

// `skin`: of the rig; -1: none.
static lobe_result place_primitive(gltf_import *import, int node, size_t primitive, int32_t skin,
                                   const double world[16]) {
    const size_t mesh = (size_t)import->document->nodes[node].mesh;
    const gltf_primitive *p = &import->document->meshes[mesh].primitives[primitive];
    const bool skinned = skin >= 0 && p->attributes[GLTF_JOINTS_0] >= 0;
    gltf_primitive_state *state;
    if (skin >= 0 && !skinned)
        scenes_gltf_note_unsupported(import, "skins of meshes without joints");
    lobe_result result = skinned || p->target_count > 0
                             ? scenes_gltf_convert_deformed(import, mesh, primitive,
                                                            skinned ? skin : -1, node, &state)
                             : scenes_gltf_convert_primitive(import, mesh, primitive, &state);
    if (result != LOBE_OK || state->mesh < 0)
        return result;
    return skinned ? place_skinned(import, state) : place(import, state, node, world);
}

static lobe_result place_mesh(gltf_import *import, int node, const double world[16]) {
    const gltf_document *document = import->document;
    const int mesh = document->nodes[node].mesh;
    int32_t skin = -1;
    size_t target_count;
    if ((size_t)mesh >= document->mesh_count)
        return lobe_host_fail(import->host, LOBE_ERROR_MALFORMED, "%s: there is no mesh %d",
                              import->path, mesh);
    lobe_result result = scenes_gltf_count_targets(import, (size_t)mesh, &target_count);
    if (result == LOBE_OK && document->nodes[node].skin >= 0)
        result = scenes_gltf_convert_skin(import, document->nodes[node].skin, &skin);
    for (size_t i = 0; result == LOBE_OK && i < document->meshes[mesh].primitive_count; i++)
        result = place_primitive(import, node, i, skin, world);
    return result;
}

static lobe_result place_light(gltf_import *import, int node, const double world[16]) {
    const int light = import->document->nodes[node].light;
    lobe_result result = scenes_gltf_convert_light(import, light, world);
    const bool posed =
        moves(import, node) || (import->scene->rig && import->scene->rig->light_number_count > 0);
    return result == LOBE_OK && posed ? scenes_gltf_pose_light(import, node, light) : result;
}

static lobe_result place_camera(gltf_import *import, int node, const double world[16]) {
    const bool first = !import->scene->has_camera;
    lobe_result result =
        scenes_gltf_convert_camera(import, import->document->nodes[node].camera, world);
    if (result != LOBE_OK || !first || !moves(import, node))
        return result;
    import->scene->rig->camera_node = (int32_t)import->rig_nodes[node];
    scenes_gltf_measure_camera(import->scene);
    return LOBE_OK;
}

static lobe_result convert_node(gltf_import *import, int index, const double world[16]) {
    const gltf_node *node = &import->document->nodes[index];
    lobe_result result = LOBE_OK;
    if (node->mesh >= 0)
        result = place_mesh(import, index, world);
    if (result == LOBE_OK && node->light >= 0)
        result = place_light(import, index, world);
    if (result == LOBE_OK && node->camera >= 0)
        result = place_camera(import, index, world);
    return result;
}

// Depth first, in the order of the file; not recursive, because a chain of nodes may be long.
static lobe_result walk(gltf_import *import, node_tree *tree, int root) {
    if (root < 0 || (size_t)root >= import->document->node_count)
        return lobe_host_fail(import->host, LOBE_ERROR_MALFORMED,
                              "%s: there is no node %d in the scene", import->path, root);
    tree->depth = 0;
    tree->stack[tree->depth++] = root;
    while (tree->depth > 0) {
        int node = tree->stack[--tree->depth];
        int parent = tree->parents[node];
        if (tree->visited[node] || (node == root && parent >= 0))
            return lobe_host_fail(import->host, LOBE_ERROR_MALFORMED,
                                  "%s: node %d is in the scene twice, or is no root", import->path,
                                  node);
        tree->visited[node] = true;
        const double *above = parent >= 0 ? tree->worlds[parent] : NULL;
        lobe_result result = world_transform(import, node, above, tree->worlds[node]);
        if (result == LOBE_OK)
            result = convert_node(import, node, tree->worlds[node]);
        if (result != LOBE_OK)
            return result;
        push_children(import, tree, node);
    }
    return LOBE_OK;
}

// The default scene, or else the first.
lobe_result scenes_gltf_choose_scene(const gltf_import *import, int *scene) {
    const gltf_document *document = import->document;
    *scene = document->scene >= 0 ? document->scene : document->scene_count > 0 ? 0 : -1;
    if (document->scene >= 0 && (size_t)*scene >= document->scene_count)
        return lobe_host_fail(import->host, LOBE_ERROR_MALFORMED, "%s: there is no scene %d",
                              import->path, *scene);
    return LOBE_OK;
}

// A file without scenes shows all nodes that have no parent.
static lobe_result walk_scene(gltf_import *import, node_tree *tree) {
    const gltf_document *document = import->document;
    int scene;
    lobe_result result = scenes_gltf_choose_scene(import, &scene);
    if (result != LOBE_OK)
        return result;
    if (scene < 0) {
        for (size_t i = 0; i < document->node_count && result == LOBE_OK; i++) {
            if (tree->parents[i] < 0)
                result = walk(import, tree, (int)i);
        }
        return result;
    }
    for (size_t i = 0; i < document->scenes[scene].node_count && result == LOBE_OK; i++)
        result = walk(import, tree, document->scenes[scene].nodes[i]);
    return result;
}

lobe_result scenes_gltf_convert_nodes(gltf_import *import) {
    node_tree tree = {0};
    lobe_result result = allocate_tree(import, &tree);
    if (result == LOBE_OK)
        result = find_parents(import, &tree);
    if (result == LOBE_OK)
        result = find_order(import, &tree);
    if (result == LOBE_OK)
        result = scenes_gltf_begin_rig(import, tree.order, tree.parents);
    if (result == LOBE_OK)
        result = walk_scene(import, &tree);
    free_tree(&tree);
    return result;
}
