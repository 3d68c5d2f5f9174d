#include "scenes/environment/direction.h"

#include <math.h>
#include <stddef.h>

// Place, forward, right, down of +X -X +Y -Y +Z -Z.
static const environment_face column_faces[ENVIRONMENT_FACE_COUNT] = {
    {0, 0, {1, 0, 0}, {0, 0, 1}, {0, -1, 0}},  {0, 1, {-1, 0, 0}, {0, 0, -1}, {0, -1, 0}},
    {0, 2, {0, 1, 0}, {1, 0, 0}, {0, 0, -1}},  {0, 3, {0, -1, 0}, {1, 0, 0}, {0, 0, 1}},
    {0, 4, {0, 0, 1}, {-1, 0, 0}, {0, -1, 0}}, {0, 5, {0, 0, -1}, {1, 0, 0}, {0, -1, 0}},
};

static const environment_face row_faces[ENVIRONMENT_FACE_COUNT] = {
    {0, 0, {1, 0, 0}, {0, 0, 1}, {0, -1, 0}},  {1, 0, {-1, 0, 0}, {0, 0, -1}, {0, -1, 0}},
    {2, 0, {0, 1, 0}, {1, 0, 0}, {0, 0, -1}},  {3, 0, {0, -1, 0}, {1, 0, 0}, {0, 0, 1}},
    {4, 0, {0, 0, 1}, {-1, 0, 0}, {0, -1, 0}}, {5, 0, {0, 0, -1}, {1, 0, 0}, {0, -1, 0}},
};

static const environment_face vertical_cross_faces[ENVIRONMENT_FACE_COUNT] = {
    {0, 1, {1, 0, 0}, {0, 0, 1}, {0, -1, 0}},  {2, 1, {-1, 0, 0}, {0, 0, -1}, {0, -1, 0}},
    {1, 0, {0, 1, 0}, {-1, 0, 0}, {0, 0, 1}},  {1, 2, {0, -1, 0}, {-1, 0, 0}, {0, 0, -1}},
    {1, 1, {0, 0, 1}, {-1, 0, 0}, {0, -1, 0}}, {1, 3, {0, 0, -1}, {-1, 0, 0}, {0, 1, 0}},
};

static const environment_face horizontal_cross_faces[ENVIRONMENT_FACE_COUNT] = {
    {0, 1, {1, 0, 0}, {0, 0, 1}, {0, -1, 0}},  {2, 1, {-1, 0, 0}, {0, 0, -1}, {0, -1, 0}},
    {1, 0, {0, 1, 0}, {-1, 0, 0}, {0, 0, 1}},  {1, 2, {0, -1, 0}, {-1, 0, 0}, {0, 0, -1}},
    {1, 1, {0, 0, 1}, {-1, 0, 0}, {0, -1, 0}}, {3, 1, {0, 0, -1}, {1, 0, 0}, {0, -1, 0}},
};

const environment_face *scenes_environment_faces(lobe_environment_layout layout) {
    switch (layout) {
    case LOBE_ENVIRONMENT_CUBE_COLUMN:
        return column_faces;
    case LOBE_ENVIRONMENT_CUBE_ROW:
        return row_faces;
    case LOBE_ENVIRONMENT_VERTICAL_CROSS:
        return vertical_cross_faces;
    case LOBE_ENVIRONMENT_HORIZONTAL_CROSS:
        return horizontal_cross_faces;
    case LOBE_ENVIRONMENT_LATITUDE_LONGITUDE:
        break;
    }
    return NULL;
}

void scenes_environment_grid(lobe_environment_layout layout, uint32_t grid[2]) {
    const environment_face *faces = scenes_environment_faces(layout);
    grid[0] = grid[1] = 1;
    for (int i = 0; faces && i < ENVIRONMENT_FACE_COUNT; i++) {
        grid[0] = faces[i].column + 1 > grid[0] ? faces[i].column + 1 : grid[0];
        grid[1] = faces[i].row + 1 > grid[1] ? faces[i].row + 1 : grid[1];
    }
}

bool scenes_environment_layout_fits(lobe_environment_layout layout, uint32_t width,
                                    uint32_t height) {
    if (layout == LOBE_ENVIRONMENT_LATITUDE_LONGITUDE)
        return width > 0 && height > 0;
    uint32_t grid[2];
    scenes_environment_grid(layout, grid);
    return width > 0 && width % grid[0] == 0 && (uint64_t)width / grid[0] * grid[1] == height;
}

// ---------------------------------------------------------------------------------------------
// From directions to positions

static double dot(const double a[3], const double b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static const environment_face *face_of_direction(const environment_face *faces,
                                                 const double direction[3]) {
    int axis = 0;
    for (int i = 1; i < 3; i++) {
        if (fabs(direction[i]) > fabs(direction[axis]))
            axis = i;
    }
    return &faces[2 * axis + (direction[axis] < 0)];
}

void scenes_environment_position(lobe_environment_layout layout, uint32_t width, uint32_t height,
                                 const double direction[3], double position[2]) {
    const environment_face *faces = scenes_environment_faces(layout);
    if (!faces) {
        double latitude = atan2(direction[1], hypot(direction[0], direction[2]));
        position[0] = (0.5 - atan2(direction[0], direction[2]) / (2 * M_PI)) * width;
        position[1] = (0.5 - latitude / M_PI) * height;
        return;
    }
    uint32_t grid[2];
    scenes_environment_grid(layout, grid);
    const environment_face *face = face_of_direction(faces, direction);
    const double size = (double)width / grid[0], depth = dot(direction, face->forward);
    position[0] = size * (face->column + 0.5 + 0.5 * dot(direction, face->right) / depth);
    position[1] = size * (face->row + 0.5 + 0.5 * dot(direction, face->down) / depth);
}

// ---------------------------------------------------------------------------------------------
// From positions to directions

// The face at a position, and the point on it in [-1, 1]; NULL outside of the faces.
static const environment_face *face_of_position(lobe_environment_layout layout, uint32_t width,
                                                const double position[2], double point[2]) {
    uint32_t grid[2], place[2];
    scenes_environment_grid(layout, grid);
    const double size = (double)width / grid[0];
    for (int i = 0; i < 2; i++) {
        if (!(position[i] >= 0 && position[i] <= size * grid[i]))
            return NULL;
        const double face = fmin(floor(position[i] / size), grid[i] - 1.0);
        place[i] = (uint32_t)face;
        point[i] = 2 * (position[i] / size - face) - 1;
    }
    const environment_face *faces = scenes_environment_faces(layout);
    for (int i = 0; i < ENVIRONMENT_FACE_COUNT; i++) {
        if (faces[i].column == place[0] && faces[i].row == place[1])
            return &faces[i];
    }
    return NULL;
}

bool scenes_environment_direction(lobe_environment_layout layout, uint32_t width, uint32_t height,
                                  const double position[2], double direction[3]) {
    if (layout == LOBE_ENVIRONMENT_LATITUDE_LONGITUDE) {
        const double longitude = (0.5 - position[0] / width) * 2 * M_PI;
        const double latitude = (0.5 - position[1] / height) * M_PI;
        direction[0] = sin(longitude) * cos(latitude);
        direction[1] = sin(latitude);
        direction[2] = cos(longitude) * cos(latitude);
        return position[0] >= 0 && position[0] <= width && position[1] >= 0 &&
               position[1] <= height;
    }
    double point[2];
    const environment_face *face = face_of_position(layout, width, position, point);
    if (!face)
        return false;
    const double length = sqrt(1 + point[0] * point[0] + point[1] * point[1]);
    for (int i = 0; i < 3; i++)
        direction[i] =
            (face->forward[i] + point[0] * face->right[i] + point[1] * face->down[i]) / length;
    return true;
}

// ---------------------------------------------------------------------------------------------
// Solid angles

// Of the rectangle from the middle of a face at distance 1 to (s, t), signed. Van Oosterom and
// Strackee 1983, "The solid angle of a plane triangle", applied to a rectangle.
static double from_middle(double s, double t) {
    return atan2(s * t, sqrt(1 + s * s + t * t));
}

double scenes_environment_solid_angle(lobe_environment_layout layout, uint32_t width,
                                      uint32_t height, double left, double top, double right,
                                      double bottom) {
    if (layout == LOBE_ENVIRONMENT_LATITUDE_LONGITUDE) {
        // cos(a) - cos(b) of the polar angles as a product, which does not cancel digits.
        const double middle = 0.5 * M_PI * (top + bottom) / height;
        const double half = 0.5 * M_PI * (bottom - top) / height;
        return 2 * M_PI * (right - left) / width * 2 * sin(middle) * sin(half);
    }
    const double middle[2] = {0.5 * (left + right), 0.5 * (top + bottom)};
    double point[2];
    if (!face_of_position(layout, width, middle, point))
        return 0;
    uint32_t grid[2];
    scenes_environment_grid(layout, grid);
    const double size = (double)width / grid[0];
    const double s[2] = {point[0] - (right - left) / size, point[0] + (right - left) / size};
    const double t[2] = {point[1] - (bottom - top) / size, point[1] + (bottom - top) / size};
    return from_middle(s[1], t[1]) - from_middle(s[0], t[1]) - from_middle(s[1], t[0]) +
           from_middle(s[0], t[0]);
}
