// A USB device without a wire: transfers go in, packets come out.
//
// Nothing here knows how a host is attached. usbfs_node.h puts it behind usbfs as umockdev emulates
// it. What is modelled is what a host can see: packets of wMaxPacketSize, transfers that end by a
// short or empty packet, data that does not fit (babble), halted endpoints, transfers that wait
// until they are answered or cancelled, and leaving the bus. Statuses are those of Linux
// (Documentation/driver-api/usb/error-codes.rst): 0, -EPIPE, -EOVERFLOW, -ENOENT, -ESHUTDOWN.
#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "usb_bench/fault_plan.h"

namespace drude::usb_bench {

using Clock = std::chrono::steady_clock;
using Instant = Clock::time_point;
using Bytes = std::string;  // of any value; a string, so that ASCII protocols read as they are

inline Clock::duration seconds_of(double seconds) {
    return std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
}
inline uint8_t byte_at(const Bytes& bytes, size_t i) {
    return static_cast<uint8_t>(bytes[i]);
}
// `width` bytes of an unsigned number, least significant first.
Bytes little_endian(uint64_t value, int width);
uint64_t read_little_endian(const Bytes& bytes, size_t first, int width);

enum class TransferType : uint8_t { isochronous = 0, interrupt = 1, control = 2, bulk = 3 };

struct Transfer {
    TransferType type = TransferType::bulk;
    uint8_t endpoint = 0;            // direction bit included
    std::array<uint8_t, 8> setup{};  // of control transfers
    Bytes data;                      // OUT: what the host sends; IN: what came
    size_t length = 0;               // IN: how much the host asks for
    int status = 0;
    uint64_t cookie = 0;  // the host's name for it

    bool incoming() const {
        return ((type == TransferType::control ? setup[0] : endpoint) & 0x80) != 0;
    }
    uint16_t value() const { return static_cast<uint16_t>(setup[2] | setup[3] << 8); }
    uint16_t index() const { return static_cast<uint16_t>(setup[4] | setup[5] << 8); }
};

struct Endpoint {
    uint8_t address = 0;
    uint16_t packet_size = 512;
};

struct Identity {
    std::string name;  // "ooi:USB4C00001"; of messages about the bench
    uint16_t vendor = 0, product = 0, release = 0x0100;
    uint8_t interface_class = 0xFF, subclass = 0, protocol = 0;
    std::vector<Endpoint> endpoints;                 // bulk
    std::string manufacturer, product_name, serial;  // an empty serial: the device has none
    bool high_speed = true;
    std::string kernel_driver;  // that has bound its interface ("ftdi_sio"); empty: none
};

class VirtualDevice {
  public:
    VirtualDevice(Identity identity, FaultPlan& faults);
    virtual ~VirtualDevice() = default;
    VirtualDevice(const VirtualDevice&) = delete;
    VirtualDevice& operator=(const VirtualDevice&) = delete;

    const Identity& identity() const { return identity_; }
    // Device descriptor and configuration descriptor, as sysfs shows them.
    Bytes descriptors() const;

    void submit(Transfer transfer);
    // Completes a waiting transfer with -ENOENT; false where it is not waiting.
    bool cancel(uint64_t cookie);
    // The next transfer that is complete, if any.
    std::optional<Transfer> reap();
    // The host that submitted it is gone.
    void forget(uint64_t cookie);
    void clear_halt(uint8_t endpoint) { halted_.erase(endpoint); }
    void reset();

    bool gone() const { return gone_; }
    void unplug();
    // Back on the bus: what USB powers begins anew.
    void plug_in();
    // Somebody saw to what a fault broke for good.
    virtual void repair() {}
    // Called by unplug(), with the time after which it is plugged in again where there is one.
    std::function<void(std::optional<int> milliseconds)> on_unplug;

  protected:
    struct Packet {
        Bytes data;
        Instant due;
        bool babble = false;
    };

    // What a bulk-OUT transfer makes it do.
    virtual void receive(uint8_t endpoint, const Bytes& data) = 0;
    // Class and vendor requests: fills `data` of a read; false: stalls.
    virtual bool control(Transfer& transfer) = 0;
    // What an OUT transfer carries, for listings.
    virtual std::string describe(const Transfer& transfer) const = 0;
    virtual void power_on() = 0;
    // The packet that an IN endpoint has to send now, removed from what it holds.
    virtual std::optional<Packet> next_packet(uint8_t endpoint, Instant now);

    // A message to the host after its faults: nothing where it is lost (stall, silence, unplugged).
    struct Prepared {
        Bytes bytes;
        bool babble = false;
    };
    std::optional<Prepared> prepare(uint8_t endpoint, Bytes message, const AnswerShape& shape);
    // prepare(), and into packets; `zero_length`: an empty packet ends a message that fills its
    // last one. False where the message was lost.
    bool send(uint8_t endpoint, const Bytes& message, const AnswerShape& shape, Instant due,
              bool zero_length = false);
    void halt(uint8_t endpoint) { halted_.insert(endpoint); }
    size_t packet_size(uint8_t endpoint) const;
    void drop_queued(uint8_t endpoint) { queued_[endpoint].clear(); }

    FaultPlan& faults_;

  private:
    void leave_bus(std::optional<int> milliseconds);
    // Applies a fault of a transfer that is not a bulk-IN message; true where it is settled.
    bool suffer(Transfer& transfer, const std::string& what);
    void standard_request(Transfer& transfer);
    void pump();

    Identity identity_;
    bool gone_ = false;
    std::set<uint8_t> halted_;
    std::map<uint8_t, std::deque<Packet>> queued_;
    std::map<uint8_t, std::deque<Transfer>> waiting_;  // IN transfers, by endpoint
    std::deque<Transfer> ignored_;                     // silence: until cancelled
    std::deque<Transfer> done_;
};

}  // namespace drude::usb_bench
