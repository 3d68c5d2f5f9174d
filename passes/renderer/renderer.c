#include <lobe/renderer.h>

#include <string.h>

#include "passes/environment/maps.h"
#include "passes/filters/filter.h"
#include "passes/filters/settings.h"
#include "passes/renderer/accumulation.h"
#include "passes/renderer/host_frame.h"
#include "passes/renderer/pass_times.h"
#include "passes/renderer/picture_drawing.h"
#include "passes/renderer/sample_pattern.h"
#include "passes/renderer/shading.h"
#include "passes/upload/device_scene.h"

/// Samples of the reference a submission: few enough that one stays short on a slow device.
#define SAMPLES_A_SUBMISSION 8

struct lobe_renderer {
    lobe_device *device;
    lobe_host host;
    lobe_graph *graph;
    device_scene *scene;
    const lobe_filter *warned; ///< the filter whose limits were told last
    // One an instance, and one an image, of the scene.
    filtered_appearance *appearances;
    lobe_resource *filtered_images;
    environment_state environment;
};

/// All that one call of lobe_renderer_render needs.
typedef struct rendering {
    lobe_renderer *renderer;
    const lobe_render_parameters *parameters;
    filter_context context;
    environment_work environment;
    lobe_settings settings;
    filtered_images images;
    uint32_t width, height, samples, pattern;
    double *sum;             ///< RGBA of all samples of the reference so far
    bool without_background; ///< the reference is laid over what the host drew
} rendering;

lobe_result lobe_renderer_create(lobe_device *device, const lobe_host *host,
                                 lobe_renderer **renderer) {
    const lobe_allocator *allocator = lobe_device_allocator(device);
    *renderer = lobe_allocate(allocator, 1, sizeof **renderer);
    if (!*renderer) {
        lobe_host_log(host, LOBE_LOG_ERROR, "renderer: out of memory");
        return LOBE_ERROR_OUT_OF_MEMORY;
    }
    (*renderer)->device = device;
    if (host)
        (*renderer)->host = *host;
    (*renderer)->host.allocator = allocator;
    lobe_result result = lobe_graph_create(device, &(*renderer)->graph);
    if (result != LOBE_OK)
        lobe_renderer_destroy(renderer);
    return result;
}

static void forget_scene(lobe_renderer *renderer) {
    passes_device_scene_destroy(&renderer->scene);
    lobe_release(renderer->appearances);
    lobe_release(renderer->filtered_images);
    renderer->appearances = NULL;
    renderer->filtered_images = NULL;
    renderer->warned = NULL;
    passes_environment_light_forget(&renderer->environment);
}

void lobe_renderer_destroy(lobe_renderer **renderer) {
    if (!renderer || !*renderer)
        return;
    lobe_graph_destroy(&(*renderer)->graph);
    forget_scene(*renderer);
    lobe_release(*renderer);
    *renderer = NULL;
}

lobe_result lobe_renderer_set_scene(lobe_renderer *renderer, const lobe_scene *scene) {
    // Retained maps of the former scene must not pass for maps of the new one.
    lobe_graph_destroy(&renderer->graph);
    forget_scene(renderer);
    lobe_result result = lobe_graph_create(renderer->device, &renderer->graph);
    if (result != LOBE_OK || !scene)
        return result;
    result = passes_device_scene_create(renderer->device, scene, &renderer->host, &renderer->scene);
    if (result != LOBE_OK)
        return result;
    renderer->appearances = lobe_allocate(renderer->host.allocator, scene->instance_count,
                                          sizeof *renderer->appearances);
    renderer->filtered_images = lobe_allocate(renderer->host.allocator, scene->image_count + 1,
                                              sizeof *renderer->filtered_images);
    if (renderer->appearances && renderer->filtered_images)
        return LOBE_OK;
    lobe_host_log(&renderer->host, LOBE_LOG_ERROR, "%s: out of memory", scene->name);
    forget_scene(renderer);
    return LOBE_ERROR_OUT_OF_MEMORY;
}

lobe_result lobe_renderer_update_scene(lobe_renderer *renderer, const lobe_scene_changes *changes) {
    if (!renderer->scene)
        return lobe_host_fail(&renderer->host, LOBE_ERROR_INVALID_ARGUMENT,
                              "update: no scene is set");
    lobe_result result =
        passes_device_scene_update(renderer->device, renderer->scene, changes, &renderer->host);
    if (result == LOBE_OK && changes->material_count > 0)
        renderer->warned = NULL;
    if (result == LOBE_OK && changes->environment)
        passes_environment_light_invalidate(&renderer->environment);
    if (result != LOBE_OK && result != LOBE_ERROR_INVALID_ARGUMENT &&
        result != LOBE_ERROR_MALFORMED)
        forget_scene(renderer);
    return result;
}

lobe_graph *lobe_renderer_graph(lobe_renderer *renderer) {
    return renderer->graph;
}

void lobe_frame_free(lobe_frame *frame) {
    lobe_image_free(&frame->radiance);
    lobe_image_free(&frame->normal_depth);
    lobe_image_free(&frame->lobes_level);
    lobe_release(frame->passes);
    *frame = (lobe_frame){0};
}

// ---------------------------------------------------------------------------------------------
// Maps

static void warn_of_limits(rendering *r) {
    const lobe_filter *filter = r->context.filter;
    const lobe_scene *scene = r->context.scene->scene;
    if (!filter->ignores || r->renderer->warned == filter)
        return;
    for (size_t i = 0; i < scene->material_count; ++i) {
        const char *limit = filter->ignores(&scene->materials[i]);
        if (limit)
            lobe_host_log(&r->renderer->host, LOBE_LOG_WARNING,
                          "%s: material '%s', filter '%s': %s", scene->name,
                          scene->materials[i].name, filter->name, limit);
    }
    r->renderer->warned = filter;
}

/// The first instance before `instance` whose maps serve it as well; `instance` where none does.
static size_t instance_to_share_with(const filter_context *context, size_t instance) {
    const lobe_filter *filter = context->filter;
    if (filter->for_each_instance && filter->for_each_instance(context, instance))
        return instance;
    const device_instance *instances = context->scene->instances;
    for (size_t i = 0; i < instance; ++i) {
        if (instances[i].material == instances[instance].material &&
            !(filter->for_each_instance && filter->for_each_instance(context, i)))
            return i;
    }
    return instance;
}

static void build_maps(rendering *r, lobe_frame *frame) {
    const lobe_scene *scene = r->context.scene->scene;
    filtered_appearance *appearances = r->renderer->appearances;
    memset(r->images.resources, 0, scene->image_count * sizeof *r->images.resources);
    r->images.bytes = 0;
    frame->filtered_bytes = frame->base_texels = 0;
    for (size_t i = 0; i < scene->instance_count; ++i) {
        size_t shared = instance_to_share_with(&r->context, i);
        if (shared < i) {
            appearances[i] = appearances[shared];
            continue;
        }
        appearances[i] = (filtered_appearance){0};
        if (r->context.filter->build)
            r->context.filter->build(&r->context, i, &appearances[i]);
        frame->filtered_bytes += appearances[i].bytes;
        frame->base_texels += appearances[i].base_texels;
    }
    frame->filtered_bytes += r->images.bytes;
}

// ---------------------------------------------------------------------------------------------
// Delivery

static lobe_result take_image(const rendering *r, lobe_resource resource, lobe_format format,
                              lobe_image *image) {
    size_t size = 0;
    const void *data = lobe_graph_data(r->renderer->graph, resource, &size);
    lobe_result result =
        lobe_image_allocate(image, format, r->width, r->height, &r->renderer->host);
    if (result != LOBE_OK)
        return result;
    // Passes of the host may have put another image here.
    if (!data || size != (size_t)r->width * r->height * lobe_format_size(format))
        return lobe_host_fail(&r->renderer->host, LOBE_ERROR_INVALID_ARGUMENT,
                              "render: an image to deliver has another extent or format than %ux%u "
                              "%s",
                              r->width, r->height, lobe_format_name(format));
    memcpy(image->texels, data, size);
    return LOBE_OK;
}

static void want(const rendering *r, lobe_resource resource) {
    if (!passes_host_frame_delivers(r->parameters))
        lobe_graph_output(r->renderer->graph, resource);
    else
        lobe_graph_read_back(r->renderer->graph, resource, (lobe_range){0});
}

static lobe_result out_of_memory(const rendering *r) {
    lobe_host_log(&r->renderer->host, LOBE_LOG_ERROR, "%s: out of memory",
                  r->context.scene->scene->name);
    return LOBE_ERROR_OUT_OF_MEMORY;
}

static lobe_result execute(rendering *r, lobe_frame *frame) {
    lobe_result result = passes_host_frame_run(r->renderer->graph, r->parameters);
    if (result != LOBE_OK || r->parameters->host.submission)
        return result;
    passes_environment_light_save(&r->environment, r->renderer->graph, &r->renderer->host);
    return passes_pass_times_add(frame, lobe_graph_describe(r->renderer->graph),
                                 r->renderer->host.allocator)
               ? LOBE_OK
               : out_of_memory(r);
}

// ---------------------------------------------------------------------------------------------
// One picture

/// Into the host's images where it lends some, and in their extent.
static lobe_result import_target(rendering *r, shading_targets *imported) {
    lobe_result result =
        passes_host_frame_import(r->renderer->graph, r->parameters, r->context.host, imported);
    if (result == LOBE_OK && imported->width > 0) {
        r->width = r->context.width = imported->width;
        r->height = r->context.height = imported->height;
    }
    return result;
}

static void draw_once(rendering *r, bool outputs, const shading_targets *imported,
                      shading_targets *targets) {
    static const shading_sample centre = {.position = {0.5f, 0.5f}};
    lobe_graph *graph = r->renderer->graph;
    *targets = passes_shading_targets_declare(graph, r->width, r->height, outputs);
    passes_host_frame_replace(imported, targets);
    passes_host_frame_before(graph, r->parameters, targets);
    shading_light light = passes_shading_light_prepare(&r->context, &r->environment);
    passes_shading(&r->context, r->renderer->appearances, &light, &centre, targets);
    passes_host_frame_after(graph, r->parameters, targets);
}

static lobe_result take_images(const rendering *r, bool outputs, const shading_targets *targets,
                               lobe_frame *frame) {
    lobe_result result = LOBE_OK;
    if (!r->parameters->host.target)
        result = take_image(r, targets->radiance, LOBE_FORMAT_RGBA32_FLOAT, &frame->radiance);
    if (result == LOBE_OK && outputs)
        result =
            take_image(r, targets->normal_depth, LOBE_FORMAT_RGBA32_FLOAT, &frame->normal_depth);
    if (result == LOBE_OK && outputs)
        result = take_image(r, targets->lobes_level, LOBE_FORMAT_RG32_FLOAT, &frame->lobes_level);
    return result;
}

/// One shading pass at the pixels' centres. `outputs`: with arbitrary output variables.
static lobe_result render_once(rendering *r, bool outputs, lobe_frame *frame) {
    shading_targets imported, targets;
    lobe_graph_set_frames_in_flight(r->renderer->graph, r->parameters->host.frames_in_flight);
    lobe_graph_begin(r->renderer->graph);
    lobe_result result = import_target(r, &imported);
    if (result != LOBE_OK)
        return result;
    build_maps(r, frame);
    draw_once(r, outputs, &imported, &targets);
    if (r->parameters->host.target)
        lobe_graph_output(r->renderer->graph, targets.radiance);
    else
        want(r, targets.radiance);
    if (outputs) {
        want(r, targets.normal_depth);
        want(r, targets.lobes_level);
    }
    result = execute(r, frame);
    return result == LOBE_OK && passes_host_frame_delivers(r->parameters)
               ? take_images(r, outputs, &targets, frame)
               : result;
}

/// Adds samples [first, first + count) of every pixel to the sum.
static lobe_result render_samples(rendering *r, uint32_t first, uint32_t count, lobe_frame *frame) {
    lobe_graph *graph = r->renderer->graph;
    lobe_graph_begin(graph);
    build_maps(r, frame);
    shading_targets targets = passes_shading_targets_declare(graph, r->width, r->height, false);
    targets.without_background = r->without_background;
    shading_light light = passes_shading_light_prepare(&r->context, &r->environment);
    lobe_resource sum =
        lobe_graph_image(graph, &(lobe_image_description){.name = "sum of samples",
                                                          .format = LOBE_FORMAT_RGBA32_FLOAT,
                                                          .width = r->width,
                                                          .height = r->height});
    lobe_pass *clear = lobe_graph_add_pass(graph, LOBE_PASS_TRANSFER, "clear");
    sum = lobe_pass_fill(clear, sum, (lobe_range){0}, (float[4]){0});
    for (uint32_t i = 0; i < count; ++i) {
        shading_sample sample = {.number = first + i, .pattern = r->pattern};
        passes_sample_position(sample.number, r->samples, sample.position);
        passes_sample_position_in_pattern(r->pattern, sample.position);
        passes_shading(&r->context, r->renderer->appearances, &light, &sample, &targets);
        sum = passes_accumulation(graph, targets.radiance, sum, r->width, r->height);
    }
    want(r, sum);
    lobe_result result = execute(r, frame);
    if (result != LOBE_OK || r->parameters->discard)
        return result;
    // Sums of few samples in float32, the sum of those in double: no bias at any count.
    const float *data = lobe_graph_data(graph, sum, NULL);
    for (size_t i = 0; data && i < (size_t)r->width * r->height * 4; ++i)
        r->sum[i] += data[i];
    return LOBE_OK;
}

static bool progress(const rendering *r, double part) {
    return !r->parameters->host.progress ||
           r->parameters->host.progress(r->parameters->host.user, part);
}

static lobe_result take_mean(rendering *r, lobe_frame *frame) {
    lobe_result result = lobe_image_allocate(&frame->radiance, LOBE_FORMAT_RGBA32_FLOAT, r->width,
                                             r->height, &r->renderer->host);
    float *texels = frame->radiance.texels;
    for (size_t i = 0; result == LOBE_OK && i < (size_t)r->width * r->height * 4; ++i)
        texels[i] = (float)(r->sum[i] / r->samples);
    return result;
}

static lobe_result render_reference(rendering *r, lobe_frame *frame) {
    lobe_result result = LOBE_OK;
    if (!r->parameters->discard) {
        r->sum = lobe_allocate(r->renderer->host.allocator, (size_t)r->width * r->height,
                               4 * sizeof *r->sum);
        if (!r->sum)
            return out_of_memory(r);
    }
    if (r->parameters->aov) {
        result = render_once(r, true, frame);
        lobe_image_free(&frame->radiance);
    }
    bool goes_on = true;
    uint32_t done = 0;
    while (result == LOBE_OK && goes_on && done < r->samples) {
        uint32_t left = r->samples - done;
        uint32_t count = left < SAMPLES_A_SUBMISSION ? left : SAMPLES_A_SUBMISSION;
        result = render_samples(r, done, count, frame);
        done += count;
        goes_on = result == LOBE_OK && progress(r, (double)done / r->samples);
    }
    if (result == LOBE_OK && !goes_on)
        lobe_frame_free(frame);
    else if (result == LOBE_OK && !r->parameters->discard)
        result = take_mean(r, frame);
    lobe_release(r->sum);
    return result;
}

// ---------------------------------------------------------------------------------------------
// The reference in the host's image

/// As large as the target, which is looked at before all the work.
static lobe_result measure_target(rendering *r) {
    shading_targets imported;
    lobe_graph_begin(r->renderer->graph);
    lobe_result result = import_target(r, &imported);
    // What is wrong with the image stays in the graph.
    return result == LOBE_OK && imported.width == 0 ? lobe_graph_compile(r->renderer->graph)
                                                    : result;
}

/// Draws the mean of the samples by the host's submission, in place of delivering it. What lasts
/// from frame to frame is declared as for the samples, lest it be forgotten.
static lobe_result draw_mean(rendering *r, lobe_frame *frame) {
    lobe_graph *graph = r->renderer->graph;
    shading_targets imported, targets = {.width = r->width, .height = r->height};
    lobe_graph_set_frames_in_flight(graph, r->parameters->host.frames_in_flight);
    lobe_graph_begin(graph);
    lobe_result result = import_target(r, &imported);
    if (result != LOBE_OK)
        return result;
    build_maps(r, frame);
    (void)passes_shading_light_prepare(&r->context, &r->environment);
    passes_host_frame_replace(&imported, &targets);
    passes_picture_drawing(graph, frame->radiance.texels, &targets);
    lobe_graph_output(graph, targets.radiance);
    lobe_image_free(&frame->radiance);
    return execute(r, frame);
}

/// The samples are taken as for a picture that is delivered.
static lobe_result render_reference_into_target(rendering *r, lobe_frame *frame) {
    const lobe_render_parameters *wanted = r->parameters;
    lobe_render_parameters delivered = *wanted;
    delivered.host.target = NULL;
    delivered.host.submission = NULL;
    delivered.aov &= !wanted->host.submission;
    lobe_result result = measure_target(r);
    r->without_background = wanted->host.target->keep;
    r->parameters = &delivered;
    if (result == LOBE_OK)
        result = render_reference(r, frame);
    r->parameters = wanted;
    // There is no mean where it is to be discarded, or the host stopped.
    return result == LOBE_OK && frame->radiance.texels ? draw_mean(r, frame) : result;
}

static lobe_result render(rendering *r, lobe_frame *frame) {
    if (!r->context.filter->supersamples)
        return render_once(r, r->parameters->aov, frame);
    return r->parameters->host.target ? render_reference_into_target(r, frame)
                                      : render_reference(r, frame);
}

// ---------------------------------------------------------------------------------------------
// Preparation

static lobe_result refuse(const lobe_host *host, lobe_result result, const char *why) {
    lobe_host_log(host, LOBE_LOG_ERROR, "render: %s", why);
    return result;
}

/// Whether the host wants what a picture in many parts cannot give.
static bool asks_for_one_submission(const lobe_render_parameters *parameters) {
    const lobe_render_target *target = parameters->host.target;
    return parameters->host.add_passes || (target && target->depth) ||
           (parameters->host.submission && !target);
}

static lobe_result check(const rendering *r) {
    const lobe_host *host = &r->renderer->host;
    uint32_t limit = lobe_device_describe(r->renderer->device)->maximum_image_extent;
    if (!r->renderer->scene)
        return refuse(host, LOBE_ERROR_INVALID_ARGUMENT, "no scene is set");
    if (r->parameters->filter && lobe_filter_supersamples(r->parameters->filter) &&
        asks_for_one_submission(r->parameters))
        return refuse(host, LOBE_ERROR_UNSUPPORTED,
                      "the reference takes many submissions, of which the last alone draws into "
                      "the target's radiance: there is no depth and no pass of the host's in it");
    if (r->samples > LOBE_MAXIMUM_SAMPLES)
        return refuse(host, LOBE_ERROR_INVALID_ARGUMENT, "more than 4096 samples a pixel");
    if (r->width > limit || r->height > limit) {
        lobe_host_log(host, LOBE_LOG_ERROR,
                      "render: %ux%u pixels are more than the device's limit of %ux%u", r->width,
                      r->height, limit, limit);
        return LOBE_ERROR_LIMIT;
    }
    return LOBE_OK;
}

/// What a frame reads back is there when the next is begun, unless more are in flight: of those in
/// commands of the host, only the host knows when they are finished.
static bool saves_environment(const lobe_render_parameters *parameters) {
    return parameters->environment.cache &&
           (!parameters->host.submission || parameters->host.frames_in_flight <= 1);
}

static lobe_result prepare(lobe_renderer *renderer, const lobe_render_parameters *parameters,
                           rendering *r) {
    *r = (rendering){
        .renderer = renderer,
        .parameters = parameters,
        .width = parameters->width ? parameters->width : 1280,
        .height = parameters->height ? parameters->height : 720,
        .samples = parameters->reference.samples ? parameters->reference.samples : 64,
        .pattern = parameters->reference.pattern,
    };
    lobe_result result = check(r);
    if (result != LOBE_OK)
        return result;
    const lobe_filter *filter = parameters->filter;
    if (!filter)
        result = lobe_filter_find("lobes", &renderer->host, &filter);
    if (result != LOBE_OK)
        return result;
    lobe_settings_default(filter, &r->settings);
    if (parameters->settings)
        r->settings = *parameters->settings;
    result = passes_settings_check(filter, &r->settings, &renderer->host);
    if (result != LOBE_OK)
        return result;
    r->images.resources = renderer->filtered_images;
    r->context = (filter_context){
        .graph = renderer->graph,
        .settings = &r->settings,
        .filter = filter,
        .scene = renderer->scene,
        .camera = parameters->camera ? parameters->camera : &renderer->scene->scene->camera,
        .width = r->width,
        .height = r->height,
        .images = &r->images,
        .host = &renderer->host,
    };
    r->environment = (environment_work){
        .state = &renderer->environment,
        .parts = parameters->environment.parts,
        .cache = parameters->environment.cache,
        .saves = saves_environment(parameters),
    };
    return LOBE_OK;
}

/// Saves what a submitted frame read back, for which nobody has waited yet, and loads what this
/// frame needs.
static lobe_result update_environment(rendering *r) {
    environment_state *state = r->environment.state;
    lobe_result result = LOBE_OK;
    if (state->reads_back)
        result = lobe_graph_wait(r->context.graph);
    if (result == LOBE_OK && r->environment.saves)
        passes_environment_light_save(&r->environment, r->context.graph, r->context.host);
    state->reads_back = false;
    return result == LOBE_OK
               ? passes_environment_light_load(&r->context, &r->environment, r->renderer->device)
               : result;
}

lobe_result lobe_renderer_render(lobe_renderer *renderer, const lobe_render_parameters *parameters,
                                 lobe_frame *frame) {
    *frame = (lobe_frame){0};
    rendering r;
    lobe_result result = prepare(renderer, parameters, &r);
    if (result != LOBE_OK)
        return result;
    result = update_environment(&r);
    if (result != LOBE_OK)
        return result;
    warn_of_limits(&r);
    if (parameters->rebuild && parameters->environment.keep)
        lobe_graph_invalidate_except(renderer->graph, ENVIRONMENT_MAP_PREFIX);
    else if (parameters->rebuild)
        lobe_graph_invalidate(renderer->graph);
    result = render(&r, frame);
    const environment_maps *maps = &renderer->environment.last;
    frame->environment_parts_left = maps->part_count - maps->parts_done;
    if (result != LOBE_OK) {
        renderer->environment.reads_back = false;
        lobe_frame_free(frame);
    }
    return result;
}
