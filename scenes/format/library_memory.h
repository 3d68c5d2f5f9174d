#ifndef SCENES_FORMAT_LIBRARY_MEMORY_H
#define SCENES_FORMAT_LIBRARY_MEMORY_H

#include <lobe/host.h>

#include "third_party/library_memory.h"

/// The log's allocator, as wrapped libraries ask for memory.
library_memory scenes_library_memory(const lobe_host *host);

#endif
