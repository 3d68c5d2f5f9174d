#ifndef ENGINE_PIPELINE_USE_H
#define ENGINE_PIPELINE_USE_H

#include <pthread.h>
#include <stdbool.h>
#include <stdint.h>

/// Tracks which pipelines frames may still need, without counting references: frames and pipelines
/// are stamped by one clock, and a pipeline last found before the oldest frame in progress began is
/// used by none of them.

/// A frame in progress, from before its first pipeline is found until the device has finished with
/// it. All zero: none.
typedef struct engine_pipeline_use {
    struct engine_pipeline_use *next;
    uint64_t since;
    bool active;
} engine_pipeline_use;

/// All frames in progress on a device, of any thread.
typedef struct engine_pipeline_uses {
    pthread_mutex_t mutex;
    engine_pipeline_use *first;
    _Atomic uint64_t clock;
} engine_pipeline_uses;

void engine_pipeline_uses_create(engine_pipeline_uses *uses);
void engine_pipeline_uses_destroy(engine_pipeline_uses *uses);

/// Starts a frame, or restarts one in progress. `use` must not move until it ends.
void engine_pipeline_use_begin(engine_pipeline_uses *uses, engine_pipeline_use *use);
/// Does nothing if it is not in progress.
void engine_pipeline_use_end(engine_pipeline_uses *uses, engine_pipeline_use *use);

/// Returns the start of the oldest frame in progress; UINT64_MAX if no frame is in progress.
uint64_t engine_pipeline_uses_oldest(engine_pipeline_uses *uses);

#endif
