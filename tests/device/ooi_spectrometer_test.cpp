#include "device/instruments/ooi_spectrometer.h"

#include <gtest/gtest.h>

#include <map>

#include "device/instruments/ooi_models.h"
#include "device/instruments/ooi_protocol.h"
#include "fake_usb_port.h"
#include "faults.h"

namespace drude {
namespace {

// A USB4000 that answers as its data sheet says; pixel i of frame f counts 1000 f + i mod 50000.
class FakeUsb4000 : public FakeUsbPort {
  public:
    FakeUsb4000() {
        name_ = "USB4000";
        serial_ = "USB4C00001";
        slots = {{0, "USB4C00001"}, {1, "340.5"}, {2, "0.125"}, {3, "-1e-6"},
                 {4, "0"},          {6, "1.0"},   {7, "-2e-7"}, {14, "1"}};
        on_write = [this](uint8_t endpoint, const Bytes& bytes) {
            if (endpoint == 0x01) handle(bytes);
        };
    }

    std::map<int, std::string> slots;
    int requests = 0;
    uint8_t sync = 0x69, speed = 0x80;
    // What is done instead of answering the next request of a spectrum.
    std::function<void()> instead;

  private:
    void handle(const Bytes& bytes) {
        switch (bytes.at(0)) {
            case 0x05: {
                Bytes reply = {0x05, bytes.at(1)};
                for (const char c : slots[bytes[1]]) reply.push_back(static_cast<uint8_t>(c));
                reply.resize(17);
                answer(0x81, reply);
                break;
            }
            case 0xFE: {
                Bytes reply(16);
                reply[1] = 0x0F;
                reply[14] = speed;
                answer(0x81, reply);
                break;
            }
            case 0x09:
                ++requests;
                if (instead) {
                    const auto act = std::move(instead);
                    instead = nullptr;
                    act();
                    break;
                }
                send_frame();
                break;
            default:
                break;
        }
    }
    void send_frame() {
        Bytes frame;
        for (int i = 0; i < 3840; ++i) {
            const int count = (1000 * requests + i) % 50000;
            frame.push_back(static_cast<uint8_t>(count));
            frame.push_back(static_cast<uint8_t>(count >> 8));
        }
        frame.push_back(sync);
        if (speed == 0) {
            answer(0x82, frame);
        } else {
            answer(0x86, Bytes(frame.begin(), frame.begin() + 2048));
            answer(0x82, Bytes(frame.begin() + 2048, frame.end()));
        }
    }
};

struct Opened {
    std::shared_ptr<FakeUsb4000> port = std::make_shared<FakeUsb4000>();
    VirtualClock clock;
    std::shared_ptr<Spectrometer> spectrometer;
    void open() { spectrometer = open_ooi(port, clock); }
};

void expect_frame(const Frame& frame, int number) {
    ASSERT_EQ(frame.counts.size(), 3840u);
    EXPECT_EQ(frame.counts[0], static_cast<uint32_t>(1000 * number));
    EXPECT_EQ(frame.counts[3839], static_cast<uint32_t>(1000 * number + 3839));
}

TEST(OoiSpectrometer, ReadsItsCalibration) {
    Opened it;
    it.open();
    const SpectrometerInfo& info = it.spectrometer->info();
    EXPECT_EQ(info.uri, "ooi:USB4C00001");
    EXPECT_EQ(info.serial, "USB4C00001");
    EXPECT_EQ(info.model, "Ocean Optics USB4000 / Flame-T");
    ASSERT_EQ(info.wavelength_nm.size(), 3840u);
    EXPECT_DOUBLE_EQ(info.wavelength_nm[1000], 340.5 + 125 - 1);
    EXPECT_EQ(info.nonlinearity, (std::vector<double>{1.0, -2e-7}));
    EXPECT_EQ(info.max_counts, 65535u);
    EXPECT_TRUE(info.has_lamp_control);
    EXPECT_TRUE(info.warnings.empty());
    EXPECT_TRUE(it.port->holds_nothing());
}

TEST(OoiSpectrometer, TakesFramesFromBothEndpoints) {
    Opened it;
    it.open();
    expect_frame(it.spectrometer->acquire(), 1);
    expect_frame(it.spectrometer->acquire(), 2);
}

TEST(OoiSpectrometer, AFullSpeedLinkSendsAllOfAFrameToOneEndpointAndIsTold) {
    Opened it;
    it.port->speed = 0;
    it.port->high_speed_ = false;
    it.port->packet_sizes_ = {{0x01, 64}, {0x81, 64}, {0x82, 64}, {0x86, 64}};
    it.open();
    expect_frame(it.spectrometer->acquire(), 1);
    ASSERT_EQ(it.spectrometer->info().warnings.size(), 1u);
    EXPECT_NE(it.spectrometer->info().warnings[0].find("full-speed"), std::string::npos);
}

TEST(OoiSpectrometer, SetsTheIntegrationTimeInItsUnit) {
    Opened it;
    it.open();
    it.port->writes.clear();
    it.spectrometer->set_integration_time(0.0123456);
    ASSERT_EQ(it.port->writes.size(), 1u);
    EXPECT_EQ(it.port->writes[0].bytes, ooi_set_integration_time(12350));
    EXPECT_DOUBLE_EQ(it.spectrometer->integration_time(), 0.01235);
    for (const double bad : {0.0, 9e-6, 65.6, -1.0, std::nan("")}) {
        EXPECT_THROW(
            {
                try {
                    it.spectrometer->set_integration_time(bad);
                } catch (const Error& error) {
                    EXPECT_EQ(error.cause(), Cause::user);
                    EXPECT_NE(error.message().find("1e-05 s to 65.535 s"), std::string::npos)
                        << error.message();
                    throw;
                }
            },
            Error);
    }
    EXPECT_EQ(it.port->writes.size(), 1u);
}

TEST(OoiSpectrometer, WhatAnEarlierProgramLeftIsDropped) {
    Opened it;
    it.port->answer(0x81, Bytes(17, 0x55));
    it.port->answer(0x82, Bytes(300, 0x66));
    it.port->answer(0x86, Bytes(2048, 0x77));
    it.open();
    expect_frame(it.spectrometer->acquire(), 1);
    EXPECT_TRUE(it.port->holds_nothing());
}

// The second half of a frame whose first half was dropped: it fits the first half of the next one.
TEST(OoiSpectrometer, AFrameThatArrivesWhileItIsDrainedIsDroppedWhole) {
    class Late : public FakeUsb4000 {
      public:
        size_t drain(uint8_t endpoint, double quiet_s, Deadline deadline) override {
            const bool arrives = endpoint == 0x86 && ++drains == 3;  // after the initialisation
            if (arrives) answer(0x86, Bytes(2048, 0x11), true);
            const size_t dropped = FakeUsb4000::drain(endpoint, quiet_s, deadline);
            if (arrives) {
                Bytes rest(5632, 0x11);
                rest.push_back(0x69);
                answer(0x82, rest);
            }
            return dropped;
        }
        int drains = 0;
    };
    Opened it;
    const auto port = std::make_shared<Late>();
    it.port = port;
    it.open();
    port->instead = [&] {};
    EXPECT_EQ(fault_of_acquire(*it.spectrometer), Fault::timeout);
    port->drains = 0;
    it.spectrometer->recover();
    expect_frame(it.spectrometer->acquire(), 2);
    EXPECT_TRUE(port->holds_nothing());
}

TEST(OoiSpectrometer, IntegrationTimesAreMultiplesOfWhatTheModelResolves) {
    struct Case {
        uint16_t product;
        double asked, set;
        uint32_t units;
    };
    const std::vector<Case> cases = {
        {0x1022, 0.0000149, 0.00001, 10},   // USB4000: 10 us
        {0x1012, 0.003456, 0.00346, 3460},  // HR4000: 10 us
        {0x101E, 0.0034, 0.003, 3000},      // USB2000+: 1 ms, in us
        {0x1016, 0.0036, 0.004, 4000},      // HR2000+: 1 ms, in us
        {0x1018, 0.0084, 0.008, 8},         // QE65000: 1 ms, in ms
    };
    for (const Case& one : cases) {
        Opened it;
        it.port->product_ = one.product;
        it.open();
        it.port->writes.clear();
        it.spectrometer->set_integration_time(one.asked);
        EXPECT_EQ(it.port->writes.at(0).bytes, ooi_set_integration_time(one.units)) << one.asked;
        EXPECT_DOUBLE_EQ(it.spectrometer->integration_time(), one.set);
    }
}

// They take two bytes of milliseconds; 70 000 would become 4464.
TEST(OoiModels, TheEarlyOnesTakeAtMostSixteenBitsOfMilliseconds) {
    for (const int product : {0x1002, 0x100A, 0x1014}) {
        const OoiModel* model = find_ooi_model(static_cast<uint16_t>(product));
        ASSERT_NE(model, nullptr);
        EXPECT_EQ(model->unit_us, 1000u);
        EXPECT_LE(model->longest_us / model->unit_us, 65535u);
    }
}

TEST(OoiSpectrometer, ALateReplyIsNotTakenForTheNextOne) {
    Opened it;
    // The answer to a query of slot 2 comes late: before that of slot 3.
    const auto device = it.port->on_write;
    it.port->on_write = [&, device](uint8_t endpoint, const Bytes& bytes) {
        if (bytes == ooi_query_slot(3)) {
            Bytes late = {0x05, 0x02, '9'};
            late.resize(17);
            it.port->answer(0x81, late);
        }
        device(endpoint, bytes);
    };
    it.open();
    EXPECT_DOUBLE_EQ(it.spectrometer->info().wavelength_nm[1000], 464.5);
}

TEST(OoiSpectrometer, FaultsAreNamedAndRecoveredFrom) {
    struct Case {
        Fault fault;
        std::function<void(FakeUsb4000&)> act;
    };
    const std::vector<Case> cases = {
        {Fault::timeout, [](FakeUsb4000&) {}},
        {Fault::stall, [](FakeUsb4000& it) { it.fail(0x86, Fault::stall); }},
        {Fault::io, [](FakeUsb4000& it) { it.fail(0x86, Fault::io); }},
        {Fault::short_read,
         [](FakeUsb4000& it) {
             it.answer(0x86, Bytes(2048));
             it.answer(0x82, Bytes(1000));
         }},
        {Fault::short_read, [](FakeUsb4000& it) { it.answer(0x86, Bytes(100)); }},
        {Fault::overflow,
         [](FakeUsb4000& it) {
             it.answer(0x86, Bytes(2048));
             it.answer(0x82, Bytes(5640));
         }},
        {Fault::bad_frame,
         [](FakeUsb4000& it) {
             it.answer(0x86, Bytes(2048));
             it.answer(0x82, Bytes(5633));
         }},
    };
    for (const Case& one : cases) {
        Opened it;
        it.open();
        it.spectrometer->set_integration_time(0.02);
        it.spectrometer->set_lamp(true);
        it.port->instead = [&] { one.act(*it.port); };
        EXPECT_EQ(fault_of_acquire(*it.spectrometer), one.fault);
        // What comes too late must not become the next frame.
        it.port->answer(0x82, Bytes(700, 0x42));
        it.port->writes.clear();
        it.spectrometer->recover();
        std::vector<Bytes> sent;
        for (const auto& write : it.port->writes) sent.push_back(write.bytes);
        EXPECT_EQ(sent,
                  (std::vector<Bytes>{ooi_initialize(), ooi_query_status(), ooi_set_trigger_mode(0),
                                      ooi_set_integration_time(20000), ooi_set_lamp(true)}));
        EXPECT_EQ(it.port->cleared, (std::vector<uint8_t>{0x01, 0x81, 0x82, 0x86}));
        expect_frame(it.spectrometer->acquire(), 2);
    }
}

TEST(OoiSpectrometer, AFaultWhileItIsOpenedIsRecoveredFrom) {
    for (const Fault fault : {Fault::stall, Fault::io, Fault::overflow}) {
        Opened it;
        const auto device = it.port->on_write;
        int queries = 0;
        it.port->on_write = [&, device](uint8_t endpoint, const Bytes& bytes) {
            if (bytes == ooi_query_slot(2) && ++queries == 1) {
                it.port->fail(0x81, fault);
            } else {
                device(endpoint, bytes);
            }
        };
        it.open();
        EXPECT_EQ(queries, 2);
        expect_frame(it.spectrometer->acquire(), 1);
    }
}

TEST(OoiSpectrometer, ADeviceThatNeverAnswersIsGivenUp) {
    Opened it;
    it.port->on_write = nullptr;
    try {
        it.open();
        ADD_FAILURE() << "opened";
    } catch (const DeviceError& error) {
        EXPECT_EQ(error.fault(), Fault::timeout);
    }
}

TEST(OoiSpectrometer, CalibrationThatCannotBeUsedIsSaid) {
    for (const std::string& c0 : {std::string("0"), std::string("nan"), std::string("")}) {
        Opened it;
        it.port->slots[6] = c0;
        it.open();
        EXPECT_TRUE(it.spectrometer->info().nonlinearity.empty());
        ASSERT_EQ(it.spectrometer->info().warnings.size(), 1u);
        EXPECT_NE(it.spectrometer->info().warnings[0].find("non-linearity"), std::string::npos);
    }
    Opened no_order;
    no_order.port->slots[14] = "8";
    no_order.open();
    EXPECT_EQ(no_order.spectrometer->info().warnings.size(), 1u);

    for (const std::string& c1 : {std::string("-0.1"), std::string("x"), std::string("0")}) {
        Opened it;
        it.port->slots[2] = c1;
        try {
            it.open();
            ADD_FAILURE() << "opened";
        } catch (const DeviceError& error) {
            EXPECT_EQ(error.fault(), Fault::bad_frame);
            EXPECT_NE(error.message().find("wavelength calibration"), std::string::npos);
        }
    }
}

TEST(OoiSpectrometer, TheSaturationInItsMemoryIsItsMaximum) {
    Opened it;
    it.port->slots[17] = std::string("\1\1\1\1\x60\xEA", 6);
    it.open();
    EXPECT_EQ(it.spectrometer->info().max_counts, 60000u);
}

TEST(OoiSpectrometer, IsSetUpAsItWasAfterItWasUnplugged) {
    Opened it;
    it.open();
    it.spectrometer->set_integration_time(0.03);
    it.port->unplug();
    EXPECT_EQ(fault_of_acquire(*it.spectrometer), Fault::unplugged);
    EXPECT_THROW(it.spectrometer->recover(), DeviceError);
    EXPECT_FALSE(it.spectrometer->reconnect(1));
    it.port->on_reopen = [](double) { return true; };
    it.port->writes.clear();
    EXPECT_TRUE(it.spectrometer->reconnect(1));
    EXPECT_EQ(it.port->writes.back().bytes, ooi_set_integration_time(30000));  // no lamp: not ours
    expect_frame(it.spectrometer->acquire(), 1);
}

TEST(OoiSpectrometer, AnotherOneInItsPlaceIsRefused) {
    Opened it;
    it.port->serial_ = "";
    it.open();
    it.port->unplug();
    EXPECT_EQ(fault_of_acquire(*it.spectrometer), Fault::unplugged);
    it.port->on_reopen = [](double) { return true; };
    it.port->slots[0] = "USB4C00002";
    try {
        it.spectrometer->reconnect(1);
        ADD_FAILURE() << "taken for the same";
    } catch (const DeviceError& error) {
        EXPECT_EQ(error.fault(), Fault::refused);
        EXPECT_NE(error.message().find("USB4C00002"), std::string::npos) << error.message();
    }
}

TEST(OoiSpectrometer, TheSerialNumberInItsMemoryStandsInForADescriptorWithoutOne) {
    Opened it;
    it.port->serial_ = "";
    it.port->slots[0] = "HR4D111 ";
    EXPECT_EQ(ask_ooi_serial(*it.port), "HR4D111");
    it.open();
    EXPECT_EQ(it.spectrometer->info().uri, "ooi:HR4D111");
}

TEST(OoiSpectrometer, AnotherProductIsRefused) {
    Opened it;
    it.port->product_ = 0x4000;
    try {
        it.open();
        ADD_FAILURE() << "opened";
    } catch (const Error& error) {
        EXPECT_EQ(error.cause(), Cause::user);
    }
}

}  // namespace
}  // namespace drude
