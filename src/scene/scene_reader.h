// The meaning of pbrt's directives: keeps the graphics state and collects the scene.
//
// parser.cpp reads the syntax and calls one function a directive; builders.h makes the pieces.
#pragma once

#include <glm/mat4x4.hpp>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "scene/graphics_state.h"

namespace drude {

class SceneReader {
  public:
    explicit SceneReader(const std::string& file);

    Assets& assets() { return assets_; }
    Messages& messages() { return messages_; }
    bool in_world() const { return in_world_; }

    // ---- transformations: the current matrix times this one
    void transform(const glm::dmat4& matrix, const Place& place);
    void replace_transform(const glm::dmat4& matrix, const Place& place);
    void name_coordinate_system(const std::string& name);
    void use_coordinate_system(const std::string& name, const Place& place);
    void active_transform(const std::string& which, const Place& place);
    void transform_times(const Place& place);
    void reverse_orientation();

    // ---- blocks
    void begin_attributes(const Place& place, const std::string& directive);
    void end_attributes(const Place& place, const std::string& directive);
    void attribute(const std::string& kind, ParameterList list);
    void begin_object(const std::string& name, const Place& place);
    void end_object(const Place& place);
    void instance(const std::string& name, const Place& place);
    void begin_world(const Place& place);
    // Depth of the open blocks; an imported file must leave it as it found it.
    size_t depth() const { return blocks_.size(); }
    void check_depth(size_t depth, const Place& place) const;

    // ---- settings, before WorldBegin
    void setting(const std::string& directive, const std::string& name, ParameterList list);
    void option(const std::string& name, const std::string& value, const Place& place);
    void colour_space(const std::string& name, const Place& place);

    // ---- the world
    void material(const std::string& name, ParameterList list);
    void make_named_material(const std::string& name, const std::string& type, ParameterList list);
    void named_material(const std::string& name, const Place& place);
    void texture(const std::string& name, bool is_spectrum, const std::string& type,
                 ParameterList list);
    void light(const std::string& name, ParameterList list);
    void area_light(const std::string& name, ParameterList list);
    void shape(const std::string& name, ParameterList list);
    void make_named_medium(const std::string& name, const std::string& type, ParameterList list);
    void medium_interface(const std::string& inside, const std::string& outside,
                          const Place& place);

    // The whole scene. `end` is where its text ends.
    Scene finish(const Place& end);

  private:
    struct Setting {
        std::string name;
        ParameterList list;
        glm::dmat4 ctm;
    };
    struct Block {
        GraphicsState state;
        std::string directive;
        Place place;
    };
    struct Instance {
        std::string object;
        glm::dmat4 ctm;
        Place place;
    };
    struct NamedMaterial {
        std::string name;
        std::optional<int> material;
        Place first_use;
    };

    void require_world(const Place& place, const std::string& directive) const;
    void add_defaults(ParameterList& list, std::string_view kind) const;
    int add_material(const std::string& name, ParameterList& list);
    int area_light_of(const ShapeGeometry& geometry, const Place& place);
    size_t name_slot(const std::string& name, const Place& place);
    int material_reference(const std::string& name, const Place& place);
    // The index of Scene::materials, or -1, that a Shape::material or a mix means.
    int resolved(int material) const;
    void resolve_mixes();
    void resolve_materials();
    void resolve_materials(std::vector<Shape>& shapes);
    void note_dark_interface(const Place& place);
    void expand_instances();
    void read_settings(const Place& place);

    Assets assets_;
    Messages messages_;
    Textures textures_;
    BuildContext context_;
    Scene scene_;
    GraphicsState state_;
    std::vector<Block> blocks_;
    bool in_world_ = false;
    std::map<std::string, Setting, std::less<>> settings_;
    std::map<std::string, glm::dmat4, std::less<>> coordinate_systems_;
    std::map<std::string, size_t, std::less<>> material_slots_;
    std::vector<NamedMaterial> named_materials_;
    std::map<int, Place> mixes_;  // by index of Scene::materials
    std::set<std::string, std::less<>> media_;
    std::map<std::string, std::vector<Shape>, std::less<>> objects_;
    std::vector<Shape>* open_object_ = nullptr;
    std::vector<Instance> instances_;
};

}  // namespace drude
