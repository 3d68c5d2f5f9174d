#ifndef PASSES_UPLOAD_DEVICE_SCENE_H
#define PASSES_UPLOAD_DEVICE_SCENE_H

#include <lobe/device.h>
#include <lobe/graph.h>
#include <lobe/renderer.h>
#include <lobe/scene.h>

#include "passes/upload/deformation/device_deformation.h"
#include "shaders/interface/material.h"

/// A map of a material, ready to be bound.
typedef struct device_map {
    const lobe_texture_use *use; ///< NULL: the material has no such map
    int32_t image;               ///< of the scene, when the map was uploaded
    uint32_t width, height;      ///< texels
    lobe_format format;
    lobe_normal_encoding normals;
    bool readable;            ///< by the host
    const lobe_image *texels; ///< in host memory, as far as there are any
} device_map;

/// A channel of an image's texels: metal or widths, where a material uses it so.
typedef struct image_channel {
    bool known;  ///< since the device has these texels
    bool varies; ///< otherwise it is `value` everywhere
    float value;
} image_channel;

/// Those that a material may use: red, green, blue.
typedef struct image_channels {
    image_channel of[3];
} image_channels;

/// The least alpha of an image's texels, where a material uses it as a mask.
typedef struct image_alpha {
    bool known; ///< since the device has these texels
    float least;
} image_alpha;

/// Whether diffuse colours go with normals (passes/maps/colours/colour_correlation.h).
typedef struct colour_correlation {
    bool asked; ///< false: no filter has
    bool known; ///< the answer has come from the device
    bool follow_normals;
    /// A frame that nobody waited for was drawn without the answer. Its pipelines serve either, and
    /// later frames keep them.
    bool was_open;
    uint64_t late;              ///< by which the graph finds the answer; 0: no frame asks for it
    int32_t images[3];          ///< that it is found from: base colour, normal, width; -1: none
    uint32_t texel_versions[3]; ///< of these
    float normal_scale, height_scale, metallic;
    float alpha, cutoff; ///< of its mask (passes/upload/colours/mask_alpha.h); without one, 0
} colour_correlation;

typedef struct device_material {
    const lobe_material *material;
    lobe_buffer *constants;
    /// The same without what no filtered map depends on, such as emission and where maps lie; and
    /// without colours and metal, too. Maps of lobes with their colours read the first, those of
    /// directions and widths the second, so that a change of the rest does not rebuild them.
    lobe_buffer *colour_constants, *map_constants;
    struct material_constants values; ///< what `constants` holds
    lobe_material_model model;        ///< when it was uploaded, like the next two
    lobe_distribution distribution;
    uint32_t lobe_count; ///< of microfacets 1
    device_map maps[MAP_COUNT];
    uint32_t map_bits;           ///< bit MAP_...: the material has one
    uint32_t second_coordinates; ///< bit MAP_...: the map uses the second set
    /// On all meshes that have the material, the second set of texture coordinates equals the first
    /// (mesh_measures), so that a map lies on them alike by either. Found where a map uses the
    /// second set, else false.
    bool equal_sets;
    /// Bit MAP_...: on all meshes that have the material, the map's coordinates stay within [0, 1],
    /// so that how they wrap does not matter.
    uint32_t inside;
    uint32_t first_instance; ///< 1 + index of the first that has it; 0: none
    /// Normals made from the height map (passes/upload/heights/), in place of a normal map; NULL:
    /// none.
    lobe_texture *height_normals;
    lobe_image height_normal_texels;
    lobe_texture_use height; ///< a copy of the height map's: not read by shading
    float height_scale;
    colour_correlation colours;
    /// It has a mask (lobe_material.alpha_mask) that may cut something away: one that keeps all is
    /// drawn as if there were none (passes/upload/colours/mask_alpha.h).
    bool masked;
    bool metallic_varies; ///< the width map determines where the material is metal
    bool widths_vary;     ///< the width map makes base lobes differ in width
    /// Of lobes in maps that leave out a width map which lies apart: its mean. Else 1.
    float width_factor;
    float metallic; ///< its metallic factor, times the map's where that is constant
    /// Increases with each change of its lobes or the texels of its maps: not of its base colour,
    /// emission or occlusion alone. 0: not on the device.
    uint32_t version;
    /// Of these, changes of what maps it has, of what kind its lobes are, and how many; and those
    /// that left all of this as it was, and the texels: of roughness, for example.
    uint32_t parameter_version, factor_version;
    uint32_t texel_versions[MAP_COUNT]; ///< increase with each change of the map's texels
    uint32_t pose_version;              ///< of the lobe_posed_material that moves it
} device_material;

/// How a lobe_grid lies on a mesh.
typedef struct grid_layout {
    uint32_t mesh, mesh_version, texture_coordinates;
    float transform[2][3]; ///< of the texture coordinates
} grid_layout;

typedef struct device_instance {
    uint32_t mesh, material;
    uint32_t next_of_material; ///< 1 + index of the next with the material; 0: none
    /// The texture coordinates of the lobes' grid stay within [0, 1] and do not overlap: each texel
    /// belongs to one place of the mesh.
    bool is_atlas;
    grid_layout layout; ///< for which `is_atlas` was found; all zero: none
    /// Of a material with normals of its heights: length over which u of the height map grows by 1,
    /// the object's (passes/upload/heights/map_width.h). 0: none.
    float map_width;
    grid_layout height_layout; ///< for which that was found; all zero: none
} device_instance;

/// What is drawn in place of an instance's mesh: buffers of struct vertex, uint32 and
/// lobe_draw_arguments. All zero: the mesh itself.
typedef struct displaced_geometry {
    lobe_resource vertices, indices, arguments;
    lobe_resource previous_vertices; ///< all zero: only the transform moves them
} displaced_geometry;

typedef struct mesh_measures {
    /// How densely both sets of texture coordinates are laid out: the smallest length in texture
    /// coordinates (the root of their area) per metre (the root of the triangle's area) over all
    /// triangles.
    float least_density[2];
    /// Of both sets of texture coordinates: least u and v, largest u and v. Infinite where they are
    /// not known.
    float coordinates[2][2][2];
    bool equal_sets; ///< it has both sets, and they are equal at all vertices, as far as is known
    float least_alpha, largest_alpha; ///< of the vertices' colours
    float minimum[3], maximum[3];     ///< of their positions, before any deformation
    size_t vertex_count, index_count;
    uint32_t version;   ///< increases with each upload, from 1 on
    bool has_instances; ///< hidden ones, too
} mesh_measures;

/// The device's copy of a scene: only what instances use. What is uploaded reaches the device with
/// the graph's next frame.
typedef struct device_scene {
    const lobe_scene *scene;
    lobe_graph *graph;               ///< which textures and buffers belong to
    const lobe_allocator *allocator; ///< the device's
    lobe_texture *white;             ///< one white texel, where a map is missing
    lobe_texture **images;           ///< one for each image of the scene; NULL: not used
    image_channels *channels;        ///< one for each image
    image_alpha *alphas;             ///< one for each image
    /// One for each image: its texels in this frame, if the host gives them on the device.
    lobe_resource *given;
    lobe_resource *given_waves; ///< one for each material: the maps of its waves
    lobe_resource
        *given_vertices; ///< one for each mesh: vertices that the host gives in this frame
    /// One for each mesh: its vertices in the previous frame, which the host gave or which were
    /// deformed again for motion; all zero: as in this frame.
    lobe_resource *previous_vertices;
    /// One for each mesh: its vertices in this frame's pose; all zero: it has none, or none that
    /// differs from the mesh.
    lobe_resource *deformed;
    /// One for each instance, in this frame. NULL: none is displaced.
    const displaced_geometry *displaced;
    float displaced_reach;     ///< how far displaced surfaces can be from their meshes, metres
    float displaced_spacing;   ///< of displaced vertices, pixels
    lobe_texture *environment; ///< its image; NULL: none
    device_material *materials;
    lobe_buffer **vertices;           ///< one for each mesh; NULL: not used, or given by the host
    lobe_buffer **indices;            ///< one for each mesh; NULL: not used
    device_deformation *deformations; ///< one for each mesh
    mesh_measures *measures;          ///< one for each mesh
    device_instance *instances;
    size_t instance_count; ///< when they were last uploaded
    size_t instance_room;  ///< how many the array holds
    /// What was concluded from texels stays when these change, as long as it holds for them too.
    bool keeps_conclusions;
    bool torn; ///< an update failed half-way: the copy can only be destroyed
} device_scene;

#endif
