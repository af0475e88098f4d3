// What a study says of its captures and lobe scans, and writes down of them.
#include "report/study_lobe.h"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "markup_checker.h"
#include "report/capture_record.h"
#include "report/study_samples.h"

namespace drude {
namespace {

StudyLobe blinn_lobe() {
    StudyLobe lobe;
    lobe.true_lobe = Lobe::blinn_phong;
    lobe.true_beta = 0.12;
    lobe.fit.data = 1000;
    lobe.fit.parameters = 2;
    lobe.fit.lobes.resize(4);
    const Lobe order[] = {Lobe::blinn_phong, Lobe::gaussian, Lobe::beckmann,
                          Lobe::trowbridge_reitz};
    for (size_t i = 0; i < 4; ++i) {
        FittedLobe& one = lobe.fit.lobes[i];
        one.lobe = order[i];
        one.beta = 0.1203 + 0.01 * static_cast<double>(i);
        one.sigma_beta = 0.0001;
        one.chi2 = 1000 + 100 * static_cast<double>(i);
        one.tied = i == 0;
        lobe.sigma.push_back(0.0001);
    }
    return lobe;
}

TEST(StudyLobe, VerdictsFollowFromTheNumbers) {
    StudyLobe lobe = blinn_lobe();
    EXPECT_EQ(lobe_verdict(lobe), LobeVerdict::recovered);  // 3 sigma off
    EXPECT_EQ(tied_with(lobe), "");
    lobe.fit.lobes[1].tied = true;
    EXPECT_EQ(lobe_verdict(lobe), LobeVerdict::tie);
    EXPECT_EQ(tied_with(lobe), "gaussian");
    lobe.sigma[0] = 0.00005;
    EXPECT_EQ(lobe_verdict(lobe), LobeVerdict::beta_missed);  // 6
    lobe.true_lobe = Lobe::trowbridge_reitz;
    EXPECT_EQ(lobe_verdict(lobe), LobeVerdict::lobe_missed);
    EXPECT_EQ(own_lobe(lobe).lobe, Lobe::trowbridge_reitz);
    lobe.fit.lobes.pop_back();
    EXPECT_THROW(lobe_verdict(lobe), std::logic_error);
}

TEST(StudyLobe, IsDrawnWellFormed) {
    StudyMetal metal;
    metal.name = "Copper & more";
    metal.folder = "copper";
    metal.lobe = blinn_lobe();
    metal.lobe->surface = find_material("Cu-McPeak");
    metal.lobe->scan.detector_solid_angle_sr = 2e-4;
    metal.lobe->scan.detector_half_angle_deg = 0.5;
    for (const double nm : {500.0, 560.0}) {
        for (int offset = -20; offset <= 20; offset += 4) {
            const double peak = 1e-3 * std::exp(-offset * offset / 100.0);
            metal.lobe->scan.rows.push_back(
                {nm, 45, static_cast<double>(offset), peak, 0.7 * peak, 1e-5, 1e-5});
        }
    }
    const std::string svg = lobe_plot(metal, 550);
    EXPECT_EQ(malformed(svg), "");
    EXPECT_NE(svg.find("560 nm"), std::string::npos);
    EXPECT_NE(svg.find(">gaussian</text>"), std::string::npos);
    EXPECT_EQ(svg.find("nan"), std::string::npos);
}

TEST(CaptureRecord, ComesBack) {
    StudyLobe lobe = blinn_lobe();
    lobe.fit.warnings = {"a warning"};
    StudyCapture& capture = lobe.capture;
    capture.seed = 18446744073709551615u;
    capture.integration_s = 0.1;
    capture.frames = 2304;
    capture.bench_seconds = 1.0 / 3;
    capture.retries = 2;
    capture.common = {{45, 0.025, 1.0 / 7}};
    capture.harmonic_4 = 0.01;
    capture.drift = 0.02;
    capture.residual_over_noise = 1.25;
    capture.step_jitter_deg = 0.06;
    capture.saturated = 3;
    capture.warnings = {"too dark"};
    const std::string text = lobe_json(lobe).dump();
    const auto read = [](const std::string& json) {
        const JsonDocument document = parse_json_tree(json, "study.json");
        return read_lobe(JsonValue(document));
    };
    const StudyLobe back = read(text);
    EXPECT_EQ(lobe_json(back).dump(), text);
    EXPECT_EQ(back.capture.seed, capture.seed);
    EXPECT_EQ(back.capture.common.at(0).sigma_delta_deg, 1.0 / 7);
    EXPECT_EQ(back.fit.lobes.at(2).beta, lobe.fit.lobes[2].beta);
    EXPECT_EQ(back.sigma, lobe.sigma);
    const auto refuse = [&](const std::string& from, const std::string& to) {
        std::string changed = text;
        ASSERT_NE(changed.find(from), std::string::npos) << from;
        changed.replace(changed.find(from), from.size(), to);
        EXPECT_THROW(read(changed), Error) << to;
    };
    refuse("\"blinn-phong\"", "\"blinn-fong\"");
    refuse("\"frames\":2304", "\"frames\":-1");
    refuse("\"frames\":2304", "\"frames\":0.5");
    refuse("\"saturated\"", "\"saturatet\"");
    refuse("\"tied\":true", "\"tied\":1");
    refuse("\"18446744073709551615\"", "\"18446744073709551616\"");
}

TEST(StudySamples, AreFiveDifferentSurfaces) {
    const auto& samples = study_samples();
    ASSERT_EQ(samples.size(), 5u);
    for (size_t i = 0; i < samples.size(); ++i) {
        const Material material = made_of(samples[i]);
        EXPECT_GE(material.beta, 0.1);
        EXPECT_LE(material.beta, 0.2);
        for (size_t j = 0; j < i; ++j) {
            EXPECT_FALSE(samples[i].lobe == samples[j].lobe && samples[i].beta == samples[j].beta);
        }
    }
}

}  // namespace
}  // namespace drude
