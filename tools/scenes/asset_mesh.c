#include "tools/scenes/asset_mesh.h"

#include <errno.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include <lobe/file.h>

#include "scenes/format/library_memory.h"
#include "scenes/mesh/mesh.h"
#include "third_party/gzip.h"
#include "tools/scenes/box_projection.h"
#include "tools/scenes/mesh_formats.h"

// More text than any mesh needs: the size stated in a compressed file is not trusted.
#define MAXIMUM_UNPACKED ((size_t)1 << 29)

// For messages: how to give the folder of assets.
#define HOW_TO_GIVE "--assets DIR or LOBE_ASSETS"

static bool is_absent(const char *path) {
    return access(path, F_OK) != 0 && errno != EACCES;
}

static lobe_result read_file(const asset_mesh *wanted, const char *path, const lobe_host *host,
                             uint8_t **bytes, size_t *size) {
    if (is_absent(path))
        return lobe_host_fail(
            host, LOBE_ERROR_NOT_FOUND,
            "scene '%s': %s: no such file; the folder of assets must contain it (%s)",
            wanted->scene, path, HOW_TO_GIVE);
    uint8_t *packed = NULL;
    lobe_result status = lobe_file_read(path, NULL, host, &packed, size);
    *bytes = packed;
    if (status || !third_party_gzip_recognise(packed, *size))
        return status;
    char message[GZIP_MESSAGE_SIZE];
    library_memory memory = scenes_library_memory(host);
    bool done =
        third_party_gzip_unpack(packed, *size, MAXIMUM_UNPACKED, &memory, bytes, size, message);
    lobe_release(packed);
    const lobe_result failure = memory.failed ? LOBE_ERROR_OUT_OF_MEMORY : LOBE_ERROR_MALFORMED;
    return done ? LOBE_OK : lobe_host_fail(host, failure, "%s: %s", path, message);
}

static lobe_result read_mesh(const char *path, const uint8_t *bytes, size_t size,
                             const lobe_host *host, lobe_mesh *mesh) {
    bool is_ply =
        size >= 4 && memcmp(bytes, "ply", 3) == 0 && (bytes[3] == '\n' || bytes[3] == '\r');
    return is_ply ? ply_read(bytes, size, path, host, mesh)
                  : javascript_mesh_read((const char *)bytes, size, path, host, mesh);
}

static lobe_result load_file(const asset_mesh *wanted, const char *assets, const lobe_host *host,
                             lobe_mesh *mesh) {
    const size_t path_size = strlen(assets) + strlen(wanted->file) + 2;
    char *path = lobe_allocate(lobe_host_allocator(host), path_size, 1);
    uint8_t *bytes = NULL;
    size_t size = 0;
    if (!path)
        return lobe_host_fail(host, LOBE_ERROR_OUT_OF_MEMORY, "scene '%s': out of memory",
                              wanted->scene);
    snprintf(path, path_size, "%s/%s", assets, wanted->file);
    lobe_result status = read_file(wanted, path, host, &bytes, &size);
    if (!status)
        status = read_mesh(path, bytes, size, host, mesh);
    lobe_release(bytes);
    lobe_release(path);
    return status;
}

// A mesh may be flat and horizontal: its height, which is 0, cannot be scaled.
static void stand_up(const asset_mesh *wanted, lobe_mesh *mesh) {
    scenes_mesh_compute_bounds(mesh);
    const float *low = mesh->minimum, *high = mesh->maximum;
    double height = (double)high[1] - low[1];
    double scale = height > 0 ? wanted->height / height : 1;
    const double origin[3] = {((double)low[0] + high[0]) / 2, low[1],
                              ((double)low[2] + high[2]) / 2};
    for (size_t i = 0; i < mesh->vertex_count; i++)
        for (int axis = 0; axis < 3; axis++) {
            float *p = &mesh->vertices[i].position[axis];
            *p = (float)((*p - origin[axis]) * scale);
        }
}

lobe_result asset_mesh_load(const asset_mesh *wanted, const char *assets, const lobe_host *host,
                            lobe_mesh *mesh) {
    *mesh = (lobe_mesh){0};
    if (!assets)
        return lobe_host_fail(host, LOBE_ERROR_NOT_FOUND,
                              "scene '%s': no folder of assets was given; it must contain %s (%s)",
                              wanted->scene, wanted->file, HOW_TO_GIVE);
    lobe_result status = load_file(wanted, assets, host, mesh);
    if (status)
        return status;
    stand_up(wanted, mesh);
    status = box_projection_apply(mesh, wanted->tile, host);
    if (status)
        scenes_mesh_free(mesh);
    return status;
}
