// An instrument of the USB Test and Measurement Class: messages out, answers in, and a way back
// into step when an answer does not come.
//
// After a time-out the instrument still holds a request that nobody waits for. It must be told to
// give it up, and what it had begun to send must be read to its end (a short packet); otherwise
// every later answer is off by one.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "device/device_error.h"
#include "device/instruments/usbtmc_message.h"
#include "device/usb/usb_port.h"

namespace drude {

struct UsbtmcOptions {
    size_t largest_answer = size_t{16} << 20;
    uint32_t transfer = uint32_t{1} << 16;  // bytes of a message in one transfer, either way
    double settle_s = 2;                    // at most, for aborting and clearing
};

class Usbtmc {
  public:
    // Finds the bulk endpoints, reads the capabilities and clears what an earlier program may have
    // left. Throws DeviceError; refused for an interface that only listens or only talks.
    explicit Usbtmc(std::shared_ptr<UsbPort> port, const UsbtmcOptions& options = {});

    UsbPort& port() { return *port_; }
    std::string name() const { return port_->name(); }
    const UsbtmcCapabilities& capabilities() const { return capabilities_; }

    // All of a message, in as many transfers as it takes. Throws DeviceError; the transfer is
    // aborted then.
    void write(std::string_view message, Deadline deadline);
    // All of an answer. With `terminator` it also ends at that character; DeviceError (refused)
    // where the instrument cannot do that. After every error but unplugged, the request was aborted
    // and the endpoint drained, so that the next answer belongs to the next question.
    std::string read(Deadline deadline, std::optional<char> terminator = {});
    std::string ask(std::string_view message, double seconds);

    // The status byte of IEEE 488.1: 0x10 message available, 0x20 event, 0x40 service requested.
    uint8_t status_byte();
    // Forgets all messages on both sides (USBTMC 1.0, 4.2.1.6).
    void clear();
    bool reopen(double seconds);

  private:
    std::vector<uint8_t> request(uint8_t type, uint8_t number, uint16_t value, uint16_t index,
                                 uint16_t length);
    void start();
    void abort_in(uint8_t tag);
    void abort_out(uint8_t tag);
    void back_in_step(uint8_t tag, bool in, Fault fault);
    void drain_in(Deadline deadline);
    UsbtmcPart read_transfer(uint8_t tag, uint32_t size, Deadline deadline);

    std::shared_ptr<UsbPort> port_;
    UsbtmcOptions options_;
    UsbtmcCapabilities capabilities_;
    uint8_t in_ = 0, out_ = 0, interrupt_ = 0;  // endpoints; no interrupt endpoint: 0
    uint8_t tag_ = 0, status_tag_ = 1;
    bool out_of_step_ = false;  // an abort failed: clear before anything else
};

}  // namespace drude
