// DRUDE_PLUGIN_PATH for the time of a test.
#pragma once

#include <cstdlib>
#include <string>

namespace drude {

class PluginPath {
  public:
    explicit PluginPath(const std::string& path = DRUDE_BINARY_DIR "/test_plugins") {
        setenv("DRUDE_PLUGIN_PATH", path.c_str(), 1);
    }
    ~PluginPath() { unsetenv("DRUDE_PLUGIN_PATH"); }
    PluginPath(const PluginPath&) = delete;
    PluginPath& operator=(const PluginPath&) = delete;
};

}  // namespace drude
