// The operations that the optics needs of its scalar, for double, float and ceres::Jet. A float
// packet (packet.h) brings its own overloads; argument-dependent lookup finds those of a Jet.
#pragma once

#include <cmath>

namespace drude {

inline constexpr double pi = 3.14159265358979323846;
inline constexpr double degree = pi / 180;  // in radians

// a where the condition holds, b elsewhere; both are evaluated.
template <class T>
T select(bool condition, const T& a, const T& b) {
    return condition ? a : b;
}

// sin and cos of 2 pi `turns`. A film of some micrometres turns the phase hundreds of radians;
// in turns the whole ones fall away before they cost digits.
template <class T>
void sincos_turns(const T& turns, T* sine, T* cosine) {
    using std::cos;
    using std::floor;
    using std::sin;
    const T angle = T(2 * pi) * (turns - floor(turns + T(0.5)));
    *sine = sin(angle);
    *cosine = cos(angle);
}

}  // namespace drude
