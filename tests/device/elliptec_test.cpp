#include "device/instruments/elliptec.h"

#include <gtest/gtest.h>

#include <cmath>
#include <deque>

#include "device/ftdi_packets.h"

namespace drude {
namespace {

const char* const ell14 = "0IN0E1140058720220201016800023000";

// Mounts on a bus: what a command is answered, unless the test has queued something for it.
class FakeBus {
  public:
    std::shared_ptr<FakeUsbPort> port = ftdi_port();
    std::map<char, int32_t> position;                       // of every mount that is there
    std::map<std::string, std::deque<std::string>> queued;  // by command, e.g. "0gs"
    std::vector<std::string> commands;
    std::string identity = ell14;

    FakeBus() {
        position['0'] = 0;
        port->on_write = [this](uint8_t, const Bytes& bytes) {
            answer(std::string(bytes.begin(), bytes.end()));
        };
    }
    // Lines that answer `command`; without the line end, several separated by blanks.
    void queue(const std::string& command, const std::string& lines) {
        queued[command].push_back(lines);
    }
    void say(const std::string& line) { port->answer(0x81, ftdi_packets(line + "\r\n")); }
    int count(const std::string& command) const {
        return static_cast<int>(std::count(commands.begin(), commands.end(), command));
    }
    std::shared_ptr<Elliptec> mount(char address = '0') {
        ElliptecOptions options;
        options.silence_s = 0.05;
        options.home_s = 0.05;
        options.degrees_per_s = 36000;
        options.poll_s = 0.001;
        return std::make_shared<Elliptec>(ElliptecBus::of(port), address, options);
    }

  private:
    void answer(const std::string& text) {
        commands.push_back(text);
        const char address = text[0];
        const std::string command = text.substr(1, 2);
        const std::string key = command == "ma" ? text.substr(0, 3) : text;
        if (command == "ma") {
            position[address] = static_cast<int32_t>(std::stoul(text.substr(3), nullptr, 16));
        }
        if (command == "ho") position[address] = 0;
        if (!queued[key].empty()) {
            std::string lines = queued[key].front();
            queued[key].pop_front();
            for (size_t blank; (blank = lines.find(' ')) != std::string::npos;) {
                say(lines.substr(0, blank));
                lines = lines.substr(blank + 1);
            }
            if (!lines.empty()) say(lines);
            return;
        }
        if (position.count(address) == 0) return;
        if (command == "in") say(address + identity.substr(1));
        if (command == "gs") say(fmt::format("{}GS00", address));
        if (command == "gp" || command == "ma" || command == "ho") {
            say(fmt::format("{}PO{:08X}", address, static_cast<uint32_t>(position[address])));
        }
    }
};

TEST(Elliptec, TellsWhoItIs) {
    FakeBus bus;
    const auto mount = bus.mount();
    EXPECT_EQ(mount->info().uri, "ell:DK0AELL1/0");
    EXPECT_EQ(mount->info().model, "Thorlabs ELL14");
    EXPECT_EQ(mount->info().serial, "11400587");
    EXPECT_DOUBLE_EQ(mount->info().units_per_degree, 143360.0 / 360);
    EXPECT_EQ(bus.commands, std::vector<std::string>{"0in"});
}

// 136533 pulses a turn, which a driver in circulation takes for every mount, would send 90 degrees
// to 34133.
TEST(Elliptec, PulsesAreThoseThatTheMountStates) {
    FakeBus bus;
    const auto mount = bus.mount();
    EXPECT_DOUBLE_EQ(mount->move_to(90), 90);
    EXPECT_EQ(bus.commands.back(), "0ma00008C00");
    bus.identity = "0IN081140058720220201016800040000";  // ELL8: 262144
    const auto other = bus.mount();
    EXPECT_DOUBLE_EQ(other->move_to(90), 90);
    EXPECT_EQ(bus.commands.back(), "0ma00010000");
}

TEST(Elliptec, AnyAngleIsTakenModuloATurnAndComesBackOnItsBranch) {
    FakeBus bus;
    const auto mount = bus.mount();
    const double pulse = 360.0 / 143360;
    for (const double degrees : {-720.0, -359.999, -45.0, -1e-9, 0.0, 0.001, 45.0, 179.9, 180.0,
                                 359.9999, 360.0, 405.0, 1234.5, 36000.25}) {
        EXPECT_NEAR(mount->move_to(degrees), degrees, pulse / 2 + 1e-9) << degrees;
        const int64_t sent = std::stoll(bus.commands.back().substr(3), nullptr, 16);
        EXPECT_GE(sent, 0);
        EXPECT_LT(sent, 143360);
        // The same place on the circle, by sine and cosine.
        const double at = static_cast<double>(sent) * pulse * M_PI / 180;
        EXPECT_NEAR(std::cos(at), std::cos(degrees * M_PI / 180), 1e-4) << degrees;
        EXPECT_NEAR(std::sin(at), std::sin(degrees * M_PI / 180), 1e-4) << degrees;
    }
    EXPECT_THROW(mount->move_to(std::nan("")), Error);
    EXPECT_THROW(mount->move_to(INFINITY), Error);
}

// The mount ends a little before its mark, and counts that as less than nothing.
TEST(Elliptec, ANegativePositionIsJustBelowATurn) {
    FakeBus bus;
    const auto mount = bus.mount();
    bus.queue("0ma", "0POFFFFFFFE");
    EXPECT_NEAR(mount->move_to(0), -2 * 360.0 / 143360, 1e-12);
    bus.queue("0ma", "0POFFFFFFFE");
    EXPECT_NEAR(mount->move_to(720), 720 - 2 * 360.0 / 143360, 1e-9);
    bus.position['0'] = -2;
    EXPECT_NEAR(mount->position(), 360 - 2 * 360.0 / 143360, 1e-9);
    bus.position['0'] = 143360 + 35840;
    EXPECT_NEAR(mount->position(), 90, 1e-9);
}

TEST(Elliptec, HomesClockwiseAndChecksWhereThatEnds) {
    FakeBus bus;
    const auto mount = bus.mount();
    mount->home();
    EXPECT_EQ(bus.commands.back(), "0ho0");
    bus.queue("0ho0", "0PO00008C00");
    std::string message;
    EXPECT_EQ(fault_of([&] { mount->home(); }, &message), Fault::mechanical);
    EXPECT_NE(message.find("90.000"), std::string::npos) << message;
}

TEST(Elliptec, AnswersOfOthersAndLateOnesAreDropped) {
    FakeBus bus;
    const auto mount = bus.mount();
    const int before = mount->answers_dropped();
    // Another address, a status nobody asked for, noise, then the answer.
    bus.queue("0gp", "1PO00001111 0IN0E1140058720220201016800023000 ??? 0PO00008C00");
    EXPECT_NEAR(mount->position(), 90, 1e-9);
    EXPECT_EQ(mount->answers_dropped(), before + 3);
    // Only an answer of another mount: that is no answer.
    bus.queue("0gp", "1PO00001111");
    std::string message;
    EXPECT_EQ(fault_of([&] { mount->position(); }, &message), Fault::timeout);
    EXPECT_NE(message.find("'0gp'"), std::string::npos) << message;
    // Answers that are there before the question are not taken for its answer.
    const int dropped = mount->answers_dropped();
    bus.say("0PO00008C00");
    bus.say("0PO00001000");
    EXPECT_NEAR(mount->position(), 0, 1e-9);
    bus.position['0'] = 7168;
    EXPECT_NEAR(mount->position(), 18, 1e-9);
    EXPECT_EQ(mount->answers_dropped(), dropped + 1);
}

TEST(Elliptec, SeveralMountsShareABus) {
    FakeBus bus;
    bus.position['A'] = 35840;
    const auto polariser = bus.mount('0');
    const auto analyser = bus.mount('a');
    EXPECT_EQ(analyser->info().uri, "ell:DK0AELL1/A");
    EXPECT_NEAR(analyser->position(), 90, 1e-9);
    EXPECT_NEAR(polariser->move_to(18), 18, 1e-9);
    EXPECT_NEAR(analyser->position(), 90, 1e-9);
    EXPECT_EQ(bus.position['0'], 7168);
    // The chip was set up once for both.
    EXPECT_EQ(bus.port->controls.size(), 8u);
}

TEST(Elliptec, AMechanicalTimeoutIsTriedOnceMore) {
    FakeBus bus;
    const auto mount = bus.mount();
    bus.queue("0ma", "0GS02");
    EXPECT_NEAR(mount->move_to(90), 90, 1e-9);
    EXPECT_EQ(bus.count("0ma00008C00"), 2);
    bus.queue("0ma", "0GS02");
    bus.queue("0ma", "0GS02");
    std::string message;
    EXPECT_EQ(fault_of([&] { mount->move_to(90); }, &message), Fault::mechanical);
    EXPECT_NE(message.find("mechanical time-out (GS02), also when asked again"), std::string::npos)
        << message;
    EXPECT_EQ(bus.count("0ma00008C00"), 4);
}

TEST(Elliptec, OtherStatusCodesAreNotTriedAgain) {
    for (const auto& [code, fault] : std::map<std::string, Fault>{{"01", Fault::refused},
                                                                  {"03", Fault::refused},
                                                                  {"04", Fault::refused},
                                                                  {"07", Fault::mechanical},
                                                                  {"08", Fault::mechanical},
                                                                  {"0A", Fault::mechanical},
                                                                  {"0B", Fault::mechanical},
                                                                  {"0C", Fault::refused},
                                                                  {"0D", Fault::mechanical},
                                                                  {"FF", Fault::refused}}) {
        FakeBus bus;
        const auto mount = bus.mount();
        bus.queue("0ma", "0GS" + code);
        const Fault expected = fault;
        std::string message;
        EXPECT_EQ(fault_of([&] { mount->move_to(90); }, &message), expected) << code;
        EXPECT_NE(message.find("GS" + code), std::string::npos) << message;
        EXPECT_EQ(bus.count("0ma00008C00"), 1) << code;
    }
}

TEST(Elliptec, ABusyMountIsWaitedFor) {
    FakeBus bus;
    const auto mount = bus.mount();
    bus.queue("0ma", "0GS09");
    bus.queue("0gs", "0GS09");
    bus.queue("0gs", "0PO00008C00 0GS09");  // the announcement of its arrival, late
    EXPECT_NEAR(mount->move_to(90), 90, 1e-9);
    EXPECT_EQ(bus.count("0gs"), 3);
    EXPECT_EQ(bus.count("0gp"), 1);
    // Busy when it is asked for its position.
    bus.queue("0gp", "0GS09");
    EXPECT_NEAR(mount->position(), 90, 1e-9);
}

TEST(Elliptec, OneThatStaysBusyIsStuck) {
    FakeBus bus;
    const auto mount = bus.mount();
    bus.queue("0ma", "0GS09");
    for (int i = 0; i < 5000; ++i) bus.queue("0gs", "0GS09");
    std::string message;
    EXPECT_EQ(fault_of([&] { mount->move_to(90); }, &message), Fault::mechanical);
    EXPECT_NE(message.find("still busy"), std::string::npos) << message;
}

TEST(Elliptec, AnotherPlaceThanCommandedIsTriedOnceThenAnError) {
    FakeBus bus;
    const auto mount = bus.mount();
    bus.queue("0ma", "0PO00001000");
    EXPECT_NEAR(mount->move_to(90), 90, 1e-9);
    bus.queue("0ma", "0PO00001000");
    bus.queue("0ma", "0PO00001000");
    std::string message;
    EXPECT_EQ(fault_of([&] { mount->move_to(450); }, &message), Fault::mechanical);
    EXPECT_NE(message.find("90.000"), std::string::npos) << message;
    EXPECT_NE(message.find("10.286"), std::string::npos) << message;
    // Within the tolerance it is the reported angle that counts: 100 pulses are 0.251 degrees.
    bus.queue("0ma", fmt::format("0PO{:08X}", 35840 + 100));
    EXPECT_NEAR(mount->move_to(90), 90 + 100 * 360.0 / 143360, 1e-12);
}

TEST(Elliptec, NoMountAtAnAddress) {
    FakeBus bus;
    std::string message;
    EXPECT_EQ(fault_of([&] { bus.mount('3'); }, &message), Fault::timeout);
    EXPECT_NE(message.find("mount 3"), std::string::npos) << message;
    EXPECT_THROW(bus.mount('g'), Error);
}

TEST(Elliptec, HalfACommandOfAnEarlierProgramIsForgottenByASecondQuestion) {
    for (const char* first : {"", "0GS01", "0GS03", "0GS09"}) {
        FakeBus bus;
        bus.queue("0in", first);
        EXPECT_EQ(bus.mount()->identity().serial, "11400587") << first;
        EXPECT_EQ(bus.count("0in"), 2) << first;
    }
    FakeBus bus;
    bus.queue("0in", "0GS03");
    bus.queue("0in", "0GS03");
    std::string message;
    EXPECT_EQ(fault_of([&] { bus.mount(); }, &message), Fault::refused);
    EXPECT_NE(message.find("GS03"), std::string::npos) << message;
}

TEST(Elliptec, RecoversFromAStallAndDropsWhatCameLate) {
    FakeBus bus;
    const auto mount = bus.mount();
    bus.queue("0ma", "");
    EXPECT_EQ(fault_of([&] { mount->move_to(90); }), Fault::timeout);
    bus.say("0PO00008C00");
    mount->recover();
    EXPECT_NEAR(mount->move_to(18), 18, 1e-9);
    bus.port->fail(0x81, Fault::stall);
    EXPECT_EQ(fault_of([&] { mount->position(); }), Fault::stall);
    // An old error is cleared by being read.
    bus.queue("0gs", "0GS02");
    mount->recover();
    EXPECT_NEAR(mount->position(), 18, 1e-9);
    bus.queue("0gs", "0GS0D");
    bus.queue("0gs", "0GS0D");
    EXPECT_EQ(fault_of([&] { mount->recover(); }), Fault::mechanical);
}

TEST(Elliptec, HomesAfterItWasUnplugged) {
    FakeBus bus;
    bus.position['1'] = 0;
    const auto mount = bus.mount('0');
    const auto other = bus.mount('1');
    bus.port->unplug();
    EXPECT_EQ(fault_of([&] { mount->move_to(90); }), Fault::unplugged);
    EXPECT_FALSE(mount->reconnect(0.01));
    bus.port->on_reopen = [](double) { return true; };
    EXPECT_TRUE(mount->reconnect(0.01));
    EXPECT_EQ(bus.count("0ho0"), 1);
    // The other one lost its supply with it, and nobody told it.
    EXPECT_NEAR(other->move_to(90), 90, 1e-9);
    EXPECT_EQ(bus.count("1ho0"), 1);
    EXPECT_NEAR(other->move_to(18), 18, 1e-9);
    EXPECT_EQ(bus.count("1ho0"), 1);
    // Another mount in its place.
    bus.port->unplug();
    bus.identity = "0IN0E1140058820220201016800023000";
    EXPECT_EQ(fault_of([&] { mount->reconnect(0.01); }), Fault::refused);
}

}  // namespace
}  // namespace drude
