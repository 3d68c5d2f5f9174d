#include <math.h>
#include <stdio.h>

#include "scenes/animation/transform.h"
#include "scenes/gltf/gltf.h"

static lobe_result out_of_memory(const gltf_import *import, int skin) {
    return lobe_host_fail(import->host, LOBE_ERROR_OUT_OF_MEMORY, "%s: skin %d: out of memory",
                          import->path, skin);
}

static lobe_result read_joints(const gltf_import *import, int index, lobe_skin *skin) {
    const gltf_skin *from = &import->document->skins[index];
    for (size_t i = 0; i < from->joint_count; i++) {
        if (from->joints[i] < 0 || (size_t)from->joints[i] >= import->document->node_count)
            return lobe_host_fail(import->host, LOBE_ERROR_MALFORMED,
                                  "%s: skin %d: joint %zu: there is no node %d", import->path,
                                  index, i, from->joints[i]);
        skin->joints[i] = import->rig_nodes[from->joints[i]];
    }
    return LOBE_OK;
}

static bool is_sound(const float matrix[16]) {
    double m[16];
    for (int i = 0; i < 16; i++)
        m[i] = matrix[i];
    return scenes_transform_is_in_range(m) && scenes_transform_is_affine(m);
}

/// glTF 2.0, section 3.7.3.1: without matrices, they are identities.
static lobe_result read_matrices(const gltf_import *import, int index, lobe_skin *skin) {
    const gltf_skin *from = &import->document->skins[index];
    char what[64];
    gltf_elements elements;
    for (size_t i = 0; i < skin->joint_count; i++)
        for (int k = 0; k < 4; k++)
            skin->inverse_bind_matrices[i][5 * k] = 1;
    if (from->inverse_bind_matrices < 0)
        return LOBE_OK;
    snprintf(what, sizeof what, "inverse bind matrices of skin %d", index);
    lobe_result result =
        scenes_gltf_open_matrices(import, from->inverse_bind_matrices, what, &elements);
    if (result != LOBE_OK)
        return result;
    if (elements.count < skin->joint_count)
        return lobe_host_fail(import->host, LOBE_ERROR_MALFORMED, "%s: %s: %zu for %zu joints",
                              import->path, what, elements.count, skin->joint_count);
    for (size_t i = 0; i < skin->joint_count; i++) {
        scenes_gltf_read_matrix(&elements, i, skin->inverse_bind_matrices[i]);
        if (!is_sound(skin->inverse_bind_matrices[i]))
            return lobe_host_fail(import->host, LOBE_ERROR_MALFORMED,
                                  "%s: %s: that of joint %zu is not affine, or out of range",
                                  import->path, what, i);
    }
    return LOBE_OK;
}

static lobe_result add_skin(gltf_import *import, int index, int32_t *converted) {
    const lobe_allocator *allocator = lobe_host_allocator(import->host);
    const gltf_skin *from = &import->document->skins[index];
    lobe_rig *rig = import->scene->rig;
    // Room for all of the file's skins is made when the rig is.
    lobe_skin *skin = &rig->skins[rig->skin_count];
    if (from->joint_count == 0 || from->joint_count > LOBE_MAXIMUM_JOINTS)
        return lobe_host_fail(import->host, LOBE_ERROR_MALFORMED,
                              "%s: skin %d: %zu joints; expected 1 to %d", import->path, index,
                              from->joint_count, LOBE_MAXIMUM_JOINTS);
    *converted = (int32_t)rig->skin_count++;
    skin->joint_count = from->joint_count;
    skin->name = lobe_copy_text(allocator, from->name);
    skin->joints = lobe_allocate(allocator, from->joint_count, sizeof *skin->joints);
    skin->inverse_bind_matrices =
        lobe_allocate(allocator, from->joint_count, sizeof *skin->inverse_bind_matrices);
    if (!skin->name || !skin->joints || !skin->inverse_bind_matrices)
        return out_of_memory(import, index);
    lobe_result result = read_joints(import, index, skin);
    return result == LOBE_OK ? read_matrices(import, index, skin) : result;
}

lobe_result scenes_gltf_convert_skin(gltf_import *import, int skin, int32_t *converted) {
    if ((size_t)skin >= import->document->skin_count)
        return lobe_host_fail(import->host, LOBE_ERROR_MALFORMED, "%s: there is no skin %d",
                              import->path, skin);
    if (import->skins[skin] == GLTF_NOT_CONVERTED) {
        const lobe_result result = add_skin(import, skin, &import->skins[skin]);
        if (result != LOBE_OK)
            return result;
    }
    *converted = import->skins[skin];
    return LOBE_OK;
}
