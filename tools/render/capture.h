#ifndef TOOLS_RENDER_CAPTURE_H
#define TOOLS_RENDER_CAPTURE_H

#include <stdbool.h>

#include <lobe/device.h>
#include <lobe/exr.h>
#include <lobe/filter.h>
#include <lobe/profile.h>
#include <lobe/renderer.h>

/// A rendered frame with all its metadata.
typedef struct capture {
    const lobe_frame *frame;
    const char *scene;
    const char *environment; ///< its name; NULL: none
    const lobe_filter *filter;
    const lobe_settings *settings;
    uint32_t samples; ///< a pixel
    const lobe_device_information *device;
    const lobe_profile_summary *times;
    bool animated;        ///< the scene changes with time
    double seconds;       ///< its time, if so
    bool first_frame;     ///< the times include compiling shaders
    lobe_exr_depth depth; ///< of the radiance; other layers are float
    double exposure;      ///< stops, PNG only
} capture;

/// Writes linear radiance as OpenEXR: layers for the frame's other outputs (normal, depth, lobes,
/// level, motion), everything else as attributes of the header.
lobe_result capture_write_exr(const char *path, const capture *capture, const lobe_host *host);

/// Writes a picture for viewing: tone-mapped, or as a heat map if the knob "view" shows something
/// other than radiance.
lobe_result capture_write_png(const char *path, const capture *capture, const lobe_host *host);

#endif
