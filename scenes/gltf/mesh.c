#include <stdio.h>
#include <string.h>

#include "scenes/animation/posed_bounds.h"
#include "scenes/gltf/attributes.h"
#include "scenes/gltf/gltf.h"
#include "scenes/mesh/mesh.h"
#include "scenes/mesh/vector.h"
#include "scenes/scene/scene.h"

#define NAME_SIZE 128

static void name_primitive(const gltf_import *import, size_t mesh, size_t primitive,
                           char name[NAME_SIZE]) {
    const gltf_mesh *m = &import->document->meshes[mesh];
    int length = *m->name ? snprintf(name, NAME_SIZE - 24, "%s", m->name)
                          : snprintf(name, NAME_SIZE - 24, "mesh %zu", mesh);
    if (m->primitive_count > 1) {
        size_t end = length < NAME_SIZE - 24 ? (size_t)length : NAME_SIZE - 25;
        snprintf(name + end, NAME_SIZE - end, ".%zu", primitive);
    }
}

static lobe_result out_of_memory(const gltf_import *import, const char *name) {
    return lobe_host_fail(import->host, LOBE_ERROR_OUT_OF_MEMORY, "%s: %s: out of memory",
                          import->path, name);
}

// The element that each vertex of the mesh comes from; NULL: the one with the same index.
typedef struct vertex_source {
    uint32_t *elements;
    size_t count;
} vertex_source;

// glTF 2.0, section 3.7.2.1: without normals the triangles are flat, so they share no vertices.
static bool source_every_corner(const lobe_allocator *allocator, uint32_t *indices,
                                size_t index_count, vertex_source *source) {
    source->elements = lobe_allocate(allocator, index_count, sizeof *source->elements);
    if (!source->elements)
        return false;
    memcpy(source->elements, indices, index_count * sizeof *indices);
    for (size_t i = 0; i < index_count; i++)
        indices[i] = (uint32_t)i;
    source->count = index_count;
    return true;
}

// Primitives often share long accessors and index a part of them. Only that part is taken, in the
// order of first use. If all elements are used, the order is unchanged.
static bool source_used_elements(const lobe_allocator *allocator, uint32_t *indices,
                                 size_t index_count, size_t element_count, vertex_source *source) {
    uint32_t *vertex_of =
        lobe_allocate(allocator, element_count, sizeof *vertex_of); // index plus one; 0: unused
    uint32_t *elements = lobe_allocate(
        allocator, index_count < element_count ? index_count : element_count, sizeof *elements);
    size_t used = 0;
    for (size_t i = 0; vertex_of && elements && i < index_count; i++) {
        if (vertex_of[indices[i]] == 0) {
            elements[used++] = indices[i];
            vertex_of[indices[i]] = (uint32_t)used;
        }
    }
    bool done = vertex_of && elements;
    bool partial = done && used < element_count;
    for (size_t i = 0; partial && i < index_count; i++)
        indices[i] = vertex_of[indices[i]] - 1;
    *source = (vertex_source){partial ? elements : NULL, used};
    if (!partial)
        lobe_release(elements);
    lobe_release(vertex_of);
    return done;
}

static lobe_result choose_vertices(gltf_import *import, const gltf_attributes *attributes,
                                   uint32_t *indices, size_t index_count, vertex_source *source) {
    const lobe_allocator *allocator = lobe_host_allocator(import->host);
    size_t element_count = attributes->elements[GLTF_POSITION].count;
    bool done = attributes->present[GLTF_NORMAL]
                    ? source_used_elements(allocator, indices, index_count, element_count, source)
                    : source_every_corner(allocator, indices, index_count, source);
    if (!done)
        return out_of_memory(import, attributes->name);
    if (source->count > GLTF_MAXIMUM_VERTICES - import->vertices)
        return lobe_host_fail(import->host, LOBE_ERROR_LIMIT,
                              "%s: %s: more than %zu vertices in the scene", import->path,
                              attributes->name, GLTF_MAXIMUM_VERTICES);
    import->vertices += source->count;
    import->indices += index_count;
    return LOBE_OK;
}

static bool is_deformed(const gltf_primitive *primitive, size_t joint_count) {
    return joint_count > 0 || primitive->target_count > 0;
}

static lobe_result fill_mesh(gltf_import *import, const gltf_primitive *primitive,
                             const gltf_attributes *attributes, uint32_t *indices,
                             size_t index_count, size_t joint_count, lobe_mesh *mesh) {
    vertex_source source = {0};
    lobe_result result = choose_vertices(import, attributes, indices, index_count, &source);
    if (result == LOBE_OK)
        result =
            scenes_mesh_allocate(mesh, attributes->name, source.count, index_count, import->host);
    if (result == LOBE_OK) {
        memcpy(mesh->indices, indices, index_count * sizeof *indices);
        result = scenes_gltf_read_vertices(import, attributes, source.elements, mesh);
    }
    if (result == LOBE_OK && is_deformed(primitive, joint_count))
        result = scenes_gltf_read_deformation(import, attributes, primitive, source.elements,
                                              joint_count, mesh);
    lobe_release(source.elements);
    return result;
}

// Converts the file's tangents to the form that lobe guarantees; counts those without a direction.
static size_t orthonormalise_tangents(lobe_mesh *mesh) {
    size_t bad = 0;
    for (size_t i = 0; i < mesh->vertex_count; i++) {
        lobe_scene_vertex *vertex = &mesh->vertices[i];
        vector3 normal = vector3_load(vertex->normal), tangent = vector3_load(vertex->tangent);
        double length = vector3_length(tangent);
        tangent = vector3_subtract(tangent, vector3_scale(normal, vector3_dot(normal, tangent)));
        bad += !vector3_normalise(&tangent, 1e-4 * length);
        vector3_store(tangent, vertex->tangent);
        vertex->tangent[3] = vertex->tangent[3] < 0 ? -1 : 1;
    }
    return bad;
}

// Where nothing is laid out along tangents, targets need none.
static lobe_result compute_tangents(gltf_import *import, const lobe_material *material,
                                    lobe_mesh *mesh) {
    lobe_result result = scenes_mesh_compute_tangents(mesh, &material->normal_map, import->host);
    if (result != LOBE_OK || !mesh->deformation || material->normal_map.image < 0)
        return result;
    const size_t before = mesh->deformation->delta_count;
    result = scenes_mesh_compute_target_tangents(
        mesh, &material->normal_map, GLTF_MAXIMUM_DELTAS - import->deltas, import->host);
    import->deltas += mesh->deformation->delta_count - before;
    return result;
}

static lobe_result complete_frames(gltf_import *import, const gltf_attributes *attributes,
                                   const lobe_material *material, lobe_mesh *mesh) {
    size_t repaired = 0, bad_tangents = 0;
    bool normals = attributes->present[GLTF_NORMAL];
    lobe_result result = normals ? scenes_mesh_repair_normals(mesh, import->host, &repaired)
                                 : scenes_mesh_compute_normals(mesh, import->host);
    import->notes.repaired_normals += repaired;
    if (result != LOBE_OK)
        return result;
    bool tangents = normals && attributes->present[GLTF_TANGENT];
    if (tangents)
        bad_tangents = orthonormalise_tangents(mesh);
    import->notes.repaired_tangents += bad_tangents;
    if (tangents && bad_tangents == 0)
        return LOBE_OK;
    return compute_tangents(import, material, mesh);
}

static void note_missing_coordinates(gltf_import *import, const lobe_material *material,
                                     const lobe_mesh *mesh) {
    const lobe_texture_use *uses[] = {&material->base_colour_map, &material->normal_map,
                                      &material->emissive_map, &material->occlusion_map,
                                      &material->metallic_roughness_map};
    bool missing = false;
    for (size_t i = 0; i < sizeof uses / sizeof *uses; i++) {
        bool there = mesh->has_texture_coordinates[uses[i]->texture_coordinates];
        missing = missing || (uses[i]->image >= 0 && !there);
    }
    import->notes.missing_coordinates += missing;
}

// Leaves `mesh` without indices if no triangle has an area.
static lobe_result build_mesh(gltf_import *import, const gltf_primitive *primitive,
                              const lobe_material *material, const char *name, size_t joint_count,
                              lobe_mesh *mesh) {
    gltf_attributes attributes;
    uint32_t *indices = NULL;
    size_t index_count = 0;
    lobe_result result = scenes_gltf_open_attributes(import, primitive, name, &attributes);
    if (result == LOBE_OK)
        result = scenes_gltf_read_triangles(import, primitive, name,
                                            attributes.elements[GLTF_POSITION].count, &indices,
                                            &index_count);
    if (result == LOBE_OK)
        result = fill_mesh(import, primitive, &attributes, indices, index_count, joint_count, mesh);
    lobe_release(indices);
    if (result != LOBE_OK)
        return result;
    result = complete_frames(import, &attributes, material, mesh);
    // Not earlier: even a triangle without area joins the tangents of its neighbours.
    // A morph target may give one an area.
    if (primitive->target_count == 0)
        import->notes.degenerate_triangles += scenes_mesh_drop_degenerate(mesh);
    if (mesh->index_count > 0)
        note_missing_coordinates(import, material, mesh);
    return result;
}

static bool is_drawable(gltf_import *import, const gltf_primitive *primitive) {
    if (primitive->mode < GLTF_TRIANGLES) {
        scenes_gltf_note_unsupported(import, "points and lines");
        return false;
    }
    if (primitive->attributes[GLTF_POSITION] < 0) {
        scenes_gltf_note_unsupported(import, "primitives without positions");
        return false;
    }
    return true;
}

// `joint_count`: of the skin that deforms it; 0: none.
static lobe_result convert(gltf_import *import, size_t mesh, size_t primitive, size_t joint_count,
                           gltf_primitive_state *state) {
    const gltf_primitive *p = &import->document->meshes[mesh].primitives[primitive];
    char name[NAME_SIZE];
    name_primitive(import, mesh, primitive, name);
    if (p->mode > GLTF_TRIANGLE_FAN)
        return lobe_host_fail(import->host, LOBE_ERROR_MALFORMED, "%s: %s: unknown mode %d",
                              import->path, name, p->mode);
    state->mesh = GLTF_NOTHING_TO_DRAW;
    if (!is_drawable(import, p))
        return LOBE_OK;
    lobe_result result = scenes_gltf_convert_material(import, p->material, &state->material);
    if (result != LOBE_OK)
        return result;
    lobe_mesh built = {0};
    uint32_t index = 0;
    result = build_mesh(import, p, &import->scene->materials[state->material], name, joint_count,
                        &built);
    bool drawn = result == LOBE_OK && built.index_count > 0;
    if (drawn)
        result = scenes_add_mesh(import->scene, &built, import->host, &index);
    if (drawn && result == LOBE_OK)
        state->mesh = index;
    scenes_mesh_free(&built);
    return result;
}

lobe_result scenes_gltf_convert_primitive(gltf_import *import, size_t mesh, size_t primitive,
                                          gltf_primitive_state **state) {
    *state = &import->primitives[import->first_primitives[mesh] + primitive];
    if ((*state)->mesh != GLTF_NOT_CONVERTED)
        return LOBE_OK;
    return convert(import, mesh, primitive, 0, *state);
}

// ---------------------------------------------------------------------------------------------
// Deformed meshes

// Gives it the weights at rest, and what its pose follows.
static lobe_result pose(gltf_import *import, size_t mesh, int node, gltf_primitive_state *state) {
    lobe_mesh *posed = &import->scene->meshes[state->mesh];
    const bool animated =
        import->motions && state->weight_node >= 0 && import->motions[state->weight_node].weights;
    lobe_result result = scenes_gltf_read_weights(
        import, mesh, node, posed->deformation->target_count, posed->deformation->weights);
    if (result == LOBE_OK && (state->skin >= 0 || animated))
        return scenes_gltf_pose_mesh(import, (uint32_t)state->mesh, state->skin,
                                     animated ? state->weight_node : -1, &state->posed_mesh);
    lobe_posed_mesh rest = {0};
    if (result == LOBE_OK)
        result = scenes_posed_bounds_measure(posed, &rest, import->host);
    if (result == LOBE_OK)
        scenes_posed_bounds_set(&rest, posed);
    lobe_release(rest.target_bounds);
    return result;
}

lobe_result scenes_gltf_convert_deformed(gltf_import *import, size_t mesh, size_t primitive,
                                         int32_t skin, int node, gltf_primitive_state **state) {
    const bool own_weights = import->document->nodes[node].weight_count > 0 ||
                             (import->motions && import->motions[node].weights);
    const int64_t weight_node = own_weights ? node : -1;
    gltf_primitive_state *s = *state =
        &import->deformed[import->first_primitives[mesh] + primitive];
    if (s->mesh != GLTF_NOT_CONVERTED && s->skin == skin && s->weight_node == weight_node)
        return LOBE_OK;
    *s = (gltf_primitive_state){
        GLTF_NOT_CONVERTED, GLTF_NOT_CONVERTED, GLTF_NOT_CONVERTED, skin, weight_node, -1};
    const size_t joint_count = skin >= 0 ? import->scene->rig->skins[skin].joint_count : 0;
    lobe_result result = convert(import, mesh, primitive, joint_count, s);
    return result == LOBE_OK && s->mesh >= 0 ? pose(import, mesh, node, s) : result;
}

static void reflect_in_x(lobe_mesh *mesh) {
    for (size_t i = 0; i < mesh->vertex_count; i++) {
        lobe_scene_vertex *vertex = &mesh->vertices[i];
        vertex->position[0] = -vertex->position[0];
        vertex->normal[0] = -vertex->normal[0];
        vertex->tangent[0] = -vertex->tangent[0];
        vertex->tangent[3] = -vertex->tangent[3];
    }
    for (size_t i = 0; i + 2 < mesh->index_count; i += 3) {
        uint32_t second = mesh->indices[i + 1];
        mesh->indices[i + 1] = mesh->indices[i + 2];
        mesh->indices[i + 2] = second;
    }
}

lobe_result scenes_gltf_convert_mirrored(gltf_import *import, gltf_primitive_state *state) {
    if (state->mirrored_mesh != GLTF_NOT_CONVERTED)
        return LOBE_OK;
    const lobe_mesh *mesh = &import->scene->meshes[state->mesh];
    lobe_mesh mirrored;
    uint32_t index = 0;
    lobe_result result = scenes_mesh_allocate(&mirrored, mesh->name, mesh->vertex_count,
                                              mesh->index_count, import->host);
    if (result != LOBE_OK)
        return result;
    memcpy(mirrored.vertices, mesh->vertices, mesh->vertex_count * sizeof *mesh->vertices);
    memcpy(mirrored.indices, mesh->indices, mesh->index_count * sizeof *mesh->indices);
    memcpy(mirrored.has_texture_coordinates, mesh->has_texture_coordinates,
           sizeof mesh->has_texture_coordinates);
    mirrored.has_colour = mesh->has_colour;
    reflect_in_x(&mirrored);
    result = scenes_add_mesh(import->scene, &mirrored, import->host, &index);
    if (result == LOBE_OK)
        state->mirrored_mesh = index;
    return result;
}
