#include "tools/cli/view_options.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "scenes/animation/rig.h"

option view_option_eye(view_options *options) {
    return (option){.name = "eye",
                    .kind = OPTION_VECTOR,
                    .argument = "X,Y,Z",
                    .summary = "position of the camera, metres (default: the scene's)",
                    .target = options->eye,
                    .given = &options->has_eye};
}

option view_option_target(view_options *options) {
    return (option){.name = "target",
                    .kind = OPTION_VECTOR,
                    .argument = "X,Y,Z",
                    .summary = "point that the camera looks at, metres (default: the scene's)",
                    .target = options->target,
                    .given = &options->has_target};
}

option view_option_field_of_view(view_options *options) {
    return (option){.name = "fov",
                    .kind = OPTION_NUMBER,
                    .argument = "DEGREES",
                    .summary = "vertical field of view (default: the scene's)",
                    .target = &options->field_of_view,
                    .given = &options->has_field_of_view,
                    .minimum = 0.1,
                    .maximum = 170};
}

option view_option_path(view_options *options) {
    return (option){
        .name = "path",
        .kind = OPTION_NUMBER,
        .argument = "PART",
        .summary = "position of the camera on its path: from 0 to 1/2 it zooms "
                   "out to 64 times the distance, then it returns to 8 times and turns once around",
        .target = &options->path,
        .fallback = "0",
        .minimum = 0,
        .maximum = 1};
}

option view_option_light(view_options *options) {
    return (option){
        .name = "light",
        .kind = OPTION_LIST,
        .argument = "LIGHT",
        .summary = "replace the scene's lights: directional:DX,DY,DZ:R,G,B travels in "
                   "that direction with an illuminance in lux; point:X,Y,Z:R,G,B shines from there "
                   "with an intensity in candela",
        .target = &options->lights};
}

// ---------------------------------------------------------------------------------------------
// Lights

/// "X,Y,Z:R,G,B"
static bool parse_two_vectors(const char *text, double first[3], double second[3]) {
    char copy[256];
    size_t length = strcspn(text, ":");
    if (text[length] == '\0' || length >= sizeof copy)
        return false;
    memcpy(copy, text, length);
    copy[length] = '\0';
    return option_parse_numbers(copy, 3, first) &&
           option_parse_numbers(text + length + 1, 3, second);
}

static bool is_intensity(const double rgb[3]) {
    return rgb[0] >= 0 && rgb[1] >= 0 && rgb[2] >= 0 && rgb[0] <= 1e30 && rgb[1] <= 1e30 &&
           rgb[2] <= 1e30;
}

static void store(const double source[3], double scale, float target[3]) {
    for (int i = 0; i < 3; i++)
        target[i] = (float)(scale * source[i]);
}

static double length(const double vector[3]) {
    return sqrt(vector[0] * vector[0] + vector[1] * vector[1] + vector[2] * vector[2]);
}

/// NULL if the text is valid, else what is wrong.
static const char *parse_light(const char *text, lobe_light *light) {
    static const char directional[] = "directional:", point[] = "point:";
    double place[3], intensity[3];
    bool is_point = strncmp(text, point, strlen(point)) == 0;
    if (!is_point && strncmp(text, directional, strlen(directional)) != 0)
        return "starts neither with 'directional:' nor with 'point:'";
    const char *rest = text + (is_point ? strlen(point) : strlen(directional));
    if (!parse_two_vectors(rest, place, intensity))
        return is_point ? "is not point:X,Y,Z:R,G,B" : "is not directional:DX,DY,DZ:R,G,B";
    if (!is_intensity(intensity))
        return "has an intensity outside [0, 1e30]";
    if (!(length(place) <= 1e18) || (!is_point && !(length(place) >= 1e-18)))
        return is_point ? "is farther away than 1e18 m" : "has no usable direction";
    *light = (lobe_light){.type = is_point ? LOBE_LIGHT_POINT : LOBE_LIGHT_DIRECTIONAL};
    store(intensity, 1, light->intensity);
    if (is_point)
        store(place, 1, light->position);
    else
        store(place, 1 / length(place), light->direction);
    return NULL;
}

int view_options_parse_lights(const option_table *table, const view_options *options,
                              lobe_light **lights) {
    *lights = NULL;
    if (options->lights.count == 0)
        return 0;
    lobe_light *parsed = lobe_allocate(NULL, options->lights.count, sizeof *parsed);
    if (!parsed) {
        fprintf(stderr, "%s: out of memory\n", table->program);
        return 1;
    }
    for (size_t i = 0; i < options->lights.count; i++) {
        const char *wrong = parse_light(options->lights.values[i], &parsed[i]);
        if (wrong) {
            lobe_release(parsed);
            return options_usage_error(table, "--light: '%s' %s", options->lights.values[i], wrong);
        }
    }
    *lights = parsed;
    return 0;
}

// ---------------------------------------------------------------------------------------------
// Applying

static double distance(const float a[3], const float b[3]) {
    return length((double[3]){(double)a[0] - b[0], (double)a[1] - b[1], (double)a[2] - b[2]});
}

bool view_options_apply(const view_options *options, lobe_light *lights, lobe_scene *scene) {
    lobe_camera camera = scene->camera;
    if (options->has_eye)
        memcpy(camera.eye, options->eye, sizeof camera.eye);
    if (options->has_target)
        memcpy(camera.target, options->target, sizeof camera.target);
    if (options->has_field_of_view)
        camera.vertical_field_of_view = (float)(options->field_of_view * M_PI / 180);
    double reach = distance(camera.eye, camera.target);
    if (!(reach > 0))
        return false;
    // Otherwise a near plane meant for another distance would cut away close objects.
    if (options->has_eye || options->has_target)
        camera.near_plane = fminf(camera.near_plane, (float)(1e-3 * reach));
    // A camera of the user's does not follow an animation of the scene's.
    if (scene->rig && memcmp(&camera, &scene->camera, sizeof camera) != 0)
        scene->rig->camera_node = -1;
    scene->camera = camera;
    lobe_scene_path(scene, options->path, &camera);
    if (scene->rig && options->path > 0)
        scene->rig->camera_node = -1;
    scene->camera = camera;
    if (lights) {
        lobe_release(scene->lights);
        scene->lights = lights;
        scene->light_count = options->lights.count;
        scenes_rig_forget_lights(scene);
    }
    return true;
}
