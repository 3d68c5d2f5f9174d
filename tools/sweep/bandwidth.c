#include "tools/sweep/sweep.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <lobe/graph.h>

struct sweep_copies {
    const sweep_job *job;
    lobe_graph *graph;
    lobe_profile *profile;
    uint64_t *bytes; ///< copied, each once in the list
    size_t count;
};

/// Devices may limit buffers to 128 MiB. Larger ones are copied at the speed of this size.
static const uint64_t largest_copy = 64 << 20;

/// The bytes to copy for a pass that reads and writes this many together: half, in whole words.
static uint64_t copied_bytes(double bytes) {
    uint64_t half = ((uint64_t)bytes / 2 + 3) & ~(uint64_t)3;
    return half < 4 ? 4 : half < largest_copy ? half : largest_copy;
}

/// The name of the pass that copies this many bytes; its times are looked up by this name.
static void name_copy(uint64_t bytes, char name[64]) {
    snprintf(name, 64, "copy of %" PRIu64 " bytes", bytes);
}

// ---------------------------------------------------------------------------------------------
// Which sizes

static bool has_size(const sweep_copies *copies, uint64_t bytes) {
    for (size_t i = 0; i < copies->count; i++) {
        if (copies->bytes[i] == bytes)
            return true;
    }
    return false;
}

static bool add_sizes(sweep_copies *copies, const sweep_row *row) {
    uint64_t *grown = realloc(copies->bytes, (copies->count + row->pass_count + 1) * sizeof *grown);
    if (!grown)
        return false;
    copies->bytes = grown;
    for (size_t i = 0; i < row->pass_count; i++) {
        uint64_t bytes = copied_bytes(row->passes[i].bytes);
        if (row->passes[i].bytes > 0 && !has_size(copies, bytes))
            grown[copies->count++] = bytes;
    }
    return true;
}

lobe_result sweep_copies_create(const sweep_job *job, const sweep_row *rows, size_t row_count,
                                sweep_copies **copies) {
    const lobe_host *host = job->bench.host;
    *copies = calloc(1, sizeof **copies);
    bool fits = *copies != NULL;
    for (size_t i = 0; fits && i < row_count; i++)
        fits = add_sizes(*copies, &rows[i]);
    if (!fits)
        return lobe_host_fail(host, LOBE_ERROR_OUT_OF_MEMORY, "sweep: out of memory");
    (*copies)->job = job;
    lobe_result result = lobe_profile_create(host, &(*copies)->profile);
    return result == LOBE_OK ? lobe_graph_create(job->bench.device, &(*copies)->graph) : result;
}

void sweep_copies_destroy(sweep_copies **copies) {
    if (!*copies)
        return;
    lobe_graph_destroy(&(*copies)->graph);
    lobe_profile_destroy(&(*copies)->profile);
    free((*copies)->bytes);
    free(*copies);
    *copies = NULL;
}

// ---------------------------------------------------------------------------------------------
// Times

/// From buffer to buffer.
static lobe_result copy(lobe_graph *graph, uint64_t bytes) {
    lobe_buffer_description description = {.name = "copied from", .size = (size_t)bytes};
    lobe_graph_begin(graph);
    lobe_resource source = lobe_graph_buffer(graph, &description);
    lobe_pass *fill = lobe_graph_add_pass(graph, LOBE_PASS_TRANSFER, "fill");
    source = lobe_pass_fill(fill, source, (lobe_range){0}, (const float[4]){1});
    description.name = "copied to";
    lobe_resource target = lobe_graph_buffer(graph, &description);
    char name[64];
    name_copy(bytes, name);
    lobe_pass *pass = lobe_graph_add_pass(graph, LOBE_PASS_TRANSFER, name);
    target = lobe_pass_copy(pass, source, (lobe_range){0}, target, (lobe_range){0});
    lobe_graph_output(graph, target);
    return lobe_graph_execute(graph);
}

lobe_result sweep_copies_time(sweep_copies *copies) {
    lobe_result result = LOBE_OK;
    for (size_t i = 0; result == LOBE_OK && i < copies->count; i++) {
        // The first copy touches new memory, the second finds it ready.
        result = copy(copies->graph, copies->bytes[i]);
        if (result == LOBE_OK)
            result = copy(copies->graph, copies->bytes[i]);
        if (result == LOBE_OK)
            result = lobe_profile_add(copies->profile, lobe_graph_describe(copies->graph));
    }
    return result;
}

static double median_of(const lobe_profile_summary *summary, const char *name) {
    for (size_t i = 0; i < summary->pass_count; i++) {
        if (strcmp(summary->passes[i].name, name) == 0)
            return summary->passes[i].median_milliseconds;
    }
    return 0;
}

lobe_result sweep_copies_summarise(sweep_copies *copies, sweep_row *rows, size_t row_count) {
    lobe_profile_summary summary;
    lobe_result result = lobe_profile_statistics(copies->profile, &summary);
    for (size_t i = 0; result == LOBE_OK && i < row_count; i++) {
        for (size_t k = 0; k < rows[i].pass_count; k++) {
            sweep_pass *pass = &rows[i].passes[k];
            if (pass->bytes <= 0)
                continue;
            char name[64];
            uint64_t copied = copied_bytes(pass->bytes);
            name_copy(copied, name);
            pass->copy_milliseconds =
                median_of(&summary, name) * fmax(pass->bytes / 2 / (double)copied, 1);
        }
    }
    return result;
}
