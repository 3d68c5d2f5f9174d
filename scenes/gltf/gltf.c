#include "scenes/gltf/gltf.h"

#include <stdio.h>
#include <string.h>

#include "scenes/format/host_file.h"
#include "scenes/gltf/container.h"
#include "scenes/gltf/schema.h"
#include "scenes/scene/even_maps.h"
#include "scenes/scene/scene.h"

// ---------------------------------------------------------------------------------------------
// From the file to the document

// Failures to read buffer files; tinygltf only learns that they happened. The message is held back
// until parsing has failed: tinygltf may mistake an image for a buffer, which is not a failure.
typedef struct buffer_reader {
    const char *path;
    const lobe_file_source *files;
    const lobe_allocator *allocator;
    lobe_result result;
    char line[1024];
} buffer_reader;

static void keep_line(void *user, lobe_log_level level, const char *message) {
    buffer_reader *reader = user;
    if (level == LOBE_LOG_ERROR)
        snprintf(reader->line, sizeof reader->line, "%s", message);
}

static void *read_buffer(void *user, const char *path, size_t *size) {
    buffer_reader *reader = user;
    lobe_host host = {.write = keep_line, .user = reader, .allocator = reader->allocator};
    uint8_t *bytes = NULL;
    reader->result = scenes_host_file_read(reader->files, path, reader->path, &host, &bytes, size);
    return bytes;
}

static lobe_result parse(const gltf_container *container, const char *path,
                         const lobe_file_source *files, const lobe_host *host,
                         const gltf_document **document) {
    const char *slash = strrchr(path, '/');
    const lobe_allocator *allocator = lobe_host_allocator(host);
    char *folder = lobe_copy_text(allocator, path);
    if (!folder)
        return lobe_host_fail(host, LOBE_ERROR_OUT_OF_MEMORY, "%s: out of memory", path);
    folder[slash ? slash + 1 - path : 0] = 0;
    char message[256];
    buffer_reader reader = {.path = path, .files = files, .allocator = allocator};
    gltf_source source = {.bytes = container->binary ? container->bytes : container->json,
                          .size = container->binary ? container->size : container->json_size,
                          .binary = container->binary,
                          .folder = folder,
                          .read = read_buffer,
                          .release = lobe_release,
                          .user = &reader};
    *document = third_party_gltf_document_parse(&source, message, sizeof message);
    lobe_release(folder);
    if (*document)
        return LOBE_OK;
    if (reader.result != LOBE_OK)
        return lobe_host_fail(host, reader.result, "%s", reader.line);
    bool malformed = *message != 0;
    return lobe_host_fail(host, malformed ? LOBE_ERROR_MALFORMED : LOBE_ERROR_OUT_OF_MEMORY,
                          "%s: %s", path, malformed ? message : "out of memory");
}

// Reading modifies the bytes, so those of a host are copied.
static lobe_result read_bytes(const lobe_scene_open_parameters *parameters, const lobe_host *host,
                              uint8_t **bytes, size_t *size) {
    const char *path = parameters->scene;
    return parameters->data
               ? scenes_host_file_copy(path, parameters->data, parameters->size, host, bytes, size)
               : scenes_host_file_read(parameters->files, path, NULL, host, bytes, size);
}

static lobe_result read_document(const lobe_scene_open_parameters *parameters,
                                 const lobe_host *host, const gltf_document **document) {
    const char *path = parameters->scene;
    gltf_container container = {0};
    pointer_nodes pointers = {0};
    uint8_t *bytes = NULL;
    lobe_result result = read_bytes(parameters, host, &bytes, &container.size);
    container.bytes = (char *)bytes;
    if (result == LOBE_OK)
        result = scenes_gltf_container_open(&container, path, host);
    if (result == LOBE_OK)
        result =
            scenes_gltf_schema_check(path, container.json, container.json_size, host, &pointers);
    if (result == LOBE_OK)
        result = scenes_pointer_nodes_insert(&pointers, &container, path, host);
    if (result == LOBE_OK)
        result = parse(&container, path, parameters->files, host, document);
    lobe_release(pointers.places);
    lobe_release(container.bytes);
    return result;
}

// ---------------------------------------------------------------------------------------------
// From the document to the scene

static int64_t *allocate_unconverted(const gltf_import *import, size_t count) {
    int64_t *states = lobe_allocate(lobe_host_allocator(import->host), count, sizeof *states);
    for (size_t i = 0; states && i < count; i++)
        states[i] = GLTF_NOT_CONVERTED;
    return states;
}

static bool allocate_primitives(gltf_import *import) {
    const lobe_allocator *allocator = lobe_host_allocator(import->host);
    const gltf_document *document = import->document;
    size_t count = 0;
    import->first_primitives =
        lobe_allocate(allocator, document->mesh_count + 1, sizeof *import->first_primitives);
    if (!import->first_primitives)
        return false;
    for (size_t i = 0; i < document->mesh_count; i++) {
        import->first_primitives[i] = count;
        count += document->meshes[i].primitive_count;
    }
    import->primitives = lobe_allocate(allocator, count + 1, sizeof *import->primitives);
    for (size_t i = 0; import->primitives && i < count; i++)
        import->primitives[i] = (gltf_primitive_state){
            GLTF_NOT_CONVERTED, GLTF_NOT_CONVERTED, GLTF_NOT_CONVERTED, -1, -1, -1};
    import->deformed = lobe_allocate(allocator, count + 1, sizeof *import->deformed);
    if (import->primitives && import->deformed)
        memcpy(import->deformed, import->primitives, count * sizeof *import->deformed);
    return import->primitives && import->deformed;
}

static lobe_result allocate_states(gltf_import *import) {
    const gltf_document *document = import->document;
    import->materials = allocate_unconverted(import, document->material_count + 1);
    import->images[0] = allocate_unconverted(import, document->image_count + 1);
    import->images[1] = allocate_unconverted(import, document->image_count + 1);
    if (allocate_primitives(import) && import->materials && import->images[0] && import->images[1])
        return LOBE_OK;
    return lobe_host_fail(import->host, LOBE_ERROR_OUT_OF_MEMORY, "%s: out of memory",
                          import->path);
}

static void free_states(gltf_import *import) {
    lobe_release(import->first_primitives);
    lobe_release(import->primitives);
    lobe_release(import->deformed);
    lobe_release(import->motions);
    lobe_release(import->rig_nodes);
    lobe_release(import->skins);
    lobe_release(import->moved_parts);
    lobe_release(import->materials);
    lobe_release(import->images[0]);
    lobe_release(import->images[1]);
}

static void note_extensions(gltf_import *import) {
    const gltf_document *document = import->document;
    for (size_t i = 0; i < document->extension_count; i++) {
        const char *name = document->extensions[i];
        if (!scenes_gltf_extension_supported(name))
            scenes_gltf_note_unsupported(import, name);
        if (strcmp(name, "KHR_mesh_quantization") == 0)
            import->quantised = true;
    }
}

static lobe_result convert(gltf_import *import) {
    lobe_result result = allocate_states(import);
    if (result != LOBE_OK)
        return result;
    note_extensions(import);
    result = scenes_gltf_convert_nodes(import);
    if (result == LOBE_OK)
        result = scenes_gltf_convert_environment(import);
    if (result == LOBE_OK)
        result = scenes_gltf_end_rig(import);
    if (result != LOBE_OK)
        return result;
    scenes_gltf_report_notes(import);
    result = scenes_fold_even_maps(import->scene, import->host);
    if (result == LOBE_OK)
        result = scenes_complete(import->scene, import->own_light_only, import->host);
    if (result == LOBE_OK && import->scene->has_camera)
        scenes_gltf_aim_camera(import->scene);
    if (result == LOBE_OK)
        scenes_gltf_measure_camera(import->scene);
    return result;
}

lobe_result scenes_gltf_open(const lobe_scene_open_parameters *parameters, const lobe_host *host,
                             lobe_scene **scene) {
    gltf_import import = {.path = parameters->scene,
                          .host = host,
                          .files = parameters->files,
                          .own_light_only = parameters->own_light_only};
    *scene = NULL;
    lobe_result result = read_document(parameters, host, &import.document);
    if (result == LOBE_OK)
        result = scenes_allocate(parameters->scene, host, &import.scene);
    if (result == LOBE_OK)
        result = convert(&import);
    if (result == LOBE_OK)
        *scene = import.scene;
    else
        lobe_scene_destroy(&import.scene);
    free_states(&import);
    third_party_gltf_document_free(import.document);
    return result;
}
