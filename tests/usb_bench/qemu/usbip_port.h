// A virtual device on a port of the kernel's virtual host controller (vhci_hcd), over USB/IP.
//
// The kernel is handed one end of a socket pair through sysfs and believes in a device that another
// machine shares; what it asks for goes to the device's model. No network and no usbip tools.
#pragma once

#include <cstdint>
#include <set>
#include <string>

#include "usb_bench/qemu/usbip_protocol.h"
#include "usb_bench/virtual_device.h"

namespace drude::usb_bench {

class UsbipPort {
  public:
    // `number`: 0 to 7, a high-speed port of the first controller. The device outlives this.
    UsbipPort(VirtualDevice& device, int number) : device_(device), number_(number) {}
    ~UsbipPort() { detach(); }
    UsbipPort(const UsbipPort&) = delete;
    UsbipPort& operator=(const UsbipPort&) = delete;

    const VirtualDevice& device() const { return device_; }
    VirtualDevice& device() { return device_; }

    // False while the kernel has not yet cleared away the device that sat there before. Throws
    // Error (outside) where there is no vhci_hcd, or it refuses.
    bool attach();
    // The cable is pulled: closing the socket is what makes the kernel disconnect the device.
    void detach();
    bool attached() const { return socket_ >= 0; }
    // To poll for input; -1 while detached.
    int descriptor() const { return socket_; }
    // Takes the commands that are here to the model and brings the answers that it has. A device
    // that has left the bus is detached a moment later: what was sent to it arrived, what it was
    // asked for never comes. Throws Error (outside) for what is no USB/IP.
    void serve();
    // How many commands there were so far: while it grows, somebody talks to the device.
    uint64_t commands() const { return commands_; }
    // Whether the kernel has configured the device and its own driver, where the model names one,
    // has bound the interface.
    bool ready() const;
    // Name of the driver that has the interface now; empty: none.
    std::string bound_driver() const;

  private:
    void obey(const UsbipCommand& command);
    void answer();
    void send(const std::string& bytes);
    std::string interface_folder() const;

    VirtualDevice& device_;
    int number_;
    int socket_ = -1;
    uint64_t commands_ = 0;
    UsbipReader reader_;
    std::optional<Instant> pulled_;  // when the kernel is to see that the device has left
    std::set<uint64_t> under_way_;   // transfers that the device has and that were not answered
    std::set<uint64_t> taken_back_;  // those of them that the kernel wants to hear no more of
};

}  // namespace drude::usb_bench
