#include "passes/displacement/displacement.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "passes/context/knob_values.h"
#include "passes/context/shared_knobs.h"
#include "passes/displacement/displaced_mesh.h"
#include "passes/displacement/patch_layout.h"
#include "passes/displacement/patch_passes.h"
#include "passes/maps/level_reduction.h"
#include "passes/upload/device_scene_parts.h"
#include "passes/upload/transform.h"

/// What decides how an instance is cut into patches.
typedef struct layout_key {
    uint32_t mesh, mesh_version;
    uint32_t width, height; ///< texels of the height map
    lobe_texture_use use;
    float height_scale;
} layout_key;

typedef struct instance_state {
    layout_key key; ///< all zero: none
    patch_layout layout;
    bool displaced;
} instance_state;

/// What was displaced in this frame, and where to.
typedef struct displaced_instance {
    displaced_surface surface;
    patch_buffers buffers;
} displaced_instance;

struct displacement {
    displaced_mesh *meshes;        ///< one for each mesh of the scene
    reduced_map *heights;          ///< one for each image: of this frame; version 0: none yet
    height_bounds *bounds;         ///< the same; no levels: none yet
    instance_state *instances;     ///< one for each instance
    displaced_geometry *geometry;  ///< the same: of this frame
    displaced_instance *displaced; ///< the same
    size_t mesh_count, instance_room;
};

bool passes_displacement_wanted(const filter_context *context) {
    return passes_knob_choice(context, &passes_knob_displacement) != 0;
}

// ---------------------------------------------------------------------------------------------
// Memory

static bool reserve(displacement *state, size_t count, const lobe_allocator *allocator) {
    if (count <= state->instance_room)
        return true;
    const size_t twice = 2 * state->instance_room, room = count > twice ? count : twice;
    instance_state *instances =
        lobe_reallocate(allocator, state->instances, room, sizeof *instances);
    if (instances) {
        memset(instances + state->instance_room, 0,
               (room - state->instance_room) * sizeof *instances);
        state->instances = instances;
    }
    displaced_geometry *geometry =
        lobe_reallocate(allocator, state->geometry, room, sizeof *geometry);
    if (geometry)
        state->geometry = geometry;
    displaced_instance *displaced =
        lobe_reallocate(allocator, state->displaced, room, sizeof *displaced);
    if (displaced)
        state->displaced = displaced;
    if (!instances || !geometry || !displaced)
        return false;
    state->instance_room = room;
    return true;
}

static bool create(displacement **state, const device_scene *scene) {
    if (*state)
        return true;
    displacement *s = lobe_allocate(scene->allocator, 1, sizeof *s);
    if (!s)
        return false;
    s->mesh_count = scene->scene->mesh_count;
    s->meshes = lobe_allocate(scene->allocator, s->mesh_count + 1, sizeof *s->meshes);
    s->heights = lobe_allocate(scene->allocator, scene->scene->image_count + 1, sizeof *s->heights);
    s->bounds = lobe_allocate(scene->allocator, scene->scene->image_count + 1, sizeof *s->bounds);
    if (!s->meshes || !s->heights || !s->bounds) {
        lobe_release(s->meshes);
        lobe_release(s->heights);
        lobe_release(s->bounds);
        lobe_release(s);
        return false;
    }
    *state = s;
    return true;
}

void passes_displacement_destroy(displacement **state) {
    displacement *s = *state;
    if (!s)
        return;
    for (size_t i = 0; i < s->mesh_count; i++)
        passes_displaced_mesh_destroy(&s->meshes[i]);
    lobe_release(s->meshes);
    lobe_release(s->heights);
    lobe_release(s->bounds);
    lobe_release(s->instances);
    lobe_release(s->geometry);
    lobe_release(s->displaced);
    lobe_release(s);
    *state = NULL;
}

// ---------------------------------------------------------------------------------------------
// Which instances

static const device_material *material_of(const device_scene *scene, size_t index) {
    return &scene->materials[scene->instances[index].material];
}

static bool has_relief(const device_scene *scene, size_t index) {
    const device_material *material = material_of(scene, index);
    return material->height.image >= 0 && material->height_scale != 0;
}

static layout_key key_of(const device_scene *scene, size_t index) {
    const device_material *material = material_of(scene, index);
    const lobe_image *image = &scene->scene->images[material->height.image].image;
    const uint32_t mesh = scene->instances[index].mesh;
    layout_key key;
    memset(&key, 0, sizeof key);
    key.mesh = mesh;
    key.mesh_version = scene->measures[mesh].version;
    key.width = image->width;
    key.height = image->height;
    memcpy(&key.use, &material->height, sizeof key.use);
    key.height_scale = material->height_scale;
    return key;
}

/// Why it cannot be; NULL: it can.
static const char *obstacle(const lobe_mesh *mesh, const instance_state *state) {
    const double relief = fabs(state->key.height_scale * state->layout.unit);
    if (!mesh->has_texture_coordinates[state->key.use.texture_coordinates])
        return "the mesh has no texture coordinates";
    if (mesh->index_count / 3 > PATCH_MOST_TRIANGLES)
        return "the mesh has more than 524288 triangles";
    if (state->layout.unit == 0)
        return "its texture coordinates have no area";
    return relief < 1e18 ? NULL : "the relief is too high";
}

/// Looks at the mesh only where something has changed.
static void find_layout(displacement *state, const filter_context *context, size_t index) {
    const device_scene *scene = context->scene;
    const layout_key key = key_of(scene, index);
    instance_state *instance = &state->instances[index];
    if (memcmp(&instance->key, &key, sizeof key) == 0)
        return;
    const lobe_mesh *mesh = &scene->scene->meshes[key.mesh];
    instance->key = key;
    instance->layout = passes_patch_layout(mesh, &key.use, key.width, key.height);
    const char *reason = obstacle(mesh, instance);
    instance->displaced = !reason;
    if (reason)
        lobe_host_log(context->host, LOBE_LOG_WARNING,
                      "%s: mesh '%s' is not displaced by the height map of material '%s': %s",
                      scene->scene->name, mesh->name, material_of(scene, index)->material->name,
                      reason);
}

// ---------------------------------------------------------------------------------------------
// Before a frame

static lobe_result prepare_instance(displacement *state, const filter_context *context,
                                    device_scene *scene, size_t index) {
    instance_state *instance = &state->instances[index];
    if (!has_relief(scene, index)) {
        memset(instance, 0, sizeof *instance);
        return LOBE_OK;
    }
    const int32_t image = material_of(scene, index)->height.image;
    lobe_result result = passes_device_scene_upload_image(scene, image, context->host);
    if (result != LOBE_OK)
        return result;
    find_layout(state, context, index);
    if (!instance->displaced)
        return LOBE_OK;
    const uint32_t mesh = instance->key.mesh;
    result = passes_displaced_mesh_update(scene, mesh, &state->meshes[mesh]);
    return result == LOBE_ERROR_OUT_OF_MEMORY
               ? lobe_host_fail(context->host, result, "%s: out of memory for mesh '%s'",
                                scene->scene->name, scene->scene->meshes[mesh].name)
               : result;
}

lobe_result passes_displacement_prepare(displacement **state, const filter_context *context,
                                        device_scene *scene) {
    lobe_result result = LOBE_OK;
    if (!passes_displacement_wanted(context))
        return result;
    if (!create(state, scene) || !reserve(*state, scene->instance_count, scene->allocator))
        return lobe_host_fail(context->host, LOBE_ERROR_OUT_OF_MEMORY, "%s: out of memory",
                              scene->scene->name);
    for (size_t i = 0; result == LOBE_OK && i < scene->instance_count; i++)
        if (!scene->scene->instances[i].hidden)
            result = prepare_instance(*state, context, scene, i);
    return result;
}

// ---------------------------------------------------------------------------------------------
// A frame

static lobe_resource import_heights(const filter_context *context, int32_t image) {
    const device_scene *scene = context->scene;
    const lobe_scene_image *source = &scene->scene->images[image];
    if (!source->on_device)
        return lobe_graph_import_texture(context->graph, scene->images[image]);
    if (scene->given[image].version == 0)
        lobe_graph_fail(context->graph, LOBE_ERROR_INVALID_ARGUMENT,
                        "%s: image '%s' is on the device, but the host gave no texels in this "
                        "frame",
                        scene->scene->name, source->name);
    return scene->given[image];
}

/// Means over larger and larger squares of a height map, from level 1 on.
static const reduced_map *reduce_heights(displacement *state, const filter_context *context,
                                         int32_t index) {
    const lobe_image *image = &context->scene->scene->images[index].image;
    reduced_map *map = &state->heights[index];
    char name[64];
    if (map->resource.version > 0)
        return map;
    snprintf(name, sizeof name, "heights of image %d", (int)index);
    *map = passes_reduced_map_declare(context->graph, name, LOBE_FORMAT_R32_FLOAT, image->width,
                                      image->height, 1, true);
    passes_level_reduction_from(context->graph, map, import_heights(context, index), image->width,
                                image->height);
    return map;
}

static height_bounds bound_heights(displacement *state, const filter_context *context,
                                   int32_t index) {
    const lobe_image *image = &context->scene->scene->images[index].image;
    height_bounds *bounds = &state->bounds[index];
    if (bounds->levels == 0)
        *bounds = passes_height_bounds(context->graph, import_heights(context, index), image->width,
                                       image->height, index);
    return *bounds;
}

static void displace(displacement *state, const filter_context *context, device_scene *scene,
                     size_t index, double spacing) {
    const instance_state *instance = &state->instances[index];
    const int32_t image = instance->key.use.image;
    const reduced_map *heights = reduce_heights(state, context, image);
    displaced_mesh *mesh = &state->meshes[instance->key.mesh];
    passes_displaced_mesh_pose(context, instance->key.mesh, mesh);
    const displaced_surface surface = {
        .instance = index,
        .mesh = mesh,
        .use = &instance->key.use,
        .layout = &instance->layout,
        .relief = instance->key.height_scale * instance->layout.unit,
        .width = instance->key.width,
        .height = instance->key.height,
        .heights = import_heights(context, image),
        .height_levels = heights->resource,
        .levels = heights->levels + 1,
        .measures = passes_displaced_mesh_measure(context, instance->key.mesh, mesh,
                                                  &instance->key.use, index),
        .bounds = bound_heights(state, context, image),
        .spacing = spacing,
    };
    const patch_buffers buffers = passes_displace_patches(context, &surface);
    state->displaced[index] = (displaced_instance){surface, buffers};
    state->geometry[index] = (displaced_geometry){
        .vertices = buffers.vertices, .indices = buffers.triangles, .arguments = buffers.arguments};
    const double reach =
        fabs(surface.relief) * passes_transform_stretch(scene->scene->instances[index].transform);
    scene->displaced_reach = fmaxf(scene->displaced_reach, (float)reach);
}

/// Pixels between vertices. The reference has a vertex in every other half pixel, or every texel.
static double spacing_of(const filter_context *context, bool cpu) {
    const double asked = passes_knob_value(context, &passes_knob_pixels_per_vertex);
    if (asked > 0)
        return fmax(asked, 0.5);
    if (context->filter->supersamples)
        return 0.5;
    return cpu ? 8 : 3;
}

void passes_displacement(displacement *state, const filter_context *context, device_scene *scene,
                         bool cpu) {
    scene->displaced = NULL;
    scene->displaced_reach = 0;
    if (!state || !passes_displacement_wanted(context))
        return;
    const double spacing = spacing_of(context, cpu);
    scene->displaced_spacing = (float)spacing;
    memset(state->geometry, 0, state->instance_room * sizeof *state->geometry);
    memset(state->heights, 0, scene->scene->image_count * sizeof *state->heights);
    memset(state->bounds, 0, scene->scene->image_count * sizeof *state->bounds);
    for (size_t i = 0; i < state->mesh_count; i++)
        state->meshes[i].posed = state->meshes[i].posed_before = (lobe_resource){0};
    for (size_t i = 0; i < scene->instance_count; i++)
        if (!scene->scene->instances[i].hidden && state->instances[i].displaced)
            displace(state, context, scene, i, spacing);
    scene->displaced = state->geometry;
}

void passes_displacement_before(displacement *state, const filter_context *context) {
    const device_scene *scene = context->scene;
    for (size_t i = 0; scene->displaced && i < scene->instance_count; i++) {
        const uint32_t mesh = scene->instances[i].mesh;
        if (state->geometry[i].vertices.version == 0 || scene->previous_vertices[mesh].version == 0)
            continue;
        const displaced_instance *displaced = &state->displaced[i];
        passes_displaced_mesh_pose_before(context, mesh, &state->meshes[mesh]);
        state->geometry[i].previous_vertices =
            passes_displace_before(context, &displaced->surface, &displaced->buffers);
    }
}
