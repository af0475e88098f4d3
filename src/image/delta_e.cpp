#include "image/delta_e.h"

#include <algorithm>
#include <cmath>

#include "materials/scalar.h"

namespace drude {

namespace {

// Degrees in [0, 360); 0 for grey.
double hue_deg(double a, double b) {
    if (a == 0 && b == 0) return 0;
    const double h = std::atan2(b, a) / degree;
    return h < 0 ? h + 360 : h;
}

double cos_deg(double angle) {
    return std::cos(angle * degree);
}

// C^7 / (C^7 + 25^7), which turns the chroma of near greys and the hue of blues.
double seventh_power_share(double chroma) {
    const double c7 = std::pow(chroma, 7);
    return c7 / (c7 + std::pow(25.0, 7));
}

}  // namespace

Lab cielab(const XYZ& over_white) {
    const auto f = [](double t) {
        constexpr double edge = 6.0 / 29.0;
        return t > edge * edge * edge ? std::cbrt(t) : t / (3 * edge * edge) + 4.0 / 29.0;
    };
    const double x = f(over_white[0]), y = f(over_white[1]), z = f(over_white[2]);
    return {116 * y - 16, 500 * (x - y), 200 * (y - z)};
}

Lab cielab_of_rgb(const RGB& rgb, double white) {
    const XYZ of_white = rgb_to_xyz({1, 1, 1});
    XYZ xyz = rgb_to_xyz(rgb);
    for (size_t c = 0; c < 3; ++c) xyz[c] /= of_white[c] * white;
    return cielab(xyz);
}

double delta_e_1976(const Lab& x, const Lab& y) {
    return std::hypot(x.L - y.L, x.a - y.a, x.b - y.b);
}

double delta_e_2000(const Lab& x, const Lab& y) {
    const double mean_chroma = (std::hypot(x.a, x.b) + std::hypot(y.a, y.b)) / 2;
    const double stretch = 1 + (1 - std::sqrt(seventh_power_share(mean_chroma))) / 2;
    const double a1 = stretch * x.a, a2 = stretch * y.a;
    const double c1 = std::hypot(a1, x.b), c2 = std::hypot(a2, y.b);
    const double h1 = hue_deg(a1, x.b), h2 = hue_deg(a2, y.b);
    const bool grey = c1 * c2 == 0;
    double turn = grey ? 0 : h2 - h1;
    if (turn > 180) turn -= 360;
    if (turn < -180) turn += 360;
    const double dL = y.L - x.L, dC = c2 - c1;
    const double dH = 2 * std::sqrt(c1 * c2) * std::sin(turn / 2 * degree);

    const double L = (x.L + y.L) / 2, C = (c1 + c2) / 2;
    double h = h1 + h2;
    if (!grey) {
        // The middle of the shorter arc.
        if (std::abs(h1 - h2) > 180) h += h < 360 ? 360 : -360;
        h /= 2;
    }
    const double T = 1 - 0.17 * cos_deg(h - 30) + 0.24 * cos_deg(2 * h) +
                     0.32 * cos_deg(3 * h + 6) - 0.20 * cos_deg(4 * h - 63);
    const double lightness = (L - 50) * (L - 50);
    const double S_L = 1 + 0.015 * lightness / std::sqrt(20 + lightness);
    const double S_C = 1 + 0.045 * C, S_H = 1 + 0.015 * C * T;
    const double blue = (h - 275) / 25;
    const double R_T =
        -2 * std::sqrt(seventh_power_share(C)) * std::sin(2 * 30 * std::exp(-blue * blue) * degree);
    const double l = dL / S_L, c = dC / S_C, s = dH / S_H;
    // The last term may leave the sum a rounding error below 0 for equal colours.
    return std::sqrt(std::max(0.0, l * l + c * c + s * s + R_T * c * s));
}

}  // namespace drude
