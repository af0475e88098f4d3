#include "scene/assets.h"

#include <filesystem>

#include "base/files.h"
#include "base/sha256.h"
#include "scene/lexer.h"

namespace drude {

namespace fs = std::filesystem;

namespace {

// A path for an error message, whole: its end is what tells files apart.
std::string whole(const fs::path& path) {
    return shown(path.lexically_normal().string(), 4096);
}

// A file name may hold any bytes but NUL; the functions of the system would cut it there.
void check_name(const std::string& name, const Place& place, std::string_view what) {
    if (name.empty()) user_error_at(place, "the name of the {} is empty; expected a file", what);
    if (name.find('\0') != std::string::npos || name.size() > 4000) {
        user_error_at(place, "'{}' cannot be the name of a file", shown(name));
    }
}

}  // namespace

Assets::Assets(const std::string& scene_file)
    : folder_(fs::path(scene_file).parent_path().string()) {}

std::string Assets::find(const std::string& name, const std::string& naming_file,
                         const Place& place, std::string_view what) const {
    check_name(name, place, what);
    const fs::path beside_scene = fs::path(folder_) / name;
    const fs::path beside_naming = fs::path(naming_file).parent_path() / name;
    for (const fs::path& path : {beside_scene, beside_naming}) {
        std::error_code error;
        const fs::file_status status = fs::status(path, error);
        if (error || !fs::exists(status)) continue;
        if (!fs::is_regular_file(status)) {
            user_error_at(place, "{}: is not a regular file; expected the {}", whole(path), what);
        }
        return path.lexically_normal().string();
    }
    if (beside_scene.lexically_normal() == beside_naming.lexically_normal()) {
        user_error_at(place, "{} not found: there is no file {}", what, whole(beside_scene));
    }
    user_error_at(place, "{} not found: there is neither {} nor {}", what, whole(beside_scene),
                  whole(beside_naming));
}

std::string Assets::read(const std::string& path, const Place& place) {
    try {
        std::string bytes = read_file(path);
        count_text(bytes);
        return bytes;
    } catch (const Error& error) {
        throw Error(error.cause(), place, error.message());
    }
}

void Assets::count(const std::string& path, const Place& place) {
    const auto found = counted_.find(path);
    if (found != counted_.end()) {
        digests_ += found->second + "\n";
        return;
    }
    try {
        const std::string digest = sha256(read_file(path));
        counted_.emplace(path, digest);
        digests_ += digest + "\n";
    } catch (const Error& error) {
        throw Error(error.cause(), place, error.message());
    }
}

void Assets::count_text(std::string_view bytes) {
    digests_ += sha256(bytes) + "\n";
}

std::string Assets::digest() const {
    return sha256(digests_);
}

}  // namespace drude
