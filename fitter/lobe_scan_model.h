// What a detector sees of a rough metal in a lobe scan, as a function of the facets' density.
#pragma once

#include <vector>

#include "materials/lobe_scan.h"
#include "materials/material.h"

namespace drude {

struct LobeDatum {
    double value = 0, sigma = 0;
    size_t wavelength = 0;  // number of its wavelength, by which data share a scale
};

// Per position of the detector, its cone is a set of directions; each has a half vector, at which
// only D depends on beta. Everything else - Fresnel's reflectance, masking, cosines, the weights of
// the average - is computed once.
//
// The flux from s-polarised light into one direction is R_s cos^2 + R_p sin^2 of the angle between
// the planes of incidence of the surface and of the facet; vice versa for p.
class LobeScanModel {
  public:
    LobeScanModel(const LobeScan& scan, const Material& metal);

    // Two of each row of the scan, s first.
    const std::vector<LobeDatum>& data() const { return data_; }
    size_t wavelength_count() const { return wavelengths_; }

    // tan^2 of the facets' angles at which the density is wanted.
    const std::vector<double>& tan2() const { return tan2_; }
    // What the detector sees of a quantity that is linear in the density, given at tan2(): one
    // value for each of data().
    std::vector<double> average(const std::vector<double>& at_facets) const;

    // The cone and the light are symmetric about the plane of incidence: every second ring has a
    // spoke in that plane on either side, and the others count twice.
    static constexpr size_t rings = 5, spokes = 12;
    static constexpr size_t nodes = (rings + 1) / 2 * (spokes / 2 + 1) + rings / 2 * (spokes / 2);

  private:
    std::vector<double> tan2_;        // `nodes` for every distinct position
    std::vector<size_t> first_node_;  // of each datum, in tan2_
    std::vector<double> weights_;     // `nodes` for each datum
    std::vector<LobeDatum> data_;
    size_t wavelengths_ = 0;
};

}  // namespace drude
