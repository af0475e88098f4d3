#include "base/md5.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>

namespace drude {
namespace {

std::string digest(const std::string& text) {
    std::string hex;
    for (const uint8_t byte : md5({reinterpret_cast<const uint8_t*>(text.data()), text.size()})) {
        hex += fmt::format("{:02x}", byte);
    }
    return hex;
}

TEST(Md5, TheTestSuiteOfTheRfc) {
    EXPECT_EQ(digest(""), "d41d8cd98f00b204e9800998ecf8427e");
    EXPECT_EQ(digest("a"), "0cc175b9c0f1b6a831c399e269772661");
    EXPECT_EQ(digest("abc"), "900150983cd24fb0d6963f7d28e17f72");
    EXPECT_EQ(digest("message digest"), "f96b697d7cb7938d525a2f31aaf161d0");
    EXPECT_EQ(digest("ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789"),
              "d174ab98d277d9f5a5611c2c9f419d9f");
    EXPECT_EQ(digest("1234567890123456789012345678901234567890123456789012345678901234567890"
                     "1234567890"),
              "57edf4a22be3c955ac49da2e2107b67a");
}

// Around the lengths at which the padding takes another block; by md5sum (GNU coreutils).
TEST(Md5, PaddingAtEveryEdge) {
    EXPECT_EQ(digest(std::string(55, 'x')), "04364420e25c512fd958a70738aa8f72");
    EXPECT_EQ(digest(std::string(56, 'x')), "668a72d5ba17f08e62dabcafad6db14b");
    EXPECT_EQ(digest(std::string(57, 'x')), "693037871c4a9d3d8685018905cb530a");
    EXPECT_EQ(digest(std::string(63, 'x')), "7dc2ca208106a2f703567bdff99d8981");
    EXPECT_EQ(digest(std::string(64, 'x')), "c1bb4f81d892b2d57947682aeb252456");
    EXPECT_EQ(digest(std::string(65, 'x')), "1bc932052302d074bdec39795fe00cf6");
    EXPECT_EQ(digest(std::string(119, 'x')), "ab347a5f68c8a443cfcddc633f12c24f");
    EXPECT_EQ(digest(std::string(120, 'x')), "fb98667f98096de92620b64f46e1c5b5");
    EXPECT_EQ(digest(std::string(128, 'x')), "d69cb61a6ee87200676eb0d4b90edbcb");
}

}  // namespace
}  // namespace drude
