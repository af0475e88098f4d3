#include "device/instruments/obp_message.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "device/device_error.h"
#include "device/instrument_family.h"
#include "device/instruments/obp_models.h"
#include "faults.h"

namespace drude {
namespace {

using Bytes = std::vector<uint8_t>;

// Set the integration time to 100 ms, with an acknowledgement asked for: 64 bytes.
const Bytes set_time = {
    0xC1, 0xC0, 0x00, 0x11, 0x04, 0x00, 0x00, 0x00, 0x10, 0x00, 0x11, 0x00, 0x07, 0x00, 0x00, 0x00,
    0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x04, 0xA0, 0x86, 0x01, 0x00, 0x00, 0x00, 0x00, 0x00,
    0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x14, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00,
    0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0xC5, 0xC4, 0xC3, 0xC2};

ObpMessage set_time_message() {
    ObpMessage message;
    message.flags = obp_ack_request;
    message.type = 0x00110010;
    message.regarding = 7;
    message.data = {0xA0, 0x86, 0x01, 0x00};
    return message;
}

TEST(ObpMessage, GoldenBytes) {
    EXPECT_EQ(format_obp_message(set_time_message()), set_time);
    EXPECT_EQ(parse_obp_message(set_time, "it"), set_time_message());
    EXPECT_EQ(obp_message_bytes(set_time, "it"), 64u);
}

TEST(ObpMessage, MoreThanSixteenBytesAreAPayload) {
    ObpMessage message = set_time_message();
    message.version = 0x2000;
    for (const size_t size : {0u, 1u, 16u, 17u, 2048u}) {
        message.data.assign(size, 0x5A);
        for (const bool checksum : {false, true}) {
            const Bytes bytes = format_obp_message(message, checksum);
            EXPECT_EQ(bytes.size(), 64 + (size > 16 ? size : 0));
            EXPECT_EQ(parse_obp_message(bytes, "it"), message);
        }
    }
}

// The checksum of the golden message, by md5sum (GNU coreutils) of its first 44 bytes with the kind
// of checksum set to 1.
TEST(ObpMessage, TheChecksumIsTheMd5OfWhatComesBefore) {
    const Bytes sum = {0x5D, 0x78, 0xAD, 0x83, 0x02, 0xAE, 0x77, 0x94,
                       0x35, 0xF8, 0xDC, 0x4D, 0x38, 0x0F, 0xA9, 0x4B};
    const Bytes bytes = format_obp_message(set_time_message(), true);
    EXPECT_TRUE(std::equal(sum.begin(), sum.end(), bytes.begin() + 44));
}

TEST(ObpMessage, EveryDamagedByteUnderAChecksumIsSeen) {
    ObpMessage message = set_time_message();
    message.data.assign(20, 0x5A);
    const Bytes good = format_obp_message(message, true);
    for (size_t i = 0; i < good.size(); ++i) {
        if (i == 22) continue;  // the kind of checksum itself: 0 would mean none
        for (const int flip : {0x01, 0x80}) {
            Bytes bad = good;
            bad[i] = static_cast<uint8_t>(bad[i] ^ flip);
            EXPECT_THROW(parse_obp_message(bad, "it"), DeviceError) << i;
        }
    }
    Bytes mismatch = good;
    mismatch[50] ^= 1;
    EXPECT_EQ(fault_of_it([&] { parse_obp_message(mismatch, "it"); }), Fault::bad_frame);
}

TEST(ObpMessage, WhatIsNoMessageIsRefused) {
    const auto changed = [](size_t at, uint8_t to) {
        Bytes bytes = set_time;
        bytes[at] = to;
        return bytes;
    };
    const auto fault = [](const Bytes& bytes) {
        return fault_of_it([&] { parse_obp_message(bytes, "it"); });
    };
    EXPECT_EQ(fault(changed(0, 0xC0)), Fault::bad_frame);   // start
    EXPECT_EQ(fault(changed(3, 0x30)), Fault::bad_frame);   // version
    EXPECT_EQ(fault(changed(22, 2)), Fault::bad_frame);     // kind of checksum
    EXPECT_EQ(fault(changed(23, 17)), Fault::bad_frame);    // length of immediate data
    EXPECT_EQ(fault(changed(40, 19)), Fault::bad_frame);    // no room for the trailer
    EXPECT_EQ(fault(changed(43, 0xFF)), Fault::bad_frame);  // four gigabytes follow
    EXPECT_EQ(fault(changed(40, 21)), Fault::short_read);   // one byte more is announced
    EXPECT_EQ(fault(changed(63, 0)), Fault::bad_frame);     // footer
    EXPECT_EQ(fault({}), Fault::short_read);
    EXPECT_EQ(fault(Bytes(set_time.begin(), set_time.begin() + 43)), Fault::short_read);
    EXPECT_EQ(fault(Bytes(set_time.begin(), set_time.end() - 1)), Fault::short_read);
    Bytes longer = set_time;
    longer.push_back(0);
    EXPECT_EQ(fault(longer), Fault::overflow);
    ObpMessage both = set_time_message();
    both.data.assign(17, 1);
    Bytes twice = format_obp_message(both);
    twice[23] = 4;  // data in the header besides the payload
    EXPECT_EQ(fault(twice), Fault::bad_frame);
}

TEST(ObpMessage, NumbersAndFloats) {
    EXPECT_EQ(parse_obp_number(Bytes{0x12}, "n", "it"), 0x12u);
    EXPECT_EQ(parse_obp_number(Bytes{0x34, 0x12}, "n", "it"), 0x1234u);
    EXPECT_EQ(parse_obp_number(Bytes{0x78, 0x56, 0x34, 0x92}, "n", "it"), 0x92345678u);
    EXPECT_EQ(fault_of_it([] { parse_obp_number(Bytes{1, 2, 3}, "n", "it"); }), Fault::bad_frame);
    EXPECT_EQ(fault_of_it([] { parse_obp_number({}, "n", "it"); }), Fault::bad_frame);
    // IEEE 754: 1.5 = 3FC00000, -0.25 = BE800000, NaN.
    const std::vector<double> values =
        parse_obp_floats(Bytes{0, 0, 0xC0, 0x3F, 0, 0, 0x80, 0xBE, 0, 0, 0xC0, 0x7F}, "c", "it");
    ASSERT_EQ(values.size(), 3u);
    EXPECT_EQ(values[0], 1.5);
    EXPECT_EQ(values[1], -0.25);
    EXPECT_TRUE(std::isnan(values[2]));
    EXPECT_EQ(fault_of_it([] { parse_obp_floats(Bytes{1, 2, 3}, "c", "it"); }), Fault::bad_frame);
    EXPECT_EQ(fault_of_it([] { parse_obp_floats({}, "c", "it"); }), Fault::bad_frame);
}

TEST(ObpModels, EveryDeviceThatIsListedHasAModel) {
    int listed = 0;
    for (const KnownInstrument& known : known_instruments()) {
        if (known.family.scheme != "obp") continue;
        ++listed;
        const ObpModel* model = find_obp_model(known.vendor, known.product);
        ASSERT_NE(model, nullptr) << known.family.name;
        EXPECT_NE(known.family.name.find(model->name), std::string::npos);
        EXPECT_EQ(model->second, known.vendor == 0x0999);
        EXPECT_LT(model->shortest_us, model->longest_us);
    }
    EXPECT_EQ(listed, 12);
    EXPECT_EQ(find_obp_model(0x2457, 0x1022), nullptr);
    EXPECT_EQ(find_obp_model(0x2457, 0x4004)->spectrum_bytes(), 4208u);
}

}  // namespace
}  // namespace drude
