// The files a scene refers to: found, read, and counted into the scene's hash.
#pragma once

#include <map>
#include <string>
#include <string_view>

#include "base/error.h"

namespace drude {

class Assets {
  public:
    explicit Assets(const std::string& scene_file);

    // The path of a file that `naming_file` names. pbrt looks beside the scene file, wherever the
    // name stands; people expect beside the file they write in: the first that exists is taken.
    // Error (user) at `place` where there is neither, or where it is no regular file.
    std::string find(const std::string& name, const std::string& naming_file, const Place& place,
                     std::string_view what) const;

    // The file's bytes, unpacked where it is gzip, counted into the hash.
    std::string read(const std::string& path, const Place& place);
    // Counts the file into the hash where its bytes are wanted later and by somebody else.
    void count(const std::string& path, const Place& place);
    // Counts text that is already in memory.
    void count_text(std::string_view bytes);

    // SHA-256 over the SHA-256 digests (hexadecimal, one a line) of everything counted, in order:
    // moving the boundary between two files therefore changes it, renaming a file does not.
    std::string digest() const;

  private:
    std::string folder_;
    std::string digests_;
    std::map<std::string, std::string> counted_;  // path -> digest
};

}  // namespace drude
