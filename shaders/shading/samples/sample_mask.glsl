#ifndef SAMPLE_MASK_GLSL
#define SAMPLE_MASK_GLSL

// Which pixels another sample leaves alone.

layout(push_constant) uniform constants_block {
    uint occluded; // bool
};
layout(set = 0, binding = 0) uniform sampler2D counts;
layout(set = 0, binding = 1) uniform sampler2D occluder;

// Hides all pixels that take one sample: they get the nearest depth. The others get the depth of
// what was drawn before, if there is anything. Returns that depth.
float hidden_depth() {
    ivec2 position = ivec2(gl_FragCoord.xy);
    bool hidden = texelFetch(counts, position, 0).r == 1.0;
    if (!hidden && occluded == 0u)
        discard;
    return hidden ? 1.0 : texelFetch(occluder, position, 0).r;
}

#endif
