// copper_table ALPHA > copper.pbrdf: the table of rough copper, Trowbridge-Reitz facets of pbrt's
// alpha with height-correlated Smith masking, as Material "conductor" "float roughness" has it.
#include <materials/fresnel.h>
#include <materials/mueller.h>
#include <materials/optical_constants.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <vector>

namespace {

constexpr double degree = 3.14159265358979323846 / 180;

std::vector<double> steps(double first, double last, double step) {
    std::vector<double> values;
    for (int i = 0; first + i * step <= last + 1e-9; ++i) values.push_back(first + i * step);
    return values;
}

void print_axis(const char* name, const std::vector<double>& values) {
    std::printf("%s %zu", name, values.size());
    for (const double value : values) std::printf(" %g", value);
    std::printf("\n");
}

// Facets and masking over 4 cos_i cos_o. Half vectors and angles at which the light, or the eye,
// would be below the surface are drawn by nobody, but interpolated with: they continue as at the
// horizon.
double facets(double cos_h, double cos_i, double cos_o, double alpha) {
    cos_i = std::max(cos_i, 0.01);
    cos_o = std::max(cos_o, 0.01);
    const double a2 = alpha * alpha, q = cos_h * cos_h * (a2 - 1) + 1;
    const double d = a2 / (180 * degree * q * q);
    return 0.5 * d /
           (cos_i * std::sqrt(a2 + (1 - a2) * cos_o * cos_o) +
            cos_o * std::sqrt(a2 + (1 - a2) * cos_i * cos_i));
}

}  // namespace

int main(int argc, char** argv) {
    const double alpha = argc == 2 ? std::atof(argv[1]) : 0;
    if (!(alpha >= 0.01 && alpha <= 1)) {
        std::fprintf(stderr, "usage: copper_table ALPHA > TABLE, with ALPHA from 0.01 to 1\n");
        return 2;
    }
    const std::vector<double> nm = steps(380, 780, 20), theta_h = steps(0, 90, 2.5),
                              theta_d = steps(0, 90, 5), phi_d = steps(0, 180, 15);
    std::printf("# rough copper, alpha %g\npbrdf-table 1\n", alpha);
    print_axis("wavelengths_nm", nm);
    print_axis("theta_h_deg", theta_h);
    print_axis("theta_d_deg", theta_d);
    print_axis("phi_d_deg", phi_d);
    std::printf("values\n");
    const drude::OpticalConstants& copper = drude::published_set("Cu");
    for (const double th : theta_h) {
        for (const double td : theta_d) {
            for (const double pd : phi_d) {
                // Along h, and across it in the plane of the normal: the cosine of the light's
                // angle to the normal is its part of both.
                const double along = std::cos(th * degree) * std::cos(td * degree);
                const double across =
                    std::sin(th * degree) * std::sin(td * degree) * std::cos(pd * degree);
                const double value =
                    facets(std::cos(th * degree), along - across, along + across, alpha);
                for (const double wavelength : nm) {
                    const drude::Index index = copper.at(wavelength);
                    const auto m = drude::mueller(drude::reflect(
                        drude::ComplexIndex<double>{index.n, index.k}, std::cos(td * degree)));
                    for (const auto& row : m.m) {
                        for (const double element : row) std::printf("%.6g ", value * element);
                    }
                    std::printf("\n");
                }
            }
        }
    }
    return std::fflush(stdout) == 0 && !std::ferror(stdout) ? 0 : 3;
}
