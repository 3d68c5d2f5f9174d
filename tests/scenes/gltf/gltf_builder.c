#include "tests/scenes/gltf/gltf_builder.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void append(char *text, size_t size, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

static void append(char *text, size_t size, const char *format, ...) {
    const size_t length = strlen(text);
    va_list arguments;
    va_start(arguments, format);
    const int added = vsnprintf(text + length, size - length, format, arguments);
    va_end(arguments);
    assert_true(added >= 0 && (size_t)added < size - length);
}

unsigned gltf_builder_add(gltf_builder *builder, gltf_component component, const char *type,
                          bool normalised, size_t count, const void *data, size_t size) {
    const char *comma = builder->count > 0 ? "," : "";
    const size_t padded = (size + 3) / 4 * 4;
    assert_true(builder->size + padded <= sizeof builder->binary);
    memcpy(builder->binary + builder->size, data, size);
    append(builder->views, sizeof builder->views,
           "%s{\"buffer\":0,\"byteOffset\":%zu,\"byteLength\":%zu}", comma, builder->size, size);
    append(builder->accessors, sizeof builder->accessors,
           "%s{\"bufferView\":%u,\"componentType\":%d,\"type\":\"%s\",\"count\":%zu%s}", comma,
           builder->count, component, type, count, normalised ? ",\"normalized\":true" : "");
    builder->size += padded;
    return builder->count++;
}

static size_t channels_of(const char *type) {
    return strcmp(type, "SCALAR") == 0 ? 1
           : strcmp(type, "MAT4") == 0 ? 16
                                       : (size_t)(type[3] - '0');
}

unsigned gltf_builder_add_floats(gltf_builder *builder, const char *type, size_t count,
                                 const float *values) {
    return gltf_builder_add(builder, GLTF_FLOAT, type, false, count, values,
                            count * channels_of(type) * sizeof *values);
}

void gltf_builder_write(const gltf_builder *builder, const gltf_fixture *fixture, const char *name,
                        const char *members) {
    const size_t room = sizeof builder->views + sizeof builder->accessors + strlen(members) + 256;
    char *json = malloc(room);
    assert_non_null(json);
    json[0] = '\0';
    append(json, room,
           "{\"asset\":{\"version\":\"2.0\"},\"buffers\":[{\"byteLength\":%zu}],"
           "\"bufferViews\":[%s],\"accessors\":[%s]%s}",
           builder->size, builder->views, builder->accessors, members);
    gltf_fixture_write_glb(fixture, name, json, builder->binary, builder->size);
    free(json);
}
