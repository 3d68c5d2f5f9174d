#include "passes/context/view_volume.h"

#include <math.h>
#include <string.h>

#include "passes/context/camera.h"

enum {
    PLANES = 5,
    MOST_CORNERS = 4 + PLANES, ///< each plane adds at most one to a convex polygon
};

static float distance_to(const vec4 plane, const vec3 point) {
    return plane[0] * point[0] + plane[1] * point[1] + plane[2] * point[2] + plane[3];
}

/// Through the eye and two corners of the picture; `inside` is on its positive side.
static void make_side(const vec3 eye, vec3 a, vec3 b, vec3 inside, vec4 plane) {
    glm_vec3_cross(a, b, plane);
    if (glm_vec3_dot(plane, inside) < 0)
        glm_vec3_negate(plane);
    plane[3] = -(plane[0] * eye[0] + plane[1] * eye[1] + plane[2] * eye[2]);
}

void passes_view_volume_make(const lobe_camera *camera, uint32_t width, uint32_t height,
                             view_volume *volume) {
    static const float middle[2] = {0.5f, 0.5f};
    static const float signs[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
    vec3 centre, right, down, directions[4];
    passes_camera_axis(camera, volume->axis);
    volume->near_plane = camera->near_plane;
    passes_camera_directions(camera, width, height, middle, centre, right, down);
    for (int i = 0; i < 4; i++) {
        for (int k = 0; k < 3; k++) {
            directions[i][k] = centre[k] + signs[i][0] * (1 + 4.0f / (float)width) * right[k] +
                               signs[i][1] * (1 + 4.0f / (float)height) * down[k];
            // Directions of pixels have the length 1 along the axis.
            volume->corners[i][k] = camera->eye[k] + camera->near_plane * directions[i][k];
        }
    }
    for (int i = 0; i < 4; i++)
        make_side(camera->eye, directions[i], directions[(i + 1) % 4], centre, volume->planes[i]);
    memcpy(volume->planes[4], volume->axis, sizeof volume->axis);
    volume->planes[4][3] = -volume->axis[3] - camera->near_plane;
}

static void to_world(const float transform[16], const vec3 point, vec3 world) {
    for (int row = 0; row < 3; row++)
        world[row] = transform[row] * point[0] + transform[4 + row] * point[1] +
                     transform[8 + row] * point[2] + transform[12 + row];
}

typedef struct world_box {
    vec3 corners[8]; ///< bits of the index: maximum in x, y, z
} world_box;

static void make_box(const float transform[16], const float minimum[3], const float maximum[3],
                     world_box *box) {
    for (int i = 0; i < 8; i++) {
        const vec3 corner = {(i & 1 ? maximum : minimum)[0], (i & 2 ? maximum : minimum)[1],
                             (i & 4 ? maximum : minimum)[2]};
        to_world(transform, corner, box->corners[i]);
    }
}

static bool is_outside(const vec4 plane, const world_box *box) {
    for (int i = 0; i < 8; i++)
        if (distance_to(plane, box->corners[i]) >= 0)
            return false;
    return true;
}

/// Whether a corner of the picture on the near plane is in the box. A flat box contains none.
static bool holds_near_corner(const view_volume *volume, const float transform[16],
                              const float minimum[3], const float maximum[3]) {
    mat4 matrix, inverse;
    memcpy(matrix, transform, sizeof matrix);
    const float scale =
        fmaxf(glm_vec3_norm(matrix[0]), fmaxf(glm_vec3_norm(matrix[1]), glm_vec3_norm(matrix[2])));
    // So that the determinant of any scale is a number.
    glm_mat4_scale(matrix, 1 / scale);
    matrix[3][3] = 1;
    glm_mat4_inv(matrix, inverse);
    for (int i = 0; i < 4; i++) {
        vec3 point, own;
        glm_vec3_scale((float *)volume->corners[i], 1 / scale, point);
        glm_mat4_mulv3(inverse, point, 1, own);
        bool inside = true;
        for (int k = 0; k < 3; k++)
            inside = inside && own[k] >= minimum[k] && own[k] <= maximum[k];
        if (inside)
            return true;
    }
    return false;
}

/// Sutherland, Hodgman 1974, Reentrant Polygon Clipping: what is on the positive side of a plane.
static int clip(const vec4 plane, vec3 *polygon, int count) {
    vec3 kept[MOST_CORNERS];
    int size = 0;
    for (int i = 0; i < count; i++) {
        const float *from = polygon[i], *to = polygon[(i + 1) % count];
        const float a = distance_to(plane, from), b = distance_to(plane, to);
        if (a >= 0)
            memcpy(kept[size++], from, sizeof *kept);
        if ((a >= 0) != (b >= 0) && size < MOST_CORNERS)
            glm_vec3_lerp((float *)from, (float *)to, a / (a - b), kept[size++]);
    }
    memcpy(polygon, kept, (size_t)size * sizeof *kept);
    return size;
}

static float nearest_of_face(const view_volume *volume, const world_box *box, const int face[4]) {
    vec3 polygon[MOST_CORNERS];
    int count = 4;
    for (int i = 0; i < 4; i++)
        memcpy(polygon[i], box->corners[face[i]], sizeof *polygon);
    for (int plane = 0; plane < PLANES && count > 0; plane++)
        count = clip(volume->planes[plane], polygon, count);
    float nearest = INFINITY;
    for (int i = 0; i < count; i++)
        nearest = fminf(nearest, glm_vec3_dot((float *)volume->axis, polygon[i]));
    return nearest - volume->axis[3];
}

// What is seen of a box is convex, so that its nearest point is a corner: either on a face of the
// box, or a corner of the picture.
float passes_view_volume_nearest(const view_volume *volume, const float transform[16],
                                 const float minimum[3], const float maximum[3]) {
    static const int faces[6][4] = {{0, 1, 3, 2}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                    {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 3, 7, 5}};
    world_box box;
    make_box(transform, minimum, maximum, &box);
    for (int i = 0; i < PLANES; i++)
        if (is_outside(volume->planes[i], &box))
            return INFINITY;
    if (holds_near_corner(volume, transform, minimum, maximum))
        return volume->near_plane;
    float nearest = INFINITY;
    for (int i = 0; i < 6; i++)
        nearest = fminf(nearest, nearest_of_face(volume, &box, faces[i]));
    return fmaxf(nearest, volume->near_plane);
}
