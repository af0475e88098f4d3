// Evaluates the Mueller matrix of copper with the installed headers and library.
#include <materials/fresnel.h>
#include <materials/mueller.h>
#include <materials/optical_constants.h>

#include <cmath>
#include <cstdio>

int main() {
    // n = 1.04, k = 2.59 at 60 degrees: A, B, C, S worked out by hand to 1e-8.
    const drude::ComplexIndex<double> copper{1.04, 2.59};
    const drude::Mueller<double> m = drude::mueller(drude::reflect(copper, 0.5));
    const double expected[4][4] = {{0.61901084, 0.17395952, 0, 0},
                                   {0.17395952, 0.61901084, 0, 0},
                                   {0, 0, -0.35616259, -0.47545842},
                                   {0, 0, 0.47545842, -0.35616259}};
    for (int i = 0; i < 4; ++i) {
        for (int j = 0; j < 4; ++j) {
            std::printf("%12.8f%c", m.m[i][j], j == 3 ? '\n' : ' ');
            if (!(std::abs(m.m[i][j] - expected[i][j]) < 1e-7)) {
                std::printf("expected %.8f\n", expected[i][j]);
                return 1;
            }
        }
    }
    // The tables come with the library.
    const drude::Index table = drude::published_set("Cu").at(550);
    const drude::Reflection<double> r =
        drude::reflect(drude::ComplexIndex<double>{table.n, table.k}, 0.5);
    std::printf("%s at 550 nm: n = %g, k = %g, Rs = %g, Rp = %g\n",
                drude::published_set("Cu").name.c_str(), table.n, table.k, r.Rs, r.Rp);
    return r.Rs > r.Rp && r.Rs < 1 && r.Rp > 0 ? 0 : 1;
}
