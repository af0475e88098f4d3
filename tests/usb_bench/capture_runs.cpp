#include "usb_bench/capture_runs.h"

#include <fmt/format.h>
#include <sys/wait.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>

#include "base/error.h"
#include "base/files.h"
#include "device/sweep/journal_reduction.h"
#include "device/virtual/ellipsometer_simulation.h"

namespace drude {

// 20 ms are long against what the host does between two frames, so that how many stale frames there
// are does not depend on how busy the machine is.
const char* const short_recipe = R"({"format": "drude-recipe/1", "sample": "Cu-McPeak",
 "angles_deg": [70], "steps": 3, "cycles": 1, "zones_deg": [45], "averages": 1, "dark_frames": 1,
 "integration_s": 0.02, "harmonic_4": false, "drift": false, "shuffle": true, "seed": 1,
 "first_nm": 400, "last_nm": 780, "step_nm": 20}
)";

namespace {

constexpr double same_deg = 1e-9;

// Full scale well above 20 ms of the sample's light; everything else a bench without faults.
constexpr const char* settings = R"({"pixels": 3840, "first_nm": 340, "last_nm": 859.8006,
 "full_scale_s": 0.03, "dark_counts": 1500})";

// The virtual STS gets its dispersion from usb-bench.
constexpr const char* small_settings = R"({"pixels": 1024, "first_nm": 340, "last_nm": 851.5,
 "max_counts": 16383, "full_scale_s": 0.03, "dark_counts": 400})";

// Every wait of a silent head ends well before the watchdog of a cell.
constexpr const char* head_bench = R"({"format": "drude-bench/1",
 "head": "usbtmc:1209:5e11:TMC0001", "scpi": {"move_s": 3, "measure_s": 3}})";

struct BenchDevices {
    const char *devices, *instrument, *settings;
};

BenchDevices devices_of(CaptureBench bench) {
    switch (bench) {
        case CaptureBench::small:
            return {"--device obp:STS00001 --device ell:DK0AELL1 --fixed-analyser 45", "bench.json",
                    small_settings};
        case CaptureBench::head:
            return {"--device usbtmc:TMC0001", "head.json", settings};
        case CaptureBench::full:
            break;
    }
    return {
        "--device ooi:USB4C00001 --device ell:DK0AELL1 --device apt-sample:55000001 "
        "--device apt-arm:55000002",
        "bench.json", settings};
}

std::string text_of(const std::string& path) {
    return std::filesystem::exists(path) ? read_file(path) : "";
}

// The first line with which drude itself ends, which names what failed.
std::string error_line(const std::string& text) {
    std::istringstream stream(text);
    std::string line, last;
    while (std::getline(stream, line)) {
        if (line.rfind("drude: ", 0) == 0) last = line;
    }
    return last;
}

const JournalPoint* point_of(const Journal& journal, uint32_t index) {
    for (const JournalPoint& point : journal.points) {
        if (point.index == index) return &point;
    }
    return nullptr;
}

bool is_saturated(const std::vector<Frame>& frames, uint32_t max_counts) {
    return std::any_of(frames.begin(), frames.end(), [&](const Frame& frame) {
        return std::find(frame.counts.begin(), frame.counts.end(), max_counts) !=
               frame.counts.end();
    });
}

// The truth as it would have been measured with the readings that were at full scale in `result`:
// no noise, so what is left of it must come out the same.
std::vector<MeasurementRow> masked_truth(const CaptureResult& truth, const CaptureResult& result) {
    Journal journal = truth.journal;
    const uint32_t max_counts = journal.header->spectrometer.max_counts;
    for (JournalPoint& point : journal.points) {
        const JournalPoint* ours = point_of(result.journal, point.index);
        if (ours == nullptr) continue;
        for (size_t k = 0; k < std::min(point.frames.size(), ours->frames.size()); ++k) {
            for (size_t i = 0; i < point.frames[k].counts.size(); ++i) {
                if (ours->frames[k].counts[i] >= max_counts) {
                    point.frames[k].counts[i] = max_counts;
                }
            }
        }
    }
    return parse_measurement(reduce_journal(journal, {}).text, "masked truth").rows;
}

void compare_rows(const std::vector<MeasurementRow>& truth, const std::vector<MeasurementRow>& rows,
                  const char* name, std::vector<std::string>* troubles) {
    for (const MeasurementRow& row : rows) {
        const auto same = std::find_if(
            truth.begin(), truth.end(),
            [&](const MeasurementRow& other) { return other.wavelength_nm == row.wavelength_nm; });
        if (same == truth.end()) {
            troubles->push_back(
                fmt::format("a row at {} nm, which {} has not", row.wavelength_nm, name));
            return;
        }
        const double off = std::max(std::abs(row.psi_deg - same->psi_deg),
                                    std::abs(row.delta_deg - same->delta_deg));
        if (!(off <= same_deg)) {
            troubles->push_back(fmt::format("Psi or Delta at {} nm is {} degrees from {}",
                                            row.wavelength_nm, off, name));
        }
    }
}

// A bin that lost pixels is read from those nearer to its centre: that must not take it farther
// from the sample than the bend of the spectrum over the whole bin does, but for the rounding of
// counts.
void compare_with_sample(const std::vector<MeasurementRow>& whole,
                         const std::vector<MeasurementRow>& rows,
                         std::vector<std::string>* troubles) {
    std::vector<double> wavelengths;
    for (const MeasurementRow& row : whole) wavelengths.push_back(row.wavelength_nm);
    const Measurement sample =
        simulate_ellipsometer(find_material("Cu-McPeak"), {{70}, wavelengths, 0, 0, 1});
    for (const MeasurementRow& row : rows) {
        for (size_t i = 0; i < whole.size(); ++i) {
            const MeasurementRow& exact = sample.rows[i];
            if (whole[i].wavelength_nm != row.wavelength_nm) continue;
            const double psi = std::abs(row.psi_deg - exact.psi_deg);
            const double delta = std::abs(row.delta_deg - exact.delta_deg);
            if (psi <= std::abs(whole[i].psi_deg - exact.psi_deg) + 5 * row.sigma_psi_deg &&
                delta <= std::abs(whole[i].delta_deg - exact.delta_deg) + 5 * row.sigma_delta_deg) {
                continue;
            }
            troubles->push_back(
                fmt::format("at {} nm Psi is {} and Delta {} degrees from the sample",
                            row.wavelength_nm, psi, delta));
        }
    }
}

void compare(const CaptureResult& truth, CaptureResult* result) {
    const auto trouble = [&](const std::string& text) { result->troubles.push_back(text); };
    if (!result->journal.complete) trouble("the journal is not complete");
    if (!truth.journal.header->has_spectrometer) {
        if (result->measurement.rows.size() != truth.measurement.rows.size()) {
            return trouble(fmt::format("{} rows", result->measurement.rows.size()));
        }
        for (size_t i = 0; i < truth.measurement.rows.size(); ++i) {
            const MeasurementRow &ours = result->measurement.rows[i],
                                 &theirs = truth.measurement.rows[i];
            if (ours.psi_deg == theirs.psi_deg && ours.delta_deg == theirs.delta_deg) continue;
            trouble(fmt::format("Psi or Delta at {} nm differs", theirs.wavelength_nm));
        }
        return;
    }
    const uint32_t max_counts = truth.journal.header->spectrometer.max_counts;
    for (const JournalDark& dark : result->journal.darks) {
        if (is_saturated(dark.frames, max_counts)) trouble("a dark is saturated");
    }
    bool saturated = false;
    for (uint32_t i = 0; i < truth.journal.plan.size(); ++i) {
        const JournalPoint *ours = point_of(result->journal, i),
                           *theirs = point_of(truth.journal, i);
        if (ours == nullptr || theirs == nullptr) {
            trouble(fmt::format("point {} is missing", i));
            return;
        }
        if (is_saturated(ours->frames, max_counts)) {
            saturated = true;
            continue;
        }
        if (ours->frames.size() != theirs->frames.size()) {
            trouble(fmt::format("point {} has {} frames", i, ours->frames.size()));
            continue;
        }
        for (size_t k = 0; k < ours->frames.size(); ++k) {
            if (ours->frames[k].counts != theirs->frames[k].counts) {
                trouble(fmt::format("frame {} of point {} differs", k, i));
            }
        }
    }
    const auto& rows = result->measurement.rows;
    const auto& true_rows = truth.measurement.rows;
    // Three azimuths are needed: wavelengths of a saturated part of a frame are left out, and a
    // bin at its edge is read from fewer pixels.
    const std::vector<MeasurementRow> expected =
        saturated ? masked_truth(truth, *result) : true_rows;
    if (rows.size() != expected.size()) {
        trouble(fmt::format("{} rows instead of {}", rows.size(), expected.size()));
        return;
    }
    compare_rows(expected, rows, "what these readings give", &result->troubles);
    if (saturated) compare_with_sample(true_rows, rows, &result->troubles);
}

}  // namespace

CaptureResult run_capture_cell(const std::string& build, const std::string& folder,
                               const CaptureCell& cell, const CaptureResult* reference) {
    std::filesystem::remove_all(folder);
    make_folder(folder);
    const auto file = [&](const std::string& name) { return folder + "/" + name; };
    write_file(file("recipe.json"), short_recipe);
    const BenchDevices bench = devices_of(cell.bench);
    write_file(file("settings.json"), bench.settings);
    write_file(file("head.json"), head_bench);
    std::string faults;
    std::istringstream words(cell.faults);
    for (std::string word; words >> word;) faults += " --fault " + word;
    const auto capture = [&](const std::string& more, const std::string& errors) {
        return fmt::format(
            "sh -c 'exec \"{}/drude\" capture recipe.json --instrument {} -o m.csv --json "
            "--wait {} {} > {}.json 2> {}'",
            build, bench.instrument, cell.wait_s, more, errors, errors);
    };
    const std::string command = fmt::format(
        "cd '{}' && '{}/usb-bench' {} --settings "
        "settings.json --bench-out bench.json --report report.json --answers "
        "answers.txt{} -- {} --on-failure {} > bench.out 2>&1 < /dev/null",
        folder, build, bench.devices, faults, capture("", "first.err"),
        capture("--resume", "second.err"));
    const int raw = std::system(command.c_str());

    CaptureResult result;
    result.answer_list = text_of(file("answers.txt"));
    const std::string report_text = text_of(file("report.json"));
    if (report_text.empty()) {
        result.troubles.push_back(
            fmt::format("usb-bench ended with {}: {}", raw, text_of(file("bench.out"))));
        return result;
    }
    const nlohmann::json report = nlohmann::json::parse(report_text);
    result.status = report["status"];
    result.status_of_second = report.value("status_of_second", -1);
    result.answers = report["answers"];
    result.applied = report["faults_applied"];
    for (const auto& trouble : report["troubles"]) result.troubles.push_back(trouble);
    const std::string errors = text_of(file("first.err"));
    if (result.status != 0) result.error_line = error_line(errors);
    const int last = result.status_of_second >= 0 ? result.status_of_second : result.status;
    if (last != 0) {
        result.troubles.push_back(
            fmt::format("{} instead of a result: {}", last,
                        result.status_of_second >= 0 ? text_of(file("second.err")) : errors));
        return result;
    }
    try {
        result.measurement = read_measurement(file("m.csv"));
        result.journal = read_journal(file("m.journal"));
        result.retries = result.journal.retries();
        if (reference != nullptr) compare(*reference, &result);
    } catch (const Error& error) {
        result.troubles.push_back(error.message());
    }
    return result;
}

}  // namespace drude
