#include "rotation.h"

#include <math.h>
#include <string.h>

#define TOLERANCE 0.02

static bool refuse(double turn[4])
{
    static const double none[4] = {0, 0, 0, 1};

    memcpy(turn, none, sizeof none);
    return false;
}

bool rotation_of_quaternion(const double quaternion[4], double turn[4])
{
    double square = 0;

    for (int i = 0; i < 4; i++)
        square += quaternion[i] * quaternion[i];

    /* What is a unit but for its last digits stays as it was told. */
    double length = fabs(square - 1) < 1e-6 ? 1 : sqrt(square);
    if (!(fabs(length - 1) <= TOLERANCE))
        return refuse(turn);
    for (int i = 0; i < 4; i++)
        turn[i] = quaternion[i] / length;
    return true;
}

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* Unit axes, square to one another, right-handed. */
static bool is_rotation(const double x[3], const double y[3], const double z[3])
{
    double across[3] = {x[1] * y[2] - x[2] * y[1], x[2] * y[0] - x[0] * y[2],
                        x[0] * y[1] - x[1] * y[0]};

    return fabs(dot(x, x) - 1) <= 2 * TOLERANCE && fabs(dot(y, y) - 1) <= 2 * TOLERANCE &&
           fabs(dot(z, z) - 1) <= 2 * TOLERANCE && fabs(dot(x, y)) <= TOLERANCE &&
           dot(across, z) > 0 && fabs(dot(x, z)) <= TOLERANCE && fabs(dot(y, z)) <= TOLERANCE;
}

bool rotation_of_columns(const double columns[9], double turn[4])
{
    const double *x = columns, *y = columns + 3, *z = columns + 6;
    double q[4];

    if (!is_rotation(x, y, z))
        return refuse(turn);

    /* Four times the square of each of x, y, z, w; the largest is divided by. */
    double squares[4] = {1 + x[0] - y[1] - z[2], 1 - x[0] + y[1] - z[2], 1 - x[0] - y[1] + z[2],
                         1 + x[0] + y[1] + z[2]};
    int largest = 0;
    for (int i = 1; i < 4; i++)
        if (squares[i] > squares[largest])
            largest = i;

    double products[4][4] = {
        {squares[0], x[1] + y[0], x[2] + z[0], y[2] - z[1]},
        {x[1] + y[0], squares[1], y[2] + z[1], z[0] - x[2]},
        {x[2] + z[0], y[2] + z[1], squares[2], x[1] - y[0]},
        {y[2] - z[1], z[0] - x[2], x[1] - y[0], squares[3]},
    };
    double scale = 2 * sqrt(squares[largest]);
    for (int i = 0; i < 4; i++)
        q[i] = products[largest][i] / scale;
    return rotation_of_quaternion(q, turn);
}

bool rotation_of_angles(const double angles[3], double turn[4])
{
    double sx = sin(angles[0] / 2), cx = cos(angles[0] / 2);
    double sy = sin(angles[1] / 2), cy = cos(angles[1] / 2);
    double sz = sin(angles[2] / 2), cz = cos(angles[2] / 2);
    double q[4] = {sx * cy * cz + cx * sy * sz, cx * sy * cz - sx * cy * sz,
                   cx * cy * sz + sx * sy * cz, cx * cy * cz - sx * sy * sz};

    return rotation_of_quaternion(q, turn);
}
