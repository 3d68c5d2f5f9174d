#ifndef LOBE_SCENE_H
#define LOBE_SCENE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include <lobe/animation.h>
#include <lobe/api.h>
#include <lobe/deformation.h>
#include <lobe/environment.h>
#include <lobe/file.h>
#include <lobe/host.h>
#include <lobe/image.h>
#include <lobe/result.h>

#ifdef __cplusplus
extern "C" {
#endif

/// A scene in host memory. Lengths are metres, +Y is up, right-handed, as in glTF. A scene owns
/// everything it points to. It is plain data that a host may also fill itself; if
/// lobe_scene_destroy is to free it, allocate all of it (the structure, arrays, names) with
/// lobe_allocate. A renderer refuses numbers that are not finite or outside of the ranges given
/// here, with a line that names the object and the value.

typedef enum lobe_scene_wrap {
    LOBE_SCENE_WRAP_REPEAT,
    LOBE_SCENE_WRAP_MIRROR,
    LOBE_SCENE_WRAP_CLAMP
} lobe_scene_wrap;

/// How the texels of a normal map store normals: unit vectors in tangent space, +Y (OpenGL). Signed
/// values need a format that has a sign. Where only x and y are stored, as in maps of two channels,
/// z follows from their length after interpolation, and is not negative.
typedef enum lobe_normal_encoding {
    LOBE_NORMALS_UNSIGNED,    ///< RGB = (n + 1) / 2
    LOBE_NORMALS_SIGNED,      ///< RGB = n
    LOBE_NORMALS_UNSIGNED_XY, ///< RG = (n + 1) / 2
    LOBE_NORMALS_SIGNED_XY,   ///< RG = n
} lobe_normal_encoding;

/// An image of the scene. Rows run downwards; texture coordinate (0, 0) is its top left corner.
/// Channels that its format lacks are 0, alpha is 1: R8_UNORM is red, as a colour. A normal map is
/// linear, and has the channels of its encoding.
typedef struct lobe_scene_image {
    char *name; ///< where it comes from, for messages
    lobe_image image;
    /// The host gives the texels in each frame, as a resource on the device: see
    /// lobe_content_giver. Those of `image` are then an example, which is not uploaded: from it
    /// filters learn what to expect (how many lobes or bins they need, and for what range) when the
    /// scene is set, or the image is listed among its changes. Without any (NULL) they expect
    /// everything: `moments` is about as precise, with more bins than some maps need; `lobes` is
    /// less precise.
    bool on_device;
    /// Where materials use it as a normal map; not read otherwise. Colours are linear or sRGB as
    /// the format says.
    lobe_normal_encoding normals;
} lobe_scene_image;

/// A use of an image by a material.
typedef struct lobe_texture_use {
    int32_t image;                ///< index into lobe_scene.images; -1: none
    uint32_t texture_coordinates; ///< which set of the mesh [0, 1]
    lobe_scene_wrap wrap_u, wrap_v;
    bool nearest; ///< texels are not interpolated (the sampler's magnification filter)
    /// Texture coordinates are transformed before the fetch (KHR_texture_transform):
    /// uv' = T(offset) R(rotation) S(scale) uv, as two rows of an affine 2x3 matrix.
    float transform[2][3];
} lobe_texture_use;

/// No image, identity transform.
#define LOBE_TEXTURE_NONE                                                                          \
    (LOBE_LITERAL(lobe_texture_use){                                                               \
        -1, 0, LOBE_SCENE_WRAP_REPEAT, LOBE_SCENE_WRAP_REPEAT, false, {{1, 0, 0}, {0, 1, 0}}})

typedef enum lobe_material_model {
    /// glTF metal-rough: F D G2 / (4 cos) with a distribution of normals, and Lambert below it.
    LOBE_MATERIAL_MICROFACET,
    /// The papers' model: a sum of lobes of the half vector, which includes the cosine, without
    /// Fresnel term and shadowing; plus a Lambert part. It does not conserve energy: a lobe of
    /// colour 1 reflects up to four times the light it gets (docs/filters-compared.md).
    LOBE_MATERIAL_HALF_VECTOR_LOBES,
} lobe_material_model;

/// Shape of the base lobe, which also defines what "width" means.
typedef enum lobe_distribution {
    LOBE_DISTRIBUTION_GGX,         ///< microfacets only: roughness [0, 1], alpha = its square
    LOBE_DISTRIBUTION_BECKMANN,    ///< microfacets only: roughness [0, 1], alpha = its square
    LOBE_DISTRIBUTION_BLINN_PHONG, ///< exponent s [0, 1e6], normalised by (s+1)/2pi
    LOBE_DISTRIBUTION_VMF,         ///< concentration kappa [0, 1e6] of a von Mises-Fisher lobe
} lobe_distribution;

#define LOBE_MATERIAL_MAXIMUM_LOBES 4

/// One lobe of a half-vector material, in the frame of the texel's normal (z along the normal,
/// x along the tangent).
typedef struct lobe_base_lobe {
    float direction[3]; ///< unit length
    float width;        ///< exponent or kappa, multiplied by the width map if there is one
    float colour[3];    ///< linear RGB reflectance, multiplied by the specular map
} lobe_base_lobe;

/// Which space mixtures of lobes are built in (method: Xu et al. 2017, section 4).
typedef enum lobe_map_space {
    LOBE_SPACE_AUTOMATIC, ///< tangent
    LOBE_SPACE_TANGENT,   ///< over the maps themselves: cheapest, and as accurate on most meshes
    LOBE_SPACE_OBJECT,    ///< over the mesh's texture atlas, with its interpolated normals; tangent
                          ///< if the maps tile over the mesh, or the instance stretches it
    LOBE_SPACE_CAMERA,    ///< the same, seen from the camera; rebuilt when that moves
} lobe_map_space;

#define LOBE_WAVES_MAXIMUM_LAYERS 3

/// Waves on a surface, whose maps the host gives on the device in every frame (`waves` of
/// lobe_given_content), for instance with lobe_ocean_add. They lie on the plane of the tangent
/// frame: x along the tangent, y along the bitangent, at x = u and y = -v of the first set of
/// texture coordinates, before any transform. Slopes are dh/dx and dh/dy. Only filters that say so
/// (lobe_filter_draws_waves) draw them; for others the surface is smooth. Covariances are (xx, yy,
/// xy).
typedef struct lobe_waves {
    uint32_t layers; ///< periodic maps that add up, [0, LOBE_WAVES_MAXIMUM_LAYERS]; 0: no waves
    uint32_t size;   ///< texels along each side of a map: a power of two, [8, 4096]
    float lengths[LOBE_WAVES_MAXIMUM_LAYERS]; ///< of texture coordinates, that a map spans; above 0
    /// Points move across the plane, and the mesh does not move with them: what has moved to a
    /// point is found. False where the host's mesh is displaced.
    bool choppy;
    float rest[3];  ///< covariance of slopes that the maps lack: widens all highlights
    float total[3]; ///< of all slopes, maps included: how far waves mask each other
} lobe_waves;

typedef struct lobe_material {
    char *name;
    lobe_material_model model;
    lobe_distribution distribution;
    lobe_map_space space;

    // Both models. A map's texel is multiplied by the factor.
    float base_colour[4]; ///< linear RGB albedo (of the diffuse part of half-vector lobes), alpha
    lobe_texture_use base_colour_map; ///< sRGB or linear, as its image's format says
    lobe_texture_use normal_map;      ///< tangent space, +Y (OpenGL): see lobe_normal_encoding
    float normal_scale;               ///< x and y of the texel's normal are multiplied by it
    /// Concentration kappa_N of the normals inside one texel of the normal map; each base lobe is
    /// convolved with it (Xu et al. 2017, Eqs. 11-14). 0: none, the texel's normal is exact.
    float normal_concentration;
    /// Red: height outwards [0, 1]; values beyond that count as its ends. Displaces the surface
    /// with the knob `displacement`, and is what the filter `displaced` shades; always
    /// interpolated. sRGB is decoded first. Without a normal map, the surface's normals are those
    /// of the heights, except that none are made of half floats, nor of heights given on the
    /// device.
    lobe_texture_use height_map;
    /// What the range [0, 1] of the height map spans, as a fraction of the map's own width in the
    /// world (the length over which u grows by 1), so that the relief scales with the map. With
    /// square texels and a map w texels wide, neighbouring texels that differ by d have a slope of
    /// height_scale * w * d. Negative: the values are depths. 0: no relief. The width is the mean
    /// over the area of the mesh at rest, so that a relief is equally high everywhere, and flatter
    /// where the map is stretched (with the filters that docs/program.md names); transforms scale
    /// it with the mesh.
    float height_scale;
    float emissive[3]; ///< linear RGB radiance
    lobe_texture_use emissive_map;
    lobe_texture_use occlusion_map; ///< red; scales indirect light only
    float occlusion_strength;       ///< [0, 1]
    bool double_sided;
    /// Discard below alpha_cutoff; otherwise opaque. A mask that keeps all, as far as the host can
    /// read its map, is drawn as if there were none.
    bool alpha_mask;
    float alpha_cutoff;

    // Microfacet.
    float metallic;                          ///< [0, 1]
    float roughness;                         ///< [0, 1]
    lobe_texture_use metallic_roughness_map; ///< green: roughness, blue: metallic

    // Half-vector lobes.
    lobe_base_lobe lobes[LOBE_MATERIAL_MAXIMUM_LOBES];
    uint32_t lobe_count;           ///< [1, LOBE_MATERIAL_MAXIMUM_LOBES]
    lobe_texture_use width_map;    ///< red multiplies the width of every lobe (float formats)
    lobe_texture_use specular_map; ///< RGB multiplies the colour of every lobe

    /// Of microfacets without a map of normals, heights or roughness, and without a mask.
    lobe_waves waves;
} lobe_material;

/// A white microfacet material: GGX, roughness 1, metallic 0, no maps.
LOBE_API void lobe_material_default(lobe_material *material);

/// 18 floats, read by the shaders as they are.
typedef struct lobe_scene_vertex {
    float position[3];
    float normal[3];  ///< unit length
    float tangent[4]; ///< unit length, orthogonal to the normal; w = +1 or -1 gives the
                      ///< bitangent w * cross(normal, tangent); along increasing u of the
                      ///< normal map's coordinates, without one of the first set
    float texture_coordinates[2][2];
    float colour[4]; ///< linear RGB and alpha, multiplies base_colour; 1 if the mesh has none
} lobe_scene_vertex;

typedef struct lobe_mesh {
    char *name;
    lobe_scene_vertex *vertices;
    size_t vertex_count;
    uint32_t *indices; ///< three per triangle, counter-clockwise as seen from the front
    size_t index_count;
    bool has_texture_coordinates[2];
    bool has_colour;
    float minimum[3], maximum[3];  ///< bounds of the positions, as they are drawn
    lobe_deformation *deformation; ///< NULL: it keeps its shape
    /// The host gives the vertices on the device, in every frame, within the bounds above (all 0:
    /// anywhere): see lobe_content_giver. `vertices` is an example, not uploaded: coordinates and
    /// colours of those given must be laid out as there. With `deformation` they are its base.
    bool on_device;
} lobe_mesh;

/// A mesh placed in the world with a material. Where surfaces coincide, which is seen is undefined.
typedef struct lobe_instance {
    uint32_t mesh, material;
    float transform[16]; ///< object to world, column-major, affine, invertible. An import gives
                         ///< mirrored instances a mesh reflected in x, so that the determinant is
                         ///< above 0, except for meshes with a deformation, and for animations that
                         ///< mirror.
    bool hidden;         ///< not drawn; nothing is built for it alone
} lobe_instance;

typedef enum lobe_light_type {
    LOBE_LIGHT_DIRECTIONAL, ///< intensity in W/m2 (lux) perpendicular to it
    LOBE_LIGHT_POINT,       ///< intensity in W/sr (candela), falls with the squared distance
    LOBE_LIGHT_SPOT,        ///< a point light within a cone, as in KHR_lights_punctual
} lobe_light_type;

typedef struct lobe_light {
    lobe_light_type type;
    float position[3];            ///< point and spot
    float direction[3];           ///< directional and spot: where the light travels to, unit length
    float intensity[3];           ///< linear RGB, at least 0
    float range;                  ///< metres, 0: unlimited (windowing of KHR_lights_punctual)
    float inner_cone, outer_cone; ///< spot: half angles in radians, at most pi/2
} lobe_light;

typedef struct lobe_camera {
    float eye[3], target[3];      ///< not at the same place
    float up[3];                  ///< of any length above 0; along the view, the picture is turned
                                  ///< to any side
    float vertical_field_of_view; ///< radians, below pi; 0 for an orthographic camera
    float orthographic_height;    ///< metres across, above 0 where the field of view is 0
    /// Metres, above 0. The far plane is at infinity; of an orthographic camera it lies behind the
    /// bounds of the scene, which must hold all that is to be seen.
    float near_plane;
    /// How far the picture's centre lies off the view's axis: to the right and down, in heights of
    /// the picture. (0, 0): on the axis. For tiles of a larger picture and for the two eyes of a
    /// headset.
    float shift[2];
    /// For temporal antialiasing: where pixels are sampled, to the right of their centres and below
    /// them, in pixels. Moves the picture like a shift of jitter / height, but is no motion (see
    /// lobe_render_motion).
    float jitter[2];
} lobe_camera;

typedef struct lobe_scene {
    char *name;
    lobe_scene_image *images;
    size_t image_count;
    lobe_material *materials;
    size_t material_count;
    lobe_mesh *meshes;
    size_t mesh_count;
    lobe_instance *instances;
    size_t instance_count;
    lobe_light *lights;
    size_t light_count;
    lobe_rig *rig;                 ///< what moves; NULL: nothing
    lobe_environment *environment; ///< light from all directions; NULL: none
    bool has_added_light;          ///< the file has no light: the environment is the sky
    bool environment_visible;      ///< it is visible where nothing is hit, instead of `background`
    lobe_camera camera;
    bool has_camera;              ///< false: the file has none; `camera` is set by lobe_scene_frame
                                  ///< for a picture of 16:9
    float background[3];          ///< linear RGB radiance where nothing is hit
    float minimum[3], maximum[3]; ///< bounds of all instances in the world
} lobe_scene;

/// A perspective camera that sees all of a scene from the front, a little from the right and above,
/// as large as fits into a picture of this aspect (width / height, above 0). Bounds must be set. Of
/// meshes with a deformation the bounds are seen, of others the vertices.
LOBE_API void lobe_scene_frame(const lobe_scene *scene, double aspect, lobe_camera *camera);

/// A camera on the scene's path, on which measurements over time are taken. `part` [0, 1] says how
/// far along (clamped; NaN is 0). The target stays where it is.
/// - From 0 to 1/2 the path zooms out: the distance from target to eye grows exponentially, to 64
///   times that of the scene's own camera, which is what part 0 gives.
/// - From 1/2 to 3/4 the distance shrinks at the same pace to 8 times that, and stays so until 1.
///   Meanwhile, from 1/2 to 1, the eye turns once around the vertical (+Y) through the target, at
///   constant speed, counter-clockwise as seen from above, and the up vector with it.
/// The near plane's distance and an orthographic camera's height grow and shrink with the distance.
/// The eye moves continuously. `scene->camera` must be set, with eye and target apart.
LOBE_API void lobe_scene_path(const lobe_scene *scene, double part, lobe_camera *camera);

/// Replaces the environment of a scene. The old one is freed; the scene owns the new one. NULL:
/// none.
LOBE_API void lobe_scene_set_environment(lobe_scene *scene, lobe_environment *environment);

/// Frees everything and clears the pointer. NULL is allowed.
LOBE_API void lobe_scene_destroy(lobe_scene **scene);

/// A scene made by code, from a fixed seed.
typedef struct lobe_builtin_scene {
    const char *name;
    const char *summary; ///< one line
} lobe_builtin_scene;

LOBE_API size_t lobe_builtin_scene_count(void);
/// NULL for an index out of range.
LOBE_API const lobe_builtin_scene *lobe_builtin_scene_get(size_t index);

/// What shows the maps of a folder.
typedef enum lobe_carrier {
    LOBE_CARRIER_PLANE,  ///< horizontal, seen from above
    LOBE_CARRIER_SPHERE, ///< seen from the front
    /// hanging and gently waving, seen at an angle. A texel of the largest map takes half a
    /// millimetre: at 1280 x 720 pixels, two to eight texels lie across a pixel.
    LOBE_CARRIER_CLOTH,
} lobe_carrier;

/// What to open, and from where.
typedef struct lobe_scene_open_parameters {
    /// The name of a built-in scene, the path of a .gltf or .glb file, or a folder of PBR maps,
    /// which lobe_scene_open_material then puts on a cloth.
    const char *scene;
    /// A whole .gltf or .glb file in memory. `scene` is then only its name: in messages, and for
    /// the folder in which the files that it refers to lie. Needed only during the call. NULL:
    /// none.
    const void *data;
    size_t size; ///< bytes of `data`
    /// Where to read a .gltf or .glb file and those it refers to; not folders of maps, because the
    /// files of a source cannot be listed. NULL: in the file system. Needed during the call only.
    const lobe_file_source *files;
    /// A scene without light stays dark: for hosts that light it themselves. Otherwise the
    /// environment "sky" is added, with a notice.
    bool own_light_only;
    /// `scene` is a folder of PBR maps, and this shows them. NULL: a cloth, if it is a folder.
    const lobe_carrier *carrier;
} lobe_scene_open_parameters;

/// Opens a scene. From a file, everything that its default scene reaches is imported, at rest:
/// animations are imported into its rig, see lobe_scene_set_pose. One warning
/// names unsupported parts; triangles without area are dropped and normals of length zero
/// recomputed, each with a warning that counts them. Triangles without normals are flat, as glTF
/// requires. A missing camera or light is added, with a notice (see `own_light_only`). Maps of a
/// file or folder that have the same value in all texels become numbers of the material, with a
/// notice, and their images keep one texel: a host that wants to write such a map gives the
/// material an image again. A file with nothing to draw opens; lobe_renderer_set_scene rejects it.
/// On failure `*result` is NULL and the log has one message that names the file and the cause.
/// Errors: LOBE_ERROR_NOT_FOUND, _READ, _MALFORMED, _UNSUPPORTED, _LIMIT, _OUT_OF_MEMORY.
LOBE_API lobe_result lobe_scene_open_with(const lobe_scene_open_parameters *parameters,
                                          const lobe_host *host, lobe_scene **result);

/// The same, with `scene` alone.
LOBE_API lobe_result lobe_scene_open(const char *scene, const lobe_host *host, lobe_scene **result);

/// A carrier with the PBR maps of a folder, recognised by the names that ambientCG, Poly Haven,
/// Quixel, Poliigon, freepbr, Substance, Unity and Unreal give their files (albedo, normal, rough,
/// metal, gloss, arm, metallicSmoothness, disp, ...): PNG, JPEG, or OpenEXR, whose texels are
/// clamped to [0, 1]; normals and values keep 16 bits, colours 8. Packed files are taken apart;
/// gloss becomes roughness. Notices say which file became which map, and which images were ignored.
/// At least one map besides that of heights must be found; maps of several materials are
/// LOBE_ERROR_UNSUPPORTED, with a line that lists the materials. Heights are scaled to be as steep
/// as the normal map if there is one of their extent that agrees with them; else by 0.05. As the
/// folder has no light, the sky is added, turned so that its sun shows the relief. Errors as for
/// lobe_scene_open.
LOBE_API lobe_result lobe_scene_open_material(const char *folder, lobe_carrier carrier,
                                              const lobe_host *host, lobe_scene **result);

#ifdef __cplusplus
}
#endif

#endif
