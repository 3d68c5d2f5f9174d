#include <inttypes.h>
#include <stdio.h>

#include <lobe/lobe.h>

#include "tools/cli/console.h"
#include "tools/cli/device_options.h"
#include "tools/cli/subcommand.h"

static void print_list(const lobe_device_information *devices, size_t count) {
    printf("lobe %s\n\nVulkan devices:\n", lobe_version());
    for (size_t i = 0; i < count; i++)
        printf("  %zu  %s (%s)\n", i, devices[i].name, lobe_device_type_name(devices[i].type));
}

static void print_features(const lobe_device_information *device, bool present) {
    size_t count = 0;
    for (size_t i = 0; i < device->feature_count; i++) {
        const lobe_device_feature *feature = &device->features[i];
        if (feature->present != present)
            continue;
        printf("    %-36s %s%s\n", feature->name, feature->use,
               feature->required ? " (required)" : "");
        ++count;
    }
    if (count == 0)
        puts("    none");
}

static void print_device(const lobe_device *device) {
    const lobe_device_information *information = lobe_device_describe(device);
    lobe_device_memory memory;
    lobe_device_memory_query(device, &memory);
    printf("\nDevice in use:\n");
    printf("  name                 %s\n", information->name);
    printf("  type                 %s\n", lobe_device_type_name(information->type));
    printf("  driver               %s\n", information->driver);
    printf("  Vulkan               %" PRIu32 ".%" PRIu32 ".%" PRIu32 "\n",
           information->vulkan_major, information->vulkan_minor, information->vulkan_patch);
    printf("  memory               %" PRIu64 " MiB, of which %" PRIu64 " MiB are available now\n",
           information->memory_bytes >> 20, memory.budget_bytes >> 20);
    printf("  largest image        %" PRIu32 " texels across\n", information->maximum_image_extent);
    printf("  pass timings         %s\n", information->timestamp_period > 0 ? "yes" : "no");
    printf("  float32 filtering    %s\n", information->linear_filter_float32 ? "yes" : "no");
    printf("  features found\n");
    print_features(information, true);
    printf("  features missing\n");
    print_features(information, false);
}

static int show(const device_options *options) {
    const lobe_host host = console_host(false);
    lobe_device_information *devices;
    lobe_device *device;
    size_t count;
    if (lobe_device_list(&(lobe_device_parameters){.host = &host}, &devices, &count) != LOBE_OK)
        return 1;
    print_list(devices, count);
    lobe_device_list_free(&devices, count);
    if (device_options_open(options, &host, &device) != LOBE_OK)
        return 1;
    print_device(device);
    lobe_device_destroy(&device);
    return 0;
}

static int run(int argc, char **argv) {
    device_options device = {0};
    const option options[] = {device_option_select(&device)};
    const option_table table = {
        .program = "lobe info",
        .summary =
            "Lists the Vulkan devices, and describes the one in use: driver, memory, and which\n"
            "of the features that lobe can use it has, and what lobe uses them for.",
        .options = options,
        .option_count = sizeof options / sizeof *options,
    };
    int status;
    return options_parse(&table, argc, argv, NULL, &status) ? show(&device) : status;
}

const subcommand info_subcommand = {"info", "describe the Vulkan device and its features", run};
