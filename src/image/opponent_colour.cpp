#include "image/opponent_colour.h"

#include <cmath>

namespace drude {

namespace {

// Linear Rec.709 to XYZ, the exact fractions of the primaries and of D65 as sRGB has them.
constexpr double to_xyz[3][3] = {
    {10135552.0 / 24577794.0, 8788810.0 / 24577794.0, 4435075.0 / 24577794.0},
    {2613072.0 / 12288897.0, 8788810.0 / 12288897.0, 887015.0 / 12288897.0},
    {1425312.0 / 73733382.0, 8788810.0 / 73733382.0, 70074185.0 / 73733382.0}};

const Triple& white() {
    static const Triple xyz = xyz_of({1.0, 1.0, 1.0});
    return xyz;
}

// The inverse, by Cramer's rule.
Triple rgb_of(const Triple& xyz) {
    static const std::array<Triple, 3> inverse = [] {
        const auto& m = to_xyz;
        std::array<Triple, 3> result{};
        double determinant = 0.0;
        const auto minor = [&](size_t i, size_t j) {
            const size_t a = (i + 1) % 3, b = (i + 2) % 3, c = (j + 1) % 3, d = (j + 2) % 3;
            return m[a][c] * m[b][d] - m[a][d] * m[b][c];
        };
        for (size_t j = 0; j < 3; ++j) determinant += m[0][j] * minor(0, j);
        for (size_t i = 0; i < 3; ++i) {
            for (size_t j = 0; j < 3; ++j) result[j][i] = minor(i, j) / determinant;
        }
        return result;
    }();
    Triple rgb{};
    for (size_t i = 0; i < 3; ++i) {
        for (size_t c = 0; c < 3; ++c) rgb[i] += inverse[i][c] * xyz[c];
    }
    return rgb;
}

}  // namespace

Triple xyz_of(const Triple& rgb) {
    Triple xyz{};
    for (size_t i = 0; i < 3; ++i) {
        for (size_t c = 0; c < 3; ++c) xyz[i] += to_xyz[i][c] * rgb[c];
    }
    return xyz;
}

Triple opponent_of(const Triple& rgb) {
    const Triple xyz = xyz_of(rgb);
    const double x = xyz[0] / white()[0], y = xyz[1] / white()[1], z = xyz[2] / white()[2];
    return {116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)};
}

Triple rgb_of_opponent(const Triple& opponent) {
    const double y = (opponent[0] + 16.0) / 116.0;
    return rgb_of({(y + opponent[1] / 500.0) * white()[0], y * white()[1],
                   (y - opponent[2] / 200.0) * white()[2]});
}

Triple hunt_lab_of(const Triple& rgb) {
    const Triple xyz = xyz_of(rgb);
    const auto f = [](double t) {
        constexpr double delta = 6.0 / 29.0;
        return t > delta * delta * delta ? std::cbrt(t) : t / (3.0 * delta * delta) + 4.0 / 29.0;
    };
    const double x = f(xyz[0] / white()[0]), y = f(xyz[1] / white()[1]), z = f(xyz[2] / white()[2]);
    const double l = 116.0 * y - 16.0;
    return {l, 0.01 * l * 500.0 * (x - y), 0.01 * l * 200.0 * (y - z)};
}

double hyab(const Triple& a, const Triple& b) {
    return std::abs(a[0] - b[0]) + std::hypot(a[1] - b[1], a[2] - b[2]);
}

}  // namespace drude
