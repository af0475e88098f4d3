#include "device/virtual/ellipsometer_simulation.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/counter_random.h"
#include "base/error.h"
#include "materials/film_stack.h"

namespace drude {
namespace {

Material constant_material(double n, double k) {
    Material material;
    material.name = "constant";
    material.substrate.name = "constant";
    material.substrate.kind = "calculated";
    material.substrate.wavelength_nm = {300, 900};
    material.substrate.n = {n, n};
    material.substrate.k = {k, k};
    return material;
}

SimulationSetup small_setup() {
    SimulationSetup setup;
    setup.angles_deg = {60, 80};
    setup.wavelengths_nm = {500, 550};
    return setup;
}

// The known answers of the generator's authors (Random123, kat_vectors).
TEST(CounterRandom, PhiloxKnownAnswers) {
    EXPECT_EQ(philox({0, 0, 0, 0}, {0, 0}),
              (PhiloxBlock{0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8}));
    const uint32_t f = 0xffffffff;
    EXPECT_EQ(philox({f, f, f, f}, {f, f}),
              (PhiloxBlock{0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd}));
    EXPECT_EQ(philox({0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344}, {0xa4093822, 0x299f31d0}),
              (PhiloxBlock{0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1}));
}

TEST(CounterRandom, NormalDeviatesHaveTheirMomentsAndTails) {
    double sum = 0, squares = 0, cubes = 0, fourths = 0, product = 0;
    int beyond_2 = 0;
    const int pairs = 200000;
    for (int i = 0; i < pairs; ++i) {
        const auto x = normal_pair(42, static_cast<uint64_t>(i));
        for (const double value : x) {
            sum += value;
            squares += value * value;
            cubes += value * value * value;
            fourths += value * value * value * value;
            if (std::abs(value) > 2) ++beyond_2;
        }
        product += x[0] * x[1];
    }
    const double count = 2.0 * pairs;
    // Four standard errors each.
    EXPECT_NEAR(sum / count, 0, 4 / std::sqrt(count));
    EXPECT_NEAR(squares / count, 1, 4 * std::sqrt(2 / count));
    EXPECT_NEAR(cubes / count, 0, 4 * std::sqrt(15 / count));
    EXPECT_NEAR(fourths / count, 3, 4 * std::sqrt(96 / count));
    EXPECT_NEAR(product / pairs, 0, 4 / std::sqrt(static_cast<double>(pairs)));
    EXPECT_NEAR(beyond_2 / count, 0.0455, 4 * std::sqrt(0.0455 / count));
}

TEST(CounterRandom, SeedsAndStreamsAreApart) {
    EXPECT_NE(normal_pair(1, 0)[0], normal_pair(2, 0)[0]);
    EXPECT_NE(normal_pair(1, 0)[0], normal_pair(1, 1)[0]);
    EXPECT_NE(normal_pair(1, 0, 0)[0], normal_pair(1, 0, 1)[0]);
    EXPECT_NE(normal_pair(1, 0)[0], normal_pair(uint64_t{1} << 32, 0)[0]);
    EXPECT_EQ(normal_pair(1, 5)[1], normal_pair(1, 5)[1]);
}

TEST(Simulation, WithoutNoiseItIsTheGoldenAnswer) {
    SimulationSetup setup = small_setup();
    setup.sigma_psi_deg = setup.sigma_delta_deg = 0;
    const Measurement m = simulate_ellipsometer(constant_material(1.04, 2.59), setup);
    ASSERT_EQ(m.rows.size(), 4u);
    EXPECT_EQ(m.rows[0].wavelength_nm, 500);
    EXPECT_EQ(m.rows[1].wavelength_nm, 500);
    EXPECT_EQ(m.rows[1].angle_deg, 80);
    EXPECT_NEAR(m.rows[0].psi_deg, 36.839209, 1e-6);
    EXPECT_NEAR(m.rows[0].delta_deg, 126.836625, 1e-6);
    EXPECT_NEAR(m.rows[1].psi_deg, 37.000107, 1e-6);
    EXPECT_NEAR(m.rows[1].delta_deg, 53.553486, 1e-6);
    EXPECT_FALSE(m.has_sigma());
}

TEST(Simulation, FilmsCountAndDeltaIsWithin360) {
    Material material = constant_material(0.96, 6.69);
    material.layers = {{constant_material(1.77, 0).substrate, 100}};
    SimulationSetup setup = small_setup();
    setup.sigma_psi_deg = setup.sigma_delta_deg = 0;
    setup.wavelengths_nm = {550};
    const Measurement m = simulate_ellipsometer(material, setup);
    EXPECT_NEAR(m.rows[0].psi_deg, 44.924760, 1e-6);
    EXPECT_NEAR(m.rows[0].delta_deg, 231.155169, 1e-6);
}

TEST(Simulation, NoiseIsReproducibleAndOfTheStatedSize) {
    SimulationSetup setup;
    setup.angles_deg = {70};
    for (int i = 0; i < 20000; ++i) setup.wavelengths_nm.push_back(400 + 0.01 * i);
    const Material material = constant_material(1.04, 2.59);
    const Measurement noisy = simulate_ellipsometer(material, setup);
    EXPECT_EQ(format_measurement(noisy),
              format_measurement(simulate_ellipsometer(material, setup)));
    SimulationSetup exact_setup = setup;
    exact_setup.sigma_psi_deg = exact_setup.sigma_delta_deg = 0;
    const Measurement exact = simulate_ellipsometer(material, exact_setup);
    double psi_squares = 0, delta_squares = 0, product = 0;
    for (size_t i = 0; i < noisy.rows.size(); ++i) {
        const double psi_error = (noisy.rows[i].psi_deg - exact.rows[i].psi_deg) / 0.05;
        const double delta_error = (noisy.rows[i].delta_deg - exact.rows[i].delta_deg) / 0.1;
        psi_squares += psi_error * psi_error;
        delta_squares += delta_error * delta_error;
        product += psi_error * delta_error;
    }
    EXPECT_NEAR(psi_squares / 20000, 1, 0.04);
    EXPECT_NEAR(delta_squares / 20000, 1, 0.04);
    EXPECT_NEAR(product / 20000, 0, 0.03);
    setup.seed = 2;
    EXPECT_NE(simulate_ellipsometer(material, setup).rows[0].psi_deg, noisy.rows[0].psi_deg);
}

// At Brewster's angle of glass Psi is 0 and half the noise would be negative.
TEST(Simulation, NoiseIsReflectedAtTheEndsOfPsi) {
    SimulationSetup setup;
    setup.angles_deg = {std::atan(1.5) * 180 / pi};
    for (int i = 0; i < 1000; ++i) setup.wavelengths_nm.push_back(400 + 0.1 * i);
    setup.sigma_psi_deg = 0.05;
    setup.sigma_delta_deg = 0.1;
    const Measurement m = simulate_ellipsometer(constant_material(1.5, 0), setup);
    int turned = 0;
    for (size_t i = 0; i < m.rows.size(); ++i) {
        const MeasurementRow& row = m.rows[i];
        EXPECT_GE(row.psi_deg, 0);
        EXPECT_GE(row.delta_deg, 0);
        EXPECT_LT(row.delta_deg, 360);
        // The complex ratio is that of the unreflected noise, up to the common turn of Delta.
        const double noise = 0.05 * normal_pair(setup.seed, i)[0];
        EXPECT_NEAR(row.psi_deg, std::abs(noise), 1e-6);
        if (noise < 0) ++turned;
    }
    EXPECT_NEAR(turned, 500, 70);
    setup.sigma_psi_deg = 45;
    for (const MeasurementRow& row : simulate_ellipsometer(constant_material(1.5, 0), setup).rows) {
        EXPECT_GE(row.psi_deg, 0);
        EXPECT_LE(row.psi_deg, 90);
    }
}

TEST(Simulation, HeaderSaysThatNothingWasMeasured) {
    const Measurement m = simulate_ellipsometer(constant_material(1.04, 2.59), small_setup());
    EXPECT_NE(m.header_value("instrument").find("simulated"), std::string::npos);
    EXPECT_EQ(m.header_value("seed"), "1");
    EXPECT_EQ(m.header_value("sample"), "constant");
    EXPECT_TRUE(m.has_sigma());
}

TEST(Simulation, SetupsOutOfRangeAreRefused) {
    const Material material = constant_material(1.04, 2.59);
    const auto refused = [&](auto&& change) {
        SimulationSetup setup = small_setup();
        change(setup);
        try {
            simulate_ellipsometer(material, setup);
        } catch (const Error& error) {
            return error.cause() == Cause::user;
        }
        return false;
    };
    EXPECT_TRUE(refused([](SimulationSetup& s) { s.angles_deg = {}; }));
    EXPECT_TRUE(refused([](SimulationSetup& s) { s.angles_deg = {90}; }));
    EXPECT_TRUE(refused([](SimulationSetup& s) { s.angles_deg = {60, 60}; }));
    EXPECT_TRUE(refused([](SimulationSetup& s) { s.wavelengths_nm = {}; }));
    EXPECT_TRUE(refused([](SimulationSetup& s) { s.wavelengths_nm = {-1}; }));
    EXPECT_TRUE(refused([](SimulationSetup& s) { s.sigma_psi_deg = -0.1; }));
    EXPECT_TRUE(refused([](SimulationSetup& s) { s.sigma_delta_deg = NAN; }));
    EXPECT_THROW(simulate_ellipsometer(constant_material(1, 0), small_setup()), Error);
}

}  // namespace
}  // namespace drude
