// Virtual devices attached to this machine's kernel, and a program that runs while they are.
#pragma once

#include <sys/types.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "usb_bench/qemu/usbip_port.h"

namespace drude::usb_bench {

class UsbipHost {
  public:
    // One port each, in this order; the devices outlive this.
    explicit UsbipHost(const std::vector<VirtualDevice*>& devices);
    ~UsbipHost();

    // Plugs all in and serves them until the kernel has configured each, bound its own drivers, and
    // these have fallen silent. Throws Error (outside) where `seconds` were not enough.
    void attach(double seconds);
    // Runs the program with its arguments and serves the devices until it ends. Devices that a
    // fault unplugs leave, and come back where the fault says so. Returns the program's exit
    // status, 128 + signal where one ended it. One that takes longer than `seconds` is killed:
    // Error (outside).
    int run(const std::vector<std::string>& program, double seconds);
    // SIGKILL for the program that runs, after `seconds`.
    void kill_program(double seconds) { kill_at_ = Clock::now() + seconds_of(seconds); }
    // Serves until the drivers that the devices name are bound again; false after `seconds`.
    // `problem`: which device has which driver instead.
    bool drivers_back(double seconds, std::string* problem);

  private:
    struct Slot {
        std::unique_ptr<UsbipPort> port;
        std::optional<Instant> plug_in;  // when it is to be (back) on the bus
    };
    void serve_for(double seconds);
    bool all_ready() const;
    uint64_t commands() const;
    void plug_in_what_is_due();

    std::vector<std::unique_ptr<Slot>> slots_;
    pid_t child_ = 0;
    std::optional<Instant> kill_at_;
};

}  // namespace drude::usb_bench
