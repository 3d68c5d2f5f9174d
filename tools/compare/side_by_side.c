#include "tools/compare/side_by_side.h"

#include <stdbool.h>
#include <stdio.h>
#include <string.h>

#include <lobe/colour.h>

#include "tools/compare/bitmap_font.h"

enum {
    GAP = 8,                                          // between panels and around them
    DOT = 2,                                          // texels a dot of the font is wide
    BAR_PADDING = 6,                                  // above and below a caption
    BAR = BITMAP_FONT_HEIGHT * DOT + 2 * BAR_PADDING, // height of a caption bar
    SCALE = 3 * BITMAP_FONT_HEIGHT * DOT,             // height of the scale of errors
    CHARACTER = (BITMAP_FONT_WIDTH + 1) * DOT,        // from one character to the next
};

static const uint8_t background[4] = {24, 24, 24, 255}, bar_colour[4] = {48, 48, 48, 255},
                     text_colour[4] = {235, 235, 235, 255};

typedef struct side_by_side_layout {
    uint32_t columns, rows, zoom;
    float magnification;
    bool with_errors;
    size_t cell_width, cell_height; ///< of a panel's picture, zoomed
} side_by_side_layout;

static lobe_result fail(const lobe_host *host, lobe_result result, const char *message) {
    lobe_host_log(host, LOBE_LOG_ERROR, "side by side: %s", message);
    return result;
}

static lobe_result check_panels(const side_by_side_panel *panels, size_t count,
                                const lobe_host *host) {
    if (count == 0)
        return fail(host, LOBE_ERROR_INVALID_ARGUMENT, "there is no image");
    for (size_t index = 0; index < count; index++) {
        const lobe_image *picture = panels[index].picture, *errors = panels[index].errors;
        if (picture->format != LOBE_FORMAT_RGBA8_SRGB ||
            (errors != NULL && errors->format != LOBE_FORMAT_R32_FLOAT))
            return fail(host, LOBE_ERROR_INVALID_ARGUMENT,
                        "pictures must be RGBA8_SRGB, errors R32_FLOAT");
        if (picture->width != panels[0].picture->width ||
            picture->height != panels[0].picture->height ||
            (errors != NULL &&
             (errors->width != picture->width || errors->height != picture->height)))
            return fail(host, LOBE_ERROR_INVALID_ARGUMENT, "the images differ in size");
    }
    return LOBE_OK;
}

static side_by_side_layout arrange(const side_by_side_panel *panels, size_t count,
                                   const side_by_side_parameters *parameters) {
    static const side_by_side_parameters defaults = {0};
    parameters = parameters != NULL ? parameters : &defaults;
    size_t columns =
        parameters->columns > 0 && parameters->columns < count ? parameters->columns : count;
    side_by_side_layout layout = {
        .columns = (uint32_t)columns,
        .rows = (uint32_t)((count + columns - 1) / columns),
        .zoom = parameters->zoom > 0 ? parameters->zoom : 1,
        .magnification =
            parameters->error_magnification > 0.0f ? parameters->error_magnification : 1.0f,
    };
    for (size_t index = 0; index < count; index++)
        layout.with_errors |= panels[index].errors != NULL;
    layout.cell_width = (size_t)layout.zoom * panels[0].picture->width;
    layout.cell_height = (size_t)layout.zoom * panels[0].picture->height;
    return layout;
}

static size_t row_height(const side_by_side_layout *layout) {
    return (layout->with_errors ? 2 : 1) * (BAR + layout->cell_height) + GAP;
}

// ---------------------------------------------------------------------------------------------
// Drawing

static uint8_t *texel_at(lobe_image *picture, size_t x, size_t y) {
    return (uint8_t *)picture->texels + 4 * (y * picture->width + x);
}

static void fill(lobe_image *picture, size_t left, size_t top, size_t width, size_t height,
                 const uint8_t colour[4]) {
    for (size_t y = top; y < top + height; y++) {
        for (size_t x = left; x < left + width; x++)
            memcpy(texel_at(picture, x, y), colour, 4);
    }
}

static void draw_character(lobe_image *picture, size_t left, size_t top, char character) {
    for (int y = 0; y < BITMAP_FONT_HEIGHT; y++) {
        for (int x = 0; x < BITMAP_FONT_WIDTH; x++) {
            if (bitmap_font_dot(character, x, y))
                fill(picture, left + (size_t)x * DOT, top + (size_t)y * DOT, DOT, DOT, text_colour);
        }
    }
}

static void draw_bar(lobe_image *picture, size_t left, size_t top, size_t width,
                     const char *caption) {
    fill(picture, left, top, width, BAR, bar_colour);
    size_t end = left + width;
    for (size_t x = left + BAR_PADDING; caption != NULL && *caption != '\0' && x + CHARACTER <= end;
         x += CHARACTER)
        draw_character(picture, x, top + BAR_PADDING, *caption++);
}

static void draw_picture(lobe_image *picture, size_t left, size_t top,
                         const side_by_side_layout *layout, const lobe_image *source) {
    const uint8_t *texels = source->texels;
    for (size_t y = 0; y < source->height; y++) {
        for (size_t x = 0; x < source->width; x++)
            fill(picture, left + x * layout->zoom, top + y * layout->zoom, layout->zoom,
                 layout->zoom, texels + 4 * (y * source->width + x));
    }
}

static void draw_errors(lobe_image *picture, size_t left, size_t top,
                        const side_by_side_layout *layout, const lobe_image *errors) {
    const float *texels = errors->texels;
    for (size_t y = 0; y < errors->height; y++) {
        for (size_t x = 0; x < errors->width; x++) {
            uint8_t colour[4] = {0, 0, 0, 255};
            lobe_heat_colour(texels[y * errors->width + x] * layout->magnification, colour);
            fill(picture, left + x * layout->zoom, top + y * layout->zoom, layout->zoom,
                 layout->zoom, colour);
        }
    }
}

/// The meaning of the heat maps' colours, in a panel without errors.
static void draw_scale(lobe_image *picture, size_t left, size_t top,
                       const side_by_side_layout *layout) {
    char caption[64];
    snprintf(caption, sizeof caption, "errors 0 to %.3g", 1.0 / (double)layout->magnification);
    draw_bar(picture, left, top, layout->cell_width, caption);
    size_t height = layout->cell_height < SCALE ? layout->cell_height : SCALE;
    for (size_t x = 0; x < layout->cell_width; x++) {
        uint8_t colour[4] = {0, 0, 0, 255};
        lobe_heat_colour(((float)x + 0.5f) / (float)layout->cell_width, colour);
        fill(picture, left + x, top + BAR, 1, height, colour);
    }
}

static void draw_panel(lobe_image *picture, size_t left, size_t top,
                       const side_by_side_layout *layout, const side_by_side_panel *panel) {
    draw_bar(picture, left, top, layout->cell_width, panel->caption);
    top += BAR;
    draw_picture(picture, left, top, layout, panel->picture);
    top += layout->cell_height;
    if (panel->errors != NULL) {
        draw_bar(picture, left, top, layout->cell_width, panel->error_caption);
        draw_errors(picture, left, top + BAR, layout, panel->errors);
    } else if (layout->with_errors) {
        draw_scale(picture, left, top, layout);
    }
}

lobe_result side_by_side_compose(const side_by_side_panel *panels, size_t count,
                                 const side_by_side_parameters *parameters, const lobe_host *host,
                                 lobe_image *picture) {
    *picture = (lobe_image){0};
    lobe_result result = check_panels(panels, count, host);
    if (result != LOBE_OK)
        return result;
    side_by_side_layout layout = arrange(panels, count, parameters);
    size_t width = layout.columns * (layout.cell_width + GAP) + GAP;
    size_t height = layout.rows * row_height(&layout) + GAP;
    if (width > LOBE_IMAGE_MAXIMUM_EXTENT || height > LOBE_IMAGE_MAXIMUM_EXTENT)
        return fail(host, LOBE_ERROR_LIMIT, "the picture would be too large");
    result = lobe_image_allocate(picture, LOBE_FORMAT_RGBA8_SRGB, (uint32_t)width, (uint32_t)height,
                                 host);
    if (result != LOBE_OK)
        return result;
    fill(picture, 0, 0, width, height, background);
    for (size_t index = 0; index < count; index++) {
        size_t left = GAP + index % layout.columns * (layout.cell_width + GAP);
        size_t top = GAP + index / layout.columns * row_height(&layout);
        draw_panel(picture, left, top, &layout, &panels[index]);
    }
    return LOBE_OK;
}
