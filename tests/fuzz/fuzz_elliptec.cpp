#include "device/instruments/elliptec_answer.h"
#include "fuzz_device.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    const std::string line(data, data + size);
    const auto answer = drude::parse_elliptec_answer(line);
    if (!answer) return 0;
    if (answer->address + answer->code + answer->digits != line) std::abort();
    drude::fuzz_answer([&] {
        const drude::ElliptecIdentity identity = drude::parse_elliptec_identity(*answer, "fuzz");
        if (identity.pulses_per_turn <= 0 || identity.model.empty()) std::abort();
    });
    drude::fuzz_answer([&] {
        const int64_t position = drude::parse_elliptec_position(*answer, "fuzz");
        if (position != static_cast<int32_t>(position)) std::abort();
    });
    drude::fuzz_answer([&] {
        const int status = drude::parse_elliptec_status(*answer, "fuzz");
        if (drude::elliptec_status_words(status).empty()) std::abort();
        drude::elliptec_status_fault(status);
    });
    return 0;
}
