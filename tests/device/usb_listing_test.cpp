#include "device/usb/usb_listing.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

namespace drude {
namespace {

TEST(InstrumentFamily, KnownNumbersAreNamed) {
    EXPECT_EQ(instrument_family(0x2457, 0x1022, {}).name, "Ocean Optics USB4000 / Flame-T");
    EXPECT_EQ(instrument_family(0x0999, 0x1002, {}).kind, "spectrometer");
    EXPECT_EQ(instrument_family(0x0403, 0xFAF0, {}).kind, "rotation mount");
    EXPECT_TRUE(instrument_family(0x0403, 0xFAF0, {}).certain);
    EXPECT_FALSE(instrument_family(0x0403, 0x6015, {}).certain);
}

TEST(InstrumentFamily, TestAndMeasurementClassIsEnough) {
    const InstrumentFamily family = instrument_family(0x1234, 0x5678, {{3, 0, 0}, {0xFE, 3, 1}});
    EXPECT_EQ(family.kind, "instrument");
    EXPECT_EQ(instrument_family(0x1234, 0x5678, {{0xFE, 1, 1}}).name, "");
    EXPECT_EQ(instrument_family(0x2457, 0xFFFF, {}).name, "");
}

TEST(InstrumentFamily, UdevRuleNamesVendorAndProduct) {
    EXPECT_EQ(udev_rule(0x2457, 0x101E),
              "SUBSYSTEM==\"usb\", ATTR{idVendor}==\"2457\", ATTR{idProduct}==\"101e\", "
              "TAG+=\"uaccess\"");
}

TEST(Usb, ListingNeverFails) {
    const UsbListing listing = list_usb_devices();
    for (size_t i = 1; i < listing.devices.size(); ++i) {
        const UsbDevice &a = listing.devices[i - 1], &b = listing.devices[i];
        EXPECT_TRUE(a.bus < b.bus || (a.bus == b.bus && a.address < b.address));
    }
    EXPECT_TRUE(listing.note.empty() || listing.devices.empty());
}

// The rest runs inside a mocked /sys and /dev (umockdev), where libusb finds two devices.
constexpr const char* inside = "DRUDE_TEST_INSIDE_UMOCKDEV";

// A record for umockdev: vendor and product as 4 hexadecimal digits, the address below 10, and
// class, subclass and protocol of the only interface as 6.
std::string mocked_device(const std::string& vendor, const std::string& product, int address,
                          const std::string& interface) {
    const auto swapped = [](const std::string& word) { return word.substr(2) + word.substr(0, 2); };
    const std::string number = std::to_string(address), node = "bus/usb/001/00" + number;
    const std::string minor = std::to_string(address - 1);
    return "P: /devices/pci0000:00/usb1/1-" + number + "\nN: " + node +
           "\nE: SUBSYSTEM=usb\nE: DEVTYPE=usb_device\nE: BUSNUM=001\nE: DEVNUM=00" + number +
           "\nE: DEVNAME=/dev/" + node + "\nE: MAJOR=189\nE: MINOR=" + minor +
           "\nA: busnum=1\\n\nA: devnum=" + number + "\\n\nA: dev=189:" + minor +
           "\\n\nA: speed=480\\n\nA: bConfigurationValue=1\\n\nH: descriptors=" +
           "1201000200000040" + swapped(vendor) + swapped(product) + "010000000001" +
           "0902120001010080320904000000" + interface + "00\n\n";
}

TEST(Usb, FindsAMockedSpectrometerAndAnInstrument) {
    if (!std::getenv(inside)) {
        if (std::system("umockdev-run --version >/dev/null 2>&1") != 0) {
            GTEST_SKIP() << "umockdev-run is not installed";
        }
        const std::string file = testing::TempDir() + "drude_two_devices.umockdev";
        std::ofstream(file)
            // One vendor-specific interface; then one of the class FE/03/01.
            << mocked_device("2457", "1022", 4, "FF0000")
            << mocked_device("1234", "5678", 5, "FE0301");
        const std::string self = std::filesystem::read_symlink("/proc/self/exe").string();
        const std::string command = std::string(inside) + "=1 umockdev-run -d '" + file + "' -- '" +
                                    self + "' --gtest_filter=Usb.FindsAMocked*";
        EXPECT_EQ(std::system(command.c_str()), 0);
        std::filesystem::remove(file);
        return;
    }
    const UsbListing listing = list_usb_devices();
    ASSERT_EQ(listing.devices.size(), 2u) << listing.note;
    EXPECT_EQ(listing.devices[0].vendor, 0x2457);
    EXPECT_EQ(listing.devices[0].product, 0x1022);
    EXPECT_EQ(listing.devices[0].address, 4);
    EXPECT_EQ(listing.devices[0].family.kind, "spectrometer");
    EXPECT_EQ(listing.devices[1].vendor, 0x1234);
    EXPECT_EQ(listing.devices[1].family.kind, "instrument");
}

}  // namespace
}  // namespace drude
