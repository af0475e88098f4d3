// An ellipsometer's head that returns Psi and Delta: SCPI over USBTMC.
//
// USBTMC 1.0 and USB488 1.0: headers with tags, padding, aborts and clears, a halt of Bulk-OUT for
// a header that is wrong, and a request that stays open until it is answered or aborted. What it
// measures are Psi and Delta of the bench's sample.
#pragma once

#include <deque>

#include "materials/material.h"
#include "usb_bench/virtual_device.h"

namespace drude::usb_bench {

class TmcDevice : public VirtualDevice {
  public:
    TmcDevice(const std::string& serial, Material sample, FaultPlan& faults);

  protected:
    void receive(uint8_t endpoint, const Bytes& data) override;
    bool control(Transfer& transfer) override;
    std::string describe(const Transfer& transfer) const override;
    void power_on() override;

  private:
    void execute(std::string command);
    std::string query(const std::string& command);
    std::string measure() const;
    void answer_request();
    void forget_messages();

    Material sample_;
    double angle_deg_ = 70;
    std::string message_, response_;
    std::deque<std::string> errors_;
    // The request that is open: its tag and how much it asks for.
    bool requested_ = false;
    uint8_t tag_ = 0, out_tag_ = 0;
    uint32_t wanted_ = 0;
};

}  // namespace drude::usb_bench
