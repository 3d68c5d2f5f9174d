#include "tests/scenes/scene/scene_check.h"

#include <math.h>
#include <stdbool.h>
#include <string.h>

#include "scenes/mesh/vector.h"
#include "tests/engine/support/cmocka_all.h"

static void assert_near(double value, double expected, double tolerance) {
    assert_true(fabs(value - expected) <= tolerance);
}

static void check_vertex(const lobe_mesh *mesh, const lobe_scene_vertex *vertex) {
    const float *numbers = vertex->position;
    for (size_t i = 0; i < sizeof *vertex / sizeof *numbers; i++)
        assert_true(isfinite(numbers[i]));
    vector3 normal = vector3_load(vertex->normal), tangent = vector3_load(vertex->tangent);
    assert_near(vector3_length(normal), 1, 1e-6);
    assert_near(vector3_length(tangent), 1, 1e-6);
    assert_near(vector3_dot(normal, tangent), 0, 1e-6);
    assert_true(fabsf(vertex->tangent[3]) == 1);
    for (int i = 0; i < 3; i++) {
        assert_true(vertex->position[i] >= mesh->minimum[i]);
        assert_true(vertex->position[i] <= mesh->maximum[i]);
    }
    for (int i = 0; i < 4; i++)
        assert_true(vertex->colour[i] == 1);
}

typedef struct triangle {
    vector3 normal;           // its length is twice the area
    vector3 along_u, along_v; // derivatives of the position
    double coordinate_area;   // twice the area
} triangle;

static triangle measure(const lobe_mesh *mesh, const uint32_t *index) {
    const lobe_scene_vertex *corner[3];
    for (int k = 0; k < 3; k++) {
        assert_true(index[k] < mesh->vertex_count);
        corner[k] = &mesh->vertices[index[k]];
    }
    vector3 edge[2];
    double u[2], v[2];
    for (int k = 0; k < 2; k++) {
        edge[k] = vector3_subtract(vector3_load(corner[k + 1]->position),
                                   vector3_load(corner[0]->position));
        u[k] = corner[k + 1]->texture_coordinates[0][0] - corner[0]->texture_coordinates[0][0];
        v[k] = corner[k + 1]->texture_coordinates[0][1] - corner[0]->texture_coordinates[0][1];
    }
    double area = u[0] * v[1] - u[1] * v[0];
    assert_true(area != 0);
    triangle made = {.normal = vector3_cross(edge[0], edge[1]), .coordinate_area = area};
    made.along_u =
        vector3_subtract(vector3_scale(edge[0], v[1] / area), vector3_scale(edge[1], v[0] / area));
    made.along_v =
        vector3_subtract(vector3_scale(edge[1], u[0] / area), vector3_scale(edge[0], u[1] / area));
    return made;
}

static void check_triangle(const lobe_mesh *mesh, const uint32_t *index) {
    triangle measured = measure(mesh, index);
    assert_true(vector3_length(measured.normal) > 1e-9);
    for (int k = 0; k < 3; k++) {
        const lobe_scene_vertex *vertex = &mesh->vertices[index[k]];
        vector3 normal = vector3_load(vertex->normal), tangent = vector3_load(vertex->tangent);
        vector3 bitangent = vector3_scale(vector3_cross(normal, tangent), vertex->tangent[3]);
        assert_true(vector3_dot(measured.normal, normal) > 0);
        assert_true(vector3_dot(measured.along_u, tangent) > 0);
        assert_true(vector3_dot(measured.along_v, bitangent) < 0);
    }
}

void scene_check_mesh(const lobe_mesh *mesh) {
    assert_true(mesh->has_texture_coordinates[0]);
    assert_true(mesh->index_count > 0 && mesh->index_count % 3 == 0);
    for (size_t i = 0; i < mesh->vertex_count; i++)
        check_vertex(mesh, &mesh->vertices[i]);
    for (size_t i = 0; i < mesh->index_count; i += 3)
        check_triangle(mesh, mesh->indices + i);
}

static void check_use(const lobe_scene *scene, const lobe_texture_use *use) {
    assert_true(use->image >= -1 && use->image < (int64_t)scene->image_count);
    assert_int_equal(use->texture_coordinates, 0);
    assert_int_equal(use->wrap_u, LOBE_SCENE_WRAP_REPEAT);
    assert_int_equal(use->wrap_v, LOBE_SCENE_WRAP_REPEAT);
}

static void check_light(const lobe_light *light) {
    for (int i = 0; i < 3; i++)
        assert_true(isfinite(light->intensity[i]) && light->intensity[i] > 0);
    if (light->type == LOBE_LIGHT_DIRECTIONAL)
        assert_near(vector3_length(vector3_load(light->direction)), 1, 1e-6);
}

void scene_check(const lobe_scene *scene) {
    for (size_t i = 0; i < scene->mesh_count; i++)
        scene_check_mesh(&scene->meshes[i]);
    assert_true(scene->instance_count > 0 && scene->has_camera);
    assert_true(scene->light_count >= 2 || scene->environment);
    for (size_t i = 0; i < scene->instance_count; i++) {
        assert_true(scene->instances[i].mesh < scene->mesh_count);
        assert_true(scene->instances[i].material < scene->material_count);
    }
    for (size_t i = 0; i < scene->material_count; i++) {
        const lobe_material *material = &scene->materials[i];
        const lobe_texture_use *uses[] = {
            &material->base_colour_map, &material->normal_map, &material->emissive_map,
            &material->occlusion_map,   &material->width_map,  &material->metallic_roughness_map,
            &material->specular_map,    &material->height_map};
        for (size_t k = 0; k < sizeof uses / sizeof *uses; k++)
            check_use(scene, uses[k]);
    }
    for (size_t i = 0; i < scene->light_count; i++)
        check_light(&scene->lights[i]);
    for (int i = 0; i < 3; i++)
        assert_true(scene->minimum[i] <= scene->maximum[i]);
}

normal_statistics scene_check_normal_map(const lobe_image *image) {
    normal_statistics found = {0};
    assert_int_equal(image->format, LOBE_FORMAT_RGBA8_UNORM);
    size_t count = (size_t)image->width * image->height;
    const uint8_t *texel = image->texels;
    for (size_t i = 0; i < count; i++, texel += 4) {
        vector3 normal = {texel[0] / 127.5 - 1, texel[1] / 127.5 - 1, texel[2] / 127.5 - 1};
        // Each component differs by at most half a step of 1/127.5.
        assert_near(vector3_length(normal), 1, sqrt(3) / 255 + 1e-9);
        assert_true(normal.z > 0.1);
        assert_int_equal(texel[3], 255);
        vector3_normalise(&normal, 0);
        double tilt = acos(fmin(normal.z, 1)) * 180 / 3.14159265358979;
        found.mean_tilt += tilt / (double)count;
        found.greatest_tilt = fmax(found.greatest_tilt, tilt);
        found.mean[0] += normal.x / (double)count;
        found.mean[1] += normal.y / (double)count;
        found.mean[2] += normal.z / (double)count;
    }
    return found;
}

/// FNV-1a over bytes, continuing from `hash`.
static uint64_t hash_bytes(uint64_t hash, const void *bytes, size_t size) {
    for (size_t i = 0; i < size; i++)
        hash = (hash ^ ((const uint8_t *)bytes)[i]) * 1099511628211u;
    return hash;
}

static size_t image_size(const lobe_image *image) {
    return (size_t)image->width * image->height * lobe_format_size(image->format);
}

uint64_t scene_check_hash(const lobe_scene *scene) {
    uint64_t hash = 14695981039346656037u; // FNV's offset basis
    for (size_t i = 0; i < scene->image_count; i++)
        hash = hash_bytes(hash, scene->images[i].image.texels, image_size(&scene->images[i].image));
    for (size_t i = 0; i < scene->mesh_count; i++) {
        const lobe_mesh *mesh = &scene->meshes[i];
        for (size_t k = 0; k < mesh->vertex_count; k++) {
            const lobe_scene_vertex *vertex = &mesh->vertices[k];
            hash = hash_bytes(hash, vertex->position, sizeof vertex->position);
            hash =
                hash_bytes(hash, vertex->texture_coordinates, sizeof vertex->texture_coordinates);
        }
        hash = hash_bytes(hash, mesh->indices, mesh->index_count * sizeof *mesh->indices);
    }
    return hash;
}

void scene_check_equal(const lobe_scene *a, const lobe_scene *b) {
    assert_int_equal(a->image_count, b->image_count);
    for (size_t i = 0; i < a->image_count; i++) {
        assert_int_equal(a->images[i].image.format, b->images[i].image.format);
        assert_int_equal(image_size(&a->images[i].image), image_size(&b->images[i].image));
        assert_memory_equal(a->images[i].image.texels, b->images[i].image.texels,
                            image_size(&a->images[i].image));
    }
    assert_int_equal(a->mesh_count, b->mesh_count);
    for (size_t i = 0; i < a->mesh_count; i++) {
        const lobe_mesh *mesh = &a->meshes[i], *other = &b->meshes[i];
        assert_int_equal(mesh->vertex_count, other->vertex_count);
        assert_int_equal(mesh->index_count, other->index_count);
        assert_memory_equal(mesh->vertices, other->vertices,
                            mesh->vertex_count * sizeof *mesh->vertices);
        assert_memory_equal(mesh->indices, other->indices,
                            mesh->index_count * sizeof *mesh->indices);
    }
    assert_int_equal(a->light_count, b->light_count);
    assert_memory_equal(a->lights, b->lights, a->light_count * sizeof *a->lights);
    assert_memory_equal(&a->camera, &b->camera, sizeof a->camera);
}
