#include "device/instruments/ooi_protocol.h"

#include <gtest/gtest.h>

#include <cmath>

#include "device/device_error.h"
#include "device/instrument_family.h"
#include "device/instruments/stored_calibration.h"
#include "faults.h"

namespace drude {
namespace {

OoiModel small_model() {
    OoiModel model = *find_ooi_model(0x1022);
    model.pixels = 3;
    return model;
}

TEST(OoiProtocol, RequestsAreTheDataSheetsBytes) {
    EXPECT_EQ(ooi_initialize(), (OoiBytes{0x01}));
    EXPECT_EQ(ooi_set_integration_time(100000), (OoiBytes{0x02, 0xA0, 0x86, 0x01, 0x00}));
    EXPECT_EQ(ooi_set_integration_time(0xFEDCBA98), (OoiBytes{0x02, 0x98, 0xBA, 0xDC, 0xFE}));
    EXPECT_EQ(ooi_set_lamp(true), (OoiBytes{0x03, 0x01, 0x00}));
    EXPECT_EQ(ooi_set_lamp(false), (OoiBytes{0x03, 0x00, 0x00}));
    EXPECT_EQ(ooi_query_slot(17), (OoiBytes{0x05, 0x11}));
    EXPECT_EQ(ooi_request_spectrum(), (OoiBytes{0x09}));
    EXPECT_EQ(ooi_set_trigger_mode(3), (OoiBytes{0x0A, 0x03, 0x00}));
    EXPECT_EQ(ooi_query_status(), (OoiBytes{0xFE}));
}

TEST(OoiProtocol, SlotsAreTextAfterAnEcho) {
    const OoiBytes reply = {0x05, 0x01, '1', '.', '7', '8', 'e', '+', '0',
                            '2',  0,    '9', 0,   0,   0,   0,   0};
    const auto slot = parse_ooi_slot(reply, 1, "it");
    EXPECT_EQ(stored_text(slot), "1.78e+02");
    EXPECT_EQ(ooi_slot_number(slot), 178.0);

    EXPECT_EQ(fault_of_it([&] { parse_ooi_slot(reply, 2, "it"); }), Fault::bad_frame);
    OoiBytes shorter = reply, longer = reply, other = reply;
    shorter.pop_back();
    longer.push_back(0);
    other[0] = 0x06;
    EXPECT_EQ(fault_of_it([&] { parse_ooi_slot(shorter, 1, "it"); }), Fault::short_read);
    EXPECT_EQ(fault_of_it([&] { parse_ooi_slot({}, 1, "it"); }), Fault::short_read);
    EXPECT_EQ(fault_of_it([&] { parse_ooi_slot(longer, 1, "it"); }), Fault::overflow);
    EXPECT_EQ(fault_of_it([&] { parse_ooi_slot(other, 1, "it"); }), Fault::bad_frame);
}

TEST(OoiProtocol, ANumberIsTheWholeOfASlot) {
    const auto number = [](std::string text) {
        std::array<uint8_t, 15> slot{};
        for (size_t i = 0; i < text.size(); ++i) slot[i] = static_cast<uint8_t>(text[i]);
        return ooi_slot_number(slot);
    };
    EXPECT_EQ(number(" 0.25 "), 0.25);
    EXPECT_EQ(number("-1.5E-05"), -1.5e-5);
    EXPECT_TRUE(std::isnan(number("")));
    EXPECT_TRUE(std::isnan(number("12 34")));
    EXPECT_TRUE(std::isnan(number("\xFF\xFF\xFF\xFF\xFF\xFF\xFF\xFF\xFF\xFF\xFF\xFF\xFF\xFF\xFF")));
}

TEST(OoiProtocol, StatusGivesPixelsTimeAndSpeed) {
    OoiBytes reply = {0x00, 0x0F, 0x10, 0x27, 0, 0, 1, 0, 0, 15, 1, 0, 0, 0, 0x80, 0};
    const OoiStatus status = parse_ooi_status(reply, "it");
    EXPECT_EQ(status.pixels, 3840);
    EXPECT_EQ(status.integration_units, 10000u);
    EXPECT_TRUE(status.lamp);
    EXPECT_TRUE(status.high_speed);
    reply[14] = 0;
    EXPECT_FALSE(parse_ooi_status(reply, "it").high_speed);
    reply[14] = 0x40;
    EXPECT_EQ(fault_of_it([&] { parse_ooi_status(reply, "it"); }), Fault::bad_frame);
    reply.pop_back();
    EXPECT_EQ(fault_of_it([&] { parse_ooi_status(reply, "it"); }), Fault::short_read);
}

TEST(OoiProtocol, AFrameIsCountsAndASyncByte) {
    OoiBytes frame = {0x34, 0x12, 0xFF, 0xFF, 0x00, 0x80, 0x69};
    EXPECT_EQ(parse_ooi_frame(frame, small_model(), "it"),
              (std::vector<uint32_t>{0x1234, 0xFFFF, 0x8000}));
    OoiModel flipped = small_model();
    flipped.flip = 0x2000;
    EXPECT_EQ(parse_ooi_frame(frame, flipped, "it"),
              (std::vector<uint32_t>{0x3234, 0xDFFF, 0xA000}));

    OoiBytes lost = frame;
    lost.back() = 0x00;
    EXPECT_EQ(fault_of_it([&] { parse_ooi_frame(lost, small_model(), "it"); }), Fault::bad_frame);
    const OoiBytes shorter(frame.begin() + 1, frame.end());  // still ends with 69
    OoiBytes longer = frame;
    longer.push_back(0x69);
    EXPECT_EQ(fault_of_it([&] { parse_ooi_frame(shorter, small_model(), "it"); }),
              Fault::short_read);
    EXPECT_EQ(fault_of_it([&] { parse_ooi_frame(longer, small_model(), "it"); }), Fault::overflow);
    EXPECT_EQ(fault_of_it([&] { parse_ooi_frame({}, small_model(), "it"); }), Fault::short_read);
}

TEST(OoiProtocol, AJazSendsNoSyncByte) {
    OoiModel jaz = *find_ooi_model(0x2000);
    EXPECT_EQ(jaz.frame_bytes(), 4096u);
    jaz.pixels = 1;
    EXPECT_EQ(parse_ooi_frame(OoiBytes{0x01, 0x02}, jaz, "it"), (std::vector<uint32_t>{0x0201}));
}

// A USB2000 sends the low bytes of 64 pixels, then their high nibbles; pixel i is (i * 31 + 7) mod
// 4096, with noise on the lines that nobody drives.
TEST(OoiProtocol, AUsb2000SendsLowAndHighBytesInTurns) {
    const OoiModel& model = *find_ooi_model(0x1002);
    OoiBytes frame(model.frame_bytes());
    for (uint32_t block = 0; block < 32; ++block) {
        for (uint32_t i = 0; i < 64; ++i) {
            const uint32_t count = ((64 * block + i) * 31 + 7) % 4096;
            frame[128 * block + i] = static_cast<uint8_t>(count);
            frame[128 * block + 64 + i] = static_cast<uint8_t>(count >> 8 | (i % 16) << 4);
        }
    }
    frame.back() = 0x69;
    const std::vector<uint32_t> counts = parse_ooi_frame(frame, model, "it");
    ASSERT_EQ(counts.size(), 2048u);
    for (uint32_t i = 0; i < 2048; ++i) ASSERT_EQ(counts[i], (i * 31 + 7) % 4096) << i;
}

TEST(OoiProtocol, SaturationIsWhereTheModelKeepsIt) {
    std::array<uint8_t, 15> slot{};
    slot[0] = 0x40, slot[1] = 0x9C;                                  // 40000 at byte 2 of the reply
    slot[4] = 0x60, slot[5] = 0xEA, slot[6] = 0x00, slot[7] = 0x01;  // 60000 at byte 6; 125536 long
    EXPECT_EQ(parse_ooi_saturation(slot, *find_ooi_model(0x1022)), 60000u);
    EXPECT_EQ(parse_ooi_saturation(slot, *find_ooi_model(0x102A)), 40000u);
    EXPECT_EQ(parse_ooi_saturation(slot, *find_ooi_model(0x1026)), 65535u);  // above the maximum
    EXPECT_EQ(parse_ooi_saturation(slot, *find_ooi_model(0x1012)), 16383u);  // keeps none
    slot = {};
    EXPECT_EQ(parse_ooi_saturation(slot, *find_ooi_model(0x1022)), 65535u);
    slot[0] = 0x00, slot[1] = 0x80;  // 32768: never written
    EXPECT_EQ(parse_ooi_saturation(slot, *find_ooi_model(0x102A)), 64000u);
}

TEST(OoiModels, EveryDeviceThatIsListedHasAModel) {
    int listed = 0;
    for (const KnownInstrument& known : known_instruments()) {
        if (known.family.scheme != "ooi") continue;
        ++listed;
        const OoiModel* model = find_ooi_model(known.product);
        ASSERT_NE(model, nullptr) << known.family.name;
        EXPECT_EQ("Ocean Optics " + std::string(model->name), known.family.name);
        EXPECT_GT(model->pixels, 0);
        EXPECT_LT(model->shortest_us, model->longest_us);
        EXPECT_EQ(model->shortest_us % model->unit_us, 0u) << known.family.name;
    }
    EXPECT_EQ(listed, 14);
    EXPECT_EQ(find_ooi_model(0x4000), nullptr);
}

// Memory that was never written is no name.
TEST(StoredCalibration, TextEndsWhereNothingWasWritten) {
    const OoiBytes erased(15, 0xFF), name = {'U', '1', ' ', 0xFF, 0xFF}, odd = {'a', 0x80, 'b', 0};
    EXPECT_EQ(stored_text(erased), "");
    EXPECT_EQ(stored_text(name), "U1");
    EXPECT_EQ(stored_text(odd), "a?b");
}

TEST(StoredCalibration, WavelengthsAreAPolynomialOfThePixel) {
    const std::vector<double> nm = polynomial_wavelengths({340, 0.25, -1e-5}, 3, -1, "it");
    ASSERT_EQ(nm.size(), 3u);
    EXPECT_DOUBLE_EQ(nm[0], 340 - 0.25 - 1e-5);
    EXPECT_DOUBLE_EQ(nm[1], 340);
    EXPECT_DOUBLE_EQ(nm[2], 340.25 - 1e-5);
    EXPECT_EQ(fault_of_it([] {
                  polynomial_wavelengths({340, NAN}, 3, 0, "it");
              }),
              Fault::bad_frame);
    EXPECT_EQ(fault_of_it([] { polynomial_wavelengths({340, 0}, 3, 0, "it"); }), Fault::bad_frame);
    EXPECT_EQ(fault_of_it([] {
                  polynomial_wavelengths({0, 0, 0, 0}, 3, 0, "it");
              }),
              Fault::bad_frame);
    EXPECT_EQ(fault_of_it([] { polynomial_wavelengths({}, 3, 0, "it"); }), Fault::bad_frame);
    // Descends from pixel 50 on.
    EXPECT_EQ(fault_of_it([] {
                  polynomial_wavelengths({340, 1, -0.01}, 100, 0, "it");
              }),
              Fault::bad_frame);
}

TEST(StoredCalibration, NonlinearityThatCannotBeDividedByIsRefused) {
    EXPECT_EQ(why_nonlinearity_is_unusable({1, -3e-7}, 65535), "");
    EXPECT_EQ(why_nonlinearity_is_unusable({}, 65535), "there are none");
    EXPECT_NE(why_nonlinearity_is_unusable({0, 1e-5}, 65535).find("the first is 0"),
              std::string::npos);
    EXPECT_NE(why_nonlinearity_is_unusable({1, NAN}, 65535).find("not a number"),
              std::string::npos);
    EXPECT_NE(why_nonlinearity_is_unusable({1, INFINITY}, 65535).find("not a number"),
              std::string::npos);
    // Below a half from 50001 counts on; looked at in 256 steps, that is 196 * 65535 / 256.
    EXPECT_NE(why_nonlinearity_is_unusable({1, -1e-5}, 65535).find("divide 50175.234375 counts"),
              std::string::npos);
}

}  // namespace
}  // namespace drude
