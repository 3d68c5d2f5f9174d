#include <lobe/fitting.h>

#include "passes/renderer/delivery.h"
#include "passes/renderer/shading.h"

static const frame_delivery nothing = {0};

/// Declares the maps of all instances, and those of the environment, so that they are kept. Returns
/// the parts of the fits that are left, this submission's included.
static uint32_t declare(rendering *r, lobe_frame *frame) {
    lobe_graph_begin(r->renderer->graph);
    r->fits.parts = 1;
    passes_instances_list(r);
    passes_instance_maps_build(r, NULL, frame);
    (void)passes_shading_light_prepare(&r->context, &r->environment);
    return r->fits.parts_left + (r->fits.parts == 0);
}

lobe_result passes_fits_make(rendering *r, lobe_frame *frame,
                             bool (*progress)(void *user, double part), void *user, bool *stopped) {
    lobe_result result = LOBE_OK;
    uint32_t count = 0, left;
    while (result == LOBE_OK && !*stopped && (left = declare(r, frame)) > 0) {
        count = count > 0 ? count : left;
        result = passes_delivery_run(r, &nothing, frame);
        *stopped = result == LOBE_OK && progress &&
                   !progress(user, (count - r->fits.parts_left) / (double)count);
    }
    r->fits.parts = UINT32_MAX;
    return result;
}

// ---------------------------------------------------------------------------------------------
// Without drawing

static lobe_result check(const lobe_fitting_parameters *wanted, const lobe_host *host) {
    const char *name = lobe_filter_name(wanted->filter);
    if (!lobe_filter_fits(wanted->filter))
        return lobe_host_fail(host, LOBE_ERROR_INVALID_ARGUMENT,
                              "fit: filter '%s' fits no maps to materials", name);
    if (!wanted->cache)
        return lobe_host_fail(host, LOBE_ERROR_INVALID_ARGUMENT, "fit: no folder to save maps in");
    if (wanted->part > wanted->part_count)
        return lobe_host_fail(host, LOBE_ERROR_INVALID_ARGUMENT, "fit: part %u of %u", wanted->part,
                              wanted->part_count);
    if (wanted->part_count > 0 && !lobe_filter_shares(wanted->filter))
        return lobe_host_fail(host, LOBE_ERROR_UNSUPPORTED,
                              "fit: the work of filter '%s' is not shared by parts", name);
    return LOBE_OK;
}

/// The last submission makes nothing: it is there for what cannot be made, such as a map that is
/// too large.
static lobe_result make(rendering *r, const lobe_fitting_parameters *wanted) {
    lobe_frame frame = {0};
    bool stopped = false;
    lobe_result result = passes_fits_make(r, &frame, wanted->progress, wanted->user, &stopped);
    if (result == LOBE_OK && !stopped)
        result = passes_delivery_run(r, &nothing, &frame);
    lobe_frame_free(&frame);
    if (result != LOBE_OK) {
        r->renderer->fits_are_read_back = false;
        return result;
    }
    const uint32_t unsaved = r->fits.outcome.unsaved;
    return unsaved > 0 ? lobe_host_fail(r->context.host, LOBE_ERROR_WRITE,
                                        "%s: maps of %u of the materials are not saved",
                                        wanted->cache, unsaved)
                       : LOBE_OK;
}

lobe_result lobe_renderer_fit(lobe_renderer *renderer, const lobe_fitting_parameters *wanted,
                              lobe_fitting_summary *summary) {
    if (summary)
        *summary = (lobe_fitting_summary){0};
    if (!renderer || !wanted)
        return lobe_host_fail(renderer ? &renderer->host : NULL, LOBE_ERROR_INVALID_ARGUMENT,
                              "lobe_renderer_fit: renderer and parameters must not be NULL");
    lobe_result result = check(wanted, &renderer->host);
    if (result != LOBE_OK)
        return result;
    const lobe_render_parameters parameters = {
        .filter = wanted->filter, .settings = wanted->settings, .fits.cache = wanted->cache};
    // Nothing that is saved depends on the picture's size.
    rendering r = {.renderer = renderer, .parameters = &parameters, .width = 1, .height = 1};
    result = passes_rendering_begin(&r);
    if (result != LOBE_OK)
        return result;
    r.fits.draws_nothing = true;
    r.fits.share = wanted->part;
    r.fits.shares = wanted->part_count;
    result = make(&r, wanted);
    const fit_outcome *outcome = &r.fits.outcome;
    if (summary)
        *summary = (lobe_fitting_summary){outcome->made, outcome->found, outcome->unkept};
    return result;
}
