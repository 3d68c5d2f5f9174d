#include "passes/renderer/tile_marking.h"

#include "passes/context/knob_values.h"
#include "passes/filters/material_shading.h"
#include "passes/maps/filtered_maps.h"
#include "passes/maps/tile_knobs.h"
#include "passes/renderer/shading.h"
#include "passes/renderer/surfaces/deferral.h"
#include "passes/renderer/surfaces/surfaces.h"
#include "passes/upload/material_maps.h"
#include "shaders/interface/frame.h"
#include "shaders/interface/map_tiles.h"

static bool marks_lobes(const device_material *material) {
    const lobe_grid grid = passes_lobe_grid(material);
    return passes_lobe_grid_varies(&grid);
}

static bool marks_map(const device_material *material, uint32_t map) {
    return map == MAP_NORMAL ? marks_lobes(material) : passes_filtered_map_is_image(material, map);
}

/// Bits MAP_...
static uint32_t marked_maps(const device_material *material) {
    uint32_t maps = 0;
    for (uint32_t map = 0; map < MAP_SHADING; map++)
        maps |= marks_map(material, map) ? 1u << map : 0;
    return maps;
}

/// Where a material's marks of a map are: with those of its lobes, or those of the image.
static uint32_t *place_of(const rendering *r, size_t material, uint32_t map) {
    const device_scene *scene = r->context.scene;
    uint32_t *first = r->renderer->first_marks;
    return map == MAP_NORMAL ? &first[material]
                             : &first[scene->scene->material_count +
                                      (size_t)scene->materials[material].maps[map].image];
}

static uint32_t width_of(const device_material *material, uint32_t map) {
    return map == MAP_NORMAL ? passes_lobe_grid(material).width : material->maps[map].width;
}

static uint32_t height_of(const device_material *material, uint32_t map) {
    return map == MAP_NORMAL ? passes_lobe_grid(material).height : material->maps[map].height;
}

/// Tells each material and image where its marks are; returns the number of all.
static uint32_t place_marks(rendering *r) {
    const device_scene *scene = r->context.scene;
    const size_t materials = scene->scene->material_count;
    uint32_t count = 0;
    for (size_t i = 0; i < materials + scene->scene->image_count; i++)
        r->renderer->first_marks[i] = NO_TILE_MARKS;
    for (size_t i = 0; i < materials; i++) {
        const device_material *material = &scene->materials[i];
        for (uint32_t map = 0; material->first_instance > 0 && map < MAP_SHADING; map++) {
            if (!marks_map(material, map) || *place_of(r, i, map) != NO_TILE_MARKS)
                continue;
            *place_of(r, i, map) = count;
            count += passes_map_tile_count(width_of(material, map), height_of(material, map));
        }
    }
    return count;
}

static lobe_resource clear_marks(lobe_graph *graph, uint32_t count) {
    lobe_pass *pass = lobe_graph_add_pass(graph, LOBE_PASS_TRANSFER, "clear");
    const lobe_buffer_description marks = {.name = "tile marks", .size = count * sizeof(uint32_t)};
    return lobe_pass_fill(pass, lobe_graph_buffer(graph, &marks), (lobe_range){0}, (float[4]){0});
}

// ---------------------------------------------------------------------------------------------
// Draws

static lobe_resource upload_maps(const rendering *r, uint32_t index) {
    static const uint wraps[] = {[LOBE_WRAP_REPEAT] = TILE_WRAP_REPEAT,
                                 [LOBE_WRAP_MIRROR] = TILE_WRAP_MIRROR,
                                 [LOBE_WRAP_CLAMP] = TILE_WRAP_CLAMP};
    const device_material *material = &r->context.scene->materials[index];
    struct tile_marking_constants maps[MAP_SHADING] = {{0}};
    for (uint32_t map = 0; map < MAP_SHADING; map++) {
        if (!marks_map(material, map))
            continue;
        const uint32_t own = map == MAP_NORMAL ? passes_lobe_grid(material).map : map;
        const uint32_t width = width_of(material, map), height = height_of(material, map);
        const lobe_sampler sampler = passes_filtered_map_sampler(&r->context, material, own);
        maps[map] = (struct tile_marking_constants){.wrap_u = wraps[sampler.wrap_u],
                                                    .wrap_v = wraps[sampler.wrap_v],
                                                    .width = width,
                                                    .height = height};
        maps[map].count =
            passes_map_tile_levels(width, height, *place_of(r, index, map), maps[map].levels);
    }
    return lobe_graph_upload(r->context.graph, "tiles", maps, sizeof maps);
}

/// What the draws of a pass share.
typedef struct marking {
    const rendering *r;
    lobe_pass *pass;
    bool deferred; ///< surfaces come from their picture
} marking;

static void draw_batch(const marking *m, uint32_t index, bool writes_depth) {
    const filter_context *context = &m->r->context;
    const device_scene *scene = context->scene;
    const instance_batch *batch = &m->r->renderer->draws.batches[index];
    const device_instance *drawn = &scene->instances[batch->instance];
    const device_material *material = &scene->materials[drawn->material];
    const struct draw_constants constants = {.first_instance = batch->first, .number = 1 + index};
    lobe_binding bindings[4 + MAP_SHADING] = {
        {.name = "material_block",
         .resource = lobe_graph_import_buffer(context->graph, material->constants)},
        {.name = "tile_block", .resource = upload_maps(m->r, drawn->material)},
        {.name = "instance_block", .resource = passes_batch_transforms(batch, DRAW_FOR_PICTURE)},
    };
    size_t count = 3;
    bindings[count++] = m->deferred
                            ? passes_surfaces_binding(&m->r->surfaces)
                            : (lobe_binding){.name = "vertex_block",
                                             .resource = passes_batch_vertices(context, batch)};
    passes_material_maps_bind(context, material, bindings + count);
    specialisation_list list = {.graph = context->graph};
    passes_material_specialise(material, &list);
    passes_knobs_specialise(context, &list);
    passes_specialise(&list, SPECIALISE_MIRRORED, batch->mirrored);
    passes_specialise(&list, SPECIALISE_DEFERRED, m->deferred);
    passes_specialise(&list, SPECIALISE_FILTERED_MAPS, marked_maps(material));
    lobe_draw draw = {
        .vertex_shader = "shading/shading.vert",
        .fragment_shader = "maps/tile_marking.frag",
        .cull = passes_batch_cull(scene, batch),
        .depth_test = true,
        .depth_write = writes_depth && !material->masked,
        .constants = &constants,
        .constants_size = sizeof constants,
        .specialisation = list.items,
        .specialisation_count = list.count,
        .bindings = bindings,
        .binding_count = count + MAP_SHADING,
    };
    if (m->deferred)
        passes_surfaces_set_draw(&draw);
    else
        passes_batch_set_counts(context, batch, DRAW_FOR_PICTURE, &draw);
    lobe_pass_draw(m->pass, &draw);
}

/// Whether a pass draws a batch: with surfaces, those that they hold or the others.
static bool is_drawn(const marking *m, uint32_t index) {
    const filter_context *context = &m->r->context;
    const device_scene *scene = context->scene;
    const instance_batch *batch = &m->r->renderer->draws.batches[index];
    if (!marked_maps(&scene->materials[scene->instances[batch->instance].material]))
        return false;
    return passes_surfaces_show(context, &m->r->surfaces, batch, m->deferred);
}

static lobe_resource own_depth(const rendering *r) {
    return lobe_graph_image(r->context.graph,
                            &(lobe_image_description){.name = "depth of tiles",
                                                      .format = LOBE_FORMAT_D32_FLOAT,
                                                      .width = r->width,
                                                      .height = r->height});
}

/// What surfaces hold hides the others, by the depth that shading goes on with.
static void attach_depth(marking *m, rendering *r, shading_targets *targets) {
    if (!r->surfaces.present) {
        (void)lobe_pass_depth(
            m->pass, &(lobe_attachment){.resource = own_depth(r), .load = LOBE_LOAD_CLEAR});
        return;
    }
    lobe_resource *depth = m->deferred ? &r->surfaces.numbers : &targets->depth;
    *depth =
        lobe_pass_depth(m->pass, &(lobe_attachment){.resource = *depth, .load = LOBE_LOAD_KEEP});
}

static bool draws_any(const marking *m) {
    for (uint32_t i = 0; i < m->r->renderer->draws.batch_count; i++)
        if (is_drawn(m, i))
            return true;
    return false;
}

/// The depth of surfaces is tested alone: shading has yet to draw what lies before them.
static void draw_batches(const marking *m) {
    const rendering *r = m->r;
    const bool over_surfaces = r->surfaces.present && !m->deferred;
    for (uint32_t i = 0; i < r->renderer->draws.batch_count; i++) {
        if (!is_drawn(m, i))
            continue;
        if (!over_surfaces || r->surfaces.open)
            draw_batch(m, i, true);
        if (over_surfaces && !passes_surfaces_hold(&r->context, &r->renderer->draws.batches[i]))
            draw_batch(m, i, false);
    }
}

static lobe_resource draw_marks(rendering *r, bool deferred, lobe_resource frame,
                                shading_targets *targets, lobe_resource marks) {
    marking m = {.r = r, .deferred = deferred};
    if (!draws_any(&m))
        return marks;
    lobe_graph *graph = r->context.graph;
    const lobe_resource layers =
        deferred ? r->surfaces.layers : passes_surfaces_absent(&r->context).layers;
    m.pass = lobe_graph_add_pass(graph, LOBE_PASS_RASTER, "tile_marking");
    attach_depth(&m, r, targets);
    lobe_pass_read(m.pass, &(lobe_binding){.name = "frame_block", .resource = frame});
    lobe_pass_read(m.pass, &(lobe_binding){.name = "surfaces", .resource = layers});
    passes_shared_knobs_bind(&r->context, m.pass);
    marks = lobe_pass_modify(m.pass, &(lobe_binding){.name = "mark_block", .resource = marks});
    draw_batches(&m);
    return marks;
}

static lobe_resource mark(rendering *r, shading_targets *targets, lobe_resource marks) {
    if (r->renderer->draws.batch_count == 0)
        return marks;
    const struct frame_constants constants =
        passes_frame_constants(&r->context, &passes_pixel_centre, r->width, r->height);
    const lobe_resource frame =
        lobe_graph_upload(r->context.graph, "frame", &constants, sizeof constants);
    r->surfaces = passes_surfaces(&r->context, &r->renderer->draws, frame, NULL, targets);
    if (r->surfaces.present)
        marks = draw_marks(r, true, frame, targets, marks);
    return r->surfaces.present && r->surfaces.holds_all
               ? marks
               : draw_marks(r, false, frame, targets, marks);
}

void passes_tile_marking(rendering *r, shading_targets *targets) {
    r->context.marks = NULL;
    r->surfaces = (seen_surfaces){0};
    if (!passes_wants_seen_tiles(&r->context))
        return;
    const uint32_t count = place_marks(r);
    if (count == 0)
        return;
    shading_targets own =
        passes_shading_targets_declare(r->context.graph, r->width, r->height, false);
    const lobe_resource marks = clear_marks(r->context.graph, count);
    r->tile_marks = (tile_marks){.marks = mark(r, targets ? targets : &own, marks),
                                 .first_marks = r->renderer->first_marks,
                                 .first_image_marks = r->renderer->first_marks +
                                                      r->context.scene->scene->material_count,
                                 .rebuild = r->parameters->rebuild};
    r->context.marks = &r->tile_marks;
}
