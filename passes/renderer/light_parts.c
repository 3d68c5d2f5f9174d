#include "passes/renderer/light_parts.h"

#include "passes/context/knob_values.h"
#include "passes/context/shared_knobs.h"

/// "moments" with six bins takes up to 1850 iterations for each light of a closed surface, and 80
/// for footprints of sixteen probes, which four lights share.
enum { LIGHTS_PER_PASS = 512, LIGHTS_PER_PASS_CLOSED = 16 };

static uint32_t least(uint32_t a, uint32_t b) {
    return a < b ? a : b;
}

uint32_t passes_light_count(const lobe_scene *scene, lobe_light_type type) {
    uint32_t count = 0;
    for (size_t i = 0; i < scene->light_count; i++)
        count += scene->lights[i].type == type;
    return count;
}

light_part passes_light_part(const filter_context *context, uint32_t first) {
    const bool closed = passes_knob_choice(context, &passes_knob_normal_mapping) > 0;
    const uint32_t count = (uint32_t)context->scene->scene->light_count;
    return (light_part){first,
                        least(count - first, closed ? LIGHTS_PER_PASS_CLOSED : LIGHTS_PER_PASS)};
}

uint32_t passes_light_part_count(const lobe_scene *scene, light_part part, lobe_light_type type) {
    uint32_t begin = 0;
    for (uint32_t earlier = 0; earlier < (uint32_t)type; earlier++)
        begin += passes_light_count(scene, (lobe_light_type)earlier);
    const uint32_t end = begin + passes_light_count(scene, type), last = part.first + part.count;
    const uint32_t from = begin > part.first ? begin : part.first, to = least(end, last);
    return to > from ? to - from : 0;
}
