#include <lobe/lobe.h>

const char *lobe_version(void) {
    return LOBE_VERSION;
}
