// Scenes from text for tests.
#pragma once

#include <gtest/gtest.h>
#include <zlib.h>

#include <fstream>
#include <string>

#include "scene/scene.h"
#include "scene/spectra.h"

namespace drude {

inline Scene scene_of(const std::string& text) {
    return parse_scene(text, "t.pbrt");
}
// `world` behind a WorldBegin in line 1, so that places in it are easy to count: line 1 is
// "WorldBegin", the world starts in line 2, column 1.
inline Scene world_of(const std::string& world) {
    return scene_of("WorldBegin\n" + world);
}

// The message of the Error that `text` gives; fails the test where there is none.
inline std::string error_of(const std::string& text) {
    try {
        scene_of(text);
    } catch (const Error& error) {
        EXPECT_EQ(static_cast<int>(error.cause()), static_cast<int>(Cause::user));
        return error.message();
    }
    ADD_FAILURE() << "nothing was thrown for: " << text;
    return {};
}
inline std::string world_error_of(const std::string& world) {
    return error_of("WorldBegin\n" + world);
}

inline bool contains(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

// Whether one of the warnings holds the text.
inline bool warns(const Scene& scene, const std::string& part) {
    for (const std::string& warning : scene.warnings) {
        if (contains(warning, part)) return true;
    }
    return false;
}

inline double luminance(const DenseSpectrum& spectrum) {
    return spectrum_to_xyz(spectrum)[1];
}

inline void write(const std::string& path, const std::string& text) {
    std::ofstream(path, std::ios::binary) << text;
}

inline void write_gz(const std::string& path, const std::string& text) {
    gzFile file = gzopen(path.c_str(), "wb");
    gzwrite(file, text.data(), static_cast<unsigned>(text.size()));
    gzclose(file);
}

}  // namespace drude

// The message has this place at its start and this text in it.
#define EXPECT_PLACE_AND_TEXT(message, place, part)                                            \
    do {                                                                                       \
        const std::string message_ = (message);                                                \
        EXPECT_EQ(message_.substr(0, std::string(place ": ").size()), place ": ") << message_; \
        EXPECT_TRUE(drude::contains(message_, part)) << message_;                              \
    } while (false)
