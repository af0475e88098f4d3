// What a Fresnel method gets wrong on a metal.
#include <algorithm>
#include <cmath>

#include "bench/charts/fresnel_chart.h"
#include "bench/charts/sphere_picture.h"

namespace drude {

FresnelError fresnel_error(const FresnelMethod& method, const DenseIndex& metal) {
    std::vector<double> values(static_cast<size_t>(spectrum_integral_size) * sphere_rings);
    std::vector<double> truths(values.size());
    FresnelError error;
    double squares = 0, psi_squares = 0;
    for (int ring = 0; ring < sphere_rings; ++ring) {
        const double cosine = ring_cosine(ring);
        for (int phase = 0; phase < FresnelWavelengths::spacing; ++phase) {
            const auto cosine_f = static_cast<float>(cosine);
            const FresnelPacket A = method.reflectance(cosine_f, phase);
            ReflectancePair<FresnelPacket> pair{A, A};
            if (method.pair) pair = method.pair(cosine_f, phase);
            for (int lane = 0; lane < 8; ++lane) {
                const int i = phase + lane * FresnelWavelengths::spacing;
                const Reflection<double> exact = reflect(index_at(metal, i), cosine);
                const auto at =
                    static_cast<size_t>(ring) * spectrum_integral_size + static_cast<size_t>(i);
                values[at] = static_cast<double>(A[lane]);
                truths[at] = exact.A();
                const double difference = std::abs(values[at] - truths[at]);
                squares += difference * difference;
                if (difference > error.worst) {
                    error.worst = difference;
                    error.worst_angle_deg = std::acos(cosine) / degree;
                }
                const double psi_deg = std::atan2(std::sqrt(static_cast<double>(pair.Rp[lane])),
                                                  std::sqrt(static_cast<double>(pair.Rs[lane]))) /
                                       degree;
                psi_squares += std::pow(psi_deg - psi(exact) / degree, 2);
            }
        }
    }
    const auto count = static_cast<double>(values.size());
    error.rms = std::sqrt(squares / count);
    error.rms_psi_deg = std::sqrt(psi_squares / count);
    const auto picture_of = [](const std::vector<double>& of) {
        return sphere_picture([&](int i, int ring) {
            return of[static_cast<size_t>(ring) * spectrum_integral_size + static_cast<size_t>(i)];
        });
    };
    const PictureError picture = picture_error(picture_of(values), picture_of(truths));
    error.mean_delta_e = picture.mean_delta_e;
    error.worst_delta_e = picture.worst_delta_e;
    error.relative_rmse = picture.relative_rmse;
    return error;
}

}  // namespace drude
