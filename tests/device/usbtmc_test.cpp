#include "device/instruments/usbtmc.h"

#include <gtest/gtest.h>

#include "device/fake_tmc.h"

namespace drude {
namespace {

TEST(UsbtmcMessage, AMessageIsPaddedToFourBytesThatItsHeaderDoesNotCount) {
    EXPECT_EQ(encode_usbtmc_out(1, "*IDN?\n", true),
              (Bytes{0x01, 0x01, 0xFE, 0x00, 0x06, 0x00, 0x00, 0x00, 0x01, 0x00,
                     0x00, 0x00, '*',  'I',  'D',  'N',  '?',  '\n', 0x00, 0x00}));
    EXPECT_EQ(encode_usbtmc_out(0x55, "abcd", false),
              (Bytes{0x01, 0x55, 0xAA, 0x00, 0x04, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 'a',
                     'b', 'c', 'd'}));
    EXPECT_EQ(encode_usbtmc_out(2, std::string(0x10203, 'x'), true).size(), 12u + 0x10204u);
    EXPECT_EQ(encode_usbtmc_out(2, std::string(0x10203, 'x'), true)[4], 0x03);
    EXPECT_EQ(encode_usbtmc_out(2, std::string(0x10203, 'x'), true)[6], 0x01);
}

TEST(UsbtmcMessage, ARequestNamesItsSizeAndMaybeACharacter) {
    EXPECT_EQ(encode_usbtmc_request(0xFF, 0x01020304, {}),
              (Bytes{0x02, 0xFF, 0x00, 0x00, 0x04, 0x03, 0x02, 0x01, 0x00, 0x00, 0x00, 0x00}));
    EXPECT_EQ(encode_usbtmc_request(3, 256, '\n'),
              (Bytes{0x02, 0x03, 0xFC, 0x00, 0x00, 0x01, 0x00, 0x00, 0x02, 0x0A, 0x00, 0x00}));
}

TEST(UsbtmcMessage, TagsGoFrom1To255) {
    EXPECT_EQ(next_usbtmc_tag(0), 1);
    EXPECT_EQ(next_usbtmc_tag(254), 255);
    EXPECT_EQ(next_usbtmc_tag(255), 1);
}

TEST(UsbtmcMessage, AnAnswerWithItsPadding) {
    const Bytes transfer = {0x02, 0x07, 0xF8, 0x00, 0x05, 0x00, 0x00, 0x00, 0x01, 0x00,
                            0x00, 0x00, 'h',  'e',  'l',  'l',  'o',  0x00, 0x00, 0x00};
    const UsbtmcPart part = parse_usbtmc_in(transfer, 7, 100, "head");
    EXPECT_EQ(part.data, "hello");
    EXPECT_TRUE(part.end);
    EXPECT_FALSE(part.terminated);
    // Without padding it is accepted too; what follows beyond it is not.
    EXPECT_EQ(parse_usbtmc_in(std::span(transfer).first(17), 7, 5, "head").data, "hello");
    const auto fault = [&](size_t at, uint8_t value, uint32_t requested = 100) {
        Bytes bad = transfer;
        bad[at] = value;
        return fault_of([&] { parse_usbtmc_in(bad, 7, requested, "head"); });
    };
    EXPECT_EQ(fault(0, 0x01), Fault::bad_frame);     // message
    EXPECT_EQ(fault(2, 0xF9), Fault::bad_frame);     // complement
    EXPECT_EQ(fault(4, 0x09), Fault::short_read);    // more than there is
    EXPECT_EQ(fault(7, 0xFF), Fault::bad_frame);     // 4 GiB
    EXPECT_EQ(fault(4, 0x05, 4), Fault::bad_frame);  // more than asked for
    EXPECT_EQ(fault(4, 0x04), Fault::bad_frame);     // 4 bytes after it
    EXPECT_EQ(fault_of([&] { parse_usbtmc_in(transfer, 8, 100, "head"); }), Fault::bad_frame);
    EXPECT_EQ(fault_of([&] { parse_usbtmc_in(std::span(transfer).first(11), 7, 100, "head"); }),
              Fault::short_read);
}

TEST(UsbtmcMessage, Capabilities) {
    Bytes bytes(24);
    bytes[0] = 1;
    bytes[3] = 1;
    bytes[5] = 1;
    bytes[13] = 1;
    bytes[14] = 6;
    bytes[15] = 8;
    const UsbtmcCapabilities capabilities = parse_usbtmc_capabilities(bytes, "head");
    EXPECT_EQ(capabilities.version, 0x0100);
    EXPECT_TRUE(capabilities.terminator);
    EXPECT_TRUE(capabilities.is_488 && capabilities.remote_local && capabilities.scpi);
    EXPECT_FALSE(capabilities.trigger || capabilities.listen_only || capabilities.talk_only);
    bytes[0] = 0x80;
    EXPECT_EQ(fault_of([&] { parse_usbtmc_capabilities(bytes, "head"); }), Fault::refused);
    bytes[0] = 1;
    bytes.pop_back();
    EXPECT_EQ(fault_of([&] { parse_usbtmc_capabilities(bytes, "head"); }), Fault::short_read);
    EXPECT_EQ(fault_of([&] { parse_usbtmc_capabilities({}, "head"); }), Fault::short_read);
}

TEST(Usbtmc, AsksAndVerifiesTheEcho) {
    FakeTmc head;
    Usbtmc tmc(head.port);
    head.answers["*IDN?"] = "drude,HEAD-1,7,0.1\n";
    EXPECT_EQ(tmc.ask("*IDN?\n", 1), "drude,HEAD-1,7,0.1\n");
    head.tag_offset = 1;
    std::string message;
    EXPECT_EQ(fault_of([&] { tmc.ask("*IDN?\n", 1); }, &message), Fault::bad_frame);
    EXPECT_NE(message.find("answer to request"), std::string::npos) << message;
    head.tag_offset = 0;
    EXPECT_EQ(tmc.ask("*IDN?\n", 1), "drude,HEAD-1,7,0.1\n");
}

TEST(Usbtmc, ClearsOnOpeningAndRefusesThoseThatDoNotTalk) {
    FakeTmc head;
    Usbtmc tmc(head.port);
    std::vector<int> requests;
    for (const auto& control : head.port->controls) requests.push_back(control.request.request);
    EXPECT_EQ(requests, (std::vector<int>{7, 5, 6}));
    EXPECT_EQ(head.port->cleared, (Bytes{0x02, 0x81}));
    FakeTmc listener;
    listener.interface_bits = 1;
    EXPECT_EQ(fault_of([&] { Usbtmc dumb(listener.port); }), Fault::refused);
    FakeTmc crippled;
    crippled.port->packet_sizes_ = {{0x02, 512}};
    EXPECT_EQ(fault_of([&] { Usbtmc none(crippled.port); }), Fault::io);
}

// Every length about the sizes of packets and transfers, so that every way to end is met: short
// packet, empty packet, several transfers.
TEST(Usbtmc, AnswersOfEveryLength) {
    FakeTmc head;
    UsbtmcOptions options;
    options.transfer = 1024;
    Usbtmc tmc(head.port, options);
    for (const size_t size : {1u, 3u, 4u, 497u, 500u, 501u, 511u, 512u, 1009u, 1012u, 1013u, 1023u,
                              1024u, 1025u, 2048u, 5000u}) {
        std::string text(size, ' ');
        for (size_t i = 0; i < size; ++i) text[i] = static_cast<char>('a' + i % 26);
        head.answers["DATA?"] = text;
        EXPECT_EQ(tmc.ask("DATA?", 1), text) << size;
        EXPECT_TRUE(head.port->holds_nothing()) << size;
    }
}

// An empty packet that was left behind by the transfer before.
TEST(Usbtmc, AnEmptyPacketBeforeAnAnswerIsSkipped) {
    FakeTmc head;
    Usbtmc tmc(head.port);
    head.answers["A?"] = "1";
    head.port->answer(0x81, {});
    EXPECT_EQ(tmc.ask("A?", 1), "1");
    EXPECT_TRUE(head.port->holds_nothing());
}

TEST(Usbtmc, RequestsNameTheInterfaceAndTheEndpoint) {
    FakeTmc head;
    head.port->interface_ = 3;
    Usbtmc tmc(head.port);
    tmc.status_byte();
    ASSERT_EQ(head.port->controls.size(), 4u);  // capabilities, clear, its check, status byte
    for (const auto& control : head.port->controls) {
        EXPECT_EQ(control.request.request_type, 0xA1);
        EXPECT_EQ(control.request.index, 3);
    }
}

TEST(Usbtmc, LongMessagesGoInSeveralTransfers) {
    FakeTmc head;
    UsbtmcOptions options;
    options.transfer = 100;
    Usbtmc tmc(head.port, options);
    const std::string text(250, 'x');
    tmc.write(text, deadline_in(1));
    ASSERT_EQ(head.port->writes.size(), 3u);
    EXPECT_EQ(head.port->writes[0].bytes[8], 0);
    EXPECT_EQ(head.port->writes[1].bytes[8], 0);
    EXPECT_EQ(head.port->writes[2].bytes[8], 1);
    EXPECT_EQ(head.port->writes[2].bytes[4], 50);
    EXPECT_EQ(head.messages.back(), text);
    // Tags over more than 255 messages.
    head.answers["A?"] = "1";
    for (int i = 0; i < 300; ++i) ASSERT_EQ(tmc.ask("A?", 1), "1") << i;
}

TEST(Usbtmc, EndsAtACharacterWhereTheInstrumentCan) {
    FakeTmc head;
    head.device_bits = 1;
    head.answers["A?"] = "one\ntwo\n";
    Usbtmc tmc(head.port);
    tmc.write("A?", deadline_in(1));
    EXPECT_EQ(tmc.read(deadline_in(1), '\n'), "one\n");
    EXPECT_EQ(tmc.read(deadline_in(1), '\n'), "two\n");
    FakeTmc without;
    Usbtmc other(without.port);
    EXPECT_EQ(fault_of([&] { other.read(deadline_in(1), '\n'); }), Fault::refused);
}

// The situation of python-usbtmc's issue 49: a question that is never answered. Its request has to
// be given up and the endpoint read to a short packet, or all later answers are out of step.
TEST(Usbtmc, AHungQuestionIsAbortedAndDrainedAndTheNextOneIsRight) {
    FakeTmc head;
    Usbtmc tmc(head.port);
    head.answers["*IDN?"] = "drude,HEAD-1,7,0.1\n";
    head.hang = 1;
    EXPECT_EQ(fault_of([&] { tmc.ask("MEAS?\n", 1); }), Fault::timeout);
    EXPECT_EQ(head.aborted, 1);
    EXPECT_TRUE(head.port->holds_nothing()) << "the empty packet that ends the abort was read";
    EXPECT_EQ(tmc.ask("*IDN?\n", 1), "drude,HEAD-1,7,0.1\n");
}

// It had begun to send: what is on its way is read up to a short packet, in several rounds where
// the instrument says that there is more.
TEST(Usbtmc, WhatWasOnItsWayIsDrained) {
    FakeTmc head;
    Usbtmc tmc(head.port);
    head.answers["*IDN?"] = "drude,HEAD-1,7,0.1\n";
    head.hang = 1;
    head.late = Bytes(3 * 512 + 7, 0x55);
    head.pending_checks = 2;
    EXPECT_EQ(fault_of([&] { tmc.ask("MEAS?\n", 1); }), Fault::timeout);
    EXPECT_EQ(head.aborted, 1);
    EXPECT_EQ(tmc.ask("*IDN?\n", 1), "drude,HEAD-1,7,0.1\n");
}

TEST(Usbtmc, AnAbortThatFailsIsMadeUpForByAClear) {
    FakeTmc head;
    Usbtmc tmc(head.port);
    head.answers["*IDN?"] = "drude,HEAD-1,7,0.1\n";
    head.hang = 1;
    head.abort_check_status = 0x80;
    EXPECT_EQ(fault_of([&] { tmc.ask("MEAS?\n", 1); }), Fault::timeout);
    const int clears = head.clears;
    EXPECT_EQ(tmc.ask("*IDN?\n", 1), "drude,HEAD-1,7,0.1\n");
    EXPECT_EQ(head.clears, clears + 1);
}

// An instrument that knows of no request any more: what it sent meanwhile is dropped.
TEST(Usbtmc, LateAnswersAreDroppedWhereNothingIsInProgress) {
    FakeTmc head;
    Usbtmc tmc(head.port);
    head.answers["*IDN?"] = "drude,HEAD-1,7,0.1\n";
    head.hang = 1;
    head.abort_status = 0x81;
    head.late = Bytes(20, 0x55);
    EXPECT_EQ(fault_of([&] { tmc.ask("MEAS?\n", 1); }), Fault::timeout);
    EXPECT_EQ(tmc.ask("*IDN?\n", 1), "drude,HEAD-1,7,0.1\n");
}

TEST(Usbtmc, AMessageThatDoesNotGoOutIsAborted) {
    FakeTmc head;
    Usbtmc tmc(head.port);
    head.answers["*IDN?"] = "drude,HEAD-1,7,0.1\n";
    for (const Fault fault : {Fault::timeout, Fault::stall}) {
        head.port->cleared.clear();
        head.port->fail_write(0x02, fault);
        EXPECT_EQ(fault_of([&] { tmc.ask("*IDN?\n", 1); }), fault);
        EXPECT_EQ(head.port->controls[head.port->controls.size() - 2].request.request, 1);
        EXPECT_EQ(head.port->controls.back().request.request, 2);
        EXPECT_EQ(head.port->cleared, Bytes{0x02});
        EXPECT_EQ(tmc.ask("*IDN?\n", 1), "drude,HEAD-1,7,0.1\n");
    }
}

TEST(Usbtmc, StallAndOverflowOnTheWayIn) {
    FakeTmc head;
    Usbtmc tmc(head.port);
    head.answers["*IDN?"] = "drude,HEAD-1,7,0.1\n";
    for (const Fault fault : {Fault::stall, Fault::overflow}) {
        head.hang = head.questions + 1;
        head.fault = fault;
        EXPECT_EQ(fault_of([&] { tmc.ask("MEAS?\n", 1); }), fault);
        EXPECT_EQ(tmc.ask("*IDN?\n", 1), "drude,HEAD-1,7,0.1\n");
    }
}

TEST(Usbtmc, AnswersThatDoNotEnd) {
    FakeTmc head;
    UsbtmcOptions options;
    options.largest_answer = 100;
    options.transfer = 64;
    Usbtmc tmc(head.port, options);
    head.answers["A?"] = std::string(101, 'x');
    EXPECT_EQ(tmc.ask("A?", 1).size(), 101u) << "the last part was under way already";
    head.answers["A?"] = std::string(1000, 'x');
    std::string message;
    EXPECT_EQ(fault_of([&] { tmc.ask("A?", 1); }, &message), Fault::bad_frame);
    EXPECT_NE(message.find("more than 100 bytes"), std::string::npos) << message;
    head.answers["B?"] = "b";
    tmc.clear();
    EXPECT_EQ(tmc.ask("B?", 1), "b");
    head.endless = true;
    EXPECT_EQ(fault_of([&] { tmc.ask("B?", 1); }), Fault::bad_frame);
}

TEST(Usbtmc, TheStatusByte) {
    FakeTmc head;
    head.status = 0x50;
    Usbtmc tmc(head.port);
    for (int i = 0; i < 300; ++i) {
        ASSERT_EQ(tmc.status_byte(), 0x50);
        const uint16_t tag = head.port->controls.back().request.value;
        ASSERT_GE(tag, 2);
        ASSERT_LE(tag, 127);
    }
    head.status_tag_offset = 1;
    EXPECT_EQ(fault_of([&] { tmc.status_byte(); }), Fault::bad_frame);
}

TEST(Usbtmc, TheStatusByteComesByInterruptWhereThereIsOne) {
    FakeTmc head(true);
    head.status = 0x40;
    Usbtmc tmc(head.port);
    head.port->answer(0x83, {0x81, 0x10});  // a request for service
    EXPECT_EQ(tmc.status_byte(), 0x40);
    EXPECT_TRUE(head.port->holds_nothing());
}

TEST(Usbtmc, UnpluggedAndBack) {
    FakeTmc head;
    Usbtmc tmc(head.port);
    head.answers["A?"] = "1";
    head.port->unplug();
    EXPECT_EQ(fault_of([&] { tmc.ask("A?", 1); }), Fault::unplugged);
    EXPECT_FALSE(tmc.reopen(0.01));
    head.port->on_reopen = [](double) { return true; };
    EXPECT_TRUE(tmc.reopen(0.01));
    EXPECT_EQ(tmc.ask("A?", 1), "1");
}

}  // namespace
}  // namespace drude
