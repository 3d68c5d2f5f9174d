#include "passes/filters/moments/survey.h"

#include <math.h>
#include <string.h>

#include "passes/context/sample_pattern.h"
#include "passes/filters/moments/coreset.h"
#include "passes/maps/colours/lobe_mask.h"
#include "passes/upload/material_rows.h"

/// What most texels have, to find those that differ.
typedef struct usual_texel {
    float place[2];
    float spread; ///< variance of places and base lobes, summed over both axes
    float width;  ///< mean logarithm of the factor of widths
    float varies; ///< its variance
} usual_texel;

/// One survey while it is made.
typedef struct surveying {
    const lobe_material *material;
    material_rows *rows;
    lobe_mask mask;
    uint64_t kept; ///< texels
    usual_texel usual;
    coreset chosen;
    float low[2], high[2]; ///< of the places
    float factors[2];      ///< smallest and largest of widths
    float *place[2];       ///< of the current row's normals
    float *density;        ///< of the current row
    float *axis[3];        ///< of one of the lobes of the current row
    float data[];
} surveying;

// ---------------------------------------------------------------------------------------------
// One row

/// Places of directions.
static void place_row(const float *x, const float *y, const float *z, uint32_t count,
                      float *restrict u, float *restrict v) {
    for (uint32_t i = 0; i < count; i++) {
        float opposite = 1 + z[i];
        bool far = opposite < 1e-6f;
        float scale = sqrtf(2 / (far ? 1 : opposite));
        u[i] = far ? 2 : x[i] * scale;
        v[i] = far ? 0 : y[i] * scale;
    }
}

/// As normal_at in shaders/maps/base_maps.glsl. Where texels are cut in two, those beyond the edge
/// are interpolated with what is kept.
static void level_what_is_cut(surveying *s, uint32_t y) {
    for (uint32_t x = 0; s->mask.image && !s->mask.cuts_texels && x < s->rows->width; x++)
        for (int axis = 0; axis < 3 && passes_lobe_mask_cuts_texel(&s->mask, x, y); axis++)
            s->rows->normal[axis][x] = axis == 2;
}

static void read_row(surveying *s, uint32_t y) {
    const material_rows *rows = s->rows;
    passes_material_row_read(s->rows, y);
    if (rows->normals)
        level_what_is_cut(s, y);
    if (rows->normals)
        place_row(rows->normal[0], rows->normal[1], rows->normal[2], rows->width, s->place[0],
                  s->place[1]);
}

/// About the binary logarithm: within 0.09, and cheap.
static float rough_logarithm(float x) {
    int32_t bits;
    memcpy(&bits, &x, sizeof bits);
    return (float)bits * (1.0f / (1 << 23)) - 127;
}

/// Half of the texels are drawn everywhere alike, the others by how much they differ from what is
/// usual, in squares of the usual differences.
static const float least_density = 0.5f, most_density = 1e6f;

static void weigh_row(surveying *s) {
    const usual_texel usual = s->usual;
    const float *u = s->place[0], *v = s->place[1], *factor = s->rows->factor;
    const float by_place = 0.25f / usual.spread, by_width = 0.25f / usual.varies;
    float *restrict density = s->density;
    for (uint32_t i = 0; i < s->rows->width; i++) {
        float x = u[i] - usual.place[0], y = v[i] - usual.place[1];
        float width = rough_logarithm(factor[i]) - usual.width;
        float value = least_density + by_place * (x * x + y * y) + by_width * width * width;
        density[i] = value < most_density ? value : most_density; // a factor may be infinite
    }
}

/// What a mask cuts away would have bins of its own, but nobody sees it.
static void leave_out_cut(surveying *s, uint32_t y) {
    for (uint32_t x = 0; s->mask.image && x < s->rows->width; x++)
        s->density[x] = passes_lobe_mask_cuts_texel(&s->mask, x, y) ? 0 : s->density[x];
}

static float least_of(float a, float b) {
    return a < b ? a : b;
}

static float most_of(float a, float b) {
    return a > b ? a : b;
}

/// In lanes, so that one comparison need not wait for the one before.
static void extend(const float *values, uint32_t count, float *low, float *high) {
    enum { LANES = 16 };
    float least[LANES], most[LANES];
    for (uint32_t k = 0; k < LANES; k++)
        least[k] = most[k] = values[k % count];
    uint32_t i = 0;
    for (; i + LANES <= count; i += LANES) {
        for (uint32_t k = 0; k < LANES; k++) {
            least[k] = least_of(values[i + k], least[k]);
            most[k] = most_of(values[i + k], most[k]);
        }
    }
    for (; i < count; i++) {
        least[0] = least_of(values[i], least[0]);
        most[0] = most_of(values[i], most[0]);
    }
    for (uint32_t k = 0; k < LANES; k++) {
        *low = least_of(least[k], *low);
        *high = most_of(most[k], *high);
    }
}

/// How far along one axis of the plane the directions lie that have this slope along it. What is
/// interpolated between directions has a slope between theirs, but its place may lie beyond theirs.
static void reach_row(const float *along, const float *z, uint32_t count, float *restrict reach) {
    for (uint32_t i = 0; i < count; i++) {
        float length = sqrtf(along[i] * along[i] + z[i] * z[i]);
        float square = length * (length + z[i]);
        bool far = square < 1e-6f;
        float sign = along[i] < 0 ? -1.0f : 1.0f;
        reach[i] = far ? 2 * sign * length : along[i] * sqrtf(2 / (far ? 1 : square));
    }
}

/// Of directions whose places are the current row's. Overwrites those.
static void extend_places(surveying *s, float *const direction[3]) {
    for (int axis = 0; axis < 2; axis++) {
        extend(s->place[axis], s->rows->width, &s->low[axis], &s->high[axis]);
        reach_row(direction[axis], direction[2], s->rows->width, s->place[axis]);
        extend(s->place[axis], s->rows->width, &s->low[axis], &s->high[axis]);
    }
}

/// Turns normals into lobes that lean away from them: passes_material_lobe_rotate for a row.
static void lean_row(const material_rows *rows, const float lobe[3], float *restrict x,
                     float *restrict y, float *restrict z) {
    const float *nx = rows->normal[0], *ny = rows->normal[1], *nz = rows->normal[2];
    for (uint32_t i = 0; i < rows->width; i++) {
        float product = nx[i] * lobe[0] + ny[i] * lobe[1];
        float along = lobe[2] - product / (1 + most_of(nz[i], -0.999999f));
        x[i] = lobe[0] + nx[i] * along;
        y[i] = lobe[1] + ny[i] * along;
        z[i] = nz[i] * lobe[2] - product;
    }
}

static void extend_places_of_lobes(surveying *s) {
    for (uint32_t k = 0; k < s->material->lobe_count; k++) {
        lean_row(s->rows, s->material->lobes[k].direction, s->axis[0], s->axis[1], s->axis[2]);
        place_row(s->axis[0], s->axis[1], s->axis[2], s->rows->width, s->place[0], s->place[1]);
        extend_places(s, s->axis);
    }
}

// ---------------------------------------------------------------------------------------------
// All rows

/// Texels in each direction that tell what is usual.
enum { PILOT = 24 };

static double variance_of_texel(const surveying *s, float factor) {
    material_lobe lobes[LOBE_MATERIAL_MAXIMUM_LOBES];
    passes_material_lobes_of(s->material, (double[]){0, 0, 1}, (double)factor, lobes);
    return passes_plane_variance(s->material, lobes[0].concentration);
}

static void find_usual(surveying *s) {
    double place[2] = {0}, square = 0, width = 0, width_square = 0, variance = 0, count = 0;
    for (uint32_t i = 0; i < PILOT * PILOT; i++) {
        double row = (i / PILOT + passes_hashed_number(2 * (uint64_t)(i / PILOT))) / PILOT;
        double column = (i % PILOT + passes_hashed_number(2 * (uint64_t)i + 1)) / PILOT;
        const uint32_t x = (uint32_t)(column * s->rows->width);
        const uint32_t y = (uint32_t)(row * s->rows->height);
        if (i % PILOT == 0)
            read_row(s, y);
        // Some texels tell enough; where a mask keeps none of them, all are as usual as others.
        if (passes_lobe_mask_cuts_texel(&s->mask, x, y))
            continue;
        count += 1;
        for (int axis = 0; axis < 2; axis++) {
            double value = (double)s->place[axis][x];
            place[axis] += value;
            square += value * value;
        }
        double logarithm = (double)rough_logarithm(s->rows->factor[x]);
        width += logarithm;
        width_square += logarithm * logarithm;
        variance += variance_of_texel(s, s->rows->factor[x]);
    }
    if (count == 0) {
        s->usual = (usual_texel){.spread = 1, .varies = 1};
        return;
    }
    for (int axis = 0; axis < 2; axis++)
        place[axis] /= count;
    square /= count;
    width /= count;
    width_square /= count;
    variance /= count;
    square -= place[0] * place[0] + place[1] * place[1];
    s->usual = (usual_texel){.place = {(float)place[0], (float)place[1]},
                             .spread = (float)(fmax(square, 0) + 2 * variance),
                             .width = (float)width,
                             .varies = (float)fmax(width_square - width * width, 0.01)};
}

static void read_all(surveying *s) {
    const material_rows *rows = s->rows;
    find_usual(s);
    passes_coreset_begin(&s->chosen, 1.25 * (double)s->kept, (double)least_density);
    for (uint32_t y = 0; y < rows->height; y++) {
        read_row(s, y);
        weigh_row(s);
        leave_out_cut(s, y);
        passes_coreset_add_row(&s->chosen, s->density, rows->width, y);
        if (s->material->model == LOBE_MATERIAL_MICROFACET)
            extend_places(s, rows->normal);
        else
            extend_places_of_lobes(s);
        extend(rows->factor, rows->width, &s->factors[0], &s->factors[1]);
    }
}

// ---------------------------------------------------------------------------------------------
// The result

/// The largest mass that plane_mass in shaders/lib/lobe/plane_lobe.glsl can give this lobe, for
/// either setting of the knob "base".
static double largest_mass(const lobe_material *material, double kappa) {
    bool microfacet = material->model == LOBE_MATERIAL_MICROFACET;
    double clamped = fmax(kappa, 1e-6);
    double projected = 0.5 * (1 + passes_mean_resultant_length(clamped / 2)) / (1 + exp(-clamped));
    double variance = 1 / fmax(kappa, 0.2);
    double mass = variance * clamped / -expm1(-2 * clamped) / (microfacet ? projected : 1);
    return microfacet ? fmax(mass, fmax(passes_plane_mass_of_ggx(kappa), 1 + variance)) : mass;
}

/// The largest mass of a lobe between two concentrations.
static double largest_mass_between(const lobe_material *material, double least, double most) {
    enum { STEPS = 32 };
    double low = fmax(least, 1e-3), ratio = fmax(most, low) / low;
    // The peak, at the broadest lobe that the plane holds.
    double mass = largest_mass(material, fmin(fmax(0.2, least), most));
    for (int i = 0; i <= STEPS; i++)
        mass = fmax(mass, largest_mass(material, low * pow(ratio, (double)i / STEPS)));
    return mass;
}

static void measure_widths(const surveying *s, plane_range *range) {
    material_lobe lobes[2][LOBE_MATERIAL_MAXIMUM_LOBES];
    uint32_t count = 0;
    for (int i = 0; i < 2; i++)
        count = passes_material_lobes_of(s->material, (double[]){0, 0, 1}, (double)s->factors[i],
                                         lobes[i]);
    double mass = 0; // of all lobes, which one bin may get
    for (uint32_t k = 0; k < count; k++) {
        double least = fmin(lobes[0][k].concentration, lobes[1][k].concentration);
        double most = fmax(lobes[0][k].concentration, lobes[1][k].concentration);
        mass += lobes[0][k].weight * largest_mass_between(s->material, least, most);
        range->sharpest = fmax(range->sharpest, sqrt(most));
        range->broadest = fmax(range->broadest, passes_plane_variance(s->material, least));
    }
    range->heaviest = fmax(range->heaviest, mass);
}

static plane_range range_of(const surveying *s) {
    plane_range range = {.sharpest = 0.45, .heaviest = 1e-6};
    for (int axis = 0; axis < 2; axis++) {
        range.low[axis] = (double)s->low[axis];
        range.high[axis] = (double)s->high[axis];
    }
    measure_widths(s, &range);
    return range;
}

static void take_samples(const surveying *s, const lobe_scene *scene,
                         const device_material *material, lobe_survey *survey) {
    for (uint32_t i = 0; i < s->chosen.count; i++) {
        const coreset_texel *texel = &s->chosen.texels[i];
        // The texels themselves, which spread further than what is interpolated between them:
        // borders between bins are softer. Under a mask that cuts texels, what it keeps of them.
        double point[2];
        passes_lobe_mask_point(&s->mask, texel->x, texel->y, point);
        survey->count +=
            passes_plane_samples_read(scene, material, point[0], point[1], (double)texel->weight,
                                      &survey->samples[survey->count]);
    }
}

static surveying *begin(const device_scene *scene, const device_material *material,
                        const lobe_allocator *allocator) {
    material_rows *rows = passes_material_rows_create(allocator, material);
    if (!rows)
        return NULL;
    enum { ARRAYS = 6 };
    surveying *s =
        lobe_allocate(allocator, 1, sizeof *s + (size_t)ARRAYS * rows->width * sizeof *s->data);
    if (!s) {
        lobe_release(rows);
        return NULL;
    }
    s->material = material->material;
    s->rows = rows;
    s->mask = passes_lobe_mask(scene, material);
    s->kept = passes_lobe_mask_count_kept(&s->mask);
    if (s->kept == 0) {
        s->mask = (lobe_mask){.grid = s->mask.grid};
        s->kept = (uint64_t)rows->width * rows->height;
    }
    s->place[0] = s->data;
    s->place[1] = s->data + rows->width;
    s->density = s->data + (size_t)2 * rows->width;
    for (uint32_t i = 0; i < 3; i++)
        s->axis[i] = s->data + (size_t)(3 + i) * rows->width;
    s->low[0] = s->low[1] = s->factors[0] = INFINITY;
    s->high[0] = s->high[1] = s->factors[1] = -INFINITY;
    return s;
}

/// For maps that the host cannot read: the range of any material.
static const plane_range everything = {{-2, -2}, {2, 2}, 1e3, 5, 10};

lobe_survey *passes_lobe_survey_make(const device_scene *scene, const device_material *material,
                                     const lobe_allocator *allocator) {
    lobe_survey *survey = lobe_allocate(allocator, 1, sizeof *survey);
    if (!survey)
        return NULL;
    survey->range = everything;
    if (!passes_material_rows_are_readable(material))
        return survey;
    surveying *s = begin(scene, material, allocator);
    if (s) {
        read_all(s);
        survey->range = range_of(s);
        take_samples(s, scene->scene, material, survey);
        lobe_release(s->rows);
    } else {
        lobe_release(survey);
        survey = NULL;
    }
    lobe_release(s);
    return survey;
}
