// How paths look for light. The default is what pictures are made with; the others exist to show
// what it gains (bench/charts/sampling_chart.cpp), so that no option of the command line sets them.
#pragma once

namespace drude {

// Every strategy gives the same picture in the mean, where it says no otherwise.
struct SamplingStrategy {
    enum class Directions {
        // By surfaces alone. Lights without a size (distant, point) are never found that way:
        // Error (user) for scenes that have some.
        lobe,
        // By lights alone, wherever a surface is not a mirror and a light's density is not 0.
        light,
        // Both, weighted by the power heuristic.
        both
    };
    Directions directions = Directions::both;
    // Environments: luminance less its mean (see Environment), or luminance itself.
    bool compensated_environments = true;
    // Metals: facets in proportion to what is seen of them, or by D cos whatever is seen, as
    // before Heitz & d'Eon 2014. Other surfaces keep to visible facets.
    bool visible_normals = true;

    bool operator==(const SamplingStrategy&) const = default;
};

}  // namespace drude
