#ifndef SCENES_FORMAT_LIBRARY_MEMORY_H
#define SCENES_FORMAT_LIBRARY_MEMORY_H

#include <lobe/log.h>

#include "third_party/library_memory.h"

/// The log's allocator, as wrapped libraries ask for memory.
library_memory scene_library_memory(const lobe_log *log);

#endif
