// Pictures to compare, and the comparison as the tests call it.
#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <vector>

#include "base/expect_error.h"
#include "image/compare.h"

namespace drude {

inline Image picture(int width, int height, const std::vector<std::string>& names, float value) {
    Image image;
    image.width = width;
    image.height = height;
    for (const std::string& name : names) {
        std::vector<float>& data = image.add(name).data;
        data.assign(data.size(), value);
    }
    return image;
}

inline Comparison compare(const Image& a, const Image& b, const CompareOptions& options = {}) {
    return compare_images(a, b, "a.exr", "b.exr", options);
}

}  // namespace drude
