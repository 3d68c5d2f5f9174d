#include "tools/report/report.h"

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

typedef struct report_request {
    const char *results, *folder;
    uint32_t picture_width;
    lobe_host host;
} report_request;

// ---------------------------------------------------------------------------------------------
// Making

static bool is_known(const report *report, const char *filter) {
    for (size_t i = 0; i < report->filter_count; ++i) {
        if (strcmp(report->filters[i], filter) == 0)
            return true;
    }
    return false;
}

static lobe_result find_filters(report *report) {
    for (size_t i = 0; i < report->results->row_count; ++i) {
        const char *filter = report->results->rows[i].filter;
        if (is_known(report, filter))
            continue;
        if (report->filter_count == REPORT_MAXIMUM_FILTERS)
            return lobe_host_fail(report->host, LOBE_ERROR_LIMIT, "%s: more than %d filters",
                                  report->path, REPORT_MAXIMUM_FILTERS);
        report->filters[report->filter_count++] = filter;
    }
    return LOBE_OK;
}

static void leave_out_noise(sweep_results *results) {
    for (size_t i = 0; i < results->row_count; ++i) {
        sweep_row *row = &results->rows[i];
        const sweep_scene *scene = sweep_results_scene(results, row->scene);
        if (scene)
            row->error.relative_l2 = sweep_error_without_noise(scene, row);
    }
}

/// The page as text, to free() by the caller.
static lobe_result write_text(report *report, char **text, size_t *size) {
    *text = NULL;
    lobe_result result = LOBE_OK;
    bool failed = true;
    report->page = open_memstream(text, size);
    if (report->page) {
        result = report_write_page(report);
        failed = ferror(report->page);
        failed = fclose(report->page) != 0 || failed;
    }
    if (result == LOBE_OK && failed)
        result = lobe_host_fail(report->host, LOBE_ERROR_OUT_OF_MEMORY,
                                "%s: no memory for the page", report->path);
    return result;
}

static lobe_result make_page(const report_request *request, char **text, size_t *size) {
    sweep_results results;
    struct stat status;
    *text = NULL;
    lobe_result result = sweep_results_read(request->results, &request->host, &results);
    if (result != LOBE_OK)
        return result;
    leave_out_noise(&results);
    report report = {.results = &results,
                     .path = request->results,
                     .picture_width = request->picture_width,
                     .host = &request->host};
    if (stat(request->results, &status) == 0)
        report.time = status.st_mtime;
    result = find_filters(&report);
    if (result == LOBE_OK)
        result = write_text(&report, text, size);
    sweep_results_free(&results);
    return result;
}

// ---------------------------------------------------------------------------------------------
// Writing

/// The folder may be there; one that had to be made goes again where the page cannot be written.
static lobe_result write_page(const report_request *request, const char *text, size_t size) {
    bool made = mkdir(request->folder, 0777) == 0;
    if (!made && errno != EEXIST)
        return lobe_host_fail(&request->host, LOBE_ERROR_WRITE, "%s: cannot be made: %s",
                              request->folder, strerror(errno));
    char *path = malloc(strlen(request->folder) + sizeof "/index.html");
    if (!path)
        return lobe_host_fail(&request->host, LOBE_ERROR_OUT_OF_MEMORY, "%s: out of memory",
                              request->folder);
    sprintf(path, "%s/index.html", request->folder);
    lobe_result result = lobe_file_write(path, text, size, &request->host);
    if (result != LOBE_OK && made)
        rmdir(request->folder);
    free(path);
    return result;
}

static int make_report(const report_request *request) {
    char *text;
    size_t size;
    lobe_result result = make_page(request, &text, &size);
    if (result == LOBE_OK)
        result = write_page(request, text, size);
    free(text);
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
         .summary = "folder that index.html is written to; made where it is not there",
         .target = &request.folder},
        {.name = "picture-width",
         .kind = OPTION_INTEGER,
         .argument = "PIXELS",
         .summary = "wider pictures are reduced, and a part of each shown as it is",
         .target = &request.picture_width,
         .fallback = "320",
         .minimum = 16,
         .maximum = LOBE_IMAGE_MAXIMUM_EXTENT},
    };
    const option_table table = {
        .program = "lobe report",
        .operands = "RESULTS.json",
        .summary = "Draws what 'lobe bench --sweep' measured as one HTML page that needs nothing\n"
                   "else: for each scene the pictures with maps of their errors, error over time\n"
                   "and over memory with the Pareto front, and the times of passes; means over\n"
                   "the scenes; and the table of Xu et al. 2017 beside the same ratios here.",
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
