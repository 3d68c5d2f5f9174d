#include "tools/scene_options.h"

#include <stdlib.h>
#include <string.h>

option scene_option_assets(scene_options *options) {
    return (option){
        .name = "assets",
        .kind = OPTION_TEXT,
        .argument = "DIR",
        .summary = "the folder that holds models/, which some built-in scenes need (default: "
                   "environment variable LOBE_ASSETS)",
        .target = &options->assets,
    };
}

lobe_result scene_options_open(const scene_options *options, const char *scene,
                               const uint32_t size[2], const lobe_log *log, lobe_scene **result) {
    const char *assets = options->assets ? options->assets : getenv("LOBE_ASSETS");
    if (assets && assets[0] == '\0')
        assets = NULL;
    lobe_result status = lobe_scene_open_with(
        &(lobe_scene_open_parameters){.scene = scene, .assets = assets}, log, result);
    if (status == LOBE_OK && !(*result)->has_camera)
        lobe_scene_frame(*result, (double)size[0] / size[1], &(*result)->camera);
    return status;
}

bool scene_options_lack_assets(const char *scene, lobe_result result) {
    for (size_t i = 0; result == LOBE_ERROR_NOT_FOUND && i < lobe_builtin_scene_count(); ++i) {
        const lobe_builtin_scene *builtin = lobe_builtin_scene_get(i);
        if (strcmp(builtin->name, scene) == 0)
            return builtin->needs_assets;
    }
    return false;
}
