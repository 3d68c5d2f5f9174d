#ifndef ENGINE_TEXT_H
#define ENGINE_TEXT_H

/// printf into fresh memory, to free() by the caller. NULL without memory.
char *engine_text(const char *format, ...) __attribute__((format(printf, 1, 2)));

#endif
