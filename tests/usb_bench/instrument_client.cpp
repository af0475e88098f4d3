// A program that uses one instrument through the registry, as small as can be.
//
//   instrument-client spectrometer URI SECONDS    all counts of the second frame, one a line
//   instrument-client rotator URI DEGREES...      homes, then what it reports after each move
//   instrument-client head URI DEGREES            rows: wavelength, psi, delta

#include <fmt/format.h>

#include <string>
#include <vector>

#include "base/error.h"
#include "base/numbers.h"
#include "device/instruments/registry.h"

namespace drude {

namespace {

double number(const std::string& text) {
    const auto value = parse_double(text);
    if (!value) user_error("found '{}', expected a number", text);
    return *value;
}

void run(const std::vector<std::string>& words) {
    if (words.size() < 3) user_error("expected spectrometer|rotator|head URI NUMBER...");
    if (words[0] == "spectrometer") {
        const auto spectrometer = open_spectrometer(words[1]);
        spectrometer->set_integration_time(number(words[2]));
        // The first may have begun with another integration time.
        spectrometer->acquire();
        const Frame frame = spectrometer->acquire();
        const SpectrometerInfo& info = spectrometer->info();
        fmt::print("{} {} pixels from {} to {} nm\n", info.serial, info.wavelength_nm.size(),
                   format_double(info.wavelength_nm.front()),
                   format_double(info.wavelength_nm.back()));
        for (const uint32_t counts : frame.counts) fmt::print("{}\n", counts);
    } else if (words[0] == "rotator") {
        const auto rotator = open_rotator(words[1]);
        rotator->home();
        for (size_t i = 2; i < words.size(); ++i) {
            fmt::print("{}\n", format_double(rotator->move_to(number(words[i]))));
        }
    } else if (words[0] == "head") {
        const auto head = open_head(words[1]);
        fmt::print("{}\n", head->identity());
        for (const MeasurementRow& row : head->measure(number(words[2]))) {
            fmt::print("{} {} {}\n", format_double(row.wavelength_nm), format_double(row.psi_deg),
                       format_double(row.delta_deg));
        }
    } else {
        user_error("found '{}', expected spectrometer, rotator or head", words[0]);
    }
}

}  // namespace

}  // namespace drude

int main(int argc, char** argv) {
    try {
        drude::run({argv + 1, argv + argc});
        return 0;
    } catch (const drude::Error& error) {
        fmt::print(stderr, "{}\n", error.message());
        return static_cast<int>(error.cause());
    }
}
