// Replies of OOI spectrometers: of every model, as slot, status and frame. A reply that is refused
// is a DeviceError; the first byte chooses the model.
#include <cstdlib>
#include <vector>

#include "device/device_error.h"
#include "device/instrument_family.h"
#include "device/instruments/ooi_protocol.h"
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

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    if (size < 1) return 0;
    std::vector<uint16_t> products;
    for (const drude::KnownInstrument& known : drude::known_instruments()) {
        if (known.family.scheme == "ooi") products.push_back(known.product);
    }
    const drude::OoiModel& model = *drude::find_ooi_model(products[data[0] % products.size()]);
    const std::span<const uint8_t> reply(data + 1, size - 1);
    expect_answer_or_device_error([&] {
        const auto slot = drude::parse_ooi_slot(reply, reply.size() > 1 ? reply[1] : 0, "it");
        const double number = drude::ooi_slot_number(slot);
        if (drude::parse_ooi_saturation(slot, model) > model.max_counts) std::abort();
        drude::why_nonlinearity_is_unusable({1, number}, model.max_counts);
        const auto nm = drude::polynomial_wavelengths({number, 1}, model.pixels, 0, "it");
        if (nm.size() != static_cast<size_t>(model.pixels)) std::abort();
    });
    expect_answer_or_device_error([&] { drude::parse_ooi_status(reply, "it"); });
    expect_answer_or_device_error([&] {
        const auto counts = drude::parse_ooi_frame(reply, model, "it");
        if (counts.size() != static_cast<size_t>(model.pixels)) std::abort();
    });
    // A frame of the right length is rare among mutations of short inputs: repeat what there is.
    expect_answer_or_device_error([&] {
        std::vector<uint8_t> frame(model.frame_bytes());
        for (size_t i = 0; i < frame.size() && !reply.empty(); ++i) {
            frame[i] = reply[i % reply.size()];
        }
        drude::parse_ooi_frame(frame, model, "it");
    });
    return 0;
}
