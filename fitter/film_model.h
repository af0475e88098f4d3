// A porous film on a known substrate: its residuals as a function of thickness, porosity and a
// common error of the angle of incidence.
#pragma once

#include <vector>

#include "fitter/point_fit.h"
#include "fitter/residuals.h"
#include "materials/effective_medium.h"

namespace drude {

// `substrate` and `material` hold one index for every wavelength of `groups`.
struct FilmProblem {
    std::vector<WavelengthData> groups;
    std::vector<Index> substrate, material;
    Estimator estimator = Estimator::psi_delta;  // not inversion

    int residuals_per_point() const { return estimator == Estimator::rho2 ? 1 : 2; }
    int residual_count() const {
        int count = 0;
        for (const WavelengthData& group : groups) {
            count += residuals_per_point() * static_cast<int>(group.points.size());
        }
        return count;
    }
};

// The film's own index: the dense material with the volume fraction `porosity` of empty pores.
template <class T>
ComplexIndex<T> film_index(const Index& material, const T& porosity) {
    return bruggeman(ComplexIndex<T>{T(material.n), T(material.k)}, ComplexIndex<T>{T(1.0), T(0.0)},
                     porosity);
}

// The residuals of one wavelength. `offset` in radians is added to every angle of incidence. False
// where nothing is reflected.
template <class T>
bool film_residuals(const FilmProblem& problem, size_t wavelength, const T& thickness_nm,
                    const T& porosity, const T& offset, T* residuals) {
    using std::cos;
    using std::sin;
    const WavelengthData& group = problem.groups[wavelength];
    const Index& below = problem.substrate[wavelength];
    const ThinFilm<T> film{film_index(problem.material[wavelength], porosity), thickness_nm};
    const ComplexIndex<T> substrate{T(below.n), T(below.k)};
    const T cos_offset = cos(offset), sin_offset = sin(offset);
    for (const AnglePoint& point : group.points) {
        const T cos_theta = T(point.cos_theta) * cos_offset - T(point.sin_theta) * sin_offset;
        const Reflection<T> model = reflect(&film, 1, substrate, cos_theta, T(group.wavelength_nm));
        const bool reflects = problem.estimator == Estimator::rho2
                                  ? rho2_residual(point, model, residuals)
                                  : psi_delta_residuals(point, model, residuals);
        if (!reflects) return false;
        residuals += problem.residuals_per_point();
    }
    return true;
}

// Parameters of one number each, as Ceres differentiates them; without the offset at the angles of
// the data.
struct FilmResiduals {
    const FilmProblem* problem;

    template <class T>
    bool operator()(const T* thickness_nm, const T* porosity, T* residuals) const {
        const T offset(0.0);
        return (*this)(thickness_nm, porosity, &offset, residuals);
    }

    template <class T>
    bool operator()(const T* thickness_nm, const T* porosity, const T* offset, T* residuals) const {
        for (size_t i = 0; i < problem->groups.size(); ++i) {
            if (!film_residuals(*problem, i, *thickness_nm, *porosity, *offset, residuals)) {
                return false;
            }
            residuals += static_cast<size_t>(problem->residuals_per_point()) *
                         problem->groups[i].points.size();
        }
        return true;
    }
};

}  // namespace drude
