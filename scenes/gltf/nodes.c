#include <float.h>
#include <math.h>
#include <string.h>

#include "scenes/gltf/gltf.h"
#include "scenes/scene/scene.h"

// ---------------------------------------------------------------------------------------------
// Transforms, column-major

static void multiply(const double a[16], const double b[16], double out[16]) {
    for (int column = 0; column < 4; column++) {
        for (int row = 0; row < 4; row++) {
            double sum = 0;
            for (int k = 0; k < 4; k++)
                sum += a[4 * k + row] * b[4 * column + k];
            out[4 * column + row] = sum;
        }
    }
}

bool scenes_gltf_rotation(const double q[4], double columns[3][3]) {
    double length = sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    if (!(length > 1e-6) || !isfinite(length))
        return false;
    double x = q[0] / length, y = q[1] / length, z = q[2] / length, w = q[3] / length;
    const double rotation[3][3] = {
        {1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w)},
        {2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w)},
        {2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y)},
    };
    memcpy(columns, rotation, sizeof rotation);
    return true;
}

// glTF 2.0, section 3.5.3: T R S.
static bool compose(const gltf_node *node, double out[16]) {
    const double *s = node->scale, *t = node->translation;
    double rotation[3][3];
    if (!scenes_gltf_rotation(node->rotation, rotation))
        return false;
    for (int column = 0; column < 3; column++) {
        for (int row = 0; row < 3; row++)
            out[4 * column + row] = rotation[column][row] * s[column];
        out[4 * column + 3] = 0;
        out[12 + column] = t[column];
    }
    out[15] = 1;
    return true;
}

static bool is_affine(const double m[16]) {
    return fabs(m[3]) < 1e-6 && fabs(m[7]) < 1e-6 && fabs(m[11]) < 1e-6 && fabs(m[15] - 1) < 1e-6;
}

static lobe_result local_transform(const gltf_import *import, int index, double out[16]) {
    const gltf_node *node = &import->document->nodes[index];
    memcpy(out, node->matrix, sizeof node->matrix);
    if (node->has_matrix ? is_affine(node->matrix) : compose(node, out))
        return LOBE_OK;
    return lobe_host_fail(
        import->host, LOBE_ERROR_MALFORMED, "%s: node %d: %s", import->path, index,
        node->has_matrix ? "its matrix is not affine" : "its rotation has no length");
}

static lobe_result world_transform(const gltf_import *import, int index, const double *parent,
                                   double out[16]) {
    double local[16];
    lobe_result result = local_transform(import, index, local);
    if (result != LOBE_OK)
        return result;
    if (parent)
        multiply(parent, local, out);
    else
        memcpy(out, local, sizeof local);
    for (int i = 0; i < 16; i++) {
        // Squares of values up to this limit are finite in single precision. NaN fails the test,
        // too.
        if (!(fabs(out[i]) <= 1e18))
            return lobe_host_fail(import->host, LOBE_ERROR_LIMIT,
                                  "%s: node %d: its transform is out of range", import->path,
                                  index);
    }
    return LOBE_OK;
}

// ---------------------------------------------------------------------------------------------
// The hierarchy

typedef struct node_tree {
    int *parents; // -1: a root
    int *stack;   // nodes still to be visited
    size_t depth; // of the stack
    bool *visited;
    double (*worlds)[16];
} node_tree;

static lobe_result allocate_tree(const gltf_import *import, node_tree *tree) {
    size_t count = import->document->node_count + 1;
    const lobe_allocator *allocator = lobe_host_allocator(import->host);
    tree->parents = lobe_allocate(allocator, count, sizeof *tree->parents);
    tree->stack = lobe_allocate(allocator, count, sizeof *tree->stack);
    tree->visited = lobe_allocate(allocator, count, sizeof *tree->visited);
    tree->worlds = lobe_allocate(allocator, count, sizeof *tree->worlds);
    if (tree->parents && tree->stack && tree->visited && tree->worlds)
        return LOBE_OK;
    return lobe_host_fail(import->host, LOBE_ERROR_OUT_OF_MEMORY, "%s: out of memory for %zu nodes",
                          import->path, count - 1);
}

static void free_tree(node_tree *tree) {
    lobe_release(tree->parents);
    lobe_release(tree->stack);
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
static lobe_result check_loops(const gltf_import *import, node_tree *tree) {
    size_t count = import->document->node_count;
    tree->depth = 0;
    for (size_t i = 0; i < count; i++) {
        if (tree->parents[i] >= 0)
            continue;
        tree->stack[tree->depth++] = (int)i;
        while (tree->depth > 0) {
            int node = tree->stack[--tree->depth];
            tree->visited[node] = true;
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

typedef enum orientation { ORIENTATION_KEPT, ORIENTATION_MIRRORED, ORIENTATION_FLAT } orientation;

// The sign of the determinant; 0 if the three axes span practically no volume.
static orientation orientation_of(const double m[16]) {
    double determinant = m[0] * (m[5] * m[10] - m[6] * m[9]) - m[4] * (m[1] * m[10] - m[2] * m[9]) +
                         m[8] * (m[1] * m[6] - m[2] * m[5]);
    double volume = 1;
    for (int column = 0; column < 3; column++) {
        const double *c = m + 4 * column;
        volume *= sqrt(c[0] * c[0] + c[1] * c[1] + c[2] * c[2]);
    }
    if (!(fabs(determinant) > 1e-9 * volume))
        return ORIENTATION_FLAT;
    return determinant < 0 ? ORIENTATION_MIRRORED : ORIENTATION_KEPT;
}

// A mirroring transform is split into a mirrored mesh and a transform that does not mirror: then
// winding, normals and tangent frames are right in object space as well as in the world.
static lobe_result place(gltf_import *import, gltf_primitive_state *state, const double world[16]) {
    float transform[16];
    orientation kind = orientation_of(world);
    if (kind == ORIENTATION_FLAT) {
        import->notes.flat_instances++;
        return LOBE_OK;
    }
    for (int i = 0; i < 16; i++)
        transform[i] = (float)world[i];
    transform[3] = transform[7] = transform[11] = 0;
    transform[15] = 1;
    int64_t mesh = state->mesh;
    if (kind == ORIENTATION_MIRRORED) {
        lobe_result result = scenes_gltf_convert_mirrored(import, state);
        if (result != LOBE_OK)
            return result;
        mesh = state->mirrored_mesh;
        for (int row = 0; row < 3; row++)
            transform[row] = -transform[row];
    }
    if (import->scene->instance_count >= GLTF_MAXIMUM_INSTANCES)
        return lobe_host_fail(import->host, LOBE_ERROR_LIMIT, "%s: more than %zu instances",
                              import->path, GLTF_MAXIMUM_INSTANCES);
    return scenes_add_instance(import->scene, (uint32_t)mesh, (uint32_t)state->material, transform,
                               import->host);
}

static lobe_result place_mesh(gltf_import *import, int mesh, const double world[16]) {
    if ((size_t)mesh >= import->document->mesh_count)
        return lobe_host_fail(import->host, LOBE_ERROR_MALFORMED, "%s: there is no mesh %d",
                              import->path, mesh);
    for (size_t i = 0; i < import->document->meshes[mesh].primitive_count; i++) {
        gltf_primitive_state *state;
        lobe_result result = scenes_gltf_convert_primitive(import, (size_t)mesh, i, &state);
        if (result == LOBE_OK && state->mesh >= 0)
            result = place(import, state, world);
        if (result != LOBE_OK)
            return result;
    }
    return LOBE_OK;
}

static lobe_result convert_node(gltf_import *import, int index, const double world[16]) {
    const gltf_node *node = &import->document->nodes[index];
    lobe_result result = LOBE_OK;
    if (node->skin >= 0)
        scenes_gltf_note_unsupported(import, "skins");
    if (node->mesh >= 0)
        result = place_mesh(import, node->mesh, world);
    if (result == LOBE_OK && node->light >= 0)
        result = scenes_gltf_convert_light(import, node->light, world);
    if (result == LOBE_OK && node->camera >= 0)
        result = scenes_gltf_convert_camera(import, node->camera, world);
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
        result = check_loops(import, &tree);
    if (result == LOBE_OK)
        result = walk_scene(import, &tree);
    free_tree(&tree);
    return result;
}
