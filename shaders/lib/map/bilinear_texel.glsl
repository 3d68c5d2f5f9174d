#ifndef LIB_BILINEAR_TEXEL_GLSL
#define LIB_BILINEAR_TEXEL_GLSL

// The texels that a bilinear sampler blends, for shading that evaluates them one by one.

// The first of the four around a place. In texels.
vec2 first_bilinear_texel(vec2 position, vec2 size) {
    return floor(position * size - 0.5);
}

struct bilinear_texel {
    vec2 position; // texture coordinates of its centre
    float weight;
};

// Number `index` of the four around `position`, of a map of `size` texels.
bilinear_texel find_bilinear_texel(vec2 position, vec2 size, uint index) {
    vec2 first = first_bilinear_texel(position, size), part = position * size - 0.5 - first;
    vec2 corner = vec2(index & 1u, (index >> 1u) & 1u), weights = mix(1.0 - part, part, corner);
    return bilinear_texel((first + corner + 0.5) / size, weights.x * weights.y);
}

#endif
