#include "device/sweep/plan.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>

#include "base/counter_random.h"
#include "base/error.h"

namespace drude {

namespace {

// Keeps the draws of a plan apart from the noise of virtual benches with the same seed.
constexpr uint64_t shuffle_stream = 0x73687566;

// 0 to count - 1, by Fisher and Yates from the end. The bias of the remainder is below 1e-9.
std::vector<int> step_order(int count, bool shuffle, uint64_t seed, uint64_t scan) {
    std::vector<int> order(static_cast<size_t>(count));
    std::iota(order.begin(), order.end(), 0);
    if (!shuffle) return order;
    for (int i = count - 1; i > 0; --i) {
        const PhiloxBlock bits =
            philox({static_cast<uint32_t>(i), static_cast<uint32_t>(scan),
                    static_cast<uint32_t>(shuffle_stream), 0},
                   {static_cast<uint32_t>(seed), static_cast<uint32_t>(seed >> 32)});
        const uint64_t draw = uint64_t{bits[0]} << 32 | bits[1];
        const uint64_t j = draw % static_cast<uint64_t>(i + 1);
        std::swap(order[static_cast<size_t>(i)], order[static_cast<size_t>(j)]);
    }
    return order;
}

void add_scans(const Recipe& recipe, const PlanPoint& setting, uint32_t* scan,
               std::vector<PlanPoint>* plan) {
    for (int cycle = 0; cycle < recipe.cycles; ++cycle) {
        for (const double zone : recipe.zones_deg) {
            for (const int step : step_order(recipe.steps, recipe.shuffle, recipe.seed, *scan)) {
                PlanPoint point = setting;
                point.scan = *scan;
                point.retarder_in = cycle == 1;
                point.analyser_deg = zone;
                point.polariser_deg = 360.0 * step / recipe.steps;
                plan->push_back(point);
            }
            ++*scan;
        }
    }
}

// s first: every position is read with the polariser along s (90) and along p (0).
void add_lobe_readings(const Recipe& recipe, const PlanPoint& setting, uint32_t* scan,
                       std::vector<PlanPoint>* plan) {
    for (const double polariser : {90.0, 0.0}) {
        PlanPoint point = setting;
        point.scan = *scan;
        point.analyser_deg = recipe.zones_deg.front();
        point.polariser_deg = polariser;
        plan->push_back(point);
    }
    ++*scan;
}

template <class Keep>
std::vector<double> kept(const std::vector<double>& values, Keep keep) {
    std::vector<double> result;
    std::copy_if(values.begin(), values.end(), std::back_inserter(result), keep);
    return result;
}

}  // namespace

std::vector<PlanPoint> make_plan(const Recipe& recipe) {
    std::vector<PlanPoint> plan;
    uint32_t scan = 0;
    PlanPoint setting;
    if (recipe.kind == RecipeKind::straight_through || recipe.kind == RecipeKind::lobe) {
        setting.straight_through = true;
        setting.incidence_deg = 90;
        if (recipe.kind == RecipeKind::straight_through) {
            add_scans(recipe, setting, &scan, &plan);
            return plan;
        }
        add_lobe_readings(recipe, setting, &scan, &plan);
        setting.straight_through = false;
        setting.block = 1;
        setting.group = 1;
    }
    for (const double angle : recipe.angles_deg) {
        setting.incidence_deg = angle;
        if (recipe.kind == RecipeKind::lobe) {
            for (const double offset : recipe.offsets_deg) {
                setting.offset_deg = offset;
                add_lobe_readings(recipe, setting, &scan, &plan);
            }
        } else {
            add_scans(recipe, setting, &scan, &plan);
        }
        ++setting.block;
    }
    return plan;
}

Recipe adapt_recipe(Recipe recipe, const Bench& bench, std::vector<std::string>* warnings) {
    recipe.check("recipe");
    if (recipe.sample.empty()) recipe.sample = bench.sample;
    const double fixed = bench.fixed_incidence_deg;
    if (fixed > 0 && recipe.kind != RecipeKind::psi_delta && recipe.kind != RecipeKind::azimuth) {
        user_error("{}: the arms are fixed at {} degrees, and a {} measurement moves them",
                   bench.name, fixed, recipe_kind_name(recipe.kind));
    }
    if (fixed > 0) {
        const auto angles = kept(recipe.angles_deg, [&](double a) { return a == fixed; });
        if (angles.empty()) {
            user_error("{}: the arms are fixed at {} degrees, found the angles {}; ask for {}",
                       bench.name, fixed, fmt::join(recipe.angles_deg, ", "), fixed);
        }
        if (angles != recipe.angles_deg) {
            warnings->push_back(fmt::format("the arms of {} are fixed: measured at {} degrees only",
                                            bench.name, fixed));
        }
        recipe.angles_deg = angles;
    }
    if (bench.head) {
        if (recipe.kind != RecipeKind::psi_delta) {
            user_error("{}: the instrument returns Psi and Delta; found the kind {}, expected {}",
                       bench.name, recipe_kind_name(recipe.kind),
                       recipe_kind_name(RecipeKind::psi_delta));
        }
        return recipe;
    }
    if (!bench.polariser.rotator) {
        user_error("{}: the polariser does not turn, and a {} measurement turns it", bench.name,
                   recipe_kind_name(recipe.kind));
    }
    if (!bench.analyser.rotator) {
        const double stands = bench.analyser.fixed_deg;
        const auto zones = kept(recipe.zones_deg, [&](double zone) { return zone == stands; });
        if (zones.empty() || recipe.kind == RecipeKind::azimuth) {
            user_error("{}: the analyser is fixed at {} degrees, found the zones {}", bench.name,
                       stands, fmt::join(recipe.zones_deg, ", "));
        }
        if (zones != recipe.zones_deg) {
            warnings->push_back(fmt::format(
                "the analyser is fixed at {} degrees: errors of its azimuth do not average out",
                stands));
        }
        recipe.zones_deg = zones;
    }
    if (recipe.cycles == 2 && !bench.retarder.present) {
        warnings->push_back(
            "the bench has no retarder: Delta is known up to its sign, and badly near 0 and 180");
        recipe.cycles = 1;
    }
    if (recipe.kind == RecipeKind::lobe) recipe.cycles = 1;
    const SpectrometerInfo& info = bench.spectrometer->info();
    if (recipe.integration_s > 0 &&
        (recipe.integration_s < info.shortest_s || recipe.integration_s > info.longest_s)) {
        user_error("{}: found an integration time of {} s, expected {} to {} s of the {}",
                   bench.name, recipe.integration_s, info.shortest_s, info.longest_s, info.model);
    }
    return recipe;
}

}  // namespace drude
