// `drude devices`: what it says of instruments that are plugged in, and the rules it prints.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "cli/program.h"
#include "device/instrument_family.h"

namespace drude {
namespace {

TEST(Devices, PrintsTheRulesFileThatIsInstalled) {
    const TemporaryFolder folder;
    const ProgramRun run = run_drude(folder, "devices --udev-rules");
    EXPECT_EQ(run.status, 0) << run.err;
    EXPECT_EQ(run.out, udev_rules_file());
}

TEST(Devices, SaysHowADeviceIsOpenedAndWhatItCanDo) {
    if (std::system("umockdev-run --version >/dev/null 2>&1") != 0) GTEST_SKIP();
    const TemporaryFolder folder;
    // A USB4000 without a serial number, with its one vendor-specific interface.
    write_text(folder.file("one.umockdev"),
               "P: /devices/pci0000:00/usb1/1-4\nN: bus/usb/001/004\n"
               "E: SUBSYSTEM=usb\nE: DEVTYPE=usb_device\nE: BUSNUM=001\nE: DEVNUM=004\n"
               "E: DEVNAME=/dev/bus/usb/001/004\nE: MAJOR=189\nE: MINOR=3\n"
               "A: busnum=1\\n\nA: devnum=4\\n\nA: dev=189:3\\n\nA: speed=480\\n\n"
               "A: bConfigurationValue=1\\n\n"
               "H: descriptors=120100020000004057242210000100000001"
               "0902120001010080320904000000FF000000\n");
    write_text(folder.file("one.ioctl"), "USBDEVFS_GET_CAPABILITIES 0 FF010000\n");
    const std::string inside = "umockdev-run -d one.umockdev -i /dev/bus/usb/001/004=one.ioctl -- ";
    const ProgramRun text = run_drude(folder, "devices", inside);
    EXPECT_EQ(text.status, 0) << text.err;
    EXPECT_NE(text.out.find("Ocean Optics USB4000 / Flame-T (spectrometer)\n  ooi: "),
              std::string::npos)
        << text.out;
    EXPECT_NE(text.out.find("intensities of 3840 pixels, integration 10 us to 65.53 s, lamp line"),
              std::string::npos)
        << text.out;
    EXPECT_NE(text.out.find("virtual:MATERIAL"), std::string::npos);

    const ProgramRun run = run_drude(folder, "devices --json", inside);
    const nlohmann::json document = nlohmann::json::parse(run.out);
    ASSERT_EQ(document["usb"].size(), 1u) << run.out;
    const nlohmann::json& device = document["usb"][0];
    EXPECT_EQ(device["uri"], "ooi:");
    EXPECT_EQ(device["plays"], "spectrometer");
    EXPECT_EQ(device["speed"], "high");
    EXPECT_NE(device["capabilities"].get<std::string>().find("3840 pixels"), std::string::npos);
    EXPECT_EQ(document["virtual"], "virtual:MATERIAL");
}

}  // namespace
}  // namespace drude
