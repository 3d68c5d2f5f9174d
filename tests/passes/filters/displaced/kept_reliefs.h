#ifndef TESTS_PASSES_FILTERS_DISPLACED_KEPT_RELIEFS_H
#define TESTS_PASSES_FILTERS_DISPLACED_KEPT_RELIEFS_H

/// Group set-up and tear-down for pictures of few reliefs from many directions: a fixture that
/// keeps fitted maps in a folder, so that each relief is fitted once.
int kept_reliefs_create(void **state);
int kept_reliefs_destroy(void **state);

#endif
