// From the parameters of a scene to the surface of a plugin.
#include "scene/plugin_surface.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <deque>

#include "scene/spectra.h"
#include "scene/vocabulary.h"

namespace drude {

// What plugins built with the installed header count on; a change is a new version.
static_assert(DRUDE_PLUGIN_VERSION == 1);
static_assert(sizeof(float) == 4 && sizeof(double) == 8 && sizeof(void*) == 8);
static_assert(sizeof(DrudeParameter) == 32 && offsetof(DrudeParameter, numbers) == 8 &&
              offsetof(DrudeParameter, strings) == 16 && offsetof(DrudeParameter, count) == 24);
static_assert(sizeof(DrudeDirections) == 52 && offsetof(DrudeDirections, in) == 12 &&
              offsetof(DrudeDirections, x_out) == 24 && offsetof(DrudeDirections, x_in) == 36 &&
              offsetof(DrudeDirections, handedness) == 48);
static_assert(sizeof(DrudeSurfacePlugin) == 72 && offsetof(DrudeSurfacePlugin, size) == 4 &&
              offsetof(DrudeSurfacePlugin, instruction_set) == 8 &&
              offsetof(DrudeSurfacePlugin, description) == 16 &&
              offsetof(DrudeSurfacePlugin, parameters) == 24 &&
              offsetof(DrudeSurfacePlugin, create) == 32 &&
              offsetof(DrudeSurfacePlugin, destroy) == 40 &&
              offsetof(DrudeSurfacePlugin, evaluate) == 48 &&
              offsetof(DrudeSurfacePlugin, sample) == 56 &&
              offsetof(DrudeSurfacePlugin, pdf) == 64);

namespace {

struct Declaration {
    std::string type, name;
    bool is_list = false;
};

constexpr size_t most_parameters = 1000;

std::vector<Declaration> declarations(const DrudeSurfacePlugin& plugin, const std::string& path,
                                      const Place& place) {
    static const std::vector<std::string> types = {"float",    "integer", "bool", "rgb",
                                                   "spectrum", "string",  "file"};
    std::vector<Declaration> result;
    for (const char* const* text = plugin.parameters; *text != nullptr; ++text) {
        if (result.size() == most_parameters) {
            user_error_at(place,
                          "{}: declares more than {} parameters; expected fewer, and a null at "
                          "their end",
                          path, most_parameters);
        }
        const std::string declaration(*text);
        const size_t blank = declaration.find(' ');
        if (blank == std::string::npos || blank + 1 == declaration.size() ||
            declaration.find_first_of(" \t\n", blank + 1) != std::string::npos) {
            user_error_at(place, "{}: declares \"{}\"; expected \"TYPE NAME\"", path,
                          shown(declaration));
        }
        Declaration d{declaration.substr(0, blank), declaration.substr(blank + 1), false};
        if (std::find(types.begin(), types.end(), d.type) == types.end()) {
            user_error_at(place, "{}: declares \"{}\" of unknown type{}; expected one of: {}", path,
                          shown(declaration), did_you_mean(d.type, types), fmt::join(types, ", "));
        }
        if (d.name.size() > 2 && d.name.substr(d.name.size() - 2) == "[]") {
            d.name.resize(d.name.size() - 2);
            d.is_list = true;
        }
        if (d.is_list && d.type == "spectrum") {
            user_error_at(place, "{}: declares \"{}\"; expected one spectrum, not a list", path,
                          shown(declaration));
        }
        for (const Declaration& other : result) {
            if (other.name == d.name) {
                user_error_at(place, "{}: declares '{}' twice; expected it once", path,
                              shown(d.name));
            }
        }
        result.push_back(std::move(d));
    }
    return result;
}

// What a scene gives for the declared parameters, as the plugin takes it.
class Arguments {
  public:
    void read(const Declaration& d, const std::string& path, ParameterList& list,
              BuildContext& context) {
        const Parameter* given = list.any_of(d.name, {scene_type(d.type)});
        if (given == nullptr) return;
        Values& values = values_.emplace_back();
        values.name = d.name;
        if (d.type == "spectrum") {
            const DenseSpectrum dense = matter_spectrum(*given, context);
            values.numbers.assign(dense.begin(), dense.end());
            return;
        }
        values.numbers = d.type == "rgb" ? matter_rgb_values(*given, context) : given->numbers;
        for (const bool value : given->booleans) values.numbers.push_back(value);
        values.strings = given->strings;
        for (size_t i = 0; i < values.strings.size(); ++i) {
            // The plugin would take it for the end.
            if (values.strings[i].find('\0') == std::string::npos) continue;
            user_error_at(given->place_of(i), "{}: {} is \"{}\"; expected text without bytes of 0",
                          list.owner(), d.name, shown(values.strings[i]));
        }
        const size_t count = std::max(values.numbers.size(), values.strings.size());
        const size_t one = d.type == "rgb" ? 3 : 1;
        if (!d.is_list && count != one) {
            user_error_at(given->place_of(one), "{}: \"{} {}\" has {} values; expected {}",
                          list.owner(), type_name(given->type), d.name, count, one);
        }
        if (d.type != "file") return;
        for (size_t i = 0; i < values.strings.size(); ++i) {
            const Place place = given->place_of(i);
            const std::string what = fmt::format("file of the plugin {}", path);
            values.strings[i] =
                context.assets.find(values.strings[i], given->place.file, place, what);
            context.assets.count(values.strings[i], place);
        }
    }

    // Points into this object.
    std::vector<DrudeParameter> list() {
        std::vector<DrudeParameter> result;
        for (Values& values : values_) {
            values.pointers.clear();
            for (const std::string& text : values.strings) values.pointers.push_back(text.c_str());
            const size_t count = std::max(values.numbers.size(), values.strings.size());
            result.push_back({values.name.c_str(),
                              values.numbers.empty() ? nullptr : values.numbers.data(),
                              values.pointers.empty() ? nullptr : values.pointers.data(),
                              static_cast<int32_t>(count), 0});
        }
        return result;
    }

  private:
    struct Values {
        std::string name;
        std::vector<double> numbers;
        std::vector<std::string> strings;
        std::vector<const char*> pointers;
    };

    static ParameterType scene_type(const std::string& type) {
        if (type == "float") return ParameterType::number;
        if (type == "integer") return ParameterType::integer;
        if (type == "bool") return ParameterType::boolean;
        if (type == "rgb") return ParameterType::rgb;
        if (type == "spectrum") return ParameterType::spectrum;
        return ParameterType::string;
    }

    std::deque<Values> values_;
};

}  // namespace

PluginSurface::PluginSurface(const DrudeSurfacePlugin& plugin, const std::string& path,
                             const std::vector<DrudeParameter>& parameters, const Place& place)
    : plugin_(plugin) {
    std::array<char, 1024> message{};
    std::string reason;
    try {
        surface_ = plugin.create(parameters.data(), static_cast<int32_t>(parameters.size()),
                                 message.data(), static_cast<int32_t>(message.size()));
        message.back() = 0;
        reason = message.data();
    } catch (const std::exception& error) {
        surface_ = nullptr;
        reason = error.what();
    } catch (...) {
        surface_ = nullptr;
    }
    if (surface_ == nullptr) {
        user_error_at(place, "{}: {}", path,
                      reason.empty() ? "makes no surface of these parameters, and gave no reason"
                                     : shown(reason, message.size()));
    }
}

PluginMaterial build_plugin_material(const std::string& name, const std::string& path,
                                     ParameterList& list, BuildContext& context) {
    const DrudeSurfacePlugin& plugin = load_plugin(path, list.place());
    context.assets.count(path, list.place());
    Arguments arguments;
    for (const Declaration& declaration : declarations(plugin, path, list.place())) {
        arguments.read(declaration, path, list, context);
    }
    list.finish(known_parameters("Material", name), context.messages);
    return {name,
            std::make_shared<const PluginSurface>(plugin, path, arguments.list(), list.place())};
}

}  // namespace drude
