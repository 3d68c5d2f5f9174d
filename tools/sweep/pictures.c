#include "tools/sweep/sweep.h"

#include <ctype.h>
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "tools/bench/timing.h"
#include "tools/cli/output_file.h"
#include "tools/render/capture.h"

// ---------------------------------------------------------------------------------------------
// The folder

static lobe_result out_of_memory(const sweep_job *job) {
    return lobe_host_fail(job->bench.host, LOBE_ERROR_OUT_OF_MEMORY, "sweep: out of memory");
}

static char *default_folder(const char *json) {
    char *folder = NULL;
    size_t length = strlen(json);
    if (output_file_has_ending(json, ".json"))
        length -= strlen(".json");
    return asprintf(&folder, "%.*s.pictures", (int)length, json) < 0 ? NULL : folder;
}

/// The folder that contains a file, as an absolute path without links.
static char *real_folder_of(const char *file) {
    const char *slash = strrchr(file, '/');
    char *folder = slash ? strndup(file, (size_t)(slash - file) + 1) : strdup(".");
    char *real = folder ? realpath(folder, NULL) : NULL;
    free(folder);
    return real;
}

/// The path of `to` relative to `from`, with a slash at its end; both absolute and without links.
static char *relative_path(const char *from, const char *to) {
    size_t common = 0, ups = 0;
    for (size_t i = 0; from[i] == to[i] || !from[i] || !to[i]; i++) {
        bool from_ends = !from[i] || from[i] == '/', to_ends = !to[i] || to[i] == '/';
        common = from_ends && to_ends ? i : common;
        if (!from[i] || !to[i])
            break;
    }
    for (size_t i = common; from[i]; i++)
        ups += from[i] == '/' && from[i + 1];
    const char *rest = to[common] == '/' ? &to[common + 1] : &to[common];
    char *path = calloc(3 * ups + strlen(rest) + 2, 1);
    for (size_t i = 0; path && i < ups; i++)
        strcat(path, "../");
    return path && rest[0] ? strcat(strcat(path, rest), "/") : path;
}

static lobe_result find_prefix(sweep_job *job) {
    char *from = real_folder_of(job->json), *to = realpath(job->picture_folder, NULL);
    if (from && to)
        job->picture_prefix = relative_path(from, to);
    free(from);
    free(to);
    return job->picture_prefix ? LOBE_OK : out_of_memory(job);
}

lobe_result sweep_pictures_open(sweep_job *job) {
    job->picture_folder = job->pictures ? strdup(job->pictures) : default_folder(job->json);
    if (!job->picture_folder)
        return out_of_memory(job);
    struct stat status;
    mkdir(job->picture_folder, 0777); // an existing folder makes it fail, which is fine
    int error = errno;
    if (stat(job->picture_folder, &status) != 0 || !S_ISDIR(status.st_mode))
        return lobe_host_fail(job->bench.host, LOBE_ERROR_WRITE,
                              "%s: cannot create the folder for pictures: %s", job->picture_folder,
                              strerror(error));
    return find_prefix(job);
}

void sweep_pictures_close(sweep_job *job) {
    free(job->picture_folder);
    free(job->picture_prefix);
    job->picture_folder = job->picture_prefix = NULL;
}

// ---------------------------------------------------------------------------------------------
// A picture

/// FNV-1a (Fowler, Noll, Vo 1991), 32 bits.
static uint32_t digest(const char *text) {
    uint32_t hash = 2166136261u;
    for (; *text; text++)
        hash = (hash ^ (unsigned char)*text) * 16777619u;
    return hash;
}

/// A scene's name as part of a file name: for a path its last part without extension, and a hash,
/// because files in different folders may have the same name.
static void name_scene(const char *scene, char name[96]) {
    const char *slash = strrchr(scene, '/');
    const char *last = slash ? slash + 1 : scene;
    size_t length = 0;
    for (; last[length] && last[length] != '.' && length < 64; length++)
        name[length] =
            isalnum((unsigned char)last[length]) || last[length] == '_' ? last[length] : '-';
    name[length] = '\0';
    if (strcmp(name, scene) != 0)
        snprintf(name + length, 96 - length, "-%08x", digest(scene));
}

static lobe_result write_picture(const sweep_job *job, const char *path, capture *capture) {
    const lobe_host *host = job->bench.host;
    lobe_profile *profile = NULL;
    lobe_profile_summary times = {0};
    lobe_result result = lobe_profile_create(host, &profile);
    if (result == LOBE_OK)
        result = timing_add(profile, capture->frame, host);
    if (result == LOBE_OK)
        result = lobe_profile_statistics(profile, &times);
    capture->times = &times;
    if (result == LOBE_OK)
        result = capture_write_exr(path, capture, host);
    lobe_profile_destroy(&profile);
    return result;
}

lobe_result sweep_pictures_write(const sweep_job *job, const char *scene,
                                 const sweep_variant *variant, uint32_t samples, const char *name,
                                 const lobe_frame *frame, char **relative) {
    capture capture = {
        .frame = frame,
        .scene = scene,
        .filter = variant->filter.filter,
        .settings = &variant->filter.settings,
        .samples = samples,
        .device = lobe_device_describe(job->bench.device),
        .depth = LOBE_EXR_HALF,
    };
    char scene_name[96], *path = NULL;
    name_scene(scene, scene_name);
    const char *separator = name[0] ? "-" : "";
    if (asprintf(&path, "%s/%s%s%s.exr", job->picture_folder, scene_name, separator, name) < 0)
        path = NULL;
    if (!path ||
        asprintf(relative, "%s%s%s%s.exr", job->picture_prefix, scene_name, separator, name) < 0)
        *relative = NULL;
    lobe_result result =
        path && *relative ? write_picture(job, path, &capture) : out_of_memory(job);
    free(path);
    return result;
}
