// A Thorlabs K10CR1 rotation mount: an APT controller behind an FTDI chip of its own.
//
// Messages as in Thorlabs, APT Communications Protocol: six bytes, or six and data; little endian.
// 409600 microsteps are three degrees.
#pragma once

#include "usb_bench/ftdi_device.h"
#include "usb_bench/optical_bench.h"

namespace drude::usb_bench {

class AptMount : public FtdiDevice {
  public:
    AptMount(const std::string& serial, Role role, double move_s, OpticalBench& bench,
             FaultPlan& faults);

    void repair() override { jammed_ = false; }

  protected:
    void line_received(const Bytes& bytes) override;
    std::string describe_line(const Bytes& bytes) const override;
    void power_on() override;

  private:
    void execute(uint16_t id, const Bytes& data);
    void answer(uint16_t id, const Bytes& data, const std::string& what, bool moves,
                double delay_s);
    void answer_short(uint16_t id, int parameter, const std::string& what, bool moves,
                      double delay_s);
    Bytes status() const;
    // Whether it got there; `arrived` is what it says if it did.
    bool go(int32_t microsteps);

    OpticalBench& bench_;
    Role role_;
    double move_s_;
    int32_t microsteps_ = 0;
    bool homed_ = false, jammed_ = false;
    Bytes line_;
};

}  // namespace drude::usb_bench
