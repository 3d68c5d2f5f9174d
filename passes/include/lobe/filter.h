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

/// A filter is a way of filtering appearance: how maps are prepared, and how a pixel is shaded
/// from them. All filters go through the same shading pass.
typedef struct lobe_filter lobe_filter;

typedef enum lobe_knob_kind {
    LOBE_KNOB_NUMBER,  ///< a real number within [minimum, maximum]
    LOBE_KNOB_INTEGER, ///< a whole number within [minimum, maximum]
    LOBE_KNOB_CHOICE,  ///< one of `choices`; its value is the index
} lobe_knob_kind;

/// Something a user can set: the same list feeds the command line, the benchmark and the
/// documentation.
typedef struct lobe_knob {
    const char *name;
    const char *summary; ///< one line
    lobe_knob_kind kind;
    double minimum, maximum;    ///< numbers and integers
    double initial;             ///< default; for a choice the index
    const char *const *choices; ///< NULL-terminated; choices only
    /// Values worth comparing, as a user would write them, with commas between: what a sweep of
    /// the benchmark goes through. NULL: none but the default.
    const char *sweep;
    /// What must be set for those values to tell, "env=sampled"; NULL: nothing.
    const char *sweep_with;
    /// Tells only in scenes that are lit by an environment: a sweep passes over it in all others.
    bool environment;
} lobe_knob;

/// Most knobs a filter may have, the shared ones included.
#define LOBE_MAXIMUM_KNOBS 24

/// The filters there are, in a fixed order.
LOBE_API size_t lobe_filter_count(void);
/// NULL for an index out of range.
LOBE_API const lobe_filter *lobe_filter_get(size_t index);
/// LOBE_ERROR_NOT_FOUND with a line that lists the filters there are. `host` may be NULL.
LOBE_API lobe_result lobe_filter_find(const char *name, const lobe_host *host,
                                      const lobe_filter **filter);

LOBE_API const char *lobe_filter_name(const lobe_filter *filter);
LOBE_API const char *lobe_filter_summary(const lobe_filter *filter); ///< one line
LOBE_API const char *lobe_filter_paper(const lobe_filter *filter);   ///< the source, or ""
/// True for the reference: it takes the mean of many samples of the unfiltered maps.
LOBE_API bool lobe_filter_supersamples(const lobe_filter *filter);

/// All knobs of a filter: its own, then those every filter shares.
LOBE_API size_t lobe_filter_knob_count(const lobe_filter *filter);
LOBE_API const lobe_knob *lobe_filter_knob(const lobe_filter *filter, size_t index);

/// Values for the knobs of one filter, in their order.
typedef struct lobe_settings {
    double values[LOBE_MAXIMUM_KNOBS];
} lobe_settings;

/// Every knob at its default.
LOBE_API void lobe_settings_default(const lobe_filter *filter, lobe_settings *settings);
/// Sets one knob from "NAME=VALUE". Errors: LOBE_ERROR_NOT_FOUND (no such knob; the line lists
/// those there are), LOBE_ERROR_INVALID_ARGUMENT (no '=', not a number, out of range, not one of
/// the choices; the line says what is allowed). `settings` is unchanged then.
LOBE_API lobe_result lobe_settings_set(const lobe_filter *filter, lobe_settings *settings,
                                       const char *assignment, const lobe_host *host);
/// Reads the value of a knob; for a choice, its index. LOBE_ERROR_NOT_FOUND with a line that lists
/// the filter's knobs if it has none of that name; `value` is unchanged then.
LOBE_API lobe_result lobe_settings_get(const lobe_filter *filter, const lobe_settings *settings,
                                       const char *name, double *value, const lobe_host *host);
/// Writes a knob's value as the user would ("0.95", "camera") into `text`.
LOBE_API void lobe_settings_print(const lobe_filter *filter, const lobe_settings *settings,
                                  size_t knob, char *text, size_t size);

#ifdef __cplusplus
}
#endif

#endif
