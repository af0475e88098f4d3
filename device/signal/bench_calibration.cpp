#include "device/signal/bench_calibration.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/numbers.h"
#include "device/signal/calibration_fit.h"
#include "device/signal/harmonic_fit.h"
#include "device/signal/psi_delta.h"
#include "device/signal/scan_readings.h"
#include "materials/scalar.h"

namespace drude {

namespace {

struct StraightScans {
    std::vector<std::vector<BinnedFit>> bare, retarded;  // [scan][bin]
    std::vector<double> bare_rad, retarded_rad;          // analyser
};

std::string found_zones(const std::vector<double>& radians) {
    std::vector<std::string> words;
    for (const double a : radians) words.push_back(fmt::format("{:.6g}", a / degree));
    return words.empty() ? std::string("none") : fmt::format("{}", fmt::join(words, ", "));
}

// Two analyser azimuths that are neither parallel nor crossed leave source and polariser apart.
bool distinct_zones(const std::vector<double>& radians) {
    for (const double a : radians) {
        for (const double b : radians) {
            if (std::abs(std::sin(a - b)) > 0.3) return true;
        }
    }
    return false;
}

void add(WavelengthCurve* curve, double nm, double value) {
    curve->wavelength_nm.push_back(nm);
    curve->value.push_back(value);
}

}  // namespace

Calibration calibrate_straight_through(const std::vector<Scan>& scans,
                                       const SpectrometerInfo& spectrometer,
                                       const ReductionOptions& options,
                                       std::vector<std::string>* warnings) {
    StraightScans straight;
    for (const Scan& scan : scans) {
        if (scan.incidence_deg != 90) {
            user_error("the scan {} has a sample in the beam, expected straight-through scans",
                       scan_name(scan));
        }
        const ScanFit fit = fit_scan(scan, spectrometer, {}, options, warnings);
        (scan.retarder_in ? straight.retarded : straight.bare)
            .push_back(bin_fit(fit, spectrometer, {}, options));
        (scan.retarder_in ? straight.retarded_rad : straight.bare_rad)
            .push_back(scan.analyser_deg * degree);
    }
    if (!distinct_zones(straight.bare_rad)) {
        user_error(
            "straight through without the retarder the analyser stood at {} degrees, expected two "
            "or more zones such as 45 and -45",
            found_zones(straight.bare_rad));
    }
    // (1 + u cos 2P + v sin 2P)(1 + D cos 2(P - A - o)), o = P0 - A0, as a scan sees it: the mean
    // intensity holds (u, v) times the signal's coefficients, halved.
    const Model model = [](const double* x, double a, double* alpha, double* beta) {
        const double u = x[0], v = x[1], depth = x[2], axis = 2 * (a + x[3]);
        const double c = depth * std::cos(axis), s = depth * std::sin(axis);
        const double mean = 1 + (u * c + v * s) / 2;
        *alpha = (u + c) / mean;
        *beta = (v + s) / mean;
    };
    const std::vector<double> centres = bin_centres(options);
    Calibration calibration;
    WeightedMean offset;
    double chi2 = 0;
    int freedom = 0, failed = 0;
    for (size_t bin = 0; bin < centres.size(); ++bin) {
        const std::vector<BinnedFit> points = bin_of(straight.bare, bin);
        const double start[4] = {0, 0, 1, 0};
        const Fitted fit =
            points.empty() ? Fitted() : fit_model(model, 4, start, points, straight.bare_rad);
        if (!fit.good || !(std::hypot(fit.value[0], fit.value[1]) < 0.9) ||
            !(fit.value[2] > 0.1 && fit.value[2] <= 1.1)) {
            ++failed;
            continue;
        }
        // In the calibration's terms the source factor is 1 - s1 cos 2P - s2 sin 2P.
        add(&calibration.source_s1, centres[bin], -fit.value[0]);
        add(&calibration.source_s2, centres[bin], -fit.value[1]);
        add(&calibration.modulation_depth, centres[bin], fit.value[2]);
        offset.add(fit.value[3], fit.covariance[15]);
        chi2 += fit.chi2;
        freedom += fit.freedom;
    }
    if (offset.count == 0) {
        throw Error(Cause::answer_is_no,
                    fmt::format("no wavelength of the straight-through scans follows I0 (1 + D cos "
                                "2(P - A)); see that the arms are in line and the lamp is on"));
    }
    if (failed > 0) {
        warnings->push_back(fmt::format(
            "straight through: {} of {} bins left out, too dark or not of the expected shape; the "
            "curves are interpolated there",
            failed, centres.size()));
    }
    if (freedom > 0 && chi2 / freedom > 9) {
        warnings->push_back(
            fmt::format("straight through: the zones differ by {:.1f} times their noise; azimuths "
                        "of the mounts repeat no better than that",
                        std::sqrt(chi2 / freedom)));
    }
    calibration.polariser_offset_deg = offset.mean() / degree;
    calibration.polariser_offset_sigma_deg = offset.sigma() / degree;
    // The source was fitted against reported azimuths; the calibration's are from the polariser's
    // true zero, which is taken for the analyser's here.
    rotate_source(&calibration, calibration.polariser_offset_deg);
    calibration.provenance.emplace_back(
        "straight_through",
        fmt::format("{} scans, {} with the retarder", scans.size(), straight.retarded.size()));
    if (straight.retarded.empty()) return calibration;

    // With what is known by now the retarder is a sample of tan Psi = t and Delta = d.
    std::vector<std::vector<BinnedFit>> corrected;
    std::vector<std::string> said_before;
    for (const Scan& scan : scans) {
        if (!scan.retarder_in) continue;
        corrected.push_back(
            bin_fit(fit_scan(scan, spectrometer, calibration, options, &said_before), spectrometer,
                    calibration, options));
        if (std::abs(std::sin(2 * scan.analyser_deg * degree)) < 0.05) {
            user_error("the scan {} has its analyser along p or s, where a retarder is not seen",
                       scan_name(scan));
        }
    }
    int unclear = 0;
    for (size_t bin = 0; bin < centres.size(); ++bin) {
        std::vector<BinScan> members;
        const std::vector<BinnedFit> points = bin_of(corrected, bin);
        for (size_t i = 0; i < points.size(); ++i) {
            const int number = static_cast<int>(i);
            members.push_back({points[i], straight.retarded_rad[i], false, number, number});
        }
        if (members.empty()) continue;
        const PsiDelta pair = combine_scans(members, {}, {});
        if (pair.state != PsiDeltaState::good) {
            ++unclear;
            continue;
        }
        add(&calibration.retardance_deg, centres[bin], pair.delta / degree);
        add(&calibration.diattenuation, centres[bin], std::tan(pair.psi));
    }
    if (unclear > 0) {
        warnings->push_back(fmt::format(
            "straight through with the retarder: {} bins left out, |cos d| is not below 1; the "
            "retardance is interpolated there",
            unclear));
    }
    if (!calibration.retardance_deg.known()) {
        throw Error(Cause::answer_is_no,
                    "no wavelength of the straight-through scans with the retarder gives its "
                    "retardance; see that it stands in the beam with its fast axis along p");
    }
    return calibration;
}

void rotate_source(Calibration* calibration, double by_deg) {
    // 1 - s1 cos 2P - s2 sin 2P with P = P' + by.
    const double c = std::cos(2 * by_deg * degree), s = std::sin(2 * by_deg * degree);
    for (size_t i = 0; i < calibration->source_s1.value.size(); ++i) {
        double &s1 = calibration->source_s1.value[i], &s2 = calibration->source_s2.value[i];
        const double turned = c * s1 + s * s2;
        s2 = c * s2 - s * s1;
        s1 = turned;
    }
}

}  // namespace drude
