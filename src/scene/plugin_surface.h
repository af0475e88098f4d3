// Materials from shared objects: finding, checking and loading them. The interface itself, with
// what authors have to know: render/plugin.h.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "render/plugin.h"
#include "scene/builders.h"

namespace drude {

// The folders of DRUDE_PLUGIN_PATH, in its order; empty ones are passed over.
std::vector<std::string> plugin_folders();

// The shared object of the material `name`: the first of FOLDER/NAME.so and FOLDER/libNAME.so over
// the folders. "" where there is none, or where the name holds anything but letters, digits, '.',
// '_' and '-'.
std::string find_plugin(const std::string& name);

// The names of all materials in the folders.
std::vector<std::string> plugin_names();

// Loads the shared object, which stays loaded, and checks what it says of itself. Error (user) at
// `place` where it is not whole or not a shared object, lacks the function of plugin.h, is of
// another version or size, needs instructions that this processor lacks, or has a null where
// something is needed.
const DrudeSurfacePlugin& load_plugin(const std::string& path, const Place& place);

// A surface that a plugin has made. Members may be called from many threads at once.
class PluginSurface {
  public:
    // Error (user) at `place` where the plugin says no, with its reason.
    PluginSurface(const DrudeSurfacePlugin& plugin, const std::string& path,
                  const std::vector<DrudeParameter>& parameters, const Place& place);
    ~PluginSurface() { plugin_.destroy(surface_); }
    PluginSurface(const PluginSurface&) = delete;
    PluginSurface& operator=(const PluginSurface&) = delete;

    // As in plugin.h.
    void evaluate(const DrudeDirections& directions, const float* wavelengths_nm, int count,
                  float* mueller) const {
        plugin_.evaluate(surface_, &directions, wavelengths_nm, count, mueller);
    }
    bool sample(const float out[3], const float u[3], float in[3], float* pdf) const {
        return plugin_.sample(surface_, out, u, in, pdf) != 0;
    }
    float pdf(const float out[3], const float in[3]) const {
        return plugin_.pdf(surface_, out, in);
    }

  private:
    const DrudeSurfacePlugin& plugin_;
    void* surface_;
};

// The material of a scene: reads what the plugin declares from `list`, counts the shared object and
// the files it names into the scene's hash. Error (user) for what load_plugin refuses, for
// declarations that are none or are there twice, and for parameters it does not declare.
PluginMaterial build_plugin_material(const std::string& name, const std::string& path,
                                     ParameterList& list, BuildContext& context);

}  // namespace drude
