#include "device/usb/usb_holder.h"

#include <fmt/format.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "device/usb/usb_handles.h"

namespace drude {

namespace {

namespace fs = std::filesystem;

// The name of the driver that is bound to an interface, or empty. In sysfs an interface is
// BUS-PORT.PORT:CONFIGURATION.INTERFACE.
std::string bound_driver(libusb_device* device, int interface_number) {
    uint8_t ports[8];
    const int count = libusb_get_port_numbers(device, ports, sizeof ports);
    const ConfigurationPointer config = read_configuration(device);
    if (count <= 0 || !config) return {};
    std::string path =
        fmt::format("/sys/bus/usb/devices/{}-{}", libusb_get_bus_number(device), int{ports[0]});
    for (int i = 1; i < count; ++i) path += fmt::format(".{}", int{ports[i]});
    path += fmt::format(":{}.{}/driver", int{config->bConfigurationValue}, interface_number);
    std::error_code error;
    const fs::path link = fs::read_symlink(path, error);
    return error ? std::string() : link.filename().string();
}

// "process 1234 (python3)" of a process that has the device open, or empty.
std::string holding_process(libusb_device* device) {
    const fs::path node = fmt::format("/dev/bus/usb/{:03}/{:03}", libusb_get_bus_number(device),
                                      libusb_get_device_address(device));
    std::error_code error;
    for (fs::directory_iterator process("/proc", error), end; !error && process != end;
         process.increment(error)) {
        const std::string number = process->path().filename().string();
        if (number.find_first_not_of("0123456789") != std::string::npos) continue;
        // This program has just opened it, to be told that it is busy.
        if (number == std::to_string(getpid())) continue;
        std::error_code hidden;  // of another user, or ended meanwhile
        for (fs::directory_iterator file(process->path() / "fd", hidden); !hidden && file != end;
             file.increment(hidden)) {
            std::error_code closed;
            if (fs::read_symlink(file->path(), closed) != node || closed) continue;
            std::string name;
            std::getline(std::ifstream(process->path() / "comm") >> std::ws, name);
            return fmt::format("process {}{}", number, name.empty() ? "" : " (" + name + ")");
        }
    }
    return {};
}

}  // namespace

std::string explain_busy(libusb_device* device, int interface_number) {
    const std::string driver = bound_driver(device, interface_number);
    // "usbfs" is what the kernel calls another program that uses libusb.
    if (!driver.empty() && driver != "usbfs") {
        return fmt::format(
            "the kernel driver '{}' holds it and did not let go; unload it (sudo modprobe -r {}), "
            "then try again",
            driver, driver);
    }
    const std::string process = holding_process(device);
    if (!process.empty()) {
        return fmt::format("{} has it open; end that program, then try again", process);
    }
    return "another program has it open; end it (a second drude, the maker's software), then try "
           "again";
}

}  // namespace drude
