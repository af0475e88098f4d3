// Simulated measurements of the five metals, fitted, and what the fit's errors do to pictures.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "bench/charts/sphere_picture.h"
#include "materials/optical_constants.h"

namespace drude {

// Pictures of a polished sphere, each wanting more of its constants than the one before:
//   sky       unpolarised light, one reflection: A
//   bounces   five reflections at one angle in one plane: (Rs^5 + Rp^5)/2
//   crossed   a polariser before the light and a crossed one before the camera: (A + C)/2, which is
//             dark where the phases of s and p agree
enum class FitScene { sky, bounces, crossed };
inline constexpr std::array<FitScene, 3> fit_scenes = {FitScene::sky, FitScene::bounces,
                                                       FitScene::crossed};
const char* fit_scene_name(FitScene scene);

SpherePicture fit_picture(FitScene scene, const DenseIndex& metal);

struct FitSetting {
    std::string estimator = "psi-delta";  // or "rho2", which measures no Delta
    std::string dispersion;               // "" is point by point
    std::vector<double> angles_deg = {65, 70, 75};
    int wavelengths = 41;  // from 380 to 780 nm, evenly
    double noise = 1;      // 1: 0.05 degrees of Psi, 0.1 of Delta

    double sigma_psi_deg() const { return 0.05 * noise; }
    // Numbers that the instrument has to deliver.
    double data() const {
        return static_cast<double>(angles_deg.size()) * wavelengths * (estimator == "rho2" ? 1 : 2);
    }
};

struct FitOutcome {
    double seconds = 0;   // of processor time, of the fit alone
    std::string refused;  // why there is no answer; then nothing else is
    // |N fitted - N| over |N|, root mean square over 380 to 779 nm, interpolation included.
    double constants_error = 0;
    double refused_share = 0;              // of the measured wavelengths
    std::array<PictureError, 3> pictures;  // by scene; white is the truth's brightest ring
};

// Of one metal with the noise of `seed`; on one thread.
FitOutcome fit_outcome(const OpticalConstants& metal, const FitSetting& setting, uint64_t seed);

}  // namespace drude
