// What a detector sees of a rough metal in a lobe scan, as a function of the facets' density.
#pragma once

#include <vector>

#include "materials/lobe_scan.h"
#include "materials/material.h"
#include "materials/microfacet.h"

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

    // As data(), for one density; T is double or ceres::Jet.
    template <class T>
    std::vector<T> evaluate(const LobeDensity<T>& density) const {
        std::vector<T> D;
        D.reserve(tan2_.size());
        for (const double tan2 : tan2_) D.push_back(density(T(tan2)));
        std::vector<T> values;
        values.reserve(data_.size());
        for (size_t i = 0; i < data_.size(); ++i) {
            T sum(0.0);
            const double* weight = &weights_[i * nodes];
            const T* density_at = &D[first_node_[i]];
            for (size_t j = 0; j < nodes; ++j) sum += weight[j] * density_at[j];
            values.push_back(sum);
        }
        return values;
    }

    static constexpr size_t rings = 5, spokes = 12, nodes = rings * spokes;

  private:
    std::vector<double> tan2_;        // of the half vectors, `nodes` for every distinct position
    std::vector<size_t> first_node_;  // of each datum, in tan2_
    std::vector<double> weights_;     // `nodes` for each datum
    std::vector<LobeDatum> data_;
    size_t wavelengths_ = 0;
};

}  // namespace drude
