// What a recipe makes a bench do, in order.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "device/bench.h"
#include "device/sweep/recipe.h"

namespace drude {

// One setting of the bench at which frames are taken. Azimuths are those of the elements' axes.
struct PlanPoint {
    uint32_t block = 0;   // points of a block share a dark: an angle, or part of a lobe scan
    uint32_t group = 0;   // points of a group share an integration time
    uint32_t scan = 0;    // points of a scan differ in the polariser only (in a lobe scan also in
                          // an analyser that follows it)
    uint32_t repeat = 1;  // times the recipe's averages are taken
    bool straight_through = false;
    double incidence_deg = 70;  // 90: straight through
    double offset_deg = 0;
    bool retarder_in = false;
    double analyser_deg = 45, polariser_deg = 0;
};

// The angle of incidence is the slowest, then retarder, analyser, and the polariser's steps, which
// are shuffled by the recipe's seed so that a drift of the lamp does not look like a modulation. A
// pure function of the recipe.
//
// A lobe scan goes through the offsets of an angle in an order shuffled likewise, in as many parts
// as there are straight-through readings between and after them, each part and each reading with a
// dark of its own. The straight beam has its own integration time, since it is far brighter than
// what a rough surface sends back, and more frames, since all reflectances hang on it; every other
// reading of it is taken with the polariser, every two with the analyser half a turn on, where the
// mounts' errors of once a turn have the other sign. So has each angle its own integration time.
//
// Detectors that see beyond 1 degree around their axis get light from facets that turn the
// polarisation, up to (half angle)^2 / (4 sin^2 angle) of it: there a following analyser also reads
// the crossed light, which belongs to the flux.
std::vector<PlanPoint> make_plan(const Recipe& recipe);

// The recipe as far as the bench can follow it: zones that a fixed analyser does not stand at, the
// second cycle without a retarder, and angles that a fixed goniometer does not have are left out
// with a warning. Throws Error (user) where nothing is left, where the bench has no part that the
// recipe needs, and for integration times that its spectrometer does not have.
Recipe adapt_recipe(Recipe recipe, const Bench& bench, std::vector<std::string>* warnings);

}  // namespace drude
