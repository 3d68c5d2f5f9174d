#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include <lobe/lobe.h>

#include "tools/animation/animation.h"
#include "tools/choice/filter_choice.h"
#include "tools/cli/cache_options.h"
#include "tools/cli/console.h"
#include "tools/cli/device_options.h"
#include "tools/cli/progress.h"
#include "tools/cli/scene_options.h"
#include "tools/cli/subcommand.h"

#define MOST_PARTS 4096

/// The command line.
typedef struct prepare_request {
    const char *scene;    ///< NULL where a material folder is given
    const char *material; ///< folder
    const char *filter_name;
    option_list assignments; ///< "KNOB=VALUE"
    const char *part_text;   ///< "I/N"; NULL: the whole
    uint32_t part;           ///< 0: the whole, or all parts are put together
    uint32_t part_count;     ///< 0: the whole
    bool merges;             ///< the parts
    scene_options opening;
    cache_options cache;
    device_options device;

    const lobe_filter *filter;
    lobe_settings settings;
} prepare_request;

typedef struct prepare_state {
    lobe_host host;
    progress progress;
    lobe_scene *scene;
    lobe_device *device;
    animation *animation; ///< NULL: the scene stands still
    lobe_renderer *renderer;
    char cache_folder[CACHE_FOLDER_SIZE];
} prepare_state;

// ---------------------------------------------------------------------------------------------
// Usage

static bool parse_part(prepare_request *request) {
    unsigned part, count;
    char rest;
    // sscanf takes blanks and signs before numbers, too.
    if (request->part_text[strspn(request->part_text, "0123456789/")] != '\0' ||
        sscanf(request->part_text, "%4u/%4u%c", &part, &count, &rest) != 2 || part < 1 ||
        part > count || count > MOST_PARTS)
        return false;
    request->part = part;
    request->part_count = count;
    return true;
}

static int check_usage(const option_table *table, prepare_request *request) {
    const int status = scene_options_check_source(table, request->scene, request->material);
    if (status != 0)
        return status;
    if (!request->filter_name)
        return options_usage_error(table, "no --filter");
    if (request->part_text && request->merges)
        return options_usage_error(table, "--part and --merge exclude each other");
    if (request->part_text && !parse_part(request))
        return options_usage_error(table,
                                   "--part: '%s' is not I/N, with I from 1 to N, and N to %d",
                                   request->part_text, MOST_PARTS);
    return 0;
}

static int check_filter(const option_table *table, const prepare_request *request) {
    if (!lobe_filter_fits(request->filter))
        return options_usage_error(table, "--filter: '%s' makes nothing that is kept",
                                   request->filter_name);
    if (request->part_count > 0 && !lobe_filter_shares(request->filter))
        return options_usage_error(table, "--%s: '%s' does not make its maps in parts",
                                   request->merges ? "merge" : "part", request->filter_name);
    return 0;
}

// ---------------------------------------------------------------------------------------------
// Work

static lobe_result open_scene(prepare_request *request, prepare_state *state) {
    static const uint32_t size[2] = {1, 1};
    request->opening.has_lights = true; // none is needed
    return request->material
               ? scene_options_open_material(&request->opening, request->material,
                                             LOBE_CARRIER_PLANE, &state->host, &state->scene)
               : scene_options_open(&request->opening, request->scene, size, &state->host,
                                    &state->scene);
}

static lobe_result open_renderer(const prepare_request *request, prepare_state *state) {
    lobe_result result = device_options_open(&request->device, &state->host, &state->device);
    if (result == LOBE_OK)
        result = lobe_renderer_create(state->device, &state->host, &state->renderer);
    if (result == LOBE_OK)
        result = animation_create(state->device, state->scene, &state->host, &state->animation);
    if (result == LOBE_OK && state->animation)
        animation_attach(state->animation, state->renderer);
    return result == LOBE_OK ? lobe_renderer_set_scene(state->renderer, state->scene) : result;
}

static void begin_progress(const prepare_request *request, prepare_state *state) {
    if (request->part > 0)
        progress_step(&state->progress, "%s: preparing part %u of %u", state->scene->name,
                      request->part, request->part_count);
    else
        progress_step(&state->progress, "%s: preparing materials", state->scene->name);
}

static void print(const prepare_request *request, const prepare_state *state, const char *folder,
                  const lobe_fitting_summary *summary) {
    printf("%s, filter %s", state->scene->name, request->filter_name);
    if (request->part > 0)
        printf(", part %u of %u", request->part, request->part_count);
    printf(": made for %u material%s, found for %u, in %s\n", summary->made,
           summary->made == 1 ? "" : "s", summary->found, folder);
    if (summary->unkept > 0)
        lobe_host_log(&state->host, LOBE_LOG_WARNING,
                      "%s: for %u of the materials nothing can be kept: their maps change with "
                      "time, or are too large",
                      state->scene->name, summary->unkept);
}

static lobe_result fit(const prepare_request *request, prepare_state *state, const char *folder) {
    const lobe_fitting_parameters parameters = {
        .filter = request->filter,
        .settings = &request->settings,
        .cache = folder,
        .part = request->part,
        .part_count = request->part_count,
        .progress = progress_part,
        .user = &state->progress,
    };
    lobe_fitting_summary summary;
    begin_progress(request, state);
    lobe_result result = lobe_renderer_fit(state->renderer, &parameters, &summary);
    progress_end(&state->progress);
    if (result == LOBE_OK)
        result = device_options_check(state->device, &state->host);
    if (result == LOBE_OK)
        print(request, state, folder, &summary);
    return result;
}

/// Checks the folder early, so that a misspelt one does not cost minutes of waiting.
static lobe_result prepare(prepare_request *request, prepare_state *state) {
    const char *folder = cache_options_find(&request->cache, "mixtures", state->cache_folder);
    if (!folder || access(folder, W_OK | X_OK) != 0)
        return lobe_host_fail(&state->host, LOBE_ERROR_WRITE, "%s: not a folder to write to",
                              folder ? folder : "the user's cache folder");
    lobe_result result = open_scene(request, state);
    if (result == LOBE_OK)
        result = open_renderer(request, state);
    return result == LOBE_OK ? fit(request, state, folder) : result;
}

static int run_request(const option_table *table, prepare_request *request) {
    prepare_state state = {.host = console_host(false), .progress = progress_begin(false)};
    int status = check_usage(table, request);
    if (status == 0)
        status = filter_choice_make(request->filter_name, &request->assignments, &state.host,
                                    &request->filter, &request->settings);
    if (status == 0)
        status = check_filter(table, request);
    if (status != 0)
        return status;
    const lobe_result result = prepare(request, &state);
    lobe_renderer_destroy(&state.renderer);
    animation_destroy(&state.animation);
    lobe_device_destroy(&state.device);
    lobe_scene_destroy(&state.scene);
    return result == LOBE_OK ? 0 : 1;
}

// ---------------------------------------------------------------------------------------------
// Options

static int run(int argc, char **argv) {
    prepare_request request = {0};
    option_list operands = {0};
    const option options[] = {
        {.name = "filter",
         .kind = OPTION_TEXT,
         .argument = "NAME",
         .summary = "the filter whose maps are made: displaced, wu, mixture, multi_leadr, tan or "
                    "fournier",
         .target = &request.filter_name,
         .values = OPTION_VALUES_FILTER},
        filter_option_set(&request.assignments),
        {.name = "material",
         .kind = OPTION_TEXT,
         .argument = "DIR",
         .summary = "instead of SCENE: a folder of PBR maps",
         .target = &request.material},
        {.name = "part",
         .kind = OPTION_TEXT,
         .argument = "I/N",
         .summary = "make only the I-th of N parts, counted from 1 on (displaced): other processes "
                    "or machines make the others, in the same cache folder or in one that is "
                    "copied there",
         .target = &request.part_text},
        {.name = "merge",
         .kind = OPTION_INTEGER,
         .argument = "N",
         .summary = "put N parts together, which all are there, and remove them",
         .target = &request.part_count,
         .minimum = 1,
         .maximum = MOST_PARTS,
         .given = &request.merges},
        scene_option_assets(&request.opening),
        cache_option_folder(&request.cache),
        device_option_select(&request.device),
        device_option_validation(&request.device),
    };
    const option_table table = {
        .program = "lobe prepare",
        .operands = "SCENE --filter NAME",
        .summary =
            "Makes what a filter fits to the materials of SCENE or to their reliefs, which can "
            "take\n"
            "minutes, without drawing: 'lobe render' and 'lobe view' then find it in the cache\n"
            "folder. (Environments are prepared by 'lobe environment'.)",
        .options = options,
        .option_count = sizeof options / sizeof *options,
        .maximum_operands = 1,
        .operand_values = OPTION_VALUES_SCENE,
    };
    int status;
    if (options_parse(&table, argc, argv, &operands, &status)) {
        request.scene = operands.count > 0 ? operands.values[0] : NULL;
        status = run_request(&table, &request);
    }
    options_free(&table, &operands);
    return status;
}

const subcommand prepare_subcommand = {
    "prepare", "make what filters fit to materials, ahead of rendering", run};
