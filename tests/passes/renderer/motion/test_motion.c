// Motion vectors: those of points projected in double precision, for whatever moves.

#include "tests/passes/support/fixture.h"

#include <math.h>
#include <string.h>

#include "scenes/scene/scene.h"
#include "shaders/interface/motion.h"
#include "tests/engine/support/host_device.h"
#include "tests/passes/renderer/motion/plate_motion.h"
#include "tests/passes/support/picture.h"
#include "tests/passes/support/scene_builder.h"

enum { WIDTH = 40, HEIGHT = 30, PLATES = 4 };

/// Where the squares and the camera are in one frame.
typedef struct placement {
    lobe_camera camera;
    float transforms[PLATES][16];
} placement;

static const placement first_place = {
    .camera = {.eye = {0.3f, 2, 2.5f},
               .target = {0.1f, 0, -0.2f},
               .up = {0.1f, 1, 0},
               .vertical_field_of_view = 0.8f,
               .orthographic_height = 2.5f,
               .near_plane = 0.05f},
    .transforms = {{0.8f, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0.8f, 0, 0, -0.2f, 0, 1},
                   {0.3f, 0.1f, 0, 0, 0, 1, 0, 0, 0, 0, 0.4f, 0, -0.5f, 0.2f, 0.3f, 1},
                   // Mirrored, which makes a batch of its own.
                   {-0.3f, 0, 0.1f, 0, 0, 1, 0, 0, 0, 0.2f, 0.3f, 0, 0.6f, 0.3f, 0.2f, 1},
                   {0.2f, 0, 0, 0, 0, 1, 0, 0, 0.1f, 0, 0.2f, 0, 0.1f, 0.4f, -0.5f, 1}},
};

/// The second square turns, the third is stretched, the fourth goes away.
static void move_plates(placement *place) {
    const float turned[16] = {0.24f, 0.1f, 0.18f, 0, 0,     1,     0,    0,
                              -0.2f, 0.1f, 0.3f,  0, -0.4f, 0.25f, 0.3f, 1};
    memcpy(place->transforms[1], turned, sizeof turned);
    place->transforms[2][0] *= 1.5f;
    place->transforms[2][13] += 0.1f;
    place->transforms[3][12] -= 0.25f;
}

static void move_camera(placement *place) {
    place->camera.eye[0] -= 0.2f;
    place->camera.eye[2] += 0.3f;
    place->camera.target[1] += 0.15f;
    place->camera.up[0] = 0.2f;
    place->camera.vertical_field_of_view = 0.7f;
}

static void apply(lobe_scene *scene, const placement *place) {
    scene->camera = place->camera;
    for (size_t i = 0; i < PLATES; i++)
        memcpy(scene->instances[i].transform, place->transforms[i], sizeof place->transforms[i]);
}

/// Two squares of each of two materials.
static lobe_scene *plates(const placement *place) {
    lobe_scene *scene = scene_begin();
    for (uint32_t m = 0; m < 2; m++) {
        lobe_material material;
        lobe_material_default(&material);
        material.double_sided = true;
        material.roughness = 0.4f;
        material.normal_map = scene_add_map(scene, random_normal_map(8, 8, 0.3, 300 + m));
        scene_add_square(scene, &material, 1, NULL);
    }
    for (uint32_t m = 0; m < 2; m++)
        assert_int_equal(scenes_add_instance(scene, m, m, place->transforms[0], NULL), LOBE_OK);
    scene_add_sun(scene, (double[]){0.3, 1, 0.2}, 2);
    scene_end(scene);
    for (int i = 0; i < 3; i++) {
        scene->minimum[i] = -3;
        scene->maximum[i] = 3;
    }
    apply(scene, place);
    scene->has_camera = true;
    return scene;
}

static lobe_render_parameters parameters(void) {
    return (lobe_render_parameters){
        .filter = filter_named("direct"), .width = WIDTH, .height = HEIGHT, .motion.deliver = true};
}

static lobe_frame render(fixture *f, const lobe_render_parameters *wanted) {
    lobe_frame frame;
    if (lobe_renderer_render(f->renderer, wanted, &frame) != LOBE_OK)
        fail_msg("%s", f->error);
    return frame;
}

static lobe_image motion_of(fixture *f, const lobe_render_parameters *wanted) {
    lobe_frame frame = render(f, wanted);
    const lobe_image motion = frame.motion;
    assert_true(motion.format == LOBE_FORMAT_RG32_FLOAT && motion.width == WIDTH &&
                motion.height == HEIGHT && motion.texels);
    frame.motion = (lobe_image){0};
    lobe_frame_free(&frame);
    return motion;
}

static const float *at(const lobe_image *motion, const uint32_t pixel[2]) {
    return (const float *)motion->texels + 2 * ((size_t)pixel[1] * WIDTH + pixel[0]);
}

static lobe_scene *start(fixture *f, const placement *place) {
    lobe_scene *scene = plates(place);
    fixture_forget_messages(f);
    assert_int_equal(lobe_renderer_set_scene(f->renderer, scene), LOBE_OK);
    return scene;
}

static void stop(fixture *f, lobe_scene **scene) {
    assert_int_equal(lobe_renderer_set_scene(f->renderer, NULL), LOBE_OK);
    lobe_scene_destroy(scene);
    assert_int_equal(f->errors, 0);
    assert_int_equal(lobe_device_validation_count(f->device), 0);
}

static size_t moving_pixels(const lobe_image *motion) {
    const float *texels = motion->texels;
    size_t count = 0;
    for (size_t i = 0; i < WIDTH * HEIGHT; i++)
        count += texels[2 * i] != 0 || texels[2 * i + 1] != 0;
    return count;
}

// ---------------------------------------------------------------------------------------------
// The reference

static plate_view view_of(const placement *place) {
    return (plate_view){place->camera, WIDTH, HEIGHT};
}

/// What to expect in a pixel; false: rounding decides.
static bool expected_motion(const placement *before, const placement *now, const uint32_t pixel[2],
                            double motion[2]) {
    const plate_view previous = view_of(before), current = view_of(now);
    const plate_hit hit = plate_seen(&current, now->transforms, PLATES, pixel);
    double position[2];
    motion[0] = motion[1] = 0;
    if (hit.unsure)
        return false;
    if (!hit.hit && now->camera.vertical_field_of_view == 0)
        return true;
    const bool seen =
        hit.hit ? plate_projected(&previous, before->transforms[hit.plate], hit.place, position)
                : plate_distance_projected(&previous, &current, pixel, position);
    for (int i = 0; i < 2; i++)
        motion[i] =
            seen ? position[i] - (pixel[i] + 0.5 + (double)now->camera.jitter[i]) : MOTION_LIMIT;
    return true;
}

/// At most so many pixels of error, and the same relative to the motion's length. GPUs round
/// vertices to 1/256 of a pixel before they interpolate.
static double slack_of(const fixture *f) {
    return lobe_device_describe(f->device)->type == LOBE_DEVICE_CPU ? 1e-4 : 1.0 / 256;
}

static void check_motion(const fixture *f, const char *what, const lobe_image *motion,
                         const placement *before, const placement *now) {
    size_t checked = 0;
    for (uint32_t i = 0; i < WIDTH * HEIGHT; i++) {
        const uint32_t pixel[2] = {i % WIDTH, i / WIDTH};
        double expected[2];
        if (!expected_motion(before, now, pixel, expected))
            continue;
        const float *found = at(motion, pixel);
        ++checked;
        for (int k = 0; k < 2; k++) {
            const double error = fabs((double)found[k] - expected[k]);
            if (!(error < slack_of(f) * (1 + 0.1 * fabs(expected[k]))))
                fail_msg("%s: pixel %u, %u moves by %g, %g; expected %g, %g", what, pixel[0],
                         pixel[1], (double)found[0], (double)found[1], expected[0], expected[1]);
        }
    }
    if (checked < WIDTH * HEIGHT * 98 / 100)
        fail_msg("%s: only %zu pixels are sure", what, checked);
}

// ---------------------------------------------------------------------------------------------
// What moves

typedef struct motion_case {
    const char *name;
    bool plates, camera;
    float shifts[2][2], jitters[2][2]; ///< of both frames
    bool orthographic[2];
} motion_case;

static const motion_case cases[] = {
    {.name = "squares", .plates = true},
    {.name = "camera", .camera = true},
    {.name = "both", .plates = true, .camera = true},
    {.name = "off the axis", .camera = true, .shifts = {{0.4f, -0.2f}, {-0.3f, 0.1f}}},
    {.name = "shift alone", .shifts = {{0.1f, -0.2f}, {0.15f, -0.25f}}},
    {.name = "jitter alone", .jitters = {{0.25f, -0.4f}, {-0.3f, 0.1f}}},
    {.name = "all",
     .plates = true,
     .camera = true,
     .shifts = {{0.1f, 0}, {0, 0.1f}},
     .jitters = {{0.5f, -0.5f}, {0.2f, 0.3f}}},
    {.name = "orthographic", .plates = true, .camera = true, .orthographic = {true, true}},
    {.name = "to an orthographic camera", .camera = true, .orthographic = {false, true}},
};

static void place_case(const motion_case *of, placement places[2]) {
    for (int n = 0; n < 2; n++) {
        places[n] = first_place;
        if (n == 1 && of->plates)
            move_plates(&places[n]);
        if (n == 1 && of->camera)
            move_camera(&places[n]);
        if (of->orthographic[n])
            places[n].camera.vertical_field_of_view = 0;
        memcpy(places[n].camera.shift, of->shifts[n], sizeof of->shifts[n]);
        memcpy(places[n].camera.jitter, of->jitters[n], sizeof of->jitters[n]);
    }
}

/// The renderer remembers the first frame, or is told of it.
static void motion_is_that_of_projected_points(void **state) {
    fixture *f = *state;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        placement places[2];
        lobe_render_parameters wanted = parameters();
        place_case(&cases[i], places);
        lobe_scene *scene = start(f, &places[0]);
        lobe_image motion = motion_of(f, &wanted);
        assert_int_equal(moving_pixels(&motion), 0);
        lobe_image_free(&motion);
        apply(scene, &places[1]);
        motion = motion_of(f, &wanted);
        check_motion(f, cases[i].name, &motion, &places[0], &places[1]);
        wanted.motion.previous_camera = &places[0].camera;
        wanted.motion.previous_transforms = (const float(*)[16])places[0].transforms;
        lobe_image given = motion_of(f, &wanted);
        assert_memory_equal(given.texels, motion.texels, (size_t)WIDTH * HEIGHT * 8);
        lobe_image_free(&motion);
        lobe_image_free(&given);
        stop(f, &scene);
    }
}

/// Not even by rounding, whatever the jitter.
static void what_stands_still_has_no_motion(void **state) {
    fixture *f = *state;
    placement place = first_place;
    place.camera.shift[0] = 0.123f;
    const lobe_render_parameters wanted = parameters();
    lobe_scene *scene = start(f, &place);
    for (int n = 0; n < 3; n++) {
        scene->camera.jitter[0] = 0.3f * (float)n - 0.4f;
        scene->camera.jitter[1] = 0.2f * (float)n;
        lobe_image motion = motion_of(f, &wanted);
        assert_int_equal(moving_pixels(&motion), 0);
        lobe_image_free(&motion);
    }
    stop(f, &scene);
}

/// A picture moves with its jitter as with a shift.
static void jitter_moves_the_picture(void **state) {
    fixture *f = *state;
    lobe_scene *scene = start(f, &first_place);
    lobe_render_parameters wanted = parameters();
    lobe_frame still = render(f, &wanted);
    scene->camera.jitter[0] = 0.25f;
    scene->camera.jitter[1] = -0.5f;
    lobe_frame jittered = render(f, &wanted);
    scene->camera = first_place.camera;
    scene->camera.shift[0] = 0.25f / HEIGHT;
    scene->camera.shift[1] = -0.5f / HEIGHT;
    lobe_frame shifted = render(f, &wanted);
    assert_true(relative_l2(&jittered.radiance, &shifted.radiance) < 1e-4);
    assert_true(relative_l2(&jittered.radiance, &still.radiance) > 1e-2);
    lobe_frame_free(&still);
    lobe_frame_free(&jittered);
    lobe_frame_free(&shifted);
    stop(f, &scene);
}

/// The surface that a mask leaves, the first of several samples, the reference.
static void motion_is_that_of_the_surface_that_is_seen(void **state) {
    static const char *const methods[][2] = {
        {"direct", NULL}, {"moments", "samples=4"}, {"reference", NULL}};
    fixture *f = *state;
    placement places[2];
    place_case(&cases[2], places);
    for (size_t i = 0; i < 3; i++) {
        lobe_scene *scene = start(f, &places[0]);
        // Nothing of the second material is kept: its squares show what is behind them.
        scene->materials[1].alpha_mask = true;
        scene->materials[1].alpha_cutoff = 0.5f;
        scene->materials[1].base_colour[3] = 0.1f;
        assert_int_equal(lobe_renderer_set_scene(f->renderer, scene), LOBE_OK);
        lobe_render_parameters wanted = parameters();
        wanted.filter = filter_named(methods[i][0]);
        wanted.reference.samples = 2;
        const char *const assignments[] = {methods[i][1], NULL};
        const lobe_settings settings = settings_of(wanted.filter, assignments);
        wanted.settings = &settings;
        lobe_image motion = motion_of(f, &wanted);
        lobe_image_free(&motion);
        apply(scene, &places[1]);
        motion = motion_of(f, &wanted);
        placement seen[2] = {places[0], places[1]};
        for (int n = 0; n < 2; n++) // out of sight; squares 1 and 3 have the second material
            seen[n].transforms[1][13] = seen[n].transforms[3][13] = 100;
        check_motion(f, methods[i][0], &motion, &seen[0], &seen[1]);
        lobe_image_free(&motion);
        stop(f, &scene);
    }
}

static void what_was_behind_the_eye_has_the_largest_motion(void **state) {
    fixture *f = *state;
    placement before = first_place;
    before.camera.target[0] = before.camera.eye[0];
    before.camera.target[1] = 2 * before.camera.eye[1];
    before.camera.target[2] = 2 * before.camera.eye[2];
    lobe_scene *scene = start(f, &first_place);
    lobe_render_parameters wanted = parameters();
    wanted.motion.previous_camera = &before.camera;
    lobe_image motion = motion_of(f, &wanted);
    const float *texels = motion.texels;
    for (size_t i = 0; i < WIDTH * HEIGHT * 2; i++)
        assert_true(texels[i] == MOTION_LIMIT);
    lobe_image_free(&motion);
    stop(f, &scene);
}

// ---------------------------------------------------------------------------------------------
// What the renderer remembers

/// Draws a frame in the first place and one in the second, with a change in between, and checks the
/// motion as if the given squares had stood still.
static void check_history(fixture *f, const char *what, lobe_scene *scene, const bool still[PLATES],
                          const lobe_scene_changes *changes) {
    placement places[2];
    place_case(&cases[2], places);
    const lobe_render_parameters wanted = parameters();
    apply(scene, &places[1]);
    if (changes)
        assert_int_equal(lobe_renderer_update_scene(f->renderer, changes), LOBE_OK);
    lobe_image motion = motion_of(f, &wanted);
    for (size_t i = 0; i < PLATES; i++)
        if (still[i])
            memcpy(places[0].transforms[i], places[1].transforms[i],
                   sizeof places[0].transforms[i]);
    check_motion(f, what, &motion, &places[0], &places[1]);
    lobe_image_free(&motion);
}

static void draw_first(fixture *f, lobe_scene *scene) {
    const lobe_render_parameters wanted = parameters();
    apply(scene, &first_place);
    assert_int_equal(lobe_renderer_set_scene(f->renderer, scene), LOBE_OK);
    lobe_image motion = motion_of(f, &wanted);
    assert_int_equal(moving_pixels(&motion), 0);
    lobe_image_free(&motion);
}

static void new_instances_have_not_moved(void **state) {
    static const uint32_t second = 1;
    fixture *f = *state;
    lobe_scene *scene = start(f, &first_place);
    draw_first(f, scene);
    check_history(f, "nothing new", scene, (bool[PLATES]){false}, NULL);
    draw_first(f, scene);
    check_history(f, "listed", scene, (bool[PLATES]){false, true},
                  &(lobe_scene_changes){.instances = &second, .instance_count = 1});
    scene->instances[3].hidden = true;
    draw_first(f, scene);
    scene->instances[3].hidden = false;
    check_history(f, "shown", scene, (bool[PLATES]){false, false, false, true}, NULL);
    draw_first(f, scene);
    scene->instance_count = 3;
    assert_int_equal(lobe_renderer_update_scene(f->renderer, &(lobe_scene_changes){0}), LOBE_OK);
    scene->instance_count = PLATES;
    check_history(f, "added", scene, (bool[PLATES]){false, false, false, true},
                  &(lobe_scene_changes){0});
    stop(f, &scene);
}

/// Frames without motion are not remembered, nor those that failed.
static void motion_is_that_since_the_last_frame_with_motion(void **state) {
    fixture *f = *state;
    lobe_scene *scene = start(f, &first_place);
    draw_first(f, scene);
    lobe_render_parameters other = parameters();
    scene->instances[1].transform[12] += 0.1f;
    other.motion.deliver = false;
    lobe_frame frame = render(f, &other);
    assert_null(frame.motion.texels);
    assert_int_equal(count_passes(lobe_renderer_graph(f->renderer), "motion", LOBE_PASS_RUN), 0);
    lobe_frame_free(&frame);
    check_history(f, "a frame without", scene, (bool[PLATES]){false}, NULL);
    stop(f, &scene);
}

static void motion_changes_no_picture(void **state) {
    fixture *f = *state;
    lobe_scene *scene = start(f, &first_place);
    lobe_render_parameters wanted = parameters();
    wanted.aov = true;
    lobe_frame with = render(f, &wanted);
    const size_t ran = count_passes(lobe_renderer_graph(f->renderer), NULL, LOBE_PASS_RUN);
    wanted.motion.deliver = false;
    lobe_frame without = render(f, &wanted);
    assert_int_equal(count_passes(lobe_renderer_graph(f->renderer), NULL, LOBE_PASS_RUN), ran - 1);
    assert_true(image_hash(&with.radiance) == image_hash(&without.radiance));
    assert_true(image_hash(&with.normal_depth) == image_hash(&without.normal_depth));
    lobe_frame_free(&with);
    lobe_frame_free(&without);
    stop(f, &scene);
}

// ---------------------------------------------------------------------------------------------
// Vertices on the device

typedef struct moved_vertices {
    lobe_buffer *now, *before; ///< `before` may be NULL
} moved_vertices;

static void give(void *user, lobe_graph *graph, const lobe_given_content *content) {
    const moved_vertices *vertices = user;
    content->vertices[0] = lobe_graph_import_buffer(graph, vertices->now);
    if (vertices->before)
        content->previous_vertices[0] = lobe_graph_import_buffer(graph, vertices->before);
}

static lobe_buffer *vertices_at(fixture *f, const lobe_mesh *mesh, float x) {
    lobe_scene_vertex vertices[64];
    lobe_buffer *buffer;
    assert_true(mesh->vertex_count <= 64);
    memcpy(vertices, mesh->vertices, mesh->vertex_count * sizeof *vertices);
    for (size_t i = 0; i < mesh->vertex_count; i++)
        vertices[i].position[0] += x;
    assert_int_equal(
        lobe_buffer_create(f->device,
                           &(lobe_buffer_parameters){.size = mesh->vertex_count * sizeof *vertices,
                                                     .data = vertices},
                           &buffer),
        LOBE_OK);
    return buffer;
}

/// Vertices that move by 0.1 m in the instance's space are those of an instance that moves by as
/// much; without those of before, nothing moves.
static void given_vertices_move_with_those_of_before(void **state) {
    fixture *f = *state;
    lobe_scene *scene = start(f, &first_place);
    const lobe_mesh *mesh = &scene->meshes[0];
    moved_vertices vertices = {vertices_at(f, mesh, 0), vertices_at(f, mesh, -0.1f)};
    lobe_buffer *const before = vertices.before;
    scene->meshes[0].on_device = true;
    assert_int_equal(lobe_renderer_set_scene(f->renderer, scene), LOBE_OK);
    lobe_renderer_set_content_giver(f->renderer, give, &vertices);
    const lobe_render_parameters wanted = parameters();
    lobe_image motion = motion_of(f, &wanted);
    placement moved = first_place;
    for (int i = 0; i < PLATES; i += 2) // those of the mesh
        for (int axis = 0; axis < 3; axis++)
            moved.transforms[i][12 + axis] -= 0.1f * moved.transforms[i][axis];
    // Squares 0 and 2 have the first mesh: see plates().
    check_motion(f, "given before", &motion, &moved, &first_place);
    lobe_image_free(&motion);
    vertices.before = NULL;
    motion = motion_of(f, &wanted);
    assert_int_equal(moving_pixels(&motion), 0);
    lobe_image_free(&motion);
    lobe_renderer_set_content_giver(f->renderer, NULL, NULL);
    lobe_buffer *now = vertices.now, *former = before;
    stop(f, &scene);
    lobe_buffer_destroy(&now);
    lobe_buffer_destroy(&former);
}

// ---------------------------------------------------------------------------------------------
// The host's images and passes

static lobe_vulkan_image lend(const host_image *image, VkImageLayout layout) {
    return (lobe_vulkan_image){.image = image->image,
                               .format = image->format,
                               .width = WIDTH,
                               .height = HEIGHT,
                               .usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT |
                                        VK_IMAGE_USAGE_TRANSFER_SRC_BIT |
                                        VK_IMAGE_USAGE_TRANSFER_DST_BIT,
                               .layout = layout,
                               .final_layout = VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL};
}

/// What lobe delivers goes into the host's image instead; with `keep`, only where lobe draws.
static void targets_get_motion(void **state) {
    fixture *f = *state;
    const VkImageUsageFlags usage = lend(&(host_image){0}, 0).usage;
    placement places[2];
    place_case(&cases[2], places);
    host_device host = {0};
    lobe_vulkan_export_device(f->device, &host.vulkan);
    const VkCommandPoolCreateInfo pool = {.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO,
                                          .queueFamilyIndex = host.vulkan.queue_family};
    assert_int_equal(vkCreateCommandPool(host.vulkan.device, &pool, NULL, &host.pool), VK_SUCCESS);
    host_image images[2];
    images[0] = host_image_create(&host, VK_FORMAT_R16G16B16A16_SFLOAT, WIDTH, HEIGHT, usage);
    images[1] = host_image_create(&host, VK_FORMAT_R32G32_SFLOAT, WIDTH, HEIGHT, usage);
    lobe_scene *scene = start(f, &places[1]);
    lobe_render_parameters wanted = parameters();
    wanted.motion.previous_camera = &places[0].camera;
    wanted.motion.previous_transforms = (const float(*)[16])places[0].transforms;
    lobe_image expected = motion_of(f, &wanted);
    for (int keep = 0; keep < 2; keep++) {
        VkCommandBuffer commands = host_begin(&host);
        for (int n = 0; n < 2; n++) {
            host_barrier(commands, &images[n], VK_IMAGE_LAYOUT_UNDEFINED,
                         VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL);
            host_clear(commands, &images[n], (float[4]){77, 78, 0, 0});
        }
        const lobe_vulkan_image lent[] = {lend(&images[0], VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL),
                                          lend(&images[1], VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL)};
        const lobe_render_target target = {
            .radiance = &lent[0], .motion = &lent[1], .keep = keep != 0};
        const lobe_vulkan_submission submission = {.commands = commands};
        wanted.motion.deliver = false; // the target asks for it
        wanted.host = (lobe_render_host){.target = &target, .submission = &submission};
        lobe_frame frame = render(f, &wanted);
        lobe_frame_free(&frame);
        host_finish(&host, commands);
        float texels[WIDTH * HEIGHT * 2];
        host_read(&host, &images[1], texels, sizeof texels);
        size_t kept = 0;
        for (uint32_t i = 0; i < WIDTH * HEIGHT; i++) {
            const float *found = texels + 2 * i, *other = (const float *)expected.texels + 2 * i;
            const bool is_kept = found[0] == 77 && found[1] == 78;
            assert_true(is_kept || (found[0] == other[0] && found[1] == other[1]));
            kept += is_kept;
        }
        assert_true(keep ? kept > 100 && kept < 1000 : kept == 0);
    }
    lobe_image_free(&expected);
    stop(f, &scene);
    for (int n = 0; n < 2; n++)
        host_image_destroy(&host, &images[n]);
    vkDestroyCommandPool(host.vulkan.device, host.pool, NULL);
}

static void look_at_resources(void *user, lobe_graph *graph, lobe_render_stage stage,
                              lobe_render_resources *resources) {
    const lobe_image_description motion = lobe_graph_describe_image(graph, resources->motion);
    (void)stage;
    *(unsigned *)user += motion.format == LOBE_FORMAT_RG32_FLOAT && motion.width == WIDTH;
}

static void passes_of_the_host_get_motion(void **state) {
    fixture *f = *state;
    lobe_scene *scene = start(f, &first_place);
    lobe_render_parameters wanted = parameters();
    unsigned seen = 0;
    wanted.host = (lobe_render_host){.add_passes = look_at_resources, .user = &seen};
    lobe_frame frame = render(f, &wanted);
    assert_int_equal(seen, 2);
    lobe_frame_free(&frame);
    wanted.motion.deliver = false;
    frame = render(f, &wanted);
    assert_int_equal(seen, 2);
    lobe_frame_free(&frame);
    stop(f, &scene);
}

// ---------------------------------------------------------------------------------------------
// Mistakes

static void refuse(fixture *f, const lobe_render_parameters *wanted, lobe_result expected,
                   const char *words) {
    lobe_frame frame;
    fixture_forget_messages(f);
    assert_failure(f, lobe_renderer_render(f->renderer, wanted, &frame), expected, words);
    assert_null(frame.motion.texels);
}

static void mistakes_are_named(void **state) {
    fixture *f = *state;
    lobe_scene *scene = start(f, &first_place);
    placement broken = first_place;
    lobe_render_parameters wanted = parameters();
    wanted.motion.previous_camera = &broken.camera;
    broken.camera.eye[1] = NAN;
    refuse(f, &wanted, LOBE_ERROR_INVALID_ARGUMENT, "eye[1] is nan");
    wanted.motion.previous_camera = NULL;
    wanted.motion.previous_transforms = (const float(*)[16])broken.transforms;
    broken.transforms[3][6] = INFINITY;
    refuse(f, &wanted, LOBE_ERROR_INVALID_ARGUMENT, "previous transform 3: elements[6] is inf");
    broken.transforms[3][6] = 0;
    broken.transforms[1][3] = 1;
    refuse(f, &wanted, LOBE_ERROR_INVALID_ARGUMENT, "the last row of previous transform 1");
    wanted = parameters();
    const lobe_vulkan_image image = {0};
    const lobe_render_target target = {.radiance = &image, .motion = &image};
    wanted.filter = filter_named("reference");
    wanted.host.target = &target;
    refuse(f, &wanted, LOBE_ERROR_UNSUPPORTED, "depth or motion");
    fixture_forget_messages(f);
    stop(f, &scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(motion_is_that_of_projected_points),
        cmocka_unit_test(what_stands_still_has_no_motion),
        cmocka_unit_test(jitter_moves_the_picture),
        cmocka_unit_test(motion_is_that_of_the_surface_that_is_seen),
        cmocka_unit_test(what_was_behind_the_eye_has_the_largest_motion),
        cmocka_unit_test(new_instances_have_not_moved),
        cmocka_unit_test(motion_is_that_since_the_last_frame_with_motion),
        cmocka_unit_test(motion_changes_no_picture),
        cmocka_unit_test(given_vertices_move_with_those_of_before),
        cmocka_unit_test(targets_get_motion),
        cmocka_unit_test(passes_of_the_host_get_motion),
        cmocka_unit_test(mistakes_are_named),
    };
    return cmocka_run_group_tests(tests, fixture_create_validated, fixture_destroy);
}
