#include "usb_bench/bench_options.h"

#include <algorithm>

#include "base/error.h"
#include "base/files.h"
#include "base/numbers.h"

namespace drude::usb_bench {

const char* const usage =
    R"(usb-bench [OPTION...] -- PROGRAM ARGUMENT... [--on-failure PROGRAM ARGUMENT...]

Runs a program on virtual USB devices, through the libusb that it was linked with, and exits with
the program's status; 125 where it left something behind, 124 where it hung.

  --device SCHEME:SERIAL   one of ooi, obp, ell, apt-sample, apt-arm, usbtmc; repeats. An empty
                           serial: the device has none. ",busy" or ",refused" after it: somebody
                           else holds it, or it may not be opened. Default: one of each but obp
  --fault KIND@NUMBER[+MS] what befalls an answer; repeats
  --random-faults SEED:COUNT:RANGE
  --material NAME          of the sample
  --settings FILE          of the bench (JSON, as of "virtual" in a bench file)
  --frozen-noise           the same noise in every exposure of one state
  --incidence DEGREES      where none of the devices turns the arms (70)
  --fixed-analyser DEGREES where it stands: the Elliptec bus has the polariser alone, and there is no
                           retarder
  --move-seconds S         that a mount takes
  --seconds S              that the program may take (60)
  --no-inspect             do not look at the program when it exits (sanitizers)
  --count                  print how many answers there were
  --answers FILE           list them
  --report FILE            what happened, as JSON
  --bench-out FILE         the bench file (JSON) that says what the devices are, with a calibration
                           beside it
  --on-failure             another command for the same devices, with everything plugged in and no
                           faults, where the first fails
)";

namespace {

DeviceOption parse_device(const std::string& text) {
    static const std::vector<std::string> schemes{"ooi",        "obp",     "ell",
                                                  "apt-sample", "apt-arm", "usbtmc"};
    DeviceOption device;
    std::string rest = text;
    const auto flag = [&](const std::string& word) {
        if (rest.size() < word.size() || rest.substr(rest.size() - word.size()) != word)
            return false;
        rest.resize(rest.size() - word.size());
        return true;
    };
    device.busy = flag(",busy");
    device.refused = flag(",refused");
    const size_t colon = rest.find(':');
    device.scheme = rest.substr(0, colon);
    if (colon == std::string::npos ||
        std::find(schemes.begin(), schemes.end(), device.scheme) == schemes.end()) {
        user_error("--device: found '{}', expected SCHEME:SERIAL with one of {}{}", text,
                   fmt::join(schemes, " "), did_you_mean(device.scheme, schemes));
    }
    device.serial = rest.substr(colon + 1);
    return device;
}

double number(const std::string& option, const std::string& text) {
    const auto value = parse_double(text);
    if (!value || !(*value >= 0 && *value <= 1e6)) {
        user_error("{}: found '{}', expected a number from 0 to 1e6", option, text);
    }
    return *value;
}

std::vector<PlannedFault> parse_random(const std::string& text) {
    const size_t first = text.find(':'), last = text.rfind(':');
    if (first != std::string::npos && first != last) {
        const auto seed = parse_unsigned(text.substr(0, first));
        const auto count = parse_unsigned(text.substr(first + 1, last - first - 1));
        const auto range = parse_unsigned(text.substr(last + 1));
        if (seed && count && range && *count <= 1000) {
            return random_faults(*seed, static_cast<int>(*count), *range);
        }
    }
    user_error("--random-faults: found '{}', expected SEED:COUNT:RANGE", text);
}

}  // namespace

BenchOptions parse_bench_options(const std::vector<std::string>& words) {
    BenchOptions options;
    // Pixels of the virtual USB4000, whose slots hold this dispersion without rounding.
    options.settings.pixels = 3840;
    options.settings.first_nm = 340;
    options.settings.last_nm = 340 + 0.1354 * 3839;
    options.settings.full_scale_s = 0.002;
    static const std::vector<std::string> known{
        "--device",       "--fault",          "--random-faults", "--material", "--settings",
        "--frozen-noise", "--fixed-analyser", "--move-seconds",  "--seconds",  "--no-inspect",
        "--count",        "--answers",        "--report",        "--bench-out"};
    size_t i = 0;
    for (; i < words.size() && words[i] != "--"; ++i) {
        const std::string& option = words[i];
        const auto value = [&]() -> const std::string& {
            if (i + 1 >= words.size()) user_error("{}: its value is missing", option);
            return words[++i];
        };
        if (option == "--device") {
            options.devices.push_back(parse_device(value()));
        } else if (option == "--fault") {
            options.faults.push_back(parse_fault(value()));
        } else if (option == "--random-faults") {
            for (const PlannedFault& fault : parse_random(value())) options.faults.push_back(fault);
        } else if (option == "--material") {
            options.material = value();
        } else if (option == "--settings") {
            const std::string& file = value();
            options.settings = parse_virtual_bench_settings(read_file(file), file);
        } else if (option == "--frozen-noise") {
            options.frozen_noise = true;
        } else if (option == "--incidence") {
            options.incidence_deg = number(option, value());
        } else if (option == "--fixed-analyser") {
            options.fixed_analyser_deg = number(option, value());
        } else if (option == "--move-seconds") {
            options.move_s = number(option, value());
        } else if (option == "--seconds") {
            options.seconds_allowed = number(option, value());
        } else if (option == "--no-inspect") {
            options.inspect = false;
        } else if (option == "--count") {
            options.count = true;
        } else if (option == "--answers") {
            options.answers_file = value();
        } else if (option == "--bench-out") {
            options.bench_file = value();
        } else if (option == "--report") {
            options.report_file = value();
        } else {
            user_error("usb-bench: found the option '{}'{}\n{}", option,
                       did_you_mean(option, known), usage);
        }
    }
    if (options.devices.empty()) {
        for (const char* device : {"ooi:USB4C00001", "ell:DK0AELL1", "apt-sample:55000001",
                                   "apt-arm:55000002", "usbtmc:TMC0001"}) {
            options.devices.push_back(parse_device(device));
        }
    }
    for (++i; i < words.size() && words[i] != "--on-failure"; ++i) {
        options.command.push_back(words[i]);
    }
    for (++i; i < words.size(); ++i) options.on_failure.push_back(words[i]);
    for (const DeviceOption& device : options.devices) {
        if (device.scheme != "obp") continue;
        // Those of the virtual STS; its coefficients are floats, which hold a half exactly.
        options.settings.pixels = 1024;
        options.settings.max_counts = 16383;
        options.settings.last_nm = 340 + 0.5 * 1023;
    }
    if (options.command.empty()) user_error("usb-bench: no program after '--'\n{}", usage);
    return options;
}

}  // namespace drude::usb_bench
