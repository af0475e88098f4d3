// The numbers that a study's page carries, and those that its claims rest on.
#include <gtest/gtest.h>
#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "device/virtual/ellipsometer_simulation.h"
#include "report/claim_figures.h"
#include "report/claims.h"
#include "report/figure_9.h"
#include "report/packed_layers.h"
#include "report/paper_figures.h"
#include "report/picture_data.h"
#include "report/study_report.h"
#include "report/table_1.h"

namespace drude {
namespace {

float half_value(uint16_t h) {
    const int exponent = h >> 10 & 31, significand = h & 1023;
    const double size = exponent == 0 ? std::ldexp(significand, -24)
                        : exponent == 31
                            ? (significand ? std::nan("") : std::numeric_limits<double>::infinity())
                            : std::ldexp(1024 + significand, exponent - 25);
    return static_cast<float>(h & 0x8000 ? -size : size);
}

std::string unpack(const std::string& text) {
    static const std::string letters =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string packed;
    uint32_t bits = 0;
    int held = 0;
    for (const char c : text) {
        if (c == '=') break;
        bits = bits << 6 | static_cast<uint32_t>(letters.find(c));
        held += 6;
        if (held >= 8) packed += static_cast<char>(bits >> (held -= 8) & 0xffu);
    }
    std::string bytes(1 << 20, '\0');
    uLongf size = bytes.size();
    EXPECT_EQ(uncompress(reinterpret_cast<Bytef*>(bytes.data()), &size,
                         reinterpret_cast<const Bytef*>(packed.data()),
                         static_cast<uLong>(packed.size())),
              Z_OK);
    bytes.resize(size);
    return bytes;
}

std::vector<float> unpack_halves(const std::string& text) {
    const std::string bytes = unpack(text);
    std::vector<float> values;
    for (size_t i = 0; i < bytes.size() / 2; ++i) {
        values.push_back(half_value(
            static_cast<uint16_t>(static_cast<unsigned char>(bytes[i]) << 8 |
                                  static_cast<unsigned char>(bytes[bytes.size() / 2 + i]))));
    }
    return values;
}

TEST(Half, KnownAnswers) {
    EXPECT_EQ(half_from_float(0.0F), 0x0000);
    EXPECT_EQ(half_from_float(-0.0F), 0x8000);
    EXPECT_EQ(half_from_float(1.0F), 0x3c00);
    EXPECT_EQ(half_from_float(-2.0F), 0xc000);
    EXPECT_EQ(half_from_float(1.0F / 3), 0x3555);
    EXPECT_EQ(half_from_float(65504.0F), 0x7bff);
    EXPECT_EQ(half_from_float(65519.0F), 0x7bff);
    EXPECT_EQ(half_from_float(65520.0F), 0x7c00);  // ties to even: infinity
    EXPECT_EQ(half_from_float(1e30F), 0x7c00);
    EXPECT_EQ(half_from_float(0x1p-14F), 0x0400);
    EXPECT_EQ(half_from_float(0x1p-24F), 0x0001);
    EXPECT_EQ(half_from_float(0x1p-25F), 0x0000);  // the tie below it goes to even
    EXPECT_EQ(half_from_float(0x1.8p-25F), 0x0001);
    EXPECT_EQ(half_from_float(0x1.ffcp-15F), 0x0400);  // rounds up into the normal numbers
    EXPECT_EQ(half_from_float(std::nanf("")) & 0x7c00, 0x7c00);
    EXPECT_NE(half_from_float(std::nanf("")) & 0x03ff, 0);
}

TEST(Half, EveryHalfComesBackAndTheNearestIsTaken) {
    for (uint32_t h = 0; h < 0x7c00; ++h) {
        const float value = half_value(static_cast<uint16_t>(h));
        ASSERT_EQ(half_from_float(value), h);
        ASSERT_EQ(half_from_float(-value), h | 0x8000);
        if (h + 1 == 0x7c00) break;
        // Just below and above the middle to the next one.
        const float next = half_value(static_cast<uint16_t>(h + 1));
        const float middle = 0.5F * (value + next);
        ASSERT_EQ(half_from_float(std::nextafter(middle, 0.0F)), h);
        ASSERT_EQ(half_from_float(std::nextafter(middle, 1e9F)), h + 1);
        ASSERT_EQ(half_from_float(middle), h + (h & 1));
    }
}

TEST(PackedLayers, ComeBack) {
    const std::vector<uint16_t> halves = {0x3c00, 0x0001, 0x8000, 0x7bff, 0x3555};
    const std::vector<float> values = unpack_halves(pack_halves(halves));
    ASSERT_EQ(values.size(), halves.size());
    for (size_t i = 0; i < halves.size(); ++i) EXPECT_EQ(values[i], half_value(halves[i]));
    EXPECT_EQ(pack_halves({0, 0x8000, 0}), "");
    EXPECT_EQ(unpack(pack_bytes("abc")), "abc");
}

// 4 x 2 pixels; the right half differs between the two pictures. S1 is a quarter of S0, S2 is 0.
StudyPair small_pair(double extra) {
    StudyPair pair;
    for (Image* image : {&pair.fitted, &pair.literature}) {
        image->width = 4;
        image->height = 2;
        for (int row = 0; row < 4; ++row) {
            for (const char c : {'R', 'G', 'B'}) {
                Channel& channel = image->add(fmt::format("S{}.{}", row, c));
                for (size_t p = 0; p < 8; ++p) {
                    const bool own = p % 4 >= 2;
                    const double value = static_cast<double>(p + 1) +
                                         (own ? extra + (image == &pair.fitted ? 0.5 : 0) : 0);
                    channel.data[p] = static_cast<float>(row == 0   ? value
                                                         : row == 1 ? value / 4
                                                                    : 0);
                }
            }
        }
    }
    pair.fitted_spectral = pair.literature_spectral = Image{2, 1, {}, {}};
    for (int row = 0; row < 4; ++row) {
        for (const char* nm : {"500,000000nm", "400,500000nm"}) {
            for (Image* image : {&pair.fitted_spectral, &pair.literature_spectral}) {
                Channel& channel = image->add(fmt::format("S{}.{}", row, nm));
                if (row > 0) continue;
                channel.data = {1, image == &pair.fitted_spectral ? 2.0F : 3.0F};
                if (nm[0] == '4') channel.data[0] = 7;
            }
        }
    }
    pair.spectral_is_smaller = true;
    return pair;
}

TEST(PictureData, HoldsEveryPixelOnce) {
    PictureData data;
    data.add("copper", small_pair(0));
    data.add("gold", small_pair(10));
    const std::string text = data.json();
    EXPECT_EQ(text.find('<'), std::string::npos);
    const nlohmann::json json = nlohmann::json::parse(text);
    EXPECT_EQ(json.at("pairs"), nlohmann::json({"copper", "gold"}));
    EXPECT_EQ(json.at("step"), 1);
    const nlohmann::json& colour = json.at("colour");
    EXPECT_EQ(colour.at("width"), 4);
    EXPECT_EQ(colour.at("planes"), 3);
    EXPECT_EQ(unpack(colour.at("own")), std::string("\0\0\1\1\0\0\1\1", 8));
    const std::vector<float> shared = {1, 2, 5, 6, 1, 2, 5, 6, 1, 2, 5, 6};
    EXPECT_EQ(unpack_halves(colour.at("shared").at(0)), shared);
    ASSERT_EQ(colour.at("pictures").size(), 4u);
    const std::vector<float> own = {13.5, 14.5, 17.5, 18.5, 13.5, 14.5,
                                    17.5, 18.5, 13.5, 14.5, 17.5, 18.5};
    EXPECT_EQ(unpack_halves(colour.at("pictures").at(2).at(0)), own);  // gold, fitted
    EXPECT_EQ(unpack_halves(colour.at("pictures").at(2).at(1)).at(0), 13.5F / 4);
    EXPECT_EQ(colour.at("pictures").at(2).at(2), "");  // zeros
    const nlohmann::json& spectral = json.at("spectral");
    EXPECT_EQ(spectral.at("nm"), nlohmann::json({400.5, 500}));
    EXPECT_EQ(unpack_halves(spectral.at("shared").at(0)), (std::vector<float>{7, 1}));
    EXPECT_EQ(unpack_halves(spectral.at("pictures").at(1).at(0)), (std::vector<float>{3, 3}));
    EXPECT_EQ(spectral.at("smaller"), true);
    EXPECT_EQ(json.at("sequential").get<std::string>().size(), 256u * 6);
    EXPECT_NE(data.description().find("2 wavelengths"), std::string::npos);
}

TEST(PictureData, KeepsToItsBudgetBySteps) {
    // Of S1, three planes of two bytes: 48 for the own pixels of both pictures and 24 for the
    // shared ones at every pixel, 12 and 6 at every second of every second row.
    PictureData narrow({512, 71, 1000000});
    narrow.add("copper", small_pair(0));
    const nlohmann::json json = nlohmann::json::parse(narrow.json());
    EXPECT_EQ(json.at("colour").at("first"), 1);
    EXPECT_EQ(json.at("colour").at("rest"), 2);
    // Pixels 0 and 2 of the first row: one shared, one own.
    EXPECT_EQ(unpack_halves(json.at("colour").at("pictures").at(0).at(1)),
              (std::vector<float>{3.5F / 4, 3.5F / 4, 3.5F / 4}));
    PictureData few({2, 1000000, 1000000});
    few.add("copper", small_pair(0));
    const nlohmann::json reduced_json = nlohmann::json::parse(few.json());
    EXPECT_EQ(reduced_json.at("step"), 2);
    EXPECT_EQ(reduced_json.at("colour").at("width"), 2);
    EXPECT_EQ(reduced_json.at("colour").at("height"), 1);
    EXPECT_EQ(unpack_halves(reduced_json.at("colour").at("shared").at(0)),
              (std::vector<float>{1, 1, 1}));
}

// S0 of two sharp pictures is 72 bytes (four shared and four own pixels, three planes of halves),
// of two blurred ones 48 more, or 12 at every second pixel of every second row.
TEST(PictureData, ThinsTheBlurredPairsFirst) {
    PictureBudget budget;
    budget.colour_bytes = 100;
    PictureData data(budget);
    data.add("copper", small_pair(0));
    data.add("copper-rough", small_pair(10), true);
    const nlohmann::json json = nlohmann::json::parse(data.json());
    EXPECT_EQ(json.at("pairs"), nlohmann::json({"copper", "copper-rough"}));
    const nlohmann::json& colour = json.at("colour");
    EXPECT_EQ(colour.at("firsts"), nlohmann::json({1, 1, 2, 2}));
    // What is compared at one place has one step, or a multiple of it.
    EXPECT_EQ(colour.at("rest"), 2);
    EXPECT_EQ(unpack_halves(colour.at("pictures").at(0).at(0)).size(), 12u);
    EXPECT_EQ(unpack_halves(colour.at("pictures").at(2).at(0)),
              (std::vector<float>{13.5, 13.5, 13.5}));
    EXPECT_NE(data.description().find("of the rough surfaces"), std::string::npos);
    budget.colour_bytes = 120;
    PictureData whole(budget);
    whole.add("copper", small_pair(0));
    whole.add("copper-rough", small_pair(10), true);
    EXPECT_EQ(nlohmann::json::parse(whole.json()).at("colour").at("firsts"),
              nlohmann::json({1, 1, 1, 1}));
}

TEST(PictureData, RefusesPairsThatDoNotBelongTogether) {
    PictureData data;
    data.add("copper", small_pair(0));
    StudyPair other = small_pair(0);
    for (Image* image : {&other.fitted, &other.literature}) {
        image->height = 1;
        for (Channel& channel : image->channels) channel.data.resize(4);
    }
    EXPECT_THROW(data.add("copper", other), Error);
    StudyPair blind = small_pair(0);
    blind.fitted_spectral = blind.literature_spectral = {};
    EXPECT_THROW(data.add("copper", blind), Error);
    EXPECT_EQ(PictureData().json(), "");
}

Image flat(float r, float g, float b, int pixels = 4) {
    Image image;
    image.width = pixels;
    image.height = 1;
    const float values[3] = {r, g, b};
    for (int c = 0; c < 3; ++c) {
        image.add(std::string(1, "RGB"[c])).data.assign(static_cast<size_t>(pixels), values[c]);
    }
    return image;
}

TEST(PairStatistics, KnownAnswers) {
    Image a = flat(1, 1, 1), b = flat(0.5F, 0.5F, 0.5F);
    for (Channel& c : a.channels) c.data[0] = 0.5F;  // equal there: does not count
    const PairStatistics s = pair_statistics(a, b);
    EXPECT_EQ(s.pixels, 3u);
    EXPECT_NEAR(s.mean_absolute, 0.5, 1e-12);
    EXPECT_NEAR(s.log10.mean, std::log10(0.5), 1e-12);
    EXPECT_NEAR(s.relative_luminance, 1, 1e-9);
    EXPECT_NEAR(s.white, 0.5, 1e-9);
    // Grey of twice the white: L* = 116 * 2^(1/3) - 16 against 100.
    EXPECT_NEAR(s.mean_delta_e, 116 * (std::cbrt(2.0) - 1), 1e-6);
    EXPECT_EQ(s.noticeable, 1);
    EXPECT_EQ(pair_statistics(b, b).pixels, 0u);
    EXPECT_EQ(pair_statistics(b, b).mean_delta_e, 0);
}

TEST(Figure9, ReducesByMeansOfBlocks) {
    Picture picture(3, 2, {0, 0, 0});
    picture.set(0, 0, {1, 0.5F, 0});
    picture.set(2, 0, {1, 1, 1});
    const Picture half = reduced(picture, 2);
    ASSERT_EQ(half.width, 2);
    ASSERT_EQ(half.height, 1);
    EXPECT_EQ(half.at(0, 0), (Colour{0.25F, 0.125F, 0}));
    EXPECT_EQ(half.at(1, 0), (Colour{0.5F, 0.5F, 0.5F}));
    EXPECT_EQ(reduced(picture, 1).rgb, picture.rgb);
}

TEST(Claims, TurningPoints) {
    EXPECT_EQ(turning_points({}, 1), 0);
    EXPECT_EQ(turning_points({1, 2, 3, 4}, 0.5), 0);
    EXPECT_EQ(turning_points({1, 4, 1, 4, 1}, 0.5), 3);
    EXPECT_EQ(turning_points({4, 1, 4}, 0.5), 1);
    EXPECT_EQ(turning_points({1, 1.2, 1, 1.2, 1}, 0.5), 0);  // noise
    EXPECT_EQ(turning_points({1, 4, 3.8, 4.1, 1}, 0.5), 1);  // noise on the top
    std::vector<double> wave;
    for (int i = 0; i <= 1000; ++i) wave.push_back(std::sin(0.1 * i));
    EXPECT_EQ(turning_points(wave, 0.1), 32);  // 100 rad = 15.9 periods
}

StudyMetal metal_of(const std::string& sample, const std::string& literature, const char* folder) {
    StudyMetal metal;
    metal.name = metal.folder = folder;
    metal.sample_set = sample;
    metal.literature_set = literature;
    metal.literature = published_set(literature);
    for (const OpticalConstants& set : published_sets()) {
        if (set.material == published_set(sample).material) metal.published.push_back(set);
    }
    SimulationSetup setup;
    setup.angles_deg = {45, 60, 75};
    for (double nm = 400; nm <= 700; nm += 50) setup.wavelengths_nm.push_back(nm);
    setup.sigma_psi_deg = setup.sigma_delta_deg = 0;
    metal.measurement = simulate_ellipsometer(find_material(sample), setup);
    metal.fitted.name = folder;
    for (const double nm : setup.wavelengths_nm) {
        const Index at = published_set(sample).at(nm);
        metal.fitted.wavelength_nm.push_back(nm);
        metal.fitted.n.push_back(at.n);
        metal.fitted.k.push_back(at.k);
    }
    return metal;
}

TEST(Table1, StandsBesideThePapers) {
    Study study;
    study.metals = {metal_of("Cu-McPeak", "Cu-Hagemann", "copper")};
    study.metals[0].name = "<Copper>";
    const std::vector<Table1Metal> metals = table_1(study);
    ASSERT_EQ(metals.size(), 6u);
    const Table1Metal& copper = metals[0];
    EXPECT_EQ(copper.name, "Copper");
    ASSERT_EQ(copper.fit.blocks.size(), 5u);
    EXPECT_TRUE(metals[2].fit.blocks.empty());  // steel: no sample
    // The measurement has no noise: every block gives the sample's constants at that wavelength.
    const Index truth = published_set("Cu-McPeak").at(copper.fit.wavelength_nm);
    for (const PaperFitBlock& block : copper.fit.blocks) {
        EXPECT_NEAR(block.n, truth.n, 1e-4);
        EXPECT_NEAR(block.k, truth.k, 1e-4);
    }
    const std::string html = table_1_markup(metals);
    for (const char* text : {"1.030", "0.786", "= start", "class=\"number nothing\"",
                             "printed values only", "&lt;Copper&gt;"}) {
        EXPECT_NE(html.find(text), std::string::npos) << text;
    }
    EXPECT_EQ(html.find("nan"), std::string::npos);
    // One angle holds too little: said, and the table stands.
    auto& rows = study.metals[0].measurement.rows;
    rows.erase(std::remove_if(rows.begin(), rows.end(),
                              [](const MeasurementRow& row) { return row.angle_deg != 60; }),
               rows.end());
    EXPECT_NE(table_1_markup(table_1(study)).find("Ours was refused"), std::string::npos);
    EXPECT_THROW(paper_figure(study, 5), Error);
}

// Zinc's sample is the very set that stands for the paper's zinc: its fit would start at its truth.
TEST(Table1, StartsFromTheSetComparedWith) {
    Study study;
    study.metals = {metal_of("Zn-Werner-DFT", "Zn-Werner", "zinc"),
                    metal_of("Ag-McPeak", "Ag-Ferrera-298K", "silver")};
    const std::vector<Table1Metal> metals = table_1(study);
    for (const Table1Metal& metal : metals) {
        if (metal.fit.blocks.empty()) continue;
        const StudyMetal& ours = study.metals[metal.name == "Silver"];
        EXPECT_EQ(metal.fit.literature, ours.literature_set);
        EXPECT_EQ(metal.fit.start_n, ours.literature.at(metal.fit.wavelength_nm).n);
        const Index truth = published_set(ours.sample_set).at(metal.fit.wavelength_nm);
        EXPECT_NEAR(metal.fit.blocks[0].n, truth.n, 1e-4);
        EXPECT_GT(std::abs(metal.fit.start_n - truth.n), 1e-3);
    }
    EXPECT_FALSE(metals[1].fit.blocks.empty());
    EXPECT_FALSE(metals[5].fit.blocks.empty());
}

int count(const std::string& text, const std::string& part) {
    int found = 0;
    for (size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) {
        ++found;
    }
    return found;
}

// One metal of the table by itself: hatching and the note follow from its fits' own numbers.
TEST(Table1, HatchesWhatTheFitsDoNotDetermine) {
    Study study;
    study.metals = {metal_of("Cu-McPeak", "Cu-Hagemann", "copper")};
    Table1Metal copper = table_1(study)[0];
    copper.fit.sigma_n = copper.check.fit.sigma_n = 0;
    copper.fit.sigma_k = copper.check.fit.sigma_k = 0;
    copper.fit.psi_delta.sigma_n = copper.fit.psi_delta.sigma_k = 0;
    const auto hatched = [&] {
        return count(table_1_markup({copper}), "class=\"number nothing\"");
    };
    EXPECT_EQ(hatched(), 8);  // beta of four distributions, the paper's and ours
    EXPECT_NE(table_1_note({copper}).find("= start"), std::string::npos);
    EXPECT_NE(table_1_note({copper}).find("started from 0.2 and from 0.5,"), std::string::npos);

    copper.fit.sigma_n = 0.21 * copper.fit.blocks[0].n;
    EXPECT_EQ(hatched(), 13);  // n of five blocks
    copper.fit.sigma_n = 0.19 * copper.fit.blocks[0].n;
    EXPECT_EQ(hatched(), 8);
    copper.fit.psi_delta.sigma_k = copper.fit.psi_delta.k;
    EXPECT_EQ(hatched(), 9);
    copper.check.fit.sigma_k = 0.5 * copper.printed->blocks[0].k;
    EXPECT_EQ(hatched(), 14);

    PaperFitBlock& block = copper.fit.blocks[2];
    block.column_beta = 0.5;
    EXPECT_EQ(hatched(), 13);
    EXPECT_EQ(table_1_note({copper}).find("cancel"), std::string::npos);
    block.beta_end = {0.3, 0.3};
    EXPECT_EQ(table_1_note({copper}).find("= start"), std::string::npos);
    EXPECT_NE(table_1_note({copper}).find("up to 0.2 away"), std::string::npos);
    EXPECT_NE(table_1_markup({copper}).find("0.2 → 0.3, 0.5 → 0.3"), std::string::npos);
}

TEST(Claims, FiguresOfAPerfectFit) {
    const StudyMetal gold = metal_of("Au-McPeak", "Au-McPeak", "gold");
    EXPECT_LT(ratio_deviation(gold.measurement, gold.literature), 1e-9);
    EXPECT_EQ(relative_gap(gold.fitted, gold.literature, true), 0);
    OpticalConstants twice = gold.fitted;
    for (double& k : twice.k) k *= 2;
    EXPECT_NEAR(relative_gap(gold.fitted, twice, false), -0.5, 1e-12);
    EXPECT_EQ(relative_gap(gold.fitted, twice, true), 0);
    EXPECT_LT(reflectance_error(find_material("Au-McPeak"), material_from_set(gold.fitted),
                                gold.measurement),
              1e-12);
    const StudyMetal other = metal_of("Au-McPeak", "Au-Johnson", "gold");
    EXPECT_GT(ratio_deviation(other.measurement, other.literature), 1e-3);
}

// At six angles and 0.05 and 0.1 degrees a bare surface meets aluminium under 3 nm of alumina.
TEST(Claims, AThinOxideHidesInTheConstants) {
    const StudyMetal aluminium = metal_of("Al-Rakic", "Al-Rakic", "aluminium");
    const HiddenOxide oxide = hidden_oxide("Al-Rakic", aluminium.measurement);
    EXPECT_LT(oxide.reduced_chi2, 0.1);
    EXPECT_GT(oxide.reflectance_error, 1e-4);
    EXPECT_LT(oxide.reflectance_error, 0.2);
}

TEST(Claims, TheEnvelopeLeavesTheSampleOut) {
    StudyMetal metal = metal_of("Au-McPeak", "Au-Johnson", "gold");
    OpticalConstants below = metal.fitted, above = metal.fitted;
    below.name = "below";
    above.name = "above";
    for (size_t i = 0; i < below.n.size(); ++i) {
        below.n[i] -= 0.01, below.k[i] -= 0.01;
        above.n[i] += 0.01, above.k[i] += 0.01;
    }
    metal.published = {below, above};
    EXPECT_EQ(envelope_share(metal).share, 1);
    EXPECT_EQ(envelope_share(metal).sets, 2);
    OpticalConstants lower = below;
    lower.name = "lower";
    metal.published = {below, lower, above};
    metal.published[2].name = metal.sample_set;
    EXPECT_EQ(envelope_share(metal).share, 0);
    EXPECT_EQ(envelope_share(metal).sets, 2);
    metal.fitted.sigma_n.assign(metal.fitted.n.size(), 0.004);
    metal.fitted.sigma_k = metal.fitted.sigma_n;
    EXPECT_EQ(envelope_share(metal).share, 1);  // within three standard deviations
    metal.published.pop_back();
    metal.published[1].name = metal.sample_set;  // one set spans nothing
    EXPECT_TRUE(std::isnan(envelope_share(metal).share));
    EXPECT_EQ(envelope_share(metal).sets, 1);
    metal.published.clear();
    EXPECT_TRUE(std::isnan(envelope_share(metal).share));
    EXPECT_EQ(envelope_share(metal).sets, 0);
}

TEST(Claims, BetaCancelsInTheMirrorDirection) {
    const StudyMetal silver = metal_of("Ag-McPeak", "Ag-McPeak", "silver");
    EXPECT_LT(largest_ratio_change_by_beta(silver.fitted, silver.measurement), 1e-12);
}

const Claim& claim(const std::vector<Claim>& claims, const std::string& id) {
    for (const Claim& c : claims) {
        if (c.id == id) return c;
    }
    throw std::logic_error("no claim " + id);
}

TEST(Claims, VerdictsFollowFromTheNumbers) {
    Study study;
    study.metals = {metal_of("Cu-McPeak", "Cu-Hagemann", "copper"),
                    metal_of("Ag-McPeak", "Ag-Johnson", "silver"),
                    metal_of("Au-McPeak", "Au-McPeak", "gold"),
                    metal_of("Al-McPeak", "Al-Rakic", "aluminium")};
    const auto with_differences = [&](std::vector<double> differences) {
        for (size_t i = 0; i < differences.size(); ++i) {
            PairStatistics pair;
            pair.pixels = 1;
            pair.mean_absolute = differences[i];
            pair.mean_delta_e = 10 * differences[i];
            study.metals[i].pair = pair;
        }
        return paper_claims(study);
    };
    std::vector<Claim> claims = with_differences({0.1, 0.2, 0.05, 0.22});
    EXPECT_EQ(claim(claims, "picture-gold").verdict, Verdict::holds);
    EXPECT_EQ(claim(claims, "picture-most").verdict, Verdict::holds);
    EXPECT_EQ(claim(claims, "picture-subtle").verdict, Verdict::holds);
    EXPECT_EQ(claim(claims, "gold-accurate").verdict, Verdict::holds);
    EXPECT_EQ(claim(claims, "beta-fitted").verdict, Verdict::does_not_hold);
    EXPECT_EQ(claim(claims, "aluminium-index").verdict, Verdict::does_not_hold);
    EXPECT_EQ(claim(claims, "film-explains").verdict, Verdict::not_tested);  // no film
    EXPECT_EQ(claim(claims, "proof-coin").verdict, Verdict::not_tested);
    claims = with_differences({0.1, 0.3, 0.2, 0.05});
    EXPECT_EQ(claim(claims, "picture-gold").verdict, Verdict::does_not_hold);
    EXPECT_EQ(claim(claims, "picture-most").verdict, Verdict::partly);
    EXPECT_EQ(claim(claims, "picture-subtle").verdict, Verdict::partly);
    for (const Claim& c : claims) {
        EXPECT_FALSE(c.claim.empty() || c.why.empty() || c.section.empty()) << c.id;
        EXPECT_FALSE(c.finding.empty() && c.verdict != Verdict::not_tested) << c.id;
    }
    EXPECT_NO_THROW(paper_claims({}));
}

// Zinc has one published set beside its sample's: between one set there is nothing.
TEST(Claims, OneSetIsNoEnvelope) {
    Study study;
    study.metals = {metal_of("Zn-Werner-DFT", "Zn-Werner", "zinc"),
                    metal_of("Cu-McPeak", "Cu-Hagemann", "copper")};
    const std::string finding = claim(paper_claims(study), "near-literature").finding;
    EXPECT_NE(finding.find("zinc – (1 set)"), std::string::npos) << finding;
    EXPECT_EQ(finding.find("copper –"), std::string::npos) << finding;
}

TEST(StudyPage, CountsTheAnglesItSpeaksOf) {
    Study study;
    study.metals = {metal_of("Cu-McPeak", "Cu-Hagemann", "copper")};
    EXPECT_NE(study_page(study, {}).find("wavelength at 3 angles of incidence"), std::string::npos);
    study.metals.push_back(metal_of("Ag-McPeak", "Ag-Johnson", "silver"));
    SimulationSetup setup;
    setup.angles_deg = paper_angles_deg();
    setup.wavelengths_nm = {500, 600};
    for (StudyMetal& metal : study.metals) {
        metal.measurement = simulate_ellipsometer(find_material(metal.sample_set), setup);
        const std::string page = study_page(study, {});
        const bool both = &metal == &study.metals.back();
        const char* text = both ? "at the paper&#39;s 6 angles of" : "at 3 to 6 angles of";
        EXPECT_NE(page.find(text), std::string::npos) << text;
        EXPECT_EQ(page.find("figure 6 below"), std::string::npos);  // there is no film
    }
}

}  // namespace
}  // namespace drude
