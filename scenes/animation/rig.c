#include "scenes/animation/rig.h"

#include "scenes/animation/posed_numbers.h"

static void free_nodes(lobe_rig *rig) {
    for (size_t i = 0; rig->nodes && i < rig->node_count; i++) {
        lobe_release(rig->nodes[i].name);
        lobe_release(rig->nodes[i].weights);
    }
    lobe_release(rig->nodes);
}

static void free_skins(lobe_rig *rig) {
    for (size_t i = 0; rig->skins && i < rig->skin_count; i++) {
        lobe_release(rig->skins[i].name);
        lobe_release(rig->skins[i].joints);
        lobe_release(rig->skins[i].inverse_bind_matrices);
    }
    lobe_release(rig->skins);
}

static void free_animation(lobe_animation *animation) {
    for (size_t i = 0; animation->channels && i < animation->channel_count; i++) {
        lobe_release(animation->channels[i].times);
        lobe_release(animation->channels[i].values);
    }
    lobe_release(animation->channels);
    lobe_release(animation->name);
}

void scenes_rig_free(lobe_rig **rig) {
    lobe_rig *old = *rig;
    *rig = NULL;
    if (!old)
        return;
    free_nodes(old);
    free_skins(old);
    for (size_t i = 0; old->animations && i < old->animation_count; i++)
        free_animation(&old->animations[i]);
    for (size_t i = 0; old->meshes && i < old->mesh_count; i++) {
        lobe_release(old->meshes[i].joint_bounds);
        lobe_release(old->meshes[i].target_bounds);
    }
    lobe_release(old->animations);
    lobe_release(old->instances);
    lobe_release(old->meshes);
    lobe_release(old->lights);
    lobe_release(old->light_numbers);
    lobe_release(old->materials);
    lobe_release(old);
}

void scenes_rig_forget_lights(lobe_scene *scene) {
    if (scene->rig)
        scene->rig->light_count = 0;
}

// ---------------------------------------------------------------------------------------------
// Checks

/// An index into `count` things, or -1.
static bool is_index(int32_t index, size_t count) {
    return index >= -1 && (index < 0 || (size_t)index < count);
}

static bool are_nodes_sound(const lobe_rig *rig, size_t *bad) {
    for (size_t i = 0; i < rig->node_count; i++) {
        const lobe_node *node = &rig->nodes[i];
        *bad = i;
        if (node->parent < -1 || node->parent >= (int64_t)i ||
            (node->weight_count > 0 && !node->weights))
            return false;
    }
    return true;
}

static bool are_skins_sound(const lobe_rig *rig, size_t *bad) {
    for (size_t i = 0; i < rig->skin_count; i++) {
        const lobe_skin *skin = &rig->skins[i];
        *bad = i;
        if (skin->joint_count == 0 || skin->joint_count > LOBE_MAXIMUM_JOINTS || !skin->joints ||
            !skin->inverse_bind_matrices)
            return false;
        for (size_t k = 0; k < skin->joint_count; k++)
            if (skin->joints[k] >= rig->node_count)
                return false;
    }
    return true;
}

/// How many there are of what the path moves.
static size_t target_count(const lobe_rig *rig, lobe_channel_path path) {
    switch (scenes_channel_owner(path)) {
    case CHANNEL_OF_MATERIAL:
        return rig->material_count;
    case CHANNEL_OF_LIGHT:
        return rig->light_number_count;
    default:
        return rig->node_count;
    }
}

static bool is_channel_sound(const lobe_rig *rig, const lobe_animation_channel *channel) {
    if ((unsigned)channel->path >= LOBE_CHANNEL_PATH_COUNT ||
        (unsigned)channel->map >= LOBE_POSED_MAP_COUNT ||
        channel->target >= target_count(rig, channel->path) ||
        (unsigned)channel->interpolation > LOBE_INTERPOLATION_CUBIC || channel->key_count == 0 ||
        !channel->times || !channel->values)
        return false;
    const size_t width = channel->path == LOBE_CHANNEL_WEIGHTS
                             ? rig->nodes[channel->target].weight_count
                             : scenes_channel_width(channel->path);
    return channel->width == width;
}

static bool are_animations_sound(const lobe_rig *rig, size_t *bad) {
    for (size_t i = 0; i < rig->animation_count; i++) {
        const lobe_animation *animation = &rig->animations[i];
        *bad = i;
        if (animation->channel_count > 0 && !animation->channels)
            return false;
        for (size_t k = 0; k < animation->channel_count; k++)
            if (!is_channel_sound(rig, &animation->channels[k]))
                return false;
    }
    return true;
}

static bool are_instances_sound(const lobe_scene *scene, size_t *bad) {
    const lobe_rig *rig = scene->rig;
    for (size_t i = 0; i < rig->instance_count; i++) {
        const lobe_posed_instance *posed = &rig->instances[i];
        *bad = i;
        if (posed->instance >= scene->instance_count || !is_index(posed->node, rig->node_count) ||
            !is_index(posed->skinned_mesh, rig->mesh_count) ||
            (posed->skinned_mesh >= 0) == (posed->node >= 0))
            return false;
    }
    return true;
}

static bool are_meshes_sound(const lobe_scene *scene, size_t *bad) {
    const lobe_rig *rig = scene->rig;
    for (size_t i = 0; i < rig->mesh_count; i++) {
        const lobe_posed_mesh *posed = &rig->meshes[i];
        *bad = i;
        if (posed->mesh >= scene->mesh_count || !is_index(posed->skin, rig->skin_count) ||
            !is_index(posed->node, rig->node_count))
            return false;
        const lobe_deformation *deformation = scene->meshes[posed->mesh].deformation;
        if (!deformation || (deformation->target_count > 0 && !deformation->weights) ||
            (deformation->joint_count > 0 && !deformation->joint_matrices))
            return false;
        if (posed->skin >= 0 && rig->skins[posed->skin].joint_count != deformation->joint_count)
            return false;
        if (posed->node >= 0 && rig->nodes[posed->node].weight_count != deformation->target_count)
            return false;
    }
    return true;
}

static bool are_lights_sound(const lobe_scene *scene, size_t *bad) {
    const lobe_rig *rig = scene->rig;
    for (size_t i = 0; i < rig->light_count; i++) {
        *bad = i;
        if (rig->lights[i].light >= scene->light_count ||
            !is_index(rig->lights[i].node, rig->node_count) ||
            !is_index(rig->lights[i].numbers, rig->light_number_count))
            return false;
    }
    return true;
}

static bool are_materials_sound(const lobe_scene *scene, size_t *bad) {
    for (size_t i = 0; i < scene->rig->material_count; i++) {
        *bad = i;
        if (!is_index(scene->rig->materials[i].material, scene->material_count))
            return false;
    }
    return true;
}

static bool have_memory(const lobe_rig *rig) {
    return (rig->nodes || rig->node_count == 0) && (rig->skins || rig->skin_count == 0) &&
           (rig->animations || rig->animation_count == 0) &&
           (rig->instances || rig->instance_count == 0) && (rig->meshes || rig->mesh_count == 0) &&
           (rig->lights || rig->light_count == 0) &&
           (rig->light_numbers || rig->light_number_count == 0) &&
           (rig->materials || rig->material_count == 0);
}

lobe_result scenes_rig_check(const lobe_scene *scene, const lobe_host *host) {
    const lobe_rig *rig = scene->rig;
    const char *what = NULL;
    size_t bad = 0;
    if (!have_memory(rig))
        what = "array";
    else if (!are_nodes_sound(rig, &bad))
        what = "node";
    else if (!are_skins_sound(rig, &bad))
        what = "skin";
    else if (!are_animations_sound(rig, &bad))
        what = "animation";
    else if (!are_instances_sound(scene, &bad))
        what = "instance";
    else if (!are_meshes_sound(scene, &bad))
        what = "mesh";
    else if (!are_lights_sound(scene, &bad))
        what = "light";
    else if (!are_materials_sound(scene, &bad))
        what = "material";
    else if (!is_index(rig->camera_node, rig->node_count))
        what = "camera";
    return !what ? LOBE_OK
                 : lobe_host_fail(host, LOBE_ERROR_MALFORMED,
                                  "%s: rig: %s %zu refers to what is not there, or to what does "
                                  "not fit",
                                  scene->name, what, bad);
}
