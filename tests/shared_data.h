// Development data that is not part of the repository: tests that want it skip where it is absent.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

namespace drude {

// The path of a file of the development data: $DRUDE_SHARED, or ../shared beside the checkout.
inline std::string shared_data(const std::string& name) {
    const char* folder = std::getenv("DRUDE_SHARED");
    const std::string root = folder ? folder : DRUDE_SOURCE_DIR "/../shared";
    return root + "/data/" + name;
}

}  // namespace drude

#define DRUDE_NEED_SHARED(path)                                \
    if (!std::filesystem::exists(path)) {                      \
        GTEST_SKIP() << "development data absent: " << (path); \
    }                                                          \
    static_assert(true)
