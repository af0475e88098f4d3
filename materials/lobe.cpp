#include "materials/lobe.h"

#include "base/error.h"

namespace drude {

const std::vector<std::string>& lobe_names() {
    static const std::vector<std::string> names = {"blinn-phong", "gaussian", "beckmann",
                                                   "trowbridge-reitz"};
    return names;
}

const std::vector<std::string>& masking_names() {
    static const std::vector<std::string> names = {"v-groove", "smith"};
    return names;
}

std::string_view lobe_name(Lobe lobe) {
    return lobe_names()[static_cast<size_t>(lobe)];
}
std::string_view masking_name(Masking masking) {
    return masking_names()[static_cast<size_t>(masking)];
}

namespace {

size_t index_of(std::string_view name, const std::vector<std::string>& names,
                std::string_view what) {
    for (size_t i = 0; i < names.size(); ++i) {
        if (names[i] == name) return i;
    }
    user_error("'{}' is not a {}; expected one of {}{}", name, what, fmt::join(names, ", "),
               did_you_mean(name, names));
}

}  // namespace

Lobe parse_lobe(std::string_view name) {
    return static_cast<Lobe>(index_of(name, lobe_names(), "lobe"));
}
Masking parse_masking(std::string_view name) {
    return static_cast<Masking>(index_of(name, masking_names(), "masking"));
}

}  // namespace drude
