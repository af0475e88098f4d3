#include "device/sweep/recipe.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/files.h"
#include "base/numbers.h"
#include "materials/json_tree.h"
#include "materials/scalar.h"

namespace drude {

namespace {

constexpr std::string_view format_name = "drude-recipe/1";
// A recipe has a screenful of numbers; this keeps a file given by mistake out of memory.
constexpr uint64_t largest_recipe = uint64_t{1} << 20;
constexpr size_t most_points = 1'000'000;
// What a JSON number holds exactly (2^53 - 1), as a double reads it.
constexpr double largest_integer = 9007199254740991.0;

const std::vector<std::string>& kind_names() {
    static const std::vector<std::string> names = {"psi-delta", "lobe", "straight-through",
                                                   "azimuth"};
    return names;
}

template <class Condition>
void check_all(const std::string& where, const char* key, const std::vector<double>& values,
               const char* expected, Condition condition) {
    for (const double value : values) {
        if (!condition(value)) {
            user_error("{}: found {} in {}, expected {}", where, value, key, expected);
        }
    }
    std::vector<double> sorted = values;
    std::sort(sorted.begin(), sorted.end());
    const auto twice = std::adjacent_find(sorted.begin(), sorted.end());
    if (twice != sorted.end()) {
        user_error("{}: found {} twice in {}, expected every value once", where, *twice, key);
    }
}

void check_range(const std::string& where, const char* key, double value, double low, double high) {
    if (!(value >= low && value <= high)) {
        user_error("{}: found {} = {}, expected {} to {}", where, key, value, low, high);
    }
}

void check_lobe(const Recipe& recipe, const std::string& where) {
    if (recipe.offsets_deg.empty()) {
        user_error(
            "{}: a lobe scan has no offsets_deg, expected the detector's offsets from the mirror "
            "direction in degrees",
            where);
    }
    check_all(where, "offsets_deg", recipe.offsets_deg, "offsets in degrees",
              [](double offset) { return std::abs(offset) < 180; });
    for (const double angle : recipe.angles_deg) {
        for (const double offset : recipe.offsets_deg) {
            if (std::abs(angle + offset) < 90) continue;
            user_error(
                "{}: at {} degrees the offset {} takes the detector to {} degrees from the normal, "
                "expected less than 90",
                where, angle, offset, angle + offset);
        }
    }
    if (!(recipe.detector_solid_angle_sr > 0 && recipe.detector_solid_angle_sr < 2 * pi)) {
        user_error(
            "{}: a lobe scan has detector_solid_angle_sr = {}, expected the detector's solid "
            "angle seen from the sample, above 0 and below 2 pi",
            where, recipe.detector_solid_angle_sr);
    }
    if (!(recipe.detector_half_angle_deg > 0 && recipe.detector_half_angle_deg < 90)) {
        user_error(
            "{}: a lobe scan has detector_half_angle_deg = {}, expected the half angle of the "
            "detector's cone, above 0 and below 90",
            where, recipe.detector_half_angle_deg);
    }
    check_range(where, "straight_through_readings", recipe.straight_through_readings, 1, 100);
    check_range(where, "relative_floor", recipe.relative_floor, 0, 0.1);
    if (!(recipe.longest_integration_s > 0 && recipe.longest_integration_s <= 3600)) {
        user_error("{}: found longest_integration_s = {}, expected above 0 and up to 3600 seconds",
                   where, recipe.longest_integration_s);
    }
}

}  // namespace

const char* recipe_kind_name(RecipeKind kind) {
    return kind_names()[static_cast<size_t>(kind)].c_str();
}

RecipeKind recipe_kind(const std::string& name) {
    const auto& names = kind_names();
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end()) {
        user_error("found the kind '{}'{}, expected {}", name, did_you_mean(name, names),
                   fmt::join(names, ", "));
    }
    return static_cast<RecipeKind>(found - names.begin());
}

Recipe default_recipe(RecipeKind kind) {
    Recipe recipe;
    recipe.kind = kind;
    // About the plane of incidence, where the residual is a parabola of the analyser's azimuth.
    if (kind == RecipeKind::azimuth) {
        recipe.zones_deg = {-5, -3, -1, 1, 3, 5};
        recipe.angles_deg = {70};
        recipe.cycles = 1;
    }
    // Where the analyser does not follow the polariser, it passes half of s and half of p.
    if (kind == RecipeKind::lobe) {
        recipe.zones_deg = {45};
        recipe.cycles = 1;
        recipe.angles_deg = {45};
    }
    return recipe;
}

void Recipe::check(const std::string& where) const {
    if (kind != RecipeKind::straight_through && angles_deg.empty()) {
        user_error("{}: angles_deg is empty, expected at least one angle of incidence", where);
    }
    check_all(where, "angles_deg", angles_deg, "angles of incidence above 0 and below 90",
              [](double angle) { return angle > 0 && angle < 90; });
    if (zones_deg.empty()) {
        user_error("{}: zones_deg is empty, expected at least one azimuth of the analyser", where);
    }
    check_all(where, "zones_deg", zones_deg, "azimuths of the analyser from -180 to 180",
              [](double zone) { return zone >= -180 && zone <= 180; });
    if (kind == RecipeKind::azimuth && zones_deg.size() < 3) {
        user_error(
            "{}: found {} azimuths in zones_deg, expected 3 or more: the plane of incidence is the "
            "vertex of a parabola through them",
            where, zones_deg.size());
    }
    check_range(where, "steps", steps, harmonic_4 ? 5 : 3, 360);
    // P and P + 180 degrees are the same polariser.
    const int distinct = steps % 2 == 0 ? steps / 2 : steps;
    if (kind != RecipeKind::lobe && distinct < (harmonic_4 ? 5 : 3)) {
        user_error(
            "{}: {} steps over a turn are {} azimuths modulo 180 degrees, expected {} or more: an "
            "odd number of steps, or twice as many",
            where, steps, distinct, harmonic_4 ? 5 : 3);
    }
    check_range(where, "cycles", cycles, 1, 2);
    check_range(where, "averages", averages, 1, 1000);
    check_range(where, "dark_frames", dark_frames, 1, 1000);
    if (!(integration_s == 0 || (integration_s > 0 && integration_s <= 3600))) {
        user_error("{}: found integration_s = {}, expected 0 (automatic) or up to 3600 seconds",
                   where, integration_s);
    }
    if (!(first_nm > 0 && std::isfinite(last_nm) && last_nm >= first_nm && step_nm > 0 &&
          (last_nm - first_nm) / step_nm <= 100'000)) {
        user_error(
            "{}: found the bins {}:{}:{} nm, expected first_nm above 0, last_nm not below it, "
            "step_nm above 0, and at most 100 000 of them",
            where, first_nm, last_nm, step_nm);
    }
    if (static_cast<double>(seed) > largest_integer) {
        user_error("{}: found seed = {}, expected 0 to {:.0f}", where, seed, largest_integer);
    }
    if (kind == RecipeKind::lobe) check_lobe(*this, where);
    const size_t settings =
        kind == RecipeKind::lobe
            ? 4 * angles_deg.size() *
                  (offsets_deg.size() + static_cast<size_t>(straight_through_readings))
            : std::max<size_t>(1, angles_deg.size()) * zones_deg.size() *
                  static_cast<size_t>(steps);
    if (settings > most_points) {
        user_error("{}: asks for {} settings of the bench, expected at most {}", where, settings,
                   most_points);
    }
}

std::string format_recipe(const Recipe& recipe) {
    // Everything is written, so that what a default means is part of the text that is hashed.
    nlohmann::ordered_json json = {{"format", format_name},
                                   {"kind", recipe_kind_name(recipe.kind)},
                                   {"sample", recipe.sample},
                                   {"angles_deg", recipe.angles_deg},
                                   {"steps", recipe.steps},
                                   {"cycles", recipe.cycles},
                                   {"zones_deg", recipe.zones_deg},
                                   {"averages", recipe.averages},
                                   {"integration_s", recipe.integration_s},
                                   {"dark_frames", recipe.dark_frames},
                                   {"harmonic_4", recipe.harmonic_4},
                                   {"drift", recipe.drift},
                                   {"shuffle", recipe.shuffle},
                                   {"seed", recipe.seed},
                                   {"first_nm", recipe.first_nm},
                                   {"last_nm", recipe.last_nm},
                                   {"step_nm", recipe.step_nm}};
    if (recipe.kind == RecipeKind::lobe) {
        json["offsets_deg"] = recipe.offsets_deg;
        json["detector_solid_angle_sr"] = recipe.detector_solid_angle_sr;
        json["detector_half_angle_deg"] = recipe.detector_half_angle_deg;
        json["straight_through_readings"] = recipe.straight_through_readings;
        json["analyser_follows"] = recipe.analyser_follows;
        json["longest_integration_s"] = recipe.longest_integration_s;
        json["relative_floor"] = recipe.relative_floor;
    }
    return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

Recipe parse_recipe(const std::string& json, const std::string& file) {
    const JsonDocument document = parse_json_tree(json, file);
    const JsonValue root(document);
    root.allow_keys({"format",
                     "kind",
                     "sample",
                     "angles_deg",
                     "steps",
                     "cycles",
                     "zones_deg",
                     "averages",
                     "integration_s",
                     "dark_frames",
                     "harmonic_4",
                     "drift",
                     "shuffle",
                     "seed",
                     "first_nm",
                     "last_nm",
                     "step_nm",
                     "offsets_deg",
                     "detector_solid_angle_sr",
                     "detector_half_angle_deg",
                     "straight_through_readings",
                     "analyser_follows",
                     "longest_integration_s",
                     "relative_floor"});
    const JsonValue format = root.at("format");
    if (format.string() != format_name) {
        user_error_at(format.place(), "{} is '{}', expected '{}'", format.shown(), format.string(),
                      format_name);
    }
    RecipeKind kind = RecipeKind::psi_delta;
    if (root.has("kind")) {
        const JsonValue value = root.at("kind");
        kind = value.located([&] { return recipe_kind(value.string()); });
    }
    Recipe recipe = default_recipe(kind);
    if (root.has("sample")) recipe.sample = root.at("sample").string();
    const auto read_numbers = [&](const char* key, std::vector<double>* target) {
        if (root.has(key)) *target = root.at(key).numbers();
    };
    const auto read_number = [&](const char* key, double* target) {
        if (root.has(key)) *target = root.at(key).number();
    };
    const auto read_integer = [&](const char* key, int* target) {
        if (root.has(key)) *target = static_cast<int>(root.at(key).whole_number(-1e9, 1e9));
    };
    const auto read_boolean = [&](const char* key, bool* target) {
        if (root.has(key)) *target = root.at(key).boolean();
    };
    read_numbers("angles_deg", &recipe.angles_deg);
    read_integer("steps", &recipe.steps);
    read_integer("cycles", &recipe.cycles);
    read_numbers("zones_deg", &recipe.zones_deg);
    read_integer("averages", &recipe.averages);
    read_number("integration_s", &recipe.integration_s);
    read_integer("dark_frames", &recipe.dark_frames);
    read_boolean("harmonic_4", &recipe.harmonic_4);
    read_boolean("drift", &recipe.drift);
    read_boolean("shuffle", &recipe.shuffle);
    if (root.has("seed")) {
        recipe.seed = static_cast<uint64_t>(root.at("seed").whole_number(0, largest_integer));
    }
    read_number("first_nm", &recipe.first_nm);
    read_number("last_nm", &recipe.last_nm);
    read_number("step_nm", &recipe.step_nm);
    read_numbers("offsets_deg", &recipe.offsets_deg);
    read_number("detector_solid_angle_sr", &recipe.detector_solid_angle_sr);
    read_number("detector_half_angle_deg", &recipe.detector_half_angle_deg);
    read_integer("straight_through_readings", &recipe.straight_through_readings);
    read_boolean("analyser_follows", &recipe.analyser_follows);
    read_number("longest_integration_s", &recipe.longest_integration_s);
    read_number("relative_floor", &recipe.relative_floor);
    recipe.check(file);
    return recipe;
}

Recipe read_recipe(const std::string& path) {
    return parse_recipe(read_file(path, largest_recipe), path);
}

}  // namespace drude
