// Preloaded into sanitized tests: drivers and layers stay loaded to the end, so that a leak report
// can name them and leaks.supp can tell their leaks from ours.

int dlclose(void *module);

int dlclose(void *module) {
    (void)module;
    return 0;
}
