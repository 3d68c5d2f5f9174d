#ifndef LIB_BOX_REDUCTION_GLSL
#define LIB_BOX_REDUCTION_GLSL

// Halving a row of `size` texels to max(1, floor(size / 2)): each target texel is the mean of the
// source within its extent, so that the overall mean is kept at any size.
//
// Guthe, Heckbert 2005, Non-Power-of-Two Mipmap Creation (NVIDIA): the polyphase box. For
// size = 2m + 1, target j covers [j, j + 1) (2m + 1) / m and takes texels 2j, 2j + 1, 2j + 2.

int box_taps(int size) {
    return size == 1 ? 1 : 2 + (size & 1);
}

// Weights of texels 2j, 2j + 1 and 2j + 2; they add up to one.
vec3 box_weights(int size, int j) {
    if (size == 1)
        return vec3(1.0, 0.0, 0.0);
    if ((size & 1) == 0)
        return vec3(0.5, 0.5, 0.0);
    int m = size / 2;
    return vec3(m - j, m, j + 1) / float(size);
}

#endif
