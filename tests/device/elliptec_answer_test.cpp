#include "device/instruments/elliptec_answer.h"

#include <gtest/gtest.h>

#include "device/ftdi_packets.h"

namespace drude {
namespace {

const char* const ell14 = "0IN0E1140058720220201016800023000";

TEST(ElliptecAnswer, TheIdentityOfAnEll14) {
    const auto answer = parse_elliptec_answer(ell14);
    ASSERT_TRUE(answer);
    EXPECT_EQ(answer->address, '0');
    EXPECT_EQ(answer->code, "IN");
    const ElliptecIdentity identity = parse_elliptec_identity(*answer, "mount");
    EXPECT_EQ(identity.type, 0x0E);
    EXPECT_EQ(identity.model, "ELL14");
    EXPECT_EQ(identity.serial, "11400587");
    EXPECT_EQ(identity.year, 2022);
    EXPECT_EQ(identity.firmware, "02");
    EXPECT_EQ(identity.travel_deg, 360);
    EXPECT_EQ(identity.pulses_per_turn, 143360);
}

TEST(ElliptecAnswer, OtherLinesAreNone) {
    for (const char* line : {"", "0", "0P", "GPO0000000", "0po00000000", "0PO0000000g", " 0GS00",
                             "0GS00 ", "0PO-0000001"}) {
        EXPECT_FALSE(parse_elliptec_answer(line)) << line;
    }
}

TEST(ElliptecAnswer, PositionsAreTwosComplement) {
    const auto position = [](const char* line) {
        return parse_elliptec_position(*parse_elliptec_answer(line), "mount");
    };
    EXPECT_EQ(position("0PO00008C00"), 35840);
    EXPECT_EQ(position("0POFFFFFFFE"), -2);
    EXPECT_EQ(position("0PO80000000"), -2147483648LL);
    EXPECT_EQ(position("0PO7FFFFFFF"), 2147483647LL);
    EXPECT_EQ(fault_of([&] { position("0PO0000000"); }), Fault::bad_frame);
    EXPECT_EQ(fault_of([&] { position("0PO000000000"); }), Fault::bad_frame);
    EXPECT_EQ(fault_of([&] { position("0GS00"); }), Fault::bad_frame);
}

TEST(ElliptecAnswer, EveryStatusHasWords) {
    EXPECT_EQ(elliptec_status_words(0), "no error");
    EXPECT_EQ(elliptec_status_words(2), "mechanical time-out");
    EXPECT_EQ(elliptec_status_words(9), "busy");
    EXPECT_EQ(elliptec_status_words(13), "over-current");
    EXPECT_EQ(elliptec_status_words(14), "reserved code");
    EXPECT_EQ(elliptec_status_words(255), "reserved code");
    EXPECT_EQ(elliptec_status_fault(2), Fault::mechanical);
    EXPECT_EQ(elliptec_status_fault(3), Fault::refused);
    EXPECT_EQ(parse_elliptec_status(*parse_elliptec_answer("AGS0D"), "mount"), 13);
}

TEST(ElliptecAnswer, IdentitiesThatCannotBeUsed) {
    const auto identity = [](const char* line) {
        parse_elliptec_identity(*parse_elliptec_answer(line), "mount");
    };
    EXPECT_EQ(fault_of([&] { identity("0IN0E114005872022020101680002300"); }), Fault::bad_frame);
    EXPECT_EQ(fault_of([&] { identity("0IN0E11400587202A0201016800023000"); }), Fault::bad_frame);
    EXPECT_EQ(fault_of([&] { identity("0IN0E1140058720220201016800000000"); }), Fault::bad_frame);
    EXPECT_EQ(fault_of([&] { identity("0IN0E11400587202202010168FFFFFFFF"); }), Fault::bad_frame);
    // A linear stage, and a rotary type whose travel is not a turn.
    EXPECT_EQ(fault_of([&] { identity("0IN111140058720220201001C00000400"); }), Fault::refused);
    EXPECT_EQ(fault_of([&] { identity("0IN0E1140058720220201001C00023000"); }), Fault::refused);
}

}  // namespace
}  // namespace drude
