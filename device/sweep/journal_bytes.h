// The bytes of a journal's records, shared by its reader and its writer.
#pragma once

#include <bit>
#include <cstdint>
#include <string>
#include <string_view>

namespace drude {

inline constexpr std::string_view journal_magic = "DRUDEJ1\n";
inline constexpr size_t record_head_bytes = 16, record_tail_bytes = 4;

enum class RecordType : uint32_t {
    header = 1,
    exposure = 2,
    dark = 3,
    point = 4,
    rows = 5,
    event = 6,
    resume = 7,
    times = 8,
    end = 9,
};

class ByteWriter {
  public:
    void u32(uint32_t value) { put(value, 4); }
    void f64(double value) { put(std::bit_cast<uint64_t>(value), 8); }
    void count(uint32_t value, uint32_t bytes) { put(value, bytes); }
    void text(std::string_view value) {
        u32(static_cast<uint32_t>(value.size()));
        bytes_ += value;
    }
    void reserve(size_t size) { bytes_.reserve(size); }
    const std::string& bytes() const { return bytes_; }

  private:
    void put(uint64_t value, uint32_t size) {
        for (uint32_t i = 0; i < size; ++i) bytes_ += static_cast<char>(value >> (8 * i) & 0xFF);
    }
    std::string bytes_;
};

// Reads what ByteWriter wrote; past the end it returns zeros and good() is false.
class ByteReader {
  public:
    explicit ByteReader(std::string_view bytes) : bytes_(bytes) {}
    uint32_t u32() { return static_cast<uint32_t>(take(4)); }
    double f64() { return std::bit_cast<double>(take(8)); }
    uint32_t count(uint32_t size) { return static_cast<uint32_t>(take(size)); }
    std::string text() {
        const uint32_t size = u32();
        if (size > left()) {
            good_ = false;
            return {};
        }
        std::string value(bytes_.substr(at_, size));
        at_ += size;
        return value;
    }
    size_t left() const { return bytes_.size() - at_; }
    bool good() const { return good_; }

  private:
    uint64_t take(uint32_t size) {
        if (size > left()) {
            good_ = false;
            at_ = bytes_.size();
            return 0;
        }
        uint64_t value = 0;
        for (uint32_t i = 0; i < size; ++i) {
            value |= uint64_t{static_cast<unsigned char>(bytes_[at_ + i])} << (8 * i);
        }
        at_ += size;
        return value;
    }
    std::string_view bytes_;
    size_t at_ = 0;
    bool good_ = true;
};

}  // namespace drude
