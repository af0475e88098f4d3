// An FTDI serial-port chip (FT230X and its like), with whatever sits behind it.
//
// Requests as in FTDI's D2XX and Linux's ftdi_sio: 0 reset and purge, 1 modem control, 2 flow, 3
// baud rate, 4 line, 5 modem status, 9 and 10 latency. Each packet to the host begins with two
// status bytes; an idle chip sends these alone whenever its latency timer has run out.
#pragma once

#include "usb_bench/virtual_device.h"

namespace drude::usb_bench {

class FtdiDevice : public VirtualDevice {
  public:
    // `divisor`: wValue of the baud rate at which what sits behind it listens (9600: 0x4138).
    FtdiDevice(Identity identity, uint16_t divisor, FaultPlan& faults);

  protected:
    // Bytes that arrive on the line at the right baud rate.
    virtual void line_received(const Bytes& bytes) = 0;
    virtual std::string describe_line(const Bytes& bytes) const = 0;
    // A message on the line to the host.
    void line_send(const Bytes& message, const AnswerShape& shape, Instant due);

    void receive(uint8_t endpoint, const Bytes& data) override;
    bool control(Transfer& transfer) override;
    std::string describe(const Transfer& transfer) const override;
    std::optional<Packet> next_packet(uint8_t endpoint, Instant now) override;
    void power_on() override;

  private:
    struct Message {
        Bytes bytes;
        Instant due;
        bool babble;
    };
    uint16_t expected_divisor_, divisor_ = 0;
    int latency_ms_ = 16;
    std::deque<Message> to_host_;
    Instant last_packet_;
};

}  // namespace drude::usb_bench
