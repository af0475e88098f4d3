// Pictures that a scene names: one that is read with it, and one that is only counted.
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "check_scene.h"
#include "fuzz.h"

namespace {

// A folder of this process; it goes when the process ends in good order.
struct Folder {
    std::filesystem::path path =
        std::filesystem::temp_directory_path() / ("drude-fuzz-" + std::to_string(::getpid()));
    Folder() { std::filesystem::create_directories(path); }
    ~Folder() {
        std::error_code ignored;
        std::filesystem::remove_all(path, ignored);
    }
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    static const Folder folder;
    return drude::fuzz_one(data, size, [](const std::string& bytes) {
        std::ofstream(folder.path / "p.exr", std::ios::binary) << bytes;
        drude::check_scene(drude::parse_scene(
            "WorldBegin LightSource \"infinite\" \"string filename\" \"p.exr\" \"float "
            "illuminance\" 3 Texture \"t\" \"spectrum\" \"imagemap\" \"string filename\" \"p.exr\"",
            (folder.path / "fuzz.pbrt").string()));
    });
}
