// What is to be measured: format "drude-recipe/1" (JSON).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace drude {

enum class RecipeKind {
    psi_delta,         // "psi-delta": a sweep over angles of incidence
    lobe,              // "lobe": reflectance against the detector's offset
    straight_through,  // "straight-through": calibration without a sample
    azimuth,           // "azimuth": calibration of the plane of incidence with a sample
};

// "psi-delta", ...; recipe_kind() throws Error (user) with the nearest of them.
const char* recipe_kind_name(RecipeKind kind);
RecipeKind recipe_kind(const std::string& name);

// Angles are in degrees, wavelengths in nanometres, as in every file. For "azimuth" zones_deg are
// the positions of the analyser about the plane of incidence; "straight-through" uses no angle.
struct Recipe {
    RecipeKind kind = RecipeKind::psi_delta;
    std::string sample;  // its name, for the header
    std::vector<double> angles_deg = {45, 50, 60, 70, 75, 80};
    int steps = 24;  // of the polariser over 360 degrees, 5 to 360 (3 without harmonic_4)
    int cycles = 2;  // 1: without retarder; 2: without and with
    std::vector<double> zones_deg = {45, -45};  // azimuths of the analyser
    int averages = 4;                           // frames at every step
    double integration_s = 0;                   // 0: automatic exposure
    int dark_frames = 16;                       // at the beginning of every angle of incidence
    bool harmonic_4 = true;                     // fit the 4P harmonic
    bool drift = true;                          // fit a drift of the lamp
    bool shuffle = true;                        // steps in an order shuffled by `seed`
    uint64_t seed = 1;
    double first_nm = 380, last_nm = 780, step_nm = 5;  // bins of the measurement
    // Lobe scans.
    std::vector<double> offsets_deg;  // of the detector
    double detector_solid_angle_sr = 0, detector_half_angle_deg = 0;

    void check(const std::string& where) const;  // throws Error (user)
};

// What a recipe of this kind holds where nothing is said.
Recipe default_recipe(RecipeKind kind);

std::string format_recipe(const Recipe& recipe);  // canonical: its hash identifies a sweep
Recipe parse_recipe(const std::string& json, const std::string& file);
Recipe read_recipe(const std::string& path);

}  // namespace drude
