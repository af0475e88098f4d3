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
    uint32_t block = 0;  // points of a block share a dark; straight through, or one angle
    uint32_t group = 0;  // points of a group share an integration time
    uint32_t scan = 0;   // points of a scan differ in the polariser only
    bool straight_through = false;
    double incidence_deg = 70;  // 90: straight through
    double offset_deg = 0;
    bool retarder_in = false;
    double analyser_deg = 45, polariser_deg = 0;
};

// The angle of incidence is the slowest, then retarder, analyser, and the polariser's steps, which
// are shuffled by the recipe's seed so that a drift of the lamp does not look like a modulation. A
// lobe scan begins straight through and has a group of its own there, since that beam is far
// brighter than what a rough surface sends back. A pure function of the recipe.
std::vector<PlanPoint> make_plan(const Recipe& recipe);

// The recipe as far as the bench can follow it: zones that a fixed analyser does not stand at, the
// second cycle without a retarder, and angles that a fixed goniometer does not have are left out
// with a warning. Throws Error (user) where nothing is left, where the bench has no part that the
// recipe needs, and for integration times that its spectrometer does not have.
Recipe adapt_recipe(Recipe recipe, const Bench& bench, std::vector<std::string>* warnings);

}  // namespace drude
