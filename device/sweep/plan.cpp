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

constexpr double widest_parallel_deg = 1;
// The straight beam is read in so many times more frames than a position of the detector.
constexpr uint32_t straight_repeat = 4;

class LobePlan {
  public:
    explicit LobePlan(const Recipe& recipe) : recipe_(recipe) {}

    std::vector<PlanPoint> make() {
        for (size_t angle = 0; angle < recipe_.angles_deg.size(); ++angle) add_angle(angle);
        return plan_;
    }

  private:
    // The last straight-through reading of an angle is the first of the next.
    void add_angle(size_t angle) {
        const auto offsets = static_cast<int>(recipe_.offsets_deg.size());
        const int parts = std::max(1, std::min(recipe_.straight_through_readings - 1, offsets));
        const std::vector<int> order = step_order(offsets, recipe_.shuffle, recipe_.seed, angle);
        if (angle == 0) add_straight();
        for (int part = 0; part < parts; ++part) {
            PlanPoint setting;
            setting.block = block_++;
            setting.group = static_cast<uint32_t>(angle) + 1;
            setting.incidence_deg = recipe_.angles_deg[angle];
            for (int i = part * offsets / parts; i < (part + 1) * offsets / parts; ++i) {
                setting.offset_deg =
                    recipe_.offsets_deg[static_cast<size_t>(order[static_cast<size_t>(i)])];
                add_readings(setting, 0, 0);
            }
            if (recipe_.straight_through_readings > 1) add_straight();
        }
    }

    void add_straight() {
        PlanPoint setting;
        setting.block = block_++;
        setting.straight_through = true;
        setting.incidence_deg = 90;
        setting.repeat = straight_repeat;
        add_readings(setting, straight_ % 2 * 180, straight_ / 2 % 2 * -180);
        ++straight_;
    }

    // s first: every position is read with the polariser along s (90) and along p (0).
    void add_readings(PlanPoint point, int polariser_turn, int analyser_turn) {
        const bool crossed =
            recipe_.analyser_follows && recipe_.detector_half_angle_deg > widest_parallel_deg;
        point.scan = scan_++;
        for (const double polariser : {90.0, 0.0}) {
            for (const double across : {0.0, 90.0}) {
                if (across > 0 && !crossed) continue;
                point.polariser_deg = polariser + polariser_turn;
                point.analyser_deg = recipe_.analyser_follows
                                         ? std::fmod(polariser + across, 180) + analyser_turn
                                         : recipe_.zones_deg.front();
                plan_.push_back(point);
            }
        }
    }

    const Recipe& recipe_;
    std::vector<PlanPoint> plan_;
    uint32_t block_ = 0, scan_ = 0;
    int straight_ = 0;
};

template <class Keep>
std::vector<double> kept(const std::vector<double>& values, Keep keep) {
    std::vector<double> result;
    std::copy_if(values.begin(), values.end(), std::back_inserter(result), keep);
    return result;
}

void adapt_lobe(const Bench& bench, Recipe* recipe, std::vector<std::string>* warnings) {
    recipe->cycles = 1;
    if (!bench.analyser.rotator && recipe->analyser_follows) {
        recipe->analyser_follows = false;
        // Twice an error of the polariser's azimuth, in radians: a quarter of a degree.
        recipe->relative_floor = std::max(recipe->relative_floor, 0.01);
        warnings->push_back(fmt::format(
            "the analyser does not turn: errors of both azimuths move the reflectances of s and p "
            "against each other, and their sigmas hold {} of the value for it",
            recipe->relative_floor));
    }
    if (bench.goniometer_by_hand && recipe->straight_through_readings > 2) {
        recipe->straight_through_readings = 2;
        warnings->push_back(
            "the arms are moved by hand: the straight beam is read before and after the detector's "
            "positions only");
    }
}

}  // namespace

std::vector<PlanPoint> make_plan(const Recipe& recipe) {
    if (recipe.kind == RecipeKind::lobe) return LobePlan(recipe).make();
    std::vector<PlanPoint> plan;
    uint32_t scan = 0;
    PlanPoint setting;
    if (recipe.kind == RecipeKind::straight_through) {
        setting.straight_through = true;
        setting.incidence_deg = 90;
        add_scans(recipe, setting, &scan, &plan);
        return plan;
    }
    for (const double angle : recipe.angles_deg) {
        setting.incidence_deg = angle;
        add_scans(recipe, setting, &scan, &plan);
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
    if (recipe.kind == RecipeKind::lobe) adapt_lobe(bench, &recipe, warnings);
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
    const SpectrometerInfo& info = bench.spectrometer->info();
    if (recipe.integration_s > 0 &&
        (recipe.integration_s < info.shortest_s || recipe.integration_s > info.longest_s)) {
        user_error("{}: found an integration time of {} s, expected {} to {} s of the {}",
                   bench.name, recipe.integration_s, info.shortest_s, info.longest_s, info.model);
    }
    return recipe;
}

}  // namespace drude
