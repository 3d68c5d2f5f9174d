#include "passes/maps/kept/texels.h"

#include "passes/context/digest.h"

bool passes_kept_has_texels(const filter_context *context, const device_map *map) {
    return !context->scene->scene->images[map->use->image].on_device && map->texels->texels &&
           lobe_format_size(map->format) > 0;
}

uint64_t passes_kept_map_digest(const device_map *map, uint64_t digest) {
    const lobe_texture_use *use = map->use;
    const uint64_t numbers[] = {map->width,
                                map->height,
                                (uint64_t)map->format,
                                (uint64_t)map->normals,
                                (uint64_t)use->texture_coordinates,
                                use->nearest,
                                (uint64_t)use->wrap_u,
                                (uint64_t)use->wrap_v};
    digest = passes_digest_bytes(digest, numbers, sizeof numbers);
    digest = passes_digest_bytes(digest, use->transform, sizeof use->transform);
    return passes_digest_bytes(digest, map->texels->texels,
                               (size_t)map->width * map->height * lobe_format_size(map->format));
}
