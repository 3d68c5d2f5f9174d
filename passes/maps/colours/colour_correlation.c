#include "passes/maps/colours/colour_correlation.h"

#include <stdio.h>
#include <string.h>

#include "passes/context/fit_work.h"
#include "passes/maps/base_maps.h"
#include "passes/upload/colours/mask_alpha.h"
#include "passes/upload/material_maps.h"
#include "shaders/interface/colours/colour_correlation.h"
#include "shaders/interface/material.h"

static const uint32_t inputs[] = {MAP_BASE_COLOUR, MAP_NORMAL, MAP_WIDTH};

// ---------------------------------------------------------------------------------------------
// What the host knows

bool passes_colours_lie_like_normals(const device_material *material) {
    return passes_device_map_has_texels(&material->maps[MAP_BASE_COLOUR]) &&
           passes_device_map_has_texels(&material->maps[MAP_NORMAL]) &&
           !(material->metallic_varies && passes_widths_lie_apart(material)) &&
           passes_lobe_grid_shares_coordinates(material, MAP_BASE_COLOUR);
}

/// Whether the host knows when the maps' texels change, which an answer of earlier ones does not
/// outlive.
static bool are_announced(const device_scene *scene, const device_material *material) {
    for (int i = 0; i < 3; i++) {
        const lobe_texture_use *use = material->maps[inputs[i]].use;
        if (use && scene->scene->images[use->image].on_device)
            return false;
    }
    return true;
}

/// What the answer depends on, without the answer.
static colour_correlation question_of(const device_scene *scene, const device_material *material) {
    colour_correlation question = {.asked = true,
                                   .images = {-1, -1, -1},
                                   .normal_scale = material->material->normal_scale,
                                   .height_scale = material->height_scale,
                                   .metallic = material->metallic};
    if (material->masked) {
        question.alpha = passes_mask_alpha(scene, material);
        question.cutoff = material->material->alpha_cutoff;
    }
    for (int i = 0; i < 3; i++) {
        if (material->maps[inputs[i]].use)
            question.images[i] = material->maps[inputs[i]].use->image;
        question.texel_versions[i] = material->texel_versions[inputs[i]];
    }
    return question;
}

static bool are_equal(const colour_correlation *a, const colour_correlation *b) {
    return memcmp(a->images, b->images, sizeof a->images) == 0 &&
           memcmp(a->texel_versions, b->texel_versions, sizeof a->texel_versions) == 0 &&
           a->normal_scale == b->normal_scale && a->height_scale == b->height_scale &&
           a->metallic == b->metallic && a->alpha == b->alpha && a->cutoff == b->cutoff;
}

static void take(colour_correlation *colours, const struct colour_correlation_found *answer) {
    colours->known = true;
    colours->follow_normals = answer->follow != 0;
}

/// Asks anew where what the answer depends on has changed; takes one that has come.
static void update(const filter_context *context, device_material *material) {
    colour_correlation *colours = &material->colours;
    const colour_correlation question = question_of(context->scene, material);
    bool pending = false;
    const bool is_kept = colours->known && context->scene->keeps_conclusions;
    if (!is_kept && (!colours->asked || !are_equal(colours, &question))) {
        const bool was_open = colours->was_open;
        *colours = question;
        colours->was_open = was_open;
    }
    if (colours->late == 0)
        return;
    const void *answer = lobe_graph_late_data(context->graph, colours->late, &pending);
    if (answer)
        take(colours, answer);
    if (!pending)
        colours->late = 0;
}

static bool is_open(const filter_context *context, uint32_t index) {
    device_material *material = &context->scene->materials[index];
    if (!passes_colours_lie_like_normals(material))
        return false;
    update(context, material);
    return !material->colours.known;
}

bool passes_colours_may_follow_normals(const filter_context *context, uint32_t index) {
    const device_material *material = &context->scene->materials[index];
    return is_open(context, index) ||
           (passes_colours_lie_like_normals(material) && material->colours.follow_normals);
}

// ---------------------------------------------------------------------------------------------
// The pass

static struct colour_correlation_constants constants_of(const device_material *material) {
    const lobe_grid grid = passes_lobe_grid(material);
    const bool microfacet = material->material->model == LOBE_MATERIAL_MICROFACET;
    return (struct colour_correlation_constants){
        .width = grid.width,
        .height = grid.height,
        .normals = material->maps[MAP_NORMAL].normals,
        .normal_scale = material->material->normal_scale,
        .metallic = microfacet ? material->metallic : 0,
        .alpha = material->colours.alpha,
        .cutoff = material->colours.cutoff,
    };
}

static void read_maps(const filter_context *context, const device_material *material,
                      lobe_pass *pass) {
    passes_base_map_read(context, material, MAP_BASE_COLOUR, "base_colour_map", pass);
    passes_base_map_read(context, material, MAP_NORMAL, "normal_map", pass);
    if (material->metallic_varies)
        passes_base_map_read(context, material, MAP_WIDTH, "width_map", pass);
    else
        lobe_pass_read(pass, &(lobe_binding){.name = "width_map",
                                             .resource = lobe_graph_import_texture(
                                                 context->graph, context->scene->white)});
}

static lobe_resource add_pass(const filter_context *context, uint32_t index) {
    const device_material *material = &context->scene->materials[index];
    const struct colour_correlation_constants constants = constants_of(material);
    char name[64];
    snprintf(name, sizeof name, "colours of material %u follow normals", index);
    const lobe_resource declared = lobe_graph_buffer(
        context->graph, &(lobe_buffer_description){.name = name,
                                                   .size = sizeof(struct colour_correlation_found),
                                                   .retained = true});
    lobe_pass *pass = lobe_graph_add_pass(context->graph, LOBE_PASS_COMPUTE, "colour_correlation");
    read_maps(context, material, pass);
    const lobe_resource found =
        lobe_pass_write(pass, &(lobe_binding){.name = "correlation_block", .resource = declared});
    lobe_pass_dispatch(pass, &(lobe_dispatch){
                                 .shader = "maps/colour_correlation.comp",
                                 .constants = &constants,
                                 .constants_size = sizeof constants,
                             });
    return found;
}

/// Of an answer that the host has: pipelines are those of an open question.
static lobe_resource upload(const filter_context *context, bool follow) {
    const struct colour_correlation_found known = {.follow = follow};
    return lobe_graph_upload(context->graph, "colours follow normals", &known, sizeof known);
}

lobe_resource passes_colour_correlation(const filter_context *context, uint32_t index) {
    colour_correlation *colours = &context->scene->materials[index].colours;
    lobe_resource *found = &context->images->correlations[index];
    const bool known = colours->known && !(colours->was_open && colours->follow_normals);
    if (found->version != 0)
        return *found;
    *found = known ? upload(context, colours->follow_normals) : add_pass(context, index);
    if (known || colours->known)
        return *found;
    colours->was_open = true;
    if (colours->late == 0 && !context->scene->keeps_conclusions &&
        are_announced(context->scene, &context->scene->materials[index]))
        colours->late = lobe_graph_read_back_late(context->graph, *found, (lobe_range){0});
    return *found;
}

bool passes_colour_correlation_decides(const filter_context *context, uint32_t index) {
    const colour_correlation *colours = &context->scene->materials[index].colours;
    return colours->was_open && (!colours->known || colours->follow_normals);
}

// ---------------------------------------------------------------------------------------------
// Frames that are waited for

/// Filters without maps do not ask. Takes an answer that has come.
static bool asks(const filter_context *context, uint32_t index) {
    const device_material *material = &context->scene->materials[index];
    return material->first_instance > 0 && context->filter->build &&
           !context->filter->reads_heights && is_open(context, index) &&
           are_announced(context->scene, material);
}

lobe_result passes_colour_correlations_ask(const filter_context *context) {
    const size_t count = context->scene->scene->material_count;
    bool open = false;
    for (uint32_t i = 0; i < count; i++)
        open |= asks(context, i);
    if (!open)
        return LOBE_OK;
    lobe_graph_begin_aside(context->graph);
    for (uint32_t i = 0; i < count; i++) {
        device_material *material = &context->scene->materials[i];
        if (asks(context, i))
            material->colours.late =
                lobe_graph_read_back_late(context->graph, add_pass(context, i), (lobe_range){0});
    }
    const lobe_result result = lobe_graph_execute(context->graph);
    // The next frame aside takes the answers' memory.
    for (uint32_t i = 0; result == LOBE_OK && i < count; i++)
        if (context->scene->materials[i].colours.late != 0)
            update(context, &context->scene->materials[i]);
    return result;
}
