#include "scenes/gltf/schema.h"

#include <string.h>

#include "scenes/gltf/json.h"

// ---------------------------------------------------------------------------------------------
// Version and extensions, which are checked first

typedef struct gltf_head {
    const char *path;
    const lobe_host *host;
    bool points; ///< the current target of an animation is a pointer
    pointer_nodes *pointers;
} gltf_head;

static lobe_result fail(const gltf_head *head, const char *what, const char *which) {
    return lobe_host_fail(head->host, LOBE_ERROR_UNSUPPORTED, "%s: %s %s", head->path, what, which);
}

// Minor versions are compatible: a reader of 2.0 reads 2.1 unless minVersion forbids it.
static lobe_result visit_version(void *user, const char *text) {
    return strncmp(text, "2.", 2) == 0 ? LOBE_OK
                                       : fail(user, "lobe reads glTF 2.0, this is version", text);
}

static lobe_result visit_minimum_version(void *user, const char *text) {
    return strcmp(text, "2.0") == 0 ? LOBE_OK
                                    : fail(user, "lobe reads glTF 2.0, this needs version", text);
}

static lobe_result visit_required_extension(void *user, const char *text) {
    return scenes_gltf_extension_supported(text)
               ? LOBE_OK
               : fail(user, "requires the unsupported extension", text);
}

bool scenes_gltf_extension_supported(const char *name) {
    static const char *const supported[] = {
        "EXT_lights_image_based",          "KHR_animation_pointer", "KHR_lights_punctual",
        "KHR_materials_emissive_strength", "KHR_mesh_quantization", "KHR_texture_transform",
    };
    for (size_t i = 0; i < sizeof supported / sizeof *supported; i++) {
        if (strcmp(supported[i], name) == 0)
            return true;
    }
    return false;
}

#define END                                                                                        \
    { NULL, NULL, false }

static const json_schema version = {.kind = JSON_STRING, .visit = visit_version};
static const json_schema minimum_version = {.kind = JSON_STRING, .visit = visit_minimum_version};
static const json_schema head_asset = {
    .kind = JSON_OBJECT,
    .members = (const json_member[]){
        {"version", &version, true}, {"minVersion", &minimum_version, false}, END}};
static const json_schema required_extension = {.kind = JSON_STRING,
                                               .visit = visit_required_extension};
static const json_schema required_extensions = {.kind = JSON_ARRAY, .element = &required_extension};
static const json_schema head_schema = {
    .kind = JSON_OBJECT,
    .members = (const json_member[]){
        {"asset", &head_asset, true}, {"extensionsRequired", &required_extensions, false}, END}};

// ---------------------------------------------------------------------------------------------
// glTF 2.0, section 5, as far as lobe and tinygltf read it

static const json_schema text = {.kind = JSON_STRING};
static const json_schema number = {.kind = JSON_NUMBER};
static const json_schema integer = {.kind = JSON_INDEX};
static const json_schema size = {.kind = JSON_SIZE};
static const json_schema boolean = {.kind = JSON_BOOLEAN};
static const json_schema object = {.kind = JSON_OBJECT};

static const json_schema texts = {.kind = JSON_ARRAY, .element = &text};
static const json_schema numbers = {.kind = JSON_ARRAY, .element = &number};
static const json_schema numbers_2 = {.kind = JSON_ARRAY, .element = &number, .length = 2};
static const json_schema numbers_3 = {.kind = JSON_ARRAY, .element = &number, .length = 3};
static const json_schema numbers_4 = {.kind = JSON_ARRAY, .element = &number, .length = 4};
static const json_schema numbers_16 = {.kind = JSON_ARRAY, .element = &number, .length = 16};
static const json_schema indices = {.kind = JSON_ARRAY, .element = &integer};
static const json_schema named_indices = {.kind = JSON_OBJECT, .element = &integer};

#define OBJECT(name, ...)                                                                          \
    static const json_schema name = {.kind = JSON_OBJECT,                                          \
                                     .members = (const json_member[]){__VA_ARGS__, END}}
#define ARRAY_OF(name, of) static const json_schema name = {.kind = JSON_ARRAY, .element = &of}

OBJECT(buffer, {"byteLength", &size, true}, {"uri", &text, false}, {"name", &text, false});
ARRAY_OF(buffers, buffer);

OBJECT(view, {"buffer", &integer, true}, {"byteOffset", &size, false}, {"byteLength", &size, true},
       {"byteStride", &size, false}, {"target", &integer, false}, {"name", &text, false});
ARRAY_OF(views, view);

OBJECT(sparse_indices, {"bufferView", &integer, true}, {"byteOffset", &integer, false},
       {"componentType", &integer, true});
OBJECT(sparse_values, {"bufferView", &integer, true}, {"byteOffset", &integer, false});
OBJECT(sparse, {"count", &integer, true}, {"indices", &sparse_indices, true},
       {"values", &sparse_values, true});
OBJECT(accessor, {"bufferView", &integer, false}, {"byteOffset", &size, false},
       {"componentType", &integer, true}, {"normalized", &boolean, false}, {"count", &size, true},
       {"type", &text, true}, {"min", &numbers, false}, {"max", &numbers, false},
       {"sparse", &sparse, false}, {"name", &text, false});
ARRAY_OF(accessors, accessor);

ARRAY_OF(targets, named_indices);
OBJECT(primitive, {"attributes", &named_indices, true}, {"indices", &integer, false},
       {"material", &integer, false}, {"mode", &integer, false}, {"targets", &targets, false});
ARRAY_OF(primitives, primitive);
OBJECT(mesh, {"primitives", &primitives, true}, {"weights", &numbers, false},
       {"name", &text, false});
ARRAY_OF(meshes, mesh);

OBJECT(node_light, {"light", &integer, true});
OBJECT(node_extensions, {"KHR_lights_punctual", &node_light, false});
OBJECT(node, {"mesh", &integer, false}, {"camera", &integer, false}, {"skin", &integer, false},
       {"children", &indices, false}, {"matrix", &numbers_16, false},
       {"translation", &numbers_3, false}, {"rotation", &numbers_4, false},
       {"scale", &numbers_3, false}, {"weights", &numbers, false},
       {"extensions", &node_extensions, false}, {"name", &text, false});
ARRAY_OF(nodes, node);

OBJECT(scene_image_light, {"light", &integer, true});
OBJECT(scene_extensions, {"EXT_lights_image_based", &scene_image_light, false});
OBJECT(scene, {"nodes", &indices, false}, {"extensions", &scene_extensions, false},
       {"name", &text, false});
ARRAY_OF(scenes, scene);

OBJECT(texture_transform, {"offset", &numbers_2, false}, {"rotation", &number, false},
       {"scale", &numbers_2, false}, {"texCoord", &integer, false});
OBJECT(reference_extensions, {"KHR_texture_transform", &texture_transform, false});
OBJECT(reference, {"index", &integer, true}, {"texCoord", &integer, false},
       {"scale", &number, false}, {"strength", &number, false},
       {"extensions", &reference_extensions, false});
OBJECT(metallic_roughness, {"baseColorFactor", &numbers_4, false},
       {"metallicFactor", &number, false}, {"roughnessFactor", &number, false},
       {"baseColorTexture", &reference, false}, {"metallicRoughnessTexture", &reference, false});
OBJECT(emissive_strength, {"emissiveStrength", &number, false});
OBJECT(material_extensions, {"KHR_materials_emissive_strength", &emissive_strength, false});
OBJECT(material, {"pbrMetallicRoughness", &metallic_roughness, false},
       {"normalTexture", &reference, false}, {"occlusionTexture", &reference, false},
       {"emissiveTexture", &reference, false}, {"emissiveFactor", &numbers_3, false},
       {"alphaMode", &text, false}, {"alphaCutoff", &number, false},
       {"doubleSided", &boolean, false}, {"extensions", &material_extensions, false},
       {"name", &text, false});
ARRAY_OF(materials, material);

OBJECT(texture, {"sampler", &integer, false}, {"source", &integer, false}, {"name", &text, false});
ARRAY_OF(textures, texture);
OBJECT(sampler, {"magFilter", &integer, false}, {"minFilter", &integer, false},
       {"wrapS", &integer, false}, {"wrapT", &integer, false}, {"name", &text, false});
ARRAY_OF(samplers, sampler);
OBJECT(image, {"uri", &text, false}, {"mimeType", &text, false}, {"bufferView", &integer, false},
       {"name", &text, false});
ARRAY_OF(images, image);

OBJECT(perspective, {"yfov", &number, true}, {"znear", &number, true}, {"zfar", &number, false},
       {"aspectRatio", &number, false});
OBJECT(orthographic, {"xmag", &number, true}, {"ymag", &number, true}, {"znear", &number, true},
       {"zfar", &number, true});
OBJECT(camera, {"type", &text, true}, {"perspective", &perspective, false},
       {"orthographic", &orthographic, false}, {"name", &text, false});
ARRAY_OF(cameras, camera);

OBJECT(spot, {"innerConeAngle", &number, false}, {"outerConeAngle", &number, false});
OBJECT(light, {"type", &text, true}, {"color", &numbers_3, false}, {"intensity", &number, false},
       {"range", &number, false}, {"spot", &spot, false}, {"name", &text, false});
ARRAY_OF(lights, light);
OBJECT(lights_punctual, {"lights", &lights, true});
OBJECT(skin, {"joints", &indices, true}, {"skeleton", &integer, false},
       {"inverseBindMatrices", &integer, false}, {"name", &text, false});
ARRAY_OF(skins, skin);

// KHR_animation_pointer.
static lobe_result visit_pointer(void *user, const char *text) {
    (void)text;
    ((gltf_head *)user)->points = true;
    return LOBE_OK;
}

static lobe_result leave_target(void *user, size_t begin, uint32_t members) {
    gltf_head *head = user;
    const bool lacks_node = head->points && !(members & 1);
    head->points = false;
    return lacks_node ? scenes_pointer_nodes_add(head->pointers, begin, head->path, head->host)
                      : LOBE_OK;
}

static const json_schema pointer = {.kind = JSON_STRING, .visit = visit_pointer};
OBJECT(animation_pointer, {"pointer", &pointer, true});
OBJECT(target_extensions, {"KHR_animation_pointer", &animation_pointer, false});
static const json_schema channel_target = {
    .kind = JSON_OBJECT,
    .members = (const json_member[]){{"node", &integer, false},
                                     {"path", &text, true},
                                     {"extensions", &target_extensions, false},
                                     END},
    .leave = leave_target};
OBJECT(channel, {"sampler", &integer, true}, {"target", &channel_target, true});
ARRAY_OF(channels, channel);
OBJECT(animation_sampler, {"input", &integer, true}, {"output", &integer, true},
       {"interpolation", &text, false});
ARRAY_OF(animation_samplers, animation_sampler);
OBJECT(animation, {"channels", &channels, true}, {"samplers", &animation_samplers, true},
       {"name", &text, false});
ARRAY_OF(animations, animation);

// EXT_lights_image_based. It also requires irradiance coefficients and the image size, which are
// not read.
static const json_schema cube_faces = {.kind = JSON_ARRAY, .element = &integer, .length = 6};
static const json_schema cube_levels = {.kind = JSON_ARRAY, .element = &cube_faces, .filled = true};
static const json_schema harmonics = {.kind = JSON_ARRAY, .element = &numbers_3, .length = 9};
OBJECT(image_light, {"rotation", &numbers_4, false}, {"intensity", &number, false},
       {"irradianceCoefficients", &harmonics, false}, {"specularImages", &cube_levels, true},
       {"specularImageSize", &integer, false}, {"name", &text, false});
ARRAY_OF(image_lights, image_light);
OBJECT(lights_image_based, {"lights", &image_lights, true});

OBJECT(root_extensions, {"KHR_lights_punctual", &lights_punctual, false},
       {"EXT_lights_image_based", &lights_image_based, false});

OBJECT(root, {"asset", &object, true}, {"extensionsUsed", &texts, false},
       {"extensionsRequired", &texts, false}, {"buffers", &buffers, false},
       {"bufferViews", &views, false}, {"accessors", &accessors, false}, {"meshes", &meshes, false},
       {"nodes", &nodes, false}, {"scenes", &scenes, false}, {"scene", &integer, false},
       {"materials", &materials, false}, {"textures", &textures, false},
       {"samplers", &samplers, false}, {"images", &images, false}, {"cameras", &cameras, false},
       {"animations", &animations, false}, {"skins", &skins, false},
       {"extensions", &root_extensions, false});

lobe_result scenes_gltf_schema_check(const char *path, const char *json, size_t json_size,
                                     const lobe_host *host, pointer_nodes *pointers) {
    gltf_head head = {.path = path, .host = host, .pointers = pointers};
    json_text content = {path, json, json_size, host, &head};
    lobe_result result = scenes_json_check(&content, &head_schema);
    return result == LOBE_OK ? scenes_json_check(&content, &root) : result;
}
