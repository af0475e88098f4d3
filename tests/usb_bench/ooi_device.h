// An Ocean Optics USB4000, protocol OOI.
//
// Commands, slots and the two endpoints of a frame as in Ocean Optics, USB4000 Data Sheet, and in
// pyseabreeze's tables: 3840 pixels of 16 bits and the byte 0x69, the first 2048 bytes by endpoint
// 0x86, the others by 0x82. Pixels are those of the optical bench, one for one.
#pragma once

#include <map>

#include "usb_bench/optical_bench.h"

namespace drude::usb_bench {

class OoiDevice : public VirtualDevice {
  public:
    static constexpr int pixels = 3840;

    // An empty serial: neither string descriptor nor slot 0 hold one.
    OoiDevice(const std::string& serial, OpticalBench& bench, FaultPlan& faults);

  protected:
    void receive(uint8_t endpoint, const Bytes& data) override;
    bool control(Transfer&) override { return false; }
    std::string describe(const Transfer& transfer) const override;
    void power_on() override;

  private:
    void send_frame();

    OpticalBench& bench_;
    FreeRunningDetector detector_;
    std::map<int, std::string> slots_;
};

}  // namespace drude::usb_bench
