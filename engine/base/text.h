#ifndef ENGINE_BASE_TEXT_H
#define ENGINE_BASE_TEXT_H

#include <stdbool.h>

#include <lobe/allocator.h>

#include "engine/base/bytes.h"

/// A text that grows. All zero, but for the allocator of its bytes: empty.
typedef struct engine_text_builder {
    engine_bytes bytes;
    bool failed; ///< memory has run out: nothing is added any more
} engine_text_builder;

/// Adds what printf would print.
void engine_text_add(engine_text_builder *builder, const char *format, ...)
    __attribute__((format(printf, 2, 3)));
/// Gives the text, for the caller to lobe_release, and empties the builder. NULL without memory.
char *engine_text_finish(engine_text_builder *builder);

/// printf into fresh memory, for the caller to lobe_release. NULL without memory.
char *engine_text(const lobe_allocator *allocator, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

#endif
