// What the lamp did between readings of its straight beam.
#pragma once

#include <array>
#include <vector>

namespace drude {

// One reading of the straight beam over the mean of all.
struct BeamRatio {
    double time_s = 0;
    std::vector<double> ratio;   // of every pixel
    std::vector<double> weight;  // inverse variance of it; 0: not to be used
};

// The beam's change is taken for a parabola over the wavelength (a lamp that ages or warms up
// changes its colour smoothly), so that a few coefficients are found from all pixels and no noise
// is added, and for linear between two readings, which no shuffled order needs to hide. Where fewer
// than 30 pixels are of use, it is one number for all wavelengths; with one reading there is none.
class LampDrift {
  public:
    // `wavelength_nm` as many as the pixels of each ratio. A reading without any usable pixel is
    // left out.
    LampDrift(const std::vector<double>& wavelength_nm, std::vector<BeamRatio> readings);

    // Brightness of every pixel at a time, over that of the mean beam; before the first and behind
    // the last reading as there.
    std::vector<double> at(double time_s) const;

    // Of all readings the largest ratio over the smallest, less 1, at the middle wavelength.
    double largest_change() const;

  private:
    struct Node {
        double time_s = 0;
        std::array<double, 3> coefficient{};  // of 1, x, x^2
    };

    std::vector<double> x_;    // of every pixel, -1 to 1 over the spectrum
    std::vector<Node> nodes_;  // ascending in time
};

}  // namespace drude
