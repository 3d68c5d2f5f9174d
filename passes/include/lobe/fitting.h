#ifndef LOBE_FITTING_H
#define LOBE_FITTING_H

#include <stdbool.h>
#include <stdint.h>

#include <lobe/api.h>
#include <lobe/filter.h>
#include <lobe/renderer.h>

#ifdef __cplusplus
extern "C" {
#endif

/// Makes the maps of a scene's materials ahead of its frames, into a folder where these find them:
/// see lobe_render_fits.

typedef struct lobe_fitting_parameters {
    const lobe_filter *filter;     ///< one that fits maps: see lobe_filter_fits
    const lobe_settings *settings; ///< NULL: the filter's defaults
    const char *cache;             ///< an existing folder; `fits.cache` of the frames to come
    /// 0, 0: the whole work. Otherwise it is shared by several calls, of processes and machines
    /// alike, whose folders are the same or are copied together: one for each `part` from 1 to
    /// `part_count`, in any order, which saves files of its own; and then one with `part` 0 and the
    /// same `part_count`, which makes the maps of these files and removes them. Maps that consist
    /// of several files, such as those of large reliefs, are shared file by file: they are whole
    /// with the last part, and the call after that only checks them. Maps are the same bit for bit,
    /// however many parts there are. Only of filters that lobe_filter_shares.
    uint32_t part, part_count;
    /// Called after each step with the fraction done, [0, 1]; returning false stops with LOBE_OK:
    /// what is not saved then is lost. NULL: none.
    bool (*progress)(void *user, double part);
    void *user; ///< passed to it
} lobe_fitting_parameters;

/// How many materials have maps that are
typedef struct lobe_fitting_summary {
    uint32_t made;   ///< made and saved by this renderer, or parts of them
    uint32_t found;  ///< in the folder already, or parts of them
    uint32_t unkept; ///< never saved: of texels that are given on the device, or too large
} lobe_fitting_summary;

/// Makes and saves the maps that the folder lacks, of all materials that instances have, without
/// drawing. A damaged or foreign file is replaced, with a notice. Files that are there are not made
/// again: a call goes on where one that was interrupted came to. Errors: as lobe_renderer_render,
/// and LOBE_ERROR_INVALID_ARGUMENT (a filter that fits no maps, no folder, a part beyond the last),
/// LOBE_ERROR_UNSUPPORTED (parts of a filter whose work is not shared), LOBE_ERROR_NOT_FOUND (a
/// part's file is missing, or damaged, or does not belong to the others), LOBE_ERROR_WRITE.
/// `summary`: may be NULL.
LOBE_API lobe_result lobe_renderer_fit(lobe_renderer *renderer,
                                       const lobe_fitting_parameters *parameters,
                                       lobe_fitting_summary *summary);

#ifdef __cplusplus
}
#endif

#endif
