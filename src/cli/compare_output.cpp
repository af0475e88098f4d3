#include "cli/compare_output.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

namespace drude {

namespace {

const char* word(Decision decision) {
    switch (decision) {
        case Decision::exact:
            return "exact";
        case Decision::tolerance:
            return "tolerance";
        case Decision::noise:
            return "noise";
        case Decision::identical:
            return "identical";
    }
    return "";
}

// NaN and infinities have no JSON number.
nlohmann::json number(double value) {
    return std::isfinite(value) ? nlohmann::json(value) : nlohmann::json();
}

nlohmann::json figures_json(const Figures& figures) {
    return {{"mean_error", number(figures.mean_error)},
            {"mae", number(figures.mae)},
            {"rmse", number(figures.rmse)},
            {"relmse", number(figures.relmse)},
            {"smape", number(figures.smape)},
            {"psnr", number(figures.psnr)},
            {"max_error", number(figures.max_error)}};
}

nlohmann::json polarisation_json(const PolarisationErrors& errors) {
    return {{"dolp_bias", number(errors.dolp_bias)},
            {"dolp_mae", number(errors.dolp_mae)},
            {"aolp_mae_deg", number(errors.aolp_mae_deg)},
            {"polarised_intensity", number(errors.polarised_intensity)},
            {"layers", errors.layers.size()},
            {"not_physical", errors.not_physical}};
}

}  // namespace

nlohmann::json comparison_json(const Comparison& comparison, const std::optional<FlipResult>& flip,
                               const CompareWords& words) {
    nlohmann::json json = figures_json(comparison.all);
    json["a"] = words.a;
    json["b"] = words.b;
    json["same"] = comparison.same;
    json["decision"] = word(comparison.decision);
    json["reason"] = comparison.reason;
    json["not_finite"] = comparison.not_finite;
    for (size_t c = 0; c < comparison.channels.size(); ++c) {
        json["channels"][comparison.channels[c]] = figures_json(comparison.each[c]);
    }
    for (size_t i = 0; i < comparison.stokes.size(); ++i) {
        json["stokes"][fmt::format("S{}", i)] = figures_json(comparison.stokes[i]);
    }
    if (comparison.polarisation) json["polarisation"] = polarisation_json(*comparison.polarisation);
    if (flip) {
        json["flip"] = {{"kind", words.flip},
                        {"mean", flip->mean},
                        {"max", *std::max_element(flip->error.begin(), flip->error.end())}};
        if (words.flip == "hdr") {
            json["flip"]["start_exposure"] = flip->start_exposure;
            json["flip"]["stop_exposure"] = flip->stop_exposure;
            json["flip"]["exposures"] = flip->exposures;
        }
    }
    // Without variances nothing is known about noise; null says so.
    for (const char* key : {"p_min", "outlier_fraction", "smallest_detectable_bias"}) {
        json[key] = nullptr;
    }
    if (comparison.noise) {
        const NoiseTest& noise = *comparison.noise;
        json["p_min"] = noise.p_min;
        json["p_pixels"] = noise.p_pixels;
        json["p_blocks"] = noise.p_blocks;
        json["p_global"] = noise.p_global;
        json["outlier_fraction"] = noise.outlier_fraction;
        json["smallest_detectable_bias"] = number(noise.smallest_detectable_bias);
        json["alpha"] = words.alpha;
        json["tests"] = noise.tests;
        json["worst"] = {{"channel", noise.worst.channel},
                         {"x", noise.worst.x},
                         {"y", noise.worst.y},
                         {"z", number(noise.worst.z)}};
        json["worst"]["test"] = noise.worst.family == TestFamily::pixel   ? "pixel"
                                : noise.worst.family == TestFamily::block ? "block"
                                                                          : "mean";
    }
    if (comparison.decision == Decision::tolerance) {
        json["beyond_tolerance"] = comparison.beyond_tolerance;
    }
    return json;
}

void print_comparison(const Comparison& comparison, const std::optional<FlipResult>& flip,
                      const CompareWords& words) {
    const Figures& all = comparison.all;
    fmt::print("{}: {} against {}, channels {}\n", comparison.same ? "same" : "different", words.a,
               words.b, fmt::join(comparison.channels, " "));
    fmt::print("  {}\n", comparison.reason);
    const auto line = [](const char* name, double value) {
        fmt::print("  {:<26}{:.6g}\n", name, value);
    };
    line("mean error (a - b)", all.mean_error);
    line("mean absolute error", all.mae);
    line("RMSE", all.rmse);
    line("relative MSE", all.relmse);
    line("SMAPE", all.smape);
    line("PSNR / dB", all.psnr);
    line("largest error", all.max_error);
    if (comparison.not_finite > 0) {
        fmt::print("  {:<26}{}\n", "NaN or infinite values", comparison.not_finite);
    }
    if (flip) line(words.flip == "hdr" ? "HDR-FLIP" : "FLIP", flip->mean);
    for (size_t i = 0; i < comparison.stokes.size(); ++i) {
        const Figures& stokes = comparison.stokes[i];
        fmt::print("  {:<26}{:.6g}, largest {:.6g}\n", fmt::format("RMSE of S{}", i), stokes.rmse,
                   stokes.max_error);
    }
    if (const auto& polarisation = comparison.polarisation) {
        line("DoLP, mean |error|", polarisation->dolp_mae);
        line("AoLP, mean |error| / deg", polarisation->aolp_mae_deg);
    }
    if (!comparison.noise) return;
    line("p, corrected", comparison.noise->p_min);
    line("  of pixels", comparison.noise->p_pixels);
    line("  of 8x8 blocks", comparison.noise->p_blocks);
    line("  of the mean", comparison.noise->p_global);
    line("outlier fraction", comparison.noise->outlier_fraction);
    line("smallest detectable bias", comparison.noise->smallest_detectable_bias);
}

}  // namespace drude
