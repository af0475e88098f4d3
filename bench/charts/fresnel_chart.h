// Chart 4: the reflectance of a metal, exactly and approximately.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "bench/charts/five_metals.h"
#include "bench/charts/fresnel_methods.h"

namespace drude {

// What a packet is evaluated for: uniform numbers chosen beforehand.
struct FresnelInputs {
    std::vector<float> cosine;
    std::vector<int> phase;
    explicit FresnelInputs(uint64_t seed);
};

// A method with the tables of one metal.
struct FresnelMethod {
    std::string name, setting;
    bool automatic = false;
    size_t bytes = 0;
    // Nanoseconds of processor time a packet.
    std::function<double(const FresnelInputs&)> reflectance_ns, pair_ns;
    std::function<FresnelPacket(float cosine, int phase)> reflectance;  // of unpolarised light
    // Empty where the method has one reflectance for both.
    std::function<ReflectancePair<FresnelPacket>(float cosine, int phase)> pair;
};
std::vector<FresnelMethod> fresnel_methods(const DenseIndex& metal);

// Of the loop with two fetched constants and no Fresnel, and of all four numbers of the exact
// reflection, in nanoseconds a packet.
double fresnel_loop_ns(const DenseIndex& metal, const FresnelInputs& inputs);
double full_reflection_ns(const DenseIndex& metal, const FresnelInputs& inputs);

// Against the closed form in double, over the sphere of sphere_picture.h and 380 to 779 nm.
struct FresnelError {
    double rms = 0, worst = 0;   // of the unpolarised reflectance
    double worst_angle_deg = 0;  // where it is
    double rms_psi_deg = 0;      // of Psi, taken as 45 degrees where there is no pair
    double mean_delta_e = 0, worst_delta_e = 0, relative_rmse = 0;  // of the picture
};
FresnelError fresnel_error(const FresnelMethod& method, const DenseIndex& metal);

}  // namespace drude
