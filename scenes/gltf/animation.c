#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "scenes/animation/posed_numbers.h"
#include "scenes/gltf/gltf.h"
#include "scenes/gltf/pointer/animation_pointer.h"

/// Where a channel is, for messages.
typedef struct channel_place {
    const gltf_import *import;
    const gltf_animation *animation;
    size_t index, channel;
} channel_place;

static void name_place(const channel_place *place, char *text, size_t size) {
    if (place->animation->name[0])
        snprintf(text, size, "channel %zu of animation '%.64s'", place->channel,
                 place->animation->name);
    else
        snprintf(text, size, "channel %zu of animation %zu", place->channel, place->index);
}

static lobe_result fail(const channel_place *place, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

static lobe_result fail(const channel_place *place, const char *format, ...) {
    char name[128], cause[160];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(cause, sizeof cause, format, arguments);
    va_end(arguments);
    name_place(place, name, sizeof name);
    return lobe_host_fail(place->import->host, LOBE_ERROR_MALFORMED, "%s: %s: %s",
                          place->import->path, name, cause);
}

// ---------------------------------------------------------------------------------------------
// Target

static bool is_node_path(const char *name, lobe_channel_path *path) {
    static const char *const names[] = {[LOBE_CHANNEL_TRANSLATION] = "translation",
                                        [LOBE_CHANNEL_ROTATION] = "rotation",
                                        [LOBE_CHANNEL_SCALE] = "scale",
                                        [LOBE_CHANNEL_WEIGHTS] = "weights"};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        if (strcmp(names[i], name) == 0) {
            *path = (lobe_channel_path)i;
            return true;
        }
    }
    return false;
}

static lobe_result find_interpolation(const channel_place *place, const char *name,
                                      lobe_interpolation *interpolation) {
    static const char *const names[] = {[LOBE_INTERPOLATION_STEP] = "STEP",
                                        [LOBE_INTERPOLATION_LINEAR] = "LINEAR",
                                        [LOBE_INTERPOLATION_CUBIC] = "CUBICSPLINE"};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        if (strcmp(names[i], name) == 0) {
            *interpolation = (lobe_interpolation)i;
            return LOBE_OK;
        }
    }
    return fail(place, "unknown interpolation '%.32s'", name);
}

static lobe_result find_width(const channel_place *place, int node, size_t *width) {
    const int mesh = place->import->document->nodes[node].mesh;
    *width = 0;
    if (mesh >= 0 && (size_t)mesh < place->import->document->mesh_count) {
        lobe_result result = scenes_gltf_count_targets(place->import, (size_t)mesh, width);
        if (result != LOBE_OK)
            return result;
    }
    return *width > 0 ? LOBE_OK : fail(place, "node %d has no morph targets", node);
}

/// What a channel moves, for messages: the last part of a pointer.
static const char *name_of(const gltf_channel *channel) {
    const char *slash = channel->pointer ? strrchr(channel->pointer, '/') : NULL;
    return slash ? slash + 1 : channel->path;
}

// ---------------------------------------------------------------------------------------------
// Keys

static lobe_result read_times(const channel_place *place, const gltf_elements *input,
                              float *times) {
    for (size_t i = 0; i < input->count; i++) {
        float value[4];
        scenes_gltf_read_floats(input, i, value);
        times[i] = value[0];
        if (!isfinite(times[i]) || times[i] < 0)
            return fail(place, "key %zu is at %g s", i, (double)times[i]);
        if (i > 0 && times[i] <= times[i - 1])
            return fail(place, "key %zu is at %g s, not after %g s", i, (double)times[i],
                        (double)times[i - 1]);
    }
    return LOBE_OK;
}

static lobe_result read_values(const channel_place *place, const gltf_elements *output,
                               float *values) {
    for (size_t i = 0; i < output->count; i++) {
        float value[4];
        scenes_gltf_read_floats(output, i, value);
        for (unsigned c = 0; c < output->channels; c++) {
            if (!(fabsf(value[c]) <= 1e18f))
                return fail(place, "output %zu is %g: out of range", i, (double)value[c]);
            values[i * output->channels + c] = value[c];
        }
    }
    return LOBE_OK;
}

/// Keys of rotations must be rotations.
static lobe_result check_rotations(const channel_place *place,
                                   const lobe_animation_channel *channel) {
    const bool cubic = channel->interpolation == LOBE_INTERPOLATION_CUBIC;
    for (size_t i = 0; channel->path == LOBE_CHANNEL_ROTATION && i < channel->key_count; i++) {
        const float *q = channel->values + 4 * (cubic ? 3 * i + 1 : i);
        const double square =
            (double)q[0] * q[0] + (double)q[1] * q[1] + (double)q[2] * q[2] + (double)q[3] * q[3];
        if (!(square > 1e-8))
            return fail(place, "the rotation of key %zu has no length", i);
    }
    return LOBE_OK;
}

static lobe_result open_input(const channel_place *place, int accessor, gltf_elements *input) {
    char what[160] = "times of ";
    name_place(place, what + strlen(what), sizeof what - strlen(what));
    lobe_result result = scenes_gltf_open_accessor(place->import, accessor, what, input);
    if (result != LOBE_OK)
        return result;
    if (input->channels != 1 || input->component != GLTF_FLOAT)
        return fail(place, "times are %u components of type %d; expected one float",
                    input->channels, input->component);
    return LOBE_OK;
}

/// Of the elements that make up a key.
static unsigned channels_of(const lobe_animation_channel *channel) {
    return channel->path == LOBE_CHANNEL_WEIGHTS ? 1
                                                 : (unsigned)scenes_channel_width(channel->path);
}

static bool is_allowed(const gltf_elements *output, const lobe_animation_channel *channel) {
    const bool integers = channel->path != LOBE_CHANNEL_TRANSLATION &&
                          channel->path != LOBE_CHANNEL_SCALE && output->normalised &&
                          output->component != GLTF_UNSIGNED_INT;
    return output->channels == channels_of(channel) &&
           (output->component == GLTF_FLOAT || integers);
}

static lobe_result open_output(const channel_place *place, int accessor,
                               const lobe_animation_channel *channel, gltf_elements *output) {
    char what[160] = "values of ";
    name_place(place, what + strlen(what), sizeof what - strlen(what));
    lobe_result result = scenes_gltf_open_accessor(place->import, accessor, what, output);
    if (result != LOBE_OK)
        return result;
    if (!is_allowed(output, channel))
        return fail(place, "%u components of type %d%s are no %s", output->channels,
                    output->component, output->normalised ? ", normalised," : "",
                    name_of(&place->animation->channels[place->channel]));
    const size_t each = (channel->width / channels_of(channel)) *
                        (channel->interpolation == LOBE_INTERPOLATION_CUBIC ? 3 : 1);
    if (output->count / each != channel->key_count || output->count % each != 0)
        return fail(place, "%zu outputs for %zu keys of %zu", output->count, channel->key_count,
                    each);
    return LOBE_OK;
}

/// Several channels may use one accessor, so what they take is limited in all.
static lobe_result allocate_keys(gltf_import *import, const channel_place *place, size_t values,
                                 lobe_animation_channel *channel) {
    const lobe_allocator *allocator = lobe_host_allocator(import->host);
    if (values > GLTF_MAXIMUM_KEY_VALUES - import->key_values)
        return lobe_host_fail(import->host, LOBE_ERROR_LIMIT,
                              "%s: animations of more than %zu values", import->path,
                              GLTF_MAXIMUM_KEY_VALUES);
    import->key_values += values;
    channel->times = lobe_allocate(allocator, channel->key_count, sizeof *channel->times);
    channel->values = lobe_allocate(allocator, values, sizeof *channel->values);
    if (channel->times && channel->values)
        return LOBE_OK;
    return lobe_host_fail(import->host, LOBE_ERROR_OUT_OF_MEMORY, "%s: out of memory",
                          place->import->path);
}

static lobe_result read_keys(gltf_import *import, const channel_place *place,
                             const gltf_animation_sampler *sampler,
                             lobe_animation_channel *channel) {
    gltf_elements input, output;
    lobe_result result = open_input(place, sampler->input, &input);
    channel->key_count = result == LOBE_OK ? input.count : 0;
    if (result == LOBE_OK)
        result = open_output(place, sampler->output, channel, &output);
    if (result == LOBE_OK)
        result = allocate_keys(import, place, output.count * output.channels, channel);
    if (result == LOBE_OK)
        result = read_times(place, &input, channel->times);
    if (result == LOBE_OK)
        result = read_values(place, &output, channel->values);
    return result == LOBE_OK ? check_rotations(place, channel) : result;
}

// ---------------------------------------------------------------------------------------------
// Channels and animations

static void mark_node(gltf_import *import, int node, lobe_channel_path path) {
    if (path == LOBE_CHANNEL_WEIGHTS)
        import->motions[node].weights = true;
    else
        import->motions[node].moves = true;
}

static lobe_result check_node(const channel_place *place, int node, lobe_channel_path path) {
    const gltf_document *document = place->import->document;
    if (node < 0 || (size_t)node >= document->node_count)
        return fail(place, "there is no node %d", node);
    if (document->nodes[node].has_matrix && path != LOBE_CHANNEL_WEIGHTS)
        return fail(place, "node %d has a matrix, which cannot be animated", node);
    return LOBE_OK;
}

static lobe_result aim_at_node(gltf_import *import, const channel_place *place, int node,
                               lobe_animation_channel *channel) {
    lobe_result result = check_node(place, node, channel->path);
    if (result != LOBE_OK)
        return result;
    channel->target = import->rig_nodes[node];
    mark_node(import, node, channel->path);
    return channel->path == LOBE_CHANNEL_WEIGHTS ? find_width(place, node, &channel->width)
                                                 : LOBE_OK;
}

/// Finds what the channel moves. `*known`: false if lobe does not move it.
static lobe_result find_target(gltf_import *import, const channel_place *place,
                               lobe_animation_channel *channel, bool *known) {
    const gltf_channel *from = &place->animation->channels[place->channel];
    animation_target target = {.node = from->node};
    char cause[128];
    *known = true;
    if (!from->pointer || strcmp(from->path, "pointer") != 0)
        *known = is_node_path(from->path, &channel->path);
    else if (!scenes_gltf_resolve_pointer(import, from->pointer, &target, known, cause,
                                          sizeof cause))
        return fail(place, "pointer '%.96s': %s", from->pointer, cause);
    else
        channel->path = target.path;
    if (!*known)
        return LOBE_OK;
    channel->width = scenes_channel_width(channel->path);
    channel->map = target.map;
    channel->target = target.index;
    if (scenes_channel_owner(channel->path) == CHANNEL_OF_MATERIAL)
        import->moved_parts[target.index] |= scenes_posed_part(channel);
    return scenes_channel_owner(channel->path) == CHANNEL_OF_NODE
               ? aim_at_node(import, place, target.node, channel)
               : LOBE_OK;
}

/// Leaves `channel` without keys if nothing of what it moves is in a scene of lobe.
static lobe_result convert_channel(gltf_import *import, const channel_place *place,
                                   lobe_animation_channel *channel) {
    const gltf_channel *from = &place->animation->channels[place->channel];
    bool known;
    if (from->sampler < 0 || (size_t)from->sampler >= place->animation->sampler_count)
        return fail(place, "there is no sampler %d", from->sampler);
    lobe_result result = find_target(import, place, channel, &known);
    if (result == LOBE_OK && !known)
        scenes_gltf_note_unsupported(import, "animations of other properties");
    if (result != LOBE_OK || !known)
        return result;
    const gltf_animation_sampler *sampler = &place->animation->samplers[from->sampler];
    result = find_interpolation(place, sampler->interpolation, &channel->interpolation);
    return result == LOBE_OK ? read_keys(import, place, sampler, channel) : result;
}

static lobe_result convert_animation(gltf_import *import, size_t index, lobe_animation *animation) {
    const lobe_allocator *allocator = lobe_host_allocator(import->host);
    const gltf_animation *from = &import->document->animations[index];
    animation->name = lobe_copy_text(allocator, from->name);
    animation->channels =
        lobe_allocate(allocator, from->channel_count + 1, sizeof *animation->channels);
    if (!animation->name || !animation->channels)
        return lobe_host_fail(import->host, LOBE_ERROR_OUT_OF_MEMORY, "%s: out of memory",
                              import->path);
    lobe_result result = LOBE_OK;
    for (size_t i = 0; result == LOBE_OK && i < from->channel_count; i++) {
        const channel_place place = {import, from, index, i};
        lobe_animation_channel *channel = &animation->channels[animation->channel_count++];
        result = convert_channel(import, &place, channel);
        if (result == LOBE_OK && channel->key_count == 0)
            animation->channel_count--;
        else if (result == LOBE_OK)
            animation->duration = fmax(animation->duration, channel->times[channel->key_count - 1]);
    }
    return result;
}

lobe_result scenes_gltf_convert_animations(gltf_import *import) {
    lobe_rig *rig = import->scene->rig;
    const size_t count = import->document->animation_count;
    rig->animations =
        lobe_allocate(lobe_host_allocator(import->host), count + 1, sizeof *rig->animations);
    if (!rig->animations)
        return lobe_host_fail(import->host, LOBE_ERROR_OUT_OF_MEMORY, "%s: out of memory",
                              import->path);
    lobe_result result = LOBE_OK;
    while (result == LOBE_OK && rig->animation_count < count) {
        const size_t index = rig->animation_count++;
        result = convert_animation(import, index, &rig->animations[index]);
    }
    return result;
}
