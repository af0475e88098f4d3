#include "base/md5.h"

#include <bit>
#include <cmath>
#include <cstddef>

namespace drude {

namespace {

// RFC 1321 section 3.4: the integer part of 2^32 |sin(i)|, i = 1 to 64.
std::array<uint32_t, 64> sine_table() {
    std::array<uint32_t, 64> table{};
    for (size_t i = 0; i < table.size(); ++i) {
        table[i] = static_cast<uint32_t>(
            std::floor(std::abs(std::sin(static_cast<double>(i + 1))) * 4294967296.0));
    }
    return table;
}

// Left rotations of the four rounds, which repeat after four steps.
constexpr int rotations[4][4] = {{7, 12, 17, 22}, {5, 9, 14, 20}, {4, 11, 16, 23}, {6, 10, 15, 21}};

void compress(std::array<uint32_t, 4>& state, const uint8_t* block) {
    static const std::array<uint32_t, 64> sines = sine_table();
    std::array<uint32_t, 16> words{};
    for (size_t i = 0; i < 64; ++i) words[i / 4] |= uint32_t{block[i]} << (8 * (i % 4));
    auto [a, b, c, d] = state;
    for (size_t i = 0; i < 64; ++i) {
        uint32_t mixed = 0;
        size_t word = 0;
        switch (i / 16) {
            case 0:
                mixed = (b & c) | (~b & d);
                word = i;
                break;
            case 1:
                mixed = (d & b) | (~d & c);
                word = (5 * i + 1) % 16;
                break;
            case 2:
                mixed = b ^ c ^ d;
                word = (3 * i + 5) % 16;
                break;
            default:
                mixed = c ^ (b | ~d);
                word = 7 * i % 16;
                break;
        }
        const uint32_t sum = a + mixed + words[word] + sines[i];
        a = d, d = c, c = b;
        b += std::rotl(sum, rotations[i / 16][i % 4]);
    }
    state[0] += a, state[1] += b, state[2] += c, state[3] += d;
}

}  // namespace

std::array<uint8_t, 16> md5(std::span<const uint8_t> bytes) {
    std::array<uint32_t, 4> state = {0x67452301, 0xEFCDAB89, 0x98BADCFE, 0x10325476};
    const uint64_t bits = uint64_t{bytes.size()} * 8;
    size_t at = 0;
    for (; bytes.size() - at >= 64; at += 64) compress(state, bytes.data() + at);
    std::array<uint8_t, 128> tail{};
    const size_t left = bytes.size() - at;
    for (size_t i = 0; i < left; ++i) tail[i] = bytes[at + i];
    tail[left] = 0x80;
    const size_t tail_size = left < 56 ? 64 : 128;
    for (size_t i = 0; i < 8; ++i) {
        tail[tail_size - 8 + i] = static_cast<uint8_t>(bits >> (8 * i));
    }
    for (size_t i = 0; i < tail_size; i += 64) compress(state, tail.data() + i);
    std::array<uint8_t, 16> digest{};
    for (size_t i = 0; i < 16; ++i) digest[i] = static_cast<uint8_t>(state[i / 4] >> (8 * (i % 4)));
    return digest;
}

}  // namespace drude
