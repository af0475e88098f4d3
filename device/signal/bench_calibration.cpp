#include "device/signal/bench_calibration.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "base/error.h"
#include "base/numbers.h"
#include "device/signal/harmonic_fit.h"
#include "device/signal/psi_delta.h"
#include "device/signal/wavelength_bins.h"
#include "materials/scalar.h"

namespace drude {

namespace {

constexpr double degree = pi / 180;

double square(double x) {
    return x * x;
}

// What a model says alpha and beta of a scan are; the parameters are at most 4.
using Model =
    std::function<void(const double* parameters, double analyser_rad, double* alpha, double* beta)>;

struct Fitted {
    bool good = false;
    double value[4] = {};
    double covariance[16] = {};  // of the scans' noise
    double chi2 = 0;
    int freedom = 0;
};

// Gauss-Newton on alpha and beta of all scans of a bin; the derivatives by central differences of
// functions that are smooth and of order 1.
Fitted fit_model(const Model& model, int parameters, const double* start,
                 const std::vector<BinnedFit>& points, const std::vector<double>& analyser_rad) {
    Fitted fit;
    std::copy(start, start + parameters, fit.value);
    fit.freedom = 2 * static_cast<int>(points.size()) - parameters;
    if (fit.freedom < 0) return fit;
    for (int iteration = 0; iteration < 50; ++iteration) {
        double matrix[16] = {}, right[4] = {};
        fit.chi2 = 0;
        for (size_t i = 0; i < points.size(); ++i) {
            double alpha, beta, slope[2][4];
            model(fit.value, analyser_rad[i], &alpha, &beta);
            for (int m = 0; m < parameters; ++m) {
                constexpr double step = 1e-6;
                double moved[4], above[2], below[2];
                std::copy(fit.value, fit.value + 4, moved);
                moved[m] += step;
                model(moved, analyser_rad[i], &above[0], &above[1]);
                moved[m] -= 2 * step;
                model(moved, analyser_rad[i], &below[0], &below[1]);
                for (int c = 0; c < 2; ++c) slope[c][m] = (above[c] - below[c]) / (2 * step);
            }
            // Where there is no noise, all count alike.
            const double floor = 1e-18;
            const Covariance& n = points[i].noise;
            const double aa = n.aa + floor, bb = n.bb + floor;
            const double determinant = aa * bb - n.ab * n.ab;
            const double weight[2][2] = {{bb / determinant, -n.ab / determinant},
                                         {-n.ab / determinant, aa / determinant}};
            const double residual[2] = {points[i].alpha - alpha, points[i].beta - beta};
            for (int c = 0; c < 2; ++c) {
                for (int e = 0; e < 2; ++e) {
                    fit.chi2 += residual[c] * weight[c][e] * residual[e];
                    for (int m = 0; m < parameters; ++m) {
                        right[m] += slope[c][m] * weight[c][e] * residual[e];
                        for (int k = 0; k < parameters; ++k) {
                            matrix[m * parameters + k] += slope[c][m] * weight[c][e] * slope[e][k];
                        }
                    }
                }
            }
        }
        if (!solve_normal_equations(parameters, matrix, right)) return fit;
        double change = 0;
        for (int m = 0; m < parameters; ++m) {
            fit.value[m] += right[m];
            change = std::max(change, std::abs(right[m]));
            if (!std::isfinite(fit.value[m])) return fit;
        }
        std::copy(matrix, matrix + parameters * parameters, fit.covariance);
        if (change < 1e-11) {
            fit.good = true;
            return fit;
        }
    }
    return fit;
}

// The weighted mean of angles that lie near each other, with its sigma from their own and, where
// they scatter more than these say, from the scatter.
struct WeightedMean {
    double weight = 0, sum = 0, squares = 0;
    int count = 0;

    void add(double value, double variance) {
        const double w = 1 / (variance + 1e-24);
        weight += w;
        sum += w * value;
        squares += w * value * value;
        ++count;
    }
    double mean() const { return sum / weight; }
    double sigma() const {
        const double scatter =
            count > 1 ? std::max(0.0, squares - sum * mean()) / (count - 1) : 1.0;
        return std::sqrt(std::max(1.0, scatter) / weight);
    }
};

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

std::vector<BinnedFit> bin_of(const std::vector<std::vector<BinnedFit>>& scans, size_t bin) {
    std::vector<BinnedFit> points;
    for (const auto& scan : scans) {
        if (scan[bin].usable) points.push_back(scan[bin]);
    }
    return points.size() == scans.size() ? points : std::vector<BinnedFit>{};
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
            members.push_back({points[i], straight.retarded_rad[i], false, static_cast<int>(i)});
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
