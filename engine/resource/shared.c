#include "engine/resource/shared.h"

#include <pthread.h>

#include "engine/device/device.h"

enum { BUCKETS = 256 };

struct engine_shared_table {
    pthread_mutex_t mutex; ///< protects the lists and the references of all objects
    engine_shared *buckets[BUCKETS];
};

lobe_result engine_shared_table_create(lobe_device *device, engine_shared_table **table) {
    *table = lobe_allocate(device->host.allocator, 1, sizeof **table);
    if (!*table)
        return lobe_host_fail(&device->host, LOBE_ERROR_OUT_OF_MEMORY,
                              "shared content: out of memory");
    pthread_mutex_init(&(*table)->mutex, NULL);
    return LOBE_OK;
}

void engine_shared_table_destroy(engine_shared_table **table) {
    if (!*table)
        return;
    pthread_mutex_destroy(&(*table)->mutex);
    lobe_release(*table);
    *table = NULL;
}

engine_shared *engine_shared_create(lobe_device *device, uint64_t creator) {
    engine_shared *shared = lobe_allocate(device->host.allocator, 1, sizeof *shared);
    if (shared)
        *shared = (engine_shared){.creator = creator, .references = 1};
    return shared;
}

static engine_shared **bucket_of(engine_shared_table *table, engine_stamp stamp) {
    return &table->buckets[stamp % BUCKETS];
}

static void list(engine_shared_table *table, engine_shared *shared) {
    engine_shared **bucket = bucket_of(table, shared->stamp);
    shared->next = *bucket;
    *bucket = shared;
    shared->listed = true;
}

static void unlist(engine_shared_table *table, engine_shared *shared) {
    engine_shared **link = bucket_of(table, shared->stamp);
    while (shared->listed && *link != shared)
        link = &(*link)->next;
    if (shared->listed)
        *link = shared->next;
    shared->listed = false;
    shared->stamp = ENGINE_STAMP_NONE;
}

static engine_shared *find(engine_shared_table *table, engine_stamp stamp, uint64_t asker) {
    engine_shared *found = *bucket_of(table, stamp);
    while (found && (found->stamp != stamp || (asker && found->creator == asker)))
        found = found->next;
    return found;
}

bool engine_shared_publish(lobe_device *device, engine_shared *shared) {
    if (!shared)
        return false;
    pthread_mutex_lock(&device->shared->mutex);
    if (!shared->listed && shared->stamp != ENGINE_STAMP_NONE &&
        !find(device->shared, shared->stamp, shared->creator))
        list(device->shared, shared);
    const bool listed = shared->listed;
    pthread_mutex_unlock(&device->shared->mutex);
    return listed;
}

engine_shared *engine_shared_find(lobe_device *device, engine_stamp stamp, uint64_t asker) {
    pthread_mutex_lock(&device->shared->mutex);
    engine_shared *found = find(device->shared, stamp, asker);
    if (found)
        found->references++;
    pthread_mutex_unlock(&device->shared->mutex);
    return found;
}

bool engine_shared_claim(lobe_device *device, engine_shared *shared) {
    if (!shared)
        return true;
    pthread_mutex_lock(&device->shared->mutex);
    const bool alone = shared->references == 1;
    if (alone)
        unlist(device->shared, shared);
    pthread_mutex_unlock(&device->shared->mutex);
    return alone;
}

bool engine_shared_release(lobe_device *device, engine_shared *shared) {
    pthread_mutex_lock(&device->shared->mutex);
    const bool last = --shared->references == 0;
    if (last)
        unlist(device->shared, shared);
    pthread_mutex_unlock(&device->shared->mutex);
    if (last)
        lobe_release(shared);
    return last;
}

void engine_object_destroy(lobe_device *device, engine_object *object) {
    if (object->shared && !engine_shared_release(device, object->shared))
        return;
    for (int i = 0; i < 2; i++)
        device->api.vkDestroyImageView(device->vulkan, object->views[i], device->callbacks);
    device->api.vkDestroyImage(device->vulkan, object->image, device->callbacks);
    device->api.vkDestroyBuffer(device->vulkan, object->buffer, device->callbacks);
    engine_memory_free(device->memory, &object->allocation);
}
