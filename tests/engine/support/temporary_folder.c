#include "tests/engine/support/temporary_folder.h"

#include <dirent.h>
#include <glob.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "tests/engine/support/cmocka_all.h"

void temporary_folder_create(temporary_folder *folder) {
    snprintf(folder->path, sizeof folder->path, "/tmp/lobe-test-XXXXXX");
    assert_non_null(mkdtemp(folder->path));
}

const char *temporary_folder_file(temporary_folder *folder, const char *name) {
    snprintf(folder->file, sizeof folder->file, "%s/%s", folder->path, name);
    return folder->file;
}

const char *temporary_folder_find(temporary_folder *folder, const char *ending) {
    char pattern[sizeof folder->file];
    snprintf(pattern, sizeof pattern, "%s/*%s", folder->path, ending);
    glob_t found;
    assert_int_equal(glob(pattern, 0, NULL, &found), 0);
    assert_int_equal(found.gl_pathc, 1);
    snprintf(folder->file, sizeof folder->file, "%s", found.gl_pathv[0]);
    globfree(&found);
    return folder->file;
}

static size_t visit(const temporary_folder *folder, int remove_files) {
    DIR *directory = opendir(folder->path);
    assert_non_null(directory);
    size_t count = 0;
    for (struct dirent *entry; (entry = readdir(directory)) != NULL;) {
        if (strcmp(entry->d_name, ".") == 0 || strcmp(entry->d_name, "..") == 0)
            continue;
        count++;
        if (remove_files)
            unlinkat(dirfd(directory), entry->d_name, 0);
    }
    closedir(directory);
    return count;
}

size_t temporary_folder_count(const temporary_folder *folder) {
    return visit(folder, 0);
}

void temporary_folder_remove(const temporary_folder *folder) {
    visit(folder, 1);
    rmdir(folder->path);
}

temporary_folder test_folder;

int test_folder_setup(void **state) {
    (void)state;
    temporary_folder_create(&test_folder);
    return 0;
}

int test_folder_teardown(void **state) {
    (void)state;
    temporary_folder_remove(&test_folder);
    return 0;
}
