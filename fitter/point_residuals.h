// All residuals of one wavelength as a function of n and k, and of an error of the angles.
#pragma once

#include <vector>

#include "fitter/point_fit.h"
#include "fitter/residuals.h"
#include "materials/effective_medium.h"

namespace drude {

struct PointResiduals {
    const WavelengthData* data;
    Estimator estimator;

    int count() const {
        const int points = static_cast<int>(data->points.size());
        return estimator == Estimator::rho2 ? points : 2 * points;
    }

    // At the angles of the data.
    template <class T>
    bool operator()(const T* index, T* residuals) const {
        return evaluate(
            index, [](const AnglePoint& point) { return T(point.cos_theta); }, residuals);
    }

    // `offset` in radians is added to every angle of incidence.
    template <class T>
    bool operator()(const T* index, const T* offset, T* residuals) const {
        using std::cos;
        using std::sin;
        const T cos_offset = cos(*offset), sin_offset = sin(*offset);
        const auto cos_theta = [&](const AnglePoint& point) {
            return T(point.cos_theta) * cos_offset - T(point.sin_theta) * sin_offset;
        };
        return evaluate(index, cos_theta, residuals);
    }

  private:
    template <class T, class CosTheta>
    bool evaluate(const T* index, const CosTheta& cos_theta, T* residuals) const {
        const ComplexIndex<T> nk{index[0], index[1]};
        std::vector<ThinFilm<T>> layers;
        for (const ThinFilm<double>& layer : data->layers) {
            layers.push_back({{T(layer.index.n), T(layer.index.k)}, T(layer.thickness)});
        }
        if (data->roughness_nm > 0) {
            const ComplexIndex<T> half =
                bruggeman(nk, ComplexIndex<T>{T(1.0), T(0.0)}, T(roughness_void));
            layers.push_back({half, T(data->roughness_nm)});
        }
        for (const AnglePoint& point : data->points) {
            const Reflection<T> model = reflect(layers.data(), static_cast<int>(layers.size()), nk,
                                                cos_theta(point), T(data->wavelength_nm));
            if (estimator == Estimator::rho2) {
                if (!rho2_residual(point, model, residuals)) return false;
                residuals += 1;
            } else {
                if (!psi_delta_residuals(point, model, residuals)) return false;
                residuals += 2;
            }
        }
        return true;
    }
};

}  // namespace drude
