#include "materials/json_tree.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>
#include <optional>
#include <tuple>

#include "base/numbers.h"

namespace drude {

namespace {

using nlohmann::json;

constexpr size_t deepest_nesting = 64;
constexpr int number_overflow = 406;  // of nlohmann's out_of_range
constexpr std::string_view white = " \t\r\n";

std::string_view kind_name(JsonNode::Kind kind) {
    switch (kind) {
        case JsonNode::Kind::null:
            return "null";
        case JsonNode::Kind::boolean:
            return "true or false";
        case JsonNode::Kind::number:
            return "a number";
        case JsonNode::Kind::string:
            return "a string";
        case JsonNode::Kind::array:
            return "an array";
        case JsonNode::Kind::object:
            return "an object";
    }
    return "";
}

// What was found, short, and free of bytes that a terminal or another JSON writer chokes on.
std::string printable(std::string_view found) {
    std::string shown;
    for (const char c : found.substr(0, 40)) shown += c < 32 || c > 126 ? '?' : c;
    return found.size() > 40 ? shown + "..." : shown;
}

// Bytes of the text that tells how far the parser has read.
class CountingIterator {
  public:
    using iterator_category = std::input_iterator_tag;
    using value_type = char;
    using difference_type = std::ptrdiff_t;
    using pointer = const char*;
    using reference = const char&;

    CountingIterator(const char* at, const char** reached) : at_(at), reached_(reached) {}
    reference operator*() const { return *at_; }
    CountingIterator& operator++() {
        *reached_ = ++at_;
        return *this;
    }
    CountingIterator operator++(int) {
        const CountingIterator before = *this;
        ++*this;
        return before;
    }
    bool operator==(const CountingIterator& other) const { return at_ == other.at_; }
    bool operator!=(const CountingIterator& other) const { return at_ != other.at_; }

  private:
    const char* at_;
    const char** reached_;
};

// The parser's events, built into a tree. The names and signatures are nlohmann's.
class TreeBuilder {
  public:
    explicit TreeBuilder(JsonDocument& document)
        : document_(document), reached_(document.text.data()) {}

    bool parse() {
        const char* begin = document_.text.data();
        const char* end = begin + document_.text.size();
        return json::sax_parse(CountingIterator(begin, &reached_), CountingIterator(end, &reached_),
                               this);
    }

    bool null() { return add(leaf(JsonNode::Kind::null)); }
    bool boolean(bool value) {
        JsonNode node = leaf(JsonNode::Kind::boolean);
        node.number = value ? 1 : 0;
        return add(std::move(node));
    }
    bool number_integer(int64_t value) { return add_number(static_cast<double>(value)); }
    bool number_unsigned(uint64_t value) { return add_number(static_cast<double>(value)); }
    bool number_float(double value, const std::string&) { return add_number(value); }
    bool string(std::string& value) {
        JsonNode node = leaf(JsonNode::Kind::string);
        node.text = std::move(value);
        return add(std::move(node));
    }
    bool binary(json::binary_t&) { return false; }  // not in text
    bool start_object(size_t) { return open(JsonNode::Kind::object); }
    bool start_array(size_t) { return open(JsonNode::Kind::array); }
    bool end_object() {
        check_distinct(open_.back().keys);
        return close();
    }
    bool end_array() { return close(); }
    bool key(std::string& name) {
        open_.back().keys.push_back({std::move(name), next_token()});
        mark();
        return true;
    }
    bool parse_error(size_t bytes_read, const std::string&, const json::exception& exception) {
        const std::string& text = document_.text;
        const size_t last = std::min(bytes_read == 0 ? 0 : bytes_read - 1, text.size());
        const size_t start = std::min(next_token(), last);
        const Place place = document_.place(start);
        const std::string found = printable(std::string_view(text).substr(start, last + 1 - start));
        if (exception.id == number_overflow) {
            user_error_at(place, "found {}, which is too large for a number in double precision",
                          found);
        }
        if (last >= text.size() && (start >= text.size() || text[start] != '"')) {
            user_error_at(place, "the file ends here, expected {}", expected(start));
        }
        if (std::string_view(exception.what()).find("invalid string") != std::string_view::npos) {
            user_error_at(place,
                          "found {}, a string that has no end or holds what a JSON string may not "
                          "(line breaks, unknown escapes, bytes that are not UTF-8)",
                          found);
        }
        user_error_at(place, "found '{}', expected {}", found, expected(start));
    }

  private:
    // Nothing but these separators stands between the last event and the next token.
    size_t next_token() const {
        return std::min(document_.text.find_first_not_of(" \t\r\n,:", marked_),
                        document_.text.size());
    }
    void mark() { marked_ = static_cast<size_t>(reached_ - document_.text.data()); }

    JsonNode leaf(JsonNode::Kind kind) const {
        JsonNode node;
        node.kind = kind;
        node.offset = next_token();
        return node;
    }
    bool add(JsonNode node) {
        if (open_.empty()) {
            document_.root = std::move(node);
        } else {
            open_.back().items.push_back(std::move(node));
        }
        mark();
        return true;
    }
    bool add_number(double parsed) {
        JsonNode node = leaf(JsonNode::Kind::number);
        // From the text itself: "-0" keeps its sign, and no locale has a say.
        const std::string_view rest = std::string_view(document_.text).substr(node.offset);
        const size_t length = std::min(rest.find_first_not_of("+-.0123456789eE"), rest.size());
        node.number = parse_double(rest.substr(0, length)).value_or(parsed);
        return add(std::move(node));
    }
    bool open(JsonNode::Kind kind) {
        JsonNode node = leaf(kind);
        if (open_.size() == deepest_nesting) {
            user_error_at(document_.place(node.offset), "values nest deeper than {} levels",
                          deepest_nesting);
        }
        open_.push_back(std::move(node));
        mark();
        return true;
    }
    bool close() {
        JsonNode node = std::move(open_.back());
        open_.pop_back();
        return add(std::move(node));
    }

    void check_distinct(const std::vector<JsonKey>& keys) const {
        std::vector<const JsonKey*> sorted;
        for (const JsonKey& key : keys) sorted.push_back(&key);
        std::sort(sorted.begin(), sorted.end(), [](const JsonKey* a, const JsonKey* b) {
            return std::tie(a->name, a->offset) < std::tie(b->name, b->offset);
        });
        const auto twice = std::adjacent_find(
            sorted.begin(), sorted.end(),
            [](const JsonKey* a, const JsonKey* b) { return a->name == b->name; });
        if (twice == sorted.end()) return;
        const JsonKey& second = **std::next(twice);
        user_error_at(document_.place(second.offset),
                      "the key '{}' stands here a second time; remove one", printable(second.name));
    }

    // What the grammar wants at `start`, from the last character before it.
    std::string_view expected(size_t start) const {
        const bool in_object = !open_.empty() && open_.back().kind == JsonNode::Kind::object;
        const size_t before =
            start == 0 ? std::string::npos : document_.text.find_last_not_of(white, start - 1);
        if (before == std::string::npos) return "a JSON value";
        const bool after_key = in_object && open_.back().keys.size() > open_.back().items.size();
        switch (document_.text[before]) {
            case '{':
                return "a key in double quotes or '}'";
            case '[':
                return "a value or ']'";
            case ',':
                return in_object ? "another key in double quotes" : "another value";
            case ':':
                return "a value";
            default:
                break;
        }
        if (open_.empty()) return "the end of the file";
        if (after_key) return "':'";
        return in_object ? "',' or '}'" : "',' or ']'";
    }

    JsonDocument& document_;
    const char* reached_;
    size_t marked_ = 0;  // one past the last event, or one further after a number
    std::vector<JsonNode> open_;
};

}  // namespace

Place JsonDocument::place(size_t offset) const {
    const std::string_view before = std::string_view(text).substr(0, offset);
    const size_t line = static_cast<size_t>(std::count(before.begin(), before.end(), '\n'));
    const size_t start = before.find_last_of('\n') + 1;  // npos + 1 is 0: the first line
    return {file, static_cast<int>(line + 1), static_cast<int>(before.size() - start + 1)};
}

JsonDocument parse_json_tree(std::string text, std::string file) {
    JsonDocument document;
    document.file = std::move(file);
    document.text = std::move(text);
    TreeBuilder(document).parse();
    return document;
}

std::string JsonValue::shown() const {
    return path_.empty() ? "the record" : "'" + path_ + "'";
}

void JsonValue::expect(JsonNode::Kind kind) const {
    if (node_->kind != kind) {
        user_error_at(place(), "{} is {}, expected {}", shown(), kind_name(node_->kind),
                      kind_name(kind));
    }
}

std::string JsonValue::child_path(std::string_view key) const {
    return path_.empty() ? std::string(key) : path_ + "." + std::string(key);
}

std::string JsonValue::string() const {
    expect(JsonNode::Kind::string);
    return node_->text;
}

double JsonValue::number() const {
    expect(JsonNode::Kind::number);
    return node_->number;
}

int64_t JsonValue::whole_number(double first, double last) const {
    const double value = number();
    // Before the conversion, which is undefined outside the type's range.
    if (!(value >= first && value <= last && value == std::floor(value))) {
        user_error_at(place(), "{}: found {}, expected a whole number from {:.0f} to {:.0f}",
                      shown(), format_double(value), first, last);
    }
    return static_cast<int64_t>(value);
}

uint64_t JsonValue::quoted_whole_number() const {
    const std::optional<uint64_t> value = parse_unsigned(string());
    if (!value) {
        user_error_at(place(), "{}: found '{}', expected a whole number in quotes", shown(),
                      string());
    }
    return *value;
}

bool JsonValue::boolean() const {
    expect(JsonNode::Kind::boolean);
    return node_->number != 0;
}

std::vector<JsonValue> JsonValue::array() const {
    expect(JsonNode::Kind::array);
    std::vector<JsonValue> values;
    for (size_t i = 0; i < node_->items.size(); ++i) {
        values.push_back(
            JsonValue(*document_, node_->items[i], path_ + "[" + std::to_string(i) + "]"));
    }
    return values;
}

std::vector<double> JsonValue::numbers() const {
    std::vector<double> numbers;
    for (const JsonValue& value : array()) numbers.push_back(value.number());
    return numbers;
}

std::vector<std::string> JsonValue::strings() const {
    std::vector<std::string> strings;
    for (const JsonValue& value : array()) strings.push_back(value.string());
    return strings;
}

size_t JsonValue::member(std::string_view key) const {
    expect(JsonNode::Kind::object);
    const std::vector<JsonKey>& keys = node_->keys;
    const auto found = std::find_if(
        keys.begin(), keys.end(), [&](const JsonKey& candidate) { return candidate.name == key; });
    return static_cast<size_t>(found - keys.begin());
}

bool JsonValue::has(std::string_view key) const {
    return member(key) < node_->keys.size();
}

JsonValue JsonValue::at(std::string_view key) const {
    const size_t i = member(key);
    if (i == node_->keys.size()) {
        user_error_at(place(), "{} has no key '{}', which it must have", shown(), key);
    }
    return JsonValue(*document_, node_->items[i], child_path(key));
}

void JsonValue::allow_keys(const std::vector<std::string>& allowed) const {
    expect(JsonNode::Kind::object);
    for (const auto& [key, offset] : node_->keys) {
        if (std::find(allowed.begin(), allowed.end(), key) != allowed.end()) continue;
        user_error_at(document_->place(offset), "{} has an unknown key '{}'{}; expected one of {}",
                      shown(), printable(key), did_you_mean(key, allowed),
                      fmt::join(allowed, ", "));
    }
}

}  // namespace drude
