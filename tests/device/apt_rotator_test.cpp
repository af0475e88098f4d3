#include "device/instruments/apt_rotator.h"

#include <gtest/gtest.h>

#include <cmath>

#include "device/apt_bytes.h"

namespace drude {
namespace {

class FakeController {
  public:
    std::shared_ptr<FakeUsbPort> port = ftdi_port();
    int32_t position = 0;
    uint32_t bits = homed, serial = 55000001;
    std::string model = "K10CR1";
    std::vector<uint16_t> ids;  // of what it was sent
    std::vector<Bytes> messages;
    // What it does instead of moving at once.
    std::function<bool(uint16_t id)> instead;

    FakeController() {
        port->on_write = [this](uint8_t, const Bytes& bytes) { answer(bytes); };
    }
    void say(const Bytes& message) { port->answer(0x81, ftdi_packets(message)); }
    int count(uint16_t id) const {
        return static_cast<int>(std::count(ids.begin(), ids.end(), id));
    }
    std::shared_ptr<AptRotator> mount() {
        AptOptions options;
        options.silence_s = 0.05;
        options.poll_s = 0.001;
        options.settle_s = 0;
        options.degrees_per_s = 36000;
        options.degrees_per_s2 = 1e6;
        return std::make_shared<AptRotator>(port, options);
    }

  private:
    void answer(const Bytes& bytes) {
        const uint16_t id = static_cast<uint16_t>(bytes[0] | (bytes[1] << 8));
        ids.push_back(id);
        messages.push_back(bytes);
        if (instead && instead(id)) return;
        if (id == 0x0005) say(info_message(serial, model));
        if (id == 0x0480) say(status_message(0x0481, position, bits));
        if (id == 0x0443) {
            position = 0;
            say({0x44, 0x04, 0x01, 0x00, 0x01, 0x50});
        }
        if (id == 0x0453) {
            position = bytes[8] | (bytes[9] << 8) | (bytes[10] << 16) | (bytes[11] << 24);
            say(status_message(0x0464, position, bits));
        }
    }
};

TEST(K10cr1, MicrostepsAreARatioOfWholeNumbers) {
    EXPECT_EQ(k10cr1_microsteps_per_turn, 49152000);
    EXPECT_EQ(k10cr1_microsteps(3), 409600);
    EXPECT_EQ(k10cr1_microsteps(1), 136533);
    EXPECT_EQ(k10cr1_microsteps(90), 12288000);
    EXPECT_EQ(k10cr1_microsteps(-90), 36864000);
    EXPECT_EQ(k10cr1_microsteps(360), 0);
    EXPECT_EQ(k10cr1_microsteps(360 - 1e-9), 0);
    // 15 degrees at a time around the circle and a thousand turns on: still the same steps, where
    // 136533 a degree would be 120 steps short after each turn.
    for (int i = 0; i < 24; ++i) {
        EXPECT_EQ(k10cr1_microsteps(360000.0 + 15 * i), 2048000 * i);
        EXPECT_DOUBLE_EQ(k10cr1_degrees(2048000 * i + 49152000LL * 7), 15 * i);
        EXPECT_DOUBLE_EQ(k10cr1_degrees(2048000 * i - 49152000LL * 7), 15 * i);
    }
}

TEST(AptRotator, SetsTheLineAndTheControllerUp) {
    FakeController controller;
    const auto mount = controller.mount();
    EXPECT_EQ(mount->info().uri, "apt:DK0AELL1");
    EXPECT_EQ(mount->info().model, "Thorlabs K10CR1");
    EXPECT_EQ(mount->info().serial, "55000001");
    EXPECT_NEAR(mount->info().units_per_degree, 136533.3333333333, 1e-9);
    ASSERT_GE(controller.port->controls.size(), 8u);
    EXPECT_EQ(controller.port->controls[2].request.value, 0x001A);  // 115200
    EXPECT_EQ(controller.port->controls[6].request.index, 0x0100);  // RTS/CTS
    EXPECT_EQ(controller.ids, (std::vector<uint16_t>{0x0018, 0x0012, 0x0005, 0x0413}));
    EXPECT_EQ(controller.messages[0], (Bytes{0x18, 0x00, 0x00, 0x00, 0x50, 0x01}));
    EXPECT_EQ(controller.messages[2], (Bytes{0x05, 0x00, 0x00, 0x00, 0x50, 0x01}));
    const Bytes& velocity = controller.messages[3];
    ASSERT_EQ(velocity.size(), 20u);
    EXPECT_EQ(Bytes(velocity.begin(), velocity.begin() + 12),
              (Bytes{0x13, 0x04, 0x0E, 0x00, 0xD0, 0x01, 1, 0, 0, 0, 0, 0}));
}

// 10 degrees a second: 73291090 is 045E5552 hexadecimal; 10 a second squared: 15020 is 3AAC.
TEST(AptRotator, VelocityIsThatOfTheOptions) {
    FakeController controller;
    AptOptions options;
    options.settle_s = 0;
    AptRotator mount(controller.port, options);
    const Bytes& velocity = controller.messages[3];
    EXPECT_EQ(Bytes(velocity.begin() + 12, velocity.end()),
              (Bytes{0xAC, 0x3A, 0x00, 0x00, 0x52, 0x55, 0x5E, 0x04}));
}

TEST(AptRotator, MovesToAnyAngleOnItsBranch) {
    FakeController controller;
    const auto mount = controller.mount();
    for (const double degrees : {0.0, 1.0, 15.0, 359.9999999, -90.0, 725.5, -1e-12}) {
        EXPECT_NEAR(mount->move_to(degrees), degrees, 0.5 / 136533 + 1e-9) << degrees;
    }
    EXPECT_DOUBLE_EQ(mount->move_to(450), 450);
    EXPECT_EQ(controller.messages.back(),
              (Bytes{0x53, 0x04, 0x06, 0x00, 0xD0, 0x01, 0x01, 0x00, 0x00, 0x80, 0xBB, 0x00}));
    EXPECT_DOUBLE_EQ(mount->position(), 90);
    controller.position = -2048000;
    EXPECT_DOUBLE_EQ(mount->position(), 345);
    EXPECT_THROW(mount->move_to(std::nan("")), Error);
}

TEST(AptRotator, StatusIsAcknowledged) {
    FakeController controller;
    const auto mount = controller.mount();
    mount->position();
    EXPECT_EQ(controller.messages.back(), (Bytes{0x92, 0x04, 0x00, 0x00, 0x50, 0x01}));
}

TEST(AptRotator, HomesAndChecksThatItDid) {
    FakeController controller;
    const auto mount = controller.mount();
    mount->home();
    EXPECT_EQ(controller.count(0x0443), 1);
    controller.bits = 0x80000000;
    std::string message;
    EXPECT_EQ(fault_of([&] { mount->home(); }, &message), Fault::mechanical);
    EXPECT_NE(message.find("not homed"), std::string::npos) << message;
}

TEST(AptRotator, OtherMessagesWhileItMovesAreDropped) {
    FakeController controller;
    const auto mount = controller.mount();
    controller.instead = [&](uint16_t id) {
        if (id == 0x0453) controller.say(status_message(0x0481, 5, moving));
        return false;
    };
    EXPECT_DOUBLE_EQ(mount->move_to(3), 3);
    EXPECT_EQ(mount->messages_dropped(), 1);
}

// The status says that it stands where it should, though the announcement never came.
TEST(AptRotator, ALostAnnouncementIsMadeUpForByItsStatus) {
    FakeController controller;
    const auto mount = controller.mount();
    int asked = 0;
    controller.instead = [&](uint16_t id) {
        if (id == 0x0453) return true;
        if (id == 0x0480) {
            controller.bits = ++asked < 3 ? moving : homed;
            controller.position = 409600;
        }
        return false;
    };
    EXPECT_DOUBLE_EQ(mount->move_to(3), 3);
    EXPECT_EQ(controller.count(0x0453), 1);
    EXPECT_GE(asked, 4);
}

TEST(AptRotator, OneThatDoesNotArriveIsStoppedAndReported) {
    FakeController controller;
    const auto mount = controller.mount();
    controller.bits = moving;
    controller.instead = [&](uint16_t id) { return id == 0x0453; };
    std::string message;
    EXPECT_EQ(fault_of([&] { mount->move_to(3); }, &message), Fault::mechanical);
    EXPECT_NE(message.find("still moving"), std::string::npos) << message;
    EXPECT_EQ(controller.messages.back(), (Bytes{0x65, 0x04, 0x01, 0x02, 0x50, 0x01}))
        << "stop, channel 1, profiled";
}

TEST(AptRotator, ErrorBitsAndComplaintsAreErrors) {
    FakeController controller;
    const auto mount = controller.mount();
    controller.bits = homed | 0x4000;
    EXPECT_EQ(fault_of([&] { mount->move_to(3); }), Fault::mechanical);
    controller.bits = homed;
    controller.instead = [&](uint16_t id) {
        if (id != 0x0453) return false;
        Bytes data = {0x53, 0x04, 0x06, 0x00};
        for (const char c : std::string("stalled")) data.push_back(static_cast<uint8_t>(c));
        data.resize(68);
        controller.say(from_unit(0x0081, data));
        return true;
    };
    std::string message;
    EXPECT_EQ(fault_of([&] { mount->move_to(3); }, &message), Fault::refused);
    EXPECT_NE(message.find("code 6 about message 0453: stalled"), std::string::npos) << message;
}

TEST(AptRotator, AnotherPlaceIsTriedOnceMore) {
    FakeController controller;
    const auto mount = controller.mount();
    int moves = 0;
    controller.instead = [&](uint16_t id) {
        if (id != 0x0453 || ++moves > 1) return false;
        controller.say(status_message(0x0464, 0, homed));
        return true;
    };
    EXPECT_DOUBLE_EQ(mount->move_to(3), 3);
    EXPECT_EQ(moves, 2);
    controller.instead = [&](uint16_t id) {
        if (id == 0x0453) controller.say(status_message(0x0464, 0, homed));
        return id == 0x0453;
    };
    EXPECT_EQ(fault_of([&] { mount->move_to(3); }), Fault::mechanical);
}

TEST(AptRotator, SilenceNoiseAndOtherControllers) {
    FakeController silent;
    silent.instead = [](uint16_t) { return true; };
    EXPECT_EQ(fault_of([&] { silent.mount(); }), Fault::timeout);
    FakeController noise;
    noise.instead = [&](uint16_t id) {
        if (id == 0x0005) noise.say(Bytes(90, 0xAA));
        return id == 0x0005;
    };
    EXPECT_EQ(fault_of([&] { noise.mount(); }), Fault::bad_frame);
    FakeController other;
    other.model = "TDC001";
    std::string message;
    EXPECT_EQ(fault_of([&] { other.mount(); }, &message), Fault::refused);
    EXPECT_NE(message.find("TDC001"), std::string::npos) << message;
}

TEST(AptRotator, RecoversAndComesBackHomed) {
    FakeController controller;
    const auto mount = controller.mount();
    controller.port->fail(0x81, Fault::stall);
    EXPECT_EQ(fault_of([&] { mount->position(); }), Fault::stall);
    int asked = 0;
    controller.instead = [&](uint16_t id) {
        if (id == 0x0480) controller.bits = ++asked < 3 ? moving : homed;
        return false;
    };
    mount->recover();
    EXPECT_EQ(asked, 3);
    EXPECT_DOUBLE_EQ(mount->move_to(3), 3);
    controller.port->unplug();
    EXPECT_EQ(fault_of([&] { mount->move_to(6); }), Fault::unplugged);
    EXPECT_FALSE(mount->reconnect(0.01));
    controller.port->on_reopen = [](double) { return true; };
    EXPECT_TRUE(mount->reconnect(0.01));
    EXPECT_EQ(controller.count(0x0443), 1);
    controller.serial = 55000002;
    EXPECT_EQ(fault_of([&] { mount->recover(); }), Fault::refused);
}

}  // namespace
}  // namespace drude
