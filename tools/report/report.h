#ifndef TOOLS_REPORT_H
#define TOOLS_REPORT_H

#include <stdint.h>
#include <stdio.h>
#include <time.h>

#include <lobe/host.h>
#include <lobe/result.h>

#include "tools/sweep/results.h"

/// What `lobe report` works on. Its page has sections, each written by a function of its own;
/// failures to write are asked of the stream once, at the end.

#define REPORT_MAXIMUM_FILTERS 64

typedef struct report {
    FILE *page;
    const sweep_results *results; ///< errors (relative L2) without the references' noise
    const char *path;             ///< of the results; pictures are named relative to it
    time_t time;                  ///< when the results were written
    uint32_t picture_width;       ///< pixels; wider pictures are reduced
    const char *filters[REPORT_MAXIMUM_FILTERS]; ///< in the order of their first rows
    size_t filter_count;
    const lobe_host *host;
} report;

/// Writes the whole page. Errors: those of its parts.
lobe_result report_write_page(const report *report);

// Sections about all scenes
void report_write_style(const report *report);
void report_write_head(const report *report);
void report_write_summary(const report *report);
void report_write_targets(const report *report);
void report_write_paper(const report *report);
void report_write_bandwidths(const report *report);
void report_write_guide(const report *report);

// Parts of a scene's section. `scene`: index into the results' scenes.
/// Errors: those of image_input_read; LOBE_ERROR_INVALID_ARGUMENT where sizes differ.
lobe_result report_write_pictures(const report *report, size_t scene);
/// Errors: LOBE_ERROR_LIMIT (more rows than a plot has points), LOBE_ERROR_OUT_OF_MEMORY.
lobe_result report_write_trade(const report *report, size_t scene);
/// What lights the scene, where options say.
void report_write_light(const report *report, size_t scene);
/// Filters by methods of integrating the environment, where there is one.
void report_write_methods(const report *report, size_t scene);
void report_write_numbers(const report *report, size_t scene);
void report_write_variations(const report *report, size_t scene);
/// Errors: LOBE_ERROR_OUT_OF_MEMORY.
lobe_result report_write_pass_bars(const report *report, size_t scene);
void report_write_passes(const report *report, size_t scene);

#endif
