#include "tests/engine/support/cmocka_all.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "tests/engine/graph/graph_support.h"

static lobe_pass *begin_with(graph_fixture *fixture, lobe_pass_kind kind) {
    lobe_graph_begin(fixture->graph);
    return lobe_graph_add_pass(fixture->graph, kind, "wrong");
}

static lobe_resource filled(graph_fixture *fixture, const char *name, size_t size) {
    lobe_pass *pass = lobe_graph_add_pass(fixture->graph, LOBE_PASS_TRANSFER, "fill");
    return lobe_pass_fill(pass, graph_fixture_buffer(fixture, name, size), (lobe_range){0},
                          (const float[4]){0});
}

static lobe_resource filled_image(graph_fixture *fixture, lobe_image_description description) {
    lobe_pass *pass = lobe_graph_add_pass(fixture->graph, LOBE_PASS_TRANSFER, "fill");
    return lobe_pass_fill(pass, lobe_graph_image(fixture->graph, &description), (lobe_range){0},
                          (const float[4]){0});
}

// ---------------------------------------------------------------------------------------------
// Handles and content

static void stale_handle(void **state) {
    graph_fixture *fixture = *state;
    lobe_graph_begin(fixture->graph);
    lobe_resource first = graph_fixture_buffer(fixture, "numbers", 256);
    graph_fixture_count(fixture, "writer", first, 1, 64);
    graph_fixture_count(fixture, "late", first, 1, 64);
    GRAPH_EXPECT(fixture, LOBE_ERROR_GRAPH, "'late'", "'numbers'", "'writer'", "stale");
}

static void handle_of_nothing(void **state) {
    graph_fixture *fixture = *state;
    lobe_pass *pass = begin_with(fixture, LOBE_PASS_COMPUTE);
    lobe_pass_read(pass, &(lobe_binding){.name = "x"});
    GRAPH_EXPECT(fixture, LOBE_ERROR_GRAPH, "'wrong'");
}

static void never_written(void **state) {
    graph_fixture *fixture = *state;
    lobe_graph_begin(fixture->graph);
    lobe_resource source = graph_fixture_buffer(fixture, "source", 256);
    lobe_resource target = graph_fixture_buffer(fixture, "target", 256);
    lobe_graph_output(fixture->graph, graph_fixture_add(fixture, "reader", source, target, 1, 64));
    GRAPH_EXPECT(fixture, LOBE_ERROR_GRAPH, "'reader'", "'source'", "no pass has written");
}

static void read_back_of_nothing(void **state) {
    graph_fixture *fixture = *state;
    lobe_graph_begin(fixture->graph);
    lobe_graph_read_back(fixture->graph, graph_fixture_buffer(fixture, "numbers", 256),
                         (lobe_range){0});
    GRAPH_EXPECT(fixture, LOBE_ERROR_GRAPH, "'read back'", "'numbers'");
}

static void import_is_written(void **state) {
    graph_fixture *fixture = *state;
    lobe_buffer *buffer = NULL;
    assert_int_equal(lobe_buffer_create(fixture->device,
                                        &(lobe_buffer_parameters){.name = "held", .size = 256},
                                        &buffer),
                     LOBE_OK);
    lobe_graph_begin(fixture->graph);
    graph_fixture_count(fixture, "writer", lobe_graph_import_buffer(fixture->graph, buffer), 1, 64);
    GRAPH_EXPECT(fixture, LOBE_ERROR_GRAPH, "'writer'", "'held'");
    lobe_buffer_destroy(&buffer);
}

static void a_cycle(void **state) {
    graph_fixture *fixture = *state;
    lobe_graph_begin(fixture->graph);
    lobe_resource x = graph_fixture_buffer(fixture, "x", 256);
    lobe_resource y = graph_fixture_buffer(fixture, "y", 256);
    lobe_pass *a = lobe_graph_add_pass(fixture->graph, LOBE_PASS_TRANSFER, "a");
    lobe_pass *b = lobe_graph_add_pass(fixture->graph, LOBE_PASS_TRANSFER, "b");
    lobe_resource p = graph_fixture_buffer(fixture, "p", 256);
    lobe_resource q = graph_fixture_buffer(fixture, "q", 256);
    x = lobe_pass_fill(a, x, (lobe_range){0}, (const float[4]){0});
    p = lobe_pass_copy(b, x, (lobe_range){0}, p, (lobe_range){0});
    y = lobe_pass_fill(b, y, (lobe_range){0}, (const float[4]){0});
    q = lobe_pass_copy(a, y, (lobe_range){0}, q, (lobe_range){0});
    lobe_graph_output(fixture->graph, q);
    GRAPH_EXPECT(fixture, LOBE_ERROR_GRAPH, "'a' before 'b' before 'a'", "'x'");
}

static void read_and_written_at_once(void **state) {
    graph_fixture *fixture = *state;
    lobe_graph_begin(fixture->graph);
    lobe_resource numbers = filled(fixture, "numbers", 256);
    lobe_pass *pass = lobe_graph_add_pass(fixture->graph, LOBE_PASS_COMPUTE, "both");
    const float constants[2] = {0};
    lobe_pass_read(pass, &(lobe_binding){.name = "source_block", .resource = numbers});
    lobe_pass_write(pass, &(lobe_binding){.name = "target_block", .resource = numbers});
    lobe_pass_dispatch(pass, &(lobe_dispatch){.shader = "graph_add.comp",
                                              .constants = constants,
                                              .constants_size = sizeof constants});
    GRAPH_EXPECT(fixture, LOBE_ERROR_GRAPH, "'both'", "'numbers'", "at once");
}

static void output_is_overwritten(void **state) {
    graph_fixture *fixture = *state;
    lobe_graph_begin(fixture->graph);
    lobe_resource numbers = filled(fixture, "numbers", 256);
    lobe_graph_output(fixture->graph, numbers);
    graph_fixture_count(fixture, "late", numbers, 1, 64);
    GRAPH_EXPECT(fixture, LOBE_ERROR_GRAPH, "'late'", "'numbers'");
}

static void range_outside(void **state) {
    graph_fixture *fixture = *state;
    lobe_pass *pass = begin_with(fixture, LOBE_PASS_TRANSFER);
    lobe_resource image = graph_fixture_image(fixture, "image", LOBE_FORMAT_R32_FLOAT, 4, 4);
    lobe_pass_fill(pass, image, (lobe_range){.first_level = 1}, (const float[4]){0});
    GRAPH_EXPECT(fixture, LOBE_ERROR_GRAPH, "'wrong'", "'image'", "level 1");
}

// ---------------------------------------------------------------------------------------------
// Resources

static void expect_image(graph_fixture *fixture, lobe_image_description description,
                         lobe_result expected, const char *word) {
    fixture->recorder.errors = 0;
    lobe_graph_begin(fixture->graph);
    description.name = "odd";
    lobe_graph_image(fixture->graph, &description);
    GRAPH_EXPECT(fixture, expected, "'odd'", word);
}

static void images_that_cannot_be(void **state) {
    graph_fixture *fixture = *state;
    char limit[16];
    snprintf(limit, sizeof limit, "%u",
             lobe_device_describe(fixture->device)->maximum_image_extent);
    const lobe_format format = LOBE_FORMAT_R32_FLOAT;
    expect_image(fixture,
                 (lobe_image_description){.format = format, .width = 65536, .height = 65536},
                 LOBE_ERROR_LIMIT, limit);
    expect_image(fixture, (lobe_image_description){.format = format, .width = 4}, LOBE_ERROR_GRAPH,
                 "4x0");
    expect_image(
        fixture,
        (lobe_image_description){.format = format, .width = 4, .height = 4, .layers = 1000000},
        LOBE_ERROR_LIMIT, "layers");
    expect_image(fixture, (lobe_image_description){.width = 4, .height = 4}, LOBE_ERROR_GRAPH,
                 "format");
    expect_image(fixture,
                 (lobe_image_description){.format = format, .width = 4, .height = 8, .levels = 5},
                 LOBE_ERROR_GRAPH, "5 levels");
    expect_image(fixture,
                 (lobe_image_description){.format = format, .width = 4, .height = 4, .samples = 3},
                 LOBE_ERROR_GRAPH, "samples");
    expect_image(fixture,
                 (lobe_image_description){
                     .format = format, .width = 4, .height = 4, .levels = 2, .samples = 4},
                 LOBE_ERROR_GRAPH, "multisampled");
}

static void buffers_that_cannot_be(void **state) {
    graph_fixture *fixture = *state;
    lobe_graph_begin(fixture->graph);
    graph_fixture_buffer(fixture, "odd", 0);
    GRAPH_EXPECT(fixture, LOBE_ERROR_GRAPH, "'odd'");
    fixture->recorder.errors = 0;
    lobe_graph_begin(fixture->graph);
    graph_fixture_buffer(fixture, "odd", (size_t)1 << 40);
    GRAPH_EXPECT(fixture, LOBE_ERROR_LIMIT, "'odd'", "1099511627776");
}

static void uploads_that_cannot_be(void **state) {
    graph_fixture *fixture = *state;
    void *data = calloc(1, (4 << 20) + 1);
    lobe_graph_begin(fixture->graph);
    lobe_graph_upload(fixture->graph, "odd", data, (4 << 20) + 1);
    GRAPH_EXPECT(fixture, LOBE_ERROR_LIMIT, "'odd'");
    fixture->recorder.errors = 0;
    lobe_graph_begin(fixture->graph);
    lobe_graph_upload(fixture->graph, "odd", data, 0);
    GRAPH_EXPECT(fixture, LOBE_ERROR_GRAPH, "'odd'");
    free(data);
}

static void retained_twice(void **state) {
    graph_fixture *fixture = *state;
    const lobe_buffer_description description = {.name = "same", .size = 16, .retained = true};
    lobe_graph_begin(fixture->graph);
    lobe_graph_buffer(fixture->graph, &description);
    lobe_graph_buffer(fixture->graph, &description);
    GRAPH_EXPECT(fixture, LOBE_ERROR_GRAPH, "'same'", "twice");
}

static void format_that_cannot_be_stored_to(void **state) {
    graph_fixture *fixture = *state;
    if (lobe_device_describe(fixture->device)->type != LOBE_DEVICE_CPU)
        skip(); // some GPUs can store to every format
    lobe_pass *pass = begin_with(fixture, LOBE_PASS_COMPUTE);
    lobe_resource image = graph_fixture_image(fixture, "depth", LOBE_FORMAT_D32_FLOAT, 8, 8);
    image = lobe_pass_write(pass, &(lobe_binding){.name = "target", .resource = image});
    lobe_pass_dispatch(pass, &(lobe_dispatch){.shader = "graph_paint.comp"});
    lobe_graph_output(fixture->graph, image);
    GRAPH_EXPECT(fixture, LOBE_ERROR_UNSUPPORTED, "'depth'", "D32_FLOAT");
}

/// On its own device, with little memory.
static void memory_is_exhausted(void **state) {
    (void)state;
    graph_fixture small = {0};
    log_recorder_start(&small.recorder);
    const lobe_device_parameters parameters = {.memory_limit = 1 << 20,
                                               .host = &small.recorder.host};
    assert_int_equal(lobe_device_create(&parameters, &small.device), LOBE_OK);
    assert_int_equal(lobe_graph_create(small.device, &small.graph), LOBE_OK);
    for (int retained = 0; retained < 2; retained++) {
        small.recorder.errors = 0;
        lobe_graph_begin(small.graph);
        lobe_image_description description = {.name = "large",
                                              .format = LOBE_FORMAT_RGBA32_FLOAT,
                                              .width = 2048,
                                              .height = 2048,
                                              .retained = retained};
        lobe_graph_output(small.graph, filled_image(&small, description));
        GRAPH_EXPECT(&small, LOBE_ERROR_OUT_OF_DEVICE_MEMORY, "large", "67108864");
    }
    // The graph still works.
    small.recorder.errors = 0;
    lobe_graph_begin(small.graph);
    lobe_graph_output(small.graph, filled(&small, "small", 256));
    graph_fixture_execute(&small);
    lobe_graph_destroy(&small.graph);
    lobe_device_destroy(&small.device);
}

// ---------------------------------------------------------------------------------------------
// Passes and calls

static void calls_for_other_kinds_of_pass(void **state) {
    graph_fixture *fixture = *state;
    for (int i = 0; i < 8; i++) {
        fixture->recorder.errors = 0;
        lobe_pass_kind kind = i < 2   ? LOBE_PASS_RASTER
                              : i < 6 ? LOBE_PASS_COMPUTE
                                      : LOBE_PASS_TRANSFER;
        lobe_pass *pass = begin_with(fixture, kind);
        lobe_resource image = graph_fixture_image(fixture, "image", LOBE_FORMAT_R32_FLOAT, 4, 4);
        if (i == 0)
            lobe_pass_dispatch(pass, &(lobe_dispatch){.shader = "graph_paint.comp"});
        else if (i == 1)
            lobe_pass_fill(pass, image, (lobe_range){0}, (const float[4]){0});
        else if (i == 2)
            lobe_pass_draw(pass, &(lobe_draw){.vertex_shader = "graph_triangle.vert"});
        else if (i == 3)
            lobe_pass_colour(pass, 0, &(lobe_attachment){.resource = image});
        else if (i == 4)
            lobe_pass_depth(pass, &(lobe_attachment){.resource = image});
        else if (i == 5)
            lobe_pass_copy(pass, image, (lobe_range){0}, image, (lobe_range){0});
        else if (i == 6)
            lobe_pass_resolve(pass, 0, image);
        else
            lobe_pass_read(pass, &(lobe_binding){.name = "x", .resource = image});
        GRAPH_EXPECT(fixture, LOBE_ERROR_GRAPH, "'wrong'", "pass");
    }
}

static void compute_without_dispatch(void **state) {
    graph_fixture *fixture = *state;
    begin_with(fixture, LOBE_PASS_COMPUTE);
    GRAPH_EXPECT(fixture, LOBE_ERROR_GRAPH, "'wrong'", "dispatch");
}

static void raster_without_attachments(void **state) {
    graph_fixture *fixture = *state;
    begin_with(fixture, LOBE_PASS_RASTER);
    GRAPH_EXPECT(fixture, LOBE_ERROR_GRAPH, "'wrong'", "attachments");
}

static void copies_that_do_not_match(void **state) {
    graph_fixture *fixture = *state;
    for (int i = 0; i < 6; i++) {
        fixture->recorder.errors = 0;
        lobe_pass *pass = begin_with(fixture, LOBE_PASS_TRANSFER);
        lobe_image_description description = {
            .name = "source", .format = LOBE_FORMAT_R32_FLOAT, .width = 4, .height = 4};
        lobe_resource source = filled_image(fixture, description);
        description.name = "target";
        if (i == 0)
            description.width = 5;
        if (i == 1)
            description.format = LOBE_FORMAT_RG32_FLOAT;
        if (i == 2)
            description.format = LOBE_FORMAT_D32_FLOAT;
        if (i == 3)
            description.layers = 2;
        if (i == 4)
            description.levels = 2;
        lobe_resource target = i == 5 ? graph_fixture_buffer(fixture, "target", 64)
                                      : lobe_graph_image(fixture->graph, &description);
        lobe_pass_copy(pass, source, (lobe_range){0}, target, (lobe_range){0});
        GRAPH_EXPECT(fixture, LOBE_ERROR_GRAPH, "'wrong'", "'source'", "'target'");
    }
}

static void parts_that_do_not_fit(void **state) {
    static const struct {
        lobe_rectangle part;
        uint32_t x, y;
        lobe_format format;
    } cases[] = {
        {{1, 0, 4, 1}, 0, 0, LOBE_FORMAT_R32_FLOAT},
        {{0, 0, 2, 2}, 3, 0, LOBE_FORMAT_R32_FLOAT},
        {{0, 0, 2, 2}, 0, UINT32_MAX, LOBE_FORMAT_R32_FLOAT},
        {{0, 0, 0, 2}, 0, 0, LOBE_FORMAT_R32_FLOAT},
        {{0, 0, 2, 2}, 0, 0, LOBE_FORMAT_RG32_FLOAT},
        {{0, 0, 2, 2}, 0, 0, LOBE_FORMAT_D32_FLOAT},
    };
    graph_fixture *fixture = *state;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        fixture->recorder.errors = 0;
        lobe_pass *pass = begin_with(fixture, LOBE_PASS_TRANSFER);
        lobe_image_description description = {
            .name = "source", .format = LOBE_FORMAT_R32_FLOAT, .width = 4, .height = 4};
        lobe_resource source = filled_image(fixture, description);
        description.name = "target";
        description.format = cases[i].format;
        lobe_resource target = filled_image(fixture, description);
        lobe_pass_copy_part(pass, source, &cases[i].part, target, cases[i].x, cases[i].y);
        GRAPH_EXPECT(fixture, LOBE_ERROR_GRAPH, "'wrong'", "'source'", "'target'");
    }
    // What a part leaves alone must have content.
    fixture->recorder.errors = 0;
    lobe_pass *pass = begin_with(fixture, LOBE_PASS_TRANSFER);
    lobe_image_description description = {
        .name = "source", .format = LOBE_FORMAT_R32_FLOAT, .width = 4, .height = 4};
    lobe_resource source = filled_image(fixture, description);
    description.name = "target";
    lobe_resource target = lobe_graph_image(fixture->graph, &description);
    target = lobe_pass_copy_part(pass, source, &(lobe_rectangle){0, 0, 2, 2}, target, 0, 0);
    lobe_graph_output(fixture->graph, target);
    GRAPH_EXPECT(fixture, LOBE_ERROR_GRAPH, "'wrong'", "'target'");
}

static void late_declarations(void **state) {
    graph_fixture *fixture = *state;
    lobe_graph_begin(fixture->graph);
    lobe_graph_output(fixture->graph, filled(fixture, "numbers", 256));
    assert_int_equal(lobe_graph_compile(fixture->graph), LOBE_OK);
    lobe_pass *pass = lobe_graph_add_pass(fixture->graph, LOBE_PASS_COMPUTE, "late");
    assert_non_null(pass);
    GRAPH_EXPECT(fixture, LOBE_ERROR_GRAPH, "'late'");
}

static void execution_twice(void **state) {
    graph_fixture *fixture = *state;
    lobe_graph_begin(fixture->graph);
    graph_fixture_execute(fixture);
    GRAPH_EXPECT(fixture, LOBE_ERROR_GRAPH, "twice");
}

/// Everything after the first mistake is silent and safe.
static void later_calls_do_nothing(void **state) {
    graph_fixture *fixture = *state;
    lobe_graph_begin(fixture->graph);
    graph_fixture_buffer(fixture, "odd", 0);
    lobe_resource numbers = graph_fixture_buffer(fixture, "numbers", 256);
    numbers = graph_fixture_count(fixture, "count", numbers, 1, 64);
    lobe_pass *pass = lobe_graph_add_pass(fixture->graph, LOBE_PASS_RASTER, "raster");
    assert_non_null(pass);
    lobe_pass_colour(pass, 77, &(lobe_attachment){.resource = numbers});
    lobe_pass_draw(pass, &(lobe_draw){0});
    lobe_pass_keep(pass);
    lobe_graph_upload(fixture->graph, "upload", &numbers, sizeof numbers);
    lobe_graph_output(fixture->graph, numbers);
    lobe_graph_read_back(fixture->graph, numbers, (lobe_range){0});
    assert_int_equal(lobe_graph_compile(fixture->graph), LOBE_ERROR_GRAPH);
    GRAPH_EXPECT(fixture, LOBE_ERROR_GRAPH, "'odd'");
    assert_null(lobe_graph_data(fixture->graph, numbers, NULL));
    // The next frame starts without the error.
    fixture->recorder.errors = 0;
    lobe_graph_begin(fixture->graph);
    graph_fixture_execute(fixture);
}

// ---------------------------------------------------------------------------------------------
// Shaders

/// A correct use of graph_add.comp, for tests to break.
typedef struct add_use {
    const char *source_name, *target_name, *extra_name, *shader;
    size_t source_size, constants_size;
    bool target_is_read, source_is_image;
} add_use;

static void declare_use(graph_fixture *fixture, const add_use *use) {
    const uint32_t constants[8] = {0};
    fixture->recorder.errors = 0;
    lobe_graph_begin(fixture->graph);
    lobe_resource source = filled(fixture, "source", use->source_size ? use->source_size : 256);
    if (use->source_is_image)
        source = filled_image(fixture, (lobe_image_description){.name = "source",
                                                                .format = LOBE_FORMAT_R32_FLOAT,
                                                                .width = 4,
                                                                .height = 4});
    lobe_resource target = filled(fixture, "target", 256);
    lobe_pass *pass = lobe_graph_add_pass(fixture->graph, LOBE_PASS_COMPUTE, "wrong");
    if (use->source_name)
        lobe_pass_read(pass, &(lobe_binding){.name = use->source_name, .resource = source});
    if (use->extra_name)
        lobe_pass_read(pass, &(lobe_binding){.name = use->extra_name, .resource = source});
    const lobe_binding binding = {.name = use->target_name, .resource = target};
    if (use->target_is_read)
        lobe_pass_read(pass, &binding);
    else
        lobe_graph_output(fixture->graph, lobe_pass_write(pass, &binding));
    lobe_pass_dispatch(pass, &(lobe_dispatch){.shader = use->shader,
                                              .threads = {64},
                                              .constants = constants,
                                              .constants_size = use->constants_size});
    lobe_pass_keep(pass);
}

static const add_use right_use = {.source_name = "source_block",
                                  .target_name = "target_block",
                                  .shader = "graph_add.comp",
                                  .constants_size = 8};

static void the_right_use_is_right(void **state) {
    graph_fixture *fixture = *state;
    declare_use(fixture, &right_use);
    graph_fixture_execute(fixture);
}

static void unbound_name(void **state) {
    graph_fixture *fixture = *state;
    add_use use = right_use;
    use.source_name = NULL;
    declare_use(fixture, &use);
    GRAPH_EXPECT(fixture, LOBE_ERROR_GRAPH, "'wrong'", "'graph_add.comp'", "'source_block'");
}

static void unknown_name(void **state) {
    graph_fixture *fixture = *state;
    add_use use = right_use;
    use.extra_name = "no_such_block";
    declare_use(fixture, &use);
    GRAPH_EXPECT(fixture, LOBE_ERROR_GRAPH, "'wrong'", "'graph_add.comp'", "'no_such_block'",
                 "'source'");
}

static void name_bound_twice(void **state) {
    graph_fixture *fixture = *state;
    add_use use = right_use;
    use.extra_name = "source_block";
    declare_use(fixture, &use);
    GRAPH_EXPECT(fixture, LOBE_ERROR_GRAPH, "'wrong'", "'source_block'", "twice");
}

static void read_where_the_shader_writes(void **state) {
    graph_fixture *fixture = *state;
    add_use use = right_use;
    use.target_is_read = true;
    declare_use(fixture, &use);
    GRAPH_EXPECT(fixture, LOBE_ERROR_GRAPH, "'wrong'", "'graph_add.comp'", "'target_block'",
                 "'target'");
}

static void write_where_the_shader_reads(void **state) {
    graph_fixture *fixture = *state;
    add_use use = right_use;
    use.source_name = "target_block";
    use.target_name = "source_block";
    declare_use(fixture, &use);
    GRAPH_EXPECT(fixture, LOBE_ERROR_GRAPH, "'wrong'", "'graph_add.comp'");
}

static void image_where_the_shader_has_a_block(void **state) {
    graph_fixture *fixture = *state;
    add_use use = right_use;
    use.source_is_image = true;
    declare_use(fixture, &use);
    GRAPH_EXPECT(fixture, LOBE_ERROR_GRAPH, "'wrong'", "'graph_add.comp'", "'source_block'",
                 "'source'");
}

static void constants_of_another_size(void **state) {
    graph_fixture *fixture = *state;
    add_use use = right_use;
    use.constants_size = 12;
    declare_use(fixture, &use);
    GRAPH_EXPECT(fixture, LOBE_ERROR_GRAPH, "'wrong'", "'graph_add.comp'", "12", "8");
    use.constants_size = 132;
    declare_use(fixture, &use);
    GRAPH_EXPECT(fixture, LOBE_ERROR_GRAPH, "'wrong'", "'graph_add.comp'", "132");
}

static void missing_shader(void **state) {
    graph_fixture *fixture = *state;
    add_use use = right_use;
    use.shader = "no_such_shader.comp";
    declare_use(fixture, &use);
    GRAPH_EXPECT(fixture, LOBE_ERROR_SHADER, "no_such_shader.comp");
}

static void no_shader(void **state) {
    graph_fixture *fixture = *state;
    add_use use = right_use;
    use.shader = NULL;
    declare_use(fixture, &use);
    GRAPH_EXPECT(fixture, LOBE_ERROR_GRAPH, "'wrong'", "shader");
}

static void block_larger_than_the_buffer(void **state) {
    graph_fixture *fixture = *state;
    const uint32_t count = 0;
    for (int i = 0; i < 2; i++) {
        fixture->recorder.errors = 0;
        lobe_pass *pass = begin_with(fixture, LOBE_PASS_COMPUTE);
        lobe_resource settings =
            lobe_graph_upload(fixture->graph, "settings", &count, i == 0 ? 4 : 1);
        lobe_pass_read(pass, &(lobe_binding){.name = "settings_block", .resource = settings});
        lobe_pass_dispatch(pass, &(lobe_dispatch){.shader = "graph_settings.comp"});
        lobe_pass_keep(pass);
        GRAPH_EXPECT(fixture, LOBE_ERROR_GRAPH, "'wrong'", "'settings'", "'settings_block'",
                     "smaller");
    }
}

static void expect_paint(graph_fixture *fixture, lobe_image_description description,
                         lobe_range range, const char *shader, const char *word) {
    fixture->recorder.errors = 0;
    lobe_pass *pass = begin_with(fixture, LOBE_PASS_COMPUTE);
    description.name = "picture";
    description.width = description.height = 8;
    lobe_resource image = lobe_graph_image(fixture->graph, &description);
    lobe_pass_write(pass, &(lobe_binding){.name = "target", .resource = image, .range = range});
    lobe_pass_dispatch(pass, &(lobe_dispatch){.shader = shader});
    GRAPH_EXPECT(fixture, LOBE_ERROR_GRAPH, "'wrong'", "'picture'", "'target'", shader, word);
}

static void images_that_do_not_fit_the_shader(void **state) {
    graph_fixture *fixture = *state;
    lobe_image_description levels = {.format = LOBE_FORMAT_R32_FLOAT, .levels = 2};
    expect_paint(fixture, levels, (lobe_range){0}, "graph_paint.comp", "single level");
    lobe_image_description layers = {.format = LOBE_FORMAT_R32_FLOAT, .layers = 2};
    expect_paint(fixture, layers, (lobe_range){0}, "graph_paint_plane.comp", "layers");
    lobe_image_description format = {.format = LOBE_FORMAT_RG32_FLOAT};
    expect_paint(fixture, format, (lobe_range){0}, "graph_paint_plane.comp", "format");
    lobe_image_description samples = {.format = LOBE_FORMAT_R32_FLOAT, .samples = 4};
    expect_paint(fixture, samples, (lobe_range){0}, "graph_paint_plane.comp", "multisampled");
}

static void a_texture_is_only_sampled(void **state) {
    graph_fixture *fixture = *state;
    lobe_texture *texture = NULL;
    lobe_image image;
    assert_int_equal(lobe_image_allocate(&image, LOBE_FORMAT_R32_FLOAT, 8, 8, NULL), LOBE_OK);
    const lobe_texture_parameters parameters = {.name = "texture", .image = &image};
    assert_int_equal(lobe_texture_create(fixture->device, &parameters, &texture), LOBE_OK);
    lobe_image_free(&image);
    lobe_pass *pass = begin_with(fixture, LOBE_PASS_COMPUTE);
    lobe_resource source = lobe_graph_import_texture(fixture->graph, texture);
    lobe_resource sum = graph_fixture_image(fixture, "sum", LOBE_FORMAT_R32_FLOAT, 8, 8);
    lobe_pass_read(pass, &(lobe_binding){.name = "sampled", .resource = source});
    lobe_pass_read(pass, &(lobe_binding){.name = "stored", .resource = source});
    lobe_pass_write(pass, &(lobe_binding){.name = "sum", .resource = sum});
    lobe_pass_dispatch(pass, &(lobe_dispatch){.shader = "graph_two_ways.comp"});
    GRAPH_EXPECT(fixture, LOBE_ERROR_GRAPH, "'wrong'", "'texture'", "'stored'", "sampled");
    lobe_texture_destroy(&texture);
}

static void check_too_many_groups(graph_fixture *fixture, const uint32_t threads[2]) {
    const uint32_t constants[2] = {0};
    fixture->recorder.errors = 0;
    lobe_pass *pass = begin_with(fixture, LOBE_PASS_COMPUTE);
    lobe_resource numbers = graph_fixture_buffer(fixture, "numbers", 256);
    numbers = lobe_pass_write(pass, &(lobe_binding){.name = "target_block", .resource = numbers});
    lobe_pass_dispatch(pass, &(lobe_dispatch){.shader = "graph_count.comp",
                                              .threads = {threads[0], threads[1]},
                                              .constants = constants,
                                              .constants_size = sizeof constants});
    lobe_graph_output(fixture->graph, numbers);
    GRAPH_EXPECT(fixture, LOBE_ERROR_LIMIT, "'wrong'", "'graph_count.comp'", "groups");
}

static void too_many_groups(void **state) {
    graph_fixture *fixture = *state;
    check_too_many_groups(fixture, (const uint32_t[2]){1, UINT32_MAX});
    // Some GPUs take as many along the first axis.
    if (lobe_device_describe(fixture->device)->type == LOBE_DEVICE_CPU)
        check_too_many_groups(fixture, (const uint32_t[2]){UINT32_MAX});
}

// ---------------------------------------------------------------------------------------------
// Attachments

static lobe_resource attachment(graph_fixture *fixture, const char *name, lobe_format format,
                                uint32_t width, uint32_t samples) {
    return lobe_graph_image(
        fixture->graph,
        &(lobe_image_description){
            .name = name, .format = format, .width = width, .height = 8, .samples = samples});
}

static void attachments_that_do_not_fit(void **state) {
    graph_fixture *fixture = *state;
    const lobe_format colour = LOBE_FORMAT_RGBA8_UNORM, depth = LOBE_FORMAT_D32_FLOAT;
    for (int i = 0; i < 6; i++) {
        fixture->recorder.errors = 0;
        lobe_pass *pass = begin_with(fixture, LOBE_PASS_RASTER);
        lobe_resource first = attachment(fixture, "first", colour, 8, 1);
        lobe_attachment odd = {0};
        lobe_pass_colour(pass, 0, &(lobe_attachment){.resource = first});
        if (i == 0) // another extent
            odd.resource = attachment(fixture, "odd", colour, 9, 1);
        if (i == 1) // another sample count
            odd.resource = attachment(fixture, "odd", colour, 8, 4);
        if (i == 2) // depth as colour
            odd.resource = attachment(fixture, "odd", depth, 8, 1);
        if (i == 3) // colour as depth
            odd.resource = attachment(fixture, "odd", colour, 8, 1);
        if (i == 4) // depth of another extent
            odd.resource = attachment(fixture, "odd", depth, 4, 1);
        if (i == 5) // no image
            odd.resource = graph_fixture_buffer(fixture, "odd", 256);
        if (i == 3 || i == 4)
            lobe_pass_depth(pass, &odd);
        else
            lobe_pass_colour(pass, 1, &odd);
        GRAPH_EXPECT(fixture, LOBE_ERROR_GRAPH, "'wrong'", "'odd'");
    }
}

static void attachment_slots(void **state) {
    graph_fixture *fixture = *state;
    for (int i = 0; i < 3; i++) {
        fixture->recorder.errors = 0;
        lobe_pass *pass = begin_with(fixture, LOBE_PASS_RASTER);
        lobe_attachment first = {.resource =
                                     attachment(fixture, "first", LOBE_FORMAT_R8_UNORM, 8, 1)};
        lobe_attachment second = {.resource =
                                      attachment(fixture, "second", LOBE_FORMAT_R8_UNORM, 8, 1)};
        if (i == 0)
            lobe_pass_colour(pass, 8, &first);
        if (i == 1) {
            lobe_pass_colour(pass, 0, &first);
            lobe_pass_colour(pass, 0, &second);
        }
        if (i == 2)
            lobe_pass_colour(
                pass, 0, &(lobe_attachment){.resource = first.resource, .load = LOBE_LOAD_KEEP});
        GRAPH_EXPECT(fixture, LOBE_ERROR_GRAPH, "'wrong'", i == 2 ? "'first'" : "location");
    }
}

static void resolves_that_do_not_fit(void **state) {
    graph_fixture *fixture = *state;
    const lobe_format colour = LOBE_FORMAT_RGBA8_UNORM;
    for (int i = 0; i < 4; i++) {
        fixture->recorder.errors = 0;
        lobe_pass *pass = begin_with(fixture, LOBE_PASS_RASTER);
        lobe_resource samples = attachment(fixture, "samples", colour, 8, i == 0 ? 1 : 4);
        lobe_resource target =
            attachment(fixture, "odd", i == 1 ? LOBE_FORMAT_R8_UNORM : colour, i == 2 ? 4 : 8, 1);
        lobe_pass_colour(pass, 0, &(lobe_attachment){.resource = samples});
        lobe_pass_resolve(pass, i == 3 ? 1 : 0, target);
        GRAPH_EXPECT(fixture, LOBE_ERROR_GRAPH, "'wrong'", "'odd'");
    }
}

static void samples_read_back(void **state) {
    graph_fixture *fixture = *state;
    lobe_pass *pass = begin_with(fixture, LOBE_PASS_RASTER);
    lobe_resource samples = attachment(fixture, "samples", LOBE_FORMAT_RGBA8_UNORM, 8, 4);
    samples = lobe_pass_colour(pass, 0, &(lobe_attachment){.resource = samples});
    lobe_graph_read_back(fixture->graph, samples, (lobe_range){0});
    GRAPH_EXPECT(fixture, LOBE_ERROR_GRAPH, "'samples'", "resolve");
}

static void indices_outside_the_buffer(void **state) {
    graph_fixture *fixture = *state;
    const uint32_t indices[3] = {0, 1, 2};
    lobe_pass *pass = begin_with(fixture, LOBE_PASS_RASTER);
    lobe_resource uploaded = lobe_graph_upload(fixture->graph, "indices", indices, sizeof indices);
    lobe_pass_draw(pass, &(lobe_draw){.vertex_shader = "graph_triangle.vert",
                                      .indices = uploaded,
                                      .first_index = 1,
                                      .index_count = 3});
    GRAPH_EXPECT(fixture, LOBE_ERROR_GRAPH, "'wrong'", "'indices'");
}

#define TEST(function)                                                                             \
    cmocka_unit_test_setup_teardown(function, graph_fixture_open, graph_fixture_close)

int main(void) {
    const struct CMUnitTest tests[] = {
        TEST(stale_handle),
        TEST(handle_of_nothing),
        TEST(never_written),
        TEST(read_back_of_nothing),
        TEST(import_is_written),
        TEST(a_cycle),
        TEST(read_and_written_at_once),
        TEST(output_is_overwritten),
        TEST(range_outside),
        TEST(images_that_cannot_be),
        TEST(buffers_that_cannot_be),
        TEST(uploads_that_cannot_be),
        TEST(retained_twice),
        TEST(format_that_cannot_be_stored_to),
        cmocka_unit_test(memory_is_exhausted),
        TEST(calls_for_other_kinds_of_pass),
        TEST(compute_without_dispatch),
        TEST(raster_without_attachments),
        TEST(copies_that_do_not_match),
        TEST(parts_that_do_not_fit),
        TEST(late_declarations),
        TEST(execution_twice),
        TEST(later_calls_do_nothing),
        TEST(the_right_use_is_right),
        TEST(unbound_name),
        TEST(unknown_name),
        TEST(name_bound_twice),
        TEST(read_where_the_shader_writes),
        TEST(write_where_the_shader_reads),
        TEST(image_where_the_shader_has_a_block),
        TEST(constants_of_another_size),
        TEST(missing_shader),
        TEST(no_shader),
        TEST(block_larger_than_the_buffer),
        TEST(images_that_do_not_fit_the_shader),
        TEST(a_texture_is_only_sampled),
        TEST(too_many_groups),
        TEST(attachments_that_do_not_fit),
        TEST(attachment_slots),
        TEST(resolves_that_do_not_fit),
        TEST(samples_read_back),
        TEST(indices_outside_the_buffer),
    };
    return cmocka_run_group_tests_name("graph_errors", tests, NULL, NULL);
}
