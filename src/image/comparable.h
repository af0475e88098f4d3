// What keeps two pictures from being compared, each an Error (user) of its own that names the
// files.
#pragma once

#include <string>
#include <vector>

#include "image/image.h"

namespace drude {

void check_size(const Image& a, const Image& b, const std::string& name_a,
                const std::string& name_b);

// Attributes `sceneHash` that differ; a file without one may show any scene.
void check_scenes(const Image& a, const Image& b, const std::string& name_a,
                  const std::string& name_b);

// Spectral layers of different wavelengths. Pictures may be compared in their colours whatever
// their layers are: this is for comparisons of the layers themselves.
void check_wavelengths(const Image& a, const Image& b, const std::string& name_a,
                       const std::string& name_b);

// Channels that only one of the two has.
void check_same_names(const Image& a, const Image& b, const std::string& name_a,
                      const std::string& name_b);

std::vector<std::string> sorted_names(const Image& image);

// Of the spectral layers of S0, in nm, ascending.
std::vector<double> wavelengths_of(const Image& image);

}  // namespace drude
