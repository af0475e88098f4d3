#include "image/image.h"

#include <fmt/ranges.h>

#include <algorithm>

#include "base/error.h"

namespace drude {

const Channel* Image::find(const std::string& name) const {
    const auto found = std::find_if(channels.begin(), channels.end(),
                                    [&](const Channel& channel) { return channel.name == name; });
    return found == channels.end() ? nullptr : &*found;
}

Channel* Image::find(const std::string& name) {
    return const_cast<Channel*>(static_cast<const Image*>(this)->find(name));
}

const Channel& Image::at(const std::string& name, const std::string& where) const {
    if (const Channel* channel = find(name)) return *channel;
    std::vector<std::string> names;
    for (const Channel& channel : channels) names.push_back(channel.name);
    const std::string hint = did_you_mean(name, names);
    // A spectral picture has hundreds of channels: enough are named to recognise the file.
    constexpr size_t enough = 12;
    const size_t more = names.size() > enough ? names.size() - enough : 0;
    names.resize(names.size() - more);
    user_error("{}: has no channel '{}'{}; its channels are {}{}", where, name, hint,
               fmt::join(names, " "), more ? fmt::format(" and {} more", more) : "");
}

Channel& Image::add(const std::string& name) {
    channels.push_back({name, std::vector<float>(pixels(), 0.0F)});
    return channels.back();
}

std::string Image::text(const std::string& attribute) const {
    const auto found = attributes.find(attribute);
    if (found == attributes.end()) return "";
    const std::string* value = std::get_if<std::string>(&found->second);
    return value ? *value : "";
}

double Image::number(const std::string& attribute, double otherwise) const {
    const auto found = attributes.find(attribute);
    if (found == attributes.end()) return otherwise;
    if (const int* whole = std::get_if<int>(&found->second)) return *whole;
    if (const float* value = std::get_if<float>(&found->second)) {
        return static_cast<double>(*value);
    }
    return otherwise;
}

std::vector<float> rgb_values(const Image& image, const std::string& where) {
    const Channel* source[3] = {image.find("R"), image.find("G"), image.find("B")};
    if (!source[0] && !source[1] && !source[2]) {
        if (const Channel* luminance = image.find("Y")) {
            std::fill(source, source + 3, luminance);
        } else if (image.find("S0.R")) {
            const char* names[] = {"S0.R", "S0.G", "S0.B"};
            for (int c = 0; c < 3; ++c) source[c] = image.find(names[c]);
        }
    }
    const char* names[] = {"R", "G", "B"};
    for (int c = 0; c < 3; ++c) {
        if (!source[c]) source[c] = &image.at(names[c], where);
    }
    std::vector<float> rgb(image.pixels() * 3);
    for (size_t i = 0; i < image.pixels(); ++i) {
        for (size_t c = 0; c < 3; ++c) rgb[3 * i + c] = source[c]->data[i];
    }
    return rgb;
}

}  // namespace drude
