// Files, arguments, and the loop over directives. The directives themselves: directives.cpp.
#include "scene/parser.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <optional>

#include "base/files.h"
#include "base/numbers.h"
#include "scene/old_versions.h"
#include "scene/plugin_surface.h"
#include "scene/transforms.h"
#include "scene/vocabulary.h"

namespace drude {

namespace {

namespace fs = std::filesystem;

// Files within files; what is deeper, or more, is a loop that no cycle check sees.
constexpr size_t deepest = 64, most_files = 100'000;
constexpr uint64_t most_bytes = uint64_t{1} << 32;

}  // namespace

Parser::Parser(const std::string& text, const std::string& file) : reader_(file) {
    open(text, file, false);
}

void Parser::open(const std::string& text, const std::string& path, bool is_import) {
    std::error_code error;
    fs::path identity = fs::weakly_canonical(path, error);
    if (error) identity = path;
    bytes_ += text.size();
    reader_.assets().count_text(text);
    files_.push_back({Lexer(std::make_shared<const Source>(Source{path, text})), identity.string(),
                      is_import, reader_.depth()});
    ++opened_;
}

void Parser::close(const Place& end) {
    if (files_.back().is_import) {
        // An import leaves no trace in the graphics state.
        reader_.check_depth(files_.back().depth, end);
        reader_.end_attributes(end, "ImportEnd");
    }
    files_.pop_back();
}

Scene Parser::run() {
    for (;;) {
        const Token token = lexer().take();
        const Place place = lexer().place(token);
        if (token.kind == Token::Kind::end) {
            if (files_.size() == 1) return reader_.finish(place);
            close(place);
            continue;
        }
        if (token.kind != Token::Kind::word) {
            user_error_at(place, "found {}; expected a directive",
                          token.kind == Token::Kind::string
                              ? fmt::format("the string \"{}\"", shown(token.text))
                              : fmt::format("'{}'", shown(token.text)));
        }
        const auto handler = handlers().find(std::string(token.text));
        if (handler == handlers().end()) unknown_directive(token);
        (this->*handler->second)(handler->first, place);
    }
}

void Parser::unknown_directive(const Token& token) {
    const Place place = lexer().place(token);
    if (is_old_directive(token.text)) old_version_error(lexer(), place, token.text);
    std::vector<std::string> names;
    for (const auto& entry : handlers()) names.push_back(entry.first);
    std::sort(names.begin(), names.end());
    if (parse_double(token.text)) {
        user_error_at(place,
                      "found the number {}; expected a directive (several values of a "
                      "parameter stand in brackets)",
                      shown(token.text));
    }
    user_error_at(place, "unknown directive '{}'{}; expected one of pbrt-v4's: {}",
                  shown(token.text), did_you_mean(token.text, names), fmt::join(names, ", "));
}

void Parser::include(const std::string& directive, const Place& place) {
    const bool is_import = directive == "Import";
    const Place name_place = lexer().place(lexer().peek());
    const std::string name = string_argument(directive, "the name of a file");
    if (is_import && !reader_.in_world()) {
        user_error_at(place,
                      "Import before WorldBegin; expected it in the world (Include may "
                      "stand anywhere)");
    }
    const std::string path = reader_.assets().find(name, name_place.file, name_place, "scene file");
    std::error_code error;
    const std::string identity = fs::weakly_canonical(path, error).string();
    for (const OpenFile& file : files_) {
        if (file.identity == identity) {
            user_error_at(name_place, "{} includes itself; expected files that do not", path);
        }
    }
    if (files_.size() >= deepest || opened_ >= most_files || bytes_ > most_bytes) {
        user_error_at(name_place,
                      "too much is included: {} files, {} deep, {} bytes; expected at "
                      "most {}, {} and {}",
                      opened_, files_.size(), bytes_, most_files, deepest, most_bytes);
    }
    std::string text;
    try {
        text = read_file(path);
    } catch (const Error& failure) {
        throw Error(failure.cause(), name_place, failure.message());
    }
    if (is_import) reader_.begin_attributes(place, "ImportBegin");
    open(text, path, is_import);
}

std::string Parser::string_argument(const std::string& directive, std::string_view what) {
    const Token token = lexer().take();
    if (token.kind != Token::Kind::string) {
        user_error_at(lexer().place(token), "{}: found {}; expected {} in quotes", directive,
                      token.kind == Token::Kind::end ? "the end of the file"
                                                     : fmt::format("'{}'", shown(token.text)),
                      what);
    }
    return string_value(token);
}

double Parser::number_argument(const std::string& directive) {
    const Token token = lexer().take();
    const std::optional<double> number =
        token.kind == Token::Kind::word ? parse_double(token.text) : std::nullopt;
    if (!number || !std::isfinite(*number)) {
        user_error_at(lexer().place(token), "{}: found {}; expected a finite number", directive,
                      token.kind == Token::Kind::end ? "the end of the file"
                                                     : fmt::format("'{}'", shown(token.text)));
    }
    return *number;
}

glm::dvec3 Parser::vector_argument(const std::string& directive) {
    glm::dvec3 vector;
    for (int i = 0; i < 3; ++i) vector[i] = number_argument(directive);
    return vector;
}

glm::dmat4 Parser::matrix_argument(const std::string& directive, const Place& place) {
    const auto bracket = [&](Token::Kind kind, std::string_view which) {
        const Token token = lexer().take();
        if (token.kind != kind) {
            user_error_at(lexer().place(token), "{}: found '{}'; expected '{}' around 16 numbers",
                          directive, shown(token.text), which);
        }
    };
    bracket(Token::Kind::open, "[");
    std::array<double, 16> values{};
    for (double& value : values) value = number_argument(directive);
    bracket(Token::Kind::close, "]");
    return matrix_of(values, place);
}

void Parser::check_name(const std::string& kind, const std::string& name, const Place& place) {
    const std::string plugin = kind == "Material" ? find_plugin(name) : "";
    if (is_known_name(kind, name) || (kind == "Material" && name.empty())) {
        if (!plugin.empty()) {
            reader_.messages().note(place, fmt::format("Material \"{}\" is the built-in one; {} is "
                                                       "never used under this name",
                                                       name, plugin));
        }
        return;
    }
    if (!plugin.empty()) return;
    if (is_old_name(kind, name)) {
        old_version_error(lexer(), place, fmt::format("{} \"{}\"", kind, name));
    }
    const std::vector<std::string> names = known_names(kind);
    std::vector<std::string> candidates = names;
    std::string searched;
    if (kind == "Material") {
        for (const std::string& other : plugin_names()) candidates.push_back(other);
        const std::vector<std::string> folders = plugin_folders();
        if (!folders.empty()) {
            searched = fmt::format(
                "; or a plugin: there is neither {0}.so nor lib{0}.so in {1} "
                "(DRUDE_PLUGIN_PATH)",
                shown(name), fmt::join(folders, ", "));
        } else {
            searched = fmt::format(
                "; or a plugin, {}.so in a folder of DRUDE_PLUGIN_PATH, which is not set",
                shown(name));
        }
    }
    user_error_at(place, "{} \"{}\" is not known{}; expected one of: {}{}", kind, shown(name),
                  did_you_mean(name, candidates), fmt::join(names, ", "), searched);
}

ParameterList Parser::parameters(const std::string& owner, const Place& place) {
    return ParameterList(owner, place, read_parameters(lexer(), reader_.colour_space()));
}

Scene parse_scene(const std::string& text, const std::string& file) {
    return Parser(text, file).run();
}

Scene read_scene(const std::string& path) {
    return parse_scene(read_file(path), path);
}

}  // namespace drude
