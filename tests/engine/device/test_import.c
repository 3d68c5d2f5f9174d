// A device created by the host: what lobe requires of it, using it, and leaving it alive.

#include "tests/engine/support/cmocka_all.h"

#include <malloc.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "tests/engine/support/host_device.h"

static host_device host;

static int open_host(void **state) {
    (void)state;
    host_device_open(&host);
    return 0;
}

static int open_unvalidated_host(void **state) {
    (void)state;
    host_device_open_unvalidated(&host);
    return 0;
}

static int close_host(void **state) {
    (void)state;
    host_device_close(&host);
    return 0;
}

/// Uploads, and so allocates, submits and waits.
static void use(lobe_device *device) {
    static const float data[64] = {1};
    lobe_buffer *buffer = NULL;
    assert_int_equal(
        lobe_buffer_create(device, &(lobe_buffer_parameters){.size = sizeof data, .data = data},
                           &buffer),
        LOBE_OK);
    lobe_buffer_destroy(&buffer);
}

static void the_hosts_device_outlives_ours(void **state) {
    (void)state;
    for (int i = 0; i < 2; i++) {
        lobe_device *device = host_device_import(&host);
        const lobe_device_information *information = lobe_device_describe(device);
        VkPhysicalDeviceProperties properties;
        vkGetPhysicalDeviceProperties(host.vulkan.physical_device, &properties);
        assert_string_equal(information->name, properties.deviceName);
        use(device);
        lobe_device_destroy(&device);
        assert_null(device);
    }
    assert_int_equal(host.recorder.errors, 0);
    // The host can still do everything that it could before.
    host_image image =
        host_image_create(&host, VK_FORMAT_R8G8B8A8_UNORM, 4, 4,
                          VK_IMAGE_USAGE_TRANSFER_SRC_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT);
    VkCommandBuffer commands = host_begin(&host);
    host_barrier(commands, &image, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL);
    host_clear(commands, &image, (float[]){1, 0, 1, 0});
    host_barrier(commands, &image, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
                 VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL);
    host_finish(&host, commands);
    uint8_t texels[4][4][4];
    host_read(&host, &image, texels, sizeof texels);
    assert_int_equal(texels[3][3][2], 255);
    host_image_destroy(&host, &image);
}

// ---------------------------------------------------------------------------------------------
// The queue

typedef struct lock_counter {
    _Atomic int locked, uses;
    _Atomic bool nested;
} lock_counter;

static void lock(void *user) {
    lock_counter *counter = user;
    if (counter->locked++ != 0)
        counter->nested = true;
    counter->uses++;
}

static void unlock(void *user) {
    ((lock_counter *)user)->locked--;
}

static void the_queue_is_used_under_the_hosts_lock(void **state) {
    (void)state;
    lock_counter counter = {0};
    host.vulkan.lock_queue = lock;
    host.vulkan.unlock_queue = unlock;
    host.vulkan.user = &counter;
    lobe_device *device = host_device_import(&host);
    use(device);
    assert_true(counter.uses > 0);
    assert_int_equal(counter.locked, 0);
    assert_false(counter.nested);
    // Exported again, the device locks in the same way.
    int uses = counter.uses;
    lobe_vulkan_device handles;
    lobe_vulkan_export_device(device, &handles);
    assert_ptr_equal(handles.device, host.vulkan.device);
    assert_ptr_equal(handles.queue, host.vulkan.queue);
    handles.lock_queue(handles.user);
    assert_int_equal(counter.locked, 1);
    handles.unlock_queue(handles.user);
    assert_int_equal(counter.locked, 0);
    assert_int_equal(counter.uses, uses + 1);
    lobe_device_destroy(&device);
}

/// What the queue does from now on waits until the timeline reaches 1.
static void stop_queue(VkSemaphore gate) {
    const VkSemaphoreSubmitInfo wait = {.sType = VK_STRUCTURE_TYPE_SEMAPHORE_SUBMIT_INFO,
                                        .semaphore = gate,
                                        .value = 1,
                                        .stageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT};
    const VkSubmitInfo2 submit = {.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO_2,
                                  .waitSemaphoreInfoCount = 1,
                                  .pWaitSemaphoreInfos = &wait};
    assert_int_equal(vkQueueSubmit2(host.vulkan.queue, 1, &submit, VK_NULL_HANDLE), VK_SUCCESS);
}

static void start_queue(VkSemaphore gate) {
    const VkSemaphoreSignalInfo signal = {
        .sType = VK_STRUCTURE_TYPE_SEMAPHORE_SIGNAL_INFO, .semaphore = gate, .value = 1};
    assert_int_equal(vkSignalSemaphore(host.vulkan.device, &signal), VK_SUCCESS);
}

/// Waits for up to ten seconds.
static bool reaches(const _Atomic int *value, int wanted) {
    for (int n = 0; *value < wanted && n < 10000; n++)
        nanosleep(&(struct timespec){.tv_nsec = 1000000}, NULL);
    return *value >= wanted;
}

static void *destroy_buffer(void *buffer) {
    lobe_buffer_destroy((lobe_buffer **)buffer);
    return NULL;
}

static void *update_buffer(void *buffer) {
    static const float data[64] = {2};
    return lobe_buffer_update(*(lobe_buffer **)buffer, data) == LOBE_OK ? buffer : NULL;
}

/// While one thread waits for the device, the queue is free for others, and uploads are recorded.
/// Without the validation layer, which gives up waiting for semaphores that the host signals.
static void threads_that_wait_block_no_others(void **state) {
    (void)state;
    enum { THREADS = 4 };
    void *(*const work[THREADS])(void *) = {destroy_buffer, update_buffer, update_buffer,
                                            destroy_buffer};
    lock_counter counter = {0};
    host.vulkan.lock_queue = lock;
    host.vulkan.unlock_queue = unlock;
    host.vulkan.user = &counter;
    lobe_device *device = host_device_import(&host);
    VkSemaphore gate = host_semaphore(&host, true);
    pthread_t threads[THREADS];
    lobe_buffer *buffers[THREADS] = {NULL};
    for (int n = 0; n < THREADS; n++)
        assert_int_equal(
            lobe_buffer_create(device, &(lobe_buffer_parameters){.size = 256}, &buffers[n]),
            LOBE_OK);
    stop_queue(gate);
    bool blocked = false;
    for (int n = 0; n < THREADS; n++) {
        const int wanted = counter.uses + 1;
        assert_int_equal(pthread_create(&threads[n], NULL, work[n], &buffers[n]), 0);
        blocked = blocked || !reaches(&counter.uses, wanted);
    }
    start_queue(gate);
    for (int n = 0; n < THREADS; n++) {
        void *done = NULL;
        assert_int_equal(pthread_join(threads[n], &done), 0);
        assert_true(done || work[n] == destroy_buffer);
        lobe_buffer_destroy(&buffers[n]);
    }
    assert_false(blocked);
    lobe_device_destroy(&device);
    assert_false(counter.nested);
    vkDestroySemaphore(host.vulkan.device, gate, NULL);
}

// ---------------------------------------------------------------------------------------------
// Memory of the host

typedef struct books {
    _Atomic int made, freed; ///< the driver has threads
} books;

static VKAPI_ATTR void *VKAPI_CALL allocate(void *user, size_t size, size_t alignment,
                                            VkSystemAllocationScope scope) {
    (void)scope;
    ((books *)user)->made++;
    size_t whole = (size + alignment - 1) / alignment * alignment;
    return aligned_alloc(alignment < sizeof(void *) ? sizeof(void *) : alignment,
                         whole < sizeof(void *) ? sizeof(void *) : whole);
}

static VKAPI_ATTR void VKAPI_CALL release(void *user, void *memory) {
    ((books *)user)->freed += memory != NULL;
    free(memory);
}

static VKAPI_ATTR void *VKAPI_CALL reallocate(void *user, void *memory, size_t size,
                                              size_t alignment, VkSystemAllocationScope scope) {
    void *moved = size ? allocate(user, size, alignment, scope) : NULL;
    if (moved && memory) {
        size_t kept = malloc_usable_size(memory);
        memcpy(moved, memory, kept < size ? kept : size);
    }
    if (moved || !size)
        release(user, memory);
    return moved;
}

static void the_driver_takes_the_hosts_memory(void **state) {
    (void)state;
    books books = {0};
    const VkAllocationCallbacks callbacks = {.pUserData = &books,
                                             .pfnAllocation = allocate,
                                             .pfnReallocation = reallocate,
                                             .pfnFree = release};
    host.vulkan.allocation_callbacks = &callbacks;
    lobe_device *device = host_device_import(&host);
    int before = books.made;
    use(device);
    assert_true(books.made > before);
    lobe_device_destroy(&device);
    assert_int_equal(books.made, books.freed);
}

// ---------------------------------------------------------------------------------------------
// Requirements

static void recommended_features_are_turned_on(void **state) {
    (void)state;
    lobe_device *device = host_device_import(&host);
    const lobe_device_information *information = lobe_device_describe(device);
    lobe_device *own = NULL;
    assert_int_equal(lobe_device_create(NULL, &own), LOBE_OK);
    const lobe_device_information *expected = lobe_device_describe(own);
    size_t count = 0;
    const lobe_device_feature *list = lobe_vulkan_feature_list(&count);
    assert_int_equal(information->feature_count, count);
    for (size_t i = 0; i < count; i++) {
        assert_string_equal(information->features[i].name, list[i].name);
        assert_int_equal(information->features[i].present, expected->features[i].present);
    }
    lobe_device_destroy(&own);
    lobe_device_destroy(&device);
}

static void missing_features_are_told_in_words(void **state) {
    (void)state;
    char text[256];
    assert_int_equal(lobe_vulkan_missing(&host.vulkan, NULL, text, sizeof text), 0);
    assert_string_equal(text, "");
    assert_int_equal(lobe_vulkan_missing(&host.vulkan, &host.features.core, text, sizeof text), 0);
    lobe_vulkan_features less;
    lobe_vulkan_features_fill(&host.vulkan, &less);
    less.vulkan_1_3.synchronization2 = VK_FALSE;
    less.vulkan_1_2.timelineSemaphore = VK_FALSE;
    less.core.features.samplerAnisotropy = VK_FALSE; // not required
    assert_int_equal(lobe_vulkan_missing(&host.vulkan, &less.core, text, sizeof text), 2);
    assert_string_equal(text, "feature synchronization2 (barriers of the render graph)\n"
                              "feature timelineSemaphore (detecting when a frame is done)");
    // Truncated, and without any space.
    assert_int_equal(lobe_vulkan_missing(&host.vulkan, &less.core, text, 20), 2);
    assert_string_equal(text, "feature synchroniza");
    assert_int_equal(lobe_vulkan_missing(&host.vulkan, &less.core, NULL, 0), 2);
    assert_int_equal(
        lobe_vulkan_missing(&host.vulkan, &(VkPhysicalDeviceFeatures2){0}, text, sizeof text), 7);
}

/// Hosts may enable each feature with its own structure.
static void single_structures_count(void **state) {
    (void)state;
    VkPhysicalDeviceDynamicRenderingFeatures rendering = {
        .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DYNAMIC_RENDERING_FEATURES,
        .dynamicRendering = VK_TRUE};
    VkPhysicalDeviceMaintenance4Features maintenance = {
        .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MAINTENANCE_4_FEATURES,
        .pNext = &rendering,
        .maintenance4 = VK_TRUE};
    VkPhysicalDeviceTransformFeedbackFeaturesEXT other = {
        .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_TRANSFORM_FEEDBACK_FEATURES_EXT,
        .pNext = &maintenance};
    VkPhysicalDeviceFeatures2 features = {.pNext = &other};
    char text[512];
    assert_int_equal(lobe_vulkan_missing(&host.vulkan, &features, text, sizeof text), 5);
    assert_null(strstr(text, "dynamicRendering"));
    assert_null(strstr(text, "maintenance4"));
}

static void assert_refused(lobe_result expected, const lobe_device_parameters *parameters,
                           const char *because) {
    lobe_device *device = (lobe_device *)&host;
    log_recorder_start(&host.recorder);
    lobe_device_parameters used = parameters ? *parameters : (lobe_device_parameters){0};
    used.host = &host.recorder.host;
    assert_int_equal(lobe_vulkan_import_device(&host.vulkan, &used, &device), expected);
    assert_null(device);
    assert_int_equal(host.recorder.errors, 1);
    if (!strstr(host.recorder.last_error, because))
        fail_msg("%s", host.recorder.last_error);
}

static void unsuited_devices_are_refused(void **state) {
    (void)state;
    host.features.vulkan_1_3.maintenance4 = VK_FALSE;
    assert_refused(LOBE_ERROR_NO_DEVICE, NULL, "maintenance4");
    host.features.vulkan_1_3.maintenance4 = VK_TRUE;
    host.vulkan.queue_family = 77;
    assert_refused(LOBE_ERROR_NO_DEVICE, NULL, "queue family 77");
    host.vulkan.queue_family = lobe_vulkan_queue_family(&host.vulkan);
    host.vulkan.lock_queue = lock;
    assert_refused(LOBE_ERROR_INVALID_ARGUMENT, NULL, "callback");
    host.vulkan.lock_queue = NULL;
    assert_refused(LOBE_ERROR_INVALID_ARGUMENT, &(lobe_device_parameters){.validation = true},
                   "chosen by the host");
    assert_refused(LOBE_ERROR_INVALID_ARGUMENT,
                   &(lobe_device_parameters){.get_instance_proc_addr = vkGetInstanceProcAddr},
                   "chosen by the host");
    host.vulkan.features = NULL;
    assert_refused(LOBE_ERROR_INVALID_ARGUMENT, NULL, "features");
    host.vulkan.features = &host.features.core;
    VkQueue queue = host.vulkan.queue;
    host.vulkan.queue = VK_NULL_HANDLE;
    assert_refused(LOBE_ERROR_INVALID_ARGUMENT, NULL, "queue");
    host.vulkan.queue = queue;
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(the_hosts_device_outlives_ours, open_host, close_host),
        cmocka_unit_test_setup_teardown(the_queue_is_used_under_the_hosts_lock, open_host,
                                        close_host),
        cmocka_unit_test_setup_teardown(threads_that_wait_block_no_others, open_unvalidated_host,
                                        close_host),
        cmocka_unit_test_setup_teardown(the_driver_takes_the_hosts_memory, open_host, close_host),
        cmocka_unit_test_setup_teardown(recommended_features_are_turned_on, open_host, close_host),
        cmocka_unit_test_setup_teardown(missing_features_are_told_in_words, open_host, close_host),
        cmocka_unit_test_setup_teardown(single_structures_count, open_host, close_host),
        cmocka_unit_test_setup_teardown(unsuited_devices_are_refused, open_host, close_host),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
