#include <stdio.h>
#include <stdlib.h>

#include <lobe/lobe.h>

#include "tools/animation/animation.h"
#include "tools/choice/budget.h"
#include "tools/choice/filter_choice.h"
#include "tools/cli/cache_options.h"
#include "tools/cli/console.h"
#include "tools/cli/device_options.h"
#include "tools/cli/output_file.h"
#include "tools/cli/progress.h"
#include "tools/cli/scene_options.h"
#include "tools/cli/subcommand.h"
#include "tools/cli/view_options.h"
#include "tools/render/capture.h"
#include "tools/render/empty_picture.h"
#include "tools/render/frame_sequence.h"
#include "tools/render/frame_times.h"
#include "tools/scenes/scene_list.h"

/// The command line.
typedef struct render_request {
    const char *scene;   ///< NULL where a material folder is given
    option_list outputs; ///< names that end in .exr or .png
    const char *material;
    uint32_t carrier;
    const char *filter_name;
    option_list assignments; ///< "KNOB=VALUE"
    budget_options budget;   ///< instead of both
    uint32_t size[2];
    uint32_t samples;
    const char *frames_text;
    frame_sequence frames;
    double time;           ///< seconds
    const char *animation; ///< NULL: the first
    const char *graph;
    uint32_t depth;
    bool layers;   ///< the layers of arbitrary output variables
    double motion; ///< where on its path the camera was in the frame before
    double exposure;
    bool has_filter, has_carrier, has_samples, has_depth, has_motion, has_exposure, has_time;
    scene_options opening;
    view_options view;
    lobe_light *lights;
    cache_options cache;
    device_options device;

    const lobe_filter *filter; ///< NULL until the budget picks it
    lobe_settings settings;
} render_request;

/// State of the rendering.
typedef struct render_state {
    lobe_host host;
    lobe_scene *scene;
    lobe_camera previous;  ///< where the camera was in the frame before, for motion
    sweep_results figures; ///< the figures that pick filter and knobs
    lobe_device *device;
    animation *animation; ///< NULL: the scene stands still
    lobe_renderer *renderer;
    lobe_frame frame;
    frame_times times;
    progress progress;
    const frame_sequence *sequence;
    uint32_t frame_number; ///< counted from 1
    bool prepares;         ///< the environment, or materials, before the frame
    const char *cache;     ///< cache folder for filtered environments; NULL: none
    char cache_folder[CACHE_FOLDER_SIZE];
    const char *fit_cache; ///< cache folder for fitted mixtures; NULL: none
    char fit_cache_folder[CACHE_FOLDER_SIZE];
} render_state;

// ---------------------------------------------------------------------------------------------
// Usage

static bool is_png(const char *path) {
    return output_file_has_ending(path, ".png");
}

/// Whether an output is a picture (`png`), or contains radiance.
static bool writes(const render_request *request, bool png) {
    for (size_t i = 0; i < request->outputs.count; i++) {
        if (is_png(request->outputs.values[i]) == png)
            return true;
    }
    return false;
}

static int check_outputs(const option_table *table, const render_request *request) {
    if (request->outputs.count == 0)
        return options_usage_error(table, "no output: give -o FILE.exr or -o FILE.png");
    for (size_t i = 0; i < request->outputs.count; i++) {
        const char *path = request->outputs.values[i];
        if (!is_png(path) && !output_file_has_ending(path, ".exr"))
            return options_usage_error(table, "output '%s' ends neither in .exr nor in .png", path);
    }
    return 0;
}

static int check_budget(const option_table *table, const render_request *request) {
    if (request->budget.sweep && request->material)
        return options_usage_error(table, "--sweep and --material exclude each other: sweeps "
                                          "measure scenes");
    const char *fixed = request->has_filter              ? "--filter"
                        : request->assignments.count > 0 ? "--set"
                                                         : NULL;
    return budget_options_check(table, &request->budget, fixed);
}

static int check_usage(const option_table *table, render_request *request) {
    int status = scene_options_check_source(table, request->scene, request->material);
    if (status != 0)
        return status;
    if (request->has_carrier && !request->material)
        return options_usage_error(table, "--carrier needs --material");
    if (request->size[0] == 0 || request->size[1] == 0)
        return options_usage_error(table, "--size: no pixels in %ux%u", request->size[0],
                                   request->size[1]);
    if (!frame_sequence_parse(request->frames_text, &request->frames))
        return options_usage_error(table,
                                   "--frames: '%s' is neither a number of frames from 1 to %d nor "
                                   "a range A..B",
                                   request->frames_text, FRAME_SEQUENCE_MAXIMUM);
    status = check_budget(table, request);
    if (status == 0)
        status = cache_options_check(table, &request->cache);
    return status == 0 ? check_outputs(table, request) : status;
}

static int choose_filter(render_request *request, const lobe_host *host) {
    if (budget_options_limit(&request->budget))
        return 0; // picked once scene and device are known
    if (!request->has_filter)
        request->filter_name = scene_list_filter(request->scene);
    return filter_choice_make(request->filter_name, &request->assignments, host, &request->filter,
                              &request->settings);
}

static void warn_of_what_is_ignored(const render_request *request, const lobe_host *host) {
    if (!writes(request, false) && request->has_depth)
        lobe_host_log(host, LOBE_LOG_WARNING, "--depth is for .exr outputs; ignored");
    if (!writes(request, false) && request->layers)
        lobe_host_log(host, LOBE_LOG_WARNING, "--aov is for .exr outputs; ignored");
    if (!writes(request, false) && request->has_motion)
        lobe_host_log(host, LOBE_LOG_WARNING, "--motion is for .exr outputs; ignored");
    if (!writes(request, true) && request->has_exposure)
        lobe_host_log(host, LOBE_LOG_WARNING, "--exposure is for .png outputs; ignored");
    if (request->has_samples && !(request->filter && lobe_filter_supersamples(request->filter)))
        lobe_host_log(host, LOBE_LOG_WARNING, "--samples is for the filter reference; ignored");
}

// ---------------------------------------------------------------------------------------------
// Work

static lobe_result open_scene(render_request *request, render_state *state) {
    request->opening.has_lights = request->view.lights.count > 0;
    if (request->material)
        return scene_options_open_material(&request->opening, request->material,
                                           (lobe_carrier)request->carrier, &state->host,
                                           &state->scene);
    return scene_options_open(&request->opening, request->scene, request->size, &state->host,
                              &state->scene);
}

static bool has_own_view(const render_request *request) {
    const view_options *view = &request->view;
    return !view->has_eye && !view->has_target && !view->has_field_of_view && view->path == 0 &&
           view->lights.count == 0;
}

static lobe_result pick_filter(render_request *request, render_state *state) {
    if (!budget_options_limit(&request->budget))
        return LOBE_OK;
    char lighting[SCENE_OPTIONS_DESCRIPTION];
    scene_options_describe(&request->opening, lighting);
    const budget_picture picture = {
        .name = request->scene,
        .scene = state->scene,
        .lighting = lighting,
        .own_view = has_own_view(request),
        .device = state->device,
        .size = {request->size[0], request->size[1]},
    };
    return budget_pick(&request->budget, &picture, &state->host, &state->figures, &request->filter,
                       &request->settings);
}

static double seconds_of(const render_request *request, uint32_t n) {
    return frame_sequence_seconds(&request->frames, request->time, n);
}

static lobe_result check_last_frame(const render_request *request, const render_state *state) {
    const double seconds = seconds_of(request, request->frames.count - 1);
    if (seconds <= ANIMATION_MAXIMUM_SECONDS)
        return LOBE_OK;
    return lobe_host_fail(&state->host, LOBE_ERROR_INVALID_ARGUMENT,
                          "%s: the last frame is at %.1f s; expected at most %d s",
                          state->scene->name, seconds, ANIMATION_MAXIMUM_SECONDS);
}

static lobe_result choose_animation(const render_request *request, render_state *state) {
    size_t index;
    lobe_result result = animation_find(state->scene, request->animation, &state->host, &index);
    return result == LOBE_OK ? animation_set_index(state->animation, index) : result;
}

static lobe_result animate(const render_request *request, render_state *state) {
    lobe_result result =
        animation_create(state->device, state->scene, &state->host, &state->animation);
    const char *consequence = request->has_time          ? "--time makes no difference"
                              : request->animation       ? "--animation makes no difference"
                              : request->frames.numbered ? "all pictures are equal"
                                                         : NULL;
    if (result == LOBE_OK && !state->animation && consequence)
        lobe_host_log(&state->host, LOBE_LOG_WARNING, "%s: does not change with time: %s",
                      state->scene->name, consequence);
    if (result == LOBE_OK && state->animation)
        result = check_last_frame(request, state);
    if (result == LOBE_OK && request->animation)
        result = choose_animation(request, state);
    if (result == LOBE_OK)
        animation_attach(state->animation, state->renderer);
    return result;
}

static lobe_result open_renderer(render_request *request, render_state *state) {
    lobe_result result = device_options_open(&request->device, &state->host, &state->device);
    if (result == LOBE_OK)
        result = pick_filter(request, state);
    if (result == LOBE_OK)
        result = lobe_renderer_create(state->device, &state->host, &state->renderer);
    if (result == LOBE_OK)
        result = animate(request, state);
    if (state->scene->environment)
        state->cache = cache_options_find(&request->cache, "environments", state->cache_folder);
    if (lobe_filter_fits(request->filter))
        state->fit_cache = cache_options_find(&request->cache, "mixtures", state->fit_cache_folder);
    if (result == LOBE_OK)
        result = lobe_renderer_set_scene(state->renderer, state->scene);
    return result;
}

static uint32_t samples_of(const render_request *request) {
    return lobe_filter_supersamples(request->filter) ? request->samples : 1;
}

static void begin_frame(render_state *state) {
    progress_step(&state->progress, "%s: frame %u of %u", state->scene->name, state->frame_number,
                  state->sequence->count);
}

/// What is prepared before the frame is drawn.
static bool report_preparation(render_state *state, const char *what, double part) {
    if (!state->prepares)
        progress_step(&state->progress, "%s: preparing %s", state->scene->name, what);
    state->prepares = part < 1;
    progress_part(&state->progress, part);
    if (!state->prepares)
        begin_frame(state);
    return true;
}

static bool report_environment(void *user, double part) {
    render_state *state = user;
    return report_preparation(state, state->scene->environment->name, part);
}

static bool report_fits(void *user, double part) {
    return report_preparation(user, "materials", part);
}

static bool report_samples(void *user, double part) {
    return progress_part(&((render_state *)user)->progress, part);
}

static lobe_result render_frame(const render_request *request, render_state *state) {
    lobe_frame_free(&state->frame);
    // Only a terminal shows it, and the graph to write is that of all that made the picture.
    const bool prepares = state->progress.terminal && !request->graph;
    lobe_result result = lobe_renderer_render(
        state->renderer,
        &(lobe_render_parameters){
            .filter = request->filter,
            .settings = &request->settings,
            .width = request->size[0],
            .height = request->size[1],
            .reference.samples = request->samples,
            .environment.cache = state->cache,
            .fits.cache = state->fit_cache,
            .aov = request->layers && writes(request, false),
            .motion = {.deliver = request->has_motion && writes(request, false),
                       .previous_camera = &state->previous},
            .host = {.progress = report_samples,
                     .environment_progress = prepares ? report_environment : NULL,
                     .fits_progress = prepares ? report_fits : NULL,
                     .user = state},
        },
        &state->frame);
    return result == LOBE_OK ? frame_times_add(&state->times, &state->frame, &state->host) : result;
}

/// What the knob `view` shows instead of light may be 0.
static bool shows_light(const render_request *request) {
    double view;
    return lobe_settings_get(request->filter, &request->settings, "view", &view, NULL) != LOBE_OK ||
           view == 0;
}

static void warn_of_a_black_picture(const render_request *request, const render_state *state) {
    const lobe_scene *scene = state->scene;
    const bool dark = scene->light_count == 0 && !scene->environment;
    if (shows_light(request) && empty_picture_is_black(&state->frame.radiance))
        lobe_host_log(&state->host, LOBE_LOG_WARNING, "%s: the picture is black: %s", scene->name,
                      dark ? "nothing lights it: see --light and --environment"
                           : "no light reaches what the camera sees");
}

static void warn_of_an_empty_picture(const render_request *request, const render_state *state) {
    char why[256];
    if (!empty_picture_recognise(&state->frame.radiance)) {
        warn_of_a_black_picture(request, state);
        return;
    }
    empty_picture_explain(state->scene, (double)request->size[0] / request->size[1], why,
                          sizeof why);
    lobe_host_log(&state->host, LOBE_LOG_WARNING, "%s: the picture is empty: %s",
                  state->scene->name, why);
}

static lobe_result write_graph(const render_request *request, render_state *state) {
    if (!request->graph)
        return LOBE_OK;
    lobe_graph *graph = lobe_renderer_graph(state->renderer);
    char *text = output_file_has_ending(request->graph, ".txt") ? lobe_graph_dump_text(graph)
                                                                : lobe_graph_dump_graphviz(graph);
    lobe_result result = LOBE_ERROR_OUT_OF_MEMORY;
    if (text)
        result = output_file_write(request->graph, text, &state->host);
    else
        lobe_host_log(&state->host, LOBE_LOG_ERROR, "%s: out of memory", request->graph);
    lobe_release(text);
    return result;
}

/// The n-th frame's file of an output.
static lobe_result name_file(const render_request *request, size_t output, uint32_t n,
                             const lobe_host *host, char path[PATH_MAX]) {
    if (frame_sequence_path(&request->frames, request->outputs.values[output], n, path))
        return LOBE_OK;
    return lobe_host_fail(host, LOBE_ERROR_WRITE, "%s: the name is too long",
                          request->outputs.values[output]);
}

/// Of the n-th frame.
static lobe_result write_images(const render_request *request, render_state *state, uint32_t n) {
    lobe_result result = frame_times_finish(&state->times);
    const capture capture = {
        .frame = &state->frame,
        .scene = state->scene->name,
        .environment = state->scene->environment ? state->scene->environment->name : NULL,
        .filter = request->filter,
        .settings = &request->settings,
        .samples = samples_of(request),
        .device = lobe_device_describe(state->device),
        .times = &state->times.summary,
        .animated = state->animation != NULL,
        .seconds = seconds_of(request, n),
        .first_frame = frame_times_are_first(&state->times),
        .depth = (lobe_exr_depth)request->depth,
        .exposure = request->exposure,
    };
    for (size_t i = 0; result == LOBE_OK && i < request->outputs.count; i++) {
        char path[PATH_MAX];
        result = name_file(request, i, n, &state->host, path);
        if (result == LOBE_OK)
            result = is_png(path) ? capture_write_png(path, &capture, &state->host)
                                  : capture_write_exr(path, &capture, &state->host);
    }
    return result;
}

/// The first frame builds the maps, later ones retain them unless they change with time.
static lobe_result render_frames(const render_request *request, render_state *state) {
    lobe_result result = LOBE_OK;
    state->sequence = &request->frames;
    for (uint32_t i = 0; result == LOBE_OK && i < request->frames.count; i++) {
        state->frame_number = i + 1;
        begin_frame(state);
        result = animation_set_time(state->animation, seconds_of(request, i));
        if (result == LOBE_OK)
            result = render_frame(request, state);
        if (result == LOBE_OK && request->frames.numbered)
            result = write_images(request, state, i);
    }
    progress_end(&state->progress);
    return result == LOBE_OK ? device_options_check(state->device, &state->host) : result;
}

static void print_times(const render_request *request, const render_state *state) {
    const lobe_device_information *device = lobe_device_describe(state->device);
    printf("%s, filter %s, %ux%u, %u sample%s per pixel, on %s%s\n", state->scene->name,
           lobe_filter_name(request->filter), request->size[0], request->size[1],
           samples_of(request), samples_of(request) == 1 ? "" : "s", device->name,
           device->type == LOBE_DEVICE_CPU ? " (a CPU: times are those of a software renderer)"
                                           : "");
    frame_times_print(&state->times);
}

/// Checks early, so that a misspelt folder does not cost minutes of waiting.
static lobe_result check_files(const render_request *request, const lobe_host *host) {
    lobe_result result = output_file_check(request->graph, host);
    const uint32_t files = request->frames.numbered ? request->frames.count : 1;
    for (size_t i = 0; i < request->outputs.count; i++) {
        for (uint32_t n = 0; result == LOBE_OK && n < files; n++) {
            char path[PATH_MAX];
            result = name_file(request, i, n, host, path);
            if (result == LOBE_OK)
                result = output_file_check(path, host);
        }
    }
    return result;
}

/// Before the camera moves to where it is now.
static void place_previous_camera(const render_request *request, render_state *state) {
    lobe_scene scene = *state->scene;
    view_options view = request->view;
    view.path = request->motion;
    (void)view_options_apply(&view, NULL, &scene);
    state->previous = scene.camera;
}

static lobe_result render(render_request *request, render_state *state) {
    lobe_result result = check_files(request, &state->host);
    if (result == LOBE_OK)
        result = budget_read(&request->budget, request->scene, &state->host, &state->figures);
    if (result == LOBE_OK)
        result = open_scene(request, state);
    if (result != LOBE_OK)
        return result;
    place_previous_camera(request, state);
    if (!view_options_apply(&request->view, request->lights, state->scene)) {
        lobe_host_log(&state->host, LOBE_LOG_ERROR, "camera: eye and target are the same point");
        return LOBE_ERROR_INVALID_ARGUMENT;
    }
    request->lights = NULL; // owned by the scene now
    result = open_renderer(request, state);
    if (result == LOBE_OK)
        result = render_frames(request, state);
    if (result == LOBE_OK)
        warn_of_an_empty_picture(request, state);
    if (result == LOBE_OK)
        result = write_graph(request, state);
    if (result == LOBE_OK && !request->frames.numbered)
        result = write_images(request, state, 0);
    if (result == LOBE_OK)
        print_times(request, state);
    return result;
}

static void free_state(render_state *state) {
    frame_times_free(&state->times);
    lobe_frame_free(&state->frame);
    lobe_renderer_destroy(&state->renderer);
    animation_destroy(&state->animation);
    lobe_device_destroy(&state->device);
    sweep_results_free(&state->figures);
    lobe_scene_destroy(&state->scene);
}

static int run_request(const option_table *table, render_request *request) {
    render_state state = {.host = console_host(false), .progress = progress_begin(false)};
    int status = check_usage(table, request);
    if (status == 0)
        status = choose_filter(request, &state.host);
    if (status == 0)
        status = view_options_parse_lights(table, &request->view, &request->lights);
    if (status != 0)
        return status;
    warn_of_what_is_ignored(request, &state.host);
    lobe_result result = render(request, &state);
    free_state(&state);
    lobe_release(request->lights);
    return result == LOBE_OK ? 0 : 1;
}

// ---------------------------------------------------------------------------------------------
// Options

static const char *const carriers[] = {"plane", "sphere", "cloth", NULL};
static const char *const depths[] = {"half", "float", NULL};

static int run(int argc, char **argv) {
    render_request request = {0};
    option_list operands = {0};
    const option options[] = {
        {.name = "output",
         .letter = 'o',
         .kind = OPTION_LIST,
         .argument = "FILE",
         .summary = "output: FILE.exr has linear radiance and all details of "
                    "the rendering, FILE.png is tone-mapped for viewing",
         .target = &request.outputs},
        {.name = "filter",
         .kind = OPTION_TEXT,
         .argument = "NAME",
         .summary = "the appearance filter, see 'lobe filters'; of the scene ocean, leadr",
         .target = &request.filter_name,
         .fallback = "moments",
         .values = OPTION_VALUES_FILTER,
         .given = &request.has_filter},
        filter_option_set(&request.assignments),
        budget_option_milliseconds(&request.budget),
        budget_option_error(&request.budget),
        budget_option_sweep(&request.budget),
        budget_option_maps(&request.budget),
        {.name = "size",
         .kind = OPTION_SIZE,
         .argument = "WxH",
         .summary = "picture size in pixels; the device sets the limit",
         .target = request.size,
         .fallback = "1280x720"},
        {.name = "samples",
         .kind = OPTION_INTEGER,
         .argument = "N",
         .summary = "samples per pixel, for the filter reference only",
         .target = &request.samples,
         .fallback = "64",
         .minimum = 1,
         .maximum = LOBE_MAXIMUM_SAMPLES,
         .given = &request.has_samples},
        view_option_eye(&request.view),
        view_option_target(&request.view),
        view_option_field_of_view(&request.view),
        view_option_path(&request.view),
        view_option_light(&request.view),
        {.name = "time",
         .kind = OPTION_NUMBER,
         .argument = "SECONDS",
         .summary = "the time in a scene that changes with time",
         .target = &request.time,
         .fallback = "0",
         .minimum = 0,
         .maximum = ANIMATION_MAXIMUM_SECONDS,
         .given = &request.has_time},
        {.name = "animation",
         .kind = OPTION_TEXT,
         .argument = "NAME",
         .summary = "which animation of a file: a name, an index from 0 on, or 'all' at once "
                    "(default: the first)",
         .target = &request.animation},
        {.name = "frames",
         .kind = OPTION_TEXT,
         .argument = "N|A..B",
         .summary = "N: draw the picture this many times and write the last one: the first "
                    "compiles shaders and builds the maps, later ones retain them; their times are "
                    "apart. A..B: draw these frames of an animation, of 1/30 s after --time each, "
                    "and write each to files of its own: FILE-0012.exr",
         .target = &request.frames_text,
         .fallback = "1"},
        {.name = "material",
         .kind = OPTION_TEXT,
         .argument = "DIR",
         .summary = "instead of SCENE: a folder of PBR maps, put on a carrier",
         .target = &request.material},
        {.name = "carrier",
         .kind = OPTION_CHOICE,
         .argument = "SHAPE",
         .summary = "what carries the material",
         .target = &request.carrier,
         .fallback = "plane",
         .choices = carriers,
         .given = &request.has_carrier},
        scene_option_assets(&request.opening),
        scene_option_environment(&request.opening),
        scene_option_rotation(&request.opening),
        scene_option_intensity(&request.opening),
        scene_option_background(&request.opening),
        scene_option_no_lights(&request.opening),
        cache_option_folder(&request.cache),
        cache_option_off(&request.cache),
        {.name = "depth",
         .kind = OPTION_CHOICE,
         .argument = "DEPTH",
         .summary = "number format of radiance in the .exr",
         .target = &request.depth,
         .fallback = "half",
         .choices = depths,
         .given = &request.has_depth},
        {.name = "aov",
         .kind = OPTION_FLAG,
         .summary = "add layers to the .exr: normal, depth, lobes (their count), level; in float",
         .target = &request.layers},
        {.name = "motion",
         .kind = OPTION_NUMBER,
         .argument = "PART",
         .summary =
             "add a layer to the .exr: by how many pixels, to the right and down, each point "
             "is away from where it was when the camera was at that place of its path",
         .target = &request.motion,
         .minimum = 0,
         .maximum = 1,
         .given = &request.has_motion},
        {.name = "exposure",
         .kind = OPTION_NUMBER,
         .argument = "STOPS",
         .summary = "brighten the .png",
         .target = &request.exposure,
         .fallback = "0",
         .minimum = -100,
         .maximum = 100,
         .given = &request.has_exposure},
        {.name = "graph",
         .kind = OPTION_TEXT,
         .argument = "FILE",
         .summary = "write the compiled render graph of the last frame: as text if the name "
                    "ends in .txt, else as Graphviz",
         .target = &request.graph},
        device_option_select(&request.device),
        device_option_validation(&request.device),
    };
    const option_table table = {
        .program = "lobe render",
        .operands = "SCENE -o FILE",
        .summary =
            "Renders a picture of SCENE, which is the name of a built-in scene (see 'lobe\n"
            "scenes'), the path of a .gltf or .glb file, or a folder of PBR maps to put on a\n"
            "cloth; and prints the time of each pass.",
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

const subcommand render_subcommand = {"render", "render a scene to an OpenEXR or PNG file", run};
