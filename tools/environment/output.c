#include "tools/environment/output.h"

#include <inttypes.h>
#include <stdio.h>
#include <string.h>

#include <lobe/lobe.h>

#include "passes/environment/cache/cube_file.h"

/// Levels of the largest possible cube.
#define MOST_LEVELS 12

static const char *kernel_name(lobe_environment_map map) {
    return map == LOBE_ENVIRONMENT_GGX ? "ggx" : "vmf";
}

// ---------------------------------------------------------------------------------------------
// For people

void environment_output_print(const environment_output *output) {
    const lobe_environment_maps_information *information =
        lobe_environment_maps_describe(output->maps);
    const lobe_image *image = &output->environment->image;
    uint32_t width = information->width[output->map];
    printf("%s: %ux%u texels on faces of %u, filtered with %s lobes\n  level   face      kappa\n",
           output->environment->name, image->width, image->height, output->size,
           kernel_name(output->map));
    for (uint32_t level = 0; level < information->levels[output->map]; level++)
        printf("  %5u  %5u  %9.4g\n", level, width >> level,
               lobe_environment_level_concentration(width, level));
    printf("  %-36s %5s %12s\n", "passes", "", "ms");
    for (size_t i = 0; i < information->pass_count; i++)
        printf("    %-34s %4ux %12.3f\n", information->passes[i].name, information->passes[i].count,
               information->passes[i].milliseconds);
    printf("    %-40s %12.3f\n", "all", information->milliseconds);
}

// ---------------------------------------------------------------------------------------------
// The file

static lobe_result take_face(const environment_output *output, cube_image *cube, uint32_t level,
                             uint32_t face) {
    lobe_image image;
    lobe_result result = lobe_environment_maps_read(output->maps, output->map, level, face, &image);
    if (result != LOBE_OK)
        return result;
    memcpy(passes_cube_image_face(cube, level, face), image.texels,
           (size_t)image.width * image.height * lobe_format_size(image.format));
    lobe_image_free(&image);
    return LOBE_OK;
}

static lobe_result take_cube(const environment_output *output, cube_image *cube) {
    uint32_t width = lobe_environment_maps_describe(output->maps)->width[output->map];
    lobe_result result = passes_cube_image_allocate(cube, width, output->host);
    for (uint32_t i = 0; result == LOBE_OK && i < 6 * cube->levels; i++)
        result = take_face(output, cube, i / 6, i % 6);
    return result;
}

/// Attributes of the file, with the texts that some of them point to.
typedef struct header {
    lobe_exr_attribute attributes[8 + MOST_LEVELS];
    size_t count;
    char key[17], names[MOST_LEVELS][16];
} header;

static void add_text(header *header, const char *name, const char *text) {
    header->attributes[header->count++] =
        (lobe_exr_attribute){.name = name, .type = LOBE_EXR_TEXT, .text = text};
}

static void fill_header(const environment_output *output, const cube_image *cube, header *header) {
    uint64_t key = passes_cube_file_key(output->environment, output->size, output->map);
    snprintf(header->key, sizeof header->key, "%016" PRIx64, key);
    add_text(header, "lobeVersion", lobe_version());
    add_text(header, "environment", output->environment->name);
    add_text(header, "environmentHash", header->key);
    add_text(header, "kernel", kernel_name(output->map));
    header->attributes[header->count++] = (lobe_exr_attribute){
        .name = "face", .type = LOBE_EXR_INTEGER, .integer = (int32_t)output->size};
    for (uint32_t level = 0; level < cube->levels && level < MOST_LEVELS; level++) {
        char *name = header->names[level];
        snprintf(name, sizeof header->names[level], "kappa%u", level);
        header->attributes[header->count++] = (lobe_exr_attribute){
            .name = name,
            .type = LOBE_EXR_NUMBER,
            .number = (float)lobe_environment_level_concentration(cube->width, level)};
    }
}

lobe_result environment_output_write(const environment_output *output, const char *path) {
    cube_image cube = {0};
    header header = {.count = 0};
    lobe_result result = take_cube(output, &cube);
    if (result == LOBE_OK) {
        fill_header(output, &cube, &header);
        result =
            passes_cube_image_write(path, &cube, header.attributes, header.count, output->host);
    }
    passes_cube_image_free(&cube);
    return result;
}
