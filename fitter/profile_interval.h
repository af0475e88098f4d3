// Intervals of a profile of chi-square, and the search for a smallest value along a line.
#pragma once

#include <array>
#include <functional>

namespace drude {

// Where chi-square, smallest over all other parameters, has risen by 1 (68.3 % for one normal
// parameter) and by 3.84 (95 %).
inline constexpr std::array<double, 2> profile_rises = {1, 3.841458820694124};

// NaN where that side is open: chi-square never rises so far before the parameter's bound.
struct ProfileInterval {
    double lower = 0, upper = 0;
};

// Smallest chi-square over the other parameters with this one held at the argument; infinite or NaN
// where there is none. Called with arguments that leave `value` step by step, so that a function
// may start from where it ended before.
using HeldChi2 = std::function<double(double)>;

struct Profile {
    std::array<ProfileInterval, 2> intervals;  // at profile_rises
    double deepest = 0;  // how far below `smallest` the function went; 0 where it never did
};

// `value`: the parameter at `smallest`. `sigma`: a first guess of the distance at a rise of 1,
// anything where it is not known. `lower` <= `value` <= `upper` are the parameter's bounds. The
// ends are good to 1e-4 of their distance from `value`.
Profile profile_of(const HeldChi2& held, double value, double smallest, double sigma, double lower,
                   double upper);

// Where `function` is smallest in [low, high], by Brent's method of golden section and parabolas
// (Algorithms for Minimization without Derivatives, 1973, chapter 5), and its value there.
struct LineMinimum {
    double at = 0, value = 0;
};
LineMinimum minimise_on_line(const std::function<double(double)>& function, double low, double high,
                             double tolerance);

}  // namespace drude
