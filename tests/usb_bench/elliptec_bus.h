// Thorlabs ELL14 rotation mounts on an RS-485 bus behind an FT230X.
//
// ELLx protocol (Thorlabs, ELLx modules protocol manual): an address, two letters, upper-case
// hexadecimal digits; answers end in CR LF. 143360 pulses a turn.
#pragma once

#include <map>
#include <vector>

#include "usb_bench/ftdi_device.h"
#include "usb_bench/optical_bench.h"

namespace drude::usb_bench {

class ElliptecBus : public FtdiDevice {
  public:
    // The mounts at addresses 0, 1, ... and what they turn; each move takes `move_s`.
    ElliptecBus(const std::string& serial, const std::vector<Role>& roles, double move_s,
                OpticalBench& bench, FaultPlan& faults);

    void repair() override {
        for (auto& mount : mounts_) mount.second.jammed = false;
    }

    static constexpr int pulses_per_turn = 143360;

  protected:
    void line_received(const Bytes& bytes) override;
    std::string describe_line(const Bytes& bytes) const override;
    void power_on() override;

  private:
    struct Mount {
        Role role;
        int32_t pulses = 0;
        bool jammed = false;
        int busy_answers = 0;  // still to give
        int status = 0;
    };
    void execute(char address, const std::string& command, const std::string& argument);
    void answer(const std::string& text, bool moves, double delay_s);
    void move(char address, Mount& mount, int32_t pulses);

    OpticalBench& bench_;
    double move_s_;
    std::map<char, Mount> mounts_;
    Bytes line_;
};

}  // namespace drude::usb_bench
