#ifndef LOBE_FILTER_H
#define LOBE_FILTER_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include <lobe/api.h>
#include <lobe/host.h>
#include <lobe/result.h>

#ifdef __cplusplus
extern "C" {
#endif

/// A way of filtering appearance: how maps are prepared, and how a pixel is shaded from them. All
/// filters go through the same shading pass.
typedef struct lobe_filter lobe_filter;

typedef enum lobe_knob_kind {
    LOBE_KNOB_NUMBER,  ///< a real number within [minimum, maximum]
    LOBE_KNOB_INTEGER, ///< a whole number within [minimum, maximum]
    LOBE_KNOB_CHOICE,  ///< one of `choices`; its value is the index
} lobe_knob_kind;

/// A parameter that a user can set. The command line, the viewer, the benchmark and the manual
/// pages all use this description.
typedef struct lobe_knob {
    const char *name;
    const char *summary; ///< one line
    lobe_knob_kind kind;
    double minimum, maximum;    ///< numbers and integers
    double initial;             ///< default; for a choice the index
    const char *const *choices; ///< NULL-terminated; choices only
    /// Values worth comparing, as a user would write them, separated by commas: a sweep of the
    /// benchmark measures them. NULL: only the default.
    const char *sweep;
    /// An assignment that those values require to have an effect, such as "env=sampled"; NULL:
    /// none.
    const char *sweep_with;
    /// Has an effect only in scenes lit by an environment; a sweep skips it in all others.
    bool environment;
} lobe_knob;

/// Largest number of knobs of a filter, including those that every filter has.
#define LOBE_MAXIMUM_KNOBS 32

/// The number of filters; their order is fixed.
LOBE_API size_t lobe_filter_count(void);
/// NULL if the index is out of range.
LOBE_API const lobe_filter *lobe_filter_get(size_t index);
/// LOBE_ERROR_NOT_FOUND with a line that lists all filters. `host` may be NULL.
LOBE_API lobe_result lobe_filter_find(const char *name, const lobe_host *host,
                                      const lobe_filter **filter);

LOBE_API const char *lobe_filter_name(const lobe_filter *filter);
LOBE_API const char *lobe_filter_summary(const lobe_filter *filter); ///< one line
LOBE_API const char *lobe_filter_paper(const lobe_filter *filter);   ///< its source, or ""
/// True for the reference, which averages many samples of the unfiltered maps.
LOBE_API bool lobe_filter_supersamples(const lobe_filter *filter);
/// True for filters that fit maps to materials: see lobe_render_fits.
LOBE_API bool lobe_filter_fits(const lobe_filter *filter);
/// Whether several processes can share the work of fitting: see lobe_fitting_parameters.
LOBE_API bool lobe_filter_shares(const lobe_filter *filter);
/// Whether it draws the waves of materials (lobe_waves); false for NULL.
LOBE_API bool lobe_filter_draws_waves(const lobe_filter *filter);

/// All knobs of a filter: its own, then those that every filter has.
LOBE_API size_t lobe_filter_knob_count(const lobe_filter *filter);
LOBE_API const lobe_knob *lobe_filter_knob(const lobe_filter *filter, size_t index);

/// Values for the knobs of one filter, in their order.
typedef struct lobe_settings {
    double values[LOBE_MAXIMUM_KNOBS];
} lobe_settings;

/// Every knob at its default.
LOBE_API void lobe_settings_default(const lobe_filter *filter, lobe_settings *settings);
/// Sets one knob from "NAME=VALUE". Errors: LOBE_ERROR_NOT_FOUND (no such knob; the line lists
/// the filter's knobs), LOBE_ERROR_INVALID_ARGUMENT (no '=', not a number, out of range, not one of
/// the choices; the line says what is allowed). `settings` is unchanged then.
LOBE_API lobe_result lobe_settings_set(const lobe_filter *filter, lobe_settings *settings,
                                       const char *assignment, const lobe_host *host);
/// Reads the value of a knob; for a choice, its index. LOBE_ERROR_NOT_FOUND, with a line that lists
/// the filter's knobs, if it has no knob of that name; `value` is unchanged then.
LOBE_API lobe_result lobe_settings_get(const lobe_filter *filter, const lobe_settings *settings,
                                       const char *name, double *value, const lobe_host *host);
/// Writes a knob's value as a user would ("0.95", "camera") into `text`.
/// `knob` is below lobe_filter_knob_count.
LOBE_API void lobe_settings_print(const lobe_filter *filter, const lobe_settings *settings,
                                  size_t knob, char *text, size_t size);

#ifdef __cplusplus
}
#endif

#endif
