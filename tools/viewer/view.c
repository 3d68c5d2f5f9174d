#include <stdlib.h>

#include <lobe/lobe.h>

#include "tools/choice/filter_choice.h"
#include "tools/cli/console.h"
#include "tools/cli/subcommand.h"
#include "tools/manual/roff.h"
#include "tools/scenes/scene_list.h"
#include "tools/viewer/keys.h"
#include "tools/viewer/viewer.h"

/// Parsed values before they become a request.
typedef struct view_texts {
    const char *filter_name;
    bool has_filter;
    option_list assignments; ///< "KNOB=VALUE"
} view_texts;

static int choose_filter(const view_texts *texts, viewer_request *request, const lobe_host *host) {
    const char *name = texts->has_filter ? texts->filter_name : scene_list_filter(request->scene);
    return filter_choice_make(name, &texts->assignments, host, &request->filter,
                              &request->settings);
}

static int check_usage(const option_table *table, const viewer_request *request) {
    if (!request->scene)
        return options_usage_error(table, "no SCENE");
    if (request->exit && request->frames == 0)
        return options_usage_error(table, "--exit needs --frames");
    return cache_options_check(table, &request->cache);
}

static int run_request(const option_table *table, const view_texts *texts,
                       viewer_request *request) {
    const lobe_host host = console_host(false);
    int status = check_usage(table, request);
    if (status == 0)
        status = choose_filter(texts, request, &host);
    if (status == 0)
        status = view_options_parse_lights(table, &request->view, &request->lights);
    if (status != 0)
        return status;
    return viewer_run(request, &host) == LOBE_OK ? 0 : 1;
}

/// The keys, from the table that also makes the help in the window.
static void describe_keys(FILE *stream) {
    roff_section(stream, "KEYS");
    for (size_t i = 0; i < viewer_key_count; i++)
        roff_item(stream, viewer_keys[i].name, NULL, viewer_keys[i].summary);
}

static int run(int argc, char **argv) {
    viewer_request request = {0};
    view_texts texts = {0};
    option_list operands = {0};
    const option options[] = {
        {.name = "filter",
         .kind = OPTION_TEXT,
         .argument = "NAME",
         .summary = "the initial appearance filter, see 'lobe filters'; of the scene ocean, leadr",
         .target = &texts.filter_name,
         .fallback = "moments",
         .values = OPTION_VALUES_FILTER,
         .given = &texts.has_filter},
        filter_option_set(&texts.assignments),
        {.name = "size",
         .kind = OPTION_SIZE,
         .argument = "WxH",
         .summary = "the initial size of the window in pixels",
         .target = request.size,
         .fallback = "1280x720",
         .minimum = 1,
         .maximum = 16384},
        {.name = "samples",
         .kind = OPTION_INTEGER,
         .argument = "N",
         .summary = "samples per pixel up to which the filter reference is refined",
         .target = &request.samples,
         .fallback = "256",
         .minimum = 1,
         .maximum = LOBE_MAXIMUM_SAMPLES},
        view_option_eye(&request.view),
        view_option_target(&request.view),
        view_option_field_of_view(&request.view),
        view_option_path(&request.view),
        view_option_light(&request.view),
        scene_option_assets(&request.opening),
        scene_option_environment(&request.opening),
        scene_option_rotation(&request.opening),
        scene_option_intensity(&request.opening),
        scene_option_background(&request.opening),
        {.name = "exposure",
         .kind = OPTION_NUMBER,
         .argument = "STOPS",
         .summary = "the initial brightening of the picture",
         .target = &request.exposure,
         .fallback = "0",
         .minimum = -VIEWER_MAXIMUM_EXPOSURE,
         .maximum = VIEWER_MAXIMUM_EXPOSURE},
        {.name = "animation",
         .kind = OPTION_TEXT,
         .argument = "NAME",
         .summary = "which animation of a file: a name, an index from 0 on, or 'all' at once "
                    "(default: the first)",
         .target = &request.animation},
        {.name = "path-frames",
         .kind = OPTION_INTEGER,
         .argument = "N",
         .summary = "number of frames of the camera's path",
         .target = &request.path_frames,
         .fallback = "240",
         .minimum = 2,
         .maximum = 100000},
        {.name = "output",
         .letter = 'o',
         .kind = OPTION_TEXT,
         .argument = "DIR",
         .summary = "where recorded frames are written, as SCENE-NUMBER.exr",
         .target = &request.folder,
         .fallback = "."},
        {.name = "frames",
         .kind = OPTION_INTEGER,
         .argument = "N",
         .summary = "draw at least this many frames before the window may idle",
         .target = &request.frames,
         .fallback = "0",
         .minimum = 0,
         .maximum = 1000000},
        {.name = "exit",
         .kind = OPTION_FLAG,
         .summary = "close the window after those",
         .target = &request.exit},
        cache_option_folder(&request.cache),
        cache_option_off(&request.cache),
        device_option_select(&request.device),
        device_option_validation(&request.device),
    };
    const option_table table = {
        .program = "lobe view",
        .operands = "SCENE",
        .summary =
            "Shows SCENE in a window: the name of a built-in scene (see 'lobe scenes'), the\n"
            "path of a .gltf or .glb file, or a folder of PBR maps. Filter, knobs and what\n"
            "they are compared with are chosen there; F1 shows the keys. A glTF file, a\n"
            "folder of maps, or an .hdr or .exr environment can be dropped onto the window.",
        .options = options,
        .option_count = sizeof options / sizeof *options,
        .maximum_operands = 1,
        .operand_values = OPTION_VALUES_SCENE,
        .manual = describe_keys,
    };
    int status;
    if (options_parse(&table, argc, argv, &operands, &status)) {
        request.scene = operands.count > 0 ? operands.values[0] : NULL;
        status = run_request(&table, &texts, &request);
    }
    options_free(&table, &operands);
    return status;
}

const subcommand view_subcommand = {"view", "show a scene in a window, live", run};
