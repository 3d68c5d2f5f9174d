#version 460
#extension GL_GOOGLE_include_directive : require

// Converts linear pictures to the window's content, encoded with the sRGB curve, as
// lobe_display_encode and lobe_heat_colour do.

#include "display.h"

layout(push_constant) uniform display_block { display_constants display; };
layout(set = 0, binding = 0) uniform sampler2D first_picture;
layout(set = 0, binding = 1) uniform sampler2D second_picture;

layout(location = 0) out vec4 colour_out;

const float PI = 3.14159265;

// IEC 61966-2-1.
vec3 encode_srgb(vec3 linear) {
    linear = clamp(linear, 0.0, 1.0);
    return mix(1.055 * pow(linear, vec3(1.0 / 2.4)) - 0.055, 12.92 * linear,
               lessThanEqual(linear, vec3(0.0031308)));
}

// LOBE_TONE_MAP_SHOULDER of lobe/colour.h.
vec3 tone_map(vec3 radiance) {
    vec3 colour = clamp(display.gain * radiance, 0.0, 1e30);
    float maximum = max(colour.r, max(colour.g, colour.b));
    return maximum <= 0.5 ? colour : colour / maximum * (1.0 - 0.25 / maximum);
}

// Björn Ottosson, 2020, "A perceptual color space for image processing": Oklab to linear sRGB.
vec3 oklab_to_linear(vec3 lab) {
    float l = lab.x + 0.3963377774 * lab.y + 0.2158037573 * lab.z;
    float m = lab.x - 0.1055613458 * lab.y - 0.0638541728 * lab.z;
    float s = lab.x - 0.0894841775 * lab.y - 1.2914855480 * lab.z;
    l = l * l * l;
    m = m * m * m;
    s = s * s * s;
    return vec3(4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s,
                -1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s,
                -0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s);
}

// See lobe_heat_colour.
vec3 heat_colour(float value) {
    float t = clamp(value, 0.0, 1.0);
    float lightness = 0.15 + 0.82 * t;
    float hue = radians(285.0 + 180.0 * t);
    float chroma = 0.17 * pow(sin(PI * (t + 0.10) / 1.22), 0.8);
    return encode_srgb(oklab_to_linear(vec3(lightness, chroma * cos(hue), chroma * sin(hue))));
}

vec3 show(vec4 texel, uint kind, float maximum) {
    if (kind == DISPLAY_COLOUR)
        return encode_srgb(texel.rgb);
    if (kind == DISPLAY_COUNT)
        return texel.a > 0.0 ? heat_colour(texel.r / maximum) : vec3(0.0);
    return encode_srgb(tone_map(texel.rgb));
}

float luminance(vec3 rgb) {
    return dot(rgb, vec3(0.2126, 0.7152, 0.0722));
}

// The difference relative to the reference's luminance plus 1/50 of white, so that errors in black
// areas are not infinite.
float relative_error(vec3 tested, vec3 reference) {
    vec3 difference = abs(tested - reference);
    return display.gain * luminance(difference) /
           (display.gain * max(luminance(reference), 0.0) + 0.02);
}

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    bool second = display.comparison == DISPLAY_SPLIT && gl_FragCoord.x > display.divider;
    // Just after the window has grown, pictures may be smaller than it.
    vec4 first = texelFetch(first_picture, min(pixel, textureSize(first_picture, 0) - 1), 0);
    vec4 other = texelFetch(second_picture, min(pixel, textureSize(second_picture, 0) - 1), 0);
    vec3 colour;
    if (display.comparison == DISPLAY_ERROR)
        colour = heat_colour(relative_error(first.rgb, other.rgb) / display.error_maximum);
    else if (second)
        colour = show(other, display.second_kind, display.second_maximum);
    else
        colour = show(first, display.first_kind, display.first_maximum);
    if (display.comparison == DISPLAY_SPLIT && abs(gl_FragCoord.x - display.divider) < 1.0)
        colour = vec3(1.0);
    colour_out = vec4(colour, 1.0);
}
