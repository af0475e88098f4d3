// A polarised BRDF of an isotropic, mirror-symmetric surface as a table, in the coordinates of
// Rusinkiewicz (1998, "A new change of variables for efficient BRDF representation"):
//   theta_h  of the half vector h from the normal, 0 to 90 degrees
//   theta_d  of the light from h, 0 to 90 degrees
//   phi_d    of the light about h, 0 to 180 degrees: 0 where the light is in the plane of the
//            normal and h, farther from the normal than h; it grows as right-handed coordinates
//            turn about h
#pragma once

#include <string>
#include <vector>

struct Table {
    // Strictly ascending, at least two each but for the wavelengths; degrees and nanometres.
    std::vector<float> wavelengths_nm, theta_h_deg, theta_d_deg, phi_d_deg;
    // [theta_h][theta_d][phi_d][wavelength][16]: Mueller matrices per steradian, row-major, in the
    // s-p frames of the half vector.
    std::vector<float> values;

    // The text format of docs/plugins.md. Throws std::runtime_error with file and line.
    static Table read(const std::string& path);

    // Multilinear between the nodes, the end values beyond them. phi_d_deg in [-180, 180]: a
    // negative one is that of the mirrored reflection.
    void interpolate(float theta_h, float theta_d, float phi_d, const float* nm, int count,
                     float* mueller) const;
};
