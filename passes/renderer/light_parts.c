#include "passes/renderer/light_parts.h"

#include "passes/context/knob_values.h"
#include "shaders/interface/light.h"

/// By the iterations that each light takes: of closed surfaces, up to 1850 in "moments" with six
/// bins; otherwise, and in filters that have no footprints, at most about 30.
enum { LIGHTS_OF_CLOSED_FOOTPRINTS = 16 };

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
    return passes_closes_surfaces(context) && context->filter->build ? LIGHTS_OF_CLOSED_FOOTPRINTS
                                                                     : LIGHTS_PER_PASS;
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
