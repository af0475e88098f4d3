#include <filesystem>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/files.h"
#include "device/instruments/registry.h"
#include "device/sweep/bench_file.h"
#include "device/sweep/goniometers.h"

namespace drude {

namespace {

using nlohmann::ordered_json;

constexpr uint64_t largest_bench_file = uint64_t{1} << 20;

// The clock of the machine outlives every bench.
std::shared_ptr<BenchClock> machine_clock() {
    return {&real_clock(), [](BenchClock*) {}};
}

ordered_json identity(const Rotator& rotator) {
    return {{"uri", rotator.info().uri},
            {"model", rotator.info().model},
            {"serial", rotator.info().serial}};
}

Azimuth open_azimuth(const AxisSetting& setting, ordered_json* description) {
    Azimuth azimuth;
    azimuth.zero_deg = setting.zero_deg;
    azimuth.direction = setting.direction;
    azimuth.fixed_deg = setting.fixed_deg;
    if (setting.rotator.empty()) {
        *description = {{"fixed_deg", setting.fixed_deg}};
        return azimuth;
    }
    azimuth.rotator = open_rotator(setting.rotator);
    *description = identity(*azimuth.rotator);
    (*description)["zero_deg"] = setting.zero_deg;
    (*description)["direction"] = setting.direction;
    return azimuth;
}

void open_arms(const BenchFile& file, std::shared_ptr<Operator> person, ordered_json* description,
               Bench* bench) {
    switch (file.arms) {
        case BenchFile::Arms::none:
            return;
        case BenchFile::Arms::manual:
            bench->goniometer = std::make_shared<ManualGoniometer>(std::move(person));
            bench->goniometer_by_hand = true;
            *description = "manual";
            return;
        case BenchFile::Arms::fixed:
            bench->fixed_incidence_deg = file.fixed_incidence_deg;
            *description = {{"fixed_deg", file.fixed_incidence_deg}};
            return;
        case BenchFile::Arms::motors:
            break;
    }
    ordered_json sample_description, arm_description;
    const Azimuth sample = open_azimuth(file.sample_stage, &sample_description);
    const Azimuth arm = open_azimuth(file.detector_arm, &arm_description);
    bench->goniometer = std::make_shared<MotorGoniometer>(
        GoniometerAxis{sample.rotator, sample.zero_deg, sample.direction},
        GoniometerAxis{arm.rotator, arm.zero_deg, arm.direction}, std::move(person));
    *description = {{"sample", sample_description}, {"arm", arm_description}};
}

Bench open_head_bench(const std::string& uri, const ScpiCommands& commands) {
    Bench bench;
    bench.name = uri;
    bench.clock = machine_clock();
    bench.head = open_head(uri, commands);
    bench.notes = {{"instrument", bench.head->identity()}};
    bench.description = ordered_json{{"head", bench.head->identity()}}.dump();
    return bench;
}

Bench open_parts(const BenchFile& file, std::shared_ptr<Operator> person) {
    Bench bench;
    ordered_json description = ordered_json::object();
    if (!file.head.empty()) {
        bench = open_head_bench(file.head, file.scpi);
        description["head"] = bench.head->identity();
    } else {
        bench.clock = machine_clock();
        bench.spectrometer = open_spectrometer(file.spectrometer, file.scpi);
        const SpectrometerInfo& info = bench.spectrometer->info();
        description["spectrometer"] = {
            {"uri", info.uri}, {"model", info.model}, {"serial", info.serial}};
        bench.polariser = open_azimuth(file.polariser, &description["polariser"]);
        bench.analyser = open_azimuth(file.analyser, &description["analyser"]);
        bench.retarder.present = file.has_retarder;
        bench.retarder.in_deg = file.retarder_in_deg;
        bench.retarder.out_deg = file.retarder_out_deg;
        if (!file.retarder_rotator.empty()) {
            bench.retarder.rotator = open_rotator(file.retarder_rotator);
            description["retarder"] = identity(*bench.retarder.rotator);
            description["retarder"]["in_deg"] = file.retarder_in_deg;
            description["retarder"]["out_deg"] = file.retarder_out_deg;
        } else if (file.has_retarder) {
            description["retarder"] = "manual";
        }
        bench.notes = {{"instrument", fmt::format("{} ({})", info.model, info.uri)}};
    }
    // Another command may measure something else.
    if (!file.scpi_json.empty()) description["scpi"] = file.scpi_json;
    if (file.arms != BenchFile::Arms::none) {
        open_arms(file, std::move(person), &description["goniometer"], &bench);
    }
    bench.name = file.name;
    bench.calibration = file.calibration;
    bench.notes.emplace_back("bench", file.name);
    bench.description = description.dump(-1, ' ', false, ordered_json::error_handler_t::replace);
    return bench;
}

Bench open_file(const std::string& path, uint64_t seed, std::shared_ptr<Operator> person,
                FaultInjection faults) {
    const BenchFile file = parse_bench_file(read_file(path, largest_bench_file), path);
    if (file.virtual_material.empty()) return open_parts(file, std::move(person));
    // A material file stands beside the bench file that names it.
    std::string material = file.virtual_material;
    if (material.find('/') != std::string::npos || material.ends_with(".json")) {
        material = (std::filesystem::path(path).parent_path() / material).string();
    }
    Bench bench =
        make_virtual_bench(find_material(material),
                           file.virtual_settings.value_or(ordinary_bench_settings(seed)), faults);
    bench.name = file.name;
    bench.calibration = file.calibration;
    return bench;
}

[[noreturn]] void needs_a_bench(const InstrumentUri& uri, const std::string& instrument) {
    const bool spectrometer = uri.scheme == "ooi" || uri.scheme == "obp";
    user_error(
        "--instrument: {} is a {} and no ellipsometer by itself; write a bench file that says what "
        "else there is, and give its name:\n"
        "  {{\"format\": \"drude-bench/1\", \"spectrometer\": \"{}\",\n"
        "   \"polariser\": {{\"rotator\": \"{}\", \"zero_deg\": 0}},\n"
        "   \"analyser\": {{\"fixed_deg\": 45}}, \"goniometer\": \"manual\"}}",
        instrument, spectrometer ? "spectrometer" : "rotation mount",
        spectrometer ? instrument : "ooi:SERIAL", spectrometer ? "ell:SERIAL/0" : instrument);
}

}  // namespace

Bench open_bench(const std::string& instrument, uint64_t seed, std::shared_ptr<Operator> person,
                 FaultInjection faults) {
    constexpr std::string_view virtual_scheme = "virtual:";
    if (instrument.starts_with(virtual_scheme)) {
        const std::string material = instrument.substr(virtual_scheme.size());
        if (material.empty()) {
            user_error(
                "--instrument: found 'virtual:', expected a material behind it, as in "
                "virtual:Cu-McPeak; 'drude materials' lists them");
        }
        return make_virtual_bench(find_material(material), ordinary_bench_settings(seed),
                                  std::move(faults));
    }
    if (std::filesystem::exists(instrument)) {
        return open_file(instrument, seed, std::move(person), std::move(faults));
    }
    if (instrument.find(':') == std::string::npos) {
        user_error(
            "--instrument: there is no bench file '{}'; expected one, virtual:MATERIAL, or the URI "
            "of an instrument (usbtmc:VID:PID:SERIAL)",
            instrument);
    }
    const InstrumentUri uri = parse_instrument_uri(instrument);
    if (uri.scheme != "usbtmc") needs_a_bench(uri, instrument);
    return open_head_bench(instrument, {});
}

}  // namespace drude
