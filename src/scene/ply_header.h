// What a PLY header declares.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"

namespace drude {

enum class PlyFormat { ascii, little_endian, big_endian };
enum class PlyType { int8, uint8, int16, uint16, int32, uint32, float32, float64 };
size_t ply_size(PlyType type);

struct PlyProperty {
    std::string name;
    PlyType type = PlyType::float32;
    bool is_list = false;
    PlyType count_type = PlyType::uint8;  // of a list
};

struct PlyElement {
    std::string name;
    uint64_t count = 0;
    std::vector<PlyProperty> properties;
    Place place;

    // Bytes one of it needs at least: lists may be empty, an ascii number is a digit and a blank.
    uint64_t least_bytes(PlyFormat format) const;
    // The index of the first property that has one of the names, or -1.
    int find(const std::vector<std::string_view>& names) const;
};

struct PlyHeader {
    PlyFormat format = PlyFormat::ascii;
    std::vector<PlyElement> elements;
    size_t body = 0;    // the first byte behind the header
    int body_line = 1;  // and its line
};

// Errors (user) with file:line for anything that is no header.
PlyHeader parse_ply_header(std::string_view bytes, const std::string& file);

}  // namespace drude
