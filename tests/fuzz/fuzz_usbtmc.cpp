#include "device/instruments/usbtmc_message.h"
#include "fuzz_device.h"

// The first byte is the tag that was asked with, the second and third how many bytes were.
extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    if (size < 3) return 0;
    const std::span<const uint8_t> transfer(data + 3, size - 3);
    const uint32_t requested = static_cast<uint32_t>(data[1] | (data[2] << 8));
    drude::fuzz_answer([&] {
        const drude::UsbtmcPart part = drude::parse_usbtmc_in(transfer, data[0], requested, "fuzz");
        if (part.data.size() > requested) std::abort();
    });
    drude::fuzz_answer([&] { drude::parse_usbtmc_capabilities(transfer, "fuzz"); });
    const std::string text(transfer.begin(), transfer.end());
    const std::vector<uint8_t> sent = drude::encode_usbtmc_out(data[0], text, true);
    if (sent.size() % 4 != 0 || sent.size() < drude::usbtmc_header + text.size()) std::abort();
    return 0;
}
