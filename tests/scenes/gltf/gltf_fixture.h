#ifndef TESTS_SCENES_GLTF_GLTF_FIXTURE_H
#define TESTS_SCENES_GLTF_GLTF_FIXTURE_H

// cmocka.h needs these before it.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <stdbool.h>

#include <lobe/scene.h>

#include "third_party/tinygltf.h"

/// A temporary folder in which a test writes files and opens them, with the log's messages.
typedef struct gltf_fixture {
    char folder[64];
    size_t errors, warnings, notices; // of the last open
    char error[1024];
    char warnings_text[4096]; // all lines
} gltf_fixture;

int gltf_fixture_setup(void **state);
int gltf_fixture_teardown(void **state);

/// The path of a file in the folder, valid until the next call.
const char *gltf_fixture_path(const gltf_fixture *fixture, const char *name);

void gltf_fixture_write(const gltf_fixture *fixture, const char *name, const void *bytes,
                        size_t size);
void gltf_fixture_write_text(const gltf_fixture *fixture, const char *name, const char *text);
/// `binary` may be NULL: no binary chunk.
void gltf_fixture_write_glb(const gltf_fixture *fixture, const char *name, const char *json,
                            const void *binary, size_t size);

/// Opens a file in the folder. Asserts that success comes with a scene and without an error
/// message, failure without a scene and with exactly one message, which names the file.
lobe_result gltf_fixture_open(gltf_fixture *fixture, const char *name, lobe_scene **scene);
/// The same for any path.
lobe_result gltf_fixture_open_path(gltf_fixture *fixture, const char *path, lobe_scene **scene);
/// Asserts success.
lobe_scene *gltf_fixture_must_open(gltf_fixture *fixture, const char *name);
/// Asserts the failure, and that its message contains `cause`.
void gltf_fixture_must_fail(gltf_fixture *fixture, const char *name, lobe_result result,
                            const char *cause);

/// One vertex attribute, or the indices (name NULL).
typedef struct gltf_fixture_accessor {
    const char *name;
    gltf_component component;
    const char *type; ///< "VEC3"
    bool normalised;
    size_t count;
    const void *data;
    size_t size; ///< bytes
} gltf_fixture_accessor;

typedef struct gltf_fixture_mesh {
    const gltf_fixture_accessor *accessors;
    size_t accessor_count;
    gltf_mode mode;        ///< 0: triangles
    const char *primitive; ///< further members of the primitive, each after a comma; NULL: none
    const char *node;      ///< the same for the node
    const char *root;      ///< the same for the document
} gltf_fixture_mesh;

/// Writes a GLB file with one primitive of one node.
void gltf_fixture_write_mesh(const gltf_fixture *fixture, const char *name,
                             const gltf_fixture_mesh *mesh);

/// The triangle (0, 0, 0), (1, 0, 0), (0, 1, 0).
extern const gltf_fixture_accessor gltf_fixture_triangle;

void gltf_fixture_assert_near(const float *values, const float *expected, size_t count,
                              float tolerance);

#endif
