#include "passes/filters/displaced/facets.h"

#include <stdio.h>

/// Threads of a group of facet_transfer, one for each quad, and of facet_links, one for each facet.
enum { GROUP = 64 };

typedef struct facets_build {
    lobe_graph *graph;
    const relief *relief;
    const transfer_kind *kind;
    uint32_t material;
    facet_range range;
    bool in_parts;
    seen_facets seen;
} facets_build;

facet_range passes_facets_share(const device_map *heights, uint32_t share, uint32_t shares) {
    const uint64_t facets = 2 * (uint64_t)heights->width * heights->height,
                   blocks = (facets + 2 * GROUP - 1) / (2 * GROUP),
                   first = blocks * (share - 1) / shares * 2 * GROUP;
    uint64_t end = blocks * share / shares * 2 * GROUP;
    end = end < facets ? end : facets;
    return (facet_range){(uint32_t)first, (uint32_t)(end - first)};
}

void passes_facets_bytes(facet_range range, const transfer_kind *kind, uint32_t bytes[3]) {
    bytes[0] = range.count * TRANSFER_WORDS(kind->order) * (uint32_t)sizeof(uint32_t);
    bytes[1] = range.count * TRANSFER_LINKS * (uint32_t)sizeof(uint32_t);
    bytes[2] = sizeof(struct transfer_basis_constants);
}

/// What Vulkan asks of every device: buffers of 128 MiB.
#define LARGEST_BUFFER ((uint64_t)1 << 27)

/// Of each facet, words, links, and light of four functions.
static uint64_t words_of_facet(const transfer_kind *kind) {
    const uint64_t words = TRANSFER_WORDS(kind->order);
    return words > TRANSFER_LINKS ? words : TRANSFER_LINKS;
}

bool passes_facets_fit(const device_map *heights, const transfer_kind *kind) {
    const uint64_t facets = 2 * (uint64_t)heights->width * heights->height;
    return facets * words_of_facet(kind) * sizeof(uint32_t) <= LARGEST_BUFFER;
}

double passes_facets_limit(const transfer_kind *kind) {
    return (double)(LARGEST_BUFFER / words_of_facet(kind) / 8) * 1e-6;
}

/// What colours do not change outlives the frame where these can, and what later parts need.
static lobe_resource declare(const facets_build *build, const char *name, size_t size) {
    char of_material[64];
    snprintf(of_material, sizeof of_material, "%s of material %u", name, build->material);
    return lobe_graph_buffer(
        build->graph,
        &(lobe_buffer_description){.name = of_material,
                                   .size = size,
                                   .retained = build->kind->coloured || build->in_parts});
}

static uint32_t basis_cells(uint32_t quads) {
    const uint32_t cells = (quads + TRANSFER_BASIS_CELL - 1) / TRANSFER_BASIS_CELL;
    return cells < TRANSFER_BASIS_MAXIMUM ? cells : TRANSFER_BASIS_MAXIMUM;
}

static void add_basis(facets_build *build) {
    const uint32_t across = basis_cells(build->relief->constants.width),
                   down = basis_cells(build->relief->constants.height), count = across * down;
    lobe_resource cells = lobe_graph_buffer(
        build->graph, &(lobe_buffer_description){.name = "cells of basis",
                                                 .size = (size_t)count * TRANSFER_BASIS_TERMS *
                                                         TRANSFER_BASIS_TERMS * sizeof(float)});
    lobe_pass *pass = lobe_graph_add_pass(build->graph, LOBE_PASS_COMPUTE, "basis_cells");
    passes_relief_read(build->relief, pass);
    cells = lobe_pass_write(pass, &(lobe_binding){.name = "cell_block", .resource = cells});
    const struct transfer_constants constants =
        passes_transfer_constants(build->relief, build->kind);
    lobe_pass_dispatch(pass, &(lobe_dispatch){.shader = "filters/displaced/basis_cells.comp",
                                              .threads = {across * TRANSFER_BASIS_POINTS,
                                                          down * TRANSFER_BASIS_POINTS},
                                              .constants = &constants,
                                              .constants_size = sizeof constants});
    pass = lobe_graph_add_pass(build->graph, LOBE_PASS_COMPUTE, "transfer_basis");
    lobe_pass_read(pass, &(lobe_binding){.name = "cell_block", .resource = cells});
    build->seen.basis = lobe_pass_write(
        pass, &(lobe_binding){.name = "basis_block",
                              .resource = declare(build, "functions of directions",
                                                  sizeof(struct transfer_basis_constants))});
    lobe_pass_dispatch(pass, &(lobe_dispatch){.shader = "filters/displaced/transfer_basis.comp",
                                              .threads = {TRANSFER_BASIS_TERMS},
                                              .constants = &count,
                                              .constants_size = sizeof count});
}

/// Threads of a pass that takes long are spread over several, so that each takes less than a second
/// on lavapipe.
typedef struct thread_bands {
    uint32_t first;   ///< thread
    uint32_t threads; ///< in all
    uint32_t of_each; ///< but the last: a multiple of a group's
} thread_bands;

/// One thread a quad.
static thread_bands transfer_bands(facet_range range, const transfer_kind *kind) {
    enum { MOST_HORIZONS = 1 << 18 };
    return (thread_bands){range.first / 2, range.count / 2,
                          MOST_HORIZONS / kind->azimuths / GROUP * GROUP};
}

/// One thread a facet.
static thread_bands link_bands(facet_range range) {
    enum { MOST_FACETS = 1 << 17 };
    return (thread_bands){range.first, range.count, MOST_FACETS};
}

static uint32_t band_count(thread_bands bands) {
    return (bands.threads + bands.of_each - 1) / bands.of_each;
}

uint32_t passes_facets_part_count(facet_range range, const transfer_kind *kind) {
    return band_count(transfer_bands(range, kind)) + band_count(link_bands(range));
}

/// What the bands of a pass write, and the shader's name.
typedef struct banded_pass {
    const char *name, *shader;
    const char *target;
    bool reads_basis;
} banded_pass;

static lobe_pass *add_band(const facets_build *build, const banded_pass *banded, thread_bands bands,
                           uint32_t band, lobe_resource *target) {
    lobe_pass *pass = lobe_graph_add_pass(build->graph, LOBE_PASS_COMPUTE, banded->name);
    passes_relief_read(build->relief, pass);
    if (banded->reads_basis)
        lobe_pass_read(pass, &(lobe_binding){.name = "basis_block", .resource = build->seen.basis});
    const lobe_binding written = {.name = banded->target, .resource = *target};
    *target = band == 0 ? lobe_pass_write(pass, &written) : lobe_pass_modify(pass, &written);
    struct transfer_constants constants = passes_transfer_constants(build->relief, build->kind);
    const uint32_t begin = band * bands.of_each, left = bands.threads - begin;
    constants.first_thread = bands.first + begin;
    constants.first_facet = build->range.first;
    const kind_specialisation kind = passes_transfer_specialisation(build->kind);
    lobe_pass_dispatch(pass,
                       &(lobe_dispatch){.shader = banded->shader,
                                        .threads = {left < bands.of_each ? left : bands.of_each},
                                        .constants = &constants,
                                        .constants_size = sizeof constants,
                                        .specialisation = kind.items,
                                        .specialisation_count = 2});
    return pass;
}

/// Adds up to `most` bands, and returns their number. Only the last one is kept: it needs those
/// before it, whose own results are no longer there once it has run.
static uint32_t add_bands(const facets_build *build, const banded_pass *banded, thread_bands bands,
                          uint32_t most, lobe_resource *target) {
    const uint32_t all = band_count(bands), count = all < most ? all : most;
    lobe_pass *last = NULL;
    for (uint32_t band = 0; band < count; band++)
        last = add_band(build, banded, bands, band, target);
    if (build->in_parts && last)
        lobe_pass_keep(last);
    return count;
}

seen_facets passes_facets(lobe_graph *graph, uint32_t material, const relief *relief,
                          const transfer_kind *kind, facet_range range, uint32_t most,
                          bool in_parts) {
    static const banded_pass transfer = {"facet_transfer", "filters/displaced/facet_transfer.comp",
                                         "transfer_words", true},
                             links = {"facet_links", "filters/displaced/facet_links.comp",
                                      "link_block", false};
    facets_build build = {.graph = graph,
                          .relief = relief,
                          .kind = kind,
                          .material = material,
                          .range = range,
                          .in_parts = in_parts};
    uint32_t bytes[3];
    passes_facets_bytes(range, kind, bytes);
    add_basis(&build);
    build.seen.words = declare(&build, "transfer of facets", bytes[0]);
    build.seen.links = declare(&build, "links of facets", bytes[1]);
    most -= add_bands(&build, &transfer, transfer_bands(range, kind), most, &build.seen.words);
    add_bands(&build, &links, link_bands(range), most, &build.seen.links);
    return build.seen;
}
