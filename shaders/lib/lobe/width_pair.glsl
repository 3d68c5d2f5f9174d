#ifndef LIB_WIDTH_PAIR_GLSL
#define LIB_WIDTH_PAIR_GLSL

// Two base lobes that stand for many of several widths: Gauss's quadrature of two points for the
// distribution of u = 1 + log(1 - |r|) / 5, which has its first three moments and is exact where
// there are two widths only. Logarithms, because what is seen of a polish beside rough lobes is its
// peak, and so that half floats tell sharp lobes apart; u is in [-1.8, 1].

struct width_pair {
    vec2 complements; // 1 - |r|, that of the sharper lobe first
    vec2 parts;       // add up to 1
    float distance;   // of both in u
};

vec3 width_powers(float complement) {
    float u = 1.0 + 0.2 * log(max(complement, 1e-6));
    return vec3(u, u * u, u * u * u);
}

// Deviations below this are noise of half floats: the third moment says nothing then.
const float LEAST_WIDTH_DEVIATION = 0.05;

// `powers`: means of width_powers.
width_pair width_pair_of(vec3 powers) {
    float mean = powers.x;
    float deviation = sqrt(max(powers.y - mean * mean, 0.0));
    float third = powers.z - mean * (3.0 * deviation * deviation + mean * mean);
    float skewness = third / pow(max(deviation, LEAST_WIDTH_DEVIATION), 3.0);
    float root = sqrt(skewness * skewness + 4.0);
    vec2 u = mean + 0.5 * deviation * vec2(skewness - root, skewness + root);
    float sharp = 0.5 + 0.5 * skewness / root;
    return width_pair(min(exp(5.0 * (u - 1.0)), 1.0), vec2(sharp, 1.0 - sharp), deviation * root);
}

// How much of a quantity that many lobes add up to, such as colour, the broad lobe has [0, 1], if
// both have its sum and that of its products with u. `mean`: of u; `sum` and `products`: with
// weights that add up to 1.
vec3 broad_share(width_pair pair, float mean, vec3 sum, vec3 products) {
    vec3 covariance = products - mean * sum;
    float distance = max(pair.distance, 2.0 * LEAST_WIDTH_DEVIATION);
    return clamp(pair.parts.y + covariance / (distance * max(sum, vec3(1e-6))), 0.0, 1.0);
}

#endif
