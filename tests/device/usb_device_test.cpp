// Opening over the real libusb, inside a mocked /sys and /dev (umockdev) with recorded transfers.
#include "device/usb/usb_device.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "device/device_error.h"

namespace drude {
namespace {

constexpr const char* inside = "DRUDE_TEST_INSIDE_UMOCKDEV";

// A USB4000 without a serial number in its descriptor: one interface, bulk endpoints 01, 81, 82, 86
// of 512 bytes.
std::string mocked_usb4000(int address) {
    const std::string number = std::to_string(address), node = "bus/usb/001/00" + number;
    const std::string minor = std::to_string(address - 1);
    return "P: /devices/pci0000:00/usb1/1-" + number + "\nN: " + node +
           "\nE: SUBSYSTEM=usb\nE: DEVTYPE=usb_device\nE: BUSNUM=001\nE: DEVNUM=00" + number +
           "\nE: DEVNAME=/dev/" + node + "\nE: MAJOR=189\nE: MINOR=" + minor +
           "\nA: busnum=1\\n\nA: devnum=" + number + "\\n\nA: dev=189:" + minor +
           "\\n\nA: speed=480\\n\nA: bConfigurationValue=1\\n\nH: descriptors=" +
           "120100020000004057242210000100000001" + "09022E0001010080320904000004FF000000" +
           "07050102000200" + "07058102000200" + "07058202000200" + "07058602000200\n\n";
}

// Runs the test `name` again, inside umockdev with these devices and, for the device at address 4,
// these transfers. False where it is skipped.
bool run_inside(const std::string& name, const std::string& devices, const std::string& transfers) {
    if (std::system("umockdev-run --version >/dev/null 2>&1") != 0) return false;
    const std::string base = testing::TempDir() + "drude_" + name;
    std::ofstream(base + ".umockdev") << devices;
    std::ofstream(base + ".ioctl") << transfers;
    const std::string self = std::filesystem::read_symlink("/proc/self/exe").string();
    std::string command = std::string(inside) + "=1 umockdev-run -d '" + base + ".umockdev' ";
    if (!transfers.empty()) command += "-i /dev/bus/usb/001/004='" + base + ".ioctl' ";
    command += "-- '" + self + "' --gtest_filter=UsbDevice." + name;
    EXPECT_EQ(std::system(command.c_str()), 0);
    std::filesystem::remove(base + ".umockdev");
    std::filesystem::remove(base + ".ioctl");
    return true;
}

UsbTarget ooi(const std::string& serial = "") {
    return {"ooi", "Ocean Optics spectrometer", usb_ids("ooi"), serial, {}};
}

std::string message_of(const UsbTarget& target, Cause cause) {
    try {
        open_usb(target);
    } catch (const Error& error) {
        EXPECT_EQ(error.cause(), cause);
        return error.message();
    }
    ADD_FAILURE() << "opened";
    return {};
}

void expect_in(const std::string& part, const std::string& message) {
    EXPECT_NE(message.find(part), std::string::npos) << message;
}

int open_files() {
    int count = 0;
    for (const auto& entry : std::filesystem::directory_iterator("/proc/self/fd")) {
        (void)entry;
        ++count;
    }
    return count;
}

TEST(UsbDevice, NumbersOfAScheme) {
    const std::vector<UsbId> ids = usb_ids("ooi");
    EXPECT_NE(std::find(ids.begin(), ids.end(), UsbId{0x2457, 0x1022}), ids.end());
    EXPECT_EQ(std::find(ids.begin(), ids.end(), UsbId{0x2457, 0x4000}), ids.end());
    EXPECT_TRUE(usb_ids("virtual").empty());
}

TEST(UsbDevice, NothingOfTheKindIsPluggedIn) {
    if (!std::getenv(inside)) {
        if (!run_inside("NothingOfTheKindIsPluggedIn", mocked_usb4000(4), "")) GTEST_SKIP();
        return;
    }
    const UsbTarget apt{"apt", "Thorlabs APT controller", usb_ids("apt"), "55000001", {}};
    const std::string message = message_of(apt, Cause::outside);
    expect_in("no Thorlabs APT controller with the serial number 55000001 is plugged in", message);
    expect_in("there is Ocean Optics USB4000 / Flame-T", message);
}

TEST(UsbDevice, TwoFitAndNothingSaysWhich) {
    if (!std::getenv(inside)) {
        if (!run_inside("TwoFitAndNothingSaysWhich", mocked_usb4000(4) + mocked_usb4000(5), "")) {
            GTEST_SKIP();
        }
        return;
    }
    expect_in(
        "2 devices fit 'ooi:' (Ocean Optics spectrometer); no serial number tells them apart: "
        "unplug all of these but the one that is meant: Ocean Optics USB4000 / Flame-T on bus 001, "
        "device 004, Ocean Optics USB4000 / Flame-T on bus 001, device 005",
        message_of(ooi(), Cause::user));
}

// What happens on the bus is recorded in the script: a query of memory slot 0, and its answer.
TEST(UsbDevice, WritesAndReads) {
    if (!std::getenv(inside)) {
        const std::string transfers =
            "USBDEVFS_GET_CAPABILITIES 0 FF010000\n"
            "USBDEVFS_REAPURBNDELAY 0 3 1 0 0 2 2 0 0500\n"
            "USBDEVFS_REAPURBNDELAY 0 3 129 0 0 512 17 0 "
            "0500555342344330303030310000000000\n";
        if (!run_inside("WritesAndReads", mocked_usb4000(4), transfers)) GTEST_SKIP();
        return;
    }
    const int before = open_files();
    {
        const std::shared_ptr<UsbPort> port = open_usb(ooi());
        EXPECT_EQ(port->name(), "Ocean Optics USB4000 / Flame-T (ooi:)");
        EXPECT_EQ(port->vendor(), 0x2457);
        EXPECT_EQ(port->product(), 0x1022);
        EXPECT_TRUE(port->high_speed());
        EXPECT_EQ(port->packet_size(0x86), 512u);
        EXPECT_EQ(port->packet_size(0x87), 0u);
        EXPECT_EQ(port->endpoints().size(), 4u);
        const std::vector<uint8_t> query = {0x05, 0x00};
        port->write(0x01, query, deadline_in(5));
        std::vector<uint8_t> answer(512);
        ASSERT_EQ(port->read(0x81, answer, deadline_in(5)), 17u);
        EXPECT_EQ(std::string(answer.begin() + 2, answer.begin() + 12), "USB4C00001");
        try {
            port->read(0x87, answer, deadline_in(5));
            ADD_FAILURE() << "an endpoint that is not there";
        } catch (const DeviceError& error) {
            EXPECT_EQ(error.fault(), Fault::io);
        }
    }
    // Nothing stays open but what libusb's own initialisation keeps for the process.
    EXPECT_LE(open_files(), before + 1);
}

}  // namespace
}  // namespace drude
