// Which wavelengths a path carries, and tables laid out for them.
//
// N wavelengths, equally spaced over the film's 400 nm, on the 1 nm grid: lane i of phase p is
// 380 + p + i * spacing nanometres. The phase is random; every table is stored phase by phase, so
// that a path's values are one contiguous load.
#pragma once

#include <vector>

#include "materials/packet.h"
#include "materials/spectrum.h"

namespace drude {

template <int N>
struct Wavelengths {
    static_assert(spectrum_integral_size % N == 0);
    static constexpr int spacing = spectrum_integral_size / N;  // nm, and the number of phases

    static int phase(float u) {
        const int p = static_cast<int>(u * spacing);
        return p < spacing ? p : spacing - 1;
    }
    static int nanometres(int phase, int lane) {
        return spectrum_first_nm + phase + lane * spacing;
    }
};

template <int N>
class PackedSpectrum {
  public:
    PackedSpectrum() = default;
    explicit PackedSpectrum(const DenseSpectrum& dense) : values_(spectrum_integral_size) {
        for (int p = 0; p < Wavelengths<N>::spacing; ++p) {
            for (int lane = 0; lane < N; ++lane) {
                values_[p * N + lane] =
                    static_cast<float>(dense[p + lane * Wavelengths<N>::spacing]);
            }
        }
    }
    Packet<N> operator[](int phase) const { return Packet<N>::load(&values_[phase * N]); }

  private:
    std::vector<float> values_;
};

}  // namespace drude
