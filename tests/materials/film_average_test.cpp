// Averages over uneven films and slits against sums by another rule, and the table of them against
// the averages.
#include "materials/film_average.h"

#include <gtest/gtest.h>

#include "base/error.h"
#include "materials/film_table.h"
#include "materials/mueller.h"
#include "materials/numeric.h"
#include "materials/surface.h"

namespace drude {
namespace {

OpticalConstants flat(const char* name, double n, double k) {
    OpticalConstants constants;
    constants.name = name;
    constants.wavelength_nm = {300, 900};
    constants.n = {n, n};
    constants.k = {k, k};
    return constants;
}

// Aluminium under one film; `absorption` makes the film a grey one.
Material coated(double thickness_nm, double spread_nm = 0, double absorption = 0) {
    Material material;
    material.name = "coated aluminium";
    material.substrate = published_set("Al-Rakic");
    const OpticalConstants oxide = published_set("Al2O3-Malitson-o");
    material.layers = {
        {absorption > 0 ? flat("grey", 1.6, absorption) : oxide, thickness_nm, spread_nm}};
    return material;
}

TEST(FilmAverage, NodesAverageFringesExactly) {
    // The mean of cos(phase x) over a standard normal is exp(-phase^2/2).
    for (const double phase : {0.5, 2.0, 6.0}) {
        const AverageNodes nodes = gaussian_nodes(phase);
        for (const double turn : {phase, 2 * phase}) {
            double mean = 0;
            for (size_t i = 0; i < nodes.x.size(); ++i) {
                mean += nodes.weight[i] * std::cos(turn * nodes.x[i]);
            }
            EXPECT_NEAR(mean, std::exp(-turn * turn / 2), 2e-5) << phase << ", " << turn;
        }
    }
    // Over [-1, 1] it is sin(phase)/phase.
    for (const double phase : {0.01, 0.3, 1.0, 3.0, 7.0, 18.0}) {
        const AverageNodes nodes = uniform_nodes(phase);
        double total = 0;
        for (const double weight : nodes.weight) total += weight;
        EXPECT_NEAR(total, 1, 1e-13);
        for (const double turn : {phase, 2 * phase}) {
            double mean = 0;
            for (size_t i = 0; i < nodes.x.size(); ++i) {
                mean += nodes.weight[i] * std::cos(turn * nodes.x[i]);
            }
            EXPECT_NEAR(mean, std::sin(turn) / turn, 1e-4) << phase << ", " << turn;
        }
    }
}

// The mean by the midpoint rule over the wavelengths of the nanometre and 401 thicknesses.
Reflection<double> by_midpoints(const Material& material, double nm, double cosine) {
    Reflection<double> sum{0, 0, 0, 0};
    double total = 0;
    const FilmLayer& layer = material.layers[0];
    for (int j = -200; j <= 200; ++j) {
        const double x = j / 200.0 * 5;
        if (layer.thickness_spread_nm == 0 && j != 0) continue;
        const int steps = layer.thickness_spread_nm > 0 ? 20 : 400;
        for (int i = 0; i < steps; ++i) {
            const double at = nm + (i + 0.5) / steps - 0.5;
            const Index film = layer.constants.at(at), metal = material.substrate.at(at);
            const ThinFilm<double> stack{{film.n, film.k},
                                         layer.thickness_nm + x * layer.thickness_spread_nm};
            const double weight = std::exp(-x * x / 2);
            add_weighted(reflect(&stack, 1, ComplexIndex<double>{metal.n, metal.k}, cosine, at),
                         weight, &sum);
            total += weight;
        }
    }
    return {sum.Rs / total, sum.Rp / total, sum.C / total, sum.S / total};
}

double difference(const Reflection<double>& a, const Reflection<double>& b) {
    return std::max(
        {std::abs(a.Rs - b.Rs), std::abs(a.Rp - b.Rp), std::abs(a.C - b.C), std::abs(a.S - b.S)});
}

TEST(FilmAverage, NanometreAndSpreadAgainstTheMidpointRule) {
    numeric::Uniform u(1);
    for (const Material& material : {coated(100), coated(3000), coated(100000), coated(3000, 30),
                                     coated(3000, 300), coated(2000, 0, 0.1)}) {
        for (int trial = 0; trial < 8; ++trial) {
            const double nm = 380 + std::floor(400 * u.next()), cosine = u.between(0.1, 1);
            EXPECT_LT(
                difference(reflect(material, nm, cosine, 1.0), by_midpoints(material, nm, cosine)),
                2e-4)
                << material.layers[0].thickness_nm << " nm +- "
                << material.layers[0].thickness_spread_nm << " at " << nm << " nm, " << cosine;
        }
    }
}

// A film without fringes is the incoherent sum of what its surfaces reflect: here in s, with the
// interface's and the substrate's own reflectances.
TEST(FilmAverage, VeryThickFilmsAreIncoherent) {
    const Material plate = coated(2e6);
    const double cosine = 0.8, nm = 500;
    const Index film = plate.layers[0].constants.at(nm), metal = plate.substrate.at(nm);
    const double R1 = reflect(ComplexIndex<double>{film.n, 0}, cosine).Rs;
    const double inside = std::sqrt(1 - (1 - cosine * cosine) / (film.n * film.n));
    const double R2 = reflect(ComplexIndex<double>{metal.n / film.n, metal.k / film.n}, inside).Rs;
    const double expected = R1 + (1 - R1) * (1 - R1) * R2 / (1 - R1 * R2);
    EXPECT_NEAR(reflect(plate, nm, cosine, 1.0).Rs, expected, 1e-3);
    // Of one wavelength it is as coherent as any.
    EXPECT_GT(std::abs(reflect(plate, nm, cosine).Rs - reflect(plate, nm + 0.001, cosine).Rs) +
                  std::abs(reflect(plate, nm, cosine).Rs - reflect(plate, nm + 0.02, cosine).Rs),
              1e-3);
}

TEST(FilmAverage, AtMostTwoUnevenFilms) {
    Material material = coated(1000, 50);
    material.layers.push_back(material.layers[0]);
    EXPECT_NO_THROW(reflect(material, 500, 0.5));
    material.layers.push_back(material.layers[0]);
    EXPECT_THROW(reflect(material, 500, 0.5), Error);
}

// The table of a material against the averaged closed form in double, at random wavelengths and
// angles; `tolerance` beside that of interpolation is for rounding in float.
void check_table(const Material& material, double tolerance, uint64_t seed) {
    const FilmTable table(material, 8);
    ASSERT_FALSE(table.empty());
    numeric::Uniform u(seed);
    double worst = 0;
    for (int trial = 0; trial < 300; ++trial) {
        const int phase = static_cast<int>(u.next() * 50);
        // Grazing angles too.
        const auto cosine = static_cast<float>(trial % 4 ? u.next() : std::pow(10, -3 * u.next()));
        if (cosine < 1e-4f) continue;
        const auto got = table.at<8>(cosine, phase);
        for (int lane = 0; lane < 8; ++lane) {
            const Reflection<double> r{got.Rs[lane], got.Rp[lane], got.C[lane], got.S[lane]};
            worst = std::max(worst, difference(r, reflect(material, 380 + phase + 50 * lane,
                                                          static_cast<double>(cosine), 1.0)));
            EXPECT_GE(smallest_coherency_eigenvalue(mueller(r)), -1e-6);
            EXPECT_LE(std::max(r.Rs, r.Rp), 1);
        }
    }
    EXPECT_LT(worst, film_table_tolerance + tolerance) << material.layers[0].thickness_nm;
}

TEST(FilmTable, ThinFilm) {
    check_table(coated(100), 2e-6, 11);
}
TEST(FilmTable, FilmOfSomeMicrometres) {
    check_table(coated(3000), 1e-4, 12);
}
TEST(FilmTable, ThickFilm) {
    check_table(coated(100000), 1e-3, 13);
}
TEST(FilmTable, UnevenFilm) {
    check_table(coated(3000, 150), 1e-4, 14);
}
TEST(FilmTable, AbsorbingFilm) {
    check_table(coated(2000, 0, 0.1), 1e-4, 15);
}

TEST(FilmTable, PacketsOfAnyWidthReadTheSameTable) {
    const Material material = coated(800, 10);
    const FilmTable narrow(material, 8), wide(material, 40);
    for (int nm = 0; nm < spectrum_integral_size; nm += 7) {
        const auto a = narrow.at<8>(0.37f, nm % 50);
        const auto b = wide.at<40>(0.37f, nm % 10);
        EXPECT_EQ(a.Rs[nm / 50], b.Rs[nm / 10]);
        EXPECT_EQ(a.S[nm / 50], b.S[nm / 10]);
    }
}

}  // namespace
}  // namespace drude
