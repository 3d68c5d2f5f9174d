#include "tests/passes/filters/displaced/kept_reliefs.h"

#include "tests/passes/support/fixture.h"

#include "tests/engine/support/temporary_folder.h"

static temporary_folder folder;

int kept_reliefs_create(void **state) {
    const int failed = fixture_create(state);
    if (failed)
        return failed;
    fixture *f = *state;
    temporary_folder_create(&folder);
    f->fits_cache = folder.path;
    return 0;
}

int kept_reliefs_destroy(void **state) {
    temporary_folder_remove(&folder);
    return fixture_destroy(state);
}
