#include <stdio.h>
#include <string.h>

#include "scenes/gltf/gltf.h"

void scenes_gltf_note_unsupported(gltf_import *import, const char *feature) {
    gltf_notes *notes = &import->notes;
    for (size_t i = 0; i < notes->unsupported_count; i++) {
        if (strcmp(notes->unsupported[i], feature) == 0)
            return;
    }
    if (notes->unsupported_count < sizeof notes->unsupported / sizeof *notes->unsupported)
        notes->unsupported[notes->unsupported_count++] = feature;
}

static void report_unsupported(const gltf_import *import) {
    const gltf_notes *notes = &import->notes;
    char list[768] = "";
    size_t length = 0;
    for (size_t i = 0; i < notes->unsupported_count; i++) {
        int added = snprintf(list + length, sizeof list - length, "%s%.64s", i > 0 ? ", " : "",
                             notes->unsupported[i]);
        if (added < 0 || (size_t)added >= sizeof list - length)
            break;
        length += (size_t)added;
    }
    if (notes->unsupported_count > 0)
        lobe_host_log(import->host, LOBE_LOG_WARNING, "%s: not supported and left out: %s",
                      import->path, list);
}

static void report_count(const gltf_import *import, size_t count, const char *what) {
    if (count > 0)
        lobe_host_log(import->host, LOBE_LOG_WARNING, "%s: %zu %s", import->path, count, what);
}

void scenes_gltf_report_notes(const gltf_import *import) {
    const gltf_notes *notes = &import->notes;
    report_unsupported(import);
    report_count(import, notes->degenerate_triangles, "degenerate triangles dropped");
    report_count(import, notes->repaired_normals, "normals of length zero recomputed");
    report_count(import, notes->repaired_tangents,
                 "tangents without a direction; recomputed all tangents of their meshes");
    report_count(import, notes->clamped_factors, "material factors clamped to their ranges");
    report_count(import, notes->flat_instances,
                 "instances left out because they are scaled to nothing");
    report_count(import, notes->unit_weights,
                 "vertices whose joint weights do not sum to 1; normalised");
    report_count(import, notes->unbound_vertices,
                 "vertices of skins without joint weights; bound to the first joint");
    report_count(import, notes->missing_coordinates,
                 "meshes lack texture coordinates that their material uses");
}
