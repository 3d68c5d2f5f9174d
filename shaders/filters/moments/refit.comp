#version 460
#extension GL_GOOGLE_include_directive : require

// Fits the bins of a material to other texels: expectation maximisation over the sample that
// moment_cell_survey drew, from those of the fit before, or anew from the bins that were fitted to
// the material's first texels. If other starts then lead to a better fit, the best of those is
// taken; where the host could not read the first texels, there are only those. Last the units of
// the bins' moments. In C for a material's first texels: passes/filters/moments/partition.h. One
// group, all sums in a fixed order.
//
// Everything that the group adds up goes through one function, called at one place: lavapipe
// compiles for seconds what it inlines at several, with a barrier at each.

#include "interface/moment_bins.h"
#include "interface/moment_refit.h"
#include "lib/lobe/bin_membership.glsl"
#include "lib/lobe/plane_lobe.glsl"
#include "maps/base_widths.glsl"

const uint THREADS = 128;

layout(local_size_x = THREADS) in;

layout(constant_id = SPECIALISE_PARTITION) const uint PARTITION = PARTITION_FITTED;
layout(constant_id = SPECIALISE_BRIGHT_TEXELS) const bool BRIGHT_TEXELS = false;

// The numbers of all survey_extremes.
layout(set = 0, binding = 16, std430) readonly buffer extremes_block { float extremes[]; };
layout(set = 0, binding = 17, std430) readonly buffer lobes_block { vec4 lobes[]; };
layout(set = 0, binding = 18, std140) uniform first_block { moment_binning_constants first_bins; };
layout(set = 0, binding = 19, std430) writeonly buffer binning_block {
    moment_binning_constants binning;
};

// Each thread reads and writes its own bin's; the rest is read by all, before the first writes it.
layout(set = 0, binding = 20, std430) buffer state_block { fit_state state; };

layout(push_constant) uniform constants_block { refit_constants constants; };

// Of a fit; more do not change a picture. And between one added bin and the next.
const int ROUNDS = 30, ROUNDS_OF_ADDED = 5;

// lavapipe leaves all loops of a thread when it has gone through them 65535 times in all. No more
// is tried after so many, which leaves enough for the range and the last measurement.
const uint MOST_ITERATIONS = 60000;

// The part of its score by which a fit must be better than that from the first bins, or than the
// bins that are shown.
const float GAIN = 0.02;

// From one fit to the next: how many rounds of a search for better bins there are, and in how many
// fits bins become those at most.
const uint ROUNDS_OF_SEARCH = 2, FITS_OF_BLEND = 128;

// On the way from bins to others: by how much of its norm the Gaussian of any changes from one fit
// to the next, if there are fits enough.
const float STEP = 0.01;

// Where the logarithm of a point's likelihood under the bins changes by so much from one fit to the
// next, the texels are others, and nothing of earlier fits counts.
const float OTHER_TEXELS = 0.5;

// A bin with a smaller part of all lobes starts over.
const float LEAST_PART = 1e-9;

// For lobes that are not in the sample. What exceeds it is clipped, if the storage format demands
// that.
const float MARGIN = 1.25;

// After the bins, where these become others, come the old ones.
const uint OLD_BINS = MOMENT_MAXIMUM_BINS;
shared moment_bin bins[2 * MOMENT_MAXIMUM_BINS];
shared vec4 gaussians[2 * MOMENT_MAXIMUM_BINS]; // of the bins: covariance (xx, yy, xy), their part
shared moment_bin kept_bins[MOMENT_MAXIMUM_BINS];
shared vec4 kept_gaussians[MOMENT_MAXIMUM_BINS];
shared fit_gaussian shown[MOMENT_MAXIMUM_BINS]; // where an earlier fit goes on: what comes out
shared fit_gaussian old[MOMENT_MAXIMUM_BINS], other[MOMENT_MAXIMUM_BINS]; // while it becomes others
shared float lengths[THREADS]; // of parts of the way
shared uint parts_of_number[THREADS];

uint thread() {
    return gl_LocalInvocationID.x;
}

// ---------------------------------------------------------------------------------------------
// What the lobes are within

struct plane_range {
    vec2 low, high;  // of their places
    float sharpest;  // root of the concentration
    float broadest;  // variance
    float heaviest;  // mass of a texel's lobes
    float brightest; // texel of the bins' colours
};

const uint EXTREMES = 8; // numbers of survey_extremes
shared float least[EXTREMES];

// The largest mass that plane_mass can give this lobe, for either setting of the knob `base`.
float largest_mass(float kappa) {
    float mass = plane_mass(MODEL, DISTRIBUTION_VMF, kappa);
    if (MODEL != MODEL_MICROFACET)
        return mass;
    float square = min(2.0 / max(kappa, 1e-6), GGX_SQUARE_MAXIMUM);
    return max(mass, max(1.0 / (1.0 - square), 1.0 + plane_variance(DISTRIBUTION_VMF, kappa)));
}

// The largest mass of a lobe between two concentrations.
float largest_mass_between(float least, float most) {
    const int STEPS = 32;
    float low = max(least, 1e-3), ratio = max(most, low) / low;
    // The peak, at the broadest lobe that the plane holds.
    float mass = largest_mass(clamp(1.0 / PLANE_VARIANCE_MAXIMUM, least, most));
    for (int i = 0; i <= STEPS; ++i)
        mass = max(mass, largest_mass(low * pow(ratio, float(i) / float(STEPS))));
    return mass;
}

void measure_widths(vec2 factors, inout plane_range range) {
    range.sharpest = 0.45;
    range.broadest = 0.0;
    range.heaviest = 0.0; // of all lobes, which one bin may get
    for (int i = 0; i < LOBE_COUNT; ++i) {
        float a = base_concentration(i, factors.x), b = base_concentration(i, factors.y);
        float share = MODEL == MODEL_MICROFACET ? 1.0 : material.lobe_colour[i].w;
        range.heaviest += share * largest_mass_between(min(a, b), max(a, b));
        range.sharpest = max(range.sharpest, sqrt(max(a, b)));
        range.broadest =
            max(range.broadest,
                max(plane_variance(DISTRIBUTION, base_parameter(i, factors.x)),
                    plane_variance(DISTRIBUTION, base_parameter(i, factors.y))));
    }
    range.heaviest = max(range.heaviest, 1e-6);
}

plane_range find_range() {
    if (thread() < EXTREMES) {
        float value = 1e30;
        for (uint i = thread(); i < EXTREMES * constants.cells; i += EXTREMES)
            value = min(value, extremes[i]);
        least[thread()] = value;
    }
    barrier();
    plane_range range;
    range.low = vec2(least[0], least[1]);
    range.high = -vec2(least[2], least[3]);
    range.brightest = -least[6];
    measure_widths(vec2(least[4], -least[5]), range);
    return range;
}

// A corner of the range of all places, where samples are rare. Without weight.
vec4 corner_of(plane_range range, uint index) {
    return vec4((index & 1u) != 0u ? range.low.x : range.high.x,
                (index & 2u) != 0u ? range.low.y : range.high.y,
                (index & 4u) != 0u ? range.broadest : 1.0 / (range.sharpest * range.sharpest),
                0.0);
}

// ---------------------------------------------------------------------------------------------
// What the bins have of the sample

// Sums over all lobes, w the weight of what the bin has of them, d their place from its centre, v
// their variance:
const uint WEIGHT = 0;     // w
const uint PLACE = 1;      // w d
const uint VARIANCE = 3;   // w v
const uint MOMENTS = 4;    // w d d: xx, yy, xy
const uint LIKELIHOOD = 7; // of a lobe under all bins, times its weight
const uint OVERLAP = 8;    // of the bin's Gaussian with a lobe's, times its weight
const uint SUMS = 9;
// Largest numbers. With the bin's share r of a lobe:
const uint REACH = 9;       // max(|d_x|, |d_y|) sqrt(r): of r |d| / s and r d^2 / s^2 none exceeds
                            // one in units s of it
const uint BROADEST = 10;   // r v
const uint SHARPEST = 11;   // r sqrt(concentration)
const uint SMALLEST = 12;   // -v
const uint WORST = 13;      // what a lobe's likelihood lacks of the mean, times its weight,
const uint WORST_LOBE = 14; // and the first lobe for which that is largest
const uint NUMBERS = 15;

shared float own_numbers[NUMBERS][THREADS];
shared float numbers[MOMENT_MAXIMUM_BINS][NUMBERS];

// Likelihoods of a lobe under bins.
struct bin_likelihoods {
    float own; // under one of them
    float most, sum; // the sum of all is sum exp(most)
};

// What likelihoods take of bins. All of them, for loops that the compiler unrolls: what is indexed
// otherwise, and what is shared, lavapipe reads thread by thread.
struct bin_shapes {
    vec4 centre[MOMENT_MAXIMUM_BINS];
    vec4 shape[MOMENT_MAXIMUM_BINS];
};

bin_shapes shapes_from(uint first) {
    bin_shapes shapes;
    for (uint i = 0; i < MOMENT_MAXIMUM_BINS; ++i) {
        shapes.centre[i] = bins[first + i].centre;
        shapes.shape[i] = bins[first + i].shape;
    }
    return shapes;
}

// `index`: of the one.
bin_likelihoods likelihoods_of(vec4 lobe, uint index, bin_shapes shapes, uint count) {
    bin_likelihoods result = bin_likelihoods(0.0, -1e30, 0.0);
    float values[MOMENT_MAXIMUM_BINS];
    for (uint i = 0; i < MOMENT_MAXIMUM_BINS; ++i) {
        moment_bin bin = moment_bin(shapes.centre[i], shapes.shape[i], vec4(0.0));
        values[i] = i < count ? bin_likelihood(bin, lobe.xy, lobe.z) : -1e30;
        result.most = max(result.most, values[i]);
        result.own = i == index ? values[i] : result.own;
    }
    for (uint i = 0; i < MOMENT_MAXIMUM_BINS; ++i)
        result.sum += exp(values[i] - result.most);
    return result;
}

struct merged_number {
    float value, lobe;
};

// A number of `count` threads, each `step` after the other.
merged_number merge_threads(uint number, uint first, uint count, uint step) {
    merged_number result =
        merged_number(own_numbers[number][first], own_numbers[WORST_LOBE][first]);
    for (uint i = 1; i < count; ++i) {
        float other = own_numbers[number][first + i * step];
        if (other > result.value)
            result.lobe = own_numbers[WORST_LOBE][first + i * step];
        result.value = number < SUMS ? result.value + other : max(result.value, other);
    }
    return result;
}

// Adds up what all threads have: in parts, and then those. Always in the same order.
void merge(uint index) {
    const uint PARTS = 8, SIZE = THREADS / PARTS;
    uint number = thread() / PARTS, first = thread() % PARTS * SIZE;
    barrier();
    if (number < WORST_LOBE) {
        merged_number part = merge_threads(number, first, SIZE, 1);
        own_numbers[number][first] = part.value;
        if (number == WORST)
            own_numbers[WORST_LOBE][first] = part.lobe;
    }
    barrier();
    if (thread() < WORST_LOBE) {
        merged_number whole = merge_threads(thread(), 0, PARTS, SIZE);
        numbers[index][thread()] = whole.value;
        if (thread() == WORST)
            numbers[index][WORST_LOBE] = whole.lobe;
    }
    barrier();
}

// Up to a constant factor.
float evaluate_gaussian(vec2 d, vec3 covariance) {
    float determinant = max(covariance.x * covariance.y - covariance.z * covariance.z, 1e-16);
    float square = dot(vec3(covariance.yx, -2.0 * covariance.z), vec3(d * d, d.x * d.y));
    return exp(-0.5 * square / determinant) / sqrt(determinant);
}

// What the rounds do.
const uint FROM_FIRST = 0;  // improve the first bins
const uint GROW = 1;        // improve one bin, and add others
const uint BY_DISTANCE = 2; // improve bins of equal steps of the distance from the middle
const uint BY_WIDTH = 3;    // and of the logarithm of the variance
const uint FOLLOW = 4;      // improve the last fit's bins
const uint BLEND = 5;       // improve those that a search has found, which the bins become
const uint BLEND_OLD = 6;   // and those from which they do
const uint MEASURE = 7;     // nothing: the numbers of the best of all are wanted
const uint UNBEGUN = 8;     // of a search: the next fit begins it

// Without first bins, adding bins comes first.
uint first_step() {
    return constants.has_first != 0 ? FROM_FIRST : GROW;
}

// How near bins are to those of a fit anew to the same lobes:
const uint MOVES = 0;
const uint SETTLES = 1; // they become these
const uint RESTS = 2;   // they are these

struct progress {
    uint step, round;
    uint count;       // of bins
    float likelihood; // of the last round
    float score;      // the same
    float kept_score; // of the bins kept
    float kept_likelihood;
    bool gained;      // those are not from the first bins
    uint iterations;  // of a thread's loops
    // Where an earlier fit goes on:
    bool follows;
    bool settles;   // a fit anew, which the bins become
    bool unchanged; // bins rest, and are only measured
    uint texels;    // a number of the lobes
    uint quiet;     // fits since they changed
    uint rest;      // how near bins are to those of a fit anew to the same lobes
    float part;     // of the way from old bins to others
    float old;      // part of each lobe that is shared as by the old bins
    float followed; // likelihood under the bins that are followed
    uint next;      // step at which the next fit goes on
    float shown_score;
    uint left;      // rounds of the search in this fit
    // What comes before the next round: in one place, because lavapipe compiles this shader three
    // times as long where each of these, with its barriers, is inlined at every call.
    bool begins, saves, shows;
    // Of all lobes: the middle, how far they are from it, and logarithms of the variance.
    vec2 middle;
    float reach, narrowest, broadest;
};

// In the first round of these, lobes belong to bins by a key.
bool sorts(progress at) {
    return at.round == 0 && (at.step == BY_DISTANCE || at.step == BY_WIDTH);
}

uint sorted_bin(vec4 lobe, progress at) {
    vec2 d = abs(lobe.xy - at.middle);
    float part = at.step == BY_DISTANCE
                     ? max(d.x, d.y) / at.reach
                     : (log(lobe.z) - at.narrowest) / (at.broadest - at.narrowest);
    return uint(clamp(part, 0.0, 0.999) * float(at.count));
}

float member_of(bin_likelihoods all) {
    return exp(all.own - all.most) / all.sum;
}

// That of the places in a bin.
vec2 origin_of(uint index, progress at) {
    return at.old > 0.0 ? shown[index].place.xy : bins[index].centre.xy;
}

// A place between the middles of two bins, for units. Without weight.
vec4 place_between(plane_range range, progress at, uint index) {
    uint pair = index / BETWEEN_PLACES, place = index % BETWEEN_PLACES;
    float part = float(place / BETWEEN_WIDTHS + 1) / float(BETWEEN_STEPS);
    float width = float(place % BETWEEN_WIDTHS) / float(BETWEEN_WIDTHS - 1);
    float least = 1.0 / (range.sharpest * range.sharpest);
    return vec4(mix(origin_of(pair / at.count, at), origin_of(pair % at.count, at), part),
                least * pow(range.broadest / least, width), 0.0);
}

uint between_count(progress at) {
    return PARTITION == PARTITION_FITTED && at.step == MEASURE && constants.interpolated != 0
               ? at.count * at.count * BETWEEN_PLACES
               : 0;
}

// Fills the numbers of one bin.
void visit(uint index, progress at, plane_range range) {
    vec4 sums = vec4(0.0), moments = vec4(0.0), largest = vec4(0.0, 0.0, 0.0, -1e30);
    float worst = -1e30, worst_lobe = 0.0, overlap = 0.0;
    vec2 centre = origin_of(index, at);
    vec3 covariance = gaussians[index].xyz;
    bin_shapes shapes = shapes_from(0), old_shapes = shapes;
    if (at.old > 0.0)
        old_shapes = shapes_from(OLD_BINS);
    uint corners = PARTITION == PARTITION_FITTED ? 8 : 0, between = constants.lobes + corners;
    for (uint n = thread(); n < between + between_count(at); n += THREADS) {
        vec4 lobe = n < constants.lobes ? lobes[n]
                    : n < between       ? corner_of(range, n - constants.lobes)
                                        : place_between(range, at, n - between);
        bin_likelihoods all = likelihoods_of(lobe, index, shapes, at.count);
        float member = member_of(all);
        if (at.old > 0.0) {
            bin_likelihoods old = likelihoods_of(lobe, index, old_shapes, at.count);
            member = mix(member, member_of(old), at.old);
        }
        if (sorts(at))
            member = sorted_bin(lobe, at) == index ? 1.0 : 0.0;
        vec2 d = lobe.xy - centre;
        overlap += lobe.w * evaluate_gaussian(d, covariance + vec3(lobe.zz, 0.0));
        float weight = member * lobe.w, total = all.most + log(all.sum);
        float lack = lobe.w * (at.likelihood - total);
        sums += weight * vec4(1.0, d, lobe.z);
        moments += vec4(weight * vec3(d * d, d.x * d.y), lobe.w * total);
        // The root of the concentration is larger than 1 / sqrt(variance) for GGX.
        largest = max(largest, vec4(sqrt(member) * max(abs(d.x), abs(d.y)), member * lobe.z,
                                    member * sqrt((1.0 + 2.0 * lobe.z) / lobe.z), -lobe.z));
        worst_lobe = lack > worst ? float(n) : worst_lobe;
        worst = max(worst, lack);
    }
    for (uint i = 0; i < 4; ++i) {
        own_numbers[i][thread()] = sums[i];
        own_numbers[4 + i][thread()] = moments[i];
        own_numbers[REACH + i][thread()] = largest[i];
    }
    own_numbers[OVERLAP][thread()] = overlap;
    own_numbers[WORST][thread()] = worst;
    own_numbers[WORST_LOBE][thread()] = worst_lobe;
    merge(index);
}

// ---------------------------------------------------------------------------------------------
// Expectation and maximisation

// The bin of a Gaussian with this part of all lobes.
void set_bin(uint index, float part, vec2 mean, vec3 covariance) {
    float determinant = max(covariance.x * covariance.y - covariance.z * covariance.z, 1e-16);
    vec3 inverse = vec3(covariance.yx, -covariance.z) / determinant;
    float half_points = 0.5 * constants.points;
    bins[index].centre = vec4(mean, log(part) - half_points * log(determinant),
                              half_points * (inverse.x + inverse.y));
    bins[index].shape.xyz = half_points * inverse;
    gaussians[index] = vec4(covariance, part);
}

// At the lobe that the bins serve worst.
void set_bin_anew(uint index, uint count) {
    vec4 lobe = lobes[uint(numbers[0][WORST_LOBE])];
    set_bin(index, 1.0 / float(count), lobe.xy, vec3(lobe.zz, 0.0));
}

void maximise(uint index, float total) {
    float weight = numbers[index][WEIGHT];
    vec2 step = vec2(numbers[index][PLACE], numbers[index][PLACE + 1]) / weight;
    vec3 covariance = vec3(numbers[index][MOMENTS], numbers[index][MOMENTS + 1],
                           numbers[index][MOMENTS + 2]) /
                          weight -
                      vec3(step * step, step.x * step.y);
    covariance.xy = max(covariance.xy, 0.0) + numbers[index][VARIANCE] / weight;
    set_bin(index, weight / total, bins[index].centre.xy + step, covariance);
}

float total_weight(uint count) {
    float total = 0.0;
    for (uint i = 0; i < count; ++i)
        total += numbers[i][WEIGHT];
    return total;
}

// The last of the bins that have lost all lobes; `count` if there is none.
uint lost_bin(uint count, float total) {
    uint lost = count;
    for (uint i = 0; i < count; ++i)
        lost = numbers[i][WEIGHT] < LEAST_PART * total ? i : lost;
    return lost;
}

// Each thread one bin.
void improve(uint count, uint lost, float total) {
    if (thread() == lost)
        set_bin_anew(lost, count);
    else if (thread() < count && numbers[thread()][WEIGHT] >= LEAST_PART * total)
        maximise(thread(), total);
}

// The thread's bin.
fit_gaussian own_gaussian() {
    vec4 own = gaussians[thread()];
    return fit_gaussian(vec4(bins[thread()].centre.xy, own.w, 0.0), vec4(own.xyz, 0.0));
}

void set_bin_of(uint index, fit_gaussian gaussian) {
    set_bin(index, gaussian.place.z, gaussian.place.xy, gaussian.spread.xyz);
}

void set_own_bin(fit_gaussian gaussian) {
    set_bin_of(thread(), gaussian);
}

// Those that the host made, and the Gaussians that they are of.
void take_first_bins() {
    moment_bin first = first_bins.bins[min(thread(), MOMENT_MAXIMUM_BINS - 1)];
    float half_points = 0.5 * constants.points;
    vec3 inverse = first.shape.xyz / half_points;
    float determinant = max(inverse.x * inverse.y - inverse.z * inverse.z, 1e-16);
    float part = exp(min(first.centre.z - half_points * log(determinant), 0.0));
    if (thread() < MOMENT_MAXIMUM_BINS) {
        bins[thread()] = first;
        gaussians[thread()] = vec4(vec3(inverse.yx, -inverse.z) / determinant, part);
    }
}

// ---------------------------------------------------------------------------------------------
// The units of the bins' moments

// The origin is the bin's centre, so that the moments of a small bin keep their digits.
void set_fitted_ranges(uint index, vec2 origin, plane_range range) {
    // A bin without any lobe has units, too.
    float reach = max(MARGIN * numbers[index][REACH], 1e-3);
    float broadest = max(MARGIN * numbers[index][BROADEST], 1e-6);
    float sharpest = max(MARGIN * numbers[index][SHARPEST], 1e-3);
    bins[index].range = vec4(origin, reach, min(sharpest, range.sharpest));
    bins[index].shape.w = min(broadest, range.broadest);
}

// Of hats: of any lobes, except that only bin 0 has rough ones.
void set_common_ranges(uint index, plane_range range, float rough) {
    vec2 half_size = 0.501 * (range.high - range.low);
    bins[index].centre = vec4(0.0);
    bins[index].shape = vec4(0.0, 0.0, 0.0,
                             index == 0 ? range.broadest : min(range.broadest, rough));
    bins[index].range = vec4(0.5 * (range.low + range.high),
                             max(max(half_size.x, half_size.y), 1e-3), range.sharpest);
}

// Two standard deviations of the lobes' places wide, from the numbers of a bin that has all lobes
// and is centred at their mean. Lobes count as rough if their variance is above the geometric mean
// of the smallest and the largest, if those differ.
vec4 hats_of() {
    float variance = 0.5 * (numbers[0][MOMENTS] + numbers[0][MOMENTS + 1]) / numbers[0][WEIGHT];
    float most = numbers[0][BROADEST], least = -numbers[0][SMALLEST];
    return vec4(bins[0].centre.xy, 0.5 / sqrt(max(variance, 1e-8)),
                most > 1.2 * least ? sqrt(least * most) : 1e9);
}

// ---------------------------------------------------------------------------------------------
// All steps

void keep_bins(inout progress at) {
    if (thread() < constants.bins) {
        kept_bins[thread()] = bins[thread()];
        kept_gaussians[thread()] = gaussians[thread()];
    }
    at.kept_score = at.score;
    at.kept_likelihood = at.likelihood;
}

// When a single bin has all lobes.
void measure_whole(inout progress at) {
    at.middle = bins[0].centre.xy;
    at.reach = max(numbers[0][REACH], 1e-6);
    at.narrowest = log(-numbers[0][SMALLEST]);
    at.broadest = log(numbers[0][BROADEST]);
}

// Nothing more is tried.
void finish(inout progress at) {
    at.step = MEASURE;
    at.count = constants.bins;
    if (thread() < constants.bins) {
        bins[thread()] = kept_bins[thread()];
        gaussians[thread()] = kept_gaussians[thread()];
    }
}

// From the first bins, or from one; for hats, one that moves to the mean.
void begin(inout progress at) {
    at.step = first_step();
    at.count = PARTITION == PARTITION_FITTED && at.step == FROM_FIRST ? constants.bins : 1;
    at.round = 0;
    at.likelihood = at.score = at.kept_score = 0.0;
    at.gained = false;
    take_first_bins();
}

// The step after one of these.
void next_step(inout progress at) {
    ++at.step;
    if (at.step == BY_WIDTH && !(at.broadest > at.narrowest + 0.2))
        ++at.step;
    if (at.step == GROW)
        at.count = 1;
}

// The step after a fit of all bins.
void end_step(inout progress at) {
    if (at.follows) {
        if (at.score < at.shown_score * (1.0 + GAIN))
            at.step = BLEND;
        else
            next_step(at);
        at.begins = at.step == FOLLOW;
        return;
    }
    bool first = at.step == first_step();
    if (first || at.score < at.kept_score * (at.gained ? 1.0 : 1.0 + GAIN)) {
        at.gained = at.step != FROM_FIRST;
        keep_bins(at);
    }
    next_step(at);
    if (at.step == FOLLOW || constants.bins == 1)
        finish(at);
}

// When a fit has settled: what comes next.
void go_on(inout progress at) {
    at.round = 0;
    if (at.count == constants.bins) {
        end_step(at);
        return;
    }
    if (at.count == 1)
        measure_whole(at);
    if (thread() == 0)
        set_bin_anew(at.count, at.count + 1);
    ++at.count;
}

// The squared error of the bins as Gaussians, integrated over the plane, without what does not
// depend on them: the integral of bins^2 - 2 bins lobes. (Likelihoods do not tell which of two fits
// a picture is better with.)
float score_of(progress at, float total) {
    float score = 0.0;
    for (uint i = 0; i < at.count; ++i) {
        score -= 2.0 * gaussians[i].w * numbers[i][OVERLAP] / total;
        for (uint k = 0; k < at.count; ++k)
            score += gaussians[i].w * gaussians[k].w *
                     evaluate_gaussian(bins[i].centre.xy - bins[k].centre.xy,
                                       gaussians[i].xyz + gaussians[k].xyz);
    }
    return score;
}

// About those of a thread's loops in a round.
uint iterations_of_round(uint count) {
    uint lobes = constants.lobes / THREADS + 2;
    return count * (lobes + 30 + count);
}

// ---------------------------------------------------------------------------------------------
// From one fit to the next

// Bins that follow those of an earlier fit take one round from there, so that what moves slowly
// does not jump. A search for better ones goes through all steps, a few rounds in each fit. When a
// step ends with bins that serve the lobes better by a clear margin, the bins that are shown become
// these in equal parts of the way.

// Whether there are bins of an earlier fit.
bool knows_earlier() {
    return PARTITION == PARTITION_FITTED && constants.follows != 0 &&
           state.bins == constants.bins && state.points == constants.points;
}

void follow(inout progress at) {
    at.step = state.step == BLEND ? BLEND : FOLLOW;
    at.round = at.step == BLEND ? state.round : 0;
    at.count = constants.bins;
    if (thread() < constants.bins) {
        if (at.step == BLEND)
            set_own_bin(other[thread()]);
        else
            set_own_bin(shown[thread()]);
    }
}

void go_on_with_search(inout progress at) {
    at.step = state.step;
    at.round = state.round;
    at.count = state.count;
    at.likelihood = state.other_likelihood;
    at.middle = vec2(state.middle_x, state.middle_y);
    at.reach = state.reach;
    at.narrowest = state.narrowest;
    at.broadest = state.broadest;
    at.left = ROUNDS_OF_SEARCH;
    at.begins = at.step == UNBEGUN;
    if (thread() < constants.bins && !at.begins)
        set_own_bin(state.other[thread()]);
}

// Leaves the search to the next fit.
void save_search(inout progress at) {
    if (thread() < constants.bins)
        state.other[thread()] = own_gaussian();
    at.next = at.step;
    if (thread() == 0) {
        state.round = at.round;
        state.count = at.count;
        state.other_likelihood = at.likelihood;
        state.middle_x = at.middle.x;
        state.middle_y = at.middle.y;
        state.reach = at.reach;
        state.narrowest = at.narrowest;
        state.broadest = at.broadest;
    }
}

// Of what there is of the old bins at a part of the way: at both ends, where a little of them makes
// narrow bins broad or leaves them so, it changes slowly.
float rest_of_old(float part) {
    return 1.0 - part * part * (3.0 - 2.0 * part);
}

void measure_shown(inout progress at) {
    bool becomes_other = at.next == BLEND;
    at.step = MEASURE;
    at.count = constants.bins;
    at.old = becomes_other ? rest_of_old(at.part) : 0.0;
    if (thread() >= constants.bins)
        return;
    set_own_bin(becomes_other ? other[thread()] : shown[thread()]);
    set_bin_of(OLD_BINS + thread(), old[thread()]);
}

// Gives each bin found the number of one that is shown and near.
void order_found() {
    for (uint i = 0; i < constants.bins; ++i) {
        uint nearest = i;
        float least = 1e30;
        for (uint k = i; k < constants.bins; ++k) {
            vec2 d = bins[k].centre.xy - shown[i].place.xy;
            float width = sqrt(gaussians[k].x + gaussians[k].y) -
                          sqrt(shown[i].spread.x + shown[i].spread.y);
            float square = dot(d, d) + width * width;
            nearest = square < least ? k : nearest;
            least = min(least, square);
        }
        vec2 place = bins[i].centre.xy;
        vec4 gaussian = gaussians[i];
        bins[i].centre.xy = bins[nearest].centre.xy;
        gaussians[i] = gaussians[nearest];
        bins[nearest].centre.xy = place;
        gaussians[nearest] = gaussian;
    }
}

// `likelihood`: of the lobes under the bins found.
void begin_blend(inout progress at, float likelihood) {
    at.followed = likelihood;
    barrier();
    if (thread() == 0)
        order_found();
    barrier();
    if (thread() < constants.bins) {
        old[thread()] = shown[thread()];
        other[thread()] = own_gaussian();
    }
    at.next = BLEND;
    at.round = 0;
    at.part = 0.0;
    at.shows = true;
}

// Two Gaussians as one, which has their moments, as bins have those of the lobes that they share as
// before and of the others.
fit_gaussian join(fit_gaussian a, fit_gaussian b, float part) {
    float sum = mix(a.place.z, b.place.z, part);
    float weight = sum > 0.0 ? part * b.place.z / sum : part;
    vec2 d = b.place.xy - a.place.xy;
    vec3 spread = mix(a.spread.xyz, b.spread.xyz, weight) +
                  weight * (1.0 - weight) * vec3(d * d, d.x * d.y);
    return fit_gaussian(vec4(mix(a.place.xy, b.place.xy, weight), sum, 0.0), vec4(spread, 0.0));
}

fit_gaussian way(uint index, float part) {
    return join(old[index], other[index], 1.0 - rest_of_old(min(part, 1.0)));
}

// The integral of the product of two bins' Gaussians.
float product(fit_gaussian a, fit_gaussian b) {
    return a.place.z * b.place.z *
           evaluate_gaussian(a.place.xy - b.place.xy, a.spread.xyz + b.spread.xyz);
}

// Of the bin that changes most. (Of the sum of all, bins with few lobes, which may be all that some
// lights see, hardly tell.)
float difference(float first, float second) {
    float most = 0.0;
    for (uint i = 0; i < constants.bins; ++i) {
        fit_gaussian a = way(i, first), b = way(i, second);
        float before = product(a, a), after = product(b, b);
        float square = max(before + after - 2.0 * product(a, b), 0.0);
        most = max(most, square / max(max(before, after), 1e-30));
    }
    return sqrt(most);
}

// The part of the way at the next fit: the rest of it in steps of equal length.
float next_part(progress at, uint fits) {
    float step = (1.0 - at.part) / float(THREADS), whole = 0.0, length = 0.0;
    float begin = at.part + float(thread()) * step;
    lengths[thread()] = difference(begin, begin + step);
    barrier();
    for (uint i = 0; i < THREADS; ++i)
        whole += lengths[i];
    float wanted = max(STEP, whole / float(max(fits, at.round + 1) - at.round));
    uint count = 0;
    for (; count < THREADS && length + lengths[count] <= wanted; ++count)
        length += lengths[count];
    if (count == THREADS)
        return 1.0;
    return at.part + (float(count) + (wanted - length) / lengths[count]) * step;
}

void blend(inout progress at) {
    barrier();
    at.part = next_part(at, at.quiet >= FIT_RESTS_AFTER ? FITS_OF_SETTLING : FITS_OF_BLEND);
    ++at.round;
    if (thread() < constants.bins)
        shown[thread()] = at.part == 1.0 ? other[thread()] : way(thread(), at.part);
    if (at.part == 1.0 && at.rest == SETTLES)
        at.rest = RESTS;
    at.next = at.part == 1.0 ? UNBEGUN : BLEND;
    at.shows = true;
}

// The bins that were found have been improved.
void improve_old(inout progress at) {
    at.followed = at.likelihood;
    at.step = BLEND_OLD;
    if (thread() < constants.bins) {
        other[thread()] = own_gaussian();
        set_own_bin(old[thread()]);
    }
}

void end_blend(inout progress at) {
    if (thread() < constants.bins)
        old[thread()] = own_gaussian();
    blend(at);
}

void end_round(inout progress at, bool settled) {
    settled = settled || at.round == (at.count < constants.bins ? ROUNDS_OF_ADDED : ROUNDS);
    if (at.iterations > MOST_ITERATIONS)
        finish(at);
    else if (settled)
        go_on(at);
}

// After a round of the search.
void end_round_of_search(inout progress at) {
    --at.left;
    if (at.step == BLEND)
        begin_blend(at, at.likelihood);
    else
        at.saves = at.shows = at.left == 0;
}

void end_following(inout progress at) {
    at.followed = at.likelihood;
    at.shown_score = at.score;
    if (thread() < constants.bins)
        shown[thread()] = own_gaussian();
    at.shows = constants.bins == 1;
    if (!at.shows)
        go_on_with_search(at);
}

void take_round(inout progress at) {
    float total = total_weight(at.count), former = at.likelihood;
    bool follows = at.step == FOLLOW || at.step == BLEND || at.step == BLEND_OLD;
    uint lost = follows ? at.count : lost_bin(at.count, total);
    at.likelihood = numbers[0][LIKELIHOOD] / total;
    at.round += follows ? 0 : 1;
    at.iterations += iterations_of_round(at.count);
    bool settled = at.round > 2 && lost == at.count && at.likelihood <= former + 1e-4;
    at.score = score_of(at, total);
    barrier();
    if ((at.step == FOLLOW || at.step == BLEND) &&
        abs(at.likelihood - at.followed) > OTHER_TEXELS * constants.points) {
        at.follows = false;
        at.begins = true;
        return;
    }
    improve(at.count, lost, total);
    barrier();
    if (at.step == FOLLOW)
        end_following(at);
    else if (at.step == BLEND)
        improve_old(at);
    else if (at.step == BLEND_OLD)
        end_blend(at);
    else {
        end_round(at, settled);
        if (at.follows)
            end_round_of_search(at);
    }
    barrier();
}

// Each thread has to do with its own bin alone.
void prepare_round(inout progress at) {
    if (at.begins)
        begin(at);
    if (at.saves)
        save_search(at);
    if (at.shows)
        measure_shown(at);
    barrier();
    at.begins = at.saves = at.shows = false;
}

// A number of the lobes: FNV-1a (Fowler, Noll, Vo).
uint number_of_lobes() {
    uint number = 2166136261u;
    for (uint n = thread(); n < constants.lobes; n += THREADS)
        for (int i = 0; i < 4; ++i)
            number = (number ^ floatBitsToUint(lobes[n][i])) * 16777619u;
    parts_of_number[thread()] = number;
    barrier();
    for (uint n = 0; n < THREADS; ++n)
        number = (n == 0 ? 2166136261u : number) * 16777619u ^ parts_of_number[n];
    return number;
}

// Where texels have stayed the same for some fits, bins become those of a fit anew, and stay.
void rest(inout progress at) {
    if (at.rest == RESTS) {
        at.shows = at.unchanged = true;
    } else if (at.next == BLEND) {
        at.round = at.quiet == FIT_RESTS_AFTER ? 0 : state.round;
        blend(at);
    } else {
        at.follows = false;
        at.settles = at.begins = true;
    }
}

void begin_settling(inout progress at) {
    at.settles = false;
    at.follows = true;
    at.rest = SETTLES;
    begin_blend(at, at.kept_likelihood);
}

void go_on_with_earlier(inout progress at) {
    at.quiet = state.texels == at.texels ? state.quiet + 1 : 0;
    at.rest = at.quiet > 0 ? state.rest : MOVES;
    at.next = state.step;
    at.part = state.part;
    at.likelihood = at.followed = state.likelihood;
    if (thread() < constants.bins) {
        shown[thread()] = state.shown[thread()];
        old[thread()] = state.old[thread()];
        other[thread()] = state.other[thread()];
    }
    barrier();
    if (at.rest == RESTS || at.quiet >= FIT_RESTS_AFTER)
        rest(at);
    else
        follow(at);
}

progress fit(plane_range range) {
    progress at;
    at.iterations = 0;
    at.texels = number_of_lobes();
    at.quiet = 0;
    at.rest = MOVES;
    at.saves = at.shows = at.settles = at.unchanged = false;
    at.old = 0.0;
    at.follows = knows_earlier();
    at.begins = !at.follows;
    if (at.follows)
        go_on_with_earlier(at);
    for (;;) {
        prepare_round(at);
        for (uint i = 0; i < at.count; ++i)
            visit(i, at, range);
        if (at.step == MEASURE)
            break;
        take_round(at);
        if (PARTITION != PARTITION_FITTED)
            at.step = MEASURE;
        if (at.step == MEASURE && at.settles)
            begin_settling(at);
    }
    return at;
}

// For the next fit.
void save_state(progress at) {
    if (!at.follows) {
        at.followed = numbers[0][LIKELIHOOD] / total_weight(constants.bins);
        at.next = UNBEGUN;
        at.rest = RESTS;
        if (thread() < constants.bins)
            shown[thread()] = own_gaussian();
    }
    if (thread() < constants.bins) {
        state.shown[thread()] = shown[thread()];
        if (at.next == BLEND) {
            state.old[thread()] = old[thread()];
            state.other[thread()] = other[thread()];
        }
    }
    if (thread() == 0) {
        state.step = at.next;
        if (at.next == BLEND)
            state.round = at.round;
        state.part = at.part;
        state.bins = constants.bins;
        state.points = constants.points;
        state.likelihood = at.followed;
        state.texels = at.texels;
        state.quiet = min(at.quiet, 1000u);
        state.rest = at.rest;
        state.unchanged = at.unchanged ? 1u : 0u;
    }
}

void main() {
    plane_range range = find_range();
    progress at = fit(range);
    vec4 hats = PARTITION == PARTITION_FITTED ? first_bins.hats : hats_of();
    barrier();
    if (thread() < constants.bins) {
        if (PARTITION == PARTITION_FITTED)
            set_fitted_ranges(thread(), origin_of(thread(), at), range);
        else
            set_common_ranges(thread(), range, hats.w);
    }
    if (thread() < MOMENT_MAXIMUM_BINS) {
        const moment_bin none = moment_bin(vec4(0.0), vec4(0.0), vec4(0.0));
        binning.bins[thread()] = bins[thread()];
        binning.bins[OLD_BINS + thread()] = at.old > 0.0 ? bins[OLD_BINS + thread()] : none;
    }
    if (thread() == 0) {
        binning.hats = hats;
        binning.largest = vec4(1.001 * range.heaviest,
                               BRIGHT_TEXELS ? range.brightest : first_bins.largest.y, at.old, 0.0);
    }
    barrier();
    if (PARTITION == PARTITION_FITTED && constants.follows != 0)
        save_state(at);
    else if (thread() == 0)
        state.bins = 0;
}
