#include "device/instruments/registry.h"

#include <gtest/gtest.h>

#include <functional>
#include <string>

#include "base/expect_error.h"
#include "device/instrument_family.h"

namespace drude {
namespace {

void expect_in(const std::string& part, const std::string& message) {
    EXPECT_NE(message.find(part), std::string::npos) << message;
}

TEST(InstrumentUri, EverySchemeIsTakenApart) {
    EXPECT_EQ(parse_instrument_uri("ooi:USB4C00001").scheme, "ooi");
    EXPECT_EQ(parse_instrument_uri("ooi:USB4C00001").serial, "USB4C00001");
    EXPECT_EQ(parse_instrument_uri("obp:").serial, "");
    EXPECT_EQ(parse_instrument_uri("apt:55000001").serial, "55000001");
    const InstrumentUri mount = parse_instrument_uri("ell:DK0AHAJZ/b");
    EXPECT_EQ(mount.serial, "DK0AHAJZ");
    EXPECT_EQ(mount.address, "B");
    EXPECT_EQ(parse_instrument_uri("ell:/2").address, "2");
    const InstrumentUri head = parse_instrument_uri("usbtmc:1209:5E11:A:B");
    EXPECT_EQ(head.vendor, 0x1209);
    EXPECT_EQ(head.product, 0x5E11);
    EXPECT_EQ(head.serial, "A:B");
    EXPECT_EQ(parse_instrument_uri("usbtmc:1:2").serial, "");
}

TEST(InstrumentUri, WhatIsNoneSaysWhatIsExpected) {
    const auto error = [](const std::string& uri) {
        return message_of([&] { parse_instrument_uri(uri); });
    };
    expect_in("expected SCHEME:SERIAL, e.g. ooi:USB4C00001", error("USB4C00001"));
    expect_in("did you mean 'ooi'?", error("oii:USB4C00001"));
    expect_in("ooi, obp, ell, apt, usbtmc", error("gpib:7"));
    expect_in("whole bench", error("virtual:Cu"));
    for (const char* bad : {"ell:DK0AHAJZ", "ell:DK0AHAJZ/", "ell:DK0AHAJZ/G", "ell:DK0AHAJZ/10"}) {
        expect_in("an address from 0 to F, e.g. ell:DK0AHAJZ/0", error(bad));
    }
    for (const char* bad : {"usbtmc:", "usbtmc:1209", "usbtmc:12345:1", "usbtmc:12x9:5e11:S"}) {
        expect_in("expected usbtmc:VID:PID:SERIAL", error(bad));
    }
}

TEST(InstrumentUri, WhatIsPrintedCanBeOpened) {
    for (const KnownInstrument& known : known_instruments()) {
        const std::string uri =
            instrument_uri(known.family.scheme, known.vendor, known.product, "S1");
        const InstrumentUri parsed = parse_instrument_uri(uri);
        EXPECT_EQ(parsed.scheme, known.family.scheme);
        EXPECT_EQ(parsed.serial, "S1");
        EXPECT_NE(instrument_capabilities(known.family.scheme, known.vendor, known.product), "");
    }
    EXPECT_EQ(parse_instrument_uri(instrument_uri("usbtmc", 0x1209, 0x5E11, "S1")).product, 0x5E11);
    EXPECT_EQ(instrument_uri("", 1, 2, "S1"), "");
    EXPECT_EQ(instrument_capabilities("", 1, 2), "");
}

TEST(Registry, APartThatPlaysAnotherRoleIsRefused) {
    expect_in("'ooi:X' plays spectrometer, where a rotator is wanted (ell:, apt:)",
              message_of([] { open_rotator("ooi:X"); }));
    expect_in("where a spectrometer is wanted (ooi:, obp:, usbtmc:)",
              message_of([] { open_spectrometer("ell:X/0"); }));
    expect_in("where a head is wanted (usbtmc:)", message_of([] { open_head("apt:X"); }));
}

TEST(UdevRules, EveryDeviceThatIsOpenedHasItsRule) {
    const std::string rules = udev_rules_file();
    for (const KnownInstrument& known : known_instruments()) {
        expect_in(udev_rule(known.vendor, known.product) + "\n", rules);
    }
    expect_in("ENV{ID_USB_INTERFACES}==\"*:fe03??:*\"", rules);
    // Every rule that names a vendor names a product: FTDI's chips sit in anything.
    for (size_t at = rules.find("idVendor"); at != std::string::npos;
         at = rules.find("idVendor", at + 1)) {
        const std::string line = rules.substr(at, rules.find('\n', at) - at);
        expect_in("idProduct", line);
    }
    EXPECT_LT(std::string(udev_rules_name), "73-seat-late.rules");
}

}  // namespace
}  // namespace drude
