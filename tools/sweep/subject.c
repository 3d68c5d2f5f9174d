#include "tools/sweep/sweep.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "tools/cli/scene_options.h"

static bool is_none(const char *environment) {
    return strcmp(environment, "none") == 0;
}

bool sweep_subject_has_environment(const sweep_subject *subject) {
    return subject->environment && !is_none(subject->environment);
}

/// "tablecloth in courtyard": the file name without folder and extension.
static char *name_subject(const sweep_subject *subject) {
    if (!sweep_subject_has_environment(subject))
        return strdup(subject->scene);
    const char *slash = strrchr(subject->environment, '/');
    const char *file = slash ? slash + 1 : subject->environment;
    const char *dot = strrchr(file, '.');
    const size_t length = dot && dot > file ? (size_t)(dot - file) : strlen(file);
    char *name;
    return asprintf(&name, "%s in %.*s", subject->scene, (int)length, file) < 0 ? NULL : name;
}

static bool same(const char *a, const char *b) {
    return a && b ? strcmp(a, b) == 0 : a == b;
}

/// A name must mean one scene in one environment.
static lobe_result check_name(const sweep_subject *subjects, size_t index, const lobe_host *host) {
    const sweep_subject *added = &subjects[index];
    for (size_t i = 0; i < index; i++) {
        const sweep_subject *other = &subjects[i];
        if (strcmp(other->name, added->name) == 0 && !same(other->environment, added->environment))
            return lobe_host_fail(host, LOBE_ERROR_INVALID_ARGUMENT,
                                  "--environment: results of %s and %s would both be called '%s'",
                                  other->environment, added->environment, added->name);
    }
    return LOBE_OK;
}

lobe_result sweep_subjects_list(const option_list *scenes, const option_list *environments,
                                const lobe_host *host, sweep_subject **subjects, size_t *count) {
    const size_t each = environments->count > 0 ? environments->count : 1;
    *count = 0;
    *subjects = calloc(scenes->count * each + 1, sizeof **subjects);
    lobe_result result = LOBE_OK;
    for (size_t i = 0; *subjects && result == LOBE_OK && i < scenes->count * each; i++) {
        sweep_subject *added = &(*subjects)[(*count)++];
        added->scene = scenes->values[i / each];
        added->environment = environments->count > 0 ? environments->values[i % each] : NULL;
        added->name = name_subject(added);
        result = added->name ? check_name(*subjects, i, host) : LOBE_ERROR_OUT_OF_MEMORY;
    }
    if (!*subjects || result == LOBE_ERROR_OUT_OF_MEMORY)
        return lobe_host_fail(host, LOBE_ERROR_OUT_OF_MEMORY, "sweep: out of memory");
    return result;
}

void sweep_subjects_free(sweep_subject **subjects, size_t count) {
    for (size_t i = 0; i < count; i++)
        free((*subjects)[i].name);
    free(*subjects);
    *subjects = NULL;
}

lobe_result sweep_subject_check(const sweep_job *job, const sweep_subject *subject,
                                const sweep_scene *former) {
    // A scene's own environment is known when the scene is opened, and no other has its name.
    const char *environment = subject->environment ? subject->environment : former->environment;
    char lighting[SCENE_OPTIONS_DESCRIPTION];
    scene_options_describe(job->opening, lighting);
    if (environment && is_none(environment))
        environment = NULL;
    if (sweep_scene_is(former, subject->scene, environment, lighting))
        return LOBE_OK;
    return lobe_host_fail(
        job->bench.host, LOBE_ERROR_INVALID_ARGUMENT,
        "%s: '%s' was measured in environment %s (%s), now it is %s (%s): "
        "--resume cannot mix them",
        job->json, subject->name, former->environment ? former->environment : "none",
        former->lighting ? former->lighting : "light unchanged", environment ? environment : "none",
        lighting[0] ? lighting : "light unchanged");
}
