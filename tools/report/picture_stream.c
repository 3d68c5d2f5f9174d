#include "tools/report/picture_stream.h"

#include <stdlib.h>
#include <string.h>

#include <lobe/colour.h>

#include "tools/compare/image_input.h"

#define REFERENCE UINT32_MAX

typedef struct picture_stream {
    FILE *file;
    const char *results; ///< their path
    const lobe_host *host;
} picture_stream;

static void write_number(const picture_stream *stream, uint32_t number) {
    fwrite(&number, sizeof number, 1, stream->file);
}

static void write_heat_colours(const picture_stream *stream) {
    for (int i = 0; i < 256; i++) {
        uint8_t colour[3];
        lobe_heat_colour((float)i / 255, colour);
        fwrite(colour, sizeof colour, 1, stream->file);
    }
}

// ---------------------------------------------------------------------------------------------
// Pictures

/// Names in the results are relative to the results file.
static char *path_beside(const char *results, const char *name) {
    const char *slash = strrchr(results, '/');
    size_t folder = slash && name[0] != '/' ? (size_t)(slash - results) + 1 : 0;
    char *path = malloc(folder + strlen(name) + 1);
    if (path) {
        memcpy(path, results, folder);
        strcpy(path + folder, name);
    }
    return path;
}

static lobe_result write_texels(const picture_stream *stream, const lobe_image *linear) {
    lobe_image shown;
    lobe_result result = lobe_display_encode(linear, NULL, stream->host, &shown);
    if (result != LOBE_OK)
        return result;
    size_t count = (size_t)linear->width * linear->height;
    write_number(stream, linear->width);
    write_number(stream, linear->height);
    fwrite(linear->texels, 4 * sizeof(float), count, stream->file);
    fwrite(shown.texels, 4, count, stream->file);
    lobe_image_free(&shown);
    return LOBE_OK;
}

static lobe_result write_picture(const picture_stream *stream, uint32_t row, const char *name) {
    char *path = path_beside(stream->results, name);
    if (!path)
        return lobe_host_fail(stream->host, LOBE_ERROR_OUT_OF_MEMORY, "%s: out of memory", name);
    image_input input;
    lobe_result result = image_input_read(path, stream->host, &input);
    free(path);
    if (result != LOBE_OK)
        return result;
    write_number(stream, row);
    result = write_texels(stream, &input.image);
    lobe_image_free(&input.image);
    return result;
}

// ---------------------------------------------------------------------------------------------
// Scenes

/// The filter `reference` differs from the scene's reference only in its number of samples.
static bool has_picture(const sweep_row *row, const sweep_scene *scene) {
    return row->picture && row->varied[0] == '\0' && strcmp(row->scene, scene->name) == 0 &&
           strcmp(row->filter, "reference") != 0;
}

static uint32_t count_pictures(const sweep_results *results, const sweep_scene *scene) {
    uint32_t count = 1;
    for (size_t i = 0; i < results->row_count; i++)
        count += has_picture(&results->rows[i], scene);
    return count;
}

static lobe_result write_scene(const picture_stream *stream, const sweep_results *results,
                               const sweep_scene *scene) {
    if (scene->skipped || !scene->reference) {
        write_number(stream, 0);
        return LOBE_OK;
    }
    write_number(stream, count_pictures(results, scene));
    lobe_result result = write_picture(stream, REFERENCE, scene->reference);
    for (size_t i = 0; result == LOBE_OK && i < results->row_count; i++) {
        const sweep_row *row = &results->rows[i];
        if (has_picture(row, scene) && !ferror(stream->file))
            result = write_picture(stream, (uint32_t)i, row->picture);
    }
    return result;
}

lobe_result picture_stream_write(FILE *file, const sweep_results *results, const char *path,
                                 const lobe_host *host) {
    const picture_stream stream = {file, path, host};
    lobe_result result = LOBE_OK;
    write_heat_colours(&stream);
    for (size_t i = 0; result == LOBE_OK && i < results->scene_count && !ferror(file); i++)
        result = write_scene(&stream, results, &results->scenes[i]);
    return result;
}
