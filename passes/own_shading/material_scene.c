#include "passes/own_shading/material_scene.h"

#include <string.h>

/// A mask may cut by the alpha of the host's vertices, also where its material alone keeps all:
/// with colours they are the host's to give. Its texture coordinates may be anywhere: these leave
/// every map, on a line, which says nothing about how densely they lie.
static void fill_mesh(material_scene *scene, bool vertex_colours) {
    static const float corners[3][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    static const float coordinates[3] = {-1e6f, 0, 1e6f};
    for (uint32_t i = 0; i < 3; i++) {
        lobe_scene_vertex *vertex = &scene->vertices[i];
        *vertex = (lobe_scene_vertex){
            .normal = {0, 0, 1}, .tangent = {1, 0, 0, 1}, .colour = {1, 1, 1, 1}};
        memcpy(vertex->position, corners[i], sizeof corners[i]);
        for (int axis = 0; axis < 4; axis++)
            vertex->texture_coordinates[axis / 2][axis % 2] = coordinates[i];
        scene->indices[i] = i;
    }
    scene->mesh = (lobe_mesh){.name = "surface of the host",
                              .vertices = scene->vertices,
                              .vertex_count = 3,
                              .indices = scene->indices,
                              .index_count = 3,
                              .has_colour = vertex_colours,
                              .on_device = vertex_colours,
                              .maximum = {1, 1, 0}};
}

static void fill_instances(material_scene *scene) {
    static const float identity[16] = {[0] = 1, [5] = 1, [10] = 1, [15] = 1};
    for (uint32_t i = 0; i < scene->source->material_count; i++) {
        scene->instances[i] = (lobe_instance){.material = i};
        memcpy(scene->instances[i].transform, identity, sizeof identity);
    }
}

material_scene *passes_material_scene_create(const lobe_scene *source, bool vertex_colours,
                                             const lobe_allocator *allocator) {
    material_scene *scene = lobe_allocate(
        allocator, 1, sizeof *scene + source->material_count * sizeof *scene->instances);
    if (!scene)
        return NULL;
    scene->source = source;
    scene->scene = (lobe_scene){
        .name = source->name ? source->name : "maps",
        .images = source->images,
        .image_count = source->image_count,
        .materials = source->materials,
        .material_count = source->material_count,
        .meshes = &scene->mesh,
        .mesh_count = 1,
        .instances = scene->instances,
        .instance_count = source->material_count,
        .camera = {.eye = {0, 0, 2}, .up = {0, 1, 0}, .orthographic_height = 1, .near_plane = 1},
        .maximum = {1, 1, 0},
    };
    fill_mesh(scene, vertex_colours);
    fill_instances(scene);
    passes_material_scene_update(scene);
    return scene;
}

void passes_material_scene_update(material_scene *scene) {
    scene->scene.environment = scene->source->environment;
}
