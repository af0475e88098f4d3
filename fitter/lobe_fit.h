// The roughness beta from lobe scans: the only data that hold it, since D and G cancel in Psi and
// Delta.
#pragma once

#include <string>
#include <vector>

#include "materials/lobe_scan.h"
#include "materials/material.h"

namespace drude {

struct FittedLobe {
    Lobe lobe = Lobe::trowbridge_reitz;
    double beta = 0, sigma_beta = 0;  // radians or RMS slope (microfacet.h); sigma from the data's
    double chi2 = 0;
    bool tied = false;  // within lobe_tie of the best chi-square: the data do not tell it from it
    bool at_bound = false;
    // The lobe is narrower than the detector's cone, so that mostly the cone was measured: beta is
    // at most `upper_bound`, where the two are equally wide, and not known otherwise.
    bool narrower_than_aperture = false;
    double upper_bound = 0;
};

struct LobeFitResult {
    std::vector<FittedLobe> lobes;  // all four, best first
    int data = 0, parameters = 0;   // beta, and a scale for every wavelength
    std::vector<std::string> warnings;

    int dof() const { return data - parameters; }
};

// Lobes whose chi-square is within this of the best are a tie.
//
// Let D be the chi-square that a wrong lobe keeps when it is fitted to the true one's scan without
// noise. With noise the difference of the two chi-squares is normal, of mean D and variance 4 D
// (likelihood ratios of models that are not nested: Cox 1961, Vuong 1989), so that the wrong lobe
// leads by t with the probability Phi(-(t + D)/(2 sqrt D)), at most Phi(-sqrt t), where D = t. A
// lead of 6 would name a wrong lobe in up to 0.7 % of the scans, whatever the fit; 18 in 1e-5.
inline constexpr double lobe_tie = 18;

// Fits all four lobes, with V-groove masking as Berger et al. 2012, to all wavelengths of the scan
// together: BRDF times cos(theta_o), averaged over the detector's cone, times its solid angle and a
// free scale for every wavelength. n and k (and layers) are those of `metal`; they come from Psi
// and Delta, not from here. beta is sought from a quarter of the cone to 1.2.
//
// Throws Error (user) for what LobeScan::check and Material::check forbid; Error (answer_is_no)
// where the scan determines no beta (one position of the detector only, say).
LobeFitResult fit_lobes(const LobeScan& scan, const Material& metal);

// Gives `material` the lobe that alone explains the scan, or the one called `name` among those that
// tie ("": none is named), with the fit's warnings. Throws Error (user) for an unknown name, and
// Error (answer_is_no) where several tie and none is named, where the data exclude the one that is,
// and where all that is known of beta is an upper bound.
void set_fitted_lobe(const LobeFitResult& result, const std::string& name, Material* material);

}  // namespace drude
