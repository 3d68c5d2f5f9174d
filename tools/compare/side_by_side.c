#include "tools/compare/side_by_side.h"

#include <stdbool.h>
#include <stdio.h>
#include <string.h>

#include <lobe/colour.h>

#include "tools/compare/bitmap_font.h"

enum {
    GAP = 8,                               // between panels and around them
    DOT = 2,                               // texels a dot of the font is wide
    BAR_PADDING = 6,                       // around a caption
    LINE = (BITMAP_FONT_HEIGHT + 2) * DOT, // from one line of a caption to the next
    MAXIMUM_LINES = 4,
    SCALE = 3 * BITMAP_FONT_HEIGHT * DOT,      // height of the scale of errors
    CHARACTER = (BITMAP_FONT_WIDTH + 1) * DOT, // from one character to the next
};

static const uint8_t background[4] = {24, 24, 24, 255}, bar_colour[4] = {48, 48, 48, 255},
                     text_colour[4] = {235, 235, 235, 255};

typedef struct side_by_side_layout {
    uint32_t columns, rows, zoom;
    float magnification;
    bool with_errors;
    size_t cell_width, cell_height; ///< of a panel's picture, zoomed
    size_t bar;                     ///< height of a caption bar
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

// ---------------------------------------------------------------------------------------------
// Captions

/// How many characters of a caption go on its next line: up to a comma that does not come early, to
/// another space, or as many as fit.
static size_t line_length(const char *text, size_t characters) {
    size_t at_space = 0, at_comma = 0;
    if (strlen(text) <= characters)
        return strlen(text);
    for (size_t i = 1; i <= characters; i++) {
        if (text[i] != ' ')
            continue;
        at_space = i;
        if (text[i - 1] == ',' && 3 * i >= characters)
            at_comma = i;
    }
    return at_comma > 0 ? at_comma : at_space > 0 ? at_space : characters;
}

static size_t characters_per_line(const side_by_side_layout *layout) {
    return layout->cell_width > BAR_PADDING ? (layout->cell_width - BAR_PADDING) / CHARACTER : 0;
}

/// The rest of a caption after a line of it.
static const char *next_line(const char *text, size_t length) {
    text += length;
    return text + strspn(text, " ");
}

static size_t count_lines(const char *caption, size_t characters) {
    size_t lines = 0;
    while (caption != NULL && *caption != '\0' && characters > 0 && lines < MAXIMUM_LINES) {
        caption = next_line(caption, line_length(caption, characters));
        lines++;
    }
    return lines;
}

static void describe_scale(const side_by_side_layout *layout, char text[64]) {
    snprintf(text, 64, "errors 0 to %.3g", 1.0 / (double)layout->magnification);
}

/// All bars are as high as the longest caption needs.
static size_t bar_height(const side_by_side_panel *panels, size_t count,
                         const side_by_side_layout *layout) {
    const size_t characters = characters_per_line(layout);
    char scale[64];
    describe_scale(layout, scale);
    size_t lines = layout->with_errors ? count_lines(scale, characters) : 0;
    for (size_t index = 0; index < count; index++) {
        const size_t captions[] = {count_lines(panels[index].caption, characters),
                                   count_lines(panels[index].error_caption, characters)};
        for (int i = 0; i < 2; i++)
            lines = captions[i] > lines ? captions[i] : lines;
    }
    return (lines > 1 ? lines - 1 : 0) * LINE + BITMAP_FONT_HEIGHT * DOT + 2 * BAR_PADDING;
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
    layout.bar = bar_height(panels, count, &layout);
    return layout;
}

static size_t row_height(const side_by_side_layout *layout) {
    return (layout->with_errors ? 2 : 1) * (layout->bar + layout->cell_height) + GAP;
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

static void draw_bar(lobe_image *picture, size_t left, size_t top,
                     const side_by_side_layout *layout, const char *caption) {
    const size_t characters = characters_per_line(layout);
    const size_t lines = count_lines(caption, characters);
    fill(picture, left, top, layout->cell_width, layout->bar, bar_colour);
    for (size_t line = 0; line < lines; line++) {
        const size_t length = line_length(caption, characters);
        for (size_t i = 0; i < length; i++)
            draw_character(picture, left + BAR_PADDING + i * CHARACTER,
                           top + BAR_PADDING + line * LINE, caption[i]);
        caption = next_line(caption, length);
    }
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
    describe_scale(layout, caption);
    draw_bar(picture, left, top, layout, caption);
    size_t height = layout->cell_height < SCALE ? layout->cell_height : SCALE;
    for (size_t x = 0; x < layout->cell_width; x++) {
        uint8_t colour[4] = {0, 0, 0, 255};
        lobe_heat_colour(((float)x + 0.5f) / (float)layout->cell_width, colour);
        fill(picture, left + x, top + layout->bar, 1, height, colour);
    }
}

static void draw_panel(lobe_image *picture, size_t left, size_t top,
                       const side_by_side_layout *layout, const side_by_side_panel *panel) {
    draw_bar(picture, left, top, layout, panel->caption);
    top += layout->bar;
    draw_picture(picture, left, top, layout, panel->picture);
    top += layout->cell_height;
    if (panel->errors != NULL) {
        draw_bar(picture, left, top, layout, panel->error_caption);
        draw_errors(picture, left, top + layout->bar, layout, panel->errors);
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
