#include "materials/optical_constants.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <set>
#include <sstream>

#include "base/expect_error.h"
#include "base/files.h"
#include "shared_data.h"

namespace drude {
namespace {

OpticalConstants small_table() {
    OpticalConstants constants;
    constants.name = "brass";
    constants.wavelength_nm = {400, 500, 700};
    constants.n = {1, 2, 0.5};
    constants.k = {3, 3.5, 4};
    return constants;
}

bool contains(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

TEST(OpticalConstants, InterpolatesLinearlyAndHitsItsRows) {
    const OpticalConstants constants = small_table();
    EXPECT_EQ(constants.at(500).n, 2);
    EXPECT_EQ(constants.at(500).k, 3.5);
    EXPECT_DOUBLE_EQ(constants.at(425).n, 1.25);
    EXPECT_DOUBLE_EQ(constants.at(600).n, 1.25);
    EXPECT_DOUBLE_EQ(constants.at(600).k, 3.75);
}

TEST(OpticalConstants, ClampHoldsTheEnds) {
    const OpticalConstants constants = small_table();
    const double infinity = std::numeric_limits<double>::infinity();
    for (const double nm : {-infinity, 0.0, 399.999, 400.0}) {
        EXPECT_EQ(constants.at(nm).n, 1);
        EXPECT_EQ(constants.at(nm).k, 3);
    }
    for (const double nm : {700.0, 700.001, infinity}) EXPECT_EQ(constants.at(nm).n, 0.5);
    EXPECT_THROW(constants.at(std::numeric_limits<double>::quiet_NaN()), Error);
    EXPECT_THROW(OpticalConstants().at(500), Error);
}

TEST(OpticalConstants, ErrorPolicyNamesTheRange) {
    OpticalConstants constants = small_table();
    constants.policy = RangePolicy::error;
    EXPECT_EQ(constants.at(400).n, 1);
    EXPECT_EQ(constants.at(700).n, 0.5);
    const std::string message = message_of([&] { constants.at(399.5); });
    EXPECT_TRUE(contains(message, "brass") && contains(message, "399.5 nm") &&
                contains(message, "400 to 700 nm"))
        << message;
    EXPECT_THROW(dense(constants), Error);
}

TEST(OpticalConstants, WarnsOnceWhereTheRangeIsNotCovered) {
    OpticalConstants constants = small_table();
    EXPECT_EQ(constants.range_warning(400, 700), "");
    EXPECT_EQ(constants.range_warning(380, 700),
              "brass is tabulated from 400 to 700 nm; the value at 400 nm is held below 400 nm");
    EXPECT_EQ(constants.range_warning(400, 701),
              "brass is tabulated from 400 to 700 nm; the value at 700 nm is held above 700 nm");
    EXPECT_EQ(constants.range_warning(380, 780),
              "brass is tabulated from 400 to 700 nm; the end values are held below 400 nm and "
              "above 700 nm");
    constants.policy = RangePolicy::error;
    EXPECT_TRUE(contains(constants.range_warning(380, 780), "errors"));
}

TEST(OpticalConstants, DenseIsTheTableOnTheGrid) {
    const DenseIndex index = dense(small_table());
    EXPECT_EQ(index.n[0], 1);
    EXPECT_DOUBLE_EQ(index.n[45], 1.25);
    EXPECT_EQ(index.k[120], 3.5);
    EXPECT_EQ(index.k[spectrum_integral_size], 4);
}

TEST(OpticalConstants, CheckNamesWhatIsWrong) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_NO_THROW(small_table().check());
    struct Case {
        std::function<void(OpticalConstants&)> spoil;
        std::string part;
    };
    const std::vector<Case> cases = {
        {[](OpticalConstants& c) { c = OpticalConstants(); }, "no rows"},
        {[](OpticalConstants& c) { c.n.pop_back(); }, "2 values of n for 3 wavelengths"},
        {[](OpticalConstants& c) { c.k.push_back(1); }, "4 values of k for 3 wavelengths"},
        {[](OpticalConstants& c) { c.sigma_n = {1}; }, "1 values of sigma_n"},
        {[](OpticalConstants& c) {
             c.sigma_k = {1, -1, 1};
         },
         "sigma_k = -1 at 500 nm"},
        {[](OpticalConstants& c) { c.wavelength_nm[2] = 500; }, "500 nm is followed by 500 nm"},
        {[](OpticalConstants& c) { c.wavelength_nm[0] = 0; }, "wavelength 0 in row 1"},
        {[&](OpticalConstants& c) { c.wavelength_nm[1] = nan; }, "wavelength nan in row 2"},
        {[](OpticalConstants& c) { c.n[1] = 0; }, "n = 0 at 500 nm"},
        {[&](OpticalConstants& c) { c.n[2] = nan; }, "n = nan at 700 nm"},
        {[](OpticalConstants& c) { c.k[0] = -0.1; }, "k = -0.1 at 400 nm"},
    };
    for (const Case& each : cases) {
        OpticalConstants constants = small_table();
        each.spoil(constants);
        const std::string message = message_of([&] { constants.check(); });
        EXPECT_TRUE(contains(message, each.part)) << message << " lacks " << each.part;
    }
}

TEST(PublishedSets, AreSoundOrderedAndComplete) {
    const std::set<std::string> expected = {"Ag-Ferrera-298K",
                                            "Ag-Hagemann",
                                            "Ag-Johnson",
                                            "Ag-McPeak",
                                            "Ag-Rakic-BB",
                                            "Ag-Yang",
                                            "Al-Hagemann",
                                            "Al-McPeak",
                                            "Al-Rakic",
                                            "Al-Rakic-LD",
                                            "Al2O3-Boidin",
                                            "Al2O3-Malitson-o",
                                            "Au-Babar",
                                            "Au-Johnson",
                                            "Au-McPeak",
                                            "Au-Olmon-ev",
                                            "Cu-Babar",
                                            "Cu-Hagemann",
                                            "Cu-Johnson",
                                            "Cu-McPeak",
                                            "Cu-Rakic-BB",
                                            "Fe-Johnson",
                                            "Fe-Querry",
                                            "Si-Aspnes",
                                            "Si-Green-2008",
                                            "Zn-Werner",
                                            "Zn-Werner-DFT",
                                            "Au-Yakubovsky-117nm",
                                            "steel-Karlsson-austenitic",
                                            "steel-Karlsson-ferritic"};
    std::set<std::string> found;
    std::string previous;
    for (const OpticalConstants& set : published_sets()) {
        SCOPED_TRACE(set.name);
        EXPECT_NO_THROW(set.check());
        EXPECT_LT(previous, set.material + " " + set.name);
        previous = set.material + " " + set.name;
        found.insert(set.name);
        EXPECT_EQ(set.name.substr(0, set.material.size() + 1), set.material + "-");
        EXPECT_GT(set.citation.size(), 20U);
        EXPECT_TRUE(set.kind == "measured" || set.kind == "calculated" || set.kind == "digitised");
        EXPECT_EQ(set.range_warning(380, 780).empty(), set.covers(380, 780));
        EXPECT_TRUE(set.covers(380, 780)) << "every set so far covers the film";
        EXPECT_GE(set.first_nm(), 200);
        EXPECT_LE(set.last_nm(), 2500);
        EXPECT_NO_THROW(published_set(set.material));
    }
    EXPECT_EQ(found, expected);
}

struct Spot {
    const char* set;
    double nm, n, k;
};

// Interpolated by an independent reader of the same publications; sapphire at the sodium line and
// silicon at the helium-neon line as handbooks have them.
TEST(PublishedSets, SpotValues) {
    for (const Spot& spot : {Spot{"Cu-Hagemann", 516, 1.121, 2.598},
                             Spot{"Cu-McPeak", 516, 1.004, 2.613},
                             Spot{"Cu-Johnson", 516, 1.188, 2.599},
                             Spot{"Cu-Babar", 516, 1.090, 2.501},
                             Spot{"Cu-Rakic-BB", 516, 0.932, 2.397},
                             Spot{"Ag-Johnson", 495, 0.050, 3.085},
                             Spot{"Ag-Hagemann", 495, 0.237, 3.081},
                             Spot{"Ag-McPeak", 495, 0.041, 3.113},
                             Spot{"Ag-Yang", 495, 0.052, 3.019},
                             Spot{"Ag-Ferrera-298K", 495, 0.121, 3.030},
                             Spot{"Ag-Rakic-BB", 495, 0.139, 2.759},
                             Spot{"Al-Rakic", 516, 0.871, 6.235},
                             Spot{"Al-Hagemann", 516, 0.855, 6.132},
                             Spot{"Al-Rakic-LD", 516, 0.823, 6.083},
                             Spot{"Al-McPeak", 516, 0.676, 5.492},
                             Spot{"Au-Johnson", 516, 0.702, 2.032},
                             Spot{"Au-Babar", 516, 0.512, 1.847},
                             Spot{"Au-McPeak", 516, 0.582, 2.064},
                             Spot{"Au-Olmon-ev", 516, 0.577, 1.998},
                             Spot{"Au-Yakubovsky-117nm", 516, 0.597, 2.046},
                             Spot{"steel-Karlsson-austenitic", 500, 1.864, 3.401},
                             Spot{"steel-Karlsson-ferritic", 500, 1.724, 2.992},
                             Spot{"Fe-Johnson", 500, 2.759, 2.885},
                             Spot{"Fe-Querry", 500, 1.996, 3.067},
                             Spot{"Zn-Werner", 500, 0.797, 4.502},
                             Spot{"Zn-Werner-DFT", 500, 1.425, 5.770},
                             Spot{"Al2O3-Malitson-o", 589.3, 1.768, 0},
                             Spot{"Al2O3-Malitson-o", 550, 1.770, 0},
                             Spot{"Al2O3-Boidin", 550, 1.682, 0},
                             Spot{"Si-Aspnes", 632.8, 3.882, 0.019}}) {
        const Index index = published_set(spot.set).at(spot.nm);
        EXPECT_NEAR(index.n, spot.n, 2e-3) << spot.set;
        EXPECT_NEAR(index.k, spot.k, 2e-3) << spot.set;
    }
}

TEST(PublishedSets, DefaultOfEachMaterial) {
    EXPECT_EQ(published_set("Cu").name, "Cu-McPeak");
    EXPECT_EQ(published_set("Ag").name, "Ag-McPeak");
    EXPECT_EQ(published_set("Au").name, "Au-McPeak");
    EXPECT_EQ(published_set("Al").name, "Al-McPeak");
    EXPECT_EQ(published_set("Zn").name, "Zn-Werner-DFT");
    EXPECT_EQ(published_set("Fe").name, "Fe-Johnson");
    EXPECT_EQ(published_set("steel").name, "steel-Karlsson-austenitic");
    EXPECT_EQ(published_set("Al2O3").name, "Al2O3-Malitson-o");
    EXPECT_EQ(published_set("Si").name, "Si-Aspnes");
    EXPECT_EQ(published_names().size(), published_sets().size() + 9);
    EXPECT_EQ(&published_set("Cu"), &published_set("Cu-McPeak"));
}

TEST(PublishedSets, AWrongNameIsToldTheNearest) {
    EXPECT_TRUE(contains(message_of([] { published_set("cu"); }), "did you mean 'Cu'"));
    EXPECT_TRUE(contains(message_of([] { published_set("Cu-McPaek"); }), "'Cu-McPeak'"));
    EXPECT_TRUE(contains(message_of([] { published_set("unobtainium"); }), "drude materials"));
    EXPECT_TRUE(contains(message_of([] { published_set(""); }), "''"));
}

TEST(PublishedSets, NotesSayWhatIsMissing) {
    EXPECT_TRUE(contains(published_note("Al2O3-Malitson-o"), "k = 0"));
    EXPECT_TRUE(contains(published_note("Ag-Yang"), "merged"));
    EXPECT_EQ(published_note("nothing"), "");
}

// The tables of the repository against the files they were made from.
TEST(PublishedSets, EqualTheirSource) {
    int rows_compared = 0;
    for (const OpticalConstants& set : published_sets()) {
        if (set.name == "Al2O3-Malitson-o") continue;  // a formula
        const std::string source = shared_data("literature/" + set.material + "/" +
                                               set.name.substr(set.material.size() + 1) + ".yml");
        DRUDE_NEED_SHARED(source);
        const std::string text = read_file(source);
        const size_t data = text.find("data: |");
        ASSERT_NE(data, std::string::npos);
        std::istringstream lines(text.substr(text.find('\n', data)));
        std::string line;
        size_t in_range = 0;
        std::set<double> seen;
        while (std::getline(lines, line)) {
            std::istringstream fields(line);
            double micrometres = 0, n = 0, k = 0;
            if (!(fields >> micrometres >> n)) continue;
            fields >> k;
            const double nm = micrometres * 1000;
            if (nm < 199.9999 || nm > 2500.0001 || !seen.insert(micrometres).second) continue;
            ++in_range;
            // Merged rows of Yang differ by one in the last digit.
            EXPECT_NEAR(set.at(nm).n, n, 1e-4) << set.name << " " << nm;
            EXPECT_NEAR(set.at(nm).k, k, 6e-3) << set.name << " " << nm;
        }
        EXPECT_EQ(set.wavelength_nm.size(), in_range) << set.name;
        rows_compared += static_cast<int>(in_range);
    }
    EXPECT_GT(rows_compared, 3000);
}

}  // namespace
}  // namespace drude
