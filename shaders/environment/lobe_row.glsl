#ifndef ENVIRONMENT_LOBE_ROW_GLSL
#define ENVIRONMENT_LOBE_ROW_GLSL

// An elongated lobe is approximated by a row of round ones with Gaussian weights: n of them at
// distances of sqrt(12/(n + 1)) have a variance of one (to 7 %), and overlap without ripple as long
// as each is at least half as broad as their distance: a row is at most sqrt((n + 4)/3) times as
// long as broad. This determines how many are needed. If fewer are allowed, the row is broader and
// shorter than the lobe, with the same sum of variances, which is what a smooth environment shows;
// but no broader than a single round lobe, because it would collect lamps from beside the lobe.
struct lobe_row {
    float count;
    float variance; // of each
    float reach;    // from one to the next, in the lobe's longer deviations
};

// `major` and `minor`: the lobe's variances. `most`: round lobes that are allowed.
lobe_row row_of_lobe(float major, float minor, float most) {
    float wanted = ceil(3.0 * major / max(minor, 1e-3 * major) - 4.0 - 0.5);
    float count = clamp(wanted, 1.0, most);
    // Of the row's variances, along it and across.
    float longest = (count + 4.0) / 3.0;
    float round_variance = sqrt(major * minor);
    float variance = count > 1.0
                         ? max(minor, min((major + minor) / (longest + 1.0), round_variance))
                         : round_variance;
    float reach = sqrt(max(min(longest * variance, major) - variance, 0.0) / major) *
                  sqrt(12.0 / (count + 1.0));
    return lobe_row(count, variance, reach);
}

// Of the i-th: its place in steps from the middle, and its weight, not normalised.
vec2 place_in_row(lobe_row row, uint i) {
    float place = float(i) - 0.5 * (row.count - 1.0);
    return vec2(place, exp(-6.0 / (row.count + 1.0) * place * place));
}

#endif
