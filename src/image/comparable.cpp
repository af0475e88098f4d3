#include "image/comparable.h"

#include <fmt/ranges.h>

#include <algorithm>

#include "base/error.h"
#include "base/numbers.h"
#include "image/stokes_layer.h"

namespace drude {

std::vector<std::string> sorted_names(const Image& image) {
    std::vector<std::string> names;
    for (const Channel& channel : image.channels) names.push_back(channel.name);
    std::sort(names.begin(), names.end());
    return names;
}

void check_size(const Image& a, const Image& b, const std::string& name_a,
                const std::string& name_b) {
    if (a.width == b.width && a.height == b.height) return;
    user_error("{} is {} x {} pixels, {} is {} x {}; expected pictures of one size", name_a,
               a.width, a.height, name_b, b.width, b.height);
}

void check_same_names(const Image& a, const Image& b, const std::string& name_a,
                      const std::string& name_b) {
    const std::vector<std::string> in_a = sorted_names(a), in_b = sorted_names(b);
    if (in_a == in_b) return;
    std::vector<std::string> only_a, only_b;
    std::set_difference(in_a.begin(), in_a.end(), in_b.begin(), in_b.end(),
                        std::back_inserter(only_a));
    std::set_difference(in_b.begin(), in_b.end(), in_a.begin(), in_a.end(),
                        std::back_inserter(only_b));
    const auto list = [](std::vector<std::string> names) {
        if (names.empty()) return std::string("none");
        constexpr size_t enough = 6;
        const size_t more = names.size() > enough ? names.size() - enough : 0;
        names.resize(names.size() - more);
        return fmt::format("{}{}", fmt::join(names, " "),
                           more ? fmt::format(" and {} more", more) : "");
    };
    user_error(
        "the channels differ: only in {}: {}; only in {}: {}; choose common ones with --channels",
        name_a, list(only_a), name_b, list(only_b));
}

void check_scenes(const Image& a, const Image& b, const std::string& name_a,
                  const std::string& name_b) {
    const std::string scene_a = a.text("sceneHash"), scene_b = b.text("sceneHash");
    if (scene_a.empty() || scene_b.empty() || scene_a == scene_b) return;
    user_error(
        "{} and {} are pictures of different scenes (sceneHash {} and {}); --any-scene compares "
        "them all the same",
        name_a, name_b, scene_a.substr(0, 12), scene_b.substr(0, 12));
}

std::vector<double> wavelengths_of(const Image& image) {
    std::vector<double> nm;
    for (const Channel& channel : image.channels) {
        if (channel.name.rfind("S0.", 0) != 0) continue;
        if (const std::optional<double> value = layer_wavelength(channel.name)) {
            nm.push_back(*value);
        }
    }
    std::sort(nm.begin(), nm.end());
    return nm;
}

void check_wavelengths(const Image& a, const Image& b, const std::string& name_a,
                       const std::string& name_b) {
    const std::vector<double> in_a = wavelengths_of(a), in_b = wavelengths_of(b);
    if (in_a == in_b || in_a.empty() || in_b.empty()) return;
    const auto range = [](const std::vector<double>& nm) {
        return fmt::format("{} from {} to {} nm", nm.size(), format_double(nm.front()),
                           format_double(nm.back()));
    };
    user_error(
        "the wavelengths of the spectral layers differ: {} has {}, {} has {}; render both alike, "
        "or compare R,G,B",
        name_a, range(in_a), name_b, range(in_b));
}

}  // namespace drude
