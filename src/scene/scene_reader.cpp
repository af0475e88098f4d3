// Transformations, blocks, settings and the end of a scene.
#include "scene/scene_reader.h"

#include <glm/matrix.hpp>

#include "base/numbers.h"
#include "scene/crop.h"
#include "scene/transforms.h"
#include "scene/vocabulary.h"

namespace drude {

SceneReader::SceneReader(const std::string& file)
    : assets_(file),
      context_{assets_, messages_, textures_, [this](const std::string& name, const Place& place) {
                   return material_reference(name, place);
               }} {
    scene_.file = file;
    // Index 0 is pbrt's default material.
    scene_.materials.emplace_back(DiffuseMaterial{{constant_spectrum(0.5)}});
}

void SceneReader::transform(const glm::dmat4& matrix, const Place& place) {
    replace_transform(state_.ctm * matrix, place);
}

void SceneReader::replace_transform(const glm::dmat4& matrix, const Place& place) {
    if (!state_.start_time_active) return;
    check_matrix(matrix, place);
    state_.ctm = matrix;
}

void SceneReader::name_coordinate_system(const std::string& name) {
    coordinate_systems_[name] = state_.ctm;
}

void SceneReader::use_coordinate_system(const std::string& name, const Place& place) {
    const auto found = coordinate_systems_.find(name);
    if (found == coordinate_systems_.end()) {
        std::vector<std::string> names;
        for (const auto& entry : coordinate_systems_) names.push_back(entry.first);
        user_error_at(place,
                      "there is no coordinate system '{}'{}; expected one that was named "
                      "before, or 'camera' behind Camera",
                      shown(name), did_you_mean(name, names));
    }
    replace_transform(found->second, place);
}

void SceneReader::active_transform(const std::string& which, const Place& place) {
    messages_.stand_in(place,
                       "ActiveTransform: motion is not modelled; everything stands where it is at "
                       "the start");
    state_.start_time_active = which != "EndTime";
}

void SceneReader::transform_times(const Place& place) {
    messages_.stand_in(place,
                       "TransformTimes: motion is not modelled; everything stands where it is at "
                       "the start");
}

void SceneReader::reverse_orientation() {
    state_.reverse_orientation = !state_.reverse_orientation;
}

void SceneReader::begin_attributes(const Place& place, const std::string& directive) {
    blocks_.push_back({state_, directive, place});
}

void SceneReader::end_attributes(const Place& place, const std::string& directive) {
    const std::string begin = directive.substr(0, directive.size() - 3) + "Begin";
    if (blocks_.empty()) {
        user_error_at(place, "{} without {}; expected one {} each", directive, begin, directive);
    }
    const Block& block = blocks_.back();
    if (block.directive != begin) {
        user_error_at(place, "{} closes the {} of line {}; expected {} first", directive,
                      block.directive, block.place.line,
                      block.directive.substr(0, block.directive.size() - 5) + "End");
    }
    state_ = std::move(blocks_.back().state);
    blocks_.pop_back();
}

void SceneReader::attribute(const std::string& kind, ParameterList list) {
    static const std::map<std::string, std::vector<std::string>, std::less<>> directives = {
        {"shape", {"Shape"}},       {"light", {"LightSource", "AreaLightSource"}},
        {"material", {"Material"}}, {"medium", {"MakeNamedMedium"}},
        {"texture", {"Texture"}},
    };
    const auto found = directives.find(kind);
    if (found == directives.end()) {
        std::vector<std::string> names;
        for (const auto& entry : directives) names.push_back(entry.first);
        user_error_at(list.place(), "Attribute \"{}\"{}; expected one of: {}", shown(kind),
                      did_you_mean(kind, names), fmt::join(names, ", "));
    }
    std::vector<std::string> known;
    for (const std::string& directive : found->second) {
        for (std::string& name : known_parameters(directive, "")) known.push_back(std::move(name));
    }
    if (kind == "material") known.insert(known.end(), {"material", "lobe", "beta", "masking"});
    list.ignore(known);
    auto defaults = std::make_shared<std::vector<Parameter>>(list.all());
    for (Parameter& parameter : *defaults) parameter.used = false;
    // What was set before stays, unless it is set again.
    if (const auto before = state_.defaults.find(kind); before != state_.defaults.end()) {
        for (const Parameter& parameter : *before->second) {
            if (!list.has(parameter.name)) defaults->push_back(parameter);
        }
    }
    state_.defaults[kind] = std::move(defaults);
}

void SceneReader::begin_object(const std::string& name, const Place& place) {
    require_world(place, "ObjectBegin");
    if (open_object_ != nullptr) {
        user_error_at(place, "ObjectBegin inside an object; expected ObjectEnd first");
    }
    const auto [entry, added] = objects_.try_emplace(name);
    if (!added) {
        user_error_at(place, "the object '{}' is defined twice; expected another name",
                      shown(name));
    }
    begin_attributes(place, "ObjectBegin");
    open_object_ = &entry->second;
}

void SceneReader::end_object(const Place& place) {
    end_attributes(place, "ObjectEnd");
    open_object_ = nullptr;
}

void SceneReader::instance(const std::string& name, const Place& place) {
    require_world(place, "ObjectInstance");
    if (open_object_ != nullptr) {
        user_error_at(place, "ObjectInstance inside an object; expected ObjectEnd first");
    }
    instances_.push_back({name, state_.ctm, place});
}

void SceneReader::check_depth(size_t depth, const Place& place) const {
    if (blocks_.size() > depth) {
        const Block& block = blocks_.back();
        user_error_at(block.place, "{} is not closed; expected {} before the end of the file",
                      block.directive,
                      block.directive.substr(0, block.directive.size() - 5) + "End");
    }
    if (blocks_.size() < depth) {
        user_error_at(place,
                      "this file closes blocks that it did not open; expected an imported "
                      "file to stand by itself");
    }
}

void SceneReader::require_world(const Place& place, const std::string& directive) const {
    if (!in_world_) {
        user_error_at(place, "{} before WorldBegin; expected it in the world", directive);
    }
}

void SceneReader::add_defaults(ParameterList& list, std::string_view kind) const {
    const auto found = state_.defaults.find(kind);
    if (found != state_.defaults.end()) list.add_defaults(*found->second);
}

void SceneReader::setting(const std::string& directive, const std::string& name,
                          ParameterList list) {
    if (in_world_) {
        user_error_at(list.place(), "{} behind WorldBegin; expected it before", directive);
    }
    if (directive == "Camera") {
        // pbrt's "camera" is world-from-camera.
        check_matrix(state_.ctm, list.place());
        coordinate_systems_["camera"] = glm::inverse(state_.ctm);
    }
    const auto found = settings_.find(directive);
    if (found != settings_.end()) {
        messages_.note(list.place(), fmt::format("this {} replaces that of line {}", directive,
                                                 found->second.list.place().line));
        settings_.erase(found);
    }
    settings_.emplace(directive, Setting{name, std::move(list), state_.ctm});
}

void SceneReader::option(const std::string& name, const std::string& value, const Place& place) {
    if (!is_known_name("Option", name)) {
        const std::vector<std::string> names = known_names("Option");
        user_error_at(place, "unknown Option '{}'{}; expected one of: {}", shown(name),
                      did_you_mean(name, names), fmt::join(names, ", "));
    }
    if (name == "seed") {
        const std::optional<long long> seed = parse_integer(value);
        if (!seed || *seed < 0) {
            user_error_at(place, "Option \"seed\" is '{}'; expected an integer of 0 or more",
                          shown(value));
        }
        scene_.seed = static_cast<uint64_t>(*seed);
    } else if (value != "false") {
        messages_.stand_in(place, fmt::format("Option \"{}\" is known to pbrt-v4 and has no effect "
                                              "in this renderer",
                                              name));
    }
}

void SceneReader::colour_space(const std::string& name, const Place& place) {
    if (!is_known_name("ColorSpace", name)) {
        const std::vector<std::string> names = known_names("ColorSpace");
        user_error_at(place, "unknown ColorSpace '{}'{}; expected one of: {}", shown(name),
                      did_you_mean(name, names), fmt::join(names, ", "));
    }
    if (name != "srgb") {
        messages_.stand_in(place, fmt::format("ColorSpace \"{}\" is not modelled; rgb values are "
                                              "taken as sRGB",
                                              name));
    }
}

void SceneReader::read_settings(const Place& place) {
    const auto find = [&](std::string_view directive) -> Setting* {
        const auto found = settings_.find(directive);
        return found == settings_.end() ? nullptr : &found->second;
    };
    const Film& film = scene_.film;
    FilmRecipe recipe{film, {0, film.width, 0, film.height}};
    if (Setting* setting = find("Film")) {
        recipe = build_film(setting->name, setting->list, messages_);
        scene_.film = recipe.film;
    }
    Setting plain{"perspective", ParameterList("Camera \"perspective\"", place, {}), glm::dmat4(1)};
    Setting* camera = find("Camera");
    if (camera == nullptr) camera = &plain;
    scene_.camera = build_camera(camera->name, camera->list, camera->ctm, film, messages_);
    const int* bounds = recipe.bounds;
    crop_picture(bounds[0], bounds[1], bounds[2], bounds[3], &scene_.film, &scene_.camera);
    if (Setting* filter = find("PixelFilter")) {
        scene_.filter = build_filter(filter->name, filter->list, messages_);
    }
    if (Setting* integrator = find("Integrator")) {
        build_integrator(integrator->name, integrator->list, messages_, scene_);
    }
    if (Setting* sampler = find("Sampler")) {
        build_sampler(sampler->name, sampler->list, messages_, scene_);
    }
    if (Setting* accelerator = find("Accelerator")) {
        // Embree has its own; the picture does not depend on it.
        accelerator->list.ignore(known_parameters("Accelerator", accelerator->name));
    }
}

void SceneReader::begin_world(const Place& place) {
    if (in_world_) user_error_at(place, "WorldBegin twice; expected it once");
    read_settings(place);
    in_world_ = true;
    state_.ctm = glm::dmat4(1);
    state_.start_time_active = true;
    coordinate_systems_["world"] = glm::dmat4(1);
}

Scene SceneReader::finish(const Place& end) {
    check_depth(0, end);
    if (!in_world_) {
        user_error_at(end,
                      "the scene ends without WorldBegin; expected it between the settings "
                      "and the world");
    }
    resolve_materials();
    expand_instances();
    scene_.number_textures = std::move(textures_.number_textures);
    scene_.spectrum_textures = std::move(textures_.spectrum_textures);
    messages_.write_to(scene_);
    scene_.sha256 = assets_.digest();
    return std::move(scene_);
}

}  // namespace drude
