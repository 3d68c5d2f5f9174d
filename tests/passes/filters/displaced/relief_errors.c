// What `displaced` shows of reliefs from far away, beside `displaced-reference`, as the tables of
// docs/displacement.md:
//
//     relief_errors MATERIAL SEED [FILE...]
//
// For each of unseen_reliefs and of the height maps in files, scaled to slopes of rms 0.7. The
// materials are named below. `swapped` compares what is reflected one way with what is reflected
// the other way instead, of metal.

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "tests/passes/filters/displaced/relief_sides.h"
#include "tests/passes/filters/displaced/unseen_reliefs.h"
#include "tests/passes/filters/wu/sample_reliefs.h"

enum {
    FAR_PERIODS = 40, ///< of which each pixel sees several
    MAXIMUM_RELIEFS = 32,
    MAXIMUM_ROUGHNESSES = 2,
    VIEWERS = 2,
    SUNS = 3,
    APARTS = 4,
    AZIMUTHS = 2,
    CELLS = MAXIMUM_ROUGHNESSES * VIEWERS * SUNS * APARTS,
};

// Degrees above the carrier, and around its normal between sun and viewer.
static const double viewers[VIEWERS] = {20, 50}, suns[SUNS] = {15, 30, 60},
                    aparts[APARTS] = {0, 60, 120, 180};

// ---------------------------------------------------------------------------------------------
// Materials

/// Sets a texel of a map from a place, in texels, and the part of the heights' range.
typedef void (*texel_rule)(int x, int y, double height, float texel[4]);

static void metal_squares(int x, int y, double height, float texel[4]) {
    (void)height;
    texel[1] = 1;
    texel[2] = (float)((x / 8 + y / 8) % 2);
}

/// From a quarter of the material's roughness to all of it.
static void rough_waves(int x, int y, double height, float texel[4]) {
    (void)height;
    const double turn = 2 * M_PI / UNSEEN_EXTENT;
    texel[1] = (float)(0.625 + 0.375 * sin(3 * turn * x + 1) * sin(turn * (2 * y + x)));
    texel[2] = 1;
}

static void rough_tops(int x, int y, double height, float texel[4]) {
    (void)x;
    (void)y;
    texel[1] = height > 0.5 ? 1 : 0.25F;
    texel[2] = 1;
}

static void shining_tops(int x, int y, double height, float texel[4]) {
    (void)x;
    (void)y;
    for (int i = 0; i < 3; i++)
        texel[i] = (float)fmax(2 * height - 1, 0);
}

static void shining_pits(int x, int y, double height, float texel[4]) {
    shining_tops(x, y, 1 - height, texel);
}

typedef struct shown_material {
    const char *name;
    float metallic, colour;
    double roughness[MAXIMUM_ROUGHNESSES]; ///< ended by 0
    texel_rule varies; ///< NULL: nothing; otherwise roughness and metal, of which these are factors
    bool shines;       ///< it is what shines that varies, and there is no other light
} shown_material;

static const shown_material materials[] = {
    {"metal", 1, 1, {0.25, 0.6}, NULL, false},
    {"half-metal", 0.5F, 1, {0.25, 0.6}, NULL, false},
    {"dielectric", 0, 0.2F, {0.1, 0.4}, NULL, false},
    {"diffuse", 0, 0.8F, {1}, NULL, false},
    {"metal-squares", 1, 1, {0.4, 0.9}, metal_squares, false},
    {"rough-waves", 1, 0.8F, {0.9}, rough_waves, false},
    {"rough-tops", 1, 0.8F, {0.9}, rough_tops, false},
    {"shining-tops", 0, 0, {1}, shining_tops, true},
    {"shining-pits", 0, 0, {1}, shining_pits, true},
};

static const shown_material *material_named(const char *name) {
    for (size_t i = 0; i < sizeof materials / sizeof *materials; i++)
        if (strcmp(materials[i].name, name) == 0)
            return &materials[i];
    return NULL;
}

static int compare_floats(const void *a, const void *b) {
    const float first = *(const float *)a, second = *(const float *)b;
    return (first > second) - (first < second);
}

/// Of as many texels as the heights, of which each has the part that is lower for a height.
static lobe_image varying_map(lobe_image heights, texel_rule rule) {
    const size_t count = (size_t)heights.width * heights.height;
    float *sorted = malloc(count * sizeof *sorted);
    assert_non_null(sorted);
    for (size_t i = 0; i < count; i++)
        sorted[i] = ((const float *)heights.texels)[4 * i];
    qsort(sorted, count, sizeof *sorted, compare_floats);
    lobe_image map = map_image(LOBE_FORMAT_RGBA32_FLOAT, heights.width, heights.height);
    for (uint32_t i = 0; i < count; i++) {
        size_t low = 0, high = count;
        while (low < high) {
            const size_t middle = (low + high) / 2;
            if (sorted[middle] < ((const float *)heights.texels)[4 * (size_t)i])
                low = middle + 1;
            else
                high = middle;
        }
        rule((int)(i % map.width), (int)(i / map.width), (double)low / (double)count,
             (float *)map.texels + 4 * (size_t)i);
    }
    free(sorted);
    return map;
}

/// A plane of the material, far away. Copies the heights.
static lobe_scene *far_plane(const shown_material *shown, double roughness, lobe_image heights,
                             bool sky) {
    lobe_image copy = map_image(heights.format, heights.width, heights.height);
    memcpy(copy.texels, heights.texels, (size_t)16 * heights.width * heights.height);
    lobe_material material =
        microfacet_material(LOBE_DISTRIBUTION_GGX, roughness, (double)shown->metallic);
    for (int i = 0; i < 3; i++) {
        material.base_colour[i] = shown->colour;
        material.emissive[i] = (float)shown->shines;
    }
    lobe_scene *scene = relief_sides_plane(&material, copy, FAR_PERIODS, sky);
    if (shown->varies) {
        lobe_texture_use map = scene_add_map(scene, varying_map(heights, shown->varies));
        map.nearest = true; // no values between
        if (shown->shines)
            scene->materials[0].emissive_map = map;
        else
            scene->materials[0].metallic_roughness_map = map;
    }
    return scene;
}

// ---------------------------------------------------------------------------------------------
// Measuring

/// A roughness, a viewer, and a sun with an angle to the viewer; `sky`: instead of the sun.
typedef struct sight {
    int roughness, viewer, sun, apart;
    bool sky;
} sight;

typedef struct outcome {
    sight seen;
    double found, expected, noise;
} outcome;

typedef struct relief_outcomes {
    const char *name;
    outcome outcomes[CELLS + MAXIMUM_ROUGHNESSES * VIEWERS];
    int count;
} relief_outcomes;

/// Smooth microfacets need more samples.
static uint32_t samples_of(double roughness) {
    return roughness < 0.15 ? 256 : roughness < 0.35 ? 64 : 16;
}

/// Averaged over azimuths. `truth`: by the reference.
static relief_mean mean_of_sight(fixture *f, lobe_scene *scene, double roughness, sight seen,
                                 bool truth) {
    relief_mean result = {0};
    for (int a = 0; a < AZIMUTHS; a++) {
        const relief_side viewer = {viewers[seen.viewer], 17 + 83 * a};
        relief_sides_look(scene, viewer);
        if (scene->light_count > 0)
            relief_sides_shine(
                scene, (relief_side){suns[seen.sun],
                                     viewer.azimuth + (a % 2 ? -1 : 1) * aparts[seen.apart]});
        const relief_mean one =
            relief_sides_draw(f, scene, truth ? "displaced-reference" : "displaced",
                              truth ? samples_of(roughness) : 1);
        result.value += one.value / AZIMUTHS;
        result.noise += one.noise * one.noise;
    }
    result.noise = sqrt(result.noise) / AZIMUTHS;
    return result;
}

/// All sights of a scene by the filter, then by the reference: each change of the filter makes the
/// relief's maps again.
static void measure_scene(fixture *f, lobe_scene *scene, double roughness, int index,
                          relief_outcomes *results) {
    const bool sky = scene->light_count == 0;
    const int sun_count = sky ? 1 : SUNS * APARTS;
    outcome *outcomes = &results->outcomes[results->count];
    for (int truth = 0; truth < 2; truth++)
        for (int i = 0; i < VIEWERS * sun_count; i++) {
            const int sun = i % sun_count;
            const sight seen = {index, i / sun_count, sun / APARTS, sun % APARTS, sky};
            const relief_mean mean = mean_of_sight(f, scene, roughness, seen, truth);
            outcomes[i].seen = seen;
            if (truth) {
                outcomes[i].expected = mean.value;
                outcomes[i].noise = mean.noise;
            } else {
                outcomes[i].found = mean.value;
            }
        }
    results->count += VIEWERS * sun_count;
}

static relief_outcomes measure_relief(fixture *f, const shown_material *shown, const char *name,
                                      lobe_image heights) {
    relief_outcomes results = {.name = name};
    for (int r = 0; r < MAXIMUM_ROUGHNESSES && shown->roughness[r] > 0; r++)
        for (int sky = 0; sky < 2; sky++) {
            if (shown->shines && sky)
                continue;
            lobe_scene *scene = far_plane(shown, shown->roughness[r], heights, sky);
            if (shown->shines)
                scene->light_count = 0;
            hold_scene(f, scene);
            measure_scene(f, scene, shown->roughness[r], r, &results);
            hold_scene(f, NULL);
            lobe_scene_destroy(&scene);
        }
    return results;
}

// ---------------------------------------------------------------------------------------------
// Tables

/// What a row of a table is about; -1: all.
typedef struct row {
    int relief;
    sight seen;
    int sky; ///< 1: skies alone
} row;

static const row everything = {-1, {-1, -1, -1, -1, false}, 0};

static bool is_about(row shown, int relief, const outcome *result) {
    const sight *seen = &result->seen;
    return (shown.relief < 0 || shown.relief == relief) && (int)seen->sky == shown.sky &&
           (shown.seen.roughness < 0 || shown.seen.roughness == seen->roughness) &&
           (shown.seen.viewer < 0 || shown.seen.viewer == seen->viewer) &&
           (shown.seen.sun < 0 || shown.seen.sun == seen->sun) &&
           (shown.seen.apart < 0 || shown.seen.apart == seen->apart);
}

/// The sum of errors over the sum of what is expected, averaged over reliefs; the geometric mean of
/// the ratio and its mean absolute logarithm, without what is too noisy to tell.
static void print_row(const char *what, const char *value, row shown,
                      const relief_outcomes *reliefs, int relief_count) {
    double errors = 0, logarithms = 0, ratio = 0;
    int used = 0, told = 0;
    for (int k = 0; k < relief_count; k++) {
        double error = 0, total = 0;
        for (int i = 0; i < reliefs[k].count; i++) {
            const outcome *result = &reliefs[k].outcomes[i];
            if (!is_about(shown, k, result))
                continue;
            error += fabs(result->found - result->expected);
            total += result->expected;
            if (!(result->noise < 0.15 * result->expected) || !(result->found > 0))
                continue;
            told++;
            logarithms += fabs(log(result->found / result->expected));
            ratio += log(result->found / result->expected);
        }
        if (total > 0) {
            used++;
            errors += error / total;
        }
    }
    if (told > 0)
        printf("| %s %s | %.3f | %.3f | %.2f |\n", what, value, errors / used, logarithms / told,
               exp(ratio / told));
}

static const char *degrees(double angle) {
    static char text[16];
    snprintf(text, sizeof text, "%g°", angle);
    return text;
}

static void print_table(const shown_material *shown, const relief_outcomes *reliefs,
                        int relief_count) {
    row of = everything;
    print_row("all", "suns", of, reliefs, relief_count);
    for (int r = 0; r < MAXIMUM_ROUGHNESSES && shown->roughness[r] > 0; r++) {
        char text[16];
        snprintf(text, sizeof text, "%g", shown->roughness[r]);
        of.seen.roughness = r;
        print_row("roughness", text, of, reliefs, relief_count);
    }
    of = everything;
    for (int v = 0; v < VIEWERS; v++) {
        of.seen.viewer = v;
        print_row("viewer", degrees(viewers[v]), of, reliefs, relief_count);
    }
    of = everything;
    for (int a = 0; a < APARTS; a++) {
        of.seen.apart = a;
        print_row("apart", degrees(aparts[a]), of, reliefs, relief_count);
    }
    for (int s = 0; s < SUNS; s++) {
        of = everything;
        of.seen.sun = s;
        print_row("sun", degrees(suns[s]), of, reliefs, relief_count);
        for (int a = 0; a < APARTS; a++) {
            of.seen.apart = a;
            print_row("- apart", degrees(aparts[a]), of, reliefs, relief_count);
        }
    }
    of = everything;
    of.sky = 1;
    print_row("all", shown->shines ? "viewers" : "skies", of, reliefs, relief_count);
    for (int v = 0; v < VIEWERS; v++) {
        of.seen.viewer = v;
        print_row("- viewer", degrees(viewers[v]), of, reliefs, relief_count);
    }
}

/// Of the relief that was measured last.
static void print_relief(const relief_outcomes *reliefs, int relief_count) {
    const char *name = reliefs[relief_count - 1].name;
    row of = everything;
    of.relief = relief_count - 1;
    print_row(name, "suns", of, reliefs, relief_count);
    of.sky = 1;
    print_row(name, "otherwise", of, reliefs, relief_count);
    fflush(stdout);
}

// ---------------------------------------------------------------------------------------------
// Light and viewer change places

static double reflectance(fixture *f, lobe_scene *scene, relief_side viewer, relief_side sun) {
    relief_sides_look(scene, viewer);
    relief_sides_shine(scene, sun);
    return relief_sides_draw(f, scene, "displaced", 1).value / sin(sun.height * M_PI / 180);
}

/// A row for each relief; for each roughness, the mean factor that both differ by, and the most.
static void print_swapped(fixture *f, const shown_material *shown, const char *name,
                          lobe_image heights) {
    static const double sides[] = {15, 30, 45, 60, 75};
    printf("| %s |", name);
    for (int r = 0; r < MAXIMUM_ROUGHNESSES && shown->roughness[r] > 0; r++) {
        lobe_scene *scene = far_plane(shown, shown->roughness[r], heights, false);
        hold_scene(f, scene);
        double sum = 0, most = 0;
        int count = 0;
        for (int i = 0; i < 25 * APARTS; i++) {
            const int first = i / APARTS / 5, second = i / APARTS % 5;
            if (second > first || (second == first && aparts[i % APARTS] == 0))
                continue;
            const relief_side one = {sides[first], 17},
                              other = {sides[second], 17 + aparts[i % APARTS]};
            const double difference =
                fabs(log(reflectance(f, scene, one, other) / reflectance(f, scene, other, one)));
            sum += difference;
            most = fmax(most, difference);
            count++;
        }
        printf(" %.2f, %.2f |", exp(sum / count), exp(most));
        hold_scene(f, NULL);
        lobe_scene_destroy(&scene);
    }
    printf("\n");
    fflush(stdout);
}

// ---------------------------------------------------------------------------------------------

typedef struct named_relief {
    const char *name;
    lobe_image heights;
} named_relief;

static int make_reliefs(fixture *f, uint64_t seed, char **files, int file_count,
                        named_relief reliefs[MAXIMUM_RELIEFS]) {
    int count = 0;
    for (const unseen_relief *relief = unseen_reliefs; relief->name; relief++) {
        reliefs[count] = (named_relief){relief->name, relief->make(100 * seed + (unsigned)count)};
        count++;
    }
    for (int i = 0; i < file_count && count < MAXIMUM_RELIEFS; i++) {
        lobe_image heights = sample_relief_load(files[i], &f->host);
        sample_relief_scale(&heights, 0.7);
        reliefs[count++] = (named_relief){files[i], heights};
    }
    return count;
}

int main(int count, char **arguments) {
    const bool swapped = count > 1 && strcmp(arguments[1], "swapped") == 0;
    const shown_material *shown =
        count > 2 ? material_named(swapped ? "metal" : arguments[1]) : NULL;
    if (!shown) {
        fprintf(stderr, "usage: relief_errors MATERIAL|swapped SEED [FILE...]\n");
        return 2;
    }
    void *state = NULL;
    fixture_create(&state);
    named_relief reliefs[MAXIMUM_RELIEFS];
    const int relief_count =
        make_reliefs(state, strtoull(arguments[2], NULL, 10), arguments + 3, count - 3, reliefs);
    if (swapped)
        printf("| | roughness %g: mean, most | %g |\n|---|---:|---:|\n", shown->roughness[0],
               shown->roughness[1]);
    else
        printf("| %s | errors | logarithm | ratio |\n|---|---:|---:|---:|\n", shown->name);
    static relief_outcomes results[MAXIMUM_RELIEFS];
    for (int k = 0; k < relief_count; k++) {
        if (swapped)
            print_swapped(state, shown, reliefs[k].name, reliefs[k].heights);
        else {
            results[k] = measure_relief(state, shown, reliefs[k].name, reliefs[k].heights);
            print_relief(results, k + 1);
        }
        lobe_image_free(&reliefs[k].heights);
    }
    if (!swapped)
        print_table(shown, results, relief_count);
    fixture_destroy(&state);
    return 0;
}
