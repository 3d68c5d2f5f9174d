#include "tests/passes/maps/wave_fields.h"

#include <math.h>

#include "tests/passes/support/picture.h"
#include "tests/passes/support/scene_builder.h"

void wave_fields_upload(fixture *f, const lobe_image images[2], wave_fields *fields) {
    fields->size = images[0].width;
    for (uint32_t i = 0; i < 2; i++) {
        const lobe_texture_parameters parameters = {.image = &images[i]};
        assert_int_equal(lobe_texture_create(f->device, &parameters, &fields->textures[i]),
                         LOBE_OK);
    }
}

void wave_fields_free(wave_fields *fields) {
    for (uint32_t i = 0; i < 2; i++)
        lobe_texture_destroy(&fields->textures[i]);
}

static void give_fields(void *user, lobe_graph *graph, const lobe_given_content *content) {
    const wave_fields *given = user;
    lobe_resource image =
        lobe_graph_image(graph, &(lobe_image_description){.name = "fields",
                                                          .format = LOBE_FORMAT_RGBA32_FLOAT,
                                                          .width = given->size,
                                                          .height = given->size,
                                                          .layers = 2,
                                                          .retained = true});
    for (uint32_t i = 0; i < 2; i++) {
        lobe_pass *pass = lobe_graph_add_pass(graph, LOBE_PASS_TRANSFER, "give");
        image = lobe_pass_copy(pass, lobe_graph_import_texture(graph, given->textures[i]),
                               (lobe_range){0}, image, (lobe_range){0, 1, i, 1});
    }
    content->waves[0] = image;
}

double wave_fields_seen_from(fixture *f, const lobe_material *material, wave_fields *given,
                             const double viewer[3], const double towards[3]) {
    lobe_scene *scene = scene_begin();
    scene_add_square(scene, material, 4000, NULL);
    scene_add_sun(scene, towards, 1);
    scene_look_from(scene, viewer, 0.2);
    scene_end(scene);
    lobe_renderer_set_content_giver(f->renderer, give_fields, given);
    assert_int_equal(lobe_renderer_set_scene(f->renderer, scene), LOBE_OK);
    const picture_request request = {"leadr", {NULL}, 4, 4, 1, false};
    lobe_frame frame = draw(f, &request);
    const double seen = pixel_at(&frame.radiance, 1, 2)[1];
    lobe_frame_free(&frame);
    assert_int_equal(lobe_renderer_set_scene(f->renderer, NULL), LOBE_OK);
    lobe_renderer_set_content_giver(f->renderer, NULL, NULL);
    lobe_scene_destroy(&scene);
    return seen;
}

void wave_field_at(const lobe_image *image, double x, double y, double value[4]) {
    const double column = floor(x - 0.5), row = floor(y - 0.5);
    for (int c = 0; c < 4; c++)
        value[c] = 0;
    for (int i = 0; i < 4; i++) {
        const int dx = i & 1, dy = i >> 1;
        const double weight =
            (dx ? x - 0.5 - column : column + 1.5 - x) * (dy ? y - 0.5 - row : row + 1.5 - y);
        const int last = (int)image->width - 1;
        const size_t at =
            (size_t)(((int)row + dy) & last) * image->width + (size_t)(((int)column + dx) & last);
        for (int c = 0; c < 4; c++)
            value[c] += weight * ((const float *)image->texels)[4 * at + c];
    }
}

double slope_density_at(const double slope[2], const double mean[2], const double c[3]) {
    const double x = slope[0] - mean[0], y = slope[1] - mean[1];
    const double determinant = c[0] * c[1] - c[2] * c[2];
    return exp(-0.5 * (c[1] * x * x - 2 * c[2] * x * y + c[0] * y * y) / determinant) /
           (2 * M_PI * sqrt(determinant));
}
