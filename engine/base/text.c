#include "engine/base/text.h"

#include <stdarg.h>
#include <stdio.h>

static void add(engine_text_builder *builder, const char *format, va_list arguments) {
    engine_bytes *bytes = &builder->bytes;
    va_list again;
    va_copy(again, arguments);
    const int length = vsnprintf(NULL, 0, format, arguments);
    builder->failed = builder->failed || length < 0 ||
                      !engine_bytes_reserve(bytes, bytes->size + (size_t)length + 1);
    if (!builder->failed) {
        vsnprintf((char *)bytes->data + bytes->size, (size_t)length + 1, format, again);
        bytes->size += (size_t)length;
    }
    va_end(again);
}

void engine_text_add(engine_text_builder *builder, const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    add(builder, format, arguments);
    va_end(arguments);
}

char *engine_text_finish(engine_text_builder *builder) {
    engine_text_add(builder, "%s", ""); // so that even an empty text has its terminator
    char *text = builder->failed ? NULL : (char *)builder->bytes.data;
    if (builder->failed)
        engine_bytes_free(&builder->bytes);
    *builder = (engine_text_builder){.bytes.allocator = builder->bytes.allocator};
    return text;
}

char *engine_text(const lobe_allocator *allocator, const char *format, ...) {
    engine_text_builder builder = {.bytes.allocator = allocator};
    va_list arguments;
    va_start(arguments, format);
    add(&builder, format, arguments);
    va_end(arguments);
    return engine_text_finish(&builder);
}
