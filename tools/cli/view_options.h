#ifndef TOOLS_CLI_VIEW_OPTIONS_H
#define TOOLS_CLI_VIEW_OPTIONS_H

#include <stdbool.h>

#include <lobe/scene.h>

#include "tools/cli/options.h"

/// Options that replace a scene's camera and lights.
typedef struct view_options {
    float eye[3], target[3];
    double field_of_view; ///< vertical, degrees
    double path;          ///< part of the scene's path [0, 1]
    bool has_eye, has_target, has_field_of_view;
    option_list lights; ///< see view_option_light
} view_options;

/// Entries for an option table.
option view_option_eye(view_options *options);
option view_option_target(view_options *options);
option view_option_field_of_view(view_options *options);
option view_option_path(view_options *options);
option view_option_light(view_options *options);

/// Parses the lights. On success the caller must lobe_release `*lights` (NULL if there are none).
/// Returns 0, or the exit status after a message on standard error.
int view_options_parse_lights(const option_table *table, const view_options *options,
                              lobe_light **lights);

/// Changes the scene's camera, and takes over the lights if there are any. False, with the scene
/// unchanged, if eye and target are the same point.
bool view_options_apply(const view_options *options, lobe_light *lights, lobe_scene *scene);

#endif
