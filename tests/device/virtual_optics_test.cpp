#include "device/virtual/virtual_optics.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <set>

#include "base/error.h"
#include "materials/surface.h"
#include "materials/torrance_sparrow.h"

namespace drude {
namespace {

using Complex64 = std::complex<double>;
const char* const metals[] = {"Cu-McPeak", "Ag-McPeak", "Au-McPeak", "Al-McPeak", "Zn-Werner-DFT"};

VirtualBenchSettings five_nm_pixels() {
    VirtualBenchSettings settings;
    settings.pixels = 81;
    settings.first_nm = 380;
    settings.last_nm = 780;
    return settings;
}

OpticalState at(double incidence_deg, double polariser_deg, double analyser_deg, bool retarder) {
    OpticalState state;
    state.incidence_deg = incidence_deg;
    state.polariser_deg = polariser_deg;
    state.analyser_deg = analyser_deg;
    state.retarder_in = retarder;
    return state;
}

OpticalState straight(double polariser_deg, double analyser_deg, bool retarder = false) {
    OpticalState state = at(45, polariser_deg, analyser_deg, retarder);
    state.straight_through = true;
    return state;
}

Material constant_metal(double n, double k, double beta = 0, Lobe lobe = Lobe::beckmann,
                        Masking masking = Masking::v_groove) {
    Material material;
    material.name = "constant";
    material.substrate.name = "constant";
    material.substrate.kind = "calculated";
    material.substrate.wavelength_nm = {300, 900};
    material.substrate.n = {n, n};
    material.substrate.k = {k, k};
    material.lobe = lobe;
    material.masking = masking;
    material.beta = beta;
    return material;
}

// Fourier coefficients of the counts over a turn of the polariser, of every pixel.
struct Harmonics {
    std::vector<double> mean, alpha, beta;
};
Harmonics scan(const VirtualOptics& optics, OpticalState state, int steps = 24) {
    const size_t pixels = optics.wavelengths_nm().size();
    Harmonics sum{std::vector<double>(pixels), std::vector<double>(pixels),
                  std::vector<double>(pixels)};
    for (int i = 0; i < steps; ++i) {
        state.polariser_deg = 360.0 * i / steps;
        const std::vector<double> counts = optics.expected_counts(state, 0.05, 0);
        const double twice = 2 * state.polariser_deg * degree;
        for (size_t j = 0; j < pixels; ++j) {
            sum.mean[j] += counts[j] / steps;
            sum.alpha[j] += 2 * counts[j] * std::cos(twice) / steps;
            sum.beta[j] += 2 * counts[j] * std::sin(twice) / steps;
        }
    }
    for (size_t j = 0; j < pixels; ++j) {
        sum.alpha[j] /= sum.mean[j];
        sum.beta[j] /= sum.mean[j];
    }
    return sum;
}

double turned(double degrees) {
    return degrees - 360 * std::round(degrees / 360);
}

// Fields in the frame of p and s. r_p and r_s with conventions' signs; the retarder brings p ahead,
// which with exp(-i omega t) is a factor exp(-i d); analyser and polariser stand counter-clockwise
// from p, where s stands clockwise of it seen looking towards the source: e = (cos, -sin).
double jones_intensity(const ComplexIndex<double>& index, double incidence, double P, double A,
                       double retardance, double diattenuation) {
    const Complex64 N(index.n, index.k);
    const double c = std::cos(incidence);
    const Complex64 c1 = std::sqrt(1.0 - std::pow(std::sin(incidence) / N, 2));
    const Complex64 rs = (c - N * c1) / (c + N * c1), rp = (N * c - c1) / (N * c + c1);
    const double scale = 1 / std::max(1.0, diattenuation);
    const Complex64 p = diattenuation * scale * std::polar(1.0, -retardance) * rp * std::cos(P);
    const Complex64 s = -scale * rs * std::sin(P);
    return std::norm(p * std::cos(A) - s * std::sin(A));
}

TEST(VirtualOptics, IntensitiesAreThoseOfFieldsInAnyState) {
    const Material copper = find_material("Cu-McPeak");
    VirtualBenchSettings settings = five_nm_pixels();
    settings.retardance_deg = 75;
    settings.retarder_diattenuation = 1.07;
    const VirtualOptics optics(copper, settings);
    const std::vector<double> full = optics.expected_counts(straight(20, 20), 0.05, 0);
    for (const double incidence : {20.0, 45.0, 70.0, 85.0}) {
        for (const double P : {0.0, 17.0, 90.0, 133.0, 301.0}) {
            for (const double A : {45.0, -45.0, 10.0}) {
                for (const bool retarder : {false, true}) {
                    const std::vector<double> got =
                        optics.expected_counts(at(incidence, P, A, retarder), 0.05, 0);
                    for (size_t i = 0; i < got.size(); i += 16) {
                        const double nm = optics.wavelengths_nm()[i];
                        const Index index = copper.substrate.at(nm);
                        const double expected = jones_intensity(
                            {index.n, index.k}, incidence * degree, P * degree, A * degree,
                            retarder ? 75 * degree * 550 / nm : 0, retarder ? 1.07 : 1);
                        EXPECT_NEAR(got[i] / full[i], expected, 1e-12)
                            << nm << " nm, " << incidence << " deg, P " << P << ", A " << A;
                    }
                }
            }
        }
    }
}

// The closed forms of a rotating polariser (Fujiwara 2007, eqs 4.19, 4.23) with Psi and Delta of
// materials/, both zones, without and with the retarder; and Delta over 360 degrees from the pair.
TEST(VirtualOptics, ScansHaveTheHarmonicsOfPsiAndDelta) {
    VirtualBenchSettings settings = five_nm_pixels();
    settings.retardance_deg = 80;
    settings.retarder_diattenuation = 0.97;
    for (const char* const name : metals) {
        const Material metal = find_material(name);
        const VirtualOptics optics(metal, settings);
        for (const double incidence : {45, 50, 60, 70, 75, 80}) {
            for (const double A : {45.0, -45.0, 30.0}) {
                const Harmonics bare = scan(optics, at(incidence, 0, A, false));
                const Harmonics held = scan(optics, at(incidence, 0, A, true));
                for (size_t i = 0; i < bare.mean.size(); ++i) {
                    const double nm = optics.wavelengths_nm()[i];
                    const Reflection<double> r = reflect(metal, nm, std::cos(incidence * degree));
                    const double tan_psi = std::tan(psi(r)), Delta = delta(r);
                    const double tan_a = std::tan(A * degree), d = 80 * degree * 550 / nm;
                    const auto expect = [&](const Harmonics& got, double t, double angle) {
                        const double x = t * tan_psi;
                        const double sum = x * x + tan_a * tan_a;
                        EXPECT_NEAR(got.alpha[i], (x * x - tan_a * tan_a) / sum, 1e-12);
                        EXPECT_NEAR(got.beta[i], 2 * x * std::cos(angle) * tan_a / sum, 1e-12);
                    };
                    expect(bare, 1, Delta);
                    expect(held, 0.97, Delta + d);
                    const double sign = tan_a > 0 ? 1 : -1;
                    const auto cosine = [&](const Harmonics& h) {
                        return sign * h.beta[i] / std::sqrt(1 - h.alpha[i] * h.alpha[i]);
                    };
                    const double sine = (cosine(bare) * std::cos(d) - cosine(held)) / std::sin(d);
                    EXPECT_NEAR(turned((std::atan2(sine, cosine(bare)) - Delta) / degree), 0, 1e-9);
                    // A bare metal.
                    EXPECT_GT(Delta, 0);
                    EXPECT_LT(Delta, pi);
                }
            }
        }
    }
}

TEST(VirtualOptics, FilmsThatTurnDeltaBeyond180AreSeen) {
    // conventions' golden film: Psi 44.924760, Delta 231.155169.
    Material coated = constant_metal(0.96, 6.69);
    FilmLayer layer;
    layer.constants = constant_metal(1.77, 0).substrate;
    layer.thickness_nm = 100;
    coated.layers.push_back(layer);
    VirtualBenchSettings settings;
    settings.pixels = 3;
    settings.first_nm = 540;
    settings.last_nm = 560;
    const VirtualOptics optics(coated, settings);
    const Harmonics bare = scan(optics, at(60, 0, 45, false));
    const Harmonics held = scan(optics, at(60, 0, 45, true));
    const auto cosine = [](const Harmonics& h) {
        return h.beta[1] / std::sqrt(1 - h.alpha[1] * h.alpha[1]);
    };
    // A quarter-wave plate at 550 nm: cos(Delta + 90) = -sin Delta.
    EXPECT_NEAR(std::atan2(-cosine(held), cosine(bare)) / degree + 360, 231.155169, 1e-6);
    EXPECT_NEAR(std::atan(std::sqrt((1 + bare.alpha[1]) / (1 - bare.alpha[1]))) / degree, 44.924760,
                1e-6);
}

TEST(VirtualOptics, TheStraightBeamFillsTheDetectorAsStated) {
    VirtualBenchSettings settings;
    settings.full_scale_s = 0.2;
    settings.max_counts = 16383;
    const VirtualOptics optics(find_material("Ag"), settings);
    for (const double azimuth : {0.0, 33.0, 90.0}) {
        const auto counts = optics.expected_counts(straight(azimuth, azimuth), 0.2, 0);
        EXPECT_NEAR(*std::max_element(counts.begin(), counts.end()), 0.8 * 16383, 1e-9 * 16383);
        const auto crossed = optics.expected_counts(straight(azimuth, azimuth + 90), 0.2, 0);
        EXPECT_NEAR(*std::max_element(crossed.begin(), crossed.end()), 0, 1e-9 * 16383);
    }
    // Malus.
    const auto at_60 = optics.expected_counts(straight(15, 75), 0.2, 0);
    EXPECT_NEAR(*std::max_element(at_60.begin(), at_60.end()), 0.25 * 0.8 * 16383, 1e-9 * 16383);
    // A retarder whose axes the polariser is along changes nothing; at 45 degrees a quarter-wave
    // plate leaves half.
    const VirtualOptics monochrome(find_material("Ag"), [] {
        VirtualBenchSettings green;
        green.pixels = 3;
        green.first_nm = 540;
        green.last_nm = 560;
        return green;
    }());
    const double all = monochrome.expected_counts(straight(0, 0), 0.05, 0)[1];
    EXPECT_NEAR(monochrome.expected_counts(straight(0, 0, true), 0.05, 0)[1], all, 1e-9 * all);
    EXPECT_NEAR(monochrome.expected_counts(straight(45, 45, true), 0.05, 0)[1], all / 2,
                1e-9 * all);
}

TEST(VirtualOptics, AzimuthErrorsTurnTheTrueAxes) {
    VirtualBenchSettings settings = five_nm_pixels();
    settings.polariser_offset_deg = 0.3;
    settings.analyser_offset_deg = -0.2;
    settings.eccentricity_deg = 0.25;
    const VirtualOptics optics(find_material("Cu-McPeak"), settings);
    EXPECT_NEAR(optics.true_polariser_deg(at(70, 90, 45, false)), 90 + 0.3 + 0.25, 1e-12);
    EXPECT_NEAR(optics.true_polariser_deg(at(70, 270, 45, false)), 270 + 0.3 - 0.25, 1e-12);
    EXPECT_NEAR(optics.true_analyser_deg(at(70, 90, 45, false)), 44.8, 1e-12);
    const VirtualOptics ideal(find_material("Cu-McPeak"), five_nm_pixels());
    const auto off = optics.expected_counts(at(70, 90, 45, true), 0.05, 0);
    const auto same = ideal.expected_counts(at(70, 90.55, 44.8, true), 0.05, 0);
    for (size_t i = 0; i < off.size(); ++i) EXPECT_NEAR(off[i], same[i], 1e-9 * same[i]);
}

TEST(VirtualOptics, JitterIsThatOfTheStateAndOfTheStatedSize) {
    VirtualBenchSettings settings = five_nm_pixels();
    settings.mount_jitter_deg = 0.05;
    const VirtualOptics optics(find_material("Cu"), settings), again(find_material("Cu"), settings);
    double squares = 0, analyser_squares = 0;
    int stops = 0, scans = 0;
    for (int incidence = 10; incidence < 85; ++incidence) {
        for (const bool retarder : {false, true}) {
            const OpticalState first = at(incidence, 0, 45, retarder);
            const double analyser = optics.true_analyser_deg(first) - 45;
            analyser_squares += analyser * analyser;
            ++scans;
            for (int P = 0; P < 360; P += 15) {
                const OpticalState state = at(incidence, P, 45, retarder);
                const double error = optics.true_polariser_deg(state) - P;
                squares += error * error;
                ++stops;
                EXPECT_EQ(again.true_polariser_deg(state) - P, error);
                EXPECT_EQ(optics.true_analyser_deg(state) - 45, analyser);
                // The same place on another turn.
                EXPECT_NEAR(optics.true_polariser_deg(at(incidence, P - 360, 45, retarder)) + 360,
                            P + error, 1e-9);
            }
        }
    }
    // Four standard errors of a sum of squares.
    EXPECT_NEAR(squares / stops / (0.05 * 0.05), 1, 4 * std::sqrt(2.0 / stops));
    EXPECT_NEAR(analyser_squares / scans / (0.05 * 0.05), 1, 4 * std::sqrt(2.0 / scans));
    settings.seed = 2;
    const VirtualOptics other(find_material("Cu"), settings);
    EXPECT_NE(other.true_polariser_deg(at(70, 30, 45, false)),
              optics.true_polariser_deg(at(70, 30, 45, false)));
}

TEST(VirtualOptics, SourcePolarisationIsAlongItsAzimuth) {
    VirtualBenchSettings settings = five_nm_pixels();
    settings.source_dop = 0.1;
    settings.source_aolp_deg = 25;
    const VirtualOptics optics(find_material("Ag"), settings);
    const VirtualOptics ideal(find_material("Ag"), five_nm_pixels());
    for (const double azimuth : {0.0, 25.0, 70.0, 115.0}) {
        const double expected = 1 + 0.1 * std::cos(2 * (azimuth - 25) * degree);
        EXPECT_NEAR(optics.expected_counts(straight(azimuth, azimuth), 0.05, 0)[40] /
                        ideal.expected_counts(straight(azimuth, azimuth), 0.05, 0)[40],
                    expected, 1e-12);
    }
}

TEST(VirtualOptics, LeaksLimitTheContrast) {
    VirtualBenchSettings settings = five_nm_pixels();
    settings.polariser_extinction = 1e-3;
    settings.analyser_extinction = 2e-3;
    const VirtualOptics optics(find_material("Ag"), settings);
    const double open = optics.expected_counts(straight(10, 10), 0.05, 0)[40];
    const double shut = optics.expected_counts(straight(10, 100), 0.05, 0)[40];
    // Each lets its leak of the other's light through.
    EXPECT_NEAR(shut / open, (1e-3 + 2e-3) / (1 + 1e-3 * 2e-3), 1e-12);
}

TEST(VirtualOptics, DetectorAddsDarkAndBendsLight) {
    VirtualBenchSettings settings = five_nm_pixels();
    settings.dark_counts = 1500;
    settings.dark_counts_per_s = 200;
    settings.nonlinearity = -0.02;
    settings.drift_per_hour = 0.01;
    const VirtualOptics optics(find_material("Ag"), settings);
    const VirtualOptics ideal(find_material("Ag"), five_nm_pixels());
    OpticalState dark = straight(0, 0);
    dark.lamp_on = false;
    EXPECT_NEAR(optics.expected_counts(dark, 0.5, 0)[0], 1600, 1e-9);
    // 0.02 s from half an hour on.
    const double light =
        ideal.expected_counts(straight(0, 0), 0.02, 0)[60] * (1 + 0.01 * (1800 + 0.01) / 3600);
    EXPECT_NEAR(optics.expected_counts(straight(0, 0), 0.02, 1800)[60],
                1500 + 4 + light * (1 - 0.02 * light / 65535), 1e-6);
    // Half of an exposure in each of two states.
    const OpticalState shut = straight(0, 90);
    const auto halves = ideal.expected_counts({{shut, 0.01}, {straight(0, 0), 0.01}}, 0);
    const auto whole = ideal.expected_counts(straight(0, 0), 0.02, 0);
    EXPECT_NEAR(halves[60], whole[60] / 2, 1e-9 * whole[60]);
}

TEST(VirtualOptics, NoiseHasTheStatedVariance) {
    VirtualBenchSettings settings;
    settings.pixels = 400;
    settings.full_scale_s = 0.05;
    settings.electrons_per_count = 2;
    settings.read_noise_counts = 15;
    settings.relative_noise = 2e-3;
    settings.dark_counts = 1500;
    const VirtualOptics optics(find_material("Ag"), settings);
    const OpticalState state = straight(0, 20);
    const auto expected = optics.expected_counts(state, 0.04, 0);
    const int frames = 200;
    double chi2 = 0, mean = 0, neighbours = 0, successive = 0;
    std::vector<double> before(expected.size());
    for (int exposure = 0; exposure < frames; ++exposure) {
        const auto frame = optics.frame(state, 0.04, 0, static_cast<uint64_t>(exposure));
        double last = 0;
        for (size_t i = 0; i < frame.size(); ++i) {
            const double light = expected[i] - 1500;
            // 1/12: rounding to whole counts.
            const double variance =
                expected[i] / 2 + 15 * 15 + std::pow(2e-3 * light, 2) + 1.0 / 12;
            const double deviate = (frame[i] - expected[i]) / std::sqrt(variance);
            chi2 += deviate * deviate;
            mean += deviate;
            neighbours += deviate * last;
            successive += deviate * before[i];
            last = before[i] = deviate;
        }
    }
    const double count = frames * static_cast<double>(expected.size());
    EXPECT_NEAR(chi2 / count, 1, 4 * std::sqrt(2 / count));
    EXPECT_NEAR(mean / count, 0, 4 / std::sqrt(count));
    EXPECT_NEAR(neighbours / count, 0, 4 / std::sqrt(count));
    EXPECT_NEAR(successive / count, 0, 4 / std::sqrt(count));
}

TEST(VirtualOptics, FramesAreAFunctionOfStateAndExposure) {
    VirtualBenchSettings settings;
    settings.pixels = 300;
    settings.read_noise_counts = 10;
    const VirtualOptics optics(find_material("Cu"), settings), again(find_material("Cu"), settings);
    OpticalState state = at(60, 15, 45, false);
    const auto frame = optics.frame(state, 0.05, 0, 3);
    // Another object, asked for other things before, at another time of the clock.
    again.frame(at(70, 15, 45, true), 0.05, 0, 1);
    EXPECT_EQ(again.frame(state, 0.05, 999, 3), frame);
    const VirtualOptics copy = again;
    EXPECT_EQ(copy.frame(state, 0.05, 0, 3), frame);
    std::set<std::vector<uint32_t>> noises{frame};
    const auto is_new = [&](const OpticalState& of, double integration_s, uint64_t exposure) {
        return noises.insert(optics.frame(of, integration_s, 0, exposure)).second;
    };
    EXPECT_TRUE(is_new(state, 0.05, 4));
    EXPECT_TRUE(is_new(state, 0.06, 3));
    OpticalState dark = state;
    dark.lamp_on = false;
    EXPECT_TRUE(is_new(dark, 0.05, 3));
    EXPECT_TRUE(is_new(dark, 0.05, 4));
    // Of the dark, wherever the polariser stands.
    OpticalState turned_dark = dark;
    turned_dark.polariser_deg = 100;
    turned_dark.retarder_in = true;
    EXPECT_FALSE(is_new(turned_dark, 0.05, 3));
    turned_dark.incidence_deg = 61;
    EXPECT_TRUE(is_new(turned_dark, 0.05, 3));
    EXPECT_NE(optics.frame({{state, 0.05}}, 0, 3), frame);
    settings.seed = 2;
    EXPECT_NE(VirtualOptics(find_material("Cu"), settings).frame(state, 0.05, 0, 3), frame);
}

TEST(VirtualOptics, ReadingsAreWholeAndEndAtTheTop) {
    VirtualBenchSettings settings = five_nm_pixels();
    settings.max_counts = 4095;
    const VirtualOptics exact(find_material("Ag"), settings);
    const OpticalState state = straight(0, 0);
    const auto expected = exact.expected_counts(state, 0.1, 0);
    const auto frame = exact.frame(state, 0.1, 0, 0);
    int saturated = 0;
    for (size_t i = 0; i < frame.size(); ++i) {
        if (expected[i] >= 4095) {
            EXPECT_EQ(frame[i], 4095u);
            ++saturated;
        } else {
            EXPECT_NEAR(frame[i], expected[i], 0.5 + 1e-9);
        }
    }
    EXPECT_GT(saturated, 10);
    EXPECT_LT(saturated, 81);
    // Dithered, the mean of many is the unrounded value.
    settings.quantise = false;
    const VirtualOptics dithered(find_material("Ag"), settings);
    const auto low = dithered.expected_counts(state, 0.01, 0);
    double error = 0;
    const int frames = 2000;
    std::vector<double> mean(low.size());
    for (int i = 0; i < frames; ++i) {
        const auto reading = dithered.frame(state, 0.01, 0, static_cast<uint64_t>(i));
        for (size_t j = 0; j < low.size(); ++j) {
            EXPECT_LT(std::abs(reading[j] - low[j]), 1);
            mean[j] += static_cast<double>(reading[j]) / frames;
        }
    }
    for (size_t j = 0; j < low.size(); ++j) error = std::max(error, std::abs(mean[j] - low[j]));
    // 4.5 standard errors of the widest case, a half.
    EXPECT_LT(error, 4.5 * 0.5 / std::sqrt(frames));
}

// ---- lobes
// ---------------------------------------------------------------------------------------

// BRDF x cos(theta_o) integrated over the detector's cone on a square grid of directions, which the
// bench does not use, of evaluate_conductor().
double cone_flux(const Material& metal, double nm, double incidence, double offset, double half,
                 double P, double A) {
    const Index index = metal.substrate.at(nm);
    const Surface<double> surface{{index.n, index.k}};
    const Microfacets<double> microfacets(metal.lobe, metal.masking, metal.beta);
    const double exit = incidence + offset;
    const Vec3<double> i(-std::sin(incidence), 0, std::cos(incidence)), y(0, 1, 0);
    const Vec3<double> axis(std::sin(exit), 0, std::cos(exit)),
        along(std::cos(exit), 0, -std::sin(exit));
    // Axis azimuths count from p, which stands 90 degrees from y.
    const Stokes<double> in{{1, -std::cos(2 * P), -std::sin(2 * P), 0}};
    const int cells = 400;
    const double top = std::tan(half), cell = 2 * top / cells;
    double sum = 0;
    for (int a = 0; a < cells; ++a) {
        for (int b = 0; b < cells; ++b) {
            const double u = -top + (a + 0.5) * cell, v = -top + (b + 0.5) * cell;
            if (u * u + v * v > top * top) continue;
            const double stretch = 1 + u * u + v * v;
            const Vec3<double> o = (axis + u * along + v * y) / std::sqrt(stretch);
            const Vec3<double> x_o = glm::normalize(y - glm::dot(y, o) * o);
            const Mueller<double> m = evaluate_conductor(microfacets, surface, i, y, o, x_o, 1.0);
            const Stokes<double> out = m * in;
            const double passed =
                0.5 * (out[0] - std::cos(2 * A) * out[1] - std::sin(2 * A) * out[2]);
            sum += passed * o.z / i.z * cell * cell / std::pow(stretch, 1.5);
        }
    }
    return sum;
}

TEST(VirtualOptics, LobeScansAreTheLobeOverTheCone) {
    struct Case {
        Lobe lobe;
        Masking masking;
        double beta;
    };
    const Case cases[] = {{Lobe::beckmann, Masking::v_groove, 0.15},
                          {Lobe::trowbridge_reitz, Masking::smith, 0.12},
                          {Lobe::gaussian, Masking::v_groove, 0.1},
                          {Lobe::blinn_phong, Masking::v_groove, 0.03}};
    for (const Case& c : cases) {
        const Material metal = constant_metal(1.04, 2.59, c.beta, c.lobe, c.masking);
        VirtualBenchSettings settings = five_nm_pixels();
        settings.pixels = 3;
        settings.detector_half_angle_deg = 2;
        const VirtualOptics optics(metal, settings);
        for (const double P : {0.0, 90.0, 30.0}) {
            for (const double offset : {-12.0, 0.0, 4.0}) {
                OpticalState state = at(55, P, 45, false);
                state.offset_deg = offset;
                const double through = optics.expected_counts(straight(P, 45), 1, 0)[1];
                const double got = optics.expected_counts(state, 1, 0)[1] / through;
                // The straight beam that the analyser passes.
                const double passed = std::pow(std::cos((P - 45) * degree), 2);
                const double flux = cone_flux(metal, 580, 55 * degree, offset * degree, 2 * degree,
                                              P * degree, 45 * degree);
                // The square grid's own error, at the circle's edge.
                EXPECT_NEAR(got, flux / passed, 1e-3 * flux / passed)
                    << lobe_name(c.lobe) << ", P " << P << ", offset " << offset;
            }
        }
    }
}

TEST(VirtualOptics, AllOfALobeIsWhatAHalfSphereWouldCollect) {
    // A narrow lobe in a wide cone: everything is collected but what masking loses; a mirror's
    // reflectance.
    const Material metal = constant_metal(1.04, 2.59, 0.004);
    VirtualBenchSettings settings = five_nm_pixels();
    settings.detector_half_angle_deg = 5;
    const VirtualOptics rough(metal, settings);
    const VirtualOptics mirror(constant_metal(1.04, 2.59), settings);
    for (const double P : {0.0, 45.0, 90.0}) {
        const double smooth = mirror.expected_counts(at(45, P, 45, false), 1, 0)[40];
        EXPECT_NEAR(rough.expected_counts(at(45, P, 45, false), 1, 0)[40] / smooth, 1, 2e-3) << P;
    }
}

TEST(VirtualOptics, PsiAndDeltaOfARoughMetalAreNearlyThoseOfItsFacets) {
    const Material metal = constant_metal(1.04, 2.59, 0.15);
    const VirtualOptics rough(metal, five_nm_pixels());
    const VirtualOptics mirror(constant_metal(1.04, 2.59), five_nm_pixels());
    const Harmonics got = scan(rough, at(70, 0, 45, false));
    const Harmonics smooth = scan(mirror, at(70, 0, 45, false));
    EXPECT_NEAR(got.alpha[40], smooth.alpha[40], 2e-4);
    EXPECT_NEAR(got.beta[40], smooth.beta[40], 2e-4);
    EXPECT_LT(got.mean[40], 0.01 * smooth.mean[40]);
}

TEST(VirtualOptics, AMirrorIsInTheDetectorOrNot) {
    const VirtualOptics optics(find_material("Cu"), five_nm_pixels());  // half angle 0.5 degrees
    OpticalState state = at(60, 0, 45, false);
    const auto centred = optics.expected_counts(state, 0.05, 0);
    state.offset_deg = -0.49;
    EXPECT_EQ(optics.expected_counts(state, 0.05, 0), centred);
    state.offset_deg = 0.51;
    for (const double counts : optics.expected_counts(state, 0.05, 0)) EXPECT_EQ(counts, 0);
}

// ---- settings
// ------------------------------------------------------------------------------------

std::string message_of(const std::string& json) {
    try {
        parse_virtual_bench_settings(json, "bench.json");
    } catch (const Error& error) {
        EXPECT_EQ(error.cause(), Cause::user);
        return error.message();
    }
    return "";
}

TEST(VirtualBenchSettings, RoundTripThroughJson) {
    VirtualBenchSettings settings;
    EXPECT_EQ(format_virtual_bench_settings(settings), "{}");
    settings.seed = 42;
    settings.quantise = false;
    settings.drift_per_hour = 0.1;
    settings.reported_nonlinearity = {1, -3e-7};
    const std::string json = format_virtual_bench_settings(settings);
    EXPECT_EQ(json,
              "{\"seed\": 42, \"reported_nonlinearity\": [1, -3e-07], \"quantise\": false, "
              "\"drift_per_hour\": 0.1}");
    const VirtualBenchSettings read = parse_virtual_bench_settings(json, "bench.json");
    EXPECT_EQ(format_virtual_bench_settings(read), json);
    EXPECT_EQ(read.seed, 42u);
    EXPECT_FALSE(read.quantise);
    EXPECT_EQ(read.drift_per_hour, 0.1);
    EXPECT_EQ(read.pixels, 2048);
}

TEST(VirtualBenchSettings, ErrorsNameKeyBoundAndPlace) {
    EXPECT_NE(message_of("{\"sead\": 1}").find("(did you mean 'seed'?)"), std::string::npos);
    EXPECT_EQ(message_of("{\"source_dop\": 2}"),
              "bench.json:1:1: source_dop = 2, expected a number from 0 to 1");
    EXPECT_EQ(message_of("{\"pixels\": 2.5}"),
              "bench.json:1:12: 'pixels': found 2.5, expected a whole number from 2 to 65536");
    EXPECT_EQ(message_of("{\"read_noise_counts\": -1}"),
              "bench.json:1:1: read_noise_counts = -1, expected a finite number of at least 0");
    EXPECT_EQ(message_of("{\"first_nm\": 900}"),
              "bench.json:1:1: the pixels lie from first_nm = 900 to last_nm = 860, expected more "
              "at the end");
    EXPECT_NE(message_of("{\"quantise\": 1}").find("'quantise'"), std::string::npos);
    EXPECT_NE(message_of("{\"seed\": 1e300}").find("whole number"), std::string::npos);
    VirtualBenchSettings nan;
    nan.relative_noise = std::nan("");
    EXPECT_THROW(VirtualOptics(find_material("Cu"), nan), Error);
}

}  // namespace
}  // namespace drude
