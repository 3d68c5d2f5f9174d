#include "passes/upload/device_scene_parts.h"

#include <math.h>
#include <string.h>

#include "passes/upload/colours/mask_alpha.h"
#include "passes/upload/frame_check.h"
#include "passes/upload/heights/map_width.h"
#include "passes/upload/material_maps.h"
#include "passes/upload/scene_check.h"

static void transformed_coordinates(const lobe_texture_use *use, const lobe_scene_vertex *vertex,
                                    float uv[2]) {
    const float *set = vertex->texture_coordinates[use->texture_coordinates];
    for (int i = 0; i < 2; i++)
        uv[i] =
            use->transform[i][0] * set[0] + use->transform[i][1] * set[1] + use->transform[i][2];
}

/// Whether each texel of a map belongs to one place of the mesh: all coordinates lie within the
/// map, and the triangles do not cover more than its area.
static bool is_atlas(const lobe_mesh *mesh, const lobe_texture_use *use) {
    if (!mesh->has_texture_coordinates[use->texture_coordinates])
        return false;
    const float slack = 1e-3f;
    double area = 0;
    for (size_t i = 0; i + 2 < mesh->index_count; i += 3) {
        float uv[3][2];
        for (int corner = 0; corner < 3; corner++) {
            transformed_coordinates(use, &mesh->vertices[mesh->indices[i + (size_t)corner]],
                                    uv[corner]);
            for (int axis = 0; axis < 2; axis++) {
                if (uv[corner][axis] < -slack || uv[corner][axis] > 1 + slack)
                    return false;
            }
        }
        area += 0.5 * fabs((double)(uv[1][0] - uv[0][0]) * (uv[2][1] - uv[0][1]) -
                           (double)(uv[1][1] - uv[0][1]) * (uv[2][0] - uv[0][0]));
    }
    return area <= 1 + 10 * slack;
}

lobe_result passes_device_scene_check_instance(const lobe_scene *scene, size_t index,
                                               const lobe_host *host) {
    const lobe_instance *instance = &scene->instances[index];
    if (instance->mesh < scene->mesh_count && instance->material < scene->material_count)
        return passes_check_transform(scene, index, host);
    return lobe_host_fail(host, LOBE_ERROR_MALFORMED,
                          "%s: instance %zu uses mesh %u of %zu, material %u of %zu", scene->name,
                          index, instance->mesh, scene->mesh_count, instance->material,
                          scene->material_count);
}

static grid_layout layout_of(const device_scene *scene, uint32_t mesh,
                             const lobe_texture_use *use) {
    grid_layout layout = {.mesh = mesh,
                          .mesh_version = scene->measures[mesh].version,
                          .texture_coordinates = use->texture_coordinates};
    memcpy(layout.transform, use->transform, sizeof layout.transform);
    return layout;
}

/// Looks at the triangles only where their layout has changed.
static void find_atlas(device_scene *scene, device_instance *instance) {
    const lobe_grid grid = passes_lobe_grid(&scene->materials[instance->material]);
    const grid_layout before = instance->layout;
    instance->layout = grid.use ? layout_of(scene, instance->mesh, grid.use) : (grid_layout){0};
    if (memcmp(&instance->layout, &before, sizeof before) != 0)
        instance->is_atlas = grid.use && is_atlas(&scene->scene->meshes[instance->mesh], grid.use);
}

/// The same for how wide the height map is.
static void find_map_width(device_scene *scene, device_instance *instance) {
    const device_material *material = &scene->materials[instance->material];
    const lobe_mesh *mesh = &scene->scene->meshes[instance->mesh];
    const lobe_texture_use *use = material->height_normals ? &material->height : NULL;
    const grid_layout before = instance->height_layout;
    if (use && !mesh->has_texture_coordinates[use->texture_coordinates])
        use = NULL;
    instance->height_layout = use ? layout_of(scene, instance->mesh, use) : (grid_layout){0};
    if (memcmp(&instance->height_layout, &before, sizeof before) != 0)
        instance->map_width = use ? (float)passes_map_width(mesh, use) : 0;
}

static void measure_instance(device_scene *scene, size_t index) {
    const lobe_instance *source = &scene->scene->instances[index];
    device_instance *instance = &scene->instances[index];
    instance->mesh = source->mesh;
    instance->material = source->material;
    find_atlas(scene, instance);
    find_map_width(scene, instance);
}

static lobe_result upload_material(device_scene *result, uint32_t index, const lobe_host *host) {
    if (result->materials[index].constants)
        return LOBE_OK;
    lobe_result status = passes_scene_check_material(result->scene, index, host);
    return status == LOBE_OK ? passes_device_scene_upload_material(result, index, host) : status;
}

static lobe_result upload_mesh(device_scene *result, uint32_t index, const lobe_host *host) {
    if (result->indices[index])
        return LOBE_OK;
    lobe_result status = passes_scene_check_mesh(result->scene, index, host);
    return status == LOBE_OK ? passes_device_scene_upload_mesh(result, index) : status;
}

lobe_result passes_device_scene_upload_instance(device_scene *scene, size_t index,
                                                const lobe_host *host) {
    const lobe_instance *source = &scene->scene->instances[index];
    lobe_result status = passes_device_scene_check_instance(scene->scene, index, host);
    if (status == LOBE_OK)
        status = upload_mesh(scene, source->mesh, host);
    if (status == LOBE_OK)
        status = upload_material(scene, source->material, host);
    if (status == LOBE_OK)
        measure_instance(scene, index);
    return status;
}

bool passes_device_scene_reserve_instances(device_scene *scene, size_t count) {
    if (count <= scene->instance_room)
        return true;
    const size_t twice = 2 * scene->instance_room, room = count > twice ? count : twice;
    device_instance *instances =
        lobe_reallocate(scene->allocator, scene->instances, room, sizeof *instances);
    if (!instances)
        return false;
    memset(instances + scene->instance_room, 0, (room - scene->instance_room) * sizeof *instances);
    scene->instances = instances;
    scene->instance_room = room;
    return true;
}

/// Where this changes, maps no longer lie alike as they did: all of them are made anew.
static void find_equal_sets(const device_scene *scene, device_material *material) {
    const bool before = material->equal_sets;
    material->equal_sets = material->second_coordinates != 0;
    for (uint32_t next = material->first_instance; material->equal_sets && next > 0;
         next = scene->instances[next - 1].next_of_material)
        material->equal_sets = scene->measures[scene->instances[next - 1].mesh].equal_sets;
    material->version += material->equal_sets != before;
    material->parameter_version += material->equal_sets != before;
}

/// Whether all corners of a box of texture coordinates (least, largest) are read within the map.
static bool are_inside(const float box[2][2], const lobe_texture_use *use) {
    const double slack = 1e-4;
    for (int i = 0; i < 8; i++) {
        const float *row = use->transform[i / 4];
        const double value = (double)row[0] * (double)box[i & 1][0] +
                             (double)row[1] * (double)box[i >> 1 & 1][1] + (double)row[2];
        if (!(value >= -slack && value <= 1 + slack))
            return false;
    }
    return true;
}

/// Where this changes, maps that wrap differently may lie alike, or no longer do.
static void find_inside(const device_scene *scene, device_material *material) {
    const uint32_t before = material->inside;
    material->inside = material->map_bits;
    for (uint32_t next = material->first_instance; next > 0;
         next = scene->instances[next - 1].next_of_material) {
        const mesh_measures *measures = &scene->measures[scene->instances[next - 1].mesh];
        for (uint32_t map = 0; map < MAP_COUNT; map++) {
            const lobe_texture_use *use = material->maps[map].use;
            if (use && !are_inside(measures->coordinates[use->texture_coordinates], use))
                material->inside &= ~(1u << map);
        }
    }
    material->version += material->inside != before;
    material->parameter_version += material->inside != before;
}

/// Where this changes, all maps are made anew, too.
static void find_mask(device_scene *scene, device_material *material) {
    const bool before = material->masked;
    material->masked = material->material->alpha_mask && ((before && scene->keeps_conclusions) ||
                                                          passes_mask_may_cut(scene, material));
    material->version += material->masked != before;
    material->parameter_version += material->masked != before;
}

void passes_device_scene_link_instances(device_scene *scene) {
    scene->instance_count = scene->scene->instance_count;
    for (size_t i = 0; i < scene->scene->material_count; i++)
        scene->materials[i].first_instance = 0;
    for (size_t i = 0; i < scene->scene->mesh_count; i++)
        scene->measures[i].has_instances = false;
    for (size_t i = scene->instance_count; i-- > 0;) {
        device_instance *instance = &scene->instances[i];
        uint32_t *first = &scene->materials[instance->material].first_instance;
        instance->next_of_material = *first;
        *first = (uint32_t)i + 1;
        scene->measures[instance->mesh].has_instances = true;
    }
    for (size_t i = 0; i < scene->scene->material_count; i++) {
        if (scene->materials[i].first_instance > 0) {
            find_equal_sets(scene, &scene->materials[i]);
            find_inside(scene, &scene->materials[i]);
            find_mask(scene, &scene->materials[i]);
        }
    }
}
