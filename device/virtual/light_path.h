// What a sample does to the light between polariser and analyser, at every pixel's wavelength.
//
// Frames are those of conventions: right-handed coordinates with the sample's normal along z and
// the plane of incidence in x and z; S1 > 0 along s, which is +y before and after the sample, and
// S2 > 0 at 45 degrees from s towards p = k x s.
#pragma once

#include <vector>

#include "materials/material.h"
#include "materials/mueller.h"
#include "materials/torrance_sparrow.h"

namespace drude {

// The first three columns of a Mueller matrix: a polariser lets no S3 through.
struct PathRows {
    double m[4][3] = {};
};

// A sample with its optical constants looked up once for every wavelength.
class SampledSurface {
  public:
    // Throws as Material::check and OpticalConstants::at do.
    SampledSurface(const Material& material, const std::vector<double>& wavelengths_nm);

    size_t size() const { return substrate_.size(); }
    Reflection<double> reflect_at(size_t pixel, double cos_theta) const;

  private:
    std::vector<double> wavelengths_nm_;
    std::vector<ComplexIndex<double>> substrate_;
    std::vector<ThinFilm<double>> films_;  // film_count_ of each pixel
    int film_count_ = 0;
};

// Detected over arriving light, for a parallel beam narrower than the detector. The detector's cone
// of `half_angle_deg` in (0, 45) is centred `offset_deg` beyond the mirror direction. A mirror
// (material.beta below mirror_below_beta) sends all of it into the cone or none; of a rough surface
// the cone gets the integral of BRDF x cos(theta_o), each direction with the Mueller matrix of the
// facets that reflect into it and seen by an analyser whose axes are those of the cone's centre.
// incidence_deg in (0, 90).
std::vector<PathRows> sample_path(const Material& material, const SampledSurface& surface,
                                  double incidence_deg, double offset_deg, double half_angle_deg);

// Nothing between polariser and analyser.
std::vector<PathRows> straight_path(size_t pixels);

}  // namespace drude
