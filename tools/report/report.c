#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include <lobe/file.h>
#include <lobe/image.h>

#include "tools/cli/console.h"
#include "tools/cli/options.h"
#include "tools/cli/subcommand.h"
#include "tools/report/picture_stream.h"
#include "tools/report/script.h"
#include "tools/sweep/results.h"

/// `lobe report` checks the results, reads their pictures and writes the page, which a Python
/// script draws.
typedef struct report_request {
    const char *results, *folder;
    const char *targets; ///< NULL: none
    uint32_t picture_width;
    lobe_host host;
} report_request;

// ---------------------------------------------------------------------------------------------
// Making

/// The script reads the pictures from its standard input.
static lobe_result start_script(const report_request *request, report_script *script) {
    char width[16];
    snprintf(width, sizeof width, "%u", request->picture_width);
    const char *arguments[REPORT_SCRIPT_ARGUMENTS + 1] = {"--picture-width", width};
    size_t count = 2;
    if (request->targets) {
        arguments[count++] = "--targets";
        arguments[count++] = request->targets;
    }
    arguments[count++] = "--";
    arguments[count++] = request->results;
    return report_script_start(arguments, &request->host, script);
}

/// Returns the page as text; the caller frees it with free().
static lobe_result make_page(const report_request *request, char **text, size_t *size) {
    sweep_results results;
    report_script script;
    *text = NULL;
    lobe_result result = sweep_results_read(request->results, &request->host, &results);
    if (result != LOBE_OK)
        return result;
    result = start_script(request, &script);
    if (result == LOBE_OK) {
        result = picture_stream_write(script.input, &results, request->results, &request->host);
        lobe_result finished = report_script_finish(&script, &request->host, text, size);
        result = result == LOBE_OK ? finished : result;
    }
    sweep_results_free(&results);
    return result;
}

// ---------------------------------------------------------------------------------------------
// Writing

static lobe_result write_page(const report_request *request, const char *text, size_t size) {
    char *path = malloc(strlen(request->folder) + sizeof "/index.html");
    if (!path)
        return lobe_host_fail(&request->host, LOBE_ERROR_OUT_OF_MEMORY, "%s: out of memory",
                              request->folder);
    sprintf(path, "%s/index.html", request->folder);
    lobe_result result = lobe_file_write(path, text, size, &request->host);
    free(path);
    return result;
}

/// The folder may exist. One created here, before the work starts, is removed again if there is no
/// page to put in it.
static int make_report(const report_request *request) {
    const bool made = mkdir(request->folder, 0777) == 0;
    if (!made && errno != EEXIST) {
        (void)lobe_host_fail(&request->host, LOBE_ERROR_WRITE, "%s: cannot be made: %s",
                             request->folder, strerror(errno));
        return 1;
    }
    char *text;
    size_t size;
    lobe_result result = make_page(request, &text, &size);
    if (result == LOBE_OK)
        result = write_page(request, text, size);
    free(text);
    if (result != LOBE_OK && made)
        rmdir(request->folder);
    return result == LOBE_OK ? 0 : 1;
}

// ---------------------------------------------------------------------------------------------
// Command line

static int run(int argc, char **argv) {
    report_request request = {.host = console_host(false)};
    const option options[] = {
        {.name = "output",
         .letter = 'o',
         .kind = OPTION_TEXT,
         .argument = "DIR",
         .summary = "folder that index.html is written to; created if it does not exist",
         .target = &request.folder},
        {.name = "picture-width",
         .kind = OPTION_INTEGER,
         .argument = "PIXELS",
         .summary = "wider pictures are downscaled, with a part of each shown at full size",
         .target = &request.picture_width,
         .fallback = "320",
         .minimum = 16,
         .maximum = LOBE_IMAGE_MAXIMUM_EXTENT},
        {.name = "targets",
         .kind = OPTION_TEXT,
         .argument = "FILE",
         .summary = "limits of ratios between filters, as JSON: show which are met",
         .target = &request.targets},
    };
    const option_table table = {
        .program = "lobe report",
        .operands = "RESULTS.json",
        .summary =
            "Draws the results of 'lobe bench --sweep' as one self-contained HTML page: for\n"
            "each scene the pictures with their error maps, error over time and over\n"
            "memory with the Pareto front, and the times of passes; means over the\n"
            "scenes; and the table of Xu et al. 2017 next to the same ratios here.\n"
            "Needs Python with matplotlib and Jinja2 (Debian: python3-matplotlib,\n"
            "python3-jinja2).",
        .options = options,
        .option_count = sizeof options / sizeof *options,
        .minimum_operands = 1,
        .maximum_operands = 1,
        .operand_values = OPTION_VALUES_FILE,
    };
    option_list operands = {0};
    int status;
    if (options_parse(&table, argc, argv, &operands, &status)) {
        request.results = operands.values[0];
        status = request.folder ? make_report(&request)
                                : options_usage_error(&table, "-o DIR is missing");
    }
    options_free(&table, &operands);
    return status;
}

const subcommand report_subcommand = {"report", "draw a sweep of the benchmark as an HTML page",
                                      run};
