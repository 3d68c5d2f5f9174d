#include "passes/filters/displaced/facets.h"

#include <stdio.h>

/// Threads of a group of facet_transfer, one for each quad, and of facet_links, one for each facet.
enum { GROUP = 64 };

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

/// What neither colours nor emission change outlives the frame where these can, and what later
/// parts need.
static lobe_resource declare(const facets_request *request, const char *name, size_t size) {
    char of_material[64];
    snprintf(of_material, sizeof of_material, "%s of material %u", name, request->material);
    return lobe_graph_buffer(request->graph,
                             &(lobe_buffer_description){.name = of_material,
                                                        .size = size,
                                                        .retained = request->kind->coloured ||
                                                                    request->kind->emissive ||
                                                                    request->in_parts});
}

static uint32_t basis_cells(uint32_t quads) {
    const uint32_t cells = (quads + TRANSFER_BASIS_CELL - 1) / TRANSFER_BASIS_CELL;
    return cells < TRANSFER_BASIS_MAXIMUM ? cells : TRANSFER_BASIS_MAXIMUM;
}

static lobe_resource add_groups(const facets_request *request, lobe_resource basis) {
    lobe_pass *pass = lobe_graph_add_pass(request->graph, LOBE_PASS_COMPUTE, "facet_groups");
    passes_relief_read(request->relief, pass);
    basis = lobe_pass_modify(pass, &(lobe_binding){.name = "basis_block", .resource = basis});
    lobe_pass_dispatch(
        pass, &(lobe_dispatch){.shader = "filters/displaced/facet_groups.comp", .threads = {1}});
    return basis;
}

static lobe_resource add_basis(const facets_request *request) {
    const uint32_t across = basis_cells(request->relief->constants.width),
                   down = basis_cells(request->relief->constants.height), count = across * down;
    lobe_resource cells = lobe_graph_buffer(
        request->graph, &(lobe_buffer_description){.name = "cells of basis",
                                                   .size = (size_t)count * TRANSFER_BASIS_TERMS *
                                                           TRANSFER_BASIS_TERMS * sizeof(float)});
    lobe_pass *pass = lobe_graph_add_pass(request->graph, LOBE_PASS_COMPUTE, "basis_cells");
    passes_relief_read(request->relief, pass);
    cells = lobe_pass_write(pass, &(lobe_binding){.name = "cell_block", .resource = cells});
    const struct transfer_constants constants =
        passes_transfer_constants(request->relief, request->kind);
    lobe_pass_dispatch(pass, &(lobe_dispatch){.shader = "filters/displaced/basis_cells.comp",
                                              .threads = {across * TRANSFER_BASIS_POINTS,
                                                          down * TRANSFER_BASIS_POINTS},
                                              .constants = &constants,
                                              .constants_size = sizeof constants});
    pass = lobe_graph_add_pass(request->graph, LOBE_PASS_COMPUTE, "transfer_basis");
    lobe_pass_read(pass, &(lobe_binding){.name = "cell_block", .resource = cells});
    const lobe_resource basis = lobe_pass_write(
        pass, &(lobe_binding){.name = "basis_block",
                              .resource = declare(request, "functions of directions",
                                                  sizeof(struct transfer_basis_constants))});
    lobe_pass_dispatch(pass, &(lobe_dispatch){.shader = "filters/displaced/transfer_basis.comp",
                                              .threads = {TRANSFER_BASIS_TERMS},
                                              .constants = &count,
                                              .constants_size = sizeof count});
    return add_groups(request, basis);
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
    const lobe_resource *basis; ///< NULL: it does not read it
    thread_bands bands;
    struct transfer_constants constants;
} banded_pass;

static lobe_pass *add_band(const facets_request *request, const banded_pass *banded, uint32_t band,
                           lobe_resource *target) {
    lobe_pass *pass = lobe_graph_add_pass(request->graph, LOBE_PASS_COMPUTE, banded->name);
    passes_relief_read(request->relief, pass);
    if (banded->basis)
        lobe_pass_read(pass, &(lobe_binding){.name = "basis_block", .resource = *banded->basis});
    const lobe_binding written = {.name = banded->target, .resource = *target};
    *target = band == 0 ? lobe_pass_write(pass, &written) : lobe_pass_modify(pass, &written);
    const thread_bands *bands = &banded->bands;
    const uint32_t begin = band * bands->of_each, left = bands->threads - begin;
    struct transfer_constants constants = banded->constants;
    constants.first_thread = bands->first + begin;
    const kind_specialisation kind = passes_transfer_specialisation(request->kind);
    lobe_pass_dispatch(pass,
                       &(lobe_dispatch){.shader = banded->shader,
                                        .threads = {left < bands->of_each ? left : bands->of_each},
                                        .constants = &constants,
                                        .constants_size = sizeof constants,
                                        .specialisation = kind.items,
                                        .specialisation_count = KIND_CONSTANTS});
    return pass;
}

/// Adds up to `most` bands, and returns their number. Only the last one is kept: it needs those
/// before it, whose own results are no longer there once it has run.
static uint32_t add_bands(const facets_request *request, const banded_pass *banded, uint32_t most,
                          bool keeps, lobe_resource *target) {
    const uint32_t all = band_count(banded->bands), count = all < most ? all : most;
    lobe_pass *last = NULL;
    for (uint32_t band = 0; band < count; band++)
        last = add_band(request, banded, band, target);
    if (keeps && last)
        lobe_pass_keep(last);
    return count;
}

seen_facets passes_facets_begin(const facets_request *request, uint32_t facets) {
    uint32_t bytes[3];
    passes_facets_bytes((facet_range){0, facets}, request->kind, bytes);
    return (seen_facets){.basis = request->basis.version > 0 ? request->basis : add_basis(request),
                         .words = declare(request, "transfer of facets", bytes[0]),
                         .links = declare(request, "links of facets", bytes[1])};
}

uint32_t passes_facets_add(const facets_request *request, const facet_window *window,
                           facet_range range, uint32_t most, bool keeps, seen_facets *seen) {
    struct transfer_constants constants = passes_transfer_constants(request->relief, request->kind);
    passes_window_constants(window, &constants);
    constants.first_facet = range.first;
    const banded_pass transfer = {"facet_transfer",
                                  "filters/displaced/facet_transfer.comp",
                                  "transfer_words",
                                  &seen->basis,
                                  transfer_bands(range, request->kind),
                                  constants},
                      links = {"facet_links",     "filters/displaced/facet_links.comp",
                               "link_block",      NULL,
                               link_bands(range), constants};
    const uint32_t count = add_bands(request, &transfer, most, keeps, &seen->words);
    return count + add_bands(request, &links, most - count, keeps, &seen->links);
}
