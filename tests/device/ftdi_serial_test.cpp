#include "device/instruments/ftdi_serial.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <stdexcept>

#include "device/ftdi_packets.h"

namespace drude {
namespace {

// What the kernel's own driver sends for these rates.
TEST(FtdiDivisor, IsThatOfTheKernelsDriver) {
    EXPECT_EQ(ftdi_divisor(1200).value, 0x09C4);
    EXPECT_EQ(ftdi_divisor(9600).value, 0x4138);
    EXPECT_EQ(ftdi_divisor(19200).value, 0x809C);
    EXPECT_EQ(ftdi_divisor(57600).value, 0xC034);
    EXPECT_EQ(ftdi_divisor(115200).value, 0x001A);
    for (const uint32_t baud : {1200u, 9600u, 19200u, 57600u, 115200u}) {
        EXPECT_EQ(ftdi_divisor(baud).index, 0) << baud;
    }
    EXPECT_EQ(ftdi_divisor(3000000).value, 0);
    EXPECT_EQ(ftdi_divisor(2000000).value, 1);
}

// Backwards through the table of codes, written out here by the eighth they stand for.
TEST(FtdiDivisor, ReadBackIsWithinHalfAnEighthOfTheRate) {
    constexpr double eighth_of_code[] = {0, 0.5, 0.25, 0.125, 0.375, 0.625, 0.75, 0.875};
    for (uint32_t baud = 200; baud < 1'400'000; baud += 1 + baud / 7) {
        const FtdiDivisor divisor = ftdi_divisor(baud);
        const int code = (divisor.value >> 14) | ((divisor.index & 1) << 2);
        const double quotient = (divisor.value & 0x3FFF) + eighth_of_code[code];
        EXPECT_LE(std::abs(quotient - 3e6 / baud), 1.0 / 16 + 1e-9) << baud;
    }
}

TEST(FtdiDivisor, RatesThatNoDivisorMakesAreTheUsersError) {
    for (const uint32_t baud : {0u, 100u, 183u, 1'800'000u, 2'500'000u, 4'000'000u}) {
        try {
            ftdi_divisor(baud);
            ADD_FAILURE() << baud;
        } catch (const Error& error) {
            EXPECT_EQ(error.cause(), Cause::user);
        }
    }
}

TEST(FtdiStatus, IsTakenOffEveryPacketOfATransfer) {
    Bytes data(150);
    for (size_t i = 0; i < data.size(); ++i) data[i] = static_cast<uint8_t>(i);
    const Bytes transfer = ftdi_packets(data);
    ASSERT_EQ(transfer.size(), 156u);
    const FtdiPayload payload = strip_ftdi_status(transfer, 64, "chip");
    EXPECT_EQ(payload.data, data);
    EXPECT_EQ(payload.modem, 0x01);
    EXPECT_EQ(payload.line, 0x60);
    EXPECT_EQ(strip_ftdi_status(ftdi_packets(data, 512), 512, "chip").data, data);
    EXPECT_TRUE(strip_ftdi_status(Bytes{0x01, 0x60}, 64, "chip").data.empty());
    EXPECT_EQ(fault_of([] { strip_ftdi_status(Bytes{0x01}, 64, "chip"); }), Fault::bad_frame);
    EXPECT_EQ(fault_of([&] { strip_ftdi_status(Bytes(65), 64, "chip"); }), Fault::bad_frame);
}

TEST(FtdiStatus, ErrorsOfAnyPacketAreKept) {
    Bytes transfer = ftdi_packets(Bytes(100));
    transfer[1] |= 0x08;
    EXPECT_EQ(ftdi_line_errors(strip_ftdi_status(transfer, 64, "chip").line), "framing error");
    EXPECT_EQ(ftdi_line_errors(0x06), "overrun, parity error");
    EXPECT_EQ(ftdi_line_errors(0x10), "break");
    EXPECT_EQ(ftdi_line_errors(0x61), "");
}

TEST(FtdiSerial, SetsTheLineUpRequestByRequest) {
    const auto port = ftdi_port();
    SerialSettings settings;
    settings.baud = 115200;
    settings.flow = FlowControl::rts_cts;
    settings.latency_ms = 3;
    FtdiSerial line(port, settings);
    std::vector<std::array<int, 4>> sent;
    for (const auto& control : port->controls) {
        const ControlRequest& request = control.request;
        sent.push_back({request.request_type, request.request, request.value, request.index});
        EXPECT_TRUE(control.data.empty());
    }
    const std::vector<std::array<int, 4>> expected = {
        {0x40, 0, 0, 0}, {0x40, 9, 3, 0}, {0x40, 3, 0x001A, 0}, {0x40, 4, 0x0008, 0},
        {0x40, 0, 1, 0}, {0x40, 0, 2, 0}, {0x40, 2, 0, 0x0100}, {0x40, 1, 0x0303, 0}};
    EXPECT_EQ(sent, expected);
}

TEST(FtdiSerial, IdlePacketsAreNotData) {
    const auto port = ftdi_port();
    FtdiSerial line(port, {});
    for (int i = 0; i < 5; ++i) port->answer(0x81, {0x01, 0x60});
    port->answer(0x81, ftdi_packets("0GS"));
    port->answer(0x81, {0x01, 0x60});
    port->answer(0x81, ftdi_packets("00\r\n0PO00000000\r\n"));
    EXPECT_EQ(line.read_line(deadline_in(1)), "0GS00");
    EXPECT_EQ(line.read_line(deadline_in(1)), "0PO00000000");
    EXPECT_TRUE(port->holds_nothing());
}

TEST(FtdiSerial, WhatCameBeforeATimeoutIsKept) {
    const auto port = ftdi_port();
    FtdiSerial line(port, {});
    port->answer(0x81, ftdi_packets("0GS"));
    EXPECT_EQ(fault_of([&] { line.read_line(deadline_in(1)); }), Fault::timeout);
    port->answer(0x81, ftdi_packets("00\r\n"));
    EXPECT_EQ(line.read_line(deadline_in(1)), "0GS00");
    EXPECT_EQ(fault_of([&] { line.read_exact(1, deadline_in(-1)); }), Fault::timeout);
}

TEST(FtdiSerial, ALongMessageComesOverSeveralPackets) {
    const auto port = ftdi_port();
    FtdiSerial line(port, {});
    Bytes data(200);
    for (size_t i = 0; i < data.size(); ++i) data[i] = static_cast<uint8_t>(3 * i);
    port->answer(0x81, ftdi_packets(data));
    EXPECT_EQ(line.read_exact(150, deadline_in(1)), Bytes(data.begin(), data.begin() + 150));
    EXPECT_EQ(line.read_exact(50, deadline_in(1)), Bytes(data.begin() + 150, data.end()));
}

TEST(FtdiSerial, DamagedBytesAreABadFrame) {
    for (const uint8_t bit : Bytes{0x02, 0x04, 0x08, 0x10}) {
        const auto port = ftdi_port();
        FtdiSerial line(port, {});
        port->answer(0x81, ftdi_packets("0GS00\r\n", 64, static_cast<uint8_t>(0x60 | bit)));
        std::string message;
        EXPECT_EQ(fault_of([&] { line.read_line(deadline_in(1)); }, &message), Fault::bad_frame);
        EXPECT_NE(message.find(ftdi_line_errors(bit)), std::string::npos) << message;
        // None of the damaged bytes stay behind.
        port->answer(0x81, ftdi_packets("0GS09\r\n"));
        EXPECT_EQ(line.read_line(deadline_in(1)), "0GS09");
    }
}

TEST(FtdiSerial, ALineWithoutEndIsABadFrame) {
    const auto port = ftdi_port();
    FtdiSerial line(port, {});
    port->answer(0x81, ftdi_packets(std::string(400, 'A')));
    EXPECT_EQ(fault_of([&] { line.read_line(deadline_in(1)); }), Fault::bad_frame);
}

TEST(FtdiSerial, DrainDropsDataAndIsNotKeptByIdlePackets) {
    const auto port = ftdi_port();
    FtdiSerial line(port, {});
    port->answer(0x81, ftdi_packets("late"));
    port->answer(0x81, {0x01, 0x60});
    port->answer(0x81, ftdi_packets("answer\r\n", 64, 0x62));
    EXPECT_EQ(line.drain(1, deadline_in(1)), 12u);
    EXPECT_TRUE(port->holds_nothing());
}

// A chip that is never silent must not be drained for ever: the quiet time counts data only.
TEST(FtdiSerial, DrainOfAnIdleChipEnds) {
    class IdleChip : public FakeUsbPort {
      public:
        int reads = 0;
        size_t read(uint8_t, std::span<uint8_t> buffer, Deadline) override {
            // Far more than come in the quiet time asked for.
            if (++reads > 50'000'000) throw std::logic_error("drained for ever");
            buffer[0] = 0x01;
            buffer[1] = 0x60;
            return 2;
        }
    };
    const auto port = std::make_shared<IdleChip>();
    port->packet_sizes_ = {{0x02, 64}, {0x81, 64}};
    FtdiSerial line(port, {});
    EXPECT_EQ(line.drain(0.01, deadline_in(600)), 0u);
    EXPECT_GT(port->reads, 0);
    EXPECT_EQ(fault_of([&] { line.read_line(deadline_in(0.01)); }), Fault::timeout);
}

TEST(FtdiSerial, RecoveryClearsHaltsAndSetsUpAnew) {
    const auto port = ftdi_port();
    FtdiSerial line(port, {});
    const size_t requests = port->controls.size();
    port->fail(0x81, Fault::stall);
    EXPECT_EQ(fault_of([&] { line.read_line(deadline_in(1)); }), Fault::stall);
    port->answer(0x81, ftdi_packets("late\r\n"));
    line.recover();
    EXPECT_EQ(port->controls.size(), 2 * requests);
    // Also when it was opened: halts outlive the program that met them.
    EXPECT_EQ(port->cleared, (Bytes{0x81, 0x02, 0x81, 0x02}));
    port->answer(0x81, ftdi_packets("0GS00\r\n"));
    EXPECT_EQ(line.read_line(deadline_in(1)), "0GS00");
}

TEST(FtdiSerial, NeedsABulkEndpointEachWay) {
    const auto port = ftdi_port();
    port->packet_sizes_ = {{0x81, 64}};
    EXPECT_EQ(fault_of([&] { FtdiSerial line(port, {}); }), Fault::io);
}

}  // namespace
}  // namespace drude
