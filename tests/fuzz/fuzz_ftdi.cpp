#include "device/instruments/ftdi_serial.h"
#include "fuzz_device.h"

// The first byte chooses the packet size; the rest is a transfer.
extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    if (size == 0) return 0;
    const size_t packet = (data[0] & 1) != 0 ? 64 : 512;
    const std::span<const uint8_t> transfer(data + 1, size - 1);
    drude::fuzz_answer([&] {
        const drude::FtdiPayload payload = drude::strip_ftdi_status(transfer, packet, "fuzz");
        const size_t packets = (transfer.size() + packet - 1) / packet;
        if (payload.data.size() + 2 * packets != transfer.size()) std::abort();
        drude::ftdi_line_errors(payload.line);
    });
    return 0;
}
