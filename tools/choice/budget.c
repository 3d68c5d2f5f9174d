#include "tools/choice/budget.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <lobe/lobe.h>

#include "tools/choice/calibration.h"
#include "tools/choice/trade_choice.h"
#include "tools/cli/number_text.h"

// ---------------------------------------------------------------------------------------------
// A stored sweep

/// "a, b, c": the scenes that were measured.
static void list_scenes(const sweep_results *figures, char *text, size_t size) {
    size_t used = 0;
    snprintf(text, size, "nothing");
    for (size_t i = 0; i < figures->scene_count && used < size; i++) {
        if (!figures->scenes[i].skipped)
            used += (size_t)snprintf(text + used, size - used, "%s%s", used > 0 ? ", " : "",
                                     figures->scenes[i].name);
    }
}

static bool is_of_scene(const sweep_scene *entry, const char *name) {
    return strcmp(entry->scene ? entry->scene : entry->name, name) == 0;
}

static lobe_result check_scene(const char *path, const char *name, const lobe_host *host,
                               const sweep_results *figures) {
    const sweep_scene *skipped = NULL;
    for (size_t i = 0; i < figures->scene_count; i++) {
        if (!is_of_scene(&figures->scenes[i], name))
            continue;
        if (!figures->scenes[i].skipped)
            return LOBE_OK;
        skipped = &figures->scenes[i];
    }
    if (skipped)
        return lobe_host_fail(host, LOBE_ERROR_INVALID_ARGUMENT,
                              "%s: scene '%s' was skipped there: %s", path, name, skipped->skipped);
    char scenes[512];
    list_scenes(figures, scenes, sizeof scenes);
    return lobe_host_fail(host, LOBE_ERROR_INVALID_ARGUMENT,
                          "%s: contains measurements of %s, not of scene '%s'", path, scenes, name);
}

lobe_result budget_read(const budget_options *options, const char *scene, const lobe_host *host,
                        sweep_results *figures) {
    *figures = (sweep_results){0};
    if (!options->sweep)
        return LOBE_OK;
    lobe_result result = sweep_results_read(options->sweep, host, figures);
    return result == LOBE_OK ? check_scene(options->sweep, scene, host, figures) : result;
}

/// `*entry`: the scene in the picture's light.
static lobe_result find_entry(const char *path, const budget_picture *picture,
                              const lobe_host *host, const sweep_results *figures,
                              const sweep_scene **entry) {
    const lobe_environment *environment = picture->scene->environment;
    const char *name = environment ? environment->name : NULL;
    for (size_t i = 0; i < figures->scene_count; i++) {
        *entry = &figures->scenes[i];
        if (!(*entry)->skipped && sweep_scene_is(*entry, picture->name, name, picture->lighting))
            return LOBE_OK;
    }
    char scenes[512];
    list_scenes(figures, scenes, sizeof scenes);
    return lobe_host_fail(
        host, LOBE_ERROR_INVALID_ARGUMENT,
        "%s: contains measurements of %s, not of scene '%s' in environment %s (%s)", path, scenes,
        picture->name, name ? name : "none",
        picture->lighting[0] ? picture->lighting : "light unchanged");
}

static lobe_result check_device(const char *path, const budget_picture *picture,
                                const lobe_host *host, const sweep_results *figures) {
    const lobe_device_information *device = lobe_device_describe(picture->device);
    if (strcmp(figures->device, device->name) == 0 && strcmp(figures->driver, device->driver) == 0)
        return LOBE_OK;
    return lobe_host_fail(host, LOBE_ERROR_INVALID_ARGUMENT,
                          "%s: was measured on %s, %s; this device is %s, %s", path,
                          figures->device, figures->driver, device->name, device->driver);
}

static void warn_of_what_differs(const char *path, const budget_picture *picture,
                                 const lobe_host *host, const sweep_results *figures) {
    if (strcmp(figures->version, lobe_version()) != 0)
        lobe_host_log(host, LOBE_LOG_WARNING, "%s: was measured with lobe %s, this is %s", path,
                      figures->version, lobe_version());
    if (!picture->own_view)
        lobe_host_log(host, LOBE_LOG_WARNING,
                      "%s: was measured with the scene's own camera and lights; with others times "
                      "and errors differ",
                      path);
}

/// `figures` may be empty: those of a calibration are of the picture's size.
static trade_request request_of(const budget_options *options, const budget_picture *picture,
                                const sweep_results *figures) {
    const double timed = (double)figures->size[0] * figures->size[1];
    return (trade_request){
        .kind = options->has_milliseconds ? TRADE_LIMIT_MILLISECONDS : TRADE_LIMIT_ERROR,
        .limit = options->has_milliseconds ? options->milliseconds : options->error,
        .retained = options->maps == 1,
        .pixels = timed > 0 ? (double)picture->size[0] * picture->size[1] / timed : 1,
    };
}

static lobe_result find_figures(const budget_options *options, const budget_picture *picture,
                                const lobe_host *host, sweep_results *figures,
                                const sweep_scene **entry) {
    *entry = NULL;
    const trade_request request = request_of(options, picture, figures);
    if (!options->sweep)
        return calibrate(&(calibration){.device = picture->device,
                                        .host = host,
                                        .scene = picture->scene,
                                        .size = {picture->size[0], picture->size[1]},
                                        .request = &request},
                         figures);
    lobe_result result = find_entry(options->sweep, picture, host, figures, entry);
    if (result == LOBE_OK)
        result = check_device(options->sweep, picture, host, figures);
    if (result == LOBE_OK)
        warn_of_what_differs(options->sweep, picture, host, figures);
    return result;
}

// ---------------------------------------------------------------------------------------------
// Rows to choose among

/// False for the reference, and for a row of another version that lobe cannot render.
static bool read_row(const sweep_row *row, const lobe_filter **filter, lobe_settings *settings) {
    if (lobe_filter_find(row->filter, NULL, filter) != LOBE_OK || lobe_filter_supersamples(*filter))
        return false;
    lobe_settings_default(*filter, settings);
    for (size_t i = 0; i < row->setting_count; i++) {
        char assignment[80];
        snprintf(assignment, sizeof assignment, "%s=%s", row->settings[i].name,
                 row->settings[i].value);
        if (lobe_settings_set(*filter, settings, assignment, NULL) != LOBE_OK)
            return false;
    }
    return true;
}

/// The rows of a scene, or all if `scene` is NULL. Returns their number.
static size_t list_rows(const sweep_results *figures, const sweep_scene *scene,
                        const sweep_row **rows) {
    size_t count = 0;
    for (size_t i = 0; i < figures->row_count; i++) {
        const sweep_row *row = &figures->rows[i];
        const lobe_filter *filter;
        lobe_settings settings;
        if ((!scene || strcmp(row->scene, scene->name) == 0) && read_row(row, &filter, &settings))
            rows[count++] = row;
    }
    return count;
}

/// Noise of the reference does not count as an error of the filter.
static void leave_out_noise(const sweep_scene *scene, sweep_results *figures) {
    for (size_t i = 0; scene && i < figures->row_count; i++) {
        sweep_row *row = &figures->rows[i];
        if (strcmp(row->scene, scene->name) == 0)
            row->error.relative_l2 = sweep_error_without_noise(scene, row);
    }
}

// ---------------------------------------------------------------------------------------------
// Words

typedef struct text {
    char characters[512];
} text;

/// "lobes with epsilon0=0.85, probes=2": the knobs that differ from their defaults.
static text name_row(const sweep_row *row) {
    const lobe_filter *filter;
    lobe_settings settings, defaults;
    text name;
    size_t used = (size_t)snprintf(name.characters, sizeof name.characters, "%s", row->filter);
    if (!read_row(row, &filter, &settings))
        return name;
    lobe_settings_default(filter, &defaults);
    const char *separator = " with ";
    for (size_t i = 0; i < lobe_filter_knob_count(filter); i++) {
        if (settings.values[i] == defaults.values[i] || used >= sizeof name.characters)
            continue;
        char value[64];
        lobe_settings_print(filter, &settings, i, value, sizeof value);
        used += (size_t)snprintf(name.characters + used, sizeof name.characters - used, "%s%s=%s",
                                 separator, lobe_filter_knob(filter, i)->name, value);
        separator = ", ";
    }
    return name;
}

/// "lobes with epsilon0=0.85: 12.3 ms with maps rebuilt, relative L2 0.163".
static text describe_row(const trade_request *request, const sweep_row *row) {
    text result;
    const text name = name_row(row);
    snprintf(
        result.characters, sizeof result.characters, "%.300s: %s ms with maps %s, relative L2 %s",
        name.characters, number_text_of(trade_milliseconds(request, row), 3).text,
        request->retained ? "retained" : "rebuilt", number_text_of(row->error.relative_l2, 3).text);
    return result;
}

/// Where the figures come from.
static text describe_source(const budget_options *options, const budget_picture *picture,
                            const sweep_results *figures) {
    text source;
    const uint32_t *from = figures->size, *to = picture->size;
    int used =
        snprintf(source.characters, sizeof source.characters,
                 "%.256s, %s%u frame%s, errors against %u samples per pixel",
                 options->sweep ? options->sweep : "calibrated", options->sweep ? "" : "up to ",
                 figures->frames, figures->frames == 1 ? "" : "s", figures->reference_samples);
    if (from[0] != to[0] || from[1] != to[1])
        snprintf(source.characters + used, sizeof source.characters - (size_t)used,
                 ", scaled from %ux%u to %ux%u: shading by the pixels, building and errors as they "
                 "were",
                 from[0], from[1], to[0], to[1]);
    return source;
}

static void print_choice(const trade_request *request, const trade_choice *choice,
                         const text *source) {
    const bool limits_time = request->kind == TRADE_LIMIT_MILLISECONDS;
    const char *comparative = limits_time ? "more exact" : "faster";
    printf("picked %s; %zu of %zu choices %s %s %g%s, this one %s\n",
           describe_row(request, choice->picked).characters, choice->within, choice->candidates,
           choice->within == 1 ? "keeps" : "keep", limits_time ? "to" : "to an error of",
           request->limit, limits_time ? " ms" : "", limits_time ? "errs least" : "is fastest");
    if (choice->better)
        printf("the next %s is %s; figures: %s\n", comparative,
               describe_row(request, choice->better).characters, source->characters);
    else
        printf("none is %s; figures: %s\n", comparative, source->characters);
    fflush(stdout); // rendering may take a while
}

// ---------------------------------------------------------------------------------------------
// Picking

static lobe_result fail(const budget_options *options, const trade_request *request,
                        const trade_choice *choice, const text *source, const lobe_host *host) {
    const char *option = budget_options_limit(options);
    if (!choice->nearest)
        return lobe_host_fail(host, LOBE_ERROR_UNSUPPORTED,
                              "%s %g: no filter has both a time and an error; figures: %s", option,
                              request->limit, source->characters);
    return lobe_host_fail(host, LOBE_ERROR_UNSUPPORTED,
                          "%s %g: none of %zu choices meets it; the %s is %s; figures: %s", option,
                          request->limit, choice->candidates,
                          request->kind == TRADE_LIMIT_MILLISECONDS ? "cheapest" : "most exact",
                          describe_row(request, choice->nearest).characters, source->characters);
}

lobe_result budget_pick(const budget_options *options, const budget_picture *picture,
                        const lobe_host *host, sweep_results *figures, const lobe_filter **filter,
                        lobe_settings *settings) {
    const sweep_scene *entry;
    lobe_result result = find_figures(options, picture, host, figures, &entry);
    if (result != LOBE_OK)
        return result;
    leave_out_noise(entry, figures);
    const sweep_row **rows = calloc(figures->row_count + 1, sizeof *rows);
    if (!rows)
        return lobe_host_fail(host, LOBE_ERROR_OUT_OF_MEMORY, "budget: out of memory");
    const size_t count = list_rows(figures, entry, rows);
    const trade_request request = request_of(options, picture, figures);
    const trade_choice choice = trade_choose(&request, rows, count);
    const text source = describe_source(options, picture, figures);
    free(rows);
    if (!choice.picked)
        return fail(options, &request, &choice, &source, host);
    read_row(choice.picked, filter, settings);
    print_choice(&request, &choice, &source);
    return LOBE_OK;
}
