#include "device/signal/reduction.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "base/error.h"
#include "base/numbers.h"
#include "device/signal/harmonic_fit.h"
#include "device/signal/psi_delta.h"
#include "device/signal/scan_readings.h"
#include "device/signal/wavelength_bins.h"
#include "materials/scalar.h"

namespace drude {

namespace {

// Coherence above 1 is what no sample does: from here on the bench is not what it is taken for.
constexpr double coherence_excess = 0.02;

struct AngleScans {
    std::vector<size_t> scans;
    double common_psi = 0, common_delta = 0;  // sums of squares
    int rows = 0, unusable = 0, impossible = 0, clamped = 0, half_wave = 0, excess = 0, faint = 0;
    int lower_half = 0;  // rows with Delta above 180 degrees
    bool retarder = false;
};

void check(const std::vector<Scan>& scans, const Calibration& calibration,
           const ReductionOptions& options) {
    if (scans.empty()) user_error("found no scan to reduce");
    for (const double sigma :
         {options.mount_repeatability_deg, options.analyser_repeatability_deg}) {
        if (!(sigma >= 0 && sigma < 45)) {
            user_error("found a mount's repeatability of {} degrees, expected 0 to 45",
                       format_double(sigma));
        }
    }
    calibration.check("calibration");
    for (const Scan& scan : scans) {
        if (!(scan.incidence_deg > 0 && scan.incidence_deg < 90)) {
            user_error(
                "the scan {} has no sample in the beam; straight-through scans are for "
                "calibration, expected an angle of incidence above 0 and below 90 degrees",
                scan_name(scan));
        }
        const double twice = 2 * (scan.analyser_deg - calibration.analyser_offset_deg) * degree;
        if (!(std::abs(std::sin(twice)) > 0.05)) {
            user_error(
                "the scan {} has its analyser along p or s, where Delta cannot be seen; expected "
                "zones such as 45 and -45 degrees",
                scan_name(scan));
        }
    }
}

// Scans with equal darks share their noise: they have one number.
std::vector<int> dark_numbers(const std::vector<Scan>& scans, const std::vector<size_t>& members) {
    std::vector<int> numbers;
    std::vector<size_t> first;
    for (const size_t i : members) {
        const auto same = std::find_if(first.begin(), first.end(), [&](size_t other) {
            return scans[other].dark == scans[i].dark;
        });
        numbers.push_back(static_cast<int>(same - first.begin()));
        if (same == first.end()) first.push_back(i);
    }
    return numbers;
}

// Each time that the analyser came to stand somewhere: scans are in the order of the measurement,
// and a mount that is asked for the place where it is does not move.
std::vector<int> analyser_stops(const std::vector<Scan>& scans,
                                const std::vector<size_t>& members) {
    std::vector<int> stops;
    for (size_t g = 0; g < members.size(); ++g) {
        const bool moved =
            g == 0 || scans[members[g]].analyser_deg != scans[members[g - 1]].analyser_deg;
        stops.push_back((g == 0 ? -1 : stops.back()) + (moved ? 1 : 0));
    }
    return stops;
}

void warn(const std::map<double, AngleScans>& angles, const Calibration& calibration,
          std::vector<std::string>* warnings) {
    std::vector<std::string> one_cycle;
    bool retarder = false;
    int rows = 0, lower = 0;
    for (const auto& [angle, group] : angles) {
        const auto say = [&, at = angle](int count, const char* what) {
            if (count > 0) {
                warnings->push_back(fmt::format("at {} degrees {} {} {}", format_double(at), count,
                                                count == 1 ? "bin" : "bins", what));
            }
        };
        say(group.unusable,
            "left out: in a scan no pixels that are neither dark nor saturated surround the "
            "centre");
        say(group.impossible,
            "left out: |cos Delta| or |alpha| is above 1 by more than noise; see to the azimuths "
            "and the linearity");
        say(group.half_wave, "left out: the retarder is within 6 degrees of a half or full wave");
        say(group.clamped, "with |cos Delta| above 1 by noise, Delta set to 0 or 180 degrees");
        say(group.faint,
            "with Psi so near 0 or 90 degrees that noise reaches it; their standard deviations are "
            "too small");
        say(group.excess,
            "more coherent than any sample by over 2 %; see to the retarder's calibration and the "
            "linearity");
        if (!group.retarder) one_cycle.push_back(format_double(angle));
        retarder = retarder || group.retarder;
        rows += group.retarder ? group.rows : 0;
        lower += group.lower_half;
    }
    if (!one_cycle.empty()) {
        warnings->push_back(
            fmt::format("no scan with the retarder at {} degrees: Delta is taken between 0 and "
                        "180 degrees, as that of a bare metal",
                        fmt::join(one_cycle, ", ")));
    }
    if (retarder && !calibration.retardance_deg.known()) {
        warnings->push_back(
            "the calibration does not hold the retarder: it is taken for a quarter-wave plate that "
            "tells Delta above 180 degrees from below, nothing else (capture --kind "
            "straight-through)");
    }
    if (rows > 0 && lower == rows) {
        warnings->push_back(
            "Delta is above 180 degrees everywhere, as no bare metal's is: the retarder may stand "
            "with its slow axis along p");
    }
}

}  // namespace

Reduction reduce_scans(const std::vector<Scan>& scans, const SpectrometerInfo& spectrometer,
                       const Calibration& calibration, const ReductionOptions& options) {
    check(scans, calibration, options);
    Reduction result;
    std::vector<std::vector<BinnedFit>> fits;
    std::map<double, AngleScans> angles;
    for (size_t i = 0; i < scans.size(); ++i) {
        const ScanFit fit =
            fit_scan(scans[i], spectrometer, calibration, options, &result.warnings);
        fits.push_back(bin_fit(fit, spectrometer, calibration, options));
        result.quality.push_back(fit.quality);
        AngleScans& group = angles[scans[i].incidence_deg];
        group.scans.push_back(i);
        group.retarder = group.retarder || scans[i].retarder_in;
    }
    for (const auto& [angle, group] : angles) {
        if (std::all_of(group.scans.begin(), group.scans.end(),
                        [&](size_t i) { return scans[i].retarder_in; })) {
            user_error(
                "at {} degrees all scans have the retarder in the beam, expected one without it",
                format_double(angle));
        }
    }
    std::map<double, std::vector<int>> darks, stops;
    for (const auto& [angle, group] : angles) {
        darks[angle] = dark_numbers(scans, group.scans);
        stops[angle] = analyser_stops(scans, group.scans);
    }
    const AzimuthErrors errors = {options.mount_repeatability_deg * degree,
                                  options.analyser_repeatability_deg * degree,
                                  calibration.polariser_offset_sigma_deg * degree,
                                  calibration.analyser_offset_sigma_deg * degree};
    const std::vector<double> centres = bin_centres(options);
    for (size_t bin = 0; bin < centres.size(); ++bin) {
        const double nm = centres[bin];
        const RetarderState retarder = {calibration.retardance_deg.known(),
                                        calibration.retardance_deg.at(nm, 90) * degree,
                                        calibration.diattenuation.at(nm, 1)};
        for (auto& [angle, group] : angles) {
            std::vector<BinScan> members;
            bool usable = true;
            for (size_t g = 0; g < group.scans.size(); ++g) {
                const Scan& scan = scans[group.scans[g]];
                usable = usable && fits[group.scans[g]][bin].usable;
                members.push_back({fits[group.scans[g]][bin],
                                   (scan.analyser_deg - calibration.analyser_offset_deg) * degree,
                                   scan.retarder_in, darks[angle][g], stops[angle][g]});
            }
            if (!usable) {
                ++group.unusable;
                continue;
            }
            const PsiDelta pair = combine_scans(members, retarder, errors);
            if (pair.state == PsiDeltaState::impossible || pair.state == PsiDeltaState::half_wave) {
                ++(pair.state == PsiDeltaState::impossible ? group.impossible : group.half_wave);
                continue;
            }
            if (pair.state == PsiDeltaState::clamped) ++group.clamped;
            if (pair.faint) ++group.faint;
            MeasurementRow row;
            row.wavelength_nm = nm;
            row.angle_deg = angle;
            row.psi_deg = pair.psi / degree;
            row.delta_deg = pair.delta / degree;
            row.sigma_psi_deg = std::sqrt(pair.noise.aa) / degree;
            row.sigma_delta_deg = std::sqrt(pair.noise.bb) / degree;
            if (pair.two_cycles) {
                const double sine = std::sin(2 * pair.psi);
                row.depolarization = std::clamp(sine * sine * (1 - pair.coherence), 0.0, 1.0);
                if (pair.coherence > 1 + coherence_excess) ++group.excess;
            }
            ++group.rows;
            if (pair.delta > pi) ++group.lower_half;
            group.common_psi += pair.common.aa;
            group.common_delta += pair.common.bb;
            result.rows.push_back(row);
            result.covariance_psi_delta.push_back(pair.noise.ab / (degree * degree));
        }
    }
    for (const auto& [angle, group] : angles) {
        const double count = std::max(1, group.rows);
        result.angles_deg.push_back(angle);
        result.common_sigma_psi_deg.push_back(std::sqrt(group.common_psi / count) / degree);
        result.common_sigma_delta_deg.push_back(std::sqrt(group.common_delta / count) / degree);
    }
    warn(angles, calibration, &result.warnings);
    if (result.rows.empty()) {
        throw Error(Cause::answer_is_no, fmt::format("no Psi and Delta follow from the scans: {}",
                                                     fmt::join(result.warnings, "; ")));
    }
    return result;
}

}  // namespace drude
