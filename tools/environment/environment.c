#include <stdio.h>
#include <string.h>

#include <lobe/lobe.h>

#include "tools/cli/cache_options.h"
#include "tools/cli/console.h"
#include "tools/cli/device_options.h"
#include "tools/cli/output_file.h"
#include "tools/cli/subcommand.h"
#include "tools/environment/check.h"
#include "tools/environment/check_passes.h"
#include "tools/environment/output.h"

/// Face sizes that are checked by default.
static const uint32_t checked_faces[] = {128, 256};
#define CHECKED_FACES 2

typedef struct environment_request {
    const char *file, *output, *json;
    uint32_t face, kernel, directions;
    double kappa;
    bool check, has_face, has_directions, has_kappa;
    cache_options cache;
    device_options device;
} environment_request;

typedef struct environment_state {
    lobe_host host;
    progress progress;
    lobe_device *device;
    lobe_environment *environment;
} environment_state;

// ---------------------------------------------------------------------------------------------
// Usage

static int check_usage(const option_table *table, const environment_request *request) {
    if ((request->face & (request->face - 1)) != 0)
        return options_usage_error(table, "--face: %u is not a power of two", request->face);
    if (request->json && !request->check)
        return options_usage_error(table, "--json needs --check");
    if (request->has_directions && !request->check)
        return options_usage_error(table, "--directions needs --check");
    if (request->has_kappa && !request->check)
        return options_usage_error(table, "--kappa needs --check");
    if (request->output && !output_file_has_ending(request->output, ".exr"))
        return options_usage_error(table, "-o: '%s' does not end in .exr", request->output);
    return cache_options_check(table, &request->cache);
}

// ---------------------------------------------------------------------------------------------
// What is done

static lobe_result prepare(const environment_request *request, environment_state *state) {
    environment_output output = {
        .environment = state->environment,
        .map = request->kernel == 0 ? LOBE_ENVIRONMENT_VON_MISES_FISHER : LOBE_ENVIRONMENT_GGX,
        .size = request->face,
        .host = &state->host,
    };
    char folder[CACHE_FOLDER_SIZE];
    lobe_environment_maps_parameters parameters = {
        .environment = state->environment,
        .size = request->face,
        .parts_per_submission = 1,
        .progress = progress_part,
        .user = &state->progress,
        .host = &state->host,
    };
    parameters.wanted[output.map] = true;
    parameters.cache = cache_options_find(&request->cache, "environments", folder);
    progress_step(&state->progress, "%s: preparing", state->environment->name);
    lobe_result result = lobe_environment_maps_create(state->device, &parameters, &output.maps);
    progress_end(&state->progress);
    if (result == LOBE_OK && request->output)
        result = environment_output_write(&output, request->output);
    if (result == LOBE_OK)
        environment_output_print(&output);
    lobe_environment_maps_destroy(&output.maps);
    return result;
}

static lobe_result check_face(const environment_check_job *job, uint32_t face,
                              environment_findings *findings) {
    lobe_result result = environment_check_run(job, face, findings);
    progress_end(job->progress);
    if (result == LOBE_OK)
        environment_check_print(findings);
    return result;
}

static lobe_result check(const environment_request *request, environment_state *state) {
    environment_check_job job = {
        .device = state->device,
        .host = &state->host,
        .progress = &state->progress,
        .environment = state->environment,
        .kappa = request->kappa,
        .directions = request->directions,
        .rounds = 5,
    };
    environment_findings findings[CHECKED_FACES];
    size_t count = request->has_face ? 1 : CHECKED_FACES;
    lobe_result result = environment_check_add_shaders(state->device);
    for (size_t i = 0; result == LOBE_OK && i < count; i++)
        result =
            check_face(&job, request->has_face ? request->face : checked_faces[i], &findings[i]);
    if (result == LOBE_OK && request->json)
        result = environment_check_write(request->json, &job, findings, count);
    return result;
}

static lobe_result execute(const environment_request *request, environment_state *state) {
    lobe_result result = output_file_check(request->output, &state->host);
    if (result == LOBE_OK)
        result = output_file_check(request->json, &state->host);
    if (result == LOBE_OK)
        result = lobe_environment_open(request->file, &state->host, &state->environment);
    if (result == LOBE_OK)
        result = device_options_open(&request->device, &state->host, &state->device);
    if (result == LOBE_OK)
        lobe_environment_shrink(state->environment,
                                lobe_device_describe(state->device)->maximum_image_extent);
    if (result == LOBE_OK && (request->output || !request->check))
        result = prepare(request, state);
    if (result == LOBE_OK && request->check)
        result = check(request, state);
    if (result == LOBE_OK)
        result = device_options_check(state->device, &state->host);
    return result;
}

static int run_request(const option_table *table, const environment_request *request) {
    environment_state state = {.host = console_host(false), .progress = progress_begin(false)};
    int status = check_usage(table, request);
    if (status != 0)
        return status;
    lobe_result result = execute(request, &state);
    lobe_environment_destroy(&state.environment);
    lobe_device_destroy(&state.device);
    return result == LOBE_OK ? 0 : 1;
}

// ---------------------------------------------------------------------------------------------
// Options

static const char *const kernels[] = {"vmf", "ggx", NULL};

static int run(int argc, char **argv) {
    environment_request request = {0};
    option_list operands = {0};
    const option options[] = {
        {.name = "output",
         .letter = 'o',
         .kind = OPTION_TEXT,
         .argument = "FILE.exr",
         .summary = "write the filtered cube: a file of MIP levels, with the faces in a column",
         .target = &request.output,
         .values = OPTION_VALUES_FILE},
        {.name = "face",
         .kind = OPTION_INTEGER,
         .argument = "N",
         .summary = "texels per side of a cube face, a power of two; --check without it measures "
                    "128 and 256",
         .target = &request.face,
         .fallback = "256",
         .minimum = 16,
         .maximum = 2048,
         .given = &request.has_face},
        {.name = "kernel",
         .kind = OPTION_CHOICE,
         .argument = "LOBE",
         .summary = "lobes to filter the cube with: von Mises-Fisher or GGX",
         .target = &request.kernel,
         .fallback = "vmf",
         .choices = kernels},
        {.name = "check",
         .kind = OPTION_FLAG,
         .summary =
             "measure the error of each method of lighting von Mises-Fisher lobes against the "
             "exact integral over all texels, and its time",
         .target = &request.check},
        {.name = "json",
         .kind = OPTION_TEXT,
         .argument = "FILE",
         .summary = "with --check: write the results as JSON",
         .target = &request.json},
        {.name = "directions",
         .kind = OPTION_INTEGER,
         .argument = "N",
         .summary = "with --check: number of lobe directions, spread over the sphere",
         .target = &request.directions,
         .fallback = "4096",
         .minimum = 1,
         .maximum = 65536,
         .given = &request.has_directions},
        {.name = "kappa",
         .kind = OPTION_NUMBER,
         .argument = "K",
         .summary =
             "with --check: the concentration of the broadest of seven lobes, each four times "
             "as concentrated as the one before; 1: lobes that the levels represent, 2: lobes "
             "half way between levels",
         .target = &request.kappa,
         .fallback = "1",
         .minimum = 0.01,
         .maximum = 100,
         .given = &request.has_kappa},
        cache_option_folder(&request.cache),
        cache_option_off(&request.cache),
        device_option_select(&request.device),
        device_option_validation(&request.device),
    };
    const option_table table = {
        .program = "lobe environment",
        .operands = "FILE",
        .summary =
            "Prepares the light of an environment, for lobes of any width: FILE is an image of\n"
            "all directions, OpenEXR or Radiance (.hdr), as latitude and longitude or as the "
            "faces\n"
            "of a cube, or 'sky', which is made by code. Prints what each level of the filtered\n"
            "cube represents, and the times of the passes that make it.",
        .options = options,
        .option_count = sizeof options / sizeof *options,
        .minimum_operands = 1,
        .maximum_operands = 1,
        .operand_values = OPTION_VALUES_FILE,
    };
    int status;
    if (options_parse(&table, argc, argv, &operands, &status)) {
        request.file = operands.values[0];
        status = run_request(&table, &request);
    }
    options_free(&table, &operands);
    return status;
}

const subcommand environment_subcommand = {
    "environment", "prepare light from all around, and check how well it is looked up", run};
