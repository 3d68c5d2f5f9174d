#ifndef SCENES_FORMAT_PATH_IN_FOLDER_H
#define SCENES_FORMAT_PATH_IN_FOLDER_H

#include <lobe/host.h>

/// "FOLDER/FILE", to lobe_release. NULL without memory; `host` gives the memory alone.
char *scenes_path_in_folder(const char *folder, const char *file, const lobe_host *host);

#endif
