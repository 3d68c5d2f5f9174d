#include <stdio.h>

#include "passes/ocean/fft.h"
#include "passes/ocean/layer.h"
#include "passes/ocean/ocean_check.h"
#include "shaders/interface/ocean.h"

#define PI 3.14159265358979323846

struct lobe_ocean {
    lobe_ocean_parameters parameters;
    fft_form form;
    lobe_buffer *amplitudes; ///< two floats for each texel of each layer
    lobe_buffer *roots;
};

// ---------------------------------------------------------------------------------------------
// Creation

static lobe_result out_of_memory(const lobe_host *host) {
    return lobe_host_fail(host, LOBE_ERROR_OUT_OF_MEMORY, "ocean: out of memory");
}

static lobe_result upload_amplitudes(lobe_ocean *ocean, lobe_device *device,
                                     const lobe_host *host) {
    const lobe_ocean_parameters *p = &ocean->parameters;
    const sea sea = passes_sea(p);
    const size_t numbers = (size_t)2 * p->size * p->size;
    const size_t size = p->layers * numbers * sizeof(float);
    float *amplitudes = lobe_allocate(lobe_host_allocator(host), 1, size);
    if (!amplitudes)
        return out_of_memory(host);
    for (uint32_t i = 0; i < p->layers; i++) {
        const ocean_layer layer = passes_ocean_layer(p, i);
        passes_ocean_layer_amplitudes(&layer, &sea, amplitudes + i * numbers);
    }
    const lobe_buffer_parameters buffer = {
        .name = "amplitudes of waves", .size = size, .data = amplitudes};
    const lobe_result result = lobe_buffer_create(device, &buffer, &ocean->amplitudes);
    lobe_release(amplitudes);
    return result;
}

static lobe_result upload_roots(lobe_ocean *ocean, lobe_device *device) {
    float roots[2 * FFT_LARGEST];
    passes_fft_roots(ocean->parameters.size, roots);
    const lobe_buffer_parameters buffer = {.name = "roots of unity",
                                           .size = 2 * ocean->parameters.size * sizeof *roots,
                                           .data = roots};
    return lobe_buffer_create(device, &buffer, &ocean->roots);
}

lobe_result lobe_ocean_create(lobe_device *device, const lobe_ocean_parameters *parameters,
                              const lobe_host *host, lobe_ocean **ocean) {
    if (ocean)
        *ocean = NULL;
    if (!device || !ocean)
        return lobe_host_fail(host, LOBE_ERROR_INVALID_ARGUMENT,
                              "lobe_ocean_create: device and ocean must not be NULL");
    lobe_result result = passes_ocean_check(parameters, host);
    if (result != LOBE_OK)
        return result;
    lobe_ocean *created = lobe_allocate(lobe_host_allocator(host), 1, sizeof *created);
    if (!created)
        return out_of_memory(host);
    created->parameters = *parameters;
    created->form =
        lobe_device_describe(device)->type == LOBE_DEVICE_CPU ? FFT_THROUGH_MEMORY : FFT_IN_GROUPS;
    result = upload_amplitudes(created, device, host);
    result = result ? result : upload_roots(created, device);
    if (result != LOBE_OK)
        lobe_ocean_destroy(&created);
    *ocean = created;
    return result;
}

void lobe_ocean_destroy(lobe_ocean **ocean) {
    if (!ocean || !*ocean)
        return;
    lobe_buffer_destroy(&(*ocean)->amplitudes);
    lobe_buffer_destroy(&(*ocean)->roots);
    lobe_release(*ocean);
    *ocean = NULL;
}

// ---------------------------------------------------------------------------------------------
// A frame

static lobe_resource add_spectrum(const lobe_ocean *ocean, lobe_graph *graph, double seconds) {
    const lobe_ocean_parameters *p = &ocean->parameters;
    const uint32_t fields = OCEAN_FIELDS * p->layers;
    lobe_resource planes =
        lobe_graph_buffer(graph, &(lobe_buffer_description){.name = "spectrum of waves",
                                                            .size = (size_t)fields * p->size *
                                                                    p->size * sizeof(float4)});
    struct ocean_spectrum_constants constants = {
        .step[3] = p->choppiness, .size = p->size, .time = (uint32_t)(seconds * OCEAN_TICKS)};
    for (uint32_t i = 0; i < p->layers; i++)
        constants.step[i] = (float)(2 * PI / p->lengths[i]);
    lobe_pass *pass = lobe_graph_add_pass(graph, LOBE_PASS_COMPUTE, "spectrum");
    lobe_pass_read(pass,
                   &(lobe_binding){.name = "amplitude_block",
                                   .resource = lobe_graph_import_buffer(graph, ocean->amplitudes)});
    planes = lobe_pass_write(pass, &(lobe_binding){.name = "field_block", .resource = planes});
    lobe_pass_dispatch(pass, &(lobe_dispatch){.shader = "ocean/spectrum.comp",
                                              .threads = {p->size, p->size, p->layers},
                                              .constants = &constants,
                                              .constants_size = sizeof constants});
    return planes;
}

static lobe_resource declare_maps(const lobe_ocean *ocean, lobe_graph *graph) {
    char name[64];
    snprintf(name, sizeof name, "waves of seed %u", ocean->parameters.seed);
    return lobe_graph_image(
        graph, &(lobe_image_description){.name = name,
                                         .format = LOBE_FORMAT_RGBA32_FLOAT,
                                         .width = ocean->parameters.size,
                                         .height = ocean->parameters.size,
                                         .layers = OCEAN_FIELDS * ocean->parameters.layers,
                                         .retained = true});
}

lobe_resource lobe_ocean_add(const lobe_ocean *ocean, lobe_graph *graph, double seconds) {
    if (!graph)
        return (lobe_resource){0};
    // False for NaN, too.
    if (!ocean || !(seconds >= 0 && seconds < OCEAN_TICKS)) {
        lobe_graph_fail(graph, LOBE_ERROR_INVALID_ARGUMENT,
                        "lobe_ocean_add: %s, at %g s; expected 0 to 65536",
                        ocean ? "an ocean" : "NULL", seconds);
        return (lobe_resource){0};
    }
    const lobe_resource planes = add_spectrum(ocean, graph, seconds);
    return passes_fft(graph, ocean->form, ocean->parameters.size,
                      OCEAN_FIELDS * ocean->parameters.layers, planes,
                      lobe_graph_import_buffer(graph, ocean->roots), declare_maps(ocean, graph));
}
