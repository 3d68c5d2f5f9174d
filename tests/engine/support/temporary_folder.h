#ifndef TESTS_ENGINE_SUPPORT_TEMPORARY_FOLDER_H
#define TESTS_ENGINE_SUPPORT_TEMPORARY_FOLDER_H

#include <stddef.h>

/// A folder for the files of a test.
typedef struct temporary_folder {
    char path[128];
    char file[512]; ///< what temporary_folder_file gave last
} temporary_folder;

/// Fails the test where no folder can be made.
void temporary_folder_create(temporary_folder *folder);
/// The path of a file in it; valid until the next call.
const char *temporary_folder_file(temporary_folder *folder, const char *name);
/// Files in it, hidden ones too.
size_t temporary_folder_count(const temporary_folder *folder);
/// Removes the files and the folder.
void temporary_folder_remove(const temporary_folder *folder);

/// The folder of a test that runs IN_TEST_FOLDER, of its own each.
extern temporary_folder test_folder;

int test_folder_setup(void **state);
int test_folder_teardown(void **state);

#define IN_TEST_FOLDER(test)                                                                       \
    cmocka_unit_test_setup_teardown(test, test_folder_setup, test_folder_teardown)

#endif
