#ifndef MOTION_GLSL
#define MOTION_GLSL

// From positions in clip space (x, y, w) in this frame and in the previous one to a motion in
// pixels, to the right and down: what to add to a position to find the previous one.

layout(set = 0, binding = 0, std140) uniform motion_block { motion_constants motion; };

// NaN becomes the limit, too.
float limited(float pixels) {
    const float limit = float(MOTION_LIMIT);
    return abs(pixels) <= limit ? pixels : (pixels < 0.0 ? -limit : limit);
}

vec2 motion_between(vec3 current, vec3 previous) {
    // What was behind the eye had no place in the picture.
    if (previous.z <= 0.0)
        return vec2(float(MOTION_LIMIT));
    vec2 pixels = motion.half_extent.xy * (previous.xy / previous.z - current.xy / current.z);
    return vec2(limited(pixels.x), limited(pixels.y));
}

#endif
