// JSON as a tree that knows where each value stands in its file, so that every complaint about a
// record can name file:line:column and the key.
//
// nlohmann::json does the parsing (json_tree.cpp) and stays out of this header.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"

namespace drude {

struct JsonKey {
    std::string name;
    size_t offset = 0;
};

struct JsonNode {
    enum class Kind { null, boolean, number, string, array, object };
    Kind kind = Kind::null;
    double number = 0;            // 1 for true
    size_t offset = 0;            // of its first byte in the text
    std::string text;             // of a string
    std::vector<JsonNode> items;  // elements of an array, values of an object
    std::vector<JsonKey> keys;    // of an object, one an item, distinct
};

struct JsonDocument {
    std::string file;
    std::string text;
    JsonNode root;

    // Line and column (in bytes) of an offset, from 1.
    Place place(size_t offset) const;
};

// Throws Error (user) with file:line:column where `text` is not JSON (RFC 8259), a number does not
// fit a double, an object has a key twice, or values nest deeper than 64.
JsonDocument parse_json_tree(std::string text, std::string file);

// A value of a document with the path that leads to it ("layers[0].n"). Reading the wrong type is
// an Error (user) that names file:line:column, the path, what was found and what was expected.
class JsonValue {
  public:
    // The root; the document must outlive the value.
    explicit JsonValue(const JsonDocument& document)
        : document_(&document), node_(&document.root) {}

    Place place() const { return document_->place(node_->offset); }
    // For messages: "'beta'", or "the record" for the root.
    std::string shown() const;

    std::string string() const;
    double number() const;
    // Without a fraction, from `first` to `last`, which lie within +-2^53: what a double, and so a
    // number of JSON, holds exactly.
    int64_t whole_number(double first, double last) const;
    // "123": 64 bits without a sign, which JSON's numbers do not hold.
    uint64_t quoted_whole_number() const;
    bool boolean() const;
    std::vector<double> numbers() const;
    std::vector<std::string> strings() const;
    std::vector<JsonValue> array() const;

    // Of an object. has() and at() are Errors where this is none; at() where the key is missing.
    bool has(std::string_view key) const;
    JsonValue at(std::string_view key) const;
    // Throws Error (user) for a key that is not among `allowed`, with the nearest of them.
    void allow_keys(const std::vector<std::string>& allowed) const;

    // Runs `read`, adding this value's place to an Error that leaves it.
    template <class Read>
    auto located(Read read) const {
        try {
            return read();
        } catch (const Error& error) {
            throw Error(error.cause(), place(), shown() + ": " + error.message());
        }
    }

  private:
    JsonValue(const JsonDocument& document, const JsonNode& node, std::string path)
        : document_(&document), node_(&node), path_(std::move(path)) {}
    void expect(JsonNode::Kind kind) const;
    // The index of a member, or the number of members where there is none of that name.
    size_t member(std::string_view key) const;
    std::string child_path(std::string_view key) const;

    const JsonDocument* document_;
    const JsonNode* node_;
    std::string path_;
};

}  // namespace drude
