// Messages of the Ocean Binary Protocol: one is taken apart or refused as a DeviceError, and what
// was taken apart is the same after another turn through bytes.
#include <cstdlib>
#include <vector>

#include "device/device_error.h"
#include "device/instruments/obp_message.h"
#include "device/instruments/obp_spectrometer.h"
#include "device/instruments/stored_calibration.h"

namespace {

template <class Call>
void expect_answer_or_device_error(const Call& call) {
    try {
        call();
    } catch (const drude::DeviceError& error) {
        if (error.message().empty()) std::abort();
    }
}

void use(std::span<const uint8_t> data) {
    drude::stored_text(data);
    expect_answer_or_device_error([&] { drude::parse_obp_number(data, "n", "it"); });
    expect_answer_or_device_error([&] {
        const std::vector<double> values = drude::parse_obp_floats(data, "c", "it");
        drude::why_nonlinearity_is_unusable(values, 65535);
        drude::polynomial_wavelengths(values, 16, 0, "it");
    });
    for (const uint16_t product : {uint16_t{0x4000}, uint16_t{0x4004}}) {
        const drude::ObpModel& model = *drude::find_obp_model(0x2457, product);
        expect_answer_or_device_error([&] { drude::parse_obp_spectrum(data, model, "it"); });
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    const std::span<const uint8_t> bytes(data, size);
    expect_answer_or_device_error([&] {
        const drude::ObpMessage message = drude::parse_obp_message(bytes, "it");
        drude::obp_error_text(message.error);
        use(message.data);
        for (const bool checksum : {false, true}) {
            const auto again = drude::format_obp_message(message, checksum);
            if (drude::parse_obp_message(again, "it") != message) std::abort();
        }
    });
    use(bytes);
    return 0;
}
