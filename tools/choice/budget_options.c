#include "tools/choice/budget_options.h"

static const char *const states_of_maps[] = {"rebuilt", "retained", NULL};

option budget_option_milliseconds(budget_options *options) {
    return (option){
        .name = "budget",
        .kind = OPTION_NUMBER,
        .argument = "MS",
        .summary =
            "instead of --filter: pick the filter and knobs with the least error among those whose "
            "frame takes at most this many milliseconds",
        .target = &options->milliseconds,
        .given = &options->has_milliseconds,
        .minimum = 0.001,
        .maximum = 1000000,
    };
}

option budget_option_error(budget_options *options) {
    return (option){
        .name = "error",
        .kind = OPTION_NUMBER,
        .argument = "E",
        .summary = "instead of --filter: pick the fastest filter and knobs among those whose "
                   "relative L2 error is at most this",
        .target = &options->error,
        .given = &options->has_error,
        .minimum = 0.000001,
        .maximum = 1000000,
    };
}

option budget_option_sweep(budget_options *options) {
    return (option){
        .name = "sweep",
        .kind = OPTION_TEXT,
        .argument = "FILE",
        .summary = "with --budget or --error: use what 'lobe bench --sweep' measured for this "
                   "scene on this device (default: a short calibration)",
        .target = &options->sweep,
    };
}

option budget_option_maps(budget_options *options) {
    return (option){
        .name = "maps",
        .kind = OPTION_CHOICE,
        .argument = "STATE",
        .summary = "with --budget or --error: time of frames in which all maps are rebuilt, as "
                   "when materials change, or of frames in which they are retained",
        .target = &options->maps,
        .fallback = "rebuilt",
        .choices = states_of_maps,
        .given = &options->has_maps,
    };
}

const char *budget_options_limit(const budget_options *options) {
    return options->has_milliseconds ? "--budget" : options->has_error ? "--error" : NULL;
}

int budget_options_check(const option_table *table, const budget_options *options,
                         const char *fixed) {
    const char *limit = budget_options_limit(options);
    if (options->has_milliseconds && options->has_error)
        return options_usage_error(table, "--budget and --error exclude each other");
    if (limit && fixed)
        return options_usage_error(table, "%s and %s exclude each other: %s picks filter and knobs",
                                   limit, fixed, limit);
    const char *alone = options->sweep ? "--sweep" : options->has_maps ? "--maps" : NULL;
    if (!limit && alone)
        return options_usage_error(table, "%s needs --budget or --error", alone);
    return 0;
}
