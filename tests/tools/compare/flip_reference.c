#include "tests/tools/compare/flip_reference.h"

#include <math.h>
#include <stdlib.h>

typedef double vector[3];

/// A square of weights around a texel.
typedef struct square {
    int radius;
    double *weights;
} square;

static double weight_at(const square *square, int x, int y) {
    return square->weights[(y + square->radius) * (2 * square->radius + 1) + x + square->radius];
}

typedef double (*kernel_function)(double x, double y, const double *parameters);

static square make_square(int radius, kernel_function function, const double *parameters) {
    int side = 2 * radius + 1;
    square square = {radius, malloc(sizeof(double) * side * side)};
    for (int y = -radius; y <= radius; y++) {
        for (int x = -radius; x <= radius; x++)
            square.weights[(y + radius) * side + x + radius] = function(x, y, parameters);
    }
    return square;
}

/// Scales positive weights to the sum 1, negative ones to -1.
static void normalise(square *square) {
    int count = (2 * square->radius + 1) * (2 * square->radius + 1);
    double positive = 0, negative = 0;
    for (int index = 0; index < count; index++) {
        positive += fmax(square->weights[index], 0);
        negative -= fmin(square->weights[index], 0);
    }
    for (int index = 0; index < count; index++)
        square->weights[index] /= square->weights[index] > 0 ? positive : fmax(negative, 1e-300);
}

/// Parameters: pixels per degree, a1, b1, a2, b2 of the contrast sensitivity function.
static double sensitivity(double x, double y, const double *p) {
    double squared = (x * x + y * y) / (p[0] * p[0]), pi = acos(-1);
    return p[1] * sqrt(pi / p[2]) * exp(-pi * pi * squared / p[2]) +
           p[3] * sqrt(pi / p[4]) * exp(-pi * pi * squared / p[4]);
}

/// Parameter: standard deviation.
static double edge_x(double x, double y, const double *p) {
    return -x * exp(-(x * x + y * y) / (2 * p[0] * p[0]));
}
static double edge_y(double x, double y, const double *p) {
    return edge_x(y, x, p);
}
static double point_x(double x, double y, const double *p) {
    return (x * x / (p[0] * p[0]) - 1) * exp(-(x * x + y * y) / (2 * p[0] * p[0]));
}
static double point_y(double x, double y, const double *p) {
    return point_x(y, x, p);
}

static int clamp_index(int index, int count) {
    return index < 0 ? 0 : index >= count ? count - 1 : index;
}

static double convolve(const vector *image, int channel, int width, int height, int x, int y,
                       const square *square) {
    double sum = 0;
    for (int dy = -square->radius; dy <= square->radius; dy++) {
        for (int dx = -square->radius; dx <= square->radius; dx++) {
            int column = clamp_index(x + dx, width), row = clamp_index(y + dy, height);
            sum += weight_at(square, dx, dy) * image[row * width + column][channel];
        }
    }
    return sum;
}

static const double rgb_to_xyz[3][3] = {
    {0.4123907992659593, 0.3575843393838780, 0.1804807884018343},
    {0.2126390058715102, 0.7151686787677560, 0.0721923153607337},
    {0.0193308187155918, 0.1191947797946260, 0.9505321522496607}};
static const double xyz_to_rgb[3][3] = {
    {3.2409699419045226, -1.5373831775700939, -0.4986107602930034},
    {-0.9692436362808796, 1.8759675015077202, 0.0415550574071756},
    {0.0556300796969936, -0.2039769588889765, 1.0569715142428786}};
static const vector white = {0.9504559270516716, 1.0, 1.0890577507598784};

static void transform(const double matrix[3][3], const vector from, vector to) {
    for (int row = 0; row < 3; row++)
        to[row] = matrix[row][0] * from[0] + matrix[row][1] * from[1] + matrix[row][2] * from[2];
}

static void opponent_of(const vector rgb, vector opponent) {
    vector xyz;
    transform(rgb_to_xyz, rgb, xyz);
    double x = xyz[0] / white[0], y = xyz[1] / white[1], z = xyz[2] / white[2];
    opponent[0] = 116 * y - 16;
    opponent[1] = 500 * (x - y);
    opponent[2] = 200 * (y - z);
}

static void rgb_of(const vector opponent, vector rgb) {
    double y = (opponent[0] + 16) / 116;
    vector xyz = {(y + opponent[1] / 500) * white[0], y * white[1],
                  (y - opponent[2] / 200) * white[2]};
    transform(xyz_to_rgb, xyz, rgb);
}

static double lab_function(double value) {
    return value > 216.0 / 24389.0 ? cbrt(value) : (24389.0 / 27.0 * value + 16) / 116;
}

static void hunt_lab_of(const vector rgb, vector lab) {
    vector xyz;
    transform(rgb_to_xyz, rgb, xyz);
    double x = lab_function(xyz[0] / white[0]), y = lab_function(xyz[1] / white[1]),
           z = lab_function(xyz[2] / white[2]);
    lab[0] = 116 * y - 16;
    lab[1] = 0.01 * lab[0] * 500 * (x - y);
    lab[2] = 0.01 * lab[0] * 200 * (y - z);
}

static double hyab(const vector a, const vector b) {
    return fabs(a[0] - b[0]) + sqrt(pow(a[1] - b[1], 2) + pow(a[2] - b[2], 2));
}

/// Everything that depends on a texel's neighbourhood: colour as seen, edge and point strength.
typedef struct percept {
    vector lab;
    double edge, point;
} percept;

typedef struct squares {
    square csf[3], edge[2], point[2];
} squares;

static squares make_squares(double ppd) {
    const double csf[3][5] = {
        {ppd, 1, 0.0047, 0, 1e-5}, {ppd, 1, 0.0053, 0, 1e-5}, {ppd, 34.1, 0.04, 13.5, 0.025}};
    double pi = acos(-1), deviation = 0.5 * 0.082 * ppd;
    int csf_radius = (int)ceil(3 * sqrt(0.04 / (2 * pi * pi)) * ppd);
    int radius = (int)ceil(3 * deviation);
    squares squares;
    for (int channel = 0; channel < 3; channel++) {
        squares.csf[channel] = make_square(csf_radius, sensitivity, csf[channel]);
        normalise(&squares.csf[channel]);
    }
    squares.edge[0] = make_square(radius, edge_x, &deviation);
    squares.edge[1] = make_square(radius, edge_y, &deviation);
    squares.point[0] = make_square(radius, point_x, &deviation);
    squares.point[1] = make_square(radius, point_y, &deviation);
    for (int axis = 0; axis < 2; axis++) {
        normalise(&squares.edge[axis]);
        normalise(&squares.point[axis]);
    }
    return squares;
}

static void free_squares(squares *squares) {
    for (int channel = 0; channel < 3; channel++)
        free(squares->csf[channel].weights);
    for (int axis = 0; axis < 2; axis++) {
        free(squares->edge[axis].weights);
        free(squares->point[axis].weights);
    }
}

static double feature(const vector *opponents, int width, int height, int x, int y,
                      const square squares[2]) {
    return hypot(convolve(opponents, 0, width, height, x, y, &squares[0]) / 116,
                 convolve(opponents, 0, width, height, x, y, &squares[1]) / 116);
}

static percept perceive(const vector *opponents, int width, int height, int x, int y,
                        const squares *squares) {
    percept percept;
    vector filtered, rgb;
    for (int channel = 0; channel < 3; channel++)
        filtered[channel] =
            convolve(opponents, channel, width, height, x, y, &squares->csf[channel]);
    rgb_of(filtered, rgb);
    for (int channel = 0; channel < 3; channel++)
        rgb[channel] = fmin(fmax(rgb[channel], 0), 1);
    hunt_lab_of(rgb, percept.lab);
    percept.edge = feature(opponents, width, height, x, y, squares->edge);
    percept.point = feature(opponents, width, height, x, y, squares->point);
    return percept;
}

static double difference(const percept *a, const percept *b) {
    vector green, blue;
    hunt_lab_of((vector){0, 1, 0}, green);
    hunt_lab_of((vector){0, 0, 1}, blue);
    double largest = pow(hyab(green, blue), 0.7), distance = pow(hyab(a->lab, b->lab), 0.7);
    double knee = 0.4 * largest;
    double colour = distance < knee ? distance * 0.95 / knee
                                    : 0.95 + 0.05 * (distance - knee) / (largest - knee);
    double feature = sqrt(fmax(fabs(a->edge - b->edge), fabs(a->point - b->point)) / sqrt(2));
    return pow(colour, 1 - feature);
}

void flip_reference(const double *test, const double *reference, int width, int height,
                    double pixels_per_degree, double *errors) {
    squares squares = make_squares(pixels_per_degree);
    vector *opponents[2];
    for (int image = 0; image < 2; image++) {
        opponents[image] = malloc(sizeof(vector) * width * height);
        for (int index = 0; index < width * height; index++)
            opponent_of((image == 0 ? test : reference) + 3 * index, opponents[image][index]);
    }
    for (int y = 0; y < height; y++) {
        for (int x = 0; x < width; x++) {
            percept a = perceive(opponents[0], width, height, x, y, &squares);
            percept b = perceive(opponents[1], width, height, x, y, &squares);
            errors[y * width + x] = difference(&a, &b);
        }
    }
    free(opponents[0]);
    free(opponents[1]);
    free_squares(&squares);
}
