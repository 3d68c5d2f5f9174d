#ifndef TOOLS_VIEWER_VIEWER_H
#define TOOLS_VIEWER_VIEWER_H

#include <stdbool.h>

#include <lobe/lobe.h>

#include "tools/cli/cache_options.h"
#include "tools/cli/device_options.h"
#include "tools/cli/scene_options.h"
#include "tools/cli/view_options.h"
#include "tools/viewer/frame.h"
#include "tools/viewer/graphics/display.h"

/// The command line.
typedef struct viewer_request {
    const char *scene;
    const lobe_filter *filter;
    lobe_settings settings;
    uint32_t size[2];
    uint32_t frames; ///< to draw at least, before the window may idle
    bool exit;       ///< close the window after those
    uint32_t samples, path_frames;
    const char *animation; ///< which of the first scene; NULL: its first
    double exposure;
    const char *folder; ///< of recorded frames
    scene_options opening;
    view_options view;
    lobe_light *lights; ///< NULL: the scene's own; the viewer frees them
    cache_options cache;
    device_options device;
} viewer_request;

/// What the mouse does while a button is held.
typedef enum viewer_drag {
    VIEWER_DRAG_NONE,
    VIEWER_DRAG_ORBIT,
    VIEWER_DRAG_PAN,
    VIEWER_DRAG_LOOK,
    VIEWER_DRAG_DIVIDER,
} viewer_drag;

/// One of the scene's lights, as the panel shows it.
typedef struct viewer_light {
    bool on;
    double intensity, initial; ///< of a channel at full colour: now, and the scene's own
    float colour[3];           ///< as displayed: encoded for sRGB, [0, 1]
    /// Where light comes from, in degrees: around +Y, from +Z towards +X, and above the horizon. Of
    /// a point light its place, as seen from the middle of the scene.
    double heading, height;
} viewer_light;

#define VIEWER_MESSAGE_SIZE 512

/// Frames drawn after an input: panels need one to see the mouse, one to act, one to show the
/// result.
#define VIEWER_REDRAWS 3

/// The whole program, from open to close.
typedef struct viewer {
    const viewer_request *request;
    lobe_host console;
    lobe_host host; ///< writes to the console, and warnings to `message`
    char message[VIEWER_MESSAGE_SIZE];
    struct GLFWwindow *window;
    viewer_device device;
    viewer_swapchain swapchain;
    viewer_display display;
    viewer_frame frame;
    viewer_view view;
    char cache_folder[CACHE_FOLDER_SIZE];     ///< `view.cache` may point to it
    char fit_cache_folder[CACHE_FOLDER_SIZE]; ///< `view.fit_cache` may point to it
    viewer_look look;
    viewer_side sides[2];
    lobe_scene *scene;
    viewer_light *lights; ///< of the scene
    size_t light_count;
    size_t light;               ///< the one on the panel
    char *wanted_scene;         ///< to open before the next frame; NULL: none
    char *wanted_environment;   ///< the same
    unsigned frames_to_opening; ///< frames to draw before that
    bool opens;                 ///< the message is about opening
    scene_options opening;      ///< how scenes are lit
    double turned;              ///< degrees by which the user has turned the scene's environment
    char *environment; ///< chosen by the user for all scenes; NULL: that of the command line
    bool shows_panel, shows_help;
    bool swapchain_is_stale;
    float scale; ///< of panels: 1 for 96 dots per inch
    bool scale_is_stale;
    bool waits;            ///< the last frame found nothing more to do
    unsigned redraws;      ///< to draw although nothing changed: panels need some frames to settle
    uint32_t frames_drawn; ///< up to the number requested
    size_t stale_shaders;  ///< saved, but not used by the last frame
    bool reloads;          ///< the last check found more of them
    // Mouse and keys.
    viewer_drag drag;
    double cursor[2]; ///< pixels of the window's content
    double last_time; ///< of the last frame, seconds
    bool time_runs;   ///< in a scene that changes with time
    // The camera's path.
    bool plays, records_path, records_frame, steps;
    uint32_t path_frame;
    unsigned losses; ///< of the device or the surface, since a frame was last shown
} viewer;

/// Opens the window and shows the scene until the window is closed. Logs a message if it fails.
lobe_result viewer_run(const viewer_request *request, const lobe_host *console);

// ---------------------------------------------------------------------------------------------
// Actions of keys and panels

/// Redraws the scene in the next frame: camera, knobs or light have changed.
void viewer_redraw_scene(viewer *v);
/// Redraws the panels in the next frames.
void viewer_redraw_panels(viewer *v);
/// Shows a message in the window.
void viewer_show_message(viewer *v, const char *text);
/// Sets the time in a scene that changes with time, [0, ANIMATION_MAXIMUM_SECONDS]. A camera that
/// is where the scene's is follows it.
void viewer_set_time(viewer *v, double seconds);
/// Chooses one of the scene's animations, or LOBE_ANIMATION_ALL.
void viewer_set_animation(viewer *v, size_t index);
/// Switches to the scene's own camera.
void viewer_reset_camera(viewer *v);
/// Changes the filter of a side. Its knobs get their defaults, except those with the same name as
/// in the old filter, which keep their values.
void viewer_set_filter(viewer_side *side, const lobe_filter *filter);
void viewer_set_comparison(viewer *v, viewer_comparison comparison);
/// Opens a scene (a name, a file or a folder) before the next frame, or an environment if the name
/// has that extension. The text is copied.
void viewer_request_opening(viewer *v, const char *path);
/// Lights the scene by a file, "sky" or "none" from the next frame on. The text is copied.
void viewer_request_light(viewer *v, const char *environment);
/// Moves the camera to a frame of its path.
void viewer_go_to(viewer *v, uint32_t path_frame);
/// Starts or ends recording the camera's path.
void viewer_record_path(viewer *v, bool on);

#endif
