#include "usb_bench/qemu/usbip_protocol.h"

#include <gtest/gtest.h>

#include <cerrno>

#include "base/error.h"

namespace drude::usb_bench {
namespace {

std::string from_hex(std::string_view text) {
    std::string digits, bytes;
    for (const char c : text) {
        if (c != ' ') digits += c;
    }
    for (size_t i = 0; i + 1 < digits.size(); i += 2) {
        bytes += static_cast<char>(std::stoi(digits.substr(i, 2), nullptr, 16));
    }
    return bytes;
}

// Captured from a wire by the kernel's developers: the example at the end of
// Documentation/usb/usbip_protocol.rst.
const std::string captured_in =
    "00000001 00000d05 0001000f 00000001 00000001 00000200 00000040 ffffffff 00000000 00000004 "
    "00000000 00000000";
const std::string captured_out =
    "00000001 00000d06 0001000f 00000000 00000001 00000000 00000040 ffffffff 00000000 00000004 "
    "00000000 00000000";
const std::string captured_out_data = "ffffffff860008a784ce5ae212376300" + std::string(96, '0');
const std::string captured_out_answer =
    "00000003 00000d06 00000000 00000000 00000000 00000000 00000040 ffffffff 00000000 00000000 "
    "00000000 00000000";
const std::string captured_in_answer =
    "00000003 00000d05 00000000 00000000 00000000 00000000 00000040 ffffffff 00000000 00000000 "
    "00000000 00000000";
const std::string captured_in_data =
    "ffffffff860011a784ce5ae2123763612891b10201000004" + std::string(80, '0');

TEST(UsbipProtocol, ReadsWhatWasCaptured) {
    UsbipReader reader;
    reader.append(from_hex(captured_in + captured_out + captured_out_data));
    const auto in = reader.next();
    ASSERT_TRUE(in);
    EXPECT_EQ(in->kind, UsbipCommand::Kind::submit);
    EXPECT_EQ(in->sequence, 0xD05u);
    EXPECT_TRUE(in->incoming);
    EXPECT_EQ(in->endpoint, 1);
    EXPECT_EQ(in->length, 64u);
    EXPECT_EQ(in->data, "");
    const auto out = reader.next();
    ASSERT_TRUE(out);
    EXPECT_EQ(out->sequence, 0xD06u);
    EXPECT_FALSE(out->incoming);
    EXPECT_EQ(out->length, 64u);
    EXPECT_EQ(out->data, from_hex(captured_out_data));
    EXPECT_FALSE(reader.next());
}

TEST(UsbipProtocol, AnswersAsCaptured) {
    EXPECT_EQ(format_usbip_answer(0xD06, 0, 64, ""), from_hex(captured_out_answer));
    EXPECT_EQ(format_usbip_answer(0xD05, 0, 64, from_hex(captured_in_data)),
              from_hex(captured_in_answer + captured_in_data));
}

// -ECONNRESET is -104 on Linux; the layout is that of the document's tables.
TEST(UsbipProtocol, TakesBackASubmit) {
    UsbipReader reader;
    reader.append(
        from_hex("00000002 00000d07 0001000f 00000000 00000000 00000d05" + std::string(48, '0')));
    const auto unlink = reader.next();
    ASSERT_TRUE(unlink);
    EXPECT_EQ(unlink->kind, UsbipCommand::Kind::unlink);
    EXPECT_EQ(unlink->sequence, 0xD07u);
    EXPECT_EQ(unlink->victim, 0xD05u);
    EXPECT_EQ(
        format_usbip_unlinked(0xD07, -ECONNRESET),
        from_hex("00000004 00000d07 00000000 00000000 00000000 ffffff98" + std::string(48, '0')));
}

TEST(UsbipProtocol, TakesPiecesOfAnySize) {
    const std::string bytes = from_hex(captured_in + captured_out + captured_out_data);
    for (size_t piece = 1; piece < bytes.size(); piece += 7) {
        UsbipReader reader;
        std::vector<uint32_t> sequences;
        for (size_t at = 0; at < bytes.size(); at += piece) {
            reader.append(std::string_view(bytes).substr(at, piece));
            while (const auto command = reader.next()) sequences.push_back(command->sequence);
        }
        EXPECT_EQ(sequences, (std::vector<uint32_t>{0xD05, 0xD06})) << piece;
    }
}

// The setup packet goes through as it is: SET_ADDRESS is no business of the message format.
TEST(UsbipProtocol, KeepsTheSetupPacket) {
    UsbipReader reader;
    reader.append(
        from_hex("00000001 00000001 00010002 00000001 00000000 00000200 00000040 00000000 "
                 "00000000 00000000 80060001 00004000"));
    const auto command = reader.next();
    ASSERT_TRUE(command);
    EXPECT_EQ(command->endpoint, 0);
    EXPECT_EQ(command->setup, (std::array<uint8_t, 8>{0x80, 6, 0, 1, 0, 0, 0x40, 0}));
}

TEST(UsbipProtocol, RefusesWhatIsNoCommand) {
    for (const char* wrong : {
             // A kind that there is not.
             "00000005 00000001 00010002 00000001 00000000 00000000 00000000 00000000 00000000",
             // Endpoint 16, 16 MB and a byte, three isochronous packets.
             "00000001 00000001 00010002 00000001 00000010 00000000 00000040 00000000 00000000",
             "00000001 00000001 00010002 00000000 00000001 00000000 01000001 00000000 00000000",
             "00000001 00000001 00010002 00000001 00000001 00000000 00000040 00000000 00000003",
         }) {
        UsbipReader reader;
        reader.append(from_hex(wrong + std::string(24, '0')));
        EXPECT_THROW(reader.next(), Error) << wrong;
    }
}

}  // namespace
}  // namespace drude::usb_bench
