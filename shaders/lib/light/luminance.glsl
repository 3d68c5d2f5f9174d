#ifndef LIB_LUMINANCE_GLSL
#define LIB_LUMINANCE_GLSL

// Of linear RGB, Rec. 709, as lobe_luminance in engine/include/lobe/colour.h.
const vec3 LUMINANCE_WEIGHTS = vec3(0.2126, 0.7152, 0.0722);

float lobe_luminance(vec3 colour) {
    return dot(colour, LUMINANCE_WEIGHTS);
}

// A colour less its luminance, from the first and last channel of that.
vec3 chroma_of_red_and_blue(vec2 chroma) {
    float green = -dot(LUMINANCE_WEIGHTS.rb, chroma) / LUMINANCE_WEIGHTS.g;
    return vec3(chroma.x, green, chroma.y);
}

#endif
