#include "scenes/animation/channel.h"

#include <math.h>
#include <string.h>

/// The values of a key: of a cubic spline, those between its tangents.
static const float *key_values(const lobe_animation_channel *channel, size_t key) {
    const bool cubic = channel->interpolation == LOBE_INTERPOLATION_CUBIC;
    return channel->values + channel->width * (cubic ? 3 * key + 1 : key);
}

/// The last key that is not after `seconds`. There is a key before it and one after it.
static size_t find_key(const lobe_animation_channel *channel, double seconds) {
    size_t low = 0, high = channel->key_count - 1;
    while (high - low > 1) {
        const size_t middle = low + (high - low) / 2;
        if (channel->times[middle] <= seconds)
            low = middle;
        else
            high = middle;
    }
    return low;
}

static void take_key(const lobe_animation_channel *channel, size_t key, double *values) {
    const float *from = key_values(channel, key);
    for (size_t i = 0; i < channel->width; i++)
        values[i] = from[i];
}

// ---------------------------------------------------------------------------------------------
// Rotations

static double normalised(const float *quaternion, double out[4]) {
    double square = 0;
    for (int i = 0; i < 4; i++)
        square += (double)quaternion[i] * quaternion[i];
    const double length = sqrt(square);
    for (int i = 0; i < 4; i++)
        out[i] = quaternion[i] / length;
    return length;
}

/// Shoemake 1985, "Animating Rotation with Quaternion Curves"; along the shorter arc.
static void slerp(const float *from, const float *to, double part, double out[4]) {
    double a[4], b[4], cosine = 0;
    if (!(normalised(from, a) > 0) || !(normalised(to, b) > 0)) {
        memcpy(out, a, sizeof a);
        return;
    }
    for (int i = 0; i < 4; i++)
        cosine += a[i] * b[i];
    const double sign = cosine < 0 ? -1 : 1;
    // The angle from both chords: exact for small angles, where the cosine is not.
    double difference = 0, sum = 0;
    for (int i = 0; i < 4; i++) {
        difference += (sign * b[i] - a[i]) * (sign * b[i] - a[i]);
        sum += (sign * b[i] + a[i]) * (sign * b[i] + a[i]);
    }
    const double angle = 2 * atan2(sqrt(difference), sqrt(sum)), sine = sin(angle);
    const double first = sine > 1e-9 ? sin((1 - part) * angle) / sine : 1 - part;
    const double second = sine > 1e-9 ? sin(part * angle) / sine : part;
    for (int i = 0; i < 4; i++)
        out[i] = first * a[i] + sign * second * b[i];
}

// ---------------------------------------------------------------------------------------------
// Between two keys

static void interpolate_linearly(const lobe_animation_channel *channel, size_t key, double part,
                                 double *values) {
    const float *from = key_values(channel, key), *to = key_values(channel, key + 1);
    if (channel->path == LOBE_CHANNEL_ROTATION) {
        slerp(from, to, part, values);
        return;
    }
    for (size_t i = 0; i < channel->width; i++)
        values[i] = (1 - part) * from[i] + part * to[i];
}

/// glTF 2.0, appendix C.5.
static void interpolate_cubically(const lobe_animation_channel *channel, size_t key, double part,
                                  double *values) {
    const double t = part, t2 = t * t, t3 = t2 * t;
    const double seconds = (double)channel->times[key + 1] - channel->times[key];
    const float *from = key_values(channel, key), *to = key_values(channel, key + 1);
    const float *out_tangent = from + channel->width, *in_tangent = to - channel->width;
    double square = 0;
    for (size_t i = 0; i < channel->width; i++) {
        values[i] = (2 * t3 - 3 * t2 + 1) * from[i] + seconds * (t3 - 2 * t2 + t) * out_tangent[i] +
                    (3 * t2 - 2 * t3) * to[i] + seconds * (t3 - t2) * in_tangent[i];
        square += values[i] * values[i];
    }
    // A curve of quaternions may pass through zero, which is no rotation.
    if (channel->path == LOBE_CHANNEL_ROTATION && !(square > 1e-8))
        take_key(channel, part < 0.5 ? key : key + 1, values);
}

void scenes_channel_evaluate(const lobe_animation_channel *channel, double seconds,
                             double *values) {
    const size_t last = channel->key_count - 1;
    if (last == 0 || !(seconds > channel->times[0])) {
        take_key(channel, 0, values);
        return;
    }
    if (!(seconds < channel->times[last])) {
        take_key(channel, last, values);
        return;
    }
    const size_t key = find_key(channel, seconds);
    const double start = channel->times[key], length = channel->times[key + 1] - start;
    const double part = length > 0 ? (seconds - start) / length : 0;
    if (channel->interpolation == LOBE_INTERPOLATION_STEP)
        take_key(channel, key, values);
    else if (channel->interpolation == LOBE_INTERPOLATION_LINEAR)
        interpolate_linearly(channel, key, part, values);
    else
        interpolate_cubically(channel, key, part, values);
}
