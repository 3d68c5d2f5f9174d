#include "third_party/tinygltf.h"

#include <algorithm>
#include <deque>
#include <exception>
#include <memory>
#include <new>
#include <string>
#include <vector>

#include <sys/stat.h>

#include <tiny_gltf.h>

namespace {

// The C view and what it points into. Strings and arrays that need no conversion are pointed to
// inside the model, which must not change any more.
struct Document {
    tinygltf::Model model;
    std::vector<gltf_buffer> buffers;
    std::vector<gltf_view> views;
    std::vector<gltf_accessor> accessors;
    std::deque<std::vector<gltf_primitive>> primitives;
    std::deque<std::vector<gltf_target>> targets;
    std::deque<std::vector<gltf_channel>> channels;
    std::deque<std::vector<gltf_animation_sampler>> animation_samplers;
    std::vector<gltf_mesh> meshes;
    std::vector<gltf_node> nodes;
    std::vector<gltf_material> materials;
    std::vector<gltf_texture> textures;
    std::vector<gltf_sampler> samplers;
    std::vector<gltf_image> images;
    std::vector<gltf_camera> cameras;
    std::vector<gltf_light> lights;
    std::vector<gltf_image_light> image_lights;
    std::vector<gltf_scene> scenes;
    std::vector<gltf_skin> skins;
    std::vector<gltf_animation> animations;
    std::vector<const char *> extensions;
};

struct Handle : gltf_document {
    Document content;
};

// ---------------------------------------------------------------------------------------------
// Callbacks

struct Reading {
    const gltf_source *source;
    const tinygltf::Model *model;
};

// tinygltf uses one callback for buffers, which come first, and for images, which we read ourselves
// and only if a material uses them. If a file has nothing between the two, nothing uses its images,
// and reading them does no harm.
bool file_exists(const std::string &, void *user) {
    const tinygltf::Model &model = *static_cast<Reading *>(user)->model;
    return model.bufferViews.empty() && model.accessors.empty() && model.meshes.empty() &&
           model.nodes.empty() && model.materials.empty();
}

std::string expand_path(const std::string &path, void *) {
    return path;
}

// tinygltf decodes '+' as a space, which only web forms mean by it.
std::string undo_form_decoding(const std::string &path) {
    struct stat status;
    std::string plus = path;
    std::replace(plus.begin(), plus.end(), ' ', '+');
    bool renamed = stat(path.c_str(), &status) != 0 && stat(plus.c_str(), &status) == 0;
    return renamed ? plus : path;
}

bool read_file(std::vector<unsigned char> *out, std::string *, const std::string &path,
               void *user) {
    const gltf_source &source = *static_cast<Reading *>(user)->source;
    size_t size = 0;
    std::unique_ptr<void, void (*)(void *)> bytes(
        source.read(source.user, undo_form_decoding(path).c_str(), &size), source.release);
    if (!bytes)
        return false;
    const unsigned char *begin = static_cast<const unsigned char *>(bytes.get());
    out->assign(begin, begin + size);
    return true;
}

// Keeps the encoded bytes of data URIs. Those of buffer views may lie outside their buffer here:
// they must not be touched, and are found through the view later.
bool keep_image(tinygltf::Image *image, const int, std::string *, std::string *, int, int,
                const unsigned char *bytes, int size, void *) {
    if (image->bufferView < 0 && size > 0)
        image->image.assign(bytes, bytes + size);
    return true;
}

// ---------------------------------------------------------------------------------------------
// Conversions

double number(const tinygltf::Value &object, const char *key, double missing) {
    if (!object.IsObject() || !object.Has(key) || !object.Get(key).IsNumber())
        return missing;
    return object.Get(key).GetNumberAsDouble();
}

int integer(const tinygltf::Value &object, const char *key, int missing) {
    if (!object.IsObject() || !object.Has(key) || !object.Get(key).IsInt())
        return missing;
    return object.Get(key).Get<int>();
}

void numbers(const tinygltf::Value &object, const char *key, size_t count, double *out) {
    if (!object.IsObject() || !object.Has(key))
        return;
    const tinygltf::Value &array = object.Get(key);
    for (size_t i = 0; array.IsArray() && i < count && i < array.ArrayLen(); i++) {
        if (array.Get(int(i)).IsNumber())
            out[i] = array.Get(int(i)).GetNumberAsDouble();
    }
}

void numbers(const std::vector<double> &values, size_t count, double *out) {
    for (size_t i = 0; i < count && i < values.size(); i++)
        out[i] = values[i];
}

const tinygltf::Value *extension(const tinygltf::ExtensionMap &map, const char *name) {
    auto found = map.find(name);
    return found == map.end() ? nullptr : &found->second;
}

unsigned channels(int type) {
    switch (type) {
    case TINYGLTF_TYPE_SCALAR:
        return 1;
    case TINYGLTF_TYPE_VEC2:
        return 2;
    case TINYGLTF_TYPE_VEC3:
        return 3;
    case TINYGLTF_TYPE_VEC4:
        return 4;
    case TINYGLTF_TYPE_MAT4:
        return 16;
    default:
        return 0;
    }
}

gltf_accessor convert(const tinygltf::Accessor &from) {
    gltf_accessor to = {};
    to.view = from.bufferView;
    to.offset = from.byteOffset;
    to.count = from.count;
    to.component = from.componentType;
    to.channels = channels(from.type);
    to.normalised = from.normalized;
    if (from.sparse.isSparse) {
        to.sparse.count = size_t(std::max(from.sparse.count, 0));
        to.sparse.index_view = from.sparse.indices.bufferView;
        to.sparse.value_view = from.sparse.values.bufferView;
        to.sparse.index_offset = size_t(std::max(from.sparse.indices.byteOffset, 0));
        to.sparse.value_offset = size_t(std::max(from.sparse.values.byteOffset, 0));
        to.sparse.index_component = from.sparse.indices.componentType;
    }
    return to;
}

gltf_target convert(const std::map<std::string, int> &from) {
    gltf_target to = {-1, -1, -1, false};
    for (const auto &attribute : from) {
        if (attribute.first == "POSITION")
            to.position = attribute.second;
        else if (attribute.first == "NORMAL")
            to.normal = attribute.second;
        else if (attribute.first == "TANGENT")
            to.tangent = attribute.second;
        else
            to.has_others = true;
    }
    return to;
}

gltf_primitive convert(const tinygltf::Primitive &from) {
    static const char *const names[GLTF_ATTRIBUTE_COUNT] = {
        "POSITION", "NORMAL",   "TANGENT",  "TEXCOORD_0", "TEXCOORD_1",
        "COLOR_0",  "JOINTS_0", "JOINTS_1", "WEIGHTS_0",  "WEIGHTS_1"};
    gltf_primitive to = {};
    for (int i = 0; i < GLTF_ATTRIBUTE_COUNT; i++) {
        auto found = from.attributes.find(names[i]);
        to.attributes[i] = found == from.attributes.end() ? -1 : found->second;
    }
    to.indices = from.indices;
    to.material = from.material;
    to.mode = from.mode;
    to.has_more_joints = from.attributes.count("JOINTS_2") > 0;
    return to;
}

gltf_node convert(const tinygltf::Node &from) {
    gltf_node to = {};
    to.name = from.name.c_str();
    to.mesh = from.mesh;
    to.camera = from.camera;
    to.skin = from.skin;
    const tinygltf::Value *light = extension(from.extensions, "KHR_lights_punctual");
    to.light = light ? integer(*light, "light", -1) : -1;
    to.children = from.children.data();
    to.child_count = from.children.size();
    to.has_matrix = !from.matrix.empty();
    numbers(from.matrix, 16, to.matrix);
    to.rotation[3] = to.scale[0] = to.scale[1] = to.scale[2] = 1;
    numbers(from.translation, 3, to.translation);
    numbers(from.rotation, 4, to.rotation);
    numbers(from.scale, 3, to.scale);
    to.weights = from.weights.data();
    to.weight_count = from.weights.size();
    return to;
}

// The three kinds of texture reference that tinygltf has differ in type, not in these members.
template <typename Info> gltf_texture_reference reference(const Info &from) {
    gltf_texture_reference to = {from.index, from.texCoord, {0, 0}, 0, {1, 1}};
    if (const tinygltf::Value *transform = extension(from.extensions, "KHR_texture_transform")) {
        to.coordinates = integer(*transform, "texCoord", to.coordinates);
        to.rotation = number(*transform, "rotation", 0);
        numbers(*transform, "offset", 2, to.offset);
        numbers(*transform, "scale", 2, to.scale);
    }
    return to;
}

gltf_material convert(const tinygltf::Material &from) {
    const tinygltf::PbrMetallicRoughness &pbr = from.pbrMetallicRoughness;
    gltf_material to = {};
    to.name = from.name.c_str();
    std::fill(to.base_colour, to.base_colour + 4, 1.0);
    numbers(pbr.baseColorFactor, 4, to.base_colour);
    to.metallic = pbr.metallicFactor;
    to.roughness = pbr.roughnessFactor;
    numbers(from.emissiveFactor, 3, to.emissive);
    const tinygltf::Value *strength = extension(from.extensions, "KHR_materials_emissive_strength");
    to.emissive_strength = strength ? number(*strength, "emissiveStrength", 1) : 1;
    to.normal_scale = from.normalTexture.scale;
    to.occlusion_strength = from.occlusionTexture.strength;
    to.base_colour_map = reference(pbr.baseColorTexture);
    to.metallic_roughness_map = reference(pbr.metallicRoughnessTexture);
    to.normal_map = reference(from.normalTexture);
    to.occlusion_map = reference(from.occlusionTexture);
    to.emissive_map = reference(from.emissiveTexture);
    to.alpha_mode = from.alphaMode.c_str();
    to.alpha_cutoff = from.alphaCutoff;
    to.double_sided = from.doubleSided;
    return to;
}

gltf_image convert(const tinygltf::Image &from) {
    return {from.name.c_str(), from.uri.c_str(), from.bufferView, from.image.data(),
            from.image.size()};
}

gltf_camera convert(const tinygltf::Camera &from) {
    bool perspective = from.type == "perspective";
    return {perspective, from.perspective.yfov, from.orthographic.ymag,
            perspective ? from.perspective.znear : from.orthographic.znear};
}

gltf_light convert(const tinygltf::Light &from) {
    gltf_light to = {from.type.c_str(),        {1, 1, 1},
                     from.intensity,           from.range,
                     from.spot.innerConeAngle, from.spot.outerConeAngle};
    numbers(from.color, 3, to.colour);
    return to;
}

gltf_buffer convert(const tinygltf::Buffer &from) {
    return {from.data.data(), from.data.size()};
}

gltf_view convert(const tinygltf::BufferView &from) {
    return {from.buffer, from.byteOffset, from.byteLength, from.byteStride};
}

gltf_texture convert(const tinygltf::Texture &from) {
    return {from.source, from.sampler};
}

gltf_sampler convert(const tinygltf::Sampler &from) {
    return {from.magFilter, from.wrapS, from.wrapT};
}

const char image_lights[] = "EXT_lights_image_based";

gltf_image_light convert(const tinygltf::Value &from) {
    gltf_image_light to = {{0, 0, 0, 1}, 1, {-1, -1, -1, -1, -1, -1}, false};
    numbers(from, "rotation", 4, to.rotation);
    to.intensity = number(from, "intensity", 1);
    to.has_harmonics = from.Has("irradianceCoefficients");
    const tinygltf::Value &levels = from.Get("specularImages");
    for (size_t i = 0; i < 6 && levels.IsArray() && levels.ArrayLen() > 0; i++) {
        const tinygltf::Value &face = levels.Get(0).Get(i);
        if (face.IsInt())
            to.faces[i] = face.Get<int>();
    }
    return to;
}

void convert_image_lights(Document &content, gltf_document &view) {
    const tinygltf::Value *all = extension(content.model.extensions, image_lights);
    const size_t count = all && all->Has("lights") ? all->Get("lights").ArrayLen() : 0;
    for (size_t i = 0; i < count; i++)
        content.image_lights.push_back(convert(all->Get("lights").Get(int(i))));
    view.image_lights = content.image_lights.data();
    view.image_light_count = count;
}

gltf_scene convert(const tinygltf::Scene &from) {
    const tinygltf::Value *light = extension(from.extensions, image_lights);
    return {from.nodes.data(), from.nodes.size(), light ? integer(*light, "light", -1) : -1};
}

gltf_skin convert(const tinygltf::Skin &from) {
    return {from.name.c_str(), from.joints.data(), from.joints.size(), from.inverseBindMatrices};
}

gltf_channel convert(const tinygltf::AnimationChannel &from) {
    gltf_channel to = {from.sampler, from.target_node, from.target_path.c_str(), nullptr};
    const tinygltf::Value *target = extension(from.target_extensions, "KHR_animation_pointer");
    if (target && target->Has("pointer") && target->Get("pointer").IsString())
        to.pointer = target->Get("pointer").Get<std::string>().c_str();
    return to;
}

gltf_animation_sampler convert(const tinygltf::AnimationSampler &from) {
    return {from.input, from.output, from.interpolation.c_str()};
}

template <typename From, typename To>
void convert_all(const std::vector<From> &from, std::vector<To> &to, const To *&pointer,
                 size_t &count) {
    to.reserve(from.size());
    for (const From &element : from)
        to.push_back(convert(element));
    pointer = to.data();
    count = to.size();
}

void convert_targets(Document &content, const tinygltf::Primitive &from, gltf_primitive &to) {
    if (from.targets.empty())
        return;
    content.targets.emplace_back();
    convert_all(from.targets, content.targets.back(), to.targets, to.target_count);
}

void convert_meshes(Document &content, gltf_document &view) {
    for (const tinygltf::Mesh &from : content.model.meshes) {
        content.primitives.emplace_back();
        gltf_mesh to = {from.name.c_str(), nullptr, 0, from.weights.data(), from.weights.size()};
        convert_all(from.primitives, content.primitives.back(), to.primitives, to.primitive_count);
        for (size_t i = 0; i < from.primitives.size(); i++)
            convert_targets(content, from.primitives[i], content.primitives.back()[i]);
        content.meshes.push_back(to);
    }
    view.meshes = content.meshes.data();
    view.mesh_count = content.meshes.size();
}

void convert_animations(Document &content, gltf_document &view) {
    for (const tinygltf::Animation &from : content.model.animations) {
        content.channels.emplace_back();
        content.animation_samplers.emplace_back();
        gltf_animation to = {from.name.c_str(), nullptr, 0, nullptr, 0};
        convert_all(from.channels, content.channels.back(), to.channels, to.channel_count);
        convert_all(from.samplers, content.animation_samplers.back(), to.samplers,
                    to.sampler_count);
        content.animations.push_back(to);
    }
    view.animations = content.animations.data();
    view.animation_count = content.animations.size();
}

void convert_document(Document &content, gltf_document &view) {
    const tinygltf::Model &model = content.model;
    convert_all(model.buffers, content.buffers, view.buffers, view.buffer_count);
    convert_all(model.bufferViews, content.views, view.views, view.view_count);
    convert_all(model.accessors, content.accessors, view.accessors, view.accessor_count);
    convert_meshes(content, view);
    convert_all(model.nodes, content.nodes, view.nodes, view.node_count);
    convert_all(model.materials, content.materials, view.materials, view.material_count);
    convert_all(model.textures, content.textures, view.textures, view.texture_count);
    convert_all(model.samplers, content.samplers, view.samplers, view.sampler_count);
    convert_all(model.images, content.images, view.images, view.image_count);
    convert_all(model.cameras, content.cameras, view.cameras, view.camera_count);
    convert_all(model.lights, content.lights, view.lights, view.light_count);
    convert_image_lights(content, view);
    convert_all(model.scenes, content.scenes, view.scenes, view.scene_count);
    view.scene = model.defaultScene;
    convert_all(model.skins, content.skins, view.skins, view.skin_count);
    convert_animations(content, view);
    for (const std::string &name : model.extensionsUsed)
        content.extensions.push_back(name.c_str());
    view.extensions = content.extensions.data();
    view.extension_count = content.extensions.size();
}

// ---------------------------------------------------------------------------------------------
// Parsing

// The first line of a message, which may have several and may quote a whole data URI.
void copy_message(const std::string &from, char *message, size_t size) {
    std::string line = from.substr(0, from.find('\n'));
    if (line.empty())
        line = "tinygltf gives no reason";
    if (line.size() > 200)
        line = line.substr(0, 200) + "...";
    size_t length = line.copy(message, size - 1);
    message[length] = 0;
}

bool parse(const gltf_source &source, tinygltf::Model &model, std::string &error) {
    Reading reading = {&source, &model};
    tinygltf::TinyGLTF parser;
    std::string warning;
    parser.SetFsCallbacks({file_exists, expand_path, read_file, nullptr, &reading});
    parser.SetImageLoader(keep_image, nullptr);
    unsigned size = unsigned(source.size);
    if (source.binary)
        return parser.LoadBinaryFromMemory(&model, &error, &warning,
                                           static_cast<const unsigned char *>(source.bytes), size,
                                           source.folder);
    return parser.LoadASCIIFromString(&model, &error, &warning,
                                      static_cast<const char *>(source.bytes), size, source.folder);
}

} // namespace

extern "C" const gltf_document *
third_party_gltf_document_parse(const gltf_source *source, char *message, size_t message_size) {
    message[0] = 0;
    try {
        std::unique_ptr<Handle> handle(new Handle());
        std::string error;
        if (!parse(*source, handle->content.model, error)) {
            copy_message(error, message, message_size);
            return nullptr;
        }
        convert_document(handle->content, *handle);
        return handle.release();
    } catch (const std::bad_alloc &) {
        return nullptr;
    } catch (const std::exception &exception) {
        // copy_message may itself run out of memory; nothing may leave a C function.
        try {
            copy_message(exception.what(), message, message_size);
        } catch (...) {
        }
        return nullptr;
    } catch (...) {
        return nullptr;
    }
}

extern "C" void third_party_gltf_document_free(const gltf_document *document) {
    delete static_cast<const Handle *>(document);
}
