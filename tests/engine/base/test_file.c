#include "tests/engine/support/cmocka_all.h"

#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <lobe/file.h>

#include "tests/engine/support/log_recorder.h"
#include "tests/engine/support/temporary_folder.h"

static void expect_content(const char *path, const void *expected, size_t expected_size) {
    uint8_t *data;
    size_t size;
    assert_int_equal(lobe_file_read(path, NULL, NULL, &data, &size), LOBE_OK);
    assert_int_equal(size, expected_size);
    assert_memory_equal(data, expected, size);
    assert_int_equal(data[size], 0);
    lobe_release(data);
}

static void what_was_written_is_read(void **state) {
    (void)state;
    uint8_t bytes[70000];
    for (size_t index = 0; index < sizeof bytes; index++)
        bytes[index] = (uint8_t)(index * index >> 3);
    const char *path = temporary_folder_file(&test_folder, "bytes");
    const size_t sizes[] = {1, 4096, 65535, 65536, sizeof bytes};
    for (size_t index = 0; index < sizeof sizes / sizeof sizes[0]; index++) {
        assert_int_equal(lobe_file_write(path, bytes, sizes[index], NULL), LOBE_OK);
        expect_content(path, bytes, sizes[index]);
    }
    assert_int_equal(temporary_folder_count(&test_folder), 1);
}

static void an_empty_file_has_data(void **state) {
    (void)state;
    const char *path = temporary_folder_file(&test_folder, "empty");
    uint8_t *data;
    size_t size;
    assert_int_equal(lobe_file_write(path, NULL, 0, NULL), LOBE_OK);
    assert_int_equal(lobe_file_read(path, NULL, NULL, &data, &size), LOBE_OK);
    assert_int_equal(size, 0);
    assert_non_null(data);
    lobe_release(data);
}

static void a_file_without_a_known_size_is_read_to_its_end(void **state) {
    (void)state;
    uint8_t *data;
    size_t size;
    assert_int_equal(lobe_file_read("/proc/self/maps", NULL, NULL, &data, &size), LOBE_OK);
    assert_true(size > 100);
    assert_int_equal(data[size - 1], '\n');
    assert_int_equal(data[size], 0);
    lobe_release(data);
}

static void expect_read_error(const char *path, lobe_result expected) {
    log_recorder recorder;
    log_recorder_start(&recorder);
    uint8_t *data;
    size_t size;
    assert_int_equal(lobe_file_read(path, NULL, &recorder.host, &data, &size), expected);
    assert_null(data);
    assert_int_equal(recorder.errors, 1);
    assert_non_null(strstr(recorder.last_error, path));
}

static void what_cannot_be_read_is_named(void **state) {
    (void)state;
    expect_read_error(temporary_folder_file(&test_folder, "missing"), LOBE_ERROR_NOT_FOUND);
    expect_read_error(test_folder.path, LOBE_ERROR_READ);
    expect_read_error("/dev/zero", LOBE_ERROR_READ);
}

static void a_pipe_is_not_waited_for(void **state) {
    (void)state;
    const char *path = temporary_folder_file(&test_folder, "pipe");
    assert_int_equal(mkfifo(path, 0600), 0);
    expect_read_error(path, LOBE_ERROR_READ);
}

static void the_referring_file_is_named_too(void **state) {
    (void)state;
    log_recorder recorder;
    log_recorder_start(&recorder);
    const char *path = temporary_folder_file(&test_folder, "missing");
    uint8_t *data;
    size_t size;
    assert_int_equal(lobe_file_read(path, "scene.gltf", &recorder.host, &data, &size),
                     LOBE_ERROR_NOT_FOUND);
    assert_ptr_equal(strstr(recorder.last_error, "scene.gltf: "), recorder.last_error);
    assert_non_null(strstr(recorder.last_error, path));
}

static void a_sparse_giant_is_refused(void **state) {
    (void)state;
    const char *path = temporary_folder_file(&test_folder, "giant");
    assert_int_equal(lobe_file_write(path, "x", 1, NULL), LOBE_OK);
    if (truncate(path, (off_t)LOBE_FILE_MAXIMUM_SIZE + 1) != 0)
        skip(); // a file system without large files
    expect_read_error(path, LOBE_ERROR_LIMIT);
}

static void expect_write_error(const char *path) {
    log_recorder recorder;
    log_recorder_start(&recorder);
    assert_int_equal(lobe_file_write(path, "new", 3, &recorder.host), LOBE_ERROR_WRITE);
    assert_int_equal(recorder.errors, 1);
    assert_non_null(strstr(recorder.last_error, path));
}

static void what_cannot_be_written_is_named_and_nothing_is_left(void **state) {
    (void)state;
    expect_write_error(temporary_folder_file(&test_folder, "no folder/file"));
    expect_write_error(test_folder.path);
    expect_write_error("/dev/full");
    char name[400];
    memset(name, 'n', sizeof name);
    name[sizeof name - 1] = '\0';
    expect_write_error(temporary_folder_file(&test_folder, name));
    assert_int_equal(temporary_folder_count(&test_folder), 0);
}

/// A program that is killed leaves nothing half-written, neither with a name nor with another.
static void a_killed_writer_leaves_nothing(void **state) {
    (void)state;
    enum { SIZE = 1 << 20 };
    static const char data[SIZE];
    const int unnamed = open(test_folder.path, O_WRONLY | O_TMPFILE, 0600);
    if (unnamed < 0)
        skip(); // the file system has no files without names
    close(unnamed);
    const char *path = temporary_folder_file(&test_folder, "large");
    const pid_t writer = fork();
    assert_true(writer >= 0);
    if (writer == 0) {
        // The signal that comes with this limit kills.
        signal(SIGXFSZ, SIG_DFL);
        setrlimit(RLIMIT_CORE, &(struct rlimit){0, 0});
        setrlimit(RLIMIT_FSIZE, &(struct rlimit){SIZE / 2, SIZE / 2});
        lobe_file_write(path, data, SIZE, NULL);
        _exit(0);
    }
    int status;
    assert_int_equal(waitpid(writer, &status, 0), writer);
    assert_true(WIFSIGNALED(status));
    assert_int_equal(temporary_folder_count(&test_folder), 0);
}

static void a_name_as_long_as_names_may_be_is_fine(void **state) {
    (void)state;
    char name[256];
    memset(name, 'n', sizeof name);
    name[255] = '\0';
    const char *path = temporary_folder_file(&test_folder, name);
    assert_int_equal(lobe_file_write(path, "long", 4, NULL), LOBE_OK);
    expect_content(path, "long", 4);
}

static void a_link_keeps_pointing_at_the_new_content(void **state) {
    (void)state;
    char target[512];
    snprintf(target, sizeof target, "%s", temporary_folder_file(&test_folder, "target"));
    assert_int_equal(lobe_file_write(target, "old", 3, NULL), LOBE_OK);
    const char *link = temporary_folder_file(&test_folder, "link");
    assert_int_equal(symlink(target, link), 0);
    assert_int_equal(lobe_file_write(link, "new", 3, NULL), LOBE_OK);
    struct stat status;
    assert_int_equal(lstat(link, &status), 0);
    assert_true(S_ISLNK(status.st_mode));
    expect_content(target, "new", 3);
    assert_int_equal(temporary_folder_count(&test_folder), 2);
}

static void a_device_is_written_to_and_stays(void **state) {
    (void)state;
    assert_int_equal(lobe_file_write("/dev/null", "gone", 4, NULL), LOBE_OK);
    struct stat status;
    assert_int_equal(stat("/dev/null", &status), 0);
    assert_true(S_ISCHR(status.st_mode));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        IN_TEST_FOLDER(what_was_written_is_read),
        IN_TEST_FOLDER(an_empty_file_has_data),
        IN_TEST_FOLDER(a_file_without_a_known_size_is_read_to_its_end),
        IN_TEST_FOLDER(what_cannot_be_read_is_named),
        IN_TEST_FOLDER(a_pipe_is_not_waited_for),
        IN_TEST_FOLDER(the_referring_file_is_named_too),
        IN_TEST_FOLDER(a_sparse_giant_is_refused),
        IN_TEST_FOLDER(what_cannot_be_written_is_named_and_nothing_is_left),
        IN_TEST_FOLDER(a_killed_writer_leaves_nothing),
        IN_TEST_FOLDER(a_name_as_long_as_names_may_be_is_fine),
        IN_TEST_FOLDER(a_link_keeps_pointing_at_the_new_content),
        IN_TEST_FOLDER(a_device_is_written_to_and_stays),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
