#include "tools/viewer/window.h"

#include <math.h>
#include <stdio.h>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include "third_party/imgui.h"
#include "tools/viewer/camera.h"
#include "tools/viewer/keys.h"
#include "tools/viewer/viewer.h"

/// Angle for a movement across the picture's height, radians.
#define TURN_OF_HEIGHT 3.0
/// A step of the wheel.
#define ZOOM 0.9
/// Distance from the divider in pixels within which it can be grabbed.
#define GRIP 6

static viewer *viewer_of(GLFWwindow *window) {
    viewer *v = glfwGetWindowUserPointer(window);
    viewer_redraw_panels(v);
    return v;
}

// ---------------------------------------------------------------------------------------------
// Mouse

bool viewer_window_is_on_divider(const viewer *v) {
    return v->look.comparison == VIEWER_SPLIT && !imgui_takes_mouse() &&
           fabs(v->cursor[0] - v->look.divider * v->view.width) <= GRIP;
}

static viewer_drag drag_of(const viewer *v, int button, int modifiers) {
    if (imgui_takes_mouse())
        return VIEWER_DRAG_NONE;
    if (button == GLFW_MOUSE_BUTTON_LEFT && viewer_window_is_on_divider(v))
        return VIEWER_DRAG_DIVIDER;
    if (button == GLFW_MOUSE_BUTTON_MIDDLE || modifiers & GLFW_MOD_SHIFT)
        return VIEWER_DRAG_PAN;
    return button == GLFW_MOUSE_BUTTON_RIGHT ? VIEWER_DRAG_LOOK : VIEWER_DRAG_ORBIT;
}

static void on_button(GLFWwindow *window, int button, int action, int modifiers) {
    viewer *v = viewer_of(window);
    if (action == GLFW_PRESS)
        v->message[0] = '\0'; // the user has read it
    v->drag = action == GLFW_PRESS ? drag_of(v, button, modifiers) : VIEWER_DRAG_NONE;
}

/// `right` and `down`: fractions of the picture's height.
static void drag(viewer *v, double right, double down) {
    lobe_camera *camera = &v->view.camera;
    if (v->drag == VIEWER_DRAG_ORBIT)
        viewer_camera_orbit(camera, -TURN_OF_HEIGHT * right, TURN_OF_HEIGHT * down);
    else if (v->drag == VIEWER_DRAG_LOOK)
        viewer_camera_look(camera, TURN_OF_HEIGHT * right, -TURN_OF_HEIGHT * down);
    else
        viewer_camera_pan(camera, -right, down);
    viewer_redraw_scene(v);
}

/// GLFW reports positions in the window's own units, which may be larger than pixels.
static void to_pixels(const viewer *v, double place[2]) {
    int width = 0, height = 0;
    glfwGetWindowSize(v->window, &width, &height);
    if (width > 0 && height > 0) {
        place[0] *= (double)v->view.width / width;
        place[1] *= (double)v->view.height / height;
    }
}

static void on_cursor(GLFWwindow *window, double x, double y) {
    viewer *v = viewer_of(window);
    double place[2] = {x, y};
    to_pixels(v, place);
    const double right = place[0] - v->cursor[0], down = place[1] - v->cursor[1];
    v->cursor[0] = place[0];
    v->cursor[1] = place[1];
    if (v->view.width == 0 || v->view.height == 0 || v->drag == VIEWER_DRAG_NONE)
        return;
    if (v->drag == VIEWER_DRAG_DIVIDER)
        v->look.divider = fmin(fmax(place[0] / v->view.width, 0), 1);
    else
        drag(v, right / v->view.height, down / v->view.height);
}

static void on_wheel(GLFWwindow *window, double x, double y) {
    viewer *v = viewer_of(window);
    (void)x;
    if (imgui_takes_mouse())
        return;
    viewer_camera_zoom(&v->view.camera, pow(ZOOM, y));
    viewer_redraw_scene(v);
}

// ---------------------------------------------------------------------------------------------
// Other events

static void on_key(GLFWwindow *window, int key, int code, int action, int modifiers) {
    viewer *v = viewer_of(window);
    (void)code, (void)modifiers;
    if (action == GLFW_PRESS)
        v->message[0] = '\0';
    if (action != GLFW_RELEASE && !imgui_takes_keys())
        viewer_keys_press(v, key);
}

static void on_drop(GLFWwindow *window, int count, const char **paths) {
    viewer *v = viewer_of(window);
    for (int i = 0; i < count; i++)
        viewer_request_opening(v, paths[i]);
}

static void on_resize(GLFWwindow *window, int width, int height) {
    (void)width, (void)height;
    viewer_of(window)->swapchain_is_stale = true;
}

static void on_scale(GLFWwindow *window, float x, float y) {
    viewer *v = viewer_of(window);
    (void)y;
    v->scale_is_stale = v->scale_is_stale || x != v->scale;
    v->scale = x;
}

static void on_refresh(GLFWwindow *window) {
    (void)viewer_of(window);
}

static void on_focus(GLFWwindow *window, int focused) {
    viewer *v = viewer_of(window);
    if (!focused)
        v->drag = VIEWER_DRAG_NONE;
}

static void listen(viewer *v) {
    glfwSetWindowUserPointer(v->window, v);
    glfwSetMouseButtonCallback(v->window, on_button);
    glfwSetCursorPosCallback(v->window, on_cursor);
    glfwSetScrollCallback(v->window, on_wheel);
    glfwSetKeyCallback(v->window, on_key);
    glfwSetDropCallback(v->window, on_drop);
    glfwSetFramebufferSizeCallback(v->window, on_resize);
    glfwSetWindowContentScaleCallback(v->window, on_scale);
    glfwSetWindowRefreshCallback(v->window, on_refresh);
    glfwSetWindowFocusCallback(v->window, on_focus);
}

/// GLFW's own reason for its last failure.
static lobe_result fail(const viewer *v, const char *what) {
    const char *why = NULL;
    glfwGetError(&why);
    return lobe_host_fail(&v->host, LOBE_ERROR_UNSUPPORTED, "window: %s: %s", what,
                          why ? why : "GLFW does not say why");
}

lobe_result viewer_window_open(viewer *v) {
    char title[256];
    if (!glfwInit())
        return fail(v, "cannot be opened");
    if (!glfwVulkanSupported())
        return fail(v, "cannot present Vulkan images");
    snprintf(title, sizeof title, "lobe - %s", v->request->scene);
    glfwWindowHint(GLFW_CLIENT_API, GLFW_NO_API);
    v->window =
        glfwCreateWindow((int)v->request->size[0], (int)v->request->size[1], title, NULL, NULL);
    if (!v->window)
        return fail(v, "cannot be opened");
    listen(v);
    float other;
    glfwGetWindowContentScale(v->window, &v->scale, &other);
    return imgui_open(v->window, v->scale) ? LOBE_OK
                                           : lobe_host_fail(&v->host, LOBE_ERROR_OUT_OF_MEMORY,
                                                            "window: panels cannot be opened");
}

void viewer_window_close(viewer *v) {
    imgui_close();
    if (v->window)
        glfwDestroyWindow(v->window);
    v->window = NULL;
    glfwTerminate();
}
