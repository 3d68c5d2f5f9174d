#ifndef TOOLS_CLI_SCENE_OPTIONS_H
#define TOOLS_CLI_SCENE_OPTIONS_H

#include <lobe/scene.h>

#include "tools/cli/options.h"

/// The options of every subcommand that takes a SCENE.
typedef struct scene_options {
    const char *assets;      ///< NULL: LOBE_ASSETS, if set; else none
    const char *environment; ///< a file, "sky" or "none"; NULL: the scene's own
    double rotation;         ///< of the environment, degrees about +Y
    double intensity;        ///< factor
    bool background;         ///< show the environment behind the scene
    bool no_lights;          ///< remove the scene's lights, keep the environment
    bool has_rotation, has_intensity;
    bool has_lights; ///< other options give the scene lights: none are added
} scene_options;

/// Entries for an option table.
option scene_option_assets(scene_options *options);
option scene_option_environment(scene_options *options);
option scene_option_rotation(scene_options *options);
option scene_option_intensity(scene_options *options);
option scene_option_background(scene_options *options);
option scene_option_no_lights(scene_options *options);

/// Size of the longest text that scene_options_describe writes, including the terminator.
#define SCENE_OPTIONS_DESCRIPTION 128

/// How the options change a scene's light apart from choosing its environment: "no lights, turned
/// by 30, intensity 2, background"; "" if they do not.
void scene_options_describe(const scene_options *options, char text[SCENE_OPTIONS_DESCRIPTION]);

/// Whether the options light the scene, so that none has to be added to one without light.
bool scene_options_give_light(const scene_options *options);

/// Applies the options to the light of an opened scene.
lobe_result scene_options_light(const scene_options *options, const lobe_host *host,
                                lobe_scene *scene);

/// Opens a scene and applies the options. A scene without a camera gets one that frames it, and its
/// first animation, in a picture of this size.
lobe_result scene_options_open(const scene_options *options, const char *scene,
                               const uint32_t size[2], const lobe_host *host, lobe_scene **result);

/// Checks that either SCENE or --material is given (NULL: it is not). Returns 0, or the exit status
/// after a message on standard error.
int scene_options_check_source(const option_table *table, const char *scene, const char *material);

/// Opens a folder of PBR maps on a carrier, and applies the options.
lobe_result scene_options_open_material(const scene_options *options, const char *folder,
                                        lobe_carrier carrier, const lobe_host *host,
                                        lobe_scene **result);

/// Whether `result`, from opening `scene`, only means that its assets are missing, so that other
/// scenes can still be measured.
bool scene_options_lack_assets(const char *scene, lobe_result result);

#endif
