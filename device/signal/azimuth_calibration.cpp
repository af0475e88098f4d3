// The plane of incidence by the residual and phase methods.
#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/numbers.h"
#include "device/signal/bench_calibration.h"
#include "device/signal/calibration_fit.h"
#include "device/signal/harmonic_fit.h"
#include "device/signal/scan_readings.h"
#include "materials/scalar.h"

namespace drude {

namespace {

double square(double x) {
    return x * x;
}

}  // namespace

void calibrate_azimuth(const std::vector<Scan>& scans, const SpectrometerInfo& spectrometer,
                       const ReductionOptions& options, Calibration* calibration,
                       std::vector<std::string>* warnings) {
    std::vector<double> reported_rad;
    bool near_p = false, near_s = false;
    for (const Scan& scan : scans) {
        if (!(scan.incidence_deg > 0 && scan.incidence_deg < 90) || scan.retarder_in) {
            user_error(
                "the scan {} is of no use for the plane of incidence, expected a sample and "
                "no retarder",
                scan_name(scan));
        }
        const double a = scan.analyser_deg * degree;
        reported_rad.push_back(a);
        (std::abs(std::cos(a)) > std::abs(std::sin(a)) ? near_p : near_s) = true;
    }
    if (scans.size() < 3) {
        user_error(
            "found {} scans for the plane of incidence, expected three or more with the "
            "analyser about 0 or 90 degrees",
            scans.size());
    }
    // N = cos 2Psi, C = sin 2Psi cos Delta; a depolariser's are not those of a pair. Offsets o of
    // analyser and polariser are those that the calibration does not hold yet:
    //   alpha' = (cos 2x - N) / (1 - N cos 2x), beta' = C sin 2x / (1 - N cos 2x), x = A - o_A,
    // turned by the polariser's. 1 - alpha^2 - beta^2 is least at x = 0, and the phase crosses
    // that of the other window's there: one fit holds the residual and the phase method.
    const Model model = [](const double* x, double a, double* alpha, double* beta) {
        const double twice = 2 * (a - x[2]), turn = 2 * x[3];
        const double mean = 1 - x[0] * std::cos(twice);
        const double p = (std::cos(twice) - x[0]) / mean, s = x[1] * std::sin(twice) / mean;
        *alpha = p * std::cos(turn) - s * std::sin(turn);
        *beta = p * std::sin(turn) + s * std::cos(turn);
    };
    const std::vector<double> centres = bin_centres(options);
    WeightedMean analyser, polariser, sine2_delta;
    // The source's polarisation is divided out at azimuths that the first pass finds.
    for (int pass = 0; pass < 2; ++pass) {
        std::vector<std::string> said_before;
        std::vector<std::vector<BinnedFit>> fits;
        std::vector<double> analyser_rad;
        for (size_t i = 0; i < scans.size(); ++i) {
            fits.push_back(bin_fit(fit_scan(scans[i], spectrometer, *calibration, options,
                                            pass == 0 ? warnings : &said_before),
                                   spectrometer, *calibration, options));
            analyser_rad.push_back(reported_rad[i] - calibration->analyser_offset_deg * degree);
        }
        analyser = polariser = sine2_delta = {};
        for (size_t bin = 0; bin < centres.size(); ++bin) {
            const std::vector<BinnedFit> points = bin_of(fits, bin);
            if (points.empty()) continue;
            Fitted best;
            for (const double cosine : {-0.5, 0.5}) {
                const double start[4] = {0.05, cosine, 0, 0};
                const Fitted fit = fit_model(model, 4, start, points, analyser_rad);
                const bool sample = fit.good && std::hypot(fit.value[0], fit.value[1]) < 1.05;
                if (!sample || std::abs(fit.value[2]) > 0.5) continue;
                if (!best.good || fit.chi2 < best.chi2) best = fit;
            }
            if (!best.good) continue;
            const double scatter = best.freedom > 0 ? std::max(1.0, best.chi2 / best.freedom) : 1.0;
            analyser.add(best.value[2], best.covariance[10] * scatter);
            polariser.add(best.value[3], best.covariance[15] * scatter);
            const double rest = 1 - square(best.value[0]);
            sine2_delta.add(std::clamp(1 - square(best.value[1]) / rest, 0.0, 1.0),
                            best.covariance[10]);
        }
        if (analyser.count == 0) {
            throw Error(
                Cause::answer_is_no,
                "no wavelength of the scans about the plane of incidence gives an azimuth; "
                "see that a sample is in the beam and the analyser within 30 degrees of it");
        }
        calibration->analyser_offset_deg += analyser.mean() / degree;
        calibration->polariser_offset_deg += polariser.mean() / degree;
        rotate_source(calibration, polariser.mean() / degree);
    }
    const double sine = std::sqrt(sine2_delta.mean());
    const bool phase = sine < 0.5;
    if (phase && !(near_p && near_s)) {
        warnings->push_back(fmt::format(
            "Delta is within {:.0f} degrees of 0 or 180 where the residual method is blunt: step "
            "the analyser about 0 and about 90 degrees, whose phases cross at the azimuth",
            std::ceil(std::asin(std::min(1.0, sine)) / degree)));
    }
    calibration->analyser_offset_sigma_deg = analyser.sigma() / degree;
    calibration->polariser_offset_sigma_deg = polariser.sigma() / degree;
    calibration->provenance.emplace_back(
        "azimuth", fmt::format("{} method, {} scans, {} wavelengths", phase ? "phase" : "residual",
                               scans.size(), analyser.count));
}

}  // namespace drude
