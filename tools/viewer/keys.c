#include "tools/viewer/viewer.h"

#include <math.h>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include "tools/viewer/camera.h"
#include "tools/viewer/keys.h"

/// Angle per press of an arrow key, radians.
#define TURN 0.1
/// Speed of flight: fractions of the distance to the target per second.
#define SPEED 0.8

static void toggle_help(viewer *v) {
    v->shows_help = !v->shows_help;
}

static void toggle_panel(viewer *v) {
    v->shows_panel = !v->shows_panel;
}

static void next_comparison(viewer *v) {
    viewer_set_comparison(v, (viewer_comparison)((v->look.comparison + 1) % 3));
}

static void next_filter(viewer *v) {
    for (size_t i = 0; i < lobe_filter_count(); i++) {
        if (lobe_filter_get(i) != v->sides[0].filter)
            continue;
        viewer_set_filter(&v->sides[0], lobe_filter_get((i + 1) % lobe_filter_count()));
        return;
    }
}

static void next_output(viewer *v) {
    for (int i = 0; i < 2; i++) {
        v->sides[i].output = (viewer_output)((v->sides[i].output + 1) % 3);
        v->sides[i].stale = true;
    }
}

static void turn_left(viewer *v) {
    viewer_camera_orbit(&v->view.camera, -TURN, 0);
    viewer_redraw_scene(v);
}

static void turn_right(viewer *v) {
    viewer_camera_orbit(&v->view.camera, TURN, 0);
    viewer_redraw_scene(v);
}

static void turn_up(viewer *v) {
    viewer_camera_orbit(&v->view.camera, 0, TURN);
    viewer_redraw_scene(v);
}

static void turn_down(viewer *v) {
    viewer_camera_orbit(&v->view.camera, 0, -TURN);
    viewer_redraw_scene(v);
}

static void brighten(viewer *v) {
    v->look.exposure = fmin(v->look.exposure + 0.5, VIEWER_MAXIMUM_EXPOSURE);
}

static void darken(viewer *v) {
    v->look.exposure = fmax(v->look.exposure - 0.5, -VIEWER_MAXIMUM_EXPOSURE);
}

static void play(viewer *v) {
    v->plays = !v->plays;
}

static void step(viewer *v) {
    v->plays = false;
    v->steps = true;
}

static void stop_time(viewer *v) {
    v->time_runs = !v->time_runs;
}

static void record_frame(viewer *v) {
    v->records_frame = true;
}

static void record_path(viewer *v) {
    viewer_record_path(v, !v->records_path);
}

static void leave(viewer *v) {
    glfwSetWindowShouldClose(v->window, GLFW_TRUE);
}

const viewer_key viewer_keys[] = {
    {0, "left button", "turns the camera around what it looks at, or moves the divider", NULL},
    {0, "middle button", "moves the camera across the view; so does the left button with shift",
     NULL},
    {0, "right button", "turns the view around the camera", NULL},
    {0, "wheel", "zooms in, zooms out", NULL},
    {0, "W A S D Q E",
     "flies forwards, left, backwards, right, down, up while it is held; faster "
     "with shift",
     NULL},
    {GLFW_KEY_LEFT, "arrow left", "turns the camera around the scene", turn_left},
    {GLFW_KEY_RIGHT, "arrow right", "turns it the other way", turn_right},
    {GLFW_KEY_UP, "arrow up", "raises the camera", turn_up},
    {GLFW_KEY_DOWN, "arrow down", "lowers it", turn_down},
    {GLFW_KEY_HOME, "Home", "goes back to the scene's own camera", viewer_reset_camera},
    {GLFW_KEY_F1, "F1", "shows or hides these keys", toggle_help},
    {GLFW_KEY_TAB, "Tab", "shows or hides the panel", toggle_panel},
    {GLFW_KEY_F, "F", "takes the next filter", next_filter},
    {GLFW_KEY_C, "C", "compares: one picture, two beside each other, their difference",
     next_comparison},
    {GLFW_KEY_V, "V", "shows radiance, normals or depth", next_output},
    {GLFW_KEY_EQUAL, "=", "brightens the picture by half a stop", brighten},
    {GLFW_KEY_MINUS, "-", "darkens it", darken},
    {GLFW_KEY_SPACE, "Space", "moves the camera along its path, or pauses", play},
    {GLFW_KEY_PERIOD, ".", "takes one step along the path", step},
    {GLFW_KEY_T, "T", "stops time in a scene that changes, or lets it go on", stop_time},
    {GLFW_KEY_R, "R", "records the frame as OpenEXR", record_frame},
    {GLFW_KEY_P, "P", "records the whole path, one file per frame; again: stops", record_path},
    {GLFW_KEY_ESCAPE, "Escape", "closes the window", leave},
};
const size_t viewer_key_count = sizeof viewer_keys / sizeof *viewer_keys;

void viewer_keys_press(viewer *v, int key) {
    for (size_t i = 0; i < viewer_key_count; i++)
        if (viewer_keys[i].key == key && viewer_keys[i].press)
            viewer_keys[i].press(v);
}

static double held(const viewer *v, int key) {
    return glfwGetKey(v->window, key) == GLFW_PRESS;
}

bool viewer_keys_fly(const viewer *v, double seconds, double steps[3]) {
    const bool fast = held(v, GLFW_KEY_LEFT_SHIFT) > 0 || held(v, GLFW_KEY_RIGHT_SHIFT) > 0;
    const double size = seconds * SPEED * (fast ? 4 : 1);
    const double directions[3] = {
        held(v, GLFW_KEY_D) - held(v, GLFW_KEY_A),
        held(v, GLFW_KEY_E) - held(v, GLFW_KEY_Q),
        held(v, GLFW_KEY_W) - held(v, GLFW_KEY_S),
    };
    bool any = false;
    for (int i = 0; i < 3; i++) {
        steps[i] = size * directions[i];
        any = any || directions[i] != 0;
    }
    return any;
}
