#include "tools/environment/check.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "passes/environment/standalone_maps.h"
#include "tools/bench/timing.h"
#include "tools/environment/check_passes.h"

#define MOST_ROUNDS 16
/// Updates whose median is taken; each is slow.
#define UPDATES 3
/// Samples of the method `sampled`.
#define SAMPLES 32
/// Terms of the exact sum per submission: few enough that other work on the device does not wait
/// long.
#define TERMS_A_SUBMISSION (1u << 24)
/// Maximum number of texels per submission: lavapipe silently ends loops after 65535 iterations.
#define MOST_TEXELS (1u << 15)

typedef struct measurement {
    const environment_check_job *job;
    environment_findings *findings;
    lobe_environment_maps *maps;
    float (*directions)[4];
    double *exact;    ///< RGB of each direction, of the first lobe, then of the second, ...
    uint32_t repeats; ///< see environment_check_request.rounds
} measurement;

const char *environment_method_name(environment_method method) {
    static const char *const names[ENVIRONMENT_METHOD_COUNT] = {"prefiltered", "blended", "mip",
                                                                "sampled", "sampled_equal_time"};
    return names[method];
}

// ---------------------------------------------------------------------------------------------
// One frame of the graph that holds the maps

static environment_check_request begin(const measurement *m, lobe_graph **graph,
                                       environment_maps *cubes) {
    *graph = passes_standalone_maps_begin(m->maps, cubes);
    uint32_t count = m->job->directions;
    return (environment_check_request){
        .directions =
            lobe_graph_upload(*graph, "directions", m->directions, count * sizeof *m->directions),
        .count = count,
        .rounds = 1,
    };
}

static double time_of(const lobe_graph *graph, const char *name) {
    const lobe_graph_report *report = lobe_graph_describe(graph);
    for (size_t i = 0; i < report->pass_count; i++) {
        if (strcmp(report->passes[i].name, name) == 0)
            return report->passes[i].milliseconds;
    }
    return 0;
}

// ---------------------------------------------------------------------------------------------
// The exact light

static lobe_result add_texels(measurement *m, uint32_t first, uint32_t count) {
    lobe_graph *graph;
    environment_maps cubes;
    environment_check_request request = begin(m, &graph, &cubes);
    lobe_resource sums =
        environment_check_exact(graph, &cubes, &request, m->findings->concentrations, first, count);
    lobe_graph_read_back(graph, sums, (lobe_range){0});
    lobe_result result = lobe_graph_execute(graph);
    if (result != LOBE_OK)
        return result;
    const float *data = lobe_graph_data(graph, sums, NULL);
    for (size_t i = 0; i < (size_t)CHECK_LOBES * m->job->directions; i++) {
        double peak = environment_check_peak(m->findings->concentrations[i / m->job->directions]);
        for (int channel = 0; channel < 3; channel++)
            m->exact[3 * i + channel] += peak * (double)data[4 * i + channel];
    }
    return LOBE_OK;
}

/// Sums few texels in float32, and those sums in double.
static lobe_result find_exact_light(measurement *m) {
    uint32_t total = 6 * m->findings->face * m->findings->face;
    uint32_t step = TERMS_A_SUBMISSION / m->job->directions / CHECK_GROUP_SIZE * CHECK_GROUP_SIZE;
    step = step > MOST_TEXELS ? MOST_TEXELS : step > 0 ? step : CHECK_GROUP_SIZE;
    progress_step(m->job->progress, "%s, faces of %u: exact light", m->job->environment->name,
                  m->findings->face);
    lobe_result result = LOBE_OK;
    for (uint32_t first = 0; result == LOBE_OK && first < total; first += step) {
        uint32_t left = total - first;
        result = add_texels(m, first, left < step ? left : step);
        progress_part(m->job->progress, (double)(first + step) / total);
    }
    return result;
}

// ---------------------------------------------------------------------------------------------
// Methods

static double relative_l2(const measurement *m, uint32_t lobe, const float *lights) {
    const double *exact = m->exact + (size_t)3 * lobe * m->job->directions;
    double difference = 0, total = 0;
    for (size_t i = 0; i < m->job->directions; i++) {
        for (int channel = 0; channel < 3; channel++) {
            double expected = exact[3 * i + channel];
            double error = (double)lights[4 * i + channel] - expected;
            difference += error * error;
            total += expected * expected;
        }
    }
    return total > 0 ? sqrt(difference / total) : 0;
}

/// Looks up the light of a lobe once; `milliseconds` receives the time.
static lobe_result look_up(measurement *m, uint32_t lobe, environment_method method,
                           uint32_t samples, environment_error *error, double *milliseconds) {
    static const uint32_t methods[ENVIRONMENT_METHOD_COUNT] = {
        METHOD_PREFILTERED, METHOD_BLENDED, METHOD_MIP, METHOD_SAMPLED, METHOD_SAMPLED};
    lobe_graph *graph;
    environment_maps cubes;
    environment_check_request request = begin(m, &graph, &cubes);
    request.method = methods[method];
    request.concentration = m->findings->concentrations[lobe];
    request.samples = samples;
    request.rounds = m->repeats;
    lobe_resource lights = environment_check_look_up(graph, &cubes, &request);
    lobe_graph_read_back(graph, lights, (lobe_range){0});
    lobe_result result = lobe_graph_execute(graph);
    if (result != LOBE_OK)
        return result;
    *milliseconds = time_of(graph, "environment_check") / m->repeats;
    error->relative_l2 = relative_l2(m, lobe, lobe_graph_data(graph, lights, NULL));
    error->samples = methods[method] == METHOD_SAMPLED ? samples : 0;
    return LOBE_OK;
}

/// Measures the methods of a lobe alternately, so that temporary slowdowns affect them all.
static lobe_result measure(measurement *m, uint32_t lobe, const environment_method *methods,
                           const uint32_t *samples, uint32_t count, environment_error *errors) {
    double times[ENVIRONMENT_METHOD_COUNT][MOST_ROUNDS];
    lobe_result result = LOBE_OK;
    for (uint32_t round = 0; result == LOBE_OK && round < m->job->rounds; round++) {
        for (uint32_t i = 0; result == LOBE_OK && i < count; i++)
            result = look_up(m, lobe, methods[i], samples[i], &errors[i], &times[i][round]);
    }
    for (uint32_t i = 0; result == LOBE_OK && i < count; i++)
        errors[i].milliseconds = timing_median(times[i], m->job->rounds);
    return result;
}

/// Chooses the number of samples that takes as long as `prefiltered`, assuming that the time is
/// linear in the samples; fewer if that turns out to take longer.
static lobe_result measure_equal_time(measurement *m, uint32_t lobe) {
    const environment_method methods[2] = {ENVIRONMENT_PREFILTERED, ENVIRONMENT_SAMPLED_EQUAL_TIME};
    environment_error *errors = m->findings->errors[lobe], pair[2];
    double of_one = errors[ENVIRONMENT_SAMPLED].milliseconds / SAMPLES;
    double guess = of_one > 0 ? errors[ENVIRONMENT_PREFILTERED].milliseconds / of_one : 1;
    uint32_t samples = guess < 1 ? 1 : guess > SAMPLES ? SAMPLES : (uint32_t)guess;
    lobe_result result = LOBE_OK;
    for (bool fits = false; result == LOBE_OK && !fits; --samples) {
        result = measure(m, lobe, methods, (uint32_t[2]){0, samples}, 2, pair);
        fits = samples == 1 || pair[1].milliseconds <= pair[0].milliseconds;
    }
    errors[ENVIRONMENT_SAMPLED_EQUAL_TIME] = pair[1];
    return result;
}

static lobe_result measure_methods(measurement *m) {
    // In the order of environment_method.
    const environment_method methods[4] = {ENVIRONMENT_PREFILTERED, ENVIRONMENT_BLENDED,
                                           ENVIRONMENT_MIP, ENVIRONMENT_SAMPLED};
    progress_step(m->job->progress, "%s, faces of %u: methods", m->job->environment->name,
                  m->findings->face);
    lobe_result result = LOBE_OK;
    for (uint32_t lobe = 0; result == LOBE_OK && lobe < CHECK_LOBES; lobe++) {
        result = measure(m, lobe, methods, (uint32_t[4]){0, 0, 0, SAMPLES}, 4,
                         m->findings->errors[lobe]);
        if (result == LOBE_OK)
            result = measure_equal_time(m, lobe);
        progress_part(m->job->progress, (lobe + 1.0) / CHECK_LOBES);
    }
    return result;
}

// ---------------------------------------------------------------------------------------------
// Preparation

static double mip_time(const lobe_environment_maps_information *information) {
    for (size_t i = 0; i < information->pass_count; i++) {
        if (strcmp(information->passes[i].name, "environment_reduction") == 0)
            return information->passes[i].milliseconds;
    }
    return 0;
}

static lobe_result prepare(measurement *m, bool between) {
    progress_step(m->job->progress, "%s, faces of %u: preparing", m->job->environment->name,
                  m->findings->face);
    lobe_environment_maps_destroy(&m->maps);
    return lobe_environment_maps_create(
        m->job->device,
        &(lobe_environment_maps_parameters){
            .environment = m->job->environment,
            .size = m->findings->face,
            .wanted =
                {[LOBE_ENVIRONMENT_VON_MISES_FISHER] = true, [LOBE_ENVIRONMENT_BETWEEN] = between},
            .parts_per_submission = 1,
            .progress = progress_part,
            .user = m->job->progress,
            .host = m->job->host,
        },
        &m->maps);
}

static lobe_result time_preparation(measurement *m) {
    lobe_result result = prepare(m, false);
    if (result != LOBE_OK)
        return result;
    const lobe_environment_maps_information *information = lobe_environment_maps_describe(m->maps);
    m->findings->first_milliseconds = information->milliseconds;
    m->findings->submissions = information->submissions;
    return LOBE_OK;
}

/// The plain MIP chain is timed in the same updates.
static lobe_result time_updates(measurement *m) {
    double updates[UPDATES], chains[UPDATES];
    progress_step(m->job->progress, "%s, faces of %u: updates", m->job->environment->name,
                  m->findings->face);
    lobe_result result = LOBE_OK;
    for (uint32_t round = 0; result == LOBE_OK && round < UPDATES; round++) {
        result = lobe_environment_maps_update(m->maps, NULL);
        const lobe_environment_maps_information *information =
            lobe_environment_maps_describe(m->maps);
        updates[round] = information->milliseconds;
        chains[round] = mip_time(information);
        progress_part(m->job->progress, (round + 1.0) / UPDATES);
    }
    if (result != LOBE_OK)
        return result;
    m->findings->update_milliseconds = timing_median(updates, UPDATES);
    m->findings->mip_milliseconds = timing_median(chains, UPDATES);
    return LOBE_OK;
}

// ---------------------------------------------------------------------------------------------

/// A GPU finishes a few thousand directions in too few ticks of its timestamp clock.
static uint32_t choose_repeats(const lobe_device *device) {
    return lobe_device_describe(device)->type == LOBE_DEVICE_CPU ? 1 : 64;
}

static lobe_result allocate(measurement *m) {
    uint32_t count = m->job->directions;
    m->directions = calloc(count, sizeof *m->directions);
    m->exact = calloc((size_t)3 * CHECK_LOBES * count, sizeof *m->exact);
    if (!m->directions || !m->exact)
        return lobe_host_fail(m->job->host, LOBE_ERROR_OUT_OF_MEMORY, "environment: out of memory");
    environment_check_directions(count, m->directions);
    return LOBE_OK;
}

lobe_result environment_check_run(const environment_check_job *job, uint32_t face,
                                  environment_findings *findings) {
    measurement m = {.job = job, .findings = findings, .repeats = choose_repeats(job->device)};
    *findings = (environment_findings){.face = face};
    for (int lobe = 0; lobe < CHECK_LOBES; lobe++)
        findings->concentrations[lobe] = job->kappa * pow(4, lobe);
    lobe_result result = allocate(&m);
    if (result == LOBE_OK)
        result = time_preparation(&m);
    if (result == LOBE_OK)
        result = time_updates(&m);
    if (result == LOBE_OK)
        result = prepare(&m, true);
    if (result == LOBE_OK)
        result = find_exact_light(&m);
    if (result == LOBE_OK)
        result = measure_methods(&m);
    lobe_environment_maps_destroy(&m.maps);
    free(m.directions);
    free(m.exact);
    return result;
}
