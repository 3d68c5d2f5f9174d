#include "passes/renderer/light_parts.h"

#include "passes/context/knob_values.h"

/// The most iterations are taken by "moments": with six bins up to 1850 for each light of a closed
/// surface, and about 30 for footprints of sixteen probes. Filters that do not fetch for lights
/// take about 15 at most ("leadr").
enum { LIGHTS_PER_PASS = 2560, LIGHTS_PER_FETCHING_PASS = 512, LIGHTS_PER_PASS_CLOSED = 16 };

static uint32_t least(uint32_t a, uint32_t b) {
    return a < b ? a : b;
}

light_counts passes_light_counts(const lobe_scene *scene) {
    light_counts counts = {{0}};
    for (size_t i = 0; i < scene->light_count; i++)
        counts.of_type[scene->lights[i].type]++;
    return counts;
}

static uint32_t most_lights(const filter_context *context) {
    if (passes_closes_surfaces(context))
        return LIGHTS_PER_PASS_CLOSED;
    return context->filter->fetches_for_lights ? LIGHTS_PER_FETCHING_PASS : LIGHTS_PER_PASS;
}

light_part passes_light_part(const filter_context *context, uint32_t first) {
    const uint32_t count = (uint32_t)context->scene->scene->light_count;
    return (light_part){first, least(count - first, most_lights(context))};
}

uint32_t passes_light_part_count(const light_counts *all, light_part part, lobe_light_type type) {
    uint32_t begin = 0;
    for (uint32_t earlier = 0; earlier < (uint32_t)type; earlier++)
        begin += all->of_type[earlier];
    const uint32_t end = begin + all->of_type[type], last = part.first + part.count;
    const uint32_t from = begin > part.first ? begin : part.first, to = least(end, last);
    return to > from ? to - from : 0;
}
