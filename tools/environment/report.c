#include "tools/environment/check.h"

#include <stdio.h>
#include <stdlib.h>

#include <cjson/cJSON.h>
#include <lobe/lobe.h>

#include "tools/cli/number_text.h"
#include "tools/cli/output_file.h"

// ---------------------------------------------------------------------------------------------
// For people

static void print_errors(const environment_findings *findings) {
    printf("\nFaces of %u: relative L2 error against the exact light, and ms\n  %6s",
           findings->face, "kappa");
    for (int method = 0; method < ENVIRONMENT_METHOD_COUNT; method++)
        printf("  %26s", environment_method_name(method));
    printf("\n");
    for (int lobe = 0; lobe < CHECK_LOBES; lobe++) {
        printf("  %6.0f", findings->concentrations[lobe]);
        for (int method = 0; method < ENVIRONMENT_METHOD_COUNT; method++) {
            const environment_error *error = &findings->errors[lobe][method];
            char samples[16] = "";
            if (method == ENVIRONMENT_SAMPLED_EQUAL_TIME)
                snprintf(samples, sizeof samples, "(%u) ", error->samples);
            printf("  %7s%8.3f %% %8.3f", samples, 100 * error->relative_l2, error->milliseconds);
        }
        printf("\n");
    }
}

static void print_time(const char *what, double milliseconds, double chain) {
    printf("  %-24s %10.2f ms", what, milliseconds);
    if (chain > 0)
        printf("  %8s plain MIP chains", number_text_of(milliseconds / chain, 3).text);
    printf("\n");
}

void environment_check_print(const environment_findings *findings) {
    double chain = findings->mip_milliseconds;
    print_errors(findings);
    print_time("plain MIP chain", chain, chain);
    print_time("first preparation", findings->first_milliseconds, chain);
    print_time("update", findings->update_milliseconds, chain);
}

// ---------------------------------------------------------------------------------------------
// For programs

/// Six digits exceed the precision of any measurement here.
static void add_number(cJSON *object, const char *name, double value) {
    char digits[32];
    snprintf(digits, sizeof digits, "%.6g", value);
    cJSON_AddNumberToObject(object, name, strtod(digits, NULL));
}

static void add_results(cJSON *array, const environment_findings *findings) {
    for (int i = 0; i < CHECK_LOBES * ENVIRONMENT_METHOD_COUNT; i++) {
        int lobe = i / ENVIRONMENT_METHOD_COUNT, method = i % ENVIRONMENT_METHOD_COUNT;
        const environment_error *error = &findings->errors[lobe][method];
        cJSON *result = cJSON_CreateObject();
        cJSON_AddNumberToObject(result, "face", findings->face);
        cJSON_AddNumberToObject(result, "kappa", findings->concentrations[lobe]);
        cJSON_AddStringToObject(result, "method", environment_method_name(method));
        if (error->samples > 0)
            cJSON_AddNumberToObject(result, "samples", error->samples);
        add_number(result, "relative_l2", error->relative_l2);
        add_number(result, "ms", error->milliseconds);
        cJSON_AddItemToArray(array, result);
    }
}

static void add_preparation(cJSON *array, const environment_findings *findings) {
    cJSON *times = cJSON_CreateObject();
    cJSON_AddNumberToObject(times, "face", findings->face);
    cJSON_AddNumberToObject(times, "submissions", findings->submissions);
    add_number(times, "mip_chain_ms", findings->mip_milliseconds);
    add_number(times, "first_ms", findings->first_milliseconds);
    add_number(times, "update_ms", findings->update_milliseconds);
    if (findings->mip_milliseconds > 0) {
        add_number(times, "first_in_mip_chains",
                   findings->first_milliseconds / findings->mip_milliseconds);
        add_number(times, "update_in_mip_chains",
                   findings->update_milliseconds / findings->mip_milliseconds);
    }
    cJSON_AddItemToArray(array, times);
}

static char *describe(const environment_check_job *job, const environment_findings *findings,
                      size_t count) {
    const lobe_device_information *information = lobe_device_describe(job->device);
    const lobe_image *image = &job->environment->image;
    cJSON *root = cJSON_CreateObject();
    cJSON_AddStringToObject(root, "lobe", lobe_version());
    cJSON *device = cJSON_AddObjectToObject(root, "device");
    cJSON_AddStringToObject(device, "name", information->name);
    cJSON_AddStringToObject(device, "driver", information->driver);
    cJSON_AddStringToObject(device, "type", lobe_device_type_name(information->type));
    cJSON_AddStringToObject(root, "environment", job->environment->name);
    cJSON_AddNumberToObject(root, "directions", job->directions);
    cJSON *results = cJSON_AddArrayToObject(root, "results");
    cJSON *prepare = cJSON_AddObjectToObject(root, "prepare");
    int size[2] = {(int)image->width, (int)image->height};
    cJSON_AddItemToObject(prepare, "image", cJSON_CreateIntArray(size, 2));
    cJSON *faces = cJSON_AddArrayToObject(prepare, "faces");
    for (size_t i = 0; i < count; i++) {
        add_results(results, &findings[i]);
        add_preparation(faces, &findings[i]);
    }
    char *text = cJSON_Print(root);
    cJSON_Delete(root);
    return text;
}

lobe_result environment_check_write(const char *path, const environment_check_job *job,
                                    const environment_findings *findings, size_t count) {
    char *text = describe(job, findings, count);
    if (!text)
        return lobe_host_fail(job->host, LOBE_ERROR_OUT_OF_MEMORY, "%s: out of memory", path);
    lobe_result result = output_file_write(path, text, job->host);
    free(text);
    return result;
}
