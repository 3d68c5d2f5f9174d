// Preloaded into tests: keeps drivers and layers loaded until exit. Leak reports can then name
// them, so that leaks.supp can distinguish their leaks from ours; and NVIDIA's driver (580) cannot
// be loaded more than 29 times by a process.

int dlclose(void *module);

int dlclose(void *module) {
    (void)module;
    return 0;
}
