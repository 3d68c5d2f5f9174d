#ifndef TOOLS_SCENE_OPTIONS_H
#define TOOLS_SCENE_OPTIONS_H

#include <lobe/scene.h>

#include "tools/options.h"

/// The options of every subcommand that takes a SCENE.
typedef struct scene_options {
    const char *assets; ///< NULL: the environment variable LOBE_ASSETS, or else none
} scene_options;

/// An entry for an option table.
option scene_option_assets(scene_options *options);

/// Opens a scene, with the camera that fits a picture of this size where it brings none.
lobe_result scene_options_open(const scene_options *options, const char *scene,
                               const uint32_t size[2], const lobe_log *log, lobe_scene **result);

/// Whether `result`, of opening `scene`, only says that there are no assets for it: then others can
/// still be measured.
bool scene_options_lack_assets(const char *scene, lobe_result result);

#endif
