#include <algorithm>

#include "device/instruments/apt_message.h"
#include "fuzz_device.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    const std::span<const uint8_t> bytes(data, size);
    drude::fuzz_answer([&] {
        const drude::AptMessage message = drude::parse_apt(bytes, "fuzz");
        drude::apt_response_words(message);
        drude::fuzz_answer([&] {
            const drude::AptStatus status = drude::parse_apt_status(message, "fuzz");
            drude::apt_status_errors(status.bits);
        });
        drude::fuzz_answer([&] {
            if (drude::parse_apt_info(message, "fuzz").model.empty()) std::abort();
        });
        // Back to bytes: the same, but for a header that announces data and then none.
        const bool data_bit = (bytes[4] & 0x80) != 0;
        if (data_bit == message.data.empty()) return;
        const std::vector<uint8_t> again = drude::encode_apt(message);
        if (again.size() != size || !std::equal(again.begin(), again.end(), data)) std::abort();
    });
    return 0;
}
