#include "scenes/format/radiance_hdr.h"

#include <math.h>
#include <string.h>

#include <lobe/colour.h>

#include "scenes/format/image_file.h"
#include "scenes/format/text_cursor.h"

// Ward 1991, "Real Pixels" (Graphics Gems II): three mantissas with a shared exponent. File layout:
// Ward, "Radiance File Formats", lbl.gov.

typedef struct hdr_reader {
    const char *name;
    const lobe_host *host;
    const uint8_t *at, *end;
    bool xyz;
    double scale[3]; // undoes exposure and colour correction
    float primaries[4][2];
    bool has_primaries;
    // Scan lines, and texels per line. They run downwards and to the right unless reversed.
    uint32_t line_count, length;
    bool lines_are_columns, lines_reversed, texels_reversed;
    lobe_image *image;
} hdr_reader;

static lobe_result fail(const hdr_reader *reader, const char *cause) {
    return lobe_host_fail(reader->host, LOBE_ERROR_MALFORMED, "%s: broken Radiance picture: %s",
                          reader->name, cause);
}

// ---------------------------------------------------------------------------------------------
// Header

bool scenes_radiance_hdr_recognise(const void *bytes, size_t size) {
    return size >= 2 && memcmp(bytes, "#?", 2) == 0;
}

// The next line without its line end; false at the end of the header.
static bool take_line(hdr_reader *reader, text_cursor *line) {
    const uint8_t *newline = memchr(reader->at, '\n', (size_t)(reader->end - reader->at));
    if (!newline)
        return false;
    *line = (text_cursor){(const char *)reader->at, (const char *)newline};
    if (line->end > line->at && line->end[-1] == '\r')
        line->end--;
    reader->at = newline + 1;
    return true;
}

static bool take_key(text_cursor *line, const char *key) {
    size_t length = strlen(key);
    if ((size_t)(line->end - line->at) < length || memcmp(line->at, key, length) != 0)
        return false;
    line->at += length;
    return true;
}

static lobe_result read_format(hdr_reader *reader, text_cursor *line) {
    scenes_text_cursor_skip_space(line);
    if (take_key(line, "32-bit_rle_rgbe"))
        reader->xyz = false;
    else if (take_key(line, "32-bit_rle_xyze"))
        reader->xyz = true;
    else
        return lobe_host_fail(reader->host, LOBE_ERROR_UNSUPPORTED,
                              "%s: Radiance picture of a format other than 32-bit_rle_rgbe and "
                              "32-bit_rle_xyze",
                              reader->name);
    return LOBE_OK;
}

// The texels were multiplied by this, which is divided out; several such lines multiply.
static lobe_result read_factors(hdr_reader *reader, text_cursor *line, bool one_for_all) {
    double factor = 0;
    for (int i = 0; i < 3; i++) {
        if ((i == 0 || !one_for_all) && !scenes_text_cursor_number(line, &factor))
            factor = 0;
        reader->scale[i] /= factor;
        if (!(factor > 0) || !(reader->scale[i] > 0) || !isfinite(reader->scale[i]))
            return fail(reader, one_for_all
                                    ? "its exposure is not a positive number"
                                    : "its colour correction is not three positive numbers");
    }
    return LOBE_OK;
}

// CIE x and y of red, green, blue and white. Photoshop writes eight zeroes, which say nothing.
static void read_primaries(hdr_reader *reader, text_cursor *line) {
    double number;
    for (int i = 0; i < 8; i++)
        reader->primaries[i / 2][i % 2] =
            scenes_text_cursor_number(line, &number) ? (float)number : 0;
    // The format's own are taken as those of Rec. 709, as colours without a header line are.
    static const float own[8] = {0.640f, 0.330f, 0.290f, 0.600f, 0.150f, 0.060f, 0.333f, 0.333f};
    for (int i = 0; i < 8; i++)
        reader->has_primaries |= fabsf(reader->primaries[i / 2][i % 2] - own[i]) > 1e-3f;
}

static lobe_result read_variables(hdr_reader *reader) {
    text_cursor line;
    while (take_line(reader, &line)) {
        lobe_result result = LOBE_OK;
        if (line.at == line.end)
            return LOBE_OK;
        if (take_key(&line, "FORMAT="))
            result = read_format(reader, &line);
        else if (take_key(&line, "EXPOSURE="))
            result = read_factors(reader, &line, true);
        else if (take_key(&line, "COLORCORR="))
            result = read_factors(reader, &line, false);
        else if (take_key(&line, "PRIMARIES="))
            read_primaries(reader, &line);
        if (result != LOBE_OK)
            return result;
    }
    return fail(reader, "its header does not end");
}

// "-Y" or the like, and a number.
static bool take_axis(text_cursor *line, char *axis, bool *minus, uint32_t *count) {
    scenes_text_cursor_skip_space(line);
    size_t number;
    if (line->end - line->at < 2 || (line->at[0] != '-' && line->at[0] != '+') ||
        (line->at[1] != 'X' && line->at[1] != 'Y'))
        return false;
    *minus = line->at[0] == '-';
    *axis = line->at[1];
    line->at += 2;
    if (!scenes_text_cursor_integer(line, LOBE_IMAGE_MAXIMUM_EXTENT, &number) || number == 0)
        return false;
    *count = (uint32_t)number;
    return true;
}

// +X runs to the right, +Y upwards.
static lobe_result read_resolution(hdr_reader *reader) {
    text_cursor line;
    char line_axis, texel_axis;
    bool line_minus, texel_minus;
    if (!take_line(reader, &line) ||
        !take_axis(&line, &line_axis, &line_minus, &reader->line_count) ||
        !take_axis(&line, &texel_axis, &texel_minus, &reader->length) || line_axis == texel_axis)
        return fail(reader, "its resolution is not like '-Y 512 +X 1024', with 1 to 65535 "
                            "texels per side");
    reader->lines_are_columns = line_axis == 'X';
    reader->lines_reversed = line_minus == reader->lines_are_columns;
    reader->texels_reversed = texel_minus != reader->lines_are_columns;
    if ((uint64_t)reader->line_count * reader->length > SCENE_IMAGE_MAXIMUM_TEXELS)
        return lobe_host_fail(reader->host, LOBE_ERROR_LIMIT,
                              "%s: %u x %u texels exceed lobe's limit (%zu in all)", reader->name,
                              reader->length, reader->line_count, SCENE_IMAGE_MAXIMUM_TEXELS);
    // However well it is compressed, a line takes at least four bytes.
    if ((uint64_t)(reader->end - reader->at) < 4 * (uint64_t)reader->line_count)
        return fail(reader, "ends early");
    return LOBE_OK;
}

// ---------------------------------------------------------------------------------------------
// Scan lines, as four bytes per texel

// One component of all texels: a count above 128 repeats a byte; a lower one precedes that many
// bytes.
static const char *unpack_component(hdr_reader *reader, uint8_t *out) {
    for (uint32_t done = 0; done < reader->length;) {
        if (reader->end - reader->at < 2)
            return "ends early";
        uint32_t count = *reader->at++;
        const bool run = count > 128;
        count -= run ? 128 : 0;
        if (count == 0 || count > reader->length - done)
            return "a run is longer than its line, or empty";
        if (!run && (uint32_t)(reader->end - reader->at) < count)
            return "ends early";
        for (uint32_t i = 0; i < count; i++)
            out[4 * (size_t)(done + i)] = reader->at[run ? 0 : i];
        reader->at += run ? 1 : count;
        done += count;
    }
    return NULL;
}

static const char *unpack_components(hdr_reader *reader, uint8_t *line) {
    if (((uint32_t)reader->at[2] << 8 | reader->at[3]) != reader->length)
        return "a line is longer or shorter than the resolution says";
    reader->at += 4;
    const char *cause = NULL;
    for (int component = 0; component < 4 && !cause; component++)
        cause = unpack_component(reader, line + component);
    return cause;
}

// Whole texels. Three ones precede a count by which the previous texel is repeated; consecutive
// counts are the digits of one number, lowest first, to base 256.
static const char *unpack_texels(hdr_reader *reader, uint8_t *line) {
    unsigned shift = 0;
    for (uint32_t done = 0; done < reader->length;) {
        if (reader->end - reader->at < 4)
            return "ends early";
        const uint8_t *texel = reader->at;
        reader->at += 4;
        if (texel[0] != 1 || texel[1] != 1 || texel[2] != 1) {
            memcpy(line + 4 * (size_t)done++, texel, 4);
            shift = 0;
            continue;
        }
        const uint64_t count = shift < 32 ? (uint64_t)texel[3] << shift : UINT32_MAX;
        if (done == 0 || count > reader->length - done)
            return "a run is longer than its line, or repeats nothing";
        for (uint64_t i = 0; i < count; i++, done++)
            memcpy(line + 4 * (size_t)done, line + 4 * (size_t)(done - 1), 4);
        shift += 8;
    }
    return NULL;
}

static const char *unpack_line(hdr_reader *reader, uint8_t *line) {
    if (reader->end - reader->at < 4)
        return "ends early";
    const uint8_t *mark = reader->at;
    const bool components = reader->length >= 8 && reader->length <= 0x7fff && mark[0] == 2 &&
                            mark[1] == 2 && mark[2] < 128;
    return components ? unpack_components(reader, line) : unpack_texels(reader, line);
}

// ---------------------------------------------------------------------------------------------
// Texels

// From CIE XYZ to Radiance's primaries (0.640, 0.330), (0.290, 0.600), (0.150, 0.060) with white at
// (1/3, 1/3), after SMPTE RP 177-1993, sections 3.3.1 to 3.3.7.
static void rgb_of_xyz(double v[3]) {
    static const double matrix[3][3] = {{2.565312843, -1.166849616, -0.398463227},
                                        {-1.022108172, 1.978286617, 0.043821555},
                                        {0.074724377, -0.251939567, 1.177215190}};
    const double xyz[3] = {v[0], v[1], v[2]};
    for (int i = 0; i < 3; i++)
        v[i] = matrix[i][0] * xyz[0] + matrix[i][1] * xyz[1] + matrix[i][2] * xyz[2];
}

static void place_texel(const hdr_reader *reader, const uint8_t *from, float *to) {
    // A mantissa was truncated: take the middle of the interval that it represents (Ward 1991).
    const double step = from[3] ? ldexp(1, from[3] - (128 + 8)) : 0;
    double v[3];
    for (int i = 0; i < 3; i++)
        v[i] = step * (from[i] + 0.5);
    if (reader->xyz)
        rgb_of_xyz(v);
    for (int i = 0; i < 3; i++)
        to[i] = (float)(v[i] * reader->scale[i]);
    to[3] = 1;
}

static void place_line(const hdr_reader *reader, uint32_t index, const uint8_t *line) {
    const uint32_t place = reader->lines_reversed ? reader->line_count - 1 - index : index;
    const size_t width = reader->image->width;
    for (uint32_t i = 0; i < reader->length; i++) {
        const uint32_t along = reader->texels_reversed ? reader->length - 1 - i : i;
        const size_t texel =
            reader->lines_are_columns ? along * width + place : place * width + along;
        place_texel(reader, line + 4 * (size_t)i, (float *)reader->image->texels + 4 * texel);
    }
}

static lobe_result decode(hdr_reader *reader) {
    const bool columns = reader->lines_are_columns;
    lobe_result result = lobe_image_allocate(
        reader->image, LOBE_FORMAT_RGBA32_FLOAT, columns ? reader->line_count : reader->length,
        columns ? reader->length : reader->line_count, reader->host);
    if (result != LOBE_OK)
        return result;
    uint8_t *line = lobe_allocate(lobe_host_allocator(reader->host), reader->length, 4);
    if (!line)
        return lobe_host_fail(reader->host, LOBE_ERROR_OUT_OF_MEMORY, "%s: out of memory",
                              reader->name);
    const char *cause = NULL;
    for (uint32_t i = 0; i < reader->line_count && !cause; i++) {
        cause = unpack_line(reader, line);
        if (!cause)
            place_line(reader, i, line);
    }
    lobe_release(line);
    return cause ? fail(reader, cause) : LOBE_OK;
}

lobe_result scenes_radiance_hdr_decode(const void *bytes, size_t size, const char *name,
                                       const lobe_host *host, lobe_image *image) {
    *image = (lobe_image){0};
    hdr_reader reader = {.name = name,
                         .host = host,
                         .at = bytes,
                         .end = (const uint8_t *)bytes + size,
                         .scale = {1, 1, 1},
                         .image = image};
    if (!scenes_radiance_hdr_recognise(bytes, size))
        return fail(&reader, "does not begin with '#?'");
    lobe_result result = read_variables(&reader);
    if (result == LOBE_OK)
        result = read_resolution(&reader);
    if (result == LOBE_OK)
        result = decode(&reader);
    if (result == LOBE_OK && reader.has_primaries && !reader.xyz)
        lobe_image_to_rec709(image, reader.primaries); // left alone if they span no colours
    if (result != LOBE_OK)
        lobe_image_free(image);
    return result;
}
