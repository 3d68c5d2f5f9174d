#include "passes/ocean/fft.h"

#include <math.h>

#include "shaders/interface/ocean.h"

void passes_fft_roots(uint32_t size, float *roots) {
    for (uint32_t i = 0; i < size; i++) {
        const double angle = 2 * 3.14159265358979323846 * i / size;
        roots[2 * i] = (float)cos(angle);
        roots[2 * i + 1] = (float)sin(angle);
    }
}

typedef struct transform {
    lobe_graph *graph;
    uint32_t size, count;
    lobe_resource roots, target;
    lobe_resource planes; ///< the numbers so far; the target in the end
} transform;

typedef struct step {
    const char *shader, *last_shader;
    struct ocean_fft_constants constants;
    uint32_t radix;
    uint32_t threads[2];
    bool last;
} step;

static lobe_resource declare_planes(const transform *t) {
    return lobe_graph_buffer(
        t->graph,
        &(lobe_buffer_description){.name = "transformed waves",
                                   .size = (size_t)t->count * t->size * t->size * sizeof(float4)});
}

static void add_step(transform *t, const step *s) {
    lobe_pass *pass = lobe_graph_add_pass(t->graph, LOBE_PASS_COMPUTE, "fft");
    lobe_pass_read(pass, &(lobe_binding){.name = "source_block", .resource = t->planes});
    lobe_pass_read(pass, &(lobe_binding){.name = "root_block", .resource = t->roots});
    t->planes = lobe_pass_write(
        pass, s->last ? &(lobe_binding){.name = "target", .resource = t->target}
                      : &(lobe_binding){.name = "target_block", .resource = declare_planes(t)});
    const lobe_specialisation specialisation[] = {{SPECIALISE_RADIX, s->radix},
                                                  {SPECIALISE_LINE, t->size}};
    lobe_pass_dispatch(pass, &(lobe_dispatch){.shader = s->last ? s->last_shader : s->shader,
                                              .threads = {s->threads[0], s->threads[1], t->count},
                                              .constants = &s->constants,
                                              .constants_size = sizeof s->constants,
                                              .specialisation = specialisation,
                                              .specialisation_count = 2});
}

/// Steps of eight as long as possible, then one of four or two.
static void transform_through_memory(transform *t, uint32_t columns) {
    for (uint32_t done = 1, radix; done < t->size; done *= radix) {
        const uint32_t left = t->size / done;
        radix = left < 8 ? left : 8;
        const uint32_t parts = t->size / radix;
        add_step(t, &(step){.shader = "ocean/fft_step.comp",
                            .last_shader = "ocean/fft_step_last.comp",
                            .constants = {t->size, done, columns},
                            .radix = radix,
                            .threads = {columns ? t->size : parts, columns ? parts : t->size},
                            .last = columns && left == radix});
    }
}

static void transform_in_groups(transform *t, uint32_t columns) {
    enum { GROUP = 64 };
    uint32_t rest = t->size;
    while (rest >= 8)
        rest /= 8;
    add_step(t, &(step){.shader = "ocean/fft_line.comp",
                        .last_shader = "ocean/fft_line_last.comp",
                        .constants = {t->size, 1, columns},
                        .radix = rest,
                        .threads = {t->size * GROUP, 1},
                        .last = columns});
}

lobe_resource passes_fft(lobe_graph *graph, fft_form form, uint32_t size, uint32_t count,
                         lobe_resource source, lobe_resource roots, lobe_resource target) {
    transform t = {graph, size, count, roots, target, source};
    for (uint32_t columns = 0; columns < 2; columns++)
        (form == FFT_THROUGH_MEMORY ? transform_through_memory : transform_in_groups)(&t, columns);
    return t.planes;
}
