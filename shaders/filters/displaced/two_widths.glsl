#ifndef TWO_WIDTHS_GLSL
#define TWO_WIDTHS_GLSL

// Two widths of microfacets that stand for all of a footprint's, where roughness varies: polish
// beside rough patches mirrors as both do, and as no width between.

struct two_widths {
    vec2 alpha;
    vec2 share; // of what is mirrored; their sum is 1
};

// The two that have the footprint's means of 2 / alpha^2, of alpha and of alpha^2. The first mean
// is nearly all that of the smoother width, whose share is looked for in a few steps.
// `concentration`: the first; `moments`: the others.
two_widths find_two_widths(float concentration, vec2 moments) {
    const uint STEPS = 4u;
    const float LEAST_ALPHA = 1e-3;
    two_widths result = two_widths(moments.xx, vec2(0.5, 0.5));
    for (uint i = 0u; i < STEPS; ++i) {
        float smoother = sqrt(2.0 * max(result.share.x, 1e-3) / max(concentration, 1.0));
        smoother = clamp(smoother, LEAST_ALPHA, max(moments.x, LEAST_ALPHA));
        // Means of what the rougher one has beyond the smoother, and of its square.
        float beyond = moments.x - smoother;
        float square = moments.y - smoother * (2.0 * moments.x - smoother);
        if (beyond < 1e-2 * moments.x || square <= beyond * beyond) {
            // Of one width, or of as good as one.
            return two_widths(moments.xx, vec2(0.5, 0.5));
        }
        result.alpha = vec2(smoother, min(smoother + square / beyond, 1.0));
        result.share.y = clamp(beyond * beyond / square, 0.0, 1.0);
        result.share.x = 1.0 - result.share.y;
    }
    return result;
}

#endif
