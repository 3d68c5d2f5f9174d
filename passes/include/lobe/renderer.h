#ifndef LOBE_RENDERER_H
#define LOBE_RENDERER_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include <lobe/device.h>
#include <lobe/filter.h>
#include <lobe/graph.h>
#include <lobe/image.h>
#include <lobe/scene.h>

#ifdef __cplusplus
extern "C" {
#endif

/// Draws scenes with filters. Owns a render graph and the device copy of one scene.
/// Not thread-safe: one renderer, one thread.
typedef struct lobe_renderer lobe_renderer;

/// `log` is copied; NULL: silent.
lobe_result lobe_renderer_create(lobe_device *device, const lobe_log *log,
                                 lobe_renderer **renderer);
/// Clears the pointer; NULL is fine. The device stays.
void lobe_renderer_destroy(lobe_renderer **renderer);

/// Uploads a scene and forgets the one before. The scene must live as long as it is set; NULL
/// only forgets. Errors: LOBE_ERROR_LIMIT, LOBE_ERROR_OUT_OF_DEVICE_MEMORY, LOBE_ERROR_MALFORMED
/// (no triangles, an index out of range, a vertex or texel that is not finite).
lobe_result lobe_renderer_set_scene(lobe_renderer *renderer, const lobe_scene *scene);

/// Largest number of samples a pixel of the reference.
#define LOBE_MAXIMUM_SAMPLES 4096

typedef struct lobe_render_parameters {
    const lobe_filter *filter;     ///< NULL: "lobes"
    const lobe_settings *settings; ///< NULL: the filter's defaults
    const lobe_camera *camera;     ///< NULL: the scene's
    uint32_t width, height;        ///< pixels; 0: 1280, 720
    /// Samples a pixel, [1, LOBE_MAXIMUM_SAMPLES]; 0: 64. Used by the reference alone.
    uint32_t samples;
    /// Which of many patterns the samples lie in: pictures of different patterns have errors of
    /// their own, by which noise can be told from what is true. Used by the reference alone.
    uint32_t pattern;
    /// Also deliver depth, normal, lobe count and level (one sample, at the pixel's centre).
    bool arbitrary_output_variables;
    /// Build every map again, as if the scene had changed.
    bool rebuild;
    /// Leave the result on the device: no image is delivered. For timing.
    bool discard;
    /// Called between submissions with the part done, [0, 1]; returning false stops the
    /// rendering with LOBE_OK and an empty frame. NULL: none.
    bool (*progress)(void *user, double part);
    void *user;
} lobe_render_parameters;

/// Device time of all passes of one name.
typedef struct lobe_pass_time {
    char name[64];
    double milliseconds;
    uint32_t count; ///< how many of the name ran
    /// What they must read and write together: see lobe_pass_report.
    uint64_t read_bytes, written_bytes;
} lobe_pass_time;

/// A finished frame. Images are owned by the frame; free with lobe_frame_free.
typedef struct lobe_frame {
    lobe_image radiance; ///< RGBA32_FLOAT, linear RGB radiance and coverage
    /// RGBA32_FLOAT: world-space unit shading normal, and distance along the view axis in metres
    /// (0 where nothing is hit). Empty unless asked for.
    lobe_image normal_depth;
    /// RG32_FLOAT: lobes evaluated, and MIP level of the filtered maps (0: the maps themselves).
    /// Empty unless asked for.
    lobe_image lobes_level;
    double milliseconds;    ///< device time of all submissions
    uint32_t submissions;   ///< how many frames of the graph it took
    lobe_pass_time *passes; ///< those that ran, in order of their first run
    size_t pass_count;
    /// Size of the maps that the filter built: device bytes, and texels of the base maps they
    /// stand for. Their ratio is the memory a filter costs a texel.
    uint64_t filtered_bytes, base_texels;
} lobe_frame;

void lobe_frame_free(lobe_frame *frame);

/// Renders one image. On failure `*frame` is zero. Errors: LOBE_ERROR_INVALID_ARGUMENT (no scene,
/// a value out of range), LOBE_ERROR_LIMIT (size), LOBE_ERROR_OUT_OF_DEVICE_MEMORY, ...
lobe_result lobe_renderer_render(lobe_renderer *renderer, const lobe_render_parameters *parameters,
                                 lobe_frame *frame);

/// The graph of the last frame (of a reference: its last submission), for dumps and reports.
lobe_graph *lobe_renderer_graph(lobe_renderer *renderer);

#ifdef __cplusplus
}
#endif

#endif
