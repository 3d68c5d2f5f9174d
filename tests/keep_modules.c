// Preloaded into sanitized tests: keeps drivers and layers loaded until exit, so that leak reports
// can name them and leaks.supp can distinguish their leaks from ours.

int dlclose(void *module);

int dlclose(void *module) {
    (void)module;
    return 0;
}
