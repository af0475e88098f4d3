// Requests and replies of the Ocean Binary Protocol over a USB port.
#pragma once

#include <cstdint>
#include <vector>

#include "device/instruments/obp_message.h"
#include "device/instruments/obp_models.h"
#include "device/usb/usb_port.h"

namespace drude {

class ObpLink {
  public:
    // Both must outlive the link.
    ObpLink(UsbPort& port, const ObpModel& model) : port_(port), model_(model) {}

    // What the device answers to a request. Messages that belong to earlier requests (another type,
    // or another number than the request's) are dropped. Throws DeviceError: refused where the
    // device says that it will not (a NACK), bad_frame where it found the request damaged, and what
    // the port and parse_obp_message() throw.
    std::vector<uint8_t> query(uint32_t type, const std::vector<uint8_t>& data, Deadline deadline);
    // A request that is acknowledged, not answered.
    void command(uint32_t type, const std::vector<uint8_t>& data);

    void drain();
    void clear();

  private:
    ObpMessage exchange(uint32_t type, uint16_t flags, const std::vector<uint8_t>& data,
                        Deadline deadline);
    ObpMessage receive(Deadline deadline);

    UsbPort& port_;
    const ObpModel& model_;
    uint32_t request_ = 0;
};

}  // namespace drude
