#ifndef LIB_HASH_GLSL
#define LIB_HASH_GLSL

// Wellons 2018, Prospecting for hash functions: lowbias32.
uint hash(uint value) {
    value = (value ^ (value >> 16u)) * 0x7feb352du;
    value = (value ^ (value >> 15u)) * 0x846ca68bu;
    return value ^ (value >> 16u);
}

// In [0, 1).
float hashed_number(uint value) {
    return float(hash(value) >> 8u) / 16777216.0;
}

#endif
