#include "engine/shader/shaders.h"

#include <stdlib.h>
#include <string.h>

#include "engine/device/device.h"
#include "engine/shader/reflection.h"
#include "engine/shader/words.h"

typedef struct shader_table {
    struct shader_table *next;
    const engine_shader_code *codes;
    size_t count;
    char *folder; ///< of the sources; NULL if unknown
    void *owned;  ///< what `codes` points to; NULL if that outlives the device
} shader_table;

typedef struct loaded_shader {
    struct loaded_shader *next;
    engine_shader shader;
    engine_shader_words words;
    const engine_shader_code *code;
} loaded_shader;

struct engine_shaders {
    lobe_device *device;
    shader_table *tables;  ///< the last added first
    loaded_shader *loaded; ///< the last loaded first
};

// ---------------------------------------------------------------------------------------------
// Tables

static lobe_result add_table(engine_shaders *shaders, const engine_shader_code *codes, size_t count,
                             const char *folder) {
    const lobe_allocator *allocator = shaders->device->host.allocator;
    for (const shader_table *known = shaders->tables; known; known = known->next)
        if (known->codes == codes)
            return LOBE_OK;
    shader_table *table = lobe_allocate(allocator, 1, sizeof *table);
    if (!table || (folder && !(table->folder = lobe_copy_text(allocator, folder)))) {
        lobe_release(table);
        return lobe_host_fail(&shaders->device->host, LOBE_ERROR_OUT_OF_MEMORY,
                              "shaders: out of memory");
    }
    table->codes = codes;
    table->count = count;
    table->next = shaders->tables;
    shaders->tables = table;
    return LOBE_OK;
}

static int compare_name(const void *name, const void *code) {
    return strcmp(name, ((const engine_shader_code *)code)->name);
}

static const engine_shader_code *find_code(const engine_shaders *shaders, const char *name,
                                           const shader_table **of) {
    const engine_shader_code *code = NULL;
    for (const shader_table *table = shaders->tables; table && !code; table = table->next) {
        *of = table;
        code = bsearch(name, table->codes, table->count, sizeof *code, compare_name);
    }
    return code;
}

/// The first table added is the library's own.
static const shader_table *library_table(const engine_shaders *shaders) {
    const shader_table *table = shaders->tables;
    while (table->next)
        table = table->next;
    return table;
}

// ---------------------------------------------------------------------------------------------
// Loading

/// The host's shaders have no source and never change.
static lobe_result get_words(const engine_shaders *shaders, lobe_log_level level,
                             const engine_shader_folders *folders, const engine_shader_code *code,
                             engine_shader_words *words) {
    if (code->source)
        return engine_shader_words_get(&shaders->device->host, level, folders, code, words);
    *words = (engine_shader_words){code->words, code->size / sizeof *code->words, NULL};
    return LOBE_OK;
}

static bool are_stale(const loaded_shader *loaded) {
    return loaded->code->source && engine_shader_words_are_stale(&loaded->words);
}

static void free_words(const engine_shader_code *code, engine_shader_words *words) {
    if (code->source)
        engine_shader_words_free(words);
}

static void free_loaded(loaded_shader *loaded) {
    engine_reflection_free(&loaded->shader);
    free_words(loaded->code, &loaded->words);
    lobe_release(loaded);
}

/// Creates a shader from its words and takes ownership of them, even on failure.
static lobe_result load(engine_shaders *shaders, const engine_shader_code *code,
                        engine_shader_words *words, loaded_shader **result_shader) {
    lobe_device *device = shaders->device;
    loaded_shader *loaded = lobe_allocate(device->host.allocator, 1, sizeof *loaded);
    if (!loaded) {
        free_words(code, words);
        return lobe_host_fail(&device->host, LOBE_ERROR_OUT_OF_MEMORY, "shader '%s': out of memory",
                              code->name);
    }
    loaded->words = *words;
    loaded->code = code;
    loaded->shader.name = code->name;
    loaded->shader.version = engine_device_stamp(device);
    loaded->shader.words = words->words;
    loaded->shader.word_count = words->count;
    const lobe_result result =
        engine_reflect(&device->host, words->words, words->count, &loaded->shader);
    if (result != LOBE_OK) {
        free_loaded(loaded);
        return result;
    }
    loaded->next = shaders->loaded;
    shaders->loaded = loaded;
    *result_shader = loaded;
    return LOBE_OK;
}

static loaded_shader *find_loaded(const engine_shaders *shaders, const engine_shader_code *code) {
    loaded_shader *loaded = shaders->loaded;
    while (loaded && loaded->code != code)
        loaded = loaded->next;
    return loaded;
}

/// Loads a shader for the first time.
static lobe_result load_first(engine_shaders *shaders, const engine_shader_code *code,
                              const engine_shader_folders *folders, loaded_shader **loaded) {
    engine_shader_words words;
    const lobe_result result = get_words(shaders, LOBE_LOG_ERROR, folders, code, &words);
    if (result != LOBE_OK) {
        free_words(code, &words);
        return result;
    }
    return load(shaders, code, &words, loaded);
}

/// Reloads a shader whose source has changed. If it does not compile, the old shader stays in use
/// until the source changes again.
static lobe_result load_again(engine_shaders *shaders, const engine_shader_code *code,
                              const engine_shader_folders *folders, loaded_shader **loaded) {
    engine_shader_words words;
    const lobe_result result = get_words(shaders, LOBE_LOG_WARNING, folders, code, &words);
    if (result == LOBE_OK)
        return load(shaders, code, &words, loaded);
    engine_source_files *old = (*loaded)->words.files;
    (*loaded)->words.files = words.files;
    words.files = old;
    free_words(code, &words);
    return LOBE_OK;
}

// ---------------------------------------------------------------------------------------------
// Interface

lobe_result engine_shaders_create(lobe_device *device, const char *folder,
                                  engine_shaders **shaders) {
    *shaders = lobe_allocate(device->host.allocator, 1, sizeof **shaders);
    if (!*shaders)
        return lobe_host_fail(&device->host, LOBE_ERROR_OUT_OF_MEMORY, "shaders: out of memory");
    (*shaders)->device = device;
    const lobe_result result =
        add_table(*shaders, engine_embedded_shaders, engine_embedded_shaders_count,
                  folder ? folder : engine_shader_words_folder());
    if (result != LOBE_OK)
        engine_shaders_destroy(shaders);
    return result;
}

void engine_shaders_destroy(engine_shaders **shaders) {
    if (!*shaders)
        return;
    for (loaded_shader *loaded = (*shaders)->loaded, *next; loaded; loaded = next) {
        next = loaded->next;
        free_loaded(loaded);
    }
    for (shader_table *table = (*shaders)->tables, *next; table; table = next) {
        next = table->next;
        lobe_release(table->folder);
        lobe_release(table->owned);
        lobe_release(table);
    }
    lobe_release(*shaders);
    *shaders = NULL;
}

lobe_result engine_shaders_add(lobe_device *device, const engine_shader_code *codes, size_t count,
                               const char *folder) {
    pthread_mutex_lock(&device->found_mutex);
    const lobe_result result = add_table(device->shaders, codes, count, folder);
    pthread_mutex_unlock(&device->found_mutex);
    return result;
}

/// Allocates the code with its words and name in one block.
static engine_shader_code *copy_code(const lobe_allocator *allocator, const lobe_shader *shader) {
    const size_t name_size = strlen(shader->name) + 1;
    engine_shader_code *code = lobe_allocate(allocator, 1, sizeof *code + shader->size + name_size);
    if (!code)
        return NULL;
    uint32_t *words = (uint32_t *)(code + 1);
    char *name = (char *)words + shader->size;
    memcpy(words, shader->words, shader->size);
    memcpy(name, shader->name, name_size);
    *code = (engine_shader_code){.name = name, .words = words, .size = shader->size};
    return code;
}

static void remove_last_table(engine_shaders *shaders) {
    shader_table *gone = shaders->tables;
    shaders->tables = gone->next;
    lobe_release(gone->owned);
    lobe_release(gone);
}

/// Takes ownership of the code, even on failure.
static lobe_result add_code(lobe_device *device, engine_shader_code *code) {
    engine_shaders *shaders = device->shaders;
    lobe_result result = add_table(shaders, code, 1, NULL);
    if (result != LOBE_OK) {
        lobe_release(code);
        return result;
    }
    shaders->tables->owned = code;
    // Report errors here, not in the first pass that uses it.
    const engine_shader *found;
    result = engine_shader_find(device, code->name, &found);
    if (result != LOBE_OK)
        remove_last_table(shaders);
    return result;
}

lobe_result lobe_device_add_shader(lobe_device *device, const lobe_shader *shader) {
    if (!device || !shader)
        return lobe_host_fail(device ? &device->host : NULL, LOBE_ERROR_INVALID_ARGUMENT,
                              "lobe_device_add_shader: device and shader must not be NULL");
    if (!shader->name || !shader->words || shader->size == 0 || shader->size % 4 != 0)
        return lobe_host_fail(&device->host, LOBE_ERROR_INVALID_ARGUMENT,
                              "shader '%s': a name and whole words of SPIR-V are needed",
                              shader->name ? shader->name : "");
    engine_shader_code *code = copy_code(device->host.allocator, shader);
    if (!code)
        return lobe_host_fail(&device->host, LOBE_ERROR_OUT_OF_MEMORY, "shader '%s': out of memory",
                              shader->name);
    pthread_mutex_lock(&device->found_mutex);
    const lobe_result result = add_code(device, code);
    pthread_mutex_unlock(&device->found_mutex);
    return result;
}

static lobe_result find_shader(lobe_device *device, const char *name,
                               const engine_shader **shader) {
    engine_shaders *shaders = device->shaders;
    const shader_table *table = NULL;
    const engine_shader_code *code = find_code(shaders, name, &table);
    *shader = NULL;
    if (!code)
        return lobe_host_fail(&device->host, LOBE_ERROR_SHADER, "there is no shader '%s'", name);
    const engine_shader_folders folders = {table->folder, library_table(shaders)->folder};
    loaded_shader *loaded = find_loaded(shaders, code);
    lobe_result result = LOBE_OK;
    if (!loaded)
        result = load_first(shaders, code, &folders, &loaded);
    else if (are_stale(loaded))
        result = load_again(shaders, code, &folders, &loaded);
    if (result == LOBE_OK)
        *shader = &loaded->shader;
    return result;
}

size_t engine_shaders_stale(lobe_device *device) {
    size_t count = 0;
    pthread_mutex_lock(&device->found_mutex);
    for (const loaded_shader *loaded = device->shaders->loaded; loaded; loaded = loaded->next)
        count += find_loaded(device->shaders, loaded->code) == loaded && are_stale(loaded);
    pthread_mutex_unlock(&device->found_mutex);
    return count;
}

lobe_result engine_shader_find(lobe_device *device, const char *name,
                               const engine_shader **shader) {
    pthread_mutex_lock(&device->found_mutex);
    const lobe_result result = find_shader(device, name, shader);
    pthread_mutex_unlock(&device->found_mutex);
    return result;
}
