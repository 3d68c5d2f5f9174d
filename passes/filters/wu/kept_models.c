#include "passes/filters/wu/kept_models.h"

#include "passes/context/digest.h"
#include "passes/context/fit_work.h"
#include "passes/maps/kept/record.h"
#include "passes/maps/kept/texels.h"

/// Increment it whenever the same relief gets other models: old files are then no longer found.
enum { MODELS_FILE_VERSION = 4 };

static uint64_t kind_digest(const wu_kind *kind) {
    const uint64_t numbers[] = {kind->lobes,   kind->angular, kind->patches, kind->points,
                                kind->bounces, kind->printed, kind->mirrors};
    return passes_digest_bytes(MODELS_FILE_VERSION, numbers, sizeof numbers);
}

static uint64_t scale_digest(const device_material *material, uint64_t digest) {
    const float *scale = &material->material->height_scale;
    return passes_digest_bytes(digest, scale, sizeof *scale);
}

static uint64_t key(const filter_context *context, uint32_t index, const void *user) {
    const device_material *material = &context->scene->materials[index];
    const uint64_t digest = scale_digest(material, kind_digest(user));
    return passes_kept_map_digest(&material->maps[MAP_HEIGHT], digest);
}

/// All in one.
static kept_tile tile(const filter_context *context, uint32_t index, const void *user,
                      uint32_t number) {
    (void)number;
    const device_material *material = &context->scene->materials[index];
    kept_tile tile = {.layout = {.what = "models", .buffer_count = 3},
                      .parts = passes_wu_part_count(material, user)};
    passes_wu_model_bytes(&material->maps[MAP_HEIGHT], user, tile.layout.buffer_bytes);
    return tile;
}

lobe_result passes_kept_models_prepare(const filter_context *context, uint32_t index,
                                       const wu_kind *kind, void **slot) {
    const device_material *material = &context->scene->materials[index];
    if (!context->work || context->work->is_dry || !passes_has_relief(material) ||
        !passes_wu_fits(material))
        return LOBE_OK;
    const uint64_t scale = scale_digest(material, material->parameter_version);
    const kept_subject subject = {
        .kind = kind_digest(kind),
        .inputs = passes_digest(scale, material->texel_versions[MAP_HEIGHT]),
        .has_texels = passes_kept_has_texels(context, &material->maps[MAP_HEIGHT]),
        .tile_count = 1,
        .tile = tile,
        .key = key,
        .user = kind,
    };
    return passes_kept_prepare(context, index, &subject, slot);
}

bool passes_kept_models_build(const filter_context *context, uint32_t index, const wu_kind *kind,
                              const void *prepared, wu_models *models) {
    const stored_content *stored = passes_kept_stored(context, prepared, 0);
    if (stored) {
        *models = passes_wu_models_declare(context, index, kind);
        models->cells = lobe_graph_import_buffer(context->graph, stored->buffers[0]);
        models->ratios = lobe_graph_import_buffer(context->graph, stored->buffers[1]);
        models->whole = lobe_graph_import_buffer(context->graph, stored->buffers[2]);
        return true;
    }
    bool in_parts;
    const uint32_t parts = passes_kept_parts(context, prepared, &in_parts);
    *models = passes_wu_models(context, index, kind, parts, in_parts);
    const lobe_resource buffers[] = {models->cells, models->ratios, models->whole};
    return passes_kept_built(context, prepared, NULL, buffers);
}
