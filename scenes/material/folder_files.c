#include "scenes/material/folder_files.h"

#include <ctype.h>
#include <dirent.h>
#include <errno.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct folder_search {
    const char *path;
    const lobe_host *host;
    material_files *found;
} folder_search;

static lobe_result out_of_memory(const folder_search *search) {
    return lobe_host_fail(search->host, LOBE_ERROR_OUT_OF_MEMORY, "%s: out of memory",
                          search->path);
}

// ---------------------------------------------------------------------------------------------
// Listing

static lobe_result add_file(const folder_search *search, const char *name) {
    material_files *found = search->found;
    const bool readable = scenes_material_file_is_readable(name);
    if (!readable && !scenes_material_file_is_other_image(name))
        return LOBE_OK;
    const lobe_allocator *allocator = lobe_host_allocator(search->host);
    // Grows at powers of two.
    if ((found->count & (found->count - 1)) == 0) {
        material_file *larger = lobe_reallocate(
            allocator, found->files, found->count ? 2 * found->count : 1, sizeof *larger);
        if (!larger)
            return out_of_memory(search);
        found->files = larger;
    }
    material_file file = {.name = lobe_copy_text(allocator, name), .readable = readable};
    if (!file.name)
        return out_of_memory(search);
    found->files[found->count++] = file;
    return LOBE_OK;
}

static int compare_names(const void *a, const void *b) {
    return strcmp(((const material_file *)a)->name, ((const material_file *)b)->name);
}

static lobe_result list_files(const folder_search *search) {
    DIR *directory = opendir(search->path);
    if (!directory && (errno == ENOENT || errno == ENAMETOOLONG))
        return lobe_host_fail(search->host, LOBE_ERROR_NOT_FOUND, "%s: no such folder",
                              search->path);
    if (!directory)
        return lobe_host_fail(search->host, LOBE_ERROR_READ, "%s: %s", search->path,
                              strerror(errno));
    lobe_result status = LOBE_OK;
    errno = 0;
    for (struct dirent *entry; !status && (entry = readdir(directory)); errno = 0)
        status = add_file(search, entry->d_name);
    if (!status && errno)
        status =
            lobe_host_fail(search->host, LOBE_ERROR_READ, "%s: %s", search->path, strerror(errno));
    closedir(directory);
    // The order in which the file system lists them must not matter.
    if (search->found->count > 0)
        qsort(search->found->files, search->found->count, sizeof *search->found->files,
              compare_names);
    return status;
}

// ---------------------------------------------------------------------------------------------
// What the names say

/// "1k", "2048", "jpg", "16bit": a form of the same material.
static bool is_form(const char *word) {
    static const char *const forms[] = {"png", "jpg",  "jpeg", "exr",  "tif", "tiff",
                                        "512", "1024", "2048", "4096", "8192"};
    for (size_t i = 0; i < sizeof forms / sizeof *forms; i++)
        if (strcmp(word, forms[i]) == 0)
            return true;
    const char *end = word;
    while (isdigit((unsigned char)*end))
        end++;
    return end > word && (strcmp(end, "k") == 0 || strcmp(end, "bit") == 0);
}

/// The map of a name that says `workflow` last, after a map and its form, as in Poliigon's
/// "Bricks_COL_2K_METALNESS"; NULL: it does not end so.
static const map_word *map_before_workflow(const material_name *name, const char *workflow) {
    if (name->count < 3 || strcmp(name->words[name->count - 1], workflow) != 0)
        return NULL;
    size_t end = name->count - 1;
    while (end > 0 && is_form(name->words[end - 1]))
        end--;
    const char *word = end > 0 && end < name->count - 1 ? name->words[end - 1] : NULL;
    return word ? scenes_material_map_word(word, strlen(word)) : NULL;
}

/// Whether names of different maps end with it: else it is a map ("Metal_1K_Metalness").
static bool is_workflow(const material_files *found, const char *workflow) {
    const map_word *first = NULL;
    for (size_t i = 0; i < found->count; i++) {
        material_name name;
        scenes_material_name_split(found->files[i].name, &name);
        const map_word *map = map_before_workflow(&name, workflow);
        if (first && map && map != first)
            return true;
        first = first ? first : map;
    }
    return false;
}

static void find_workflow(material_files *found) {
    static const char *const workflows[] = {"metalness", "specular"};
    for (size_t i = 0; !found->workflow && i < sizeof workflows / sizeof *workflows; i++)
        if (is_workflow(found, workflows[i]))
            found->workflow = workflows[i];
}

/// Without the workflow at its end.
static void split_name(const material_files *found, const material_file *file,
                       material_name *name) {
    scenes_material_name_split(file->name, name);
    if (found->workflow && map_before_workflow(name, found->workflow))
        name->count--;
}

/// How many words all names begin with; one fewer if there are no others ("albedo.png",
/// "albedo.exr").
static size_t count_common_words(const material_files *found) {
    material_name first, other;
    split_name(found, &found->files[0], &first);
    size_t common = found->count > 1 ? first.count : 0, most = first.count;
    for (size_t i = 1; i < found->count; i++) {
        split_name(found, &found->files[i], &other);
        size_t same = 0;
        while (same < common && same < other.count &&
               strcmp(first.words[same], other.words[same]) == 0)
            same++;
        common = same;
        most = other.count > most ? other.count : most;
    }
    return common > 0 && common == most ? common - 1 : common;
}

/// Whether each map is still recognised without its first `skipped` words, unless no others are
/// left: "Metal2.png" beside "Metal2_Color.png" is a picture of the material and no map.
static bool may_skip(const material_files *found, size_t skipped) {
    material_name name;
    for (size_t i = 0; i < found->count; i++) {
        split_name(found, &found->files[i], &name);
        const material_file_content whole = scenes_material_name_parse(&name, 0);
        const material_file_content rest = scenes_material_name_parse(&name, skipped);
        if (name.count > skipped && scenes_material_file_is_map(&whole) &&
            !scenes_material_file_is_map(&rest))
            return false;
    }
    return true;
}

/// What all names have in common is the material's name, which may contain words for maps.
static void parse_names(material_files *found) {
    material_name name;
    find_workflow(found);
    size_t skipped = found->count > 0 ? count_common_words(found) : 0;
    while (skipped > 0 && !may_skip(found, skipped))
        skipped--;
    for (size_t i = 0; i < found->count; i++) {
        split_name(found, &found->files[i], &name);
        found->files[i].content = scenes_material_name_parse(&name, skipped);
    }
}

// ---------------------------------------------------------------------------------------------
// One material

static bool is_filler(const char *word) {
    const map_word *known = scenes_material_map_word(word, strlen(word));
    return known && known->kind == WORD_FILLER;
}

enum { KEY_SIZE = 2 * MATERIAL_NAME_LENGTH };

/// Joins the words [first, end) that tell materials apart.
static void join_words(const material_name *name, size_t first, size_t end, char key[KEY_SIZE]) {
    size_t length = 0;
    key[0] = 0;
    while (end > first && is_filler(name->words[end - 1]))
        end--;
    for (size_t i = first; i < end; i++) {
        if (is_form(name->words[i]) || (i == 0 && strcmp(name->words[i], "t") == 0))
            continue;
        length += (size_t)snprintf(key + length, KEY_SIZE - length, "%s%s", length ? " " : "",
                                   name->words[i]);
    }
}

/// The name of the material: the words before the map, or after it where no file has any before.
/// False if a file's name has none.
static bool material_of(const material_files *found, const material_file *file, bool after,
                        char key[KEY_SIZE]) {
    material_name name;
    key[0] = 0;
    if (!scenes_material_file_is_map(&file->content))
        return false;
    split_name(found, file, &name);
    if (after)
        join_words(&name, file->content.end, name.count, key);
    else
        join_words(&name, 0, file->content.first, key);
    return key[0] != 0;
}

static size_t count_files_of(const material_files *found, size_t count, bool after,
                             const char *key) {
    char other[KEY_SIZE];
    size_t same = 0;
    for (size_t i = 0; i < count; i++)
        same += material_of(found, &found->files[i], after, other) && strcmp(other, key) == 0;
    return same;
}

/// How many materials the names speak of. Words after the map may say anything ("col_red"): only
/// those that several files share count.
static size_t list_materials(const material_files *found, bool after, char *list, size_t size) {
    char key[KEY_SIZE];
    size_t count = 0, length = 0;
    for (size_t i = 0; i < found->count; i++) {
        if (!material_of(found, &found->files[i], after, key) ||
            count_files_of(found, i, after, key) > 0)
            continue;
        if (after && count_files_of(found, found->count, after, key) < 2)
            continue;
        if (length < size / 2)
            length +=
                (size_t)snprintf(list + length, size - length, "%s'%.80s'", count ? ", " : "", key);
        count++;
    }
    return count;
}

static lobe_result require_one_material(const folder_search *search) {
    char list[768] = "";
    size_t count = list_materials(search->found, false, list, sizeof list);
    if (count == 0)
        count = list_materials(search->found, true, list, sizeof list);
    if (count <= 1)
        return LOBE_OK;
    return lobe_host_fail(search->host, LOBE_ERROR_UNSUPPORTED,
                          "%s: has maps of %zu materials: %s; put those of each into a folder of "
                          "their own",
                          search->path, count, list);
}

// ---------------------------------------------------------------------------------------------
// Choosing

/// Lower is better. The numbers of OpenEXR files may lie outside [0, 1].
static int rank(const material_file *file) {
    const int exr = scenes_material_file_is_exr(file->name);
    if (scenes_material_file_is_gltf(&file->content))
        return exr;
    return (scenes_material_file_is_packed(&file->content) ? 4 : 2) + exr;
}

static void offer(material_source *source, const material_file *file, uint32_t channel) {
    if (!source->file || rank(file) < rank(source->file))
        *source = (material_source){file, channel};
}

static void choose_sources(material_files *found) {
    material_source *sources = found->sources;
    for (size_t i = 0; i < found->count; i++) {
        const material_file *file = &found->files[i];
        if (!file->readable)
            continue;
        if (file->content.map != MATERIAL_MAP_COUNT)
            offer(&sources[file->content.map], file, 0);
        for (uint32_t channel = 0; channel < 4; channel++)
            if (file->content.channels[channel] != MATERIAL_MAP_COUNT)
                offer(&sources[file->content.channels[channel]], file, channel);
    }
    if (sources[MATERIAL_MAP_NORMAL].file)
        sources[MATERIAL_MAP_NORMAL_DIRECTX].file = NULL;
    if (sources[MATERIAL_MAP_ROUGHNESS].file)
        sources[MATERIAL_MAP_GLOSS].file = NULL;
}

static lobe_result require_maps(const folder_search *search) {
    for (int map = 0; map < MATERIAL_MAP_COUNT; map++)
        if (search->found->sources[map].file && map != MATERIAL_MAP_DISPLACEMENT)
            return LOBE_OK;
    return lobe_host_fail(search->host, LOBE_ERROR_NOT_FOUND,
                          "%s: no PNG, JPEG or OpenEXR file is named after a map (albedo, "
                          "normal, roughness, metallic, arm, ao, emissive)%s",
                          search->path,
                          search->found->sources[MATERIAL_MAP_DISPLACEMENT].file
                              ? "; heights alone are no material"
                              : "");
}

// ---------------------------------------------------------------------------------------------
// Saying so

/// A line that is cut at the end of an item if it gets too long.
typedef struct item_list {
    char text[800];
    size_t length, left_out;
} item_list;

static void __attribute__((format(printf, 2, 3)))
add_item(item_list *list, const char *format, ...) {
    char item[700];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(item, sizeof item, format, arguments);
    va_end(arguments);
    const size_t needed = strlen(item) + 2;
    if (list->left_out > 0 || list->length + needed >= sizeof list->text) {
        list->left_out++;
        return;
    }
    list->length += (size_t)snprintf(list->text + list->length, sizeof list->text - list->length,
                                     "%s%s", list->length ? ", " : "", item);
}

static void log_list(const folder_search *search, const char *what, const item_list *list) {
    char more[48] = "";
    if (list->left_out > 0)
        snprintf(more, sizeof more, " and %zu more", list->left_out);
    if (list->length > 0)
        lobe_host_log(search->host, LOBE_LOG_NOTICE, "%s: %s%s%s", search->path, what, list->text,
                      more);
}

static void log_sources(const folder_search *search) {
    static const char *const channels[] = {"red", "green", "blue", "alpha"};
    item_list list = {.length = 0};
    for (int map = 0; map < MATERIAL_MAP_COUNT; map++) {
        const material_source *source = &search->found->sources[map];
        if (!source->file)
            continue;
        char channel[16] = "";
        if (scenes_material_file_is_packed(&source->file->content))
            snprintf(channel, sizeof channel, " (%s)", channels[source->channel]);
        add_item(&list, "%s from %s%s", scenes_material_map_name((material_map)map),
                 source->file->name, channel);
    }
    log_list(search, "", &list);
}

static bool is_source(const material_files *found, const material_file *file) {
    for (int map = 0; map < MATERIAL_MAP_COUNT; map++)
        if (found->sources[map].file == file)
            return true;
    return false;
}

static void log_ignored(const folder_search *search) {
    item_list list = {.length = 0};
    for (size_t i = 0; i < search->found->count; i++) {
        const material_file *file = &search->found->files[i];
        const bool map = scenes_material_file_is_map(&file->content);
        if (!file->readable && map)
            lobe_host_log(search->host, LOBE_LOG_WARNING,
                          "%s/%s: not read, neither PNG, JPEG nor OpenEXR", search->path,
                          file->name);
        else if (!is_source(search->found, file))
            add_item(&list, "%s (%s)", file->name,
                     map                    ? "there is another one for this"
                     : file->content.unused ? file->content.unused
                                            : "names no map");
    }
    log_list(search, "ignored ", &list);
}

// ---------------------------------------------------------------------------------------------

lobe_result scenes_material_files_find(const char *folder, const lobe_host *host,
                                       material_files *files) {
    *files = (material_files){0};
    const folder_search search = {.path = folder, .host = host, .found = files};
    lobe_result status = list_files(&search);
    if (status != LOBE_OK)
        return status;
    parse_names(files);
    choose_sources(files);
    status = require_maps(&search);
    if (status == LOBE_OK)
        status = require_one_material(&search);
    if (status != LOBE_OK)
        return status;
    log_sources(&search);
    log_ignored(&search);
    return LOBE_OK;
}

void scenes_material_files_free(material_files *files) {
    for (size_t i = 0; i < files->count; i++)
        lobe_release(files->files[i].name);
    lobe_release(files->files);
    *files = (material_files){0};
}
