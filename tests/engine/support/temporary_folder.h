#ifndef TESTS_ENGINE_SUPPORT_TEMPORARY_FOLDER_H
#define TESTS_ENGINE_SUPPORT_TEMPORARY_FOLDER_H

#include <stddef.h>

/// A folder for the files of a test.
typedef struct temporary_folder {
    char path[128];
    char file[512]; ///< the last path that was asked for
} temporary_folder;

/// Fails the test if the folder cannot be created.
void temporary_folder_create(temporary_folder *folder);
/// The path of a file in it; valid until the next call.
const char *temporary_folder_file(temporary_folder *folder, const char *name);
/// The same of the only file there whose name ends so; asserts that there is one.
const char *temporary_folder_find(temporary_folder *folder, const char *ending);
/// The number of files in it, including hidden ones.
size_t temporary_folder_count(const temporary_folder *folder);
/// Removes the files and the folder.
void temporary_folder_remove(const temporary_folder *folder);

/// The folder of a test that runs IN_TEST_FOLDER; each test has its own.
extern temporary_folder test_folder;

int test_folder_setup(void **state);
int test_folder_teardown(void **state);

#define IN_TEST_FOLDER(test)                                                                       \
    cmocka_unit_test_setup_teardown(test, test_folder_setup, test_folder_teardown)

#endif
