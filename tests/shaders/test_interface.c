// The structures of shaders/interface have the same layout in GLSL, as its compiler chose it, as in
// C. Read from the SPIR-V of the library's own shaders.

#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "engine/shader/shaders.h"
#include "shaders/interface/atlas.h"
#include "shaders/interface/background.h"
#include "shaders/interface/clustering_atlas.h"
#include "shaders/interface/colours/mask.h"
#include "shaders/interface/deformation.h"
#include "shaders/interface/displacement/displacement.h"
#include "shaders/interface/displacement/relief.h"
#include "shaders/interface/displacement/wu.h"
#include "shaders/interface/environment/environment_light.h"
#include "shaders/interface/environment/hemisphere_moments.h"
#include "shaders/interface/environment/irradiance_harmonics.h"
#include "shaders/interface/frame.h"
#include "shaders/interface/gaussian_mixture.h"
#include "shaders/interface/instance.h"
#include "shaders/interface/knobs.h"
#include "shaders/interface/light.h"
#include "shaders/interface/lobe_grid.h"
#include "shaders/interface/map_tiles.h"
#include "shaders/interface/material.h"
#include "shaders/interface/mixture.h"
#include "shaders/interface/moment_bins.h"
#include "shaders/interface/moment_refit.h"
#include "shaders/interface/motion.h"
#include "shaders/interface/ocean.h"
#include "shaders/interface/picture/surfaces.h"
#include "shaders/interface/shadow.h"
#include "shaders/interface/slope_moments.h"
#include "shaders/interface/vertex.h"
#include "shaders/interface/waves.h"
#include "tests/engine/support/cmocka_all.h"

// ---------------------------------------------------------------------------------------------
// What C says

typedef struct known_member {
    const char *structure, *name;
    size_t size, offset; ///< bytes; the size is the structure's
    uint32_t position;   ///< in the structure
    bool seen;
} known_member;

#define MEMBER(type, member, position)                                                             \
    { #type, #member, sizeof(struct type), offsetof(struct type, member), position, false }

static known_member known[] = {
    MEMBER(atlas_layout, u, 0),
    MEMBER(atlas_layout, v, 1),
    MEMBER(atlas_layout, second_coordinates, 2),
    MEMBER(background_constants, centre, 0),
    MEMBER(background_constants, right, 1),
    MEMBER(background_constants, down, 2),
    MEMBER(motion_background_constants, centre, 0),
    MEMBER(motion_background_constants, right, 1),
    MEMBER(motion_background_constants, down, 2),
    MEMBER(motion_constants, world_to_clip, 0),
    MEMBER(motion_constants, current, 1),
    MEMBER(motion_constants, change, 2),
    MEMBER(motion_constants, half_extent, 3),
    MEMBER(base_triangle, charts, 0),
    MEMBER(base_triangle, edges, 1),
    MEMBER(base_edge, points, 0),
    MEMBER(base_edge, first_pair, 1),
    MEMBER(base_edge, pair_count, 2),
    MEMBER(base_chart, point, 0),
    MEMBER(base_chart, vertex, 1),
    MEMBER(base_point, first_chart, 0),
    MEMBER(base_point, chart_count, 1),
    MEMBER(base_point, first_corner, 2),
    MEMBER(base_point, corner_count, 3),
    MEMBER(posed_point, position, 0),
    MEMBER(posed_point, direction, 1),
    MEMBER(pose_constants, count, 0),
    MEMBER(pose_constants, second_set, 1),
    MEMBER(pose_constants, row, 2),
    MEMBER(pose_constants, map_rows, 4),
    MEMBER(pose_constants, width, 5),
    MEMBER(pose_constants, height, 6),
    MEMBER(chart_measure, lengths, 0),
    MEMBER(chart_measure, edge, 1),
    MEMBER(height_bounds_constants, width, 0),
    MEMBER(height_bounds_constants, height, 1),
    MEMBER(height_bounds_constants, columns, 2),
    MEMBER(height_bounds_constants, rows, 3),
    MEMBER(height_bounds_constants, target, 4),
    MEMBER(height_bounds_constants, source, 5),
    MEMBER(height_bounds_constants, source_columns, 6),
    MEMBER(height_bounds_constants, source_rows, 7),
    MEMBER(displacement_constants, width, 0),
    MEMBER(displacement_constants, height, 1),
    MEMBER(displacement_constants, wrap_u, 2),
    MEMBER(displacement_constants, wrap_v, 3),
    MEMBER(displacement_constants, second_set, 4),
    MEMBER(displacement_constants, levels, 5),
    MEMBER(displacement_constants, patch_count, 6),
    MEMBER(displacement_constants, depth, 7),
    MEMBER(displacement_constants, rows, 8),
    MEMBER(displacement_constants, axis, 9),
    MEMBER(displacement_constants, planes, 10),
    MEMBER(displacement_constants, map_rows, 11),
    MEMBER(displacement_constants, pixels, 12),
    MEMBER(displacement_constants, perspective, 13),
    MEMBER(displacement_constants, near_plane, 14),
    MEMBER(displacement_constants, spacing, 15),
    MEMBER(displacement_constants, relief, 16),
    MEMBER(displacement_constants, stretch, 17),
    MEMBER(displacement_constants, scale, 18),
    MEMBER(displacement_constants, facing, 19),
    MEMBER(displacement_constants, row, 20),
    MEMBER(displacement_constants, vertex_room, 21),
    MEMBER(displacement_constants, triangle_room, 22),
    MEMBER(displacement_constants, caster_count, 23),
    MEMBER(displacement_constants, eye, 24),
    MEMBER(displacement_constants, casters, 25),
    MEMBER(displacement_constants, bounds_levels, 26),
    MEMBER(lobe_grid_constants, width, 0),
    MEMBER(lobe_grid_constants, height, 1),
    MEMBER(lobe_grid_constants, level, 2),
    MEMBER(lobe_grid_constants, alpha, 3),
    MEMBER(lobe_grid_constants, cutoff, 4),
    MEMBER(tile_level, first_mark, 0),
    MEMBER(tile_level, columns, 1),
    MEMBER(tile_level, width, 2),
    MEMBER(tile_level, height, 3),
    MEMBER(tile_list_constants, first_mark, 0),
    MEMBER(tile_list_constants, width, 1),
    MEMBER(tile_list_constants, height, 2),
    MEMBER(tile_list_constants, levels, 3),
    MEMBER(tile_list_constants, layers, 4),
    MEMBER(tile_list_constants, content, 5),
    MEMBER(tile_list_constants, forgets, 6),
    MEMBER(tile_list_constants, reduced, 7),
    MEMBER(tile_list_constants, conditional, 8),
    MEMBER(tile_list_constants, made_with, 9),
    MEMBER(tile_marking_constants, count, 0),
    MEMBER(tile_marking_constants, wrap_u, 1),
    MEMBER(tile_marking_constants, wrap_v, 2),
    MEMBER(tile_marking_constants, width, 3),
    MEMBER(tile_marking_constants, height, 4),
    MEMBER(tile_marking_constants, levels, 8),
    MEMBER(mask_constants, width, 0),
    MEMBER(mask_constants, height, 1),
    MEMBER(mask_constants, interpolated, 2),
    MEMBER(mask_constants, repeats_u, 3),
    MEMBER(mask_constants, repeats_v, 4),
    MEMBER(mask_constants, alpha, 5),
    MEMBER(mask_constants, cutoff, 6),
    MEMBER(mask_constants, step, 7),
    MEMBER(atlas_constants, rotation, 0),
    MEMBER(atlas_constants, eye, 1),
    MEMBER(atlas_constants, width, 2),
    MEMBER(atlas_constants, height, 3),
    MEMBER(atlas_constants, alpha, 4),
    MEMBER(atlas_constants, cutoff, 5),
    MEMBER(environment_constants, environment_from_world, 0),
    MEMBER(environment_constants, intensity, 1),
    MEMBER(environment_constants, sample_number, 2),
    MEMBER(environment_constants, pattern, 3),
    MEMBER(height_level, offset, 0),
    MEMBER(height_level, width, 1),
    MEMBER(height_level, height, 2),
    MEMBER(height_field_constants, width, 0),
    MEMBER(height_field_constants, height, 1),
    MEMBER(height_field_constants, last_level, 2),
    MEMBER(height_field_constants, scale, 3),
    MEMBER(height_field_constants, levels, 4),
    MEMBER(height_field_constants, least_value, 5),
    MEMBER(height_field_constants, largest_value, 6),
    MEMBER(transfer_basis_constants, functions, 0),
    MEMBER(transfer_basis_constants, integrals, 1),
    MEMBER(transfer_basis_constants, groups, 2),
    MEMBER(transfer_basis_constants, hidden, 3),
    MEMBER(transfer_basis_constants, second, 4),
    MEMBER(transfer_closure_constants, basis, 0),
    MEMBER(transfer_closure_constants, lacking, 1),
    MEMBER(transfer_closure_constants, visible, 2),
    MEMBER(transfer_closure_constants, lost, 3),
    MEMBER(transfer_closure_constants, persistence, 4),
    MEMBER(transfer_closure_constants, direct, 5),
    MEMBER(transfer_closure_constants, emission, 7),
    MEMBER(transfer_closure_constants, mean, 8),
    MEMBER(transfer_constants, width, 0),
    MEMBER(transfer_constants, height, 1),
    MEMBER(transfer_constants, azimuths, 2),
    MEMBER(transfer_constants, first, 3),
    MEMBER(transfer_constants, channel, 4),
    MEMBER(transfer_constants, first_thread, 5),
    MEMBER(transfer_constants, first_facet, 6),
    MEMBER(transfer_constants, origin_x, 7),
    MEMBER(transfer_constants, origin_y, 8),
    MEMBER(transfer_constants, first_column, 9),
    MEMBER(transfer_constants, first_row, 10),
    MEMBER(transfer_constants, target_column, 11),
    MEMBER(transfer_constants, target_row, 12),
    MEMBER(colour_constants, base_colour, 0),
    MEMBER(colour_constants, width, 1),
    MEMBER(colour_constants, height, 2),
    MEMBER(colour_constants, points, 3),
    MEMBER(colour_constants, metallic, 4),
    MEMBER(colour_constants, origin_x, 5),
    MEMBER(colour_constants, origin_y, 6),
    MEMBER(colour_constants, relief_width, 7),
    MEMBER(colour_constants, relief_height, 8),
    MEMBER(wu_level, first_cell, 0),
    MEMBER(wu_level, width, 1),
    MEMBER(wu_level, height, 2),
    MEMBER(wu_level, first_pair, 3),
    MEMBER(wu_level, spacing_x, 4),
    MEMBER(wu_level, spacing_y, 5),
    MEMBER(wu_level, unit, 6),
    MEMBER(wu_level, octave, 7),
    MEMBER(wu_constants, width, 0),
    MEMBER(wu_constants, height, 1),
    MEMBER(wu_constants, level_count, 2),
    MEMBER(wu_constants, angular, 3),
    MEMBER(wu_constants, patches, 4),
    MEMBER(wu_constants, points, 5),
    MEMBER(wu_constants, bounces, 6),
    MEMBER(wu_constants, printed, 7),
    MEMBER(wu_constants, levels, 8),
    MEMBER(wu_cell, lobes, 0),
    MEMBER(wu_cell, slopes, 1),
    MEMBER(wu_cell, numerator, 2),
    MEMBER(wu_cell, denominator, 3),
    MEMBER(wu_cell, horizons, 4),
    MEMBER(wu_step, level, 0),
    MEMBER(wu_step, samples, 1),
    MEMBER(wu_step, one_way, 2),
    MEMBER(wu_step, alike, 3),
    MEMBER(frame_constants, world_to_clip, 0),
    MEMBER(frame_constants, world_to_camera, 1),
    MEMBER(frame_constants, eye, 2),
    MEMBER(frame_constants, axis, 3),
    MEMBER(frame_constants, directional_count, 4),
    MEMBER(frame_constants, point_count, 5),
    MEMBER(frame_constants, spot_count, 6),
    MEMBER(frame_constants, footprint, 7),
    MEMBER(frame_constants, dither, 8),
    MEMBER(frame_constants, first_light, 9),
    MEMBER(frame_constants, vertex_spacing, 10),
    MEMBER(frame_constants, seed, 11),
    MEMBER(joint_influence, joint, 0),
    MEMBER(joint_influence, weight, 1),
    MEMBER(morph_delta, target, 0),
    MEMBER(morph_delta, position, 1),
    MEMBER(morph_delta, normal, 2),
    MEMBER(morph_delta, tangent, 3),
    MEMBER(deform_constants, vertex_count, 0),
    MEMBER(deform_constants, influences, 1),
    MEMBER(deform_constants, targets, 2),
    MEMBER(deform_constants, faceted, 3),
    MEMBER(deform_constants, row, 4),
    MEMBER(instance_constants, rows, 0),
    MEMBER(culling_constants, planes, 0),
    MEMBER(culling_constants, first_record, 1),
    MEMBER(culled_batch, minimum, 0),
    MEMBER(culled_batch, maximum, 1),
    MEMBER(culled_batch, first, 2),
    MEMBER(culled_batch, count, 3),
    MEMBER(culled_batch, index_count, 4),
    MEMBER(draw_constants, first_instance, 0),
    MEMBER(draw_constants, map_width, 1),
    MEMBER(draw_constants, number, 2),
    MEMBER(hemisphere_moments_constants, size, 0),
    MEMBER(irradiance_harmonics, coefficients, 0),
    MEMBER(irradiance_remainder_constants, size, 0),
    MEMBER(irradiance_remainder_constants, is_zero, 1),
    MEMBER(irradiance_harmonics_constants, size, 0),
    MEMBER(irradiance_harmonics_sum_constants, band_factors, 0),
    MEMBER(irradiance_harmonics_sum_constants, count, 1),
    MEMBER(leadr_knobs, height, 0),
    MEMBER(light, position, 0),
    MEMBER(light, direction, 1),
    MEMBER(light, intensity, 2),
    MEMBER(light, cone, 3),
    MEMBER(lobes_knobs, epsilon0, 0),
    MEMBER(lobes_knobs, epsilon1, 1),
    MEMBER(lobes_knobs, blend, 2),
    MEMBER(shadow_view, world_to_clip, 0),
    MEMBER(shadow_view, tolerance, 1),
    MEMBER(material_constants, base_colour, 0),
    MEMBER(material_constants, emissive, 1),
    MEMBER(material_constants, metallic, 2),
    MEMBER(material_constants, roughness, 3),
    MEMBER(material_constants, normal_scale, 4),
    MEMBER(material_constants, normal_concentration, 5),
    MEMBER(material_constants, lobe_direction, 6),
    MEMBER(material_constants, lobe_colour, 7),
    MEMBER(material_constants, occlusion_strength, 8),
    MEMBER(material_constants, largest_colour, 9),
    MEMBER(material_constants, width_factor, 10),
    MEMBER(material_constants, transforms, 12),
    MEMBER(mixture_extremes, places, 0),
    MEMBER(mixture_extremes, lobes, 1),
    MEMBER(mixture_fit_constants, width, 0),
    MEMBER(mixture_fit_constants, height, 1),
    MEMBER(mixture_fit_constants, steps, 2),
    MEMBER(mixture_fit_constants, prior, 3),
    MEMBER(mixture_fit_constants, first_row, 4),
    MEMBER(mixture_fit_constants, own_steps, 5),
    MEMBER(mixture_fit_constants, least_gain, 6),
    MEMBER(mixture_likeness_constants, mirrored_x, 0),
    MEMBER(mixture_likeness_constants, mirrored_y, 1),
    MEMBER(mixture_likeness_constants, level, 2),
    MEMBER(mixture_likeness_constants, tolerance, 3),
    MEMBER(moment_bin, centre, 0),
    MEMBER(moment_bin, shape, 1),
    MEMBER(moment_bin, range, 2),
    MEMBER(moment_binning_constants, hats, 0),
    MEMBER(moment_binning_constants, largest, 1),
    MEMBER(moment_binning_constants, bins, 2),
    MEMBER(moments_knobs, least_share, 0),
    MEMBER(cell_survey_constants, width, 0),
    MEMBER(cell_survey_constants, height, 1),
    MEMBER(cell_survey_constants, columns, 2),
    MEMBER(cell_survey_constants, rows, 3),
    MEMBER(cell_survey_constants, part, 4),
    MEMBER(cell_survey_constants, alpha, 5),
    MEMBER(cell_survey_constants, cutoff, 6),
    MEMBER(survey_extremes, places, 0),
    MEMBER(survey_extremes, factors, 1),
    MEMBER(ocean_fft_constants, size, 0),
    MEMBER(ocean_fft_constants, done, 1),
    MEMBER(ocean_fft_constants, columns, 2),
    MEMBER(ocean_spectrum_constants, step, 0),
    MEMBER(ocean_spectrum_constants, size, 1),
    MEMBER(ocean_spectrum_constants, time, 2),
    MEMBER(refit_constants, cells, 0),
    MEMBER(refit_constants, lobes, 1),
    MEMBER(refit_constants, points, 2),
    MEMBER(refit_constants, bins, 3),
    MEMBER(refit_constants, has_first, 4),
    MEMBER(refit_constants, follows, 5),
    MEMBER(refit_constants, interpolated, 6),
    MEMBER(fit_gaussian, place, 0),
    MEMBER(fit_gaussian, spread, 1),
    MEMBER(fit_state, shown, 0),
    MEMBER(fit_state, other, 1),
    MEMBER(fit_state, old, 2),
    MEMBER(fit_state, bins, 3),
    MEMBER(fit_state, step, 4),
    MEMBER(fit_state, round, 5),
    MEMBER(fit_state, count, 6),
    MEMBER(fit_state, likelihood, 7),
    MEMBER(fit_state, other_likelihood, 8),
    MEMBER(fit_state, points, 9),
    MEMBER(fit_state, reach, 10),
    MEMBER(fit_state, middle_x, 11),
    MEMBER(fit_state, middle_y, 12),
    MEMBER(fit_state, narrowest, 13),
    MEMBER(fit_state, broadest, 14),
    MEMBER(fit_state, texels, 15),
    MEMBER(fit_state, quiet, 16),
    MEMBER(fit_state, rest, 17),
    MEMBER(fit_state, part, 18),
    MEMBER(fit_state, unchanged, 19),
    MEMBER(shared_knobs, curvature, 0),
    MEMBER(shared_knobs, level_bias, 1),
    MEMBER(shared_knobs, level_blend, 2),
    MEMBER(surface_rectangle, right, 0),
    MEMBER(surface_rectangle, bottom, 1),
    MEMBER(surface_rectangle, from_right, 2),
    MEMBER(surface_rectangle, from_bottom, 3),
    MEMBER(wave_constants, frequency, 0),
    MEMBER(wave_constants, rest, 1),
    MEMBER(wave_constants, total, 2),
    MEMBER(wave_moments_constants, size, 0),
    MEMBER(vertex, position, 0),
    MEMBER(vertex, normal, 1),
    MEMBER(vertex, tangent, 2),
    MEMBER(vertex, texture_coordinates, 3),
    MEMBER(vertex, colour, 4),
};
static const size_t known_count = sizeof known / sizeof *known;

static bool is_known(const char *structure) {
    for (size_t i = 0; i < known_count; i++)
        if (strcmp(known[i].structure, structure) == 0)
            return true;
    return false;
}

static known_member *find(const char *structure, const char *member) {
    for (size_t i = 0; i < known_count; i++)
        if (strcmp(known[i].structure, structure) == 0 && strcmp(known[i].name, member) == 0)
            return &known[i];
    return NULL;
}

// ---------------------------------------------------------------------------------------------
// What GLSL says: SPIR-V specification 1.6, sections 2.3 (layout of a module) and 3.42
// (instructions)

enum {
    OP_NAME = 5,
    OP_MEMBER_NAME = 6,
    OP_TYPE_ARRAY = 28,
    OP_TYPE_RUNTIME_ARRAY = 29,
    OP_DECORATE = 71,
    OP_MEMBER_DECORATE = 72,
    DECORATION_ARRAY_STRIDE = 6,
    DECORATION_OFFSET = 35,
    HEADER_WORDS = 5,
    MAXIMUM_MEMBERS = 32,
};

/// What one module says of an id.
typedef struct spirv_type {
    const char *name;
    const char *members[MAXIMUM_MEMBERS];
    uint32_t stride;
} spirv_type;

typedef void visit(spirv_type *types, const uint32_t *instruction);

static void visit_instructions(const engine_shader_code *code, spirv_type *types, visit *visit) {
    const size_t count = code->size / sizeof *code->words;
    for (size_t i = HEADER_WORDS; i < count; i += code->words[i] >> 16) {
        // Instructions of one word have no id; the last one of a module is such an instruction.
        if (code->words[i] >> 16 > 1)
            visit(types, code->words + i);
    }
}

static void note_names(spirv_type *types, const uint32_t *instruction) {
    const uint32_t operation = instruction[0] & 0xffff, id = instruction[1];
    if (operation == OP_NAME)
        types[id].name = (const char *)(instruction + 2);
    if (operation == OP_MEMBER_NAME && instruction[2] < MAXIMUM_MEMBERS)
        types[id].members[instruction[2]] = (const char *)(instruction + 3);
    if (operation == OP_DECORATE && instruction[2] == DECORATION_ARRAY_STRIDE)
        types[id].stride = instruction[3];
}

static void check_offset(const spirv_type *type, uint32_t position, uint32_t offset) {
    assert_true(position < MAXIMUM_MEMBERS);
    const char *name = type->members[position];
    if (strncmp(name, "padding", 7) == 0)
        return;
    known_member *member = find(type->name, name);
    if (!member)
        fail_msg("%s.%s is not known to this test", type->name, name);
    if (member->offset != offset || member->position != position)
        fail_msg("%s.%s: at %zu in C, at %u in GLSL", type->name, name, member->offset, offset);
    member->seen = true;
}

static void check_stride(const spirv_type *array, const spirv_type *element) {
    for (size_t i = 0; i < known_count; i++)
        if (strcmp(known[i].structure, element->name) == 0 && known[i].size != array->stride)
            fail_msg("%s: %zu bytes in C, %u in an array of GLSL", element->name, known[i].size,
                     array->stride);
}

static void check_instruction(spirv_type *types, const uint32_t *instruction) {
    const uint32_t operation = instruction[0] & 0xffff;
    if (operation != OP_MEMBER_DECORATE && operation != OP_TYPE_ARRAY &&
        operation != OP_TYPE_RUNTIME_ARRAY)
        return;
    const spirv_type *first = &types[instruction[1]];
    if (operation == OP_MEMBER_DECORATE && instruction[3] == DECORATION_OFFSET && first->name &&
        is_known(first->name))
        check_offset(first, instruction[2], instruction[4]);
    if ((operation == OP_TYPE_ARRAY || operation == OP_TYPE_RUNTIME_ARRAY) && first->stride) {
        const spirv_type *element = &types[instruction[2]];
        if (element->name && is_known(element->name))
            check_stride(first, element);
    }
}

static void members_lie_where_c_has_them(void **state) {
    (void)state;
    for (size_t i = 0; i < engine_embedded_shaders_count; i++) {
        const engine_shader_code *code = &engine_embedded_shaders[i];
        const uint32_t bound = code->words[3];
        spirv_type *types = calloc(bound, sizeof *types);
        assert_non_null(types);
        visit_instructions(code, types, note_names);
        visit_instructions(code, types, check_instruction);
        free(types);
    }
    for (size_t i = 0; i < known_count; i++)
        if (!known[i].seen)
            fail_msg("no shader has %s.%s", known[i].structure, known[i].name);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(members_lie_where_c_has_them),
    };
    return cmocka_run_group_tests_name("structures shared by C and GLSL", tests, NULL, NULL);
}
