#ifndef FACET_COLOURS_GLSL
#define FACET_COLOURS_GLSL

// What facet_colours.comp has found, for one channel; white where colours do not vary.

layout(constant_id = SPECIALISE_TRANSFER_COLOURED) const bool COLOURED = false;

layout(set = 0, binding = 9, std430) readonly buffer colour_words { uint colours[]; };

// x: what the facet reflects diffusely, y: all that it reflects.
vec2 colours_of_facet(uint index, uint channel) {
    if (!COLOURED)
        return vec2(1.0);
    uint first = index * TRANSFER_COLOUR_WORDS, other = channel + 3u;
    return vec2(unpackHalf2x16(colours[first + channel / 2u])[channel % 2u],
                unpackHalf2x16(colours[first + other / 2u])[other % 2u]);
}

#endif
