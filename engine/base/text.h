#ifndef ENGINE_BASE_TEXT_H
#define ENGINE_BASE_TEXT_H

#include <stdbool.h>

#include <lobe/allocator.h>

#include "engine/base/bytes.h"

/// A growing string. Initialise `bytes.allocator`, and everything else with zero.
typedef struct engine_text_builder {
    engine_bytes bytes;
    bool failed; ///< out of memory; nothing is added any more
} engine_text_builder;

/// Appends what printf would print.
void engine_text_add(engine_text_builder *builder, const char *format, ...)
    __attribute__((format(printf, 2, 3)));
/// Returns the text, which the caller frees with lobe_release, and empties the builder. NULL if out
/// of memory.
char *engine_text_finish(engine_text_builder *builder);

/// What printf would print, which the caller frees with lobe_release. NULL if out of memory.
char *engine_text(const lobe_allocator *allocator, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

#endif
