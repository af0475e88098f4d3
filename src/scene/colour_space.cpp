#include "scene/colour_space.h"

#include <algorithm>
#include <array>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

namespace drude {

namespace {

// CIE xyz of a chromaticity, which is XYZ up to a factor.
glm::dvec3 xyz_of(double x, double y) {
    return {x, y, 1 - x - y};
}

glm::dvec3 vector_of(const std::array<double, 3>& values) {
    return {values[0], values[1], values[2]};
}

// The project's D65, Y = 1.
glm::dvec3 d65() {
    const glm::dvec3 white = vector_of(rgb_to_xyz({1, 1, 1}));
    return white / white.y;
}

struct Definition {
    ColourSpace space;
    std::string_view name;
    double xy[3][2];
    double white[2];  // 0 0: the project's D65
};

constexpr std::array<Definition, 4> definitions = {{
    {ColourSpace::srgb, "srgb", {{0.64, 0.33}, {0.30, 0.60}, {0.15, 0.06}}, {0, 0}},
    {ColourSpace::rec2020, "rec2020", {{0.708, 0.292}, {0.170, 0.797}, {0.131, 0.046}}, {0, 0}},
    {ColourSpace::dci_p3, "dci-p3", {{0.680, 0.320}, {0.265, 0.690}, {0.150, 0.060}}, {0, 0}},
    {ColourSpace::aces2065_1,
     "aces2065-1",
     {{0.7347, 0.2653}, {0, 1}, {0.0001, -0.0770}},
     {0.32168, 0.33767}},
}};

struct Matrices {
    glm::dmat3 light, matter;  // linear sRGB from linear RGB of the space
};

Matrices make_matrices(const Definition& space) {
    glm::dmat3 primaries;
    for (int c = 0; c < 3; ++c) primaries[c] = xyz_of(space.xy[c][0], space.xy[c][1]);
    glm::dvec3 white = d65();
    if (space.white[1] > 0) white = xyz_of(space.white[0], space.white[1]) / space.white[1];
    // The primaries' strengths are those that make white together.
    const glm::dvec3 strength = glm::inverse(primaries) * white;
    glm::dmat3 xyz_from_space;
    for (int c = 0; c < 3; ++c) xyz_from_space[c] = primaries[c] * strength[c];
    glm::dmat3 srgb_from_xyz;
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 3; ++column) {
            srgb_from_xyz[column][row] =
                rgb_from_xyz()[static_cast<size_t>(row)][static_cast<size_t>(column)];
        }
    }
    const glm::dmat3 cones_from_xyz(0.8951, -0.7502, 0.0389, 0.2664, 1.7135, -0.0685, -0.1614,
                                    0.0367, 1.0296);
    const glm::dvec3 gain = (cones_from_xyz * d65()) / (cones_from_xyz * white);
    glm::dmat3 gains(0);
    for (int c = 0; c < 3; ++c) gains[c][c] = gain[c];
    const glm::dmat3 adapted = glm::inverse(cones_from_xyz) * gains * cones_from_xyz;
    return {srgb_from_xyz * xyz_from_space, srgb_from_xyz * adapted * xyz_from_space};
}

const Matrices& matrices_of(ColourSpace space) {
    static const std::array<Matrices, definitions.size()> all = [] {
        std::array<Matrices, definitions.size()> result;
        for (size_t i = 0; i < result.size(); ++i) result[i] = make_matrices(definitions[i]);
        return result;
    }();
    return all[static_cast<size_t>(space)];
}

RGB product(const glm::dmat3& matrix, const RGB& rgb) {
    const glm::dvec3 result = matrix * vector_of(rgb);
    return {result.x, result.y, result.z};
}

}  // namespace

ColourSpace parse_colour_space(std::string_view name) {
    for (const Definition& definition : definitions) {
        if (definition.name == name) return definition.space;
    }
    return ColourSpace::srgb;
}

std::string_view colour_space_name(ColourSpace space) {
    return definitions[static_cast<size_t>(space)].name;
}

// sRGB is the project's own: nothing is done to it, not even rounding.
RGB light_to_srgb(ColourSpace space, const RGB& rgb) {
    return space == ColourSpace::srgb ? rgb : product(matrices_of(space).light, rgb);
}

RGB matter_to_srgb(ColourSpace space, const RGB& rgb) {
    return space == ColourSpace::srgb ? rgb : product(matrices_of(space).matter, rgb);
}

RGB into_gamut(const RGB& rgb, double highest) {
    const double grey = std::clamp(rgb_to_xyz(rgb)[1], 0.0, highest);
    double chroma = 1;
    for (const double value : rgb) {
        if (value < 0) chroma = std::min(chroma, grey / (grey - value));
        if (value > highest) chroma = std::min(chroma, (highest - grey) / (value - grey));
    }
    if (chroma == 1) return rgb;
    RGB result;
    for (size_t c = 0; c < 3; ++c) {
        result[c] = std::clamp(grey + chroma * (rgb[c] - grey), 0.0, highest);
    }
    return result;
}

}  // namespace drude
