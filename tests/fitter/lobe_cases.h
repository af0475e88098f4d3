// Lobe scans with known answers.
#pragma once

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "base/counter_random.h"
#include "fitter/lobe_fit.h"
#include "materials/microfacet.h"
#include "materials/surface.h"

namespace drude {

// 60 degrees, the detector from 30 to 85 by 1, 2 % noise of s and p; a cone so narrow that the
// value in its middle is the average. Seed 0 is noise-free.
inline LobeScan scan_of(Lobe lobe, double beta, const std::vector<double>& wavelengths_nm,
                        uint64_t seed, double scale = 1) {
    const Material metal = find_material("Cu-McPeak");
    const Microfacets<double> facets(lobe, Masking::v_groove, beta);
    LobeScan scan;
    scan.detector_half_angle_deg = 0.01;
    scan.detector_solid_angle_sr = 1e-7;
    uint64_t index = 0;
    for (const double nm : wavelengths_nm) {
        for (int seen = 30; seen <= 85; ++seen) {
            const Vec3<double> in(-std::sin(60 * degree), 0, std::cos(60 * degree));
            const Vec3<double> out(std::sin(seen * degree), 0, std::cos(seen * degree));
            // BRDF times the cosine of the outgoing direction: the roles of the two exchanged.
            const auto e = facets.evaluate(in, out);
            const Reflection<double> r = reflect(metal, nm, glm::dot(in, e.m));
            const auto noise = normal_pair(seed, index++);
            const double factor = scale * e.value * scan.detector_solid_angle_sr;
            LobeScanRow row;
            row.wavelength_nm = nm;
            row.angle_deg = 60;
            row.offset_deg = seen - 60;
            row.reflectance_s = factor * r.Rs * (1 + (seed ? 0.02 * noise[0] : 0));
            row.reflectance_p = factor * r.Rp * (1 + (seed ? 0.02 * noise[1] : 0));
            // Where a lobe has died away no detector is exact to 2 % of what is left.
            row.sigma_s = std::max(0.02 * factor * r.Rs, 1e-300);
            row.sigma_p = std::max(0.02 * factor * r.Rp, 1e-300);
            scan.rows.push_back(row);
        }
    }
    return scan;
}

inline const FittedLobe& result_for(const LobeFitResult& fit, Lobe lobe) {
    for (const FittedLobe& one : fit.lobes) {
        if (one.lobe == lobe) return one;
    }
    throw std::logic_error("a lobe is missing");
}

inline constexpr Lobe all_lobes[] = {Lobe::blinn_phong, Lobe::gaussian, Lobe::beckmann,
                                     Lobe::trowbridge_reitz};

}  // namespace drude
