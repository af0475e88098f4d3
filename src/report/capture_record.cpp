#include "report/capture_record.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "base/numbers.h"

namespace drude {

namespace {

using nlohmann::ordered_json;

size_t count_of(const JsonValue& value) {
    return static_cast<size_t>(value.whole_number(0, 1e15));
}

FittedLobe read_fitted_lobe(const JsonValue& value) {
    value.allow_keys({"lobe", "beta", "sigma", "sigma_beta", "chi2", "tied", "at_bound",
                      "narrower_than_aperture", "upper_bound"});
    FittedLobe lobe;
    lobe.lobe = value.at("lobe").located([&] { return parse_lobe(value.at("lobe").string()); });
    lobe.beta = value.at("beta").number();
    lobe.sigma_beta = value.at("sigma_beta").number();
    lobe.chi2 = value.at("chi2").number();
    lobe.tied = value.at("tied").boolean();
    lobe.at_bound = value.at("at_bound").boolean();
    lobe.narrower_than_aperture = value.at("narrower_than_aperture").boolean();
    lobe.upper_bound = value.at("upper_bound").number();
    return lobe;
}

}  // namespace

ordered_json capture_json(const StudyCapture& capture) {
    ordered_json common = ordered_json::array();
    for (const CommonError& error : capture.common) {
        common.push_back({{"angle_deg", error.angle_deg},
                          {"sigma_psi_deg", error.sigma_psi_deg},
                          {"sigma_delta_deg", error.sigma_delta_deg}});
    }
    // Whole numbers of 64 bits in quotes: JSON's numbers are doubles.
    return {{"seed", fmt::format("{}", capture.seed)},
            {"integration_s", capture.integration_s},
            {"frames", capture.frames},
            {"bench_seconds", capture.bench_seconds},
            {"retries", capture.retries},
            {"common_errors", common},
            {"harmonic_4", capture.harmonic_4},
            {"drift", capture.drift},
            {"residual_over_noise", capture.residual_over_noise},
            {"step_jitter_deg", capture.step_jitter_deg},
            {"saturated", capture.saturated},
            {"warnings", capture.warnings}};
}

StudyCapture read_capture(const JsonValue& value) {
    value.allow_keys({"seed", "integration_s", "frames", "bench_seconds", "retries",
                      "common_errors", "harmonic_4", "drift", "residual_over_noise",
                      "step_jitter_deg", "saturated", "warnings"});
    StudyCapture capture;
    capture.seed = value.at("seed").quoted_whole_number();
    capture.integration_s = value.at("integration_s").number();
    capture.frames = count_of(value.at("frames"));
    capture.bench_seconds = value.at("bench_seconds").number();
    capture.retries = count_of(value.at("retries"));
    for (const JsonValue& entry : value.at("common_errors").array()) {
        entry.allow_keys({"angle_deg", "sigma_psi_deg", "sigma_delta_deg"});
        capture.common.push_back({entry.at("angle_deg").number(),
                                  entry.at("sigma_psi_deg").number(),
                                  entry.at("sigma_delta_deg").number()});
    }
    capture.harmonic_4 = value.at("harmonic_4").number();
    capture.drift = value.at("drift").number();
    capture.residual_over_noise = value.at("residual_over_noise").number();
    capture.step_jitter_deg = value.at("step_jitter_deg").number();
    capture.saturated = count_of(value.at("saturated"));
    capture.warnings = value.at("warnings").strings();
    return capture;
}

ordered_json lobe_json(const StudyLobe& lobe) {
    ordered_json lobes = ordered_json::array();
    for (size_t i = 0; i < lobe.fit.lobes.size(); ++i) {
        const FittedLobe& one = lobe.fit.lobes[i];
        lobes.push_back({{"lobe", lobe_name(one.lobe)},
                         {"beta", one.beta},
                         {"sigma", lobe.sigma[i]},
                         {"sigma_beta", one.sigma_beta},
                         {"chi2", one.chi2},
                         {"tied", one.tied},
                         {"at_bound", one.at_bound},
                         {"narrower_than_aperture", one.narrower_than_aperture},
                         {"upper_bound", one.upper_bound}});
    }
    return {{"capture", capture_json(lobe.capture)},
            {"data", lobe.fit.data},
            {"parameters", lobe.fit.parameters},
            {"lobes", lobes},
            {"warnings", lobe.fit.warnings}};
}

StudyLobe read_lobe(const JsonValue& value) {
    value.allow_keys({"capture", "data", "parameters", "lobes", "warnings"});
    StudyLobe lobe;
    lobe.capture = read_capture(value.at("capture"));
    lobe.fit.data = static_cast<int>(std::min<size_t>(count_of(value.at("data")), 2000000000));
    lobe.fit.parameters =
        static_cast<int>(std::min<size_t>(count_of(value.at("parameters")), 2000000000));
    for (const JsonValue& entry : value.at("lobes").array()) {
        lobe.fit.lobes.push_back(read_fitted_lobe(entry));
        lobe.sigma.push_back(entry.at("sigma").number());
    }
    if (lobe.fit.lobes.empty()) {
        user_error_at(value.at("lobes").place(), "a lobe scan without a fitted lobe");
    }
    lobe.fit.warnings = value.at("warnings").strings();
    return lobe;
}

}  // namespace drude
