// An Ocean Optics STS, protocol OBP: every message that it sends carries an MD5 checksum.
//
// Messages as in Ocean Optics, STS Data Sheet: header of 44 bytes, payload, checksum, footer.
#pragma once

#include <vector>

#include "usb_bench/optical_bench.h"

namespace drude::usb_bench {

class ObpDevice : public VirtualDevice {
  public:
    static constexpr int pixels = 1024;
    static constexpr uint32_t max_counts = 16383;

    ObpDevice(const std::string& serial, OpticalBench& bench, FaultPlan& faults);

  protected:
    void receive(uint8_t endpoint, const Bytes& data) override;
    bool control(Transfer&) override { return false; }
    std::string describe(const Transfer& transfer) const override;
    void power_on() override;

  private:
    void execute(const Bytes& message);
    void reply(const Bytes& request, int flags, int error, const Bytes& data,
               const std::string& what, Instant due, bool frame = false);

    OpticalBench& bench_;
    FreeRunningDetector detector_;
    Bytes received_;
};

}  // namespace drude::usb_bench
