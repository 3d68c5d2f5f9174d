#include <math.h>
#include <string.h>

#include <lobe/colour.h>

#include "scenes/animation/transform.h"
#include "scenes/environment/direction.h"
#include "scenes/environment/environment.h"
#include "scenes/format/image_file.h"
#include "scenes/gltf/gltf.h"

// EXT_lights_image_based: a cube whose faces are images. lobe filters the first level itself and
// ignores the other levels, which were filtered in unknown ways.

typedef struct face_reader {
    gltf_import *import;
    int light; // for messages
    lobe_environment *environment;
    uint32_t size;      // of a face
    float decoded[256]; // linear values of sRGB bytes
} face_reader;

static lobe_result fail(const face_reader *reader, const char *cause) {
    return lobe_host_fail(reader->import->host, LOBE_ERROR_MALFORMED,
                          "%s: image-based light %d: %s", reader->import->path, reader->light,
                          cause);
}

// The first face determines the size of all.
static lobe_result allocate(face_reader *reader, const lobe_image *face) {
    const uint64_t texels = (uint64_t)ENVIRONMENT_FACE_COUNT * face->width * face->height;
    if (texels > SCENE_IMAGE_MAXIMUM_TEXELS ||
        face->height > LOBE_IMAGE_MAXIMUM_EXTENT / ENVIRONMENT_FACE_COUNT)
        return lobe_host_fail(reader->import->host, LOBE_ERROR_LIMIT,
                              "%s: image-based light %d: faces of %u x %u texels are too large",
                              reader->import->path, reader->light, face->width, face->height);
    reader->size = face->width;
    return lobe_image_allocate(&reader->environment->image, LOBE_FORMAT_RGBA32_FLOAT, face->width,
                               ENVIRONMENT_FACE_COUNT * face->width, reader->import->host);
}

// RGBD: colours are divided by alpha, which is 1 in JPEG and in PNG without alpha.
static void decode_texel(const face_reader *reader, const uint8_t from[4], float to[4]) {
    const float divisor = (float)(from[3] > 0 ? from[3] : 1) / 255;
    for (int i = 0; i < 3; i++)
        to[i] = reader->decoded[from[i]] / divisor;
    to[3] = 1;
}

// The images are those of OpenGL cubes "flipped about the vertical axis", so that they are not
// mirrored as seen from inside. They differ from those of a column by half a turn of the upper and
// the lower face.
static void place_face(const face_reader *reader, int index, const lobe_image *face) {
    const size_t count = (size_t)reader->size * reader->size;
    const bool turned = index == 2 || index == 3;
    const uint8_t *from = face->texels;
    float *to = (float *)reader->environment->image.texels + 4 * count * (size_t)index;
    for (size_t i = 0; i < count; i++)
        decode_texel(reader, from + 4 * (turned ? count - 1 - i : i), to + 4 * i);
}

static lobe_result read_face(face_reader *reader, int index, int image) {
    lobe_image face;
    lobe_result result = scenes_gltf_decode_image(reader->import, image, &face);
    if (result == LOBE_OK && index == 0)
        result = allocate(reader, &face);
    if (result == LOBE_OK && (face.width != reader->size || face.height != reader->size))
        result = fail(reader, "its faces are not squares of equal size");
    if (result == LOBE_OK)
        place_face(reader, index, &face);
    lobe_image_free(&face);
    return result;
}

static lobe_result read_faces(face_reader *reader, const gltf_image_light *light) {
    lobe_result result = LOBE_OK;
    for (int i = 0; i < 256; i++)
        reader->decoded[i] = lobe_srgb_decode((float)i / 255);
    for (int i = 0; i < ENVIRONMENT_FACE_COUNT && result == LOBE_OK; i++)
        result = read_face(reader, i, light->faces[i]);
    return result;
}

static lobe_result place(face_reader *reader, const gltf_image_light *light) {
    lobe_environment *environment = reader->environment;
    double columns[3][3];
    if (!scenes_transform_rotation(light->rotation, columns))
        return fail(reader, "its rotation has no length");
    if (!(light->intensity >= 0 && light->intensity <= 1e30))
        return fail(reader, "its intensity is outside [0, 1e30]");
    environment->layout = LOBE_ENVIRONMENT_CUBE_COLUMN;
    environment->intensity = (float)light->intensity;
    for (int i = 0; i < 9; i++)
        environment->world_from_environment[i / 3][i % 3] = (float)columns[i / 3][i % 3];
    return LOBE_OK;
}

static lobe_result convert(gltf_import *import, int index) {
    const gltf_image_light *light = &import->document->image_lights[index];
    face_reader reader = {.import = import, .light = index};
    if (light->has_harmonics)
        scenes_gltf_note_unsupported(import, "irradianceCoefficients (lobe computes its own)");
    lobe_result result =
        scenes_environment_allocate(import->path, import->host, &reader.environment);
    import->scene->environment = reader.environment; // frees it also on failure
    if (result == LOBE_OK)
        result = place(&reader, light);
    if (result == LOBE_OK)
        result = read_faces(&reader, light);
    return result == LOBE_OK ? scenes_environment_complete(reader.environment, import->host)
                             : result;
}

lobe_result scenes_gltf_convert_environment(gltf_import *import) {
    const gltf_document *document = import->document;
    int scene;
    lobe_result result = scenes_gltf_choose_scene(import, &scene);
    if (result != LOBE_OK || scene < 0 || document->scenes[scene].image_light < 0)
        return result;
    const int light = document->scenes[scene].image_light;
    if ((size_t)light >= document->image_light_count)
        return lobe_host_fail(import->host, LOBE_ERROR_MALFORMED,
                              "%s: there is no image-based light %d", import->path, light);
    return convert(import, light);
}
