// The grammar of pbrt-v4: reads directives and their arguments, keeps the stack of included files,
// and calls SceneReader.
#pragma once

#include <cstdint>
#include <string>
#include <unordered_map>
#include <vector>

#include "scene/scene_reader.h"

namespace drude {

class Parser {
  public:
    Parser(const std::string& text, const std::string& file);
    Scene run();

  private:
    using Handler = void (Parser::*)(const std::string& directive, const Place& place);
    static const std::unordered_map<std::string, Handler>& handlers();

    struct OpenFile {
        Lexer lexer;
        std::string identity;  // the same for one file under several names
        bool is_import;
        size_t depth;  // of blocks where the import began
    };

    Lexer& lexer() { return files_.back().lexer; }
    void open(const std::string& text, const std::string& path, bool is_import);
    void close(const Place& end);
    [[noreturn]] void unknown_directive(const Token& token);

    std::string string_argument(const std::string& directive, std::string_view what);
    double number_argument(const std::string& directive);
    glm::dvec3 vector_argument(const std::string& directive);
    glm::dmat4 matrix_argument(const std::string& directive, const Place& place);
    void check_name(const std::string& kind, const std::string& name, const Place& place);
    ParameterList parameters(const std::string& owner, const Place& place);
    std::string type_of(ParameterList& list, const std::string& kind);

    void simple(const std::string& directive, const Place& place);
    void transformation(const std::string& directive, const Place& place);
    void coordinate_system(const std::string& directive, const Place& place);
    void time(const std::string& directive, const Place& place);
    void block(const std::string& directive, const Place& place);
    void object(const std::string& directive, const Place& place);
    void attribute(const std::string& directive, const Place& place);
    void named_thing(const std::string& directive, const Place& place);
    void option(const std::string& directive, const Place& place);
    void colour_space(const std::string& directive, const Place& place);
    void make_named(const std::string& directive, const Place& place);
    void named_material(const std::string& directive, const Place& place);
    void medium_interface(const std::string& directive, const Place& place);
    void texture(const std::string& directive, const Place& place);
    void include(const std::string& directive, const Place& place);

    SceneReader reader_;
    std::vector<OpenFile> files_;
    size_t opened_ = 0;
    uint64_t bytes_ = 0;
};

}  // namespace drude
