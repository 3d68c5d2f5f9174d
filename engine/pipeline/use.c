#include "engine/pipeline/use.h"

void engine_pipeline_uses_create(engine_pipeline_uses *uses) {
    *uses = (engine_pipeline_uses){0};
    pthread_mutex_init(&uses->mutex, NULL);
}

void engine_pipeline_uses_destroy(engine_pipeline_uses *uses) {
    pthread_mutex_destroy(&uses->mutex);
}

static void unlink_use(engine_pipeline_uses *uses, engine_pipeline_use *use) {
    if (!use->active)
        return;
    engine_pipeline_use **link = &uses->first;
    while (*link != use)
        link = &(*link)->next;
    *link = use->next;
    *use = (engine_pipeline_use){0};
}

void engine_pipeline_use_begin(engine_pipeline_uses *uses, engine_pipeline_use *use) {
    pthread_mutex_lock(&uses->mutex);
    unlink_use(uses, use);
    *use = (engine_pipeline_use){.next = uses->first, .since = ++uses->clock, .active = true};
    uses->first = use;
    pthread_mutex_unlock(&uses->mutex);
}

void engine_pipeline_use_end(engine_pipeline_uses *uses, engine_pipeline_use *use) {
    pthread_mutex_lock(&uses->mutex);
    unlink_use(uses, use);
    pthread_mutex_unlock(&uses->mutex);
}

void engine_pipeline_use_submitted(engine_pipeline_uses *uses, engine_pipeline_use *use,
                                   uint64_t submission) {
    pthread_mutex_lock(&uses->mutex);
    use->submission = submission;
    pthread_mutex_unlock(&uses->mutex);
}

static bool is_finished(const engine_pipeline_use *use, uint64_t finished) {
    return use->submission && use->submission <= finished;
}

uint64_t engine_pipeline_uses_oldest(engine_pipeline_uses *uses, uint64_t finished) {
    uint64_t oldest = UINT64_MAX;
    pthread_mutex_lock(&uses->mutex);
    for (const engine_pipeline_use *use = uses->first; use; use = use->next)
        if (!is_finished(use, finished) && use->since < oldest)
            oldest = use->since;
    pthread_mutex_unlock(&uses->mutex);
    return oldest;
}
