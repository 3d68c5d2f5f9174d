// What both shaders of own_shading read: lobe_camera, the scales of a perspective, and lobe_light
// as lobe has them. Cameras without perspective, spot lights and ranges are left out.

struct own_camera {
    float eye[3], target[3], up[3];
    float vertical_field_of_view, orthographic_height, near_plane;
    float shift[2], jitter[2];
};

struct own_light {
    uint type;
    float position[3], direction[3], intensity[3];
    float range, inner_cone, outer_cone;
};

const uint POINT = 1u;

layout(set = 0, binding = 0, std430) readonly buffer own_block {
    own_camera camera;
    float scales[2]; // of slopes from the view's axis, to the right and up, to clip space
    own_light lights[];
};

vec3 vector(float values[3]) {
    return vec3(values[0], values[1], values[2]);
}
