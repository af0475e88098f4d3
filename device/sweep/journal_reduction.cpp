#include "device/sweep/journal_reduction.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/numbers.h"
#include "device/signal/bench_calibration.h"
#include "device/sweep/journal_scans.h"

namespace drude {

namespace {

using Header = std::vector<std::pair<std::string, std::string>>;

ReductionOptions reduction_options(const JournalHeader& header,
                                   const JournalReductionOptions& options) {
    ReductionOptions result;
    const Recipe& recipe = header.recipe;
    const bool own = options.last_nm > 0;
    result.first_nm = own ? options.first_nm : recipe.first_nm;
    result.last_nm = own ? options.last_nm : recipe.last_nm;
    result.step_nm = own ? options.step_nm : recipe.step_nm;
    result.harmonic_4 = recipe.harmonic_4;
    result.drift = recipe.drift;
    result.mount_repeatability_deg = header.mount_repeatability_deg;
    result.analyser_repeatability_deg = header.analyser_repeatability_deg;
    result.relative_floor = recipe.kind == RecipeKind::lobe ? recipe.relative_floor : 0;
    return result;
}

Header make_file_header(const Journal& journal, const JournalReductionOptions& options) {
    const JournalHeader& from = *journal.header;
    Header header;
    const auto add = [&](const char* key, const std::string& value) {
        if (!value.empty()) header.emplace_back(key, value);
    };
    add("sample", from.recipe.sample);
    header.insert(header.end(), from.notes.begin(), from.notes.end());
    add("parts", from.bench_description);
    add("date", from.started);
    add("software", "drude " DRUDE_VERSION);
    add("recipe_sha256", journal.recipe_sha256);
    add("journal", options.journal_name);
    add("journal_sha256", options.journal_sha256);
    add("calibration", options.calibration_name.empty() ? "none" : options.calibration_name);
    std::vector<std::string> times;
    for (const JournalExposure& exposure : journal.exposures) {
        times.push_back(format_double(exposure.integration_s));
    }
    add("integration_s", fmt::format("{}", fmt::join(times, ", ")));
    add("retries", std::to_string(journal.retries()));
    add("sessions", std::to_string(journal.resumes.size() + 1));
    return header;
}

void add_quality(const Reduction& reduction, Header* header) {
    ScanQuality worst;
    double squares = 0;
    for (const ScanQuality& scan : reduction.quality) {
        worst.harmonic_4 = std::max(worst.harmonic_4, scan.harmonic_4);
        worst.drift = std::max(worst.drift, std::abs(scan.drift));
        worst.step_jitter_deg = std::max(worst.step_jitter_deg, scan.step_jitter_deg);
        worst.saturated += scan.saturated;
        squares += scan.residual_over_noise * scan.residual_over_noise;
    }
    const double count = std::max<double>(1, static_cast<double>(reduction.quality.size()));
    header->emplace_back(
        "quality",
        fmt::format("harmonic_4 {:.2g} drift {:.2g} residual_over_noise {:.3f} step_jitter_deg "
                    "{:.2g} saturated {} (largest of {} scans; residuals rms; readings left out)",
                    worst.harmonic_4, worst.drift, std::sqrt(squares / count),
                    worst.step_jitter_deg, worst.saturated, reduction.quality.size()));
    std::vector<std::string> common;
    for (size_t i = 0; i < reduction.angles_deg.size(); ++i) {
        common.push_back(fmt::format("{}: {} {}", format_double(reduction.angles_deg[i]),
                                     format_double(reduction.common_sigma_psi_deg[i]),
                                     format_double(reduction.common_sigma_delta_deg[i])));
    }
    header->emplace_back("sigma_common_deg",
                         fmt::format("{} (angle: psi delta; shared by all wavelengths of an angle, "
                                     "not in sigma_psi_deg and sigma_delta_deg)",
                                     fmt::join(common, "; ")));
}

void add_warnings(const std::vector<std::string>& warnings, Header* header) {
    for (const std::string& warning : warnings) header->emplace_back("warning", warning);
}

void finish_measurement(Header header, std::vector<MeasurementRow> rows, JournalReduction* result) {
    add_warnings(result->warnings, &header);
    Measurement measurement;
    measurement.header = std::move(header);
    measurement.rows = std::move(rows);
    result->rows = measurement.rows.size();
    result->text = format_measurement(measurement);
}

// What an instrument returned that reduces its own signal.
void collect_rows(const Journal& journal, const ReductionOptions& options, Header header,
                  JournalReduction* result) {
    std::vector<MeasurementRow> rows;
    for (const JournalRows& angle : journal.rows) {
        for (const MeasurementRow& row : angle.rows) {
            if (row.wavelength_nm >= options.first_nm && row.wavelength_nm <= options.last_nm) {
                rows.push_back(row);
            }
        }
    }
    std::stable_sort(rows.begin(), rows.end(), [](const auto& a, const auto& b) {
        return a.wavelength_nm < b.wavelength_nm;
    });
    if (rows.empty()) {
        user_error("the instrument returned nothing from {} to {} nm",
                   format_double(options.first_nm), format_double(options.last_nm));
    }
    finish_measurement(std::move(header), std::move(rows), result);
}

void reduce_to_calibration(const Journal& journal, const std::vector<Scan>& scans,
                           const ReductionOptions& options, Calibration calibration,
                           const Header& header, JournalReduction* result) {
    const SpectrometerInfo& info = journal.header->spectrometer;
    if (journal.header->recipe.kind == RecipeKind::straight_through) {
        calibration = calibrate_straight_through(scans, info, options, &result->warnings);
    } else {
        calibrate_azimuth(scans, info, options, &calibration, &result->warnings);
    }
    for (const auto& [key, value] : header) {
        if (key == "instrument" || key == "date" || key == "journal" || key == "journal_sha256") {
            calibration.provenance.emplace_back(key, value);
        }
    }
    result->text = format_calibration(calibration);
}

void reduce_lobe(const Journal& journal, const ReductionOptions& options, Header header,
                 JournalReduction* result) {
    const Recipe& recipe = journal.header->recipe;
    const std::vector<LobeReading> readings =
        lobe_readings_of(journal, result->noise, &result->warnings);
    LobeScan scan = reduce_lobe_readings(readings, journal.header->spectrometer, options,
                                         recipe.detector_solid_angle_sr,
                                         recipe.detector_half_angle_deg, &result->warnings);
    add_warnings(result->warnings, &header);
    scan.header.insert(scan.header.begin(), header.begin(), header.end());
    result->rows = scan.rows.size();
    result->text = format_lobe_scan(scan);
}

}  // namespace

JournalReduction reduce_journal(const Journal& journal, const JournalReductionOptions& options) {
    if (!journal.header) user_error("the journal holds nothing: the sweep was stopped at once");
    const JournalHeader& from = *journal.header;
    JournalReduction result;
    result.warnings = from.warnings;
    for (const JournalEvent& event : journal.events) {
        if (event.kind == "warning") result.warnings.push_back(event.text);
    }
    const ReductionOptions reduction = reduction_options(from, options);
    Header header = make_file_header(journal, options);
    if (!from.has_spectrometer) {
        collect_rows(journal, reduction, std::move(header), &result);
        return result;
    }
    result.noise = fit_noise_model(journal);
    if (from.recipe.kind == RecipeKind::lobe) {
        reduce_lobe(journal, reduction, std::move(header), &result);
        return result;
    }
    const std::vector<Scan> scans = scans_of(journal, result.noise, &result.warnings);
    if (scans.empty()) {
        user_error(
            "the journal holds {} of {} points, and no angle is complete: go on with the "
            "sweep (--resume) first",
            journal.points.size(), journal.plan.size());
    }
    if (from.recipe.kind != RecipeKind::psi_delta) {
        reduce_to_calibration(journal, scans, reduction, options.calibration, header, &result);
        return result;
    }
    if (options.calibration_name.empty() && options.calibration.provenance.empty()) {
        result.warnings.emplace_back(
            "the bench is not calibrated: what the source's polarisation and azimuths that are off "
            "add to Psi and Delta is in no standard deviation; capture --kind straight-through, "
            "then --kind azimuth, and reduce the journal again with --calibration");
    }
    if (result.noise.light_readings == 0) {
        result.warnings.emplace_back(
            "one frame a step and no two steps half a turn apart: nothing tells the noise of the "
            "light, and the standard deviations hold that of the dark alone, which is several "
            "times less; measure with 2 frames a step or more, or with an even number of steps");
    }
    result.reduction = reduce_scans(scans, from.spectrometer, options.calibration, reduction);
    const auto& own = result.reduction.warnings;
    result.warnings.insert(result.warnings.end(), own.begin(), own.end());
    add_quality(result.reduction, &header);
    finish_measurement(std::move(header), result.reduction.rows, &result);
    return result;
}

}  // namespace drude
