#include "device/instruments/apt_message.h"

#include <gtest/gtest.h>

#include "device/apt_bytes.h"

namespace drude {
namespace {

TEST(AptMessage, HeadersAndDataAsThePublishedProtocolHasThem) {
    AptMessage home;
    home.id = 0x0443;
    home.parameter_1 = 1;
    EXPECT_EQ(encode_apt(home), (Bytes{0x43, 0x04, 0x01, 0x00, 0x50, 0x01}));
    AptMessage move;
    move.id = 0x0453;
    move.data = {0x01, 0x00, 0x40, 0x0D, 0x03, 0x00};  // channel 1, 200000
    EXPECT_EQ(encode_apt(move),
              (Bytes{0x53, 0x04, 0x06, 0x00, 0xD0, 0x01, 0x01, 0x00, 0x40, 0x0D, 0x03, 0x00}));
}

TEST(AptMessage, WhatAControllerSays) {
    const AptMessage done = parse_apt(Bytes{0x44, 0x04, 0x01, 0x00, 0x01, 0x50}, "mount");
    EXPECT_EQ(done.id, 0x0444);
    EXPECT_EQ(done.parameter_1, 1);
    EXPECT_TRUE(done.data.empty());
    const AptMessage message = parse_apt(status_message(0x0464, -200000, moving), "mount");
    const AptStatus status = parse_apt_status(message, "mount");
    EXPECT_EQ(message.id, 0x0464);
    EXPECT_EQ(message.destination, 0x01);
    EXPECT_EQ(status.channel, 1);
    EXPECT_EQ(status.position, -200000);
    EXPECT_TRUE(status.homed());
    EXPECT_TRUE(status.moving());
    const AptInfo info = parse_apt_info(parse_apt(info_message(55000001, "K10CR1"), "m"), "m");
    EXPECT_EQ(info.serial, 55000001u);
    EXPECT_EQ(info.model, "K10CR1");
    EXPECT_EQ(info.firmware, "1.0.3");
}

TEST(AptMessage, WhatIsNone) {
    const Bytes good = {0x44, 0x04, 0x01, 0x00, 0x01, 0x50};
    for (size_t at = 4; at < 6; ++at) {
        Bytes bad = good;
        bad[at] = 0x22;
        EXPECT_EQ(fault_of([&] { parse_apt(bad, "mount"); }), Fault::bad_frame) << at;
    }
    EXPECT_EQ(fault_of([&] { parse_apt(Bytes{0x44, 0x04}, "mount"); }), Fault::short_read);
    Bytes status = status_message(0x0464, 0, 0);
    status.pop_back();
    EXPECT_EQ(fault_of([&] { parse_apt(status, "mount"); }), Fault::short_read);
    status.insert(status.end(), {0, 0});
    EXPECT_EQ(fault_of([&] { parse_apt(status, "mount"); }), Fault::bad_frame);
    // A header that promises 64 KiB is one that was read from the middle of a message.
    EXPECT_EQ(fault_of([&] {
                  apt_data_size(Bytes{0, 0, 0xFF, 0xFF, 0x81, 0x50}, "mount");
              }),
              Fault::bad_frame);
    EXPECT_EQ(
        fault_of([&] { parse_apt_status(parse_apt(from_unit(0x0481, Bytes(13)), "m"), "m"); }),
        Fault::bad_frame);
    EXPECT_EQ(fault_of([&] { parse_apt_info(parse_apt(info_message(1, "\x01\x02"), "m"), "m"); }),
              Fault::bad_frame);
}

TEST(AptMessage, StatusBitsInWords) {
    EXPECT_EQ(apt_status_errors(homed), "");
    EXPECT_EQ(apt_status_errors(0x4000), "position error too large");
    EXPECT_EQ(apt_status_errors(0x01020000), "too hot, motor current limit");
}

}  // namespace
}  // namespace drude
