#ifndef SCENES_FORMAT_PATH_IN_FOLDER_H
#define SCENES_FORMAT_PATH_IN_FOLDER_H

#include <lobe/log.h>

/// "FOLDER/FILE", to lobe_release. NULL without memory; `log` gives the memory alone.
char *path_in_folder(const char *folder, const char *file, const lobe_log *log);

#endif
