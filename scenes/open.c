#include <errno.h>
#include <stdbool.h>
#include <sys/stat.h>
#include <unistd.h>

#include <lobe/scene.h>

#include "scenes/builtin/builtin.h"
#include "scenes/gltf/gltf.h"
#include "scenes/material/folder.h"

static bool is_absent(const char *path) {
    return access(path, F_OK) != 0 && errno != EACCES;
}

static bool is_folder(const char *path) {
    struct stat status;
    return stat(path, &status) == 0 && S_ISDIR(status.st_mode);
}

static lobe_result open_material(const lobe_scene_open_parameters *parameters,
                                 const lobe_host *host, lobe_scene **result) {
    const lobe_carrier carrier = *parameters->carrier;
    if ((unsigned)carrier > LOBE_CARRIER_CLOTH)
        return lobe_host_fail(host, LOBE_ERROR_INVALID_ARGUMENT, "%s: there is no carrier %d",
                              parameters->scene, (int)carrier);
    return scenes_material_open(parameters, carrier, host, result);
}

lobe_result lobe_scene_open_with(const lobe_scene_open_parameters *parameters,
                                 const lobe_host *host, lobe_scene **result) {
    if (result)
        *result = NULL;
    if (!parameters || !parameters->scene || !result)
        return lobe_host_fail(
            host, LOBE_ERROR_INVALID_ARGUMENT,
            "lobe_scene_open_with: parameters, their scene (a name) and result must not be NULL");
    const char *scene = parameters->scene;
    if (parameters->data)
        return scenes_gltf_open(parameters, host, result);
    if (parameters->carrier)
        return open_material(parameters, host, result);
    const builtin_scene *builtin = scenes_builtin_find(scene);
    if (builtin)
        return builtin->build(host, result);
    if (parameters->files)
        return scenes_gltf_open(parameters, host, result);
    if (is_absent(scene))
        return lobe_host_fail(host, LOBE_ERROR_NOT_FOUND,
                              "%s: neither a built-in scene nor a file or folder", scene);
    if (is_folder(scene))
        return scenes_material_open(parameters, LOBE_CARRIER_CLOTH, host, result);
    return scenes_gltf_open(parameters, host, result);
}

lobe_result lobe_scene_open(const char *scene, const lobe_host *host, lobe_scene **result) {
    return lobe_scene_open_with(&(lobe_scene_open_parameters){.scene = scene}, host, result);
}

lobe_result lobe_scene_open_material(const char *folder, lobe_carrier carrier,
                                     const lobe_host *host, lobe_scene **result) {
    const lobe_scene_open_parameters parameters = {.scene = folder, .carrier = &carrier};
    return lobe_scene_open_with(&parameters, host, result);
}
