#include <lobe/animation.h>

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "scenes/animation/channel.h"
#include "scenes/animation/posed_bounds.h"
#include "scenes/animation/posed_numbers.h"
#include "scenes/animation/rig.h"
#include "scenes/animation/transform.h"
#include "scenes/mesh/vector.h"
#include "scenes/scene/scene.h"

typedef struct node_state {
    double translation[3], rotation[4], scale[3];
    size_t first_weight;
} node_state;

/// Everything that follows from a pose, before the scene takes it.
typedef struct pose_work {
    lobe_scene *scene;
    const lobe_rig *rig;
    const lobe_host *host;
    node_state *nodes;
    double *weights;             ///< of all nodes
    double (*worlds)[16];        ///< one for each node
    double (*joints)[16];        ///< of all posed meshes, one after another
    bool *mirrored;              ///< one for each posed mesh
    size_t weight_count, widest; ///< of all nodes; of a channel
    double *values;              ///< of one channel
    lobe_material_numbers *materials;
    lobe_light_numbers *lights;
    uint32_t *material_parts, *light_parts; ///< what any animation moves of each
} pose_work;

// ---------------------------------------------------------------------------------------------
// Memory

static size_t count_joints(const lobe_rig *rig) {
    size_t count = 0;
    for (size_t i = 0; i < rig->mesh_count; i++)
        if (rig->meshes[i].skin >= 0)
            count += rig->skins[rig->meshes[i].skin].joint_count;
    return count;
}

static bool allocate_numbers(pose_work *work) {
    const lobe_allocator *allocator = lobe_host_allocator(work->host);
    const size_t materials = work->rig->material_count + 1,
                 lights = work->rig->light_number_count + 1;
    work->materials = lobe_allocate(allocator, materials, sizeof *work->materials);
    work->lights = lobe_allocate(allocator, lights, sizeof *work->lights);
    work->material_parts = lobe_allocate(allocator, materials, sizeof *work->material_parts);
    work->light_parts = lobe_allocate(allocator, lights, sizeof *work->light_parts);
    return work->materials && work->lights && work->material_parts && work->light_parts;
}

static lobe_result allocate(pose_work *work) {
    const lobe_allocator *allocator = lobe_host_allocator(work->host);
    const lobe_rig *rig = work->rig;
    work->widest = 4;
    for (size_t i = 0; i < rig->node_count; i++) {
        const size_t count = rig->nodes[i].weight_count;
        work->weight_count += count;
        work->widest = count > work->widest ? count : work->widest;
    }
    work->nodes = lobe_allocate(allocator, rig->node_count + 1, sizeof *work->nodes);
    work->weights = lobe_allocate(allocator, work->weight_count + 1, sizeof *work->weights);
    work->worlds = lobe_allocate(allocator, rig->node_count + 1, sizeof *work->worlds);
    work->joints = lobe_allocate(allocator, count_joints(rig) + 1, sizeof *work->joints);
    work->mirrored = lobe_allocate(allocator, rig->mesh_count + 1, sizeof *work->mirrored);
    work->values = lobe_allocate(allocator, work->widest, sizeof *work->values);
    if (work->nodes && work->weights && work->worlds && work->joints && work->mirrored &&
        work->values && allocate_numbers(work))
        return LOBE_OK;
    return lobe_host_fail(work->host, LOBE_ERROR_OUT_OF_MEMORY, "%s: out of memory for a pose",
                          work->scene->name);
}

static void release(pose_work *work) {
    lobe_release(work->nodes);
    lobe_release(work->weights);
    lobe_release(work->worlds);
    lobe_release(work->joints);
    lobe_release(work->mirrored);
    lobe_release(work->values);
    lobe_release(work->materials);
    lobe_release(work->lights);
    lobe_release(work->material_parts);
    lobe_release(work->light_parts);
}

// ---------------------------------------------------------------------------------------------
// Nodes, and numbers of materials and lights

static void load(const float *from, size_t count, double *to) {
    for (size_t i = 0; i < count; i++)
        to[i] = from[i];
}

static void take_rest(pose_work *work) {
    size_t first = 0;
    for (size_t i = 0; i < work->rig->node_count; i++) {
        const lobe_node *node = &work->rig->nodes[i];
        node_state *state = &work->nodes[i];
        load(node->translation, 3, state->translation);
        load(node->rotation, 4, state->rotation);
        load(node->scale, 3, state->scale);
        load(node->weights, node->weight_count, work->weights + first);
        state->first_weight = first;
        first += node->weight_count;
    }
    for (size_t i = 0; i < work->rig->material_count; i++)
        work->materials[i] = work->rig->materials[i].rest;
    for (size_t i = 0; i < work->rig->light_number_count; i++)
        work->lights[i] = work->rig->light_numbers[i];
}

/// Whatever moves in one animation is at rest in the others.
static void find_parts(pose_work *work) {
    for (size_t a = 0; a < work->rig->animation_count; a++) {
        for (size_t i = 0; i < work->rig->animations[a].channel_count; i++) {
            const lobe_animation_channel *channel = &work->rig->animations[a].channels[i];
            const channel_owner owner = scenes_channel_owner(channel->path);
            if (owner == CHANNEL_OF_MATERIAL)
                work->material_parts[channel->target] |= scenes_posed_part(channel);
            else if (owner == CHANNEL_OF_LIGHT)
                work->light_parts[channel->target] |= scenes_posed_part(channel);
        }
    }
}

static double *property(pose_work *work, const lobe_animation_channel *channel) {
    node_state *state = &work->nodes[channel->target];
    switch (channel->path) {
    case LOBE_CHANNEL_TRANSLATION:
        return state->translation;
    case LOBE_CHANNEL_ROTATION:
        return state->rotation;
    case LOBE_CHANNEL_SCALE:
        return state->scale;
    default:
        return work->weights + state->first_weight;
    }
}

/// Gives a channel's values to what it moves.
static void take_values(pose_work *work, const lobe_animation_channel *channel) {
    const channel_owner owner = scenes_channel_owner(channel->path);
    if (owner == CHANNEL_OF_NODE) {
        memcpy(property(work, channel), work->values, channel->width * sizeof *work->values);
        return;
    }
    float *numbers = scenes_posed_numbers(channel, owner == CHANNEL_OF_MATERIAL
                                                       ? (void *)&work->materials[channel->target]
                                                       : (void *)&work->lights[channel->target]);
    for (size_t i = 0; i < channel->width; i++)
        numbers[i] = (float)work->values[i];
}

static double time_in(const lobe_animation *animation, const lobe_pose *pose) {
    const double duration = animation->duration;
    if (pose->once || !(duration > 0))
        return pose->seconds;
    return pose->seconds - duration * floor(pose->seconds / duration);
}

static void apply(pose_work *work, const lobe_animation *animation, const lobe_pose *pose) {
    const double seconds = time_in(animation, pose);
    for (size_t i = 0; i < animation->channel_count; i++) {
        const lobe_animation_channel *channel = &animation->channels[i];
        scenes_channel_evaluate(channel, seconds, work->values);
        take_values(work, channel);
    }
}

static void apply_all(pose_work *work, const lobe_pose *pose) {
    const bool all = pose->animation == LOBE_ANIMATION_ALL;
    for (size_t i = 0; i < work->rig->animation_count; i++)
        if (all || i == pose->animation)
            apply(work, &work->rig->animations[i], pose);
}

static lobe_result fail_node(const pose_work *work, size_t node, lobe_result result,
                             const char *what) {
    return lobe_host_fail(work->host, result, "%s: node %zu '%s': %s", work->scene->name, node,
                          work->rig->nodes[node].name ? work->rig->nodes[node].name : "", what);
}

static lobe_result place_node(pose_work *work, size_t index) {
    const lobe_node *node = &work->rig->nodes[index];
    const node_state *state = &work->nodes[index];
    double local[16];
    if (node->has_matrix)
        load(node->matrix, 16, local);
    else if (!scenes_transform_compose(state->translation, state->rotation, state->scale, local))
        return fail_node(work, index, LOBE_ERROR_MALFORMED, "its rotation has no length");
    if (node->parent >= 0)
        scenes_transform_multiply(work->worlds[node->parent], local, work->worlds[index]);
    else
        memcpy(work->worlds[index], local, sizeof local);
    if (!scenes_transform_is_in_range(work->worlds[index]))
        return fail_node(work, index, LOBE_ERROR_LIMIT, "its transform is out of range");
    for (size_t i = 0; i < node->weight_count; i++)
        if (!(fabs(work->weights[state->first_weight + i]) <= 1e18))
            return fail_node(work, index, LOBE_ERROR_LIMIT, "a morph weight is out of range");
    return LOBE_OK;
}

// ---------------------------------------------------------------------------------------------
// Skins

static lobe_result find_joint(const pose_work *work, const lobe_skin *skin, size_t joint,
                              double out[16]) {
    double inverse_bind[16];
    load(skin->inverse_bind_matrices[joint], 16, inverse_bind);
    scenes_transform_multiply(work->worlds[skin->joints[joint]], inverse_bind, out);
    if (scenes_transform_is_in_range(out))
        return LOBE_OK;
    return lobe_host_fail(work->host, LOBE_ERROR_LIMIT,
                          "%s: skin '%s': the matrix of joint %zu is out of range",
                          work->scene->name, skin->name ? skin->name : "", joint);
}

/// Joints that mirror turn triangles over. If most of a skin do, then they take the mesh to its
/// reflection in x, and its instance reflects that.
static lobe_result find_joints(pose_work *work) {
    double(*joints)[16] = work->joints;
    for (size_t i = 0; i < work->rig->mesh_count; i++) {
        if (work->rig->meshes[i].skin < 0)
            continue;
        const lobe_skin *skin = &work->rig->skins[work->rig->meshes[i].skin];
        int64_t handedness = 0;
        for (size_t k = 0; k < skin->joint_count; k++) {
            const lobe_result result = find_joint(work, skin, k, joints[k]);
            if (result != LOBE_OK)
                return result;
            handedness += scenes_transform_handedness(joints[k]);
        }
        work->mirrored[i] = handedness < 0;
        joints += skin->joint_count;
    }
    return LOBE_OK;
}

// ---------------------------------------------------------------------------------------------
// The scene takes the pose

static void reflect(float transform[16], int first, int step) {
    for (int i = 0; i < 4; i++)
        transform[first + step * i] = -transform[first + step * i];
}

static void pose_meshes(const pose_work *work) {
    double(*joints)[16] = work->joints;
    for (size_t i = 0; i < work->rig->mesh_count; i++) {
        const lobe_posed_mesh *posed = &work->rig->meshes[i];
        lobe_mesh *mesh = &work->scene->meshes[posed->mesh];
        lobe_deformation *deformation = mesh->deformation;
        for (size_t k = 0; posed->skin >= 0 && k < deformation->joint_count; k++) {
            scenes_transform_store(*joints++, deformation->joint_matrices[k]);
            if (work->mirrored[i])
                reflect(deformation->joint_matrices[k], 0, 4);
        }
        for (size_t k = 0; posed->node >= 0 && k < deformation->target_count; k++)
            deformation->weights[k] =
                (float)work->weights[work->nodes[posed->node].first_weight + k];
        scenes_posed_bounds_set(posed, mesh);
    }
}

/// Where the instance is, of a size that can still be drawn.
static void shrink(const double world[16], float transform[16]) {
    memset(transform, 0, 16 * sizeof *transform);
    for (int axis = 0; axis < 3; axis++) {
        transform[5 * axis] = 1e-6f;
        transform[12 + axis] = (float)world[12 + axis];
    }
    transform[15] = 1;
}

static void pose_instance(const pose_work *work, lobe_posed_instance *posed) {
    lobe_instance *instance = &work->scene->instances[posed->instance];
    static const float identity[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    if (posed->skinned_mesh >= 0) {
        memcpy(instance->transform, identity, sizeof identity);
        if (work->mirrored[posed->skinned_mesh])
            instance->transform[0] = -1;
        return;
    }
    const double *world = work->worlds[posed->node];
    const bool flat = scenes_transform_handedness(world) == 0;
    if (flat != posed->flat)
        instance->hidden = flat;
    posed->flat = flat;
    if (flat)
        shrink(world, instance->transform);
    else
        scenes_transform_store(world, instance->transform);
    if (!flat && posed->reflected)
        reflect(instance->transform, 0, 1);
}

static void pose_light(const pose_work *work, const lobe_posed_light *posed) {
    lobe_light *light = &work->scene->lights[posed->light];
    if (posed->numbers >= 0)
        scenes_posed_light_set(&work->lights[posed->numbers], work->light_parts[posed->numbers],
                               light);
    if (posed->node < 0)
        return;
    const double *world = work->worlds[posed->node];
    vector3 direction = {-world[8], -world[9], -world[10]};
    if (light->type != LOBE_LIGHT_DIRECTIONAL)
        vector3_store((vector3){world[12], world[13], world[14]}, light->position);
    if (light->type != LOBE_LIGHT_POINT && vector3_normalise(&direction, 0))
        vector3_store(direction, light->direction);
}

static void pose_materials(const pose_work *work) {
    for (size_t i = 0; i < work->rig->material_count; i++) {
        lobe_posed_material *posed = &work->scene->rig->materials[i];
        if (posed->material >= 0 &&
            scenes_posed_material_set(&work->materials[i], work->material_parts[i],
                                      &work->scene->materials[posed->material]))
            ++posed->version;
    }
}

static void pose_camera(const pose_work *work) {
    lobe_camera *camera = &work->scene->camera;
    const double *world = work->worlds[work->rig->camera_node];
    vector3 eye = {world[12], world[13], world[14]}, up = {world[4], world[5], world[6]},
            back = {world[8], world[9], world[10]};
    if (!vector3_normalise(&up, 0) || !vector3_normalise(&back, 0))
        return; // scaled to nothing: it stays
    vector3_store(eye, camera->eye);
    vector3_store(up, camera->up);
    // At least as far as makes a difference in single precision.
    const double distance = fmax(work->rig->camera_distance, 1e-6 * vector3_length(eye));
    vector3_store(vector3_subtract(eye, vector3_scale(back, distance)), camera->target);
}

static void commit(const pose_work *work) {
    pose_meshes(work);
    for (size_t i = 0; i < work->rig->instance_count; i++)
        pose_instance(work, &work->rig->instances[i]);
    for (size_t i = 0; i < work->rig->light_count; i++)
        pose_light(work, &work->rig->lights[i]);
    pose_materials(work);
    if (work->rig->camera_node >= 0)
        pose_camera(work);
}

// ---------------------------------------------------------------------------------------------
// The call

static lobe_result evaluate(pose_work *work, const lobe_pose *pose) {
    lobe_result result = LOBE_OK;
    take_rest(work);
    find_parts(work);
    apply_all(work, pose);
    for (size_t i = 0; result == LOBE_OK && i < work->rig->node_count; i++)
        result = place_node(work, i);
    return result == LOBE_OK ? find_joints(work) : result;
}

static lobe_result set_pose(lobe_scene *scene, const lobe_pose *pose, const lobe_host *host) {
    pose_work work = {.scene = scene, .rig = scene->rig, .host = host};
    lobe_result result = allocate(&work);
    if (result == LOBE_OK)
        result = evaluate(&work, pose);
    if (result == LOBE_OK) {
        commit(&work);
        result = scenes_set_bounds(scene, host);
        if (result != LOBE_OK &&
            evaluate(&work, &(lobe_pose){.animation = LOBE_ANIMATION_NONE}) == LOBE_OK)
            commit(&work);
    }
    release(&work);
    return result;
}

static lobe_result check_pose(const lobe_scene *scene, const lobe_pose *pose,
                              const lobe_host *host) {
    const size_t count = scene->rig ? scene->rig->animation_count : 0;
    if (!isfinite(pose->seconds))
        return lobe_host_fail(host, LOBE_ERROR_INVALID_ARGUMENT,
                              "%s: a pose at %g s; expected a finite number", scene->name,
                              pose->seconds);
    if (pose->animation < count || pose->animation == LOBE_ANIMATION_NONE ||
        pose->animation == LOBE_ANIMATION_ALL)
        return LOBE_OK;
    return lobe_host_fail(host, LOBE_ERROR_INVALID_ARGUMENT,
                          "%s: there is no animation %zu; it has %zu", scene->name, pose->animation,
                          count);
}

lobe_result lobe_scene_set_pose(lobe_scene *scene, const lobe_pose *pose, const lobe_host *host) {
    if (!scene)
        return lobe_host_fail(host, LOBE_ERROR_INVALID_ARGUMENT,
                              "lobe_scene_set_pose: scene must not be NULL");
    const bool moves = scene->rig && scene->rig->animation_count > 0;
    const lobe_pose first = {.animation = moves ? 0 : LOBE_ANIMATION_NONE};
    pose = pose ? pose : &first;
    lobe_result result = check_pose(scene, pose, host);
    if (result == LOBE_OK && scene->rig)
        result = scenes_rig_check(scene, host);
    return result == LOBE_OK && scene->rig ? set_pose(scene, pose, host) : result;
}

static void list_names(const lobe_scene *scene, char *text, size_t size) {
    size_t length = 0;
    for (size_t i = 0; scene->rig && i < scene->rig->animation_count && length < size; i++) {
        const char *name = scene->rig->animations[i].name;
        length += (size_t)snprintf(text + length, size - length, "%s'%.64s'", i > 0 ? ", " : "",
                                   name ? name : "");
    }
    if (length == 0)
        snprintf(text, size, "none");
}

lobe_result lobe_scene_find_animation(const lobe_scene *scene, const char *name,
                                      const lobe_host *host, size_t *animation) {
    if (!scene || !name || !animation)
        return lobe_host_fail(
            host, LOBE_ERROR_INVALID_ARGUMENT,
            "lobe_scene_find_animation: scene, name and animation must not be NULL");
    for (size_t i = 0; scene->rig && scene->rig->animations && i < scene->rig->animation_count;
         i++) {
        const char *other = scene->rig->animations[i].name;
        if (other && strcmp(other, name) == 0) {
            *animation = i;
            return LOBE_OK;
        }
    }
    char names[512];
    list_names(scene, names, sizeof names);
    return lobe_host_fail(host, LOBE_ERROR_NOT_FOUND,
                          "%s: there is no animation '%.128s'; it has: %s", scene->name, name,
                          names);
}
