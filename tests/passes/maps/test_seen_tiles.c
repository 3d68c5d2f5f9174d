// Maps of which only the tiles that pixels read are made: pictures equal those of whole maps to the
// bit, whatever unread tiles hold, and a tile is made once for each content.

#include "tests/passes/support/fixture.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "passes/maps/seen_tiles.h"
#include "scenes/builtin/random.h"
#include "tests/passes/support/picture.h"
#include "tests/passes/support/scene_builder.h"

enum { EXTENT = 48 };

// ---------------------------------------------------------------------------------------------
// The list

/// Marks, and what must be listed for them.
typedef struct tile_case {
    uint32_t width, height; ///< texels that the map is made from
    bool reduced;
    bool conditional;
    uint32_t condition; ///< 0: no tile is needed
    uint32_t made_with[2];
    struct tile_level levels[MAP_TILE_LEVELS];
    uint32_t level_count, tiles;
    uint32_t *marks, *needed;
} tile_case;

static tile_case case_of(uint32_t width, uint32_t height, bool reduced, double density) {
    tile_case c = {.width = width, .height = height, .reduced = reduced};
    random_sequence sequence = scenes_random_start(width + 7 * height);
    c.level_count = passes_map_tile_levels(width, height, 0, c.levels);
    c.tiles = passes_map_tile_count(width, height);
    c.marks = calloc(c.tiles, sizeof *c.marks);
    c.needed = calloc(c.tiles, sizeof *c.needed);
    for (uint32_t i = 0; i < c.tiles; i++)
        c.marks[i] = scenes_random_between(&sequence, 0, 1) < density;
    return c;
}

static uint32_t *tile_of(const tile_case *c, uint32_t *flags, uint32_t level, uint32_t x,
                         uint32_t y) {
    const struct tile_level *of = &c->levels[level];
    return &flags[of->first_mark + y / MAP_TILE * of->columns + x / MAP_TILE];
}

/// Needed: what is marked, and each texel that a needed texel of the coarser level is the mean of.
static void find_needed(tile_case *c) {
    memcpy(c->needed, c->marks, c->tiles * sizeof *c->marks);
    for (uint32_t level = c->level_count; c->reduced && --level > 0;) {
        const struct tile_level *of = &c->levels[level], *finer = of - 1;
        for (uint32_t y = 0; y < of->height; y++) {
            for (uint32_t x = 0; x < of->width; x++) {
                if (!*tile_of(c, c->needed, level, x, y))
                    continue;
                for (uint32_t v = 2 * y; v < finer->height && v <= 2 * y + 1 + finer->height % 2;
                     v++)
                    for (uint32_t u = 2 * x; u < finer->width && u <= 2 * x + 1 + finer->width % 2;
                         u++)
                        *tile_of(c, c->needed, level - 1, u, v) = 1;
            }
        }
    }
}

/// The list for a content number, read back.
static const uint32_t *list_of(fixture *f, const tile_case *c, uint32_t content, bool forgets) {
    lobe_graph *graph = f->graph;
    lobe_graph_begin(graph);
    const lobe_buffer_description states = {
        .name = "states", .size = c->tiles * sizeof(uint32_t), .retained = true};
    const lobe_buffer_description listed = {
        .name = "list",
        .size = (MAP_TILE_LEVELS * MAP_TILE_RECORD + 2 * c->tiles) * sizeof(uint32_t)};
    const struct tile_list_constants constants = {.width = c->levels[0].width,
                                                  .height = c->levels[0].height,
                                                  .levels = c->level_count,
                                                  .layers = 3,
                                                  .content = content,
                                                  .forgets = forgets,
                                                  .reduced = c->reduced,
                                                  .conditional = c->conditional,
                                                  .made_with = 2};
    lobe_pass *pass = lobe_graph_add_pass(graph, LOBE_PASS_COMPUTE, "tile_list");
    lobe_pass_read(pass,
                   &(lobe_binding){.name = "mark_block",
                                   .resource = lobe_graph_upload(graph, "marks", c->marks,
                                                                 c->tiles * sizeof *c->marks)});
    lobe_pass_read(pass,
                   &(lobe_binding){.name = "condition_block",
                                   .resource = lobe_graph_upload(graph, "condition", &c->condition,
                                                                 sizeof c->condition)});
    lobe_pass_read(pass,
                   &(lobe_binding){.name = "made_with_block",
                                   .resource = lobe_graph_upload(graph, "made with", c->made_with,
                                                                 sizeof c->made_with)});
    const lobe_resource known = lobe_graph_buffer(graph, &states);
    assert_int_equal(lobe_graph_has_content(graph, known), !forgets);
    const lobe_binding state = {.name = "state_block", .resource = known};
    lobe_graph_output(graph,
                      forgets ? lobe_pass_write(pass, &state) : lobe_pass_modify(pass, &state));
    const lobe_resource list =
        lobe_pass_write(pass, &(lobe_binding){.name = "tile_list_block",
                                              .resource = lobe_graph_buffer(graph, &listed)});
    lobe_pass_dispatch(pass, &(lobe_dispatch){.shader = "maps/tile_list.comp",
                                              .threads = {1, 1, 1},
                                              .constants = &constants,
                                              .constants_size = sizeof constants});
    lobe_graph_read_back(graph, list, (lobe_range){0});
    if (lobe_graph_execute(graph) != LOBE_OK)
        fail_msg("%s", f->error);
    return lobe_graph_data(graph, list, NULL);
}

/// Every tile for which `expected` is 1 is listed once, and no other.
static void check_list(const tile_case *c, const uint32_t *list, const uint32_t *expected) {
    for (uint32_t level = 0; level < c->level_count; level++) {
        const struct tile_level *of = &c->levels[level];
        const uint32_t *record = list + level * MAP_TILE_RECORD;
        const uint32_t tiles = of->columns * ((of->height + MAP_TILE - 1) / MAP_TILE);
        uint32_t *seen = calloc(tiles, sizeof *seen), sum = 0;
        for (uint32_t i = 0; i < record[MAP_TILE_COUNT]; i++) {
            const uint32_t tile = list[record[MAP_TILE_FIRST] + i];
            seen[(tile >> 16) * of->columns + (tile & 0xffff)]++;
        }
        for (uint32_t i = 0; i < tiles; i++) {
            sum += seen[i];
            if (seen[i] != expected[of->first_mark + i])
                fail_msg("%u x %u, level %u, tile %u: listed %u times instead of %u", c->width,
                         c->height, level, i, seen[i], expected[of->first_mark + i]);
        }
        free(seen);
        assert_int_equal(record[0] * record[1] >= MAP_TILE_GROUPS * sum, 1);
        assert_int_equal(record[2], c->reduced && level > 0 ? 3 : 1);
    }
}

static void tiles_that_marks_need_are_listed_once(void **state) {
    static const uint32_t extents[][2] = {{256, 256}, {200, 73},   {1, 600}, {1027, 515},
                                          {33, 33},   {4096, 130}, {2, 2},   {63, 65}};
    fixture *f = *state;
    for (size_t i = 0; i < sizeof extents / sizeof *extents; i++) {
        for (int reduced = 0; reduced < 2; reduced++) {
            tile_case c = case_of(extents[i][0], extents[i][1], reduced, 0.1);
            uint32_t *none = calloc(c.tiles, sizeof *none);
            find_needed(&c);
            check_list(&c, list_of(f, &c, 5, true), c.needed);
            check_list(&c, list_of(f, &c, 5, false), none);
            c.conditional = true;
            check_list(&c, list_of(f, &c, 6, false), none);
            c.condition = 1;
            check_list(&c, list_of(f, &c, 6, false), c.needed);
            // Two numbers have another sign.
            c.made_with[0] = c.made_with[1] = 1u << 31;
            check_list(&c, list_of(f, &c, 6, false), c.needed);
            check_list(&c, list_of(f, &c, 6, false), none);
            free(none);
            free(c.marks);
            free(c.needed);
            lobe_graph_begin(f->graph); // forgets the states
            assert_int_equal(lobe_graph_execute(f->graph), LOBE_OK);
        }
    }
    assert_int_equal(f->errors, 0);
    assert_int_equal(lobe_device_validation_count(f->device), 0);
}

// ---------------------------------------------------------------------------------------------
// Pictures

typedef struct view {
    double towards[3];
    double height;
} view;

static const view views[] = {{{0.3, 1, 0.4}, 2}, {{0.2, 0.15, 1}, 0.7}, {{0.5, 1, 0.1}, 0.3}};

static lobe_scene *mapped_scene(uint32_t width, uint32_t height, double tiles,
                                lobe_scene_wrap wrap) {
    lobe_scene *scene = scene_begin();
    lobe_material material = microfacet_material(LOBE_DISTRIBUTION_GGX, 0.5, 1);
    material.normal_map = scene_add_map(scene, random_normal_map(width, height, 0.5, width));
    material.metallic_roughness_map =
        scene_add_map(scene, random_map(width, height, 0.3, 0.9, height));
    // Colours are laid out otherwise, and one of them as the lobes.
    material.base_colour_map = scene_add_map(scene, random_map(2 * width, height, 0.2, 0.9, 3));
    material.emissive_map = scene_add_map(scene, random_map(width + 33, 2 * height, 0, 1, 4));
    material.base_colour_map.transform[0][0] = 0.75f;
    material.base_colour_map.transform[0][2] = 0.3f;
    material.emissive_map.transform[1][0] = 0.5f;
    material.emissive[0] = material.emissive[1] = 0.2f;
    material.metallic = 0.5f;
    lobe_texture_use *const uses[] = {&material.normal_map, &material.metallic_roughness_map,
                                      &material.base_colour_map, &material.emissive_map};
    for (size_t i = 0; i < sizeof uses / sizeof *uses; i++)
        uses[i]->wrap_u = uses[i]->wrap_v = wrap;
    scene_add_square(scene, &material, tiles, NULL);
    scene_add_sun(scene, (double[]){0.3, 1, 0.2}, 2);
    scene_look_from(scene, views[0].towards, views[0].height);
    scene_end(scene);
    return scene;
}

static lobe_frame picture(fixture *f, const lobe_scene *scene, const char *filter,
                          const char *const *settings, bool seen) {
    picture_request request = {.filter = filter,
                               .settings = {"samples=1", seen ? "built=seen" : "built=whole"},
                               .width = EXTENT,
                               .height = EXTENT};
    for (int i = 0; settings[i]; i++)
        request.settings[2 + i] = settings[i];
    return draw_silently(f, scene->name, &request);
}

static void check_equal(const lobe_frame *a, const lobe_frame *b, const char *what, size_t number) {
    if (image_hash(&a->radiance) != image_hash(&b->radiance))
        fail_msg("%s, view %zu: largest difference %g of %g", what, number,
                 largest_difference(&a->radiance, &b->radiance), largest_value(&b->radiance));
}

/// From all places, one after another: what was made for one is kept for the next.
static void check_views(fixture *f, lobe_scene *scene, const char *filter,
                        const char *const *settings, const char *what) {
    enum { VIEWS = sizeof views / sizeof *views };
    lobe_frame whole[VIEWS];
    for (int seen = 0; seen < 2; seen++) {
        assert_int_equal(lobe_renderer_set_scene(f->renderer, scene), LOBE_OK);
        for (size_t i = 0; i < 2 * VIEWS; i++) {
            const view *from = &views[i % VIEWS];
            scene_look_from(scene, from->towards, from->height);
            lobe_frame frame = picture(f, scene, filter, settings, seen);
            assert_true(largest_value(&frame.radiance) > 0.01);
            if (seen)
                check_equal(&frame, &whole[i % VIEWS], what, i);
            if (!seen && i < VIEWS)
                whole[i] = frame;
            else
                lobe_frame_free(&frame);
        }
    }
    for (size_t i = 0; i < VIEWS; i++)
        lobe_frame_free(&whole[i]);
    assert_int_equal(lobe_renderer_set_scene(f->renderer, NULL), LOBE_OK);
}

static void pictures_equal_those_of_whole_maps(void **state) {
    static const struct {
        const char *filter;
        uint32_t width, height;
        double tiles;
        lobe_scene_wrap wrap;
        const char *settings[4];
    } cases[] = {
        {"moments", 128, 128, 3, LOBE_SCENE_WRAP_REPEAT, {"storage=float32"}},
        {"moments", 128, 128, 1, LOBE_SCENE_WRAP_REPEAT, {"storage=snorm16"}},
        {"moments", 75, 130, 2.5, LOBE_SCENE_WRAP_MIRROR, {"storage=float32"}},
        {"moments", 257, 31, 1.5, LOBE_SCENE_WRAP_CLAMP, {"storage=float32"}},
        {"moments", 512, 512, 1, LOBE_SCENE_WRAP_REPEAT, {"storage=float16", "probes=4"}},
        {"moments", 256, 128, 8, LOBE_SCENE_WRAP_MIRROR, {"storage=float32", "bias=1", "probes=2"}},
        {"moments", 256, 256, 1, LOBE_SCENE_WRAP_CLAMP, {"storage=float32", "bias=-2", "bins=4"}},
        {"mipmap", 128, 90, 2, LOBE_SCENE_WRAP_REPEAT, {"storage=float32"}},
        {"toksvig", 128, 90, 2, LOBE_SCENE_WRAP_REPEAT, {"storage=float16"}},
        {"lean", 160, 96, 2, LOBE_SCENE_WRAP_REPEAT, {"storage=float32"}},
        {"leadr", 128, 90, 2, LOBE_SCENE_WRAP_REPEAT, {"storage=float32"}},
        {"lobes", 192, 90, 2, LOBE_SCENE_WRAP_REPEAT, {"storage=float32"}},
        {"lobes", 64, 64, 1, LOBE_SCENE_WRAP_REPEAT, {"space=object"}},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        lobe_scene *scene =
            mapped_scene(cases[i].width, cases[i].height, cases[i].tiles, cases[i].wrap);
        const char *filter = cases[i].filter;
        char what[64];
        snprintf(what, sizeof what, "%s, %u x %u, %s", filter, cases[i].width, cases[i].height,
                 cases[i].settings[0]);
        check_views(*state, scene, filter, cases[i].settings, what);
        lobe_scene_destroy(&scene);
    }
}

// ---------------------------------------------------------------------------------------------
// Content that changes

/// A host that gives a copy of a texture.
typedef struct texture_giver {
    lobe_texture *texture;
    uint32_t image; ///< of the scene
} texture_giver;

static void give(void *user, lobe_graph *graph, const lobe_given_content *content) {
    const texture_giver *giver = user;
    const lobe_resource texture = lobe_graph_import_texture(graph, giver->texture);
    lobe_image_description copy = lobe_graph_describe_image(graph, texture);
    copy.name = "given";
    lobe_pass *pass = lobe_graph_add_pass(graph, LOBE_PASS_TRANSFER, "give");
    content->images[giver->image] = lobe_pass_copy(pass, texture, (lobe_range){0},
                                                   lobe_graph_image(graph, &copy), (lobe_range){0});
}

static void fill(lobe_image *image, const float texel[4]) {
    for (size_t i = 0; i < (size_t)image->width * image->height; i++)
        memcpy((float *)image->texels + 4 * i, texel, 4 * sizeof *texel);
}

/// A frame that sees the whole map, made from `poison`, then one that sees a part of it.
static lobe_frame frame_after(fixture *f, lobe_scene *scene, const texture_giver *giver,
                              const lobe_image *poison, bool seen) {
    static const char *const settings[] = {"storage=float32", "partition=hats", NULL};
    assert_int_equal(lobe_renderer_set_scene(f->renderer, scene), LOBE_OK);
    scene_look_from(scene, views[0].towards, views[0].height);
    assert_int_equal(lobe_texture_update(giver->texture, poison), LOBE_OK);
    lobe_frame spoilt = picture(f, scene, "moments", settings, seen);
    lobe_frame_free(&spoilt);
    assert_int_equal(lobe_texture_update(giver->texture, &scene->images[giver->image].image),
                     LOBE_OK);
    scene_look_from(scene, views[2].towards, views[2].height);
    lobe_frame frame = picture(f, scene, "moments", settings, seen);
    assert_true(all_finite(&frame.radiance) && largest_value(&frame.radiance) > 0.01);
    return frame;
}

static void check_unread_tiles(fixture *f, uint32_t index) {
    static const float poisons[2][4] = {{NAN, NAN, NAN, NAN}, {0.95f, 0.5f, 0.6f, 1}};
    lobe_scene *scene = mapped_scene(256, 256, 1, LOBE_SCENE_WRAP_REPEAT);
    lobe_image *image = &scene->images[index].image, poison;
    texture_giver giver = {.image = index};
    const lobe_texture_parameters parameters = {.image = image};
    assert_int_equal(lobe_image_allocate(&poison, image->format, image->width, image->height, NULL),
                     LOBE_OK);
    assert_int_equal(lobe_texture_create(f->device, &parameters, &giver.texture), LOBE_OK);
    scene->images[index].on_device = true;
    lobe_renderer_set_content_giver(f->renderer, give, &giver);
    lobe_frame whole = frame_after(f, scene, &giver, image, false);
    for (int i = 0; i < 2; i++) {
        fill(&poison, poisons[i]);
        lobe_frame frame = frame_after(f, scene, &giver, &poison, true);
        check_equal(&frame, &whole, "after other texels", 10 * index + (size_t)i);
        lobe_frame_free(&frame);
    }
    lobe_frame_free(&whole);
    lobe_renderer_set_content_giver(f->renderer, NULL, NULL);
    assert_int_equal(lobe_renderer_set_scene(f->renderer, NULL), LOBE_OK);
    lobe_texture_destroy(&giver.texture);
    lobe_image_free(&poison);
    lobe_scene_destroy(&scene);
}

/// Of the map of lobes, and of two maps of colours.
static void tiles_that_are_not_read_may_hold_anything(void **state) {
    for (uint32_t image = 0; image < 4; image++)
        if (image != 1) // of widths
            check_unread_tiles(*state, image);
}

/// Swaps the first two channels.
static void swap_channels(float *texels, size_t count) {
    for (size_t i = 0; i < count; i++) {
        const float first = texels[4 * i];
        texels[4 * i] = texels[4 * i + 1];
        texels[4 * i + 1] = first;
    }
}

/// Texels that the host changes, and settings, are other content.
static void tiles_follow_what_they_are_made_from(void **state) {
    static const char *const settings[2][2] = {{"storage=float32"}, {"storage=float16"}};
    static const uint32_t image = 0;
    const lobe_scene_changes changes = {.images = &image, .image_count = 1};
    fixture *f = *state;
    lobe_scene *scene = mapped_scene(128, 128, 1, LOBE_SCENE_WRAP_REPEAT);
    float *texels = scene->images[0].image.texels;
    lobe_frame frames[2][4];
    for (int seen = 0; seen < 2; seen++) {
        assert_int_equal(lobe_renderer_set_scene(f->renderer, scene), LOBE_OK);
        for (int i = 0; i < 4; i++) {
            // Reflects all normals in a diagonal, and back.
            if (i > 1)
                swap_channels(texels, (size_t)128 * 128);
            if (i > 1)
                assert_int_equal(lobe_renderer_update_scene(f->renderer, &changes), LOBE_OK);
            frames[seen][i] = picture(f, scene, "moments", settings[i % 2], seen);
        }
    }
    for (int i = 0; i < 4; i++) {
        check_equal(&frames[1][i], &frames[0][i], "change", i);
        assert_true(i == 0 ||
                    image_hash(&frames[0][i].radiance) != image_hash(&frames[0][i - 1].radiance));
        lobe_frame_free(&frames[0][i]);
        lobe_frame_free(&frames[1][i]);
    }
    assert_int_equal(lobe_renderer_set_scene(f->renderer, NULL), LOBE_OK);
    lobe_scene_destroy(&scene);
}

/// A metal whose colours lie as its lobes do, if they have as few texels (128): these count by what
/// they mirror. Of colours with more texels than lobes, only metal counts.
static lobe_scene *coloured_metal(uint32_t colours) {
    lobe_scene *scene = scene_begin();
    lobe_material material = microfacet_material(LOBE_DISTRIBUTION_GGX, 0.5, 1);
    material.normal_map = scene_add_map(scene, random_normal_map(128, 128, 0.5, 7));
    material.metallic_roughness_map = scene_add_map(scene, random_map(128, 128, 0.3, 0.9, 8));
    material.base_colour_map = scene_add_map(scene, random_map(colours, colours, 0.02, 0.9, 9));
    scene_add_square(scene, &material, 1, NULL);
    scene_add_sun(scene, (double[]){0.3, 1, 0.2}, 2);
    scene_look_from(scene, views[0].towards, views[0].height);
    scene_end(scene);
    return scene;
}

/// So are factors of colour and of metal, where texels count by what they mirror: tiles, and whole
/// maps, that were made with others give the pictures of a scene that is set anew.
static void tiles_follow_factors(void **state) {
    enum { CHANGES = 3, WAYS = 3 };
    static const struct {
        const char *filter, *settings[2];
        uint32_t colours;
    } cases[] = {{"moments", {"refit=anew"}, 128}, {"lobes", {NULL}, 128}, {"leadr", {NULL}, 256}};
    static const uint32_t first = 0;
    const lobe_scene_changes changes = {.materials = &first, .material_count = 1};
    fixture *f = *state;
    for (size_t n = 0; n < sizeof cases / sizeof *cases; n++) {
        lobe_scene *scene = coloured_metal(cases[n].colours);
        lobe_material *material = &scene->materials[0];
        lobe_frame frames[WAYS][CHANGES];
        for (int way = 0; way < WAYS; way++) {
            material->base_colour[1] = 1;
            material->metallic = 1;
            for (int i = 0; i < CHANGES; i++) {
                if (i == 1)
                    material->base_colour[1] = 0.02f;
                else if (i == 2)
                    material->metallic = 0.3f;
                assert_int_equal(i == 0 || way == 2
                                     ? lobe_renderer_set_scene(f->renderer, scene)
                                     : lobe_renderer_update_scene(f->renderer, &changes),
                                 LOBE_OK);
                frames[way][i] = picture(f, scene, cases[n].filter, cases[n].settings, way == 1);
            }
        }
        for (int i = 0; i < WAYS * CHANGES; i++)
            check_equal(&frames[i / CHANGES][i % CHANGES], &frames[2][i % CHANGES], cases[n].filter,
                        (size_t)i);
        for (int i = 0; i < WAYS * CHANGES; i++)
            lobe_frame_free(&frames[i / CHANGES][i % CHANGES]);
        assert_int_equal(lobe_renderer_set_scene(f->renderer, NULL), LOBE_OK);
        lobe_scene_destroy(&scene);
    }
}

/// A square whose mask keeps texels at random.
static lobe_scene *masked_metal(void) {
    enum { TEXELS = 64 * 64 };
    lobe_scene *scene = coloured_metal(64);
    lobe_material *material = &scene->materials[0];
    lobe_image alpha = random_map(64, 64, 0, 1, 10);
    float *colours = scene->images[material->base_colour_map.image].image.texels;
    for (size_t i = 0; i < TEXELS; i++)
        colours[4 * i + 3] = ((const float *)alpha.texels)[4 * i];
    lobe_image_free(&alpha);
    material->alpha_mask = true;
    material->alpha_cutoff = 0.3f;
    return scene;
}

/// Changes the mask of such a scene, or how its maps are read.
static void change_reading(lobe_scene *scene, int change) {
    lobe_material *material = &scene->materials[0];
    lobe_texture_use *const uses[] = {&material->normal_map, &material->metallic_roughness_map,
                                      &material->base_colour_map};
    lobe_mesh *mesh = &scene->meshes[0];
    material->alpha_cutoff = change >= 1 ? 0.5f : 0.3f;
    material->base_colour[3] = change == 2 ? 0.8f : 1;
    mesh->has_colour = change == 3;
    for (size_t i = 0; i < mesh->vertex_count; i++)
        mesh->vertices[i].colour[3] = change == 3 ? 0.7f : 1;
    for (size_t i = 0; i < sizeof uses / sizeof *uses; i++) {
        uses[i]->wrap_u = change >= 4 ? LOBE_SCENE_WRAP_CLAMP : LOBE_SCENE_WRAP_REPEAT;
        uses[i]->nearest = change == 5;
    }
}

static void tiles_follow_masks_and_samplers(void **state) {
    enum { CHANGES = 6 };
    static const char *const filters[] = {"mipmap", "lobes", "moments"};
    static const char *const settings[] = {NULL};
    static const uint32_t first = 0;
    const lobe_scene_changes changes = {
        .materials = &first, .material_count = 1, .meshes = &first, .mesh_count = 1};
    fixture *f = *state;
    for (size_t n = 0; n < sizeof filters / sizeof *filters; n++) {
        lobe_frame frames[2][CHANGES];
        for (int seen = 0; seen < 2; seen++) {
            lobe_scene *scene = masked_metal();
            assert_int_equal(lobe_renderer_set_scene(f->renderer, scene), LOBE_OK);
            for (int i = 0; i < CHANGES; i++) {
                change_reading(scene, i);
                if (i > 0)
                    assert_int_equal(lobe_renderer_update_scene(f->renderer, &changes), LOBE_OK);
                frames[seen][i] = picture(f, scene, filters[n], settings, seen);
            }
            assert_int_equal(lobe_renderer_set_scene(f->renderer, NULL), LOBE_OK);
            lobe_scene_destroy(&scene);
        }
        for (int i = 0; i < CHANGES; i++) {
            check_equal(&frames[1][i], &frames[0][i], filters[n], (size_t)i);
            assert_true(i == 0 || image_hash(&frames[0][i].radiance) !=
                                      image_hash(&frames[0][i - 1].radiance));
        }
        for (int i = 0; i < 2 * CHANGES; i++)
            lobe_frame_free(&frames[i / CHANGES][i % CHANGES]);
    }
}

/// Bins go on to change when texels no longer do.
static void tiles_follow_bins_that_settle(void **state) {
    enum { MOVING = 3, FRAMES = 9 };
    static const char *const settings[] = {"storage=float32", "bins=2", "frames_of_fit=2", NULL};
    static const uint32_t image = 0;
    const lobe_scene_changes changes = {.images = &image, .image_count = 1};
    fixture *f = *state;
    lobe_scene *scene = mapped_scene(64, 64, 1, LOBE_SCENE_WRAP_REPEAT);
    float *texels = scene->images[0].image.texels, first[64 * 64];
    lobe_frame frames[2][FRAMES];
    for (int k = 0; k < 64 * 64; k++)
        first[k] = texels[4 * k];
    for (int seen = 0; seen < 2; seen++) {
        assert_int_equal(lobe_renderer_set_scene(f->renderer, scene), LOBE_OK);
        for (int i = 0; i < FRAMES; i++) {
            for (int k = 0; i < MOVING && k < 64 * 64; k++)
                texels[4 * k] = 0.5f + (0.4f + (float)i * 0.1f) * (first[k] - 0.5f);
            if (i < MOVING)
                assert_int_equal(lobe_renderer_update_scene(f->renderer, &changes), LOBE_OK);
            frames[seen][i] = picture(f, scene, "moments", settings, seen);
        }
    }
    for (int i = 0; i < FRAMES; i++) {
        check_equal(&frames[1][i], &frames[0][i], "fit", i);
        lobe_frame_free(&frames[0][i]);
        lobe_frame_free(&frames[1][i]);
    }
    assert_int_equal(lobe_renderer_set_scene(f->renderer, NULL), LOBE_OK);
    lobe_scene_destroy(&scene);
}

/// Two materials that share an image, one of which is hidden while its texels change.
static void shared_images_follow_their_texels(void **state) {
    static const char *const settings[] = {"storage=float32", NULL};
    static const uint32_t image = 2; // colours
    const lobe_scene_changes changes = {.images = &image, .image_count = 1};
    fixture *f = *state;
    lobe_scene *scene = mapped_scene(64, 64, 1, LOBE_SCENE_WRAP_REPEAT);
    lobe_material second = scene->materials[0];
    float right[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0.5f, 0.1f, 0, 1};
    second.name = NULL;
    second.roughness = 0.9f;
    scene_add_square(scene, &second, 1, right);
    scene_end(scene);
    float *texels = scene->images[image].image.texels;
    lobe_frame frames[2][4];
    for (int seen = 0; seen < 2; seen++) {
        assert_int_equal(lobe_renderer_set_scene(f->renderer, scene), LOBE_OK);
        for (int i = 0; i < 4; i++) {
            scene->instances[0].hidden = i == 1;
            scene->instances[1].hidden = i == 2;
            if (i > 0)
                swap_channels(texels, (size_t)128 * 64);
            assert_int_equal(lobe_renderer_update_scene(f->renderer, &changes), LOBE_OK);
            frames[seen][i] = picture(f, scene, "lean", settings, seen);
        }
        swap_channels(texels, (size_t)128 * 64);
    }
    for (int i = 0; i < 4; i++) {
        check_equal(&frames[1][i], &frames[0][i], "shared", i);
        lobe_frame_free(&frames[0][i]);
        lobe_frame_free(&frames[1][i]);
    }
    assert_int_equal(lobe_renderer_set_scene(f->renderer, NULL), LOBE_OK);
    lobe_scene_destroy(&scene);
}

/// Beside surfaces of which nothing is marked, tiles are those that the others show.
static void surfaces_without_maps_mark_nothing(void **state) {
    static const char *const settings[] = {"storage=float32", NULL};
    fixture *f = *state;
    lobe_scene *scene = mapped_scene(256, 256, 1, LOBE_SCENE_WRAP_REPEAT);
    lobe_material second = scene->materials[0];
    const lobe_material plain = microfacet_material(LOBE_DISTRIBUTION_GGX, 0.5, 0);
    const float right[16] = {0.5f, 0, 0, 0, 0, 0.5f, 0, 0, 0, 0, 0.5f, 0, 0.3f, 0.1f, 0, 1};
    const float small[16] = {0.1f, 0, 0, 0, 0, 0.1f, 0, 0, 0, 0, 0.1f, 0, -0.3f, 0.1f, 0, 1};
    second.name = NULL;
    second.roughness = 0.9f;
    scene_add_square(scene, &second, 1, right);
    for (int i = 0; i < 3; i++)
        scene_add_square(scene, &plain, 1, small);
    scene_end(scene);
    check_views(f, scene, "lean", settings, "beside plain surfaces");
    lobe_scene_destroy(&scene);
}

/// Four times as many points have half the error.
static void samples_of_texels_converge(void **state) {
    static const char *const settings[4][3] = {{"storage=float32"},
                                               {"storage=float32", "texel_samples=4"},
                                               {"storage=float32", "texel_samples=16"},
                                               {"storage=float32", "texel_samples=64"}};
    fixture *f = *state;
    lobe_scene *scene = mapped_scene(1024, 1024, 1, LOBE_SCENE_WRAP_REPEAT);
    lobe_frame frames[4];
    double errors[4];
    assert_int_equal(lobe_renderer_set_scene(f->renderer, scene), LOBE_OK);
    for (int i = 0; i < 4; i++) {
        frames[i] = picture(f, scene, "moments", settings[i], true);
        errors[i] = relative_l2(&frames[i].radiance, &frames[0].radiance);
        print_message("# %s: error %.4f\n", i ? settings[i][1] : "all", errors[i]);
    }
    assert_true(errors[1] < 0.5);
    for (int i = 2; i < 4; i++)
        assert_true(errors[i] < 0.65 * errors[i - 1] && errors[i] > 0.35 * errors[i - 1]);
    for (int i = 0; i < 4; i++)
        lobe_frame_free(&frames[i]);
    assert_int_equal(lobe_renderer_set_scene(f->renderer, NULL), LOBE_OK);
    lobe_scene_destroy(&scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(tiles_that_marks_need_are_listed_once),
        cmocka_unit_test(pictures_equal_those_of_whole_maps),
        cmocka_unit_test(tiles_that_are_not_read_may_hold_anything),
        cmocka_unit_test(tiles_follow_what_they_are_made_from),
        cmocka_unit_test(tiles_follow_factors),
        cmocka_unit_test(tiles_follow_masks_and_samplers),
        cmocka_unit_test(tiles_follow_bins_that_settle),
        cmocka_unit_test(shared_images_follow_their_texels),
        cmocka_unit_test(surfaces_without_maps_mark_nothing),
        cmocka_unit_test(samples_of_texels_converge),
    };
    return cmocka_run_group_tests(tests, fixture_create_validated, fixture_destroy);
}
