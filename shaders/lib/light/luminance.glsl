#ifndef LIB_LUMINANCE_GLSL
#define LIB_LUMINANCE_GLSL

// Of linear RGB, Rec. 709, as lobe_luminance in engine/include/lobe/colour.h.
float lobe_luminance(vec3 colour) {
    return dot(colour, vec3(0.2126, 0.7152, 0.0722));
}

#endif
