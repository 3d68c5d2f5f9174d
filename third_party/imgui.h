#ifndef THIRD_PARTY_IMGUI_H
#define THIRD_PARTY_IMGUI_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/// A C interface to the panels of Dear ImGui: widgets are declared again in each frame, and return
/// whether the user changed something. There is one set of panels at a time, for one window. A
/// frame ends as triangles, which the caller draws.

/// The GLFW window whose mouse and keys the panels receive.
struct GLFWwindow;

/// A corner of a triangle.
typedef struct imgui_vertex {
    float position[2];            ///< pixels of the window's content, from the top left corner
    float texture_coordinates[2]; ///< on the font's picture
    uint32_t colour;              ///< R, G, B, A from the lowest byte on; sRGB, straight alpha
} imgui_vertex;

/// Triangles with a common clip rectangle.
typedef struct imgui_batch {
    uint32_t first, count; ///< vertices; three per triangle
    float clip[4];         ///< left, top, right, bottom in pixels
} imgui_batch;

/// Starts the panels. `scale`: of text and widgets, 1 for 96 dots per inch. The window's own
/// callbacks are still called. False: out of memory.
bool imgui_open(struct GLFWwindow *window, float scale);
void imgui_close(void);

/// Changes the scale of text and widgets; call between frames. False: out of memory.
bool imgui_rescale(float scale);

/// The font's picture, one byte of coverage per texel; valid until imgui_rescale or imgui_close.
const uint8_t *imgui_font(uint32_t *width, uint32_t *height);

void imgui_begin_frame(void);
/// Each frame that is begun must be ended.
void imgui_end_frame(void);
/// The triangles of the last frame that ended, valid until the next one ends. Returns the number of
/// batches.
size_t imgui_triangles(const imgui_vertex **vertices, size_t *vertex_count,
                       const imgui_batch **batches);

/// Whether the mouse is over a panel or drags part of one.
bool imgui_takes_mouse(void);
/// Within a frame: shows the pointer for dragging left and right.
void imgui_show_drag_pointer(void);
/// Whether a number is being typed.
bool imgui_takes_keys(void);

// ---------------------------------------------------------------------------------------------
// Widgets. A name is shown in front of its widget, and must be unique within a section.

/// A panel with this position and size; pixels. A width of 0: as large as its content, but at most
/// this high. Always end it.
void imgui_begin_panel(const char *name, const float place[2], const float size[2]);
/// A panel as high as its content, with its lower left corner at this position; pixels.
void imgui_begin_note(const char *name, const float place[2], float width);
/// A panel as high as its content, up to a maximum, with its upper right corner at this position;
/// pixels.
void imgui_begin_list(const char *name, const float place[2], float width, float maximum_height);
void imgui_end_panel(void);
/// Widgets until the end may reuse names from outside of it. May be nested.
void imgui_begin_group(const char *name);
void imgui_end_group(void);
/// A heading that folds the widgets below it; false: they are folded.
bool imgui_section(const char *title, bool open);

void imgui_text(const char *text);       ///< broken into lines at the panel's edge
void imgui_faint_text(const char *text); ///< the same
/// A line of a table: text to the left, and to the right.
void imgui_line(const char *left, const char *right);
void imgui_indented_line(const char *left, const char *right);
/// A name and, in a column beside it, its meaning.
void imgui_term(const char *name, const char *meaning);
void imgui_space(void);
/// A tooltip for the widget before.
void imgui_tooltip(const char *text);

bool imgui_button(const char *name);
bool imgui_checkbox(const char *name, bool *value);
bool imgui_choice(const char *name, const char *const *choices, size_t count, size_t *index);
bool imgui_number(const char *name, double minimum, double maximum, double *value);
bool imgui_integer(const char *name, int minimum, int maximum, int *value);
/// A colour as displayed, [0, 1] each.
bool imgui_colour(const char *name, float colour[3]);
/// Puts the next widget on the same line.
void imgui_same_line(void);

#ifdef __cplusplus
}
#endif

#endif
