#include <lobe/preparation.h>

#include <pthread.h>
#include <signal.h>
#include <string.h>

#include "passes/renderer/renderer.h"

struct lobe_preparation {
    lobe_preparation_parameters parameters;
    lobe_host host;
    lobe_renderer *renderer;        ///< of the thread, until that ends
    lobe_render_parameters *frames; ///< owned: those of `parameters`
    pthread_t thread;
    atomic_bool stopped; ///< by destruction
    atomic_bool done;    ///< `result` is set
    lobe_result result;
};

static lobe_result run(lobe_preparation *self) {
    const lobe_preparation_parameters *wanted = &self->parameters;
    lobe_renderer_set_content_giver(self->renderer, wanted->give_content, wanted->giver);
    lobe_result result = lobe_renderer_set_scene(self->renderer, wanted->scene);
    for (size_t i = 0; result == LOBE_OK && i < wanted->frame_count && !atomic_load(&self->stopped);
         i++)
        result = passes_renderer_prepare(self->renderer, &wanted->frames[i], &self->stopped);
    return result;
}

static void *run_thread(void *user) {
    lobe_preparation *self = user;
    self->result = run(self);
    if (self->parameters.done && !atomic_load(&self->stopped))
        self->parameters.done(self->parameters.user, self->result);
    atomic_store(&self->done, true);
    return NULL;
}

/// A thread that handles none of the process's signals: what the host does about them, it expects
/// in threads of its own.
static int start_thread(lobe_preparation *self) {
    sigset_t all, before;
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &before);
    const int error = pthread_create(&self->thread, NULL, run_thread, self);
    pthread_sigmask(SIG_SETMASK, &before, NULL);
    return error;
}

static void release(lobe_preparation **preparation) {
    lobe_renderer_destroy(&(*preparation)->renderer);
    lobe_release((*preparation)->frames);
    lobe_release(*preparation);
    *preparation = NULL;
}

static lobe_result begin(lobe_preparation **preparation, lobe_device *device) {
    lobe_preparation *self = *preparation;
    const lobe_preparation_parameters *wanted = &self->parameters;
    const lobe_allocator *allocator = lobe_device_allocator(device);
    self->frames = lobe_allocate(allocator, wanted->frame_count, sizeof *self->frames);
    if (!self->frames)
        return lobe_host_fail(&self->host, LOBE_ERROR_OUT_OF_MEMORY, "preparation: out of memory");
    memcpy(self->frames, wanted->frames, wanted->frame_count * sizeof *self->frames);
    self->parameters.frames = self->frames;
    const lobe_result result = lobe_renderer_create(device, &self->host, &self->renderer);
    if (result != LOBE_OK)
        return result;
    const int error = start_thread(self);
    return error ? lobe_host_fail(&self->host, LOBE_ERROR_LIMIT, "preparation: no thread: %s",
                                  strerror(error))
                 : LOBE_OK;
}

lobe_result lobe_preparation_begin(lobe_device *device,
                                   const lobe_preparation_parameters *parameters,
                                   const lobe_host *host, lobe_preparation **preparation) {
    if (preparation)
        *preparation = NULL;
    if (!device || !parameters || !preparation || !parameters->scene || !parameters->frames ||
        parameters->frame_count == 0)
        return lobe_host_fail(host, LOBE_ERROR_INVALID_ARGUMENT,
                              "lobe_preparation_begin: device, parameters and preparation must not "
                              "be NULL, nor the scene, nor the frames, of which there is at least "
                              "one");
    *preparation = lobe_allocate(lobe_device_allocator(device), 1, sizeof **preparation);
    if (!*preparation)
        return lobe_host_fail(host, LOBE_ERROR_OUT_OF_MEMORY, "preparation: out of memory");
    (*preparation)->parameters = *parameters;
    if (host)
        (*preparation)->host = *host;
    const lobe_result result = begin(preparation, device);
    if (result != LOBE_OK)
        release(preparation);
    return result;
}

bool lobe_preparation_is_done(const lobe_preparation *preparation, lobe_result *result) {
    if (!preparation || !atomic_load(&preparation->done))
        return false;
    if (result)
        *result = preparation->result;
    return true;
}

void lobe_preparation_destroy(lobe_preparation **preparation) {
    if (!preparation || !*preparation)
        return;
    atomic_store(&(*preparation)->stopped, true);
    pthread_join((*preparation)->thread, NULL);
    release(preparation);
}
