#ifndef MOTION_GLSL
#define MOTION_GLSL

// From a position in clip space (x, y, w), and the previous frame's less that, to a motion in
// pixels, to the right and down: what to add to a position to find the previous one. The difference
// and not the previous position, because it is 0 where nothing moved, however a driver rounds.

layout(set = 0, binding = 0, std140) uniform motion_block { motion_constants motion; };

// NaN becomes the limit, too.
float limited(float pixels) {
    const float limit = float(MOTION_LIMIT);
    return abs(pixels) <= limit ? pixels : (pixels < 0.0 ? -limit : limit);
}

vec2 motion_of(vec3 current, vec3 change) {
    float previous_w = current.z + change.z;
    // What was behind the eye had no place in the picture.
    if (previous_w <= 0.0)
        return vec2(float(MOTION_LIMIT));
    vec2 pixels =
        motion.half_extent.xy * (change.xy - current.xy / current.z * change.z) / previous_w;
    return vec2(limited(pixels.x), limited(pixels.y));
}

#endif
