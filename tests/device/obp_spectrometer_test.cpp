#include "device/instruments/obp_spectrometer.h"

#include <gtest/gtest.h>

#include <bit>
#include <map>
#include <set>

#include "device/instruments/obp_message.h"
#include "fake_usb_port.h"
#include "faults.h"

namespace drude {
namespace {

void put(Bytes& bytes, uint32_t value, int count) {
    for (int i = 0; i < count; ++i) bytes.push_back(static_cast<uint8_t>(value >> (8 * i)));
}

Bytes floats(const std::vector<float>& values) {
    Bytes bytes;
    for (const float value : values) put(bytes, std::bit_cast<uint32_t>(value), 4);
    return bytes;
}

// A device that answers what is in `answers` (by message type, and by its argument for
// coefficients), acknowledges commands, and refuses everything else.
class FakeObp : public FakeUsbPort {
  public:
    explicit FakeObp(uint16_t product, uint16_t vendor = 0x2457, size_t packet = 512) {
        name_ = "it";
        serial_ = "S01234";
        vendor_ = vendor;
        product_ = product;
        packet_sizes_ = {{0x01, packet}, {0x81, packet}, {0x82, packet}};
        on_write = [this](uint8_t, const Bytes& bytes) { handle(bytes); };
    }

    std::map<uint32_t, Bytes> answers;
    std::map<uint32_t, std::vector<float>> coefficients;  // first version: of type and argument
    std::set<uint32_t> commands;                          // that are acknowledged
    std::vector<ObpMessage> requests;
    bool checksums = true, echo = true, terminate = false;
    // What is done instead of answering the next request of this type.
    uint32_t instead_of = 0;
    std::function<void(const ObpMessage&)> instead;

    void reply(const ObpMessage& request, const Bytes& data, uint16_t flags = obp_response,
               uint16_t error = 0) {
        ObpMessage message;
        message.version = request.version;
        message.flags = flags;
        message.error = error;
        message.type = request.type;
        message.regarding = echo ? request.regarding : 0;
        message.data = data;
        answer(0x81, format_obp_message(message, checksums), terminate);
    }

  private:
    void handle(const Bytes& bytes) {
        const ObpMessage request = parse_obp_message(bytes, "request");
        requests.push_back(request);
        if (instead && request.type == instead_of) {
            const auto act = std::move(instead);
            instead = nullptr;
            act(request);
        } else if (answers.count(request.type) > 0) {
            reply(request, answers[request.type]);
        } else if (coefficients.count(request.type) > 0) {
            reply(request, floats({coefficients[request.type].at(request.data.at(0))}));
        } else if (commands.count(request.type) > 0) {
            reply(request, {}, obp_response | obp_ack);
        } else {
            reply(request, {}, obp_response | obp_nack, 2);
        }
    }
};

struct Opened {
    explicit Opened(std::shared_ptr<FakeObp> with) : port(std::move(with)) {}
    std::shared_ptr<FakeObp> port;
    VirtualClock clock;
    std::shared_ptr<Spectrometer> spectrometer;
    void open() { spectrometer = open_obp(port, clock); }
};

// 1024 pixels, 12 bits in use; wavelengths 300 + 0.5 p.
std::shared_ptr<FakeObp> make_sts(size_t packet = 64) {
    auto port = std::make_shared<FakeObp>(uint16_t{0x4000}, uint16_t{0x2457}, packet);
    port->answers[0x000100] = {'S', '0', '1', '2', '3', '4', 0, 0};
    port->answers[0x180100] = {2};
    port->coefficients[0x180101] = {300, 0.5};
    port->answers[0x181100] = {2};
    port->coefficients[0x181101] = {1, -1e-6F};
    port->commands = {0x110010, 0x110110, 0x110410};
    port->answers[0x110400] = {0};
    Bytes spectrum;
    for (uint32_t i = 0; i < 1024; ++i) put(spectrum, 7 * i, 2);
    port->answers[0x101100] = spectrum;
    return port;
}

TEST(ObpSpectrometer, AnStsIsReadAndAsked) {
    // Messages that fill their packets, with and without an empty packet after them; firmware that
    // repeats the request's number and that does not; with checksums and without.
    for (const size_t packet : {64u, 512u}) {
        for (int variant = 0; variant < 8; ++variant) {
            Opened it(make_sts(packet));
            it.port->terminate = variant & 1;
            it.port->echo = variant & 2;
            it.port->checksums = variant & 4;
            it.open();
            const SpectrometerInfo& info = it.spectrometer->info();
            EXPECT_EQ(info.uri, "obp:S01234");
            EXPECT_EQ(info.serial, "S01234");
            EXPECT_EQ(info.model, "Ocean Optics STS");
            ASSERT_EQ(info.wavelength_nm.size(), 1024u);
            EXPECT_DOUBLE_EQ(info.wavelength_nm[1023], 811.5);
            ASSERT_EQ(info.nonlinearity.size(), 2u);
            EXPECT_TRUE(info.has_lamp_control);
            EXPECT_EQ(info.max_counts, 16383u);
            const Frame frame = it.spectrometer->acquire();
            ASSERT_EQ(frame.counts.size(), 1024u);
            EXPECT_EQ(frame.counts[1023], 7161u);
        }
    }
}

TEST(ObpSpectrometer, AQeProHasMetadataAndWideCounts) {
    auto port = std::make_shared<FakeObp>(uint16_t{0x4004});
    port->answers[0x000100] = {'Q', '1'};
    port->answers[0x180100] = {2};
    port->coefficients[0x180101] = {200, 0.75};
    port->commands = {0x110010, 0x110110};
    Bytes spectrum(32, 0xEE);
    for (uint32_t i = 0; i < 1044; ++i) put(spectrum, 250 * i, 4);
    port->answers[0x100928] = spectrum;
    Opened it(port);
    it.open();
    ASSERT_EQ(it.spectrometer->info().warnings.size(), 1u);  // no non-linearity
    EXPECT_FALSE(it.spectrometer->info().has_lamp_control);
    it.spectrometer->set_lamp(true);  // without effect
    // The buffer is empty at first.
    port->instead_of = 0x100928;
    port->instead = [&](const ObpMessage& request) { port->reply(request, {}); };
    EXPECT_EQ(it.spectrometer->acquire().counts[1043], 260750u);
}

// It gathers spectra by itself and hands out the oldest first.
TEST(ObpSpectrometer, AQeProForgetsWhatItGatheredBeforeTheRequest) {
    auto port = std::make_shared<FakeObp>(uint16_t{0x4004});
    port->answers[0x000100] = {'Q', '1'};
    port->answers[0x180100] = {2};
    port->coefficients[0x180101] = {200, 0.75};
    port->commands = {0x110010, 0x110110, 0x100830};
    const auto spectrum = [](uint32_t counts) {
        Bytes bytes(32, 0xEE);
        for (uint32_t i = 0; i < 1044; ++i) put(bytes, counts, 4);
        return bytes;
    };
    Opened it(port);
    it.open();
    EXPECT_EQ(it.spectrometer->info().max_counts, 200000u);
    port->answers[0x100928] = spectrum(1);  // old
    port->instead_of = 0x100830;
    port->instead = [&](const ObpMessage& request) {
        port->answers[0x100928] = spectrum(2);
        port->reply(request, {}, obp_response | obp_ack);
    };
    EXPECT_EQ(it.spectrometer->acquire().counts[0], 2u);
}

// The kernel would end a transfer there: 64 bytes in a packet of up to 512.
TEST(ObpSpectrometer, AMessageMayComeInShortPackets) {
    Opened it(make_sts(512));
    it.open();
    it.port->instead_of = 0x101100;
    it.port->instead = [&](const ObpMessage& request) {
        ObpMessage message = request;
        message.flags = obp_response;
        message.data = it.port->answers[0x101100];
        const Bytes bytes = format_obp_message(message, true);
        it.port->answer(0x81, Bytes(bytes.begin(), bytes.begin() + 64));
        it.port->answer(0x81, Bytes(bytes.begin() + 64, bytes.begin() + 1000));
        it.port->answer(0x81, Bytes(bytes.begin() + 1000, bytes.end()));
    };
    EXPECT_EQ(it.spectrometer->acquire().counts[1023], 7u * 1023);
}

TEST(ObpSpectrometer, AnotherOneInItsPlaceIsRefused) {
    Opened it(make_sts());
    it.open();
    it.port->unplug();
    EXPECT_EQ(fault_of_acquire(*it.spectrometer), Fault::unplugged);
    it.port->on_reopen = [](double) { return true; };
    it.port->answers[0x000100] = {'S', '9'};
    try {
        it.spectrometer->reconnect(1);
        ADD_FAILURE() << "taken for the same";
    } catch (const DeviceError& error) {
        EXPECT_EQ(error.fault(), Fault::refused);
        EXPECT_NE(error.message().find("S9"), std::string::npos) << error.message();
    }
}

TEST(ObpSpectrometer, AnHr4SpeaksTheSecondVersion) {
    auto port = std::make_shared<FakeObp>(uint16_t{0x1004}, uint16_t{0x0999});
    port->answers[0x000100] = {'H', 'R', '4', ' '};
    port->answers[0x001100] = floats({3, 350, 0.125});
    port->answers[0x001200] = floats({2, 1, 2e-7F});
    port->answers[0x011D00] = {0x60, 0xEA, 0, 0};
    port->commands = {0x000C01, 0x000D01};
    Bytes spectrum(32);
    for (uint32_t i = 0; i < 3648; ++i) put(spectrum, i, 2);
    port->answers[0x001C00] = spectrum;
    Opened it(port);
    it.open();
    EXPECT_EQ(it.port->requests[0].version, 0x2000);
    EXPECT_EQ(it.spectrometer->info().model, "Ocean Insight HR4");
    EXPECT_EQ(it.spectrometer->info().max_counts, 60000u);
    EXPECT_DOUBLE_EQ(it.spectrometer->info().wavelength_nm[8], 351);
    EXPECT_EQ(it.spectrometer->info().nonlinearity[0], 1.0);
    EXPECT_EQ(it.spectrometer->acquire().counts[3647], 3647u);
    it.port->requests.clear();
    it.spectrometer->set_integration_time(0.0125);
    EXPECT_EQ(it.port->requests.at(0).data, (Bytes{0xD4, 0x30, 0, 0}));
    EXPECT_EQ(it.port->requests[0].flags, obp_ack_request);
    EXPECT_THROW(it.spectrometer->set_integration_time(1e-3), Error);
}

TEST(ObpSpectrometer, FaultsAreNamedAndRecoveredFrom) {
    struct Case {
        Fault fault;
        std::function<void(FakeObp&, const ObpMessage&)> act;
    };
    const auto damaged = [](const ObpMessage& request) {
        ObpMessage message = request;
        message.flags = obp_response;
        message.data.assign(2048, 1);
        return format_obp_message(message, true);
    };
    const std::vector<Case> cases = {
        {Fault::timeout, [](FakeObp&, const ObpMessage&) {}},
        {Fault::stall, [](FakeObp& it, const ObpMessage&) { it.fail(0x81, Fault::stall); }},
        // A checksum that does not fit.
        {Fault::bad_frame,
         [&](FakeObp& it, const ObpMessage& request) {
             Bytes bytes = damaged(request);
             bytes[1000] ^= 1;
             it.answer(0x81, bytes);
         }},
        // Half a message.
        {Fault::short_read,
         [&](FakeObp& it, const ObpMessage& request) {
             Bytes bytes = damaged(request);
             bytes.resize(1000);
             it.answer(0x81, bytes);
         }},
        // More than the message says.
        {Fault::overflow,
         [&](FakeObp& it, const ObpMessage& request) {
             Bytes bytes = damaged(request);
             bytes.resize(bytes.size() + 7);
             it.answer(0x81, bytes);
         }},
        // A good message of too few pixels.
        {Fault::short_read,
         [](FakeObp& it, const ObpMessage& request) { it.reply(request, Bytes(2046)); }},
        // The device refuses, or found the request damaged.
        {Fault::refused,
         [](FakeObp& it, const ObpMessage& request) {
             it.reply(request, {}, obp_response | obp_nack, 7);
         }},
        {Fault::bad_frame,
         [](FakeObp& it, const ObpMessage& request) {
             it.reply(request, {}, obp_response | obp_nack, 3);
         }},
    };
    for (const Case& one : cases) {
        Opened it(make_sts(512));  // the last packet of a spectrum has room
        it.open();
        it.spectrometer->set_integration_time(0.02);
        it.spectrometer->set_lamp(true);
        it.port->instead_of = 0x101100;
        it.port->instead = [&](const ObpMessage& request) { one.act(*it.port, request); };
        EXPECT_EQ(fault_of_acquire(*it.spectrometer), one.fault);
        it.port->answer(0x81, Bytes(700, 0x42));  // late and meaningless
        it.port->requests.clear();
        it.spectrometer->recover();
        std::vector<uint32_t> types;
        for (const ObpMessage& request : it.port->requests) types.push_back(request.type);
        EXPECT_EQ(types, (std::vector<uint32_t>{0x110110, 0x110010, 0x110410}));
        EXPECT_EQ(it.spectrometer->acquire().counts[2], 14u);
    }
}

TEST(ObpSpectrometer, LateAnswersAreDropped) {
    Opened it(make_sts());
    it.open();
    // An answer of the same type to an earlier request, one of another type, and one that says that
    // it will take a while.
    it.port->instead_of = 0x101100;
    it.port->instead = [&](const ObpMessage& request) {
        ObpMessage other = request;
        other.regarding = request.regarding - 1;
        it.port->reply(other, Bytes(2048, 9));
        other = request;
        other.type = 0x110010;
        it.port->reply(other, {}, obp_response | obp_ack);
        it.port->reply(request, {}, obp_response | obp_nack, 255);
        it.port->reply(request, it.port->answers[0x101100]);
    };
    EXPECT_EQ(it.spectrometer->acquire().counts[2], 14u);
}

TEST(ObpSpectrometer, EndlessWrongAnswersEnd) {
    Opened it(make_sts());
    it.open();
    it.port->instead_of = 0x101100;
    it.port->instead = [&](const ObpMessage& request) {
        for (int i = 0; i < 100; ++i) {
            ObpMessage other = request;
            other.type = 0x110010;
            it.port->reply(other, {});
        }
    };
    EXPECT_EQ(fault_of_acquire(*it.spectrometer), Fault::bad_frame);
}

TEST(ObpSpectrometer, ACommandThatIsRefusedIsSaid) {
    Opened it(make_sts());
    it.open();
    it.port->commands.erase(0x110010);
    try {
        it.spectrometer->set_integration_time(0.02);
        ADD_FAILURE() << "accepted";
    } catch (const DeviceError& error) {
        EXPECT_EQ(error.fault(), Fault::refused);
        EXPECT_EQ(error.message(), "it: it refuses message 110010: unknown message type");
    }
    EXPECT_DOUBLE_EQ(it.spectrometer->integration_time(), 0.1);
}

TEST(ObpSpectrometer, CalibrationThatMakesNoWavelengthsIsRefused) {
    Opened it(make_sts());
    it.port->coefficients[0x180101] = {300, std::nanf("")};
    EXPECT_THROW(it.open(), DeviceError);
    it.port->answers[0x180100] = {200};
    EXPECT_THROW(it.open(), DeviceError);
    it.port->answers[0x180100] = {0};
    EXPECT_THROW(it.open(), DeviceError);
}

TEST(ObpSpectrometer, TellsItsSerialNumber) {
    auto port = make_sts();
    EXPECT_EQ(ask_obp_serial(*port), "S01234");
    port->product_ = 0x1022;
    EXPECT_EQ(ask_obp_serial(*port), "");
    VirtualClock clock;
    EXPECT_THROW(open_obp(port, clock), Error);
}

TEST(ObpSpectrometer, IsSetUpAsItWasAfterItWasUnplugged) {
    Opened it(make_sts());
    it.open();
    it.spectrometer->set_integration_time(0.03);
    it.port->unplug();
    EXPECT_EQ(fault_of_acquire(*it.spectrometer), Fault::unplugged);
    EXPECT_FALSE(it.spectrometer->reconnect(1));
    it.port->on_reopen = [](double) { return true; };
    EXPECT_TRUE(it.spectrometer->reconnect(1));
    EXPECT_EQ(it.port->requests.back().data, (Bytes{0x30, 0x75, 0, 0}));
    EXPECT_EQ(it.spectrometer->acquire().counts[2], 14u);
}

}  // namespace
}  // namespace drude
