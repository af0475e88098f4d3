// A porous film on a known substrate: its residuals as a function of thickness, porosity, a common
// error of the angle of incidence, a spread of the thickness, and roughness.
#pragma once

#include <vector>

#include "fitter/point_fit.h"
#include "fitter/residuals.h"
#include "materials/effective_medium.h"
#include "materials/film_average.h"

namespace drude {

// Where the slit of the spectrometer looks: a wavelength about the nominal one, its share of the
// light, and the constants there.
struct BandNode {
    double wavelength_nm = 0, weight = 1;
    Index substrate, material;
};

// A film may be uneven, rough and seen through a slit. What is averaged are the intensities, so
// that the light is partly depolarised; Psi and Delta are then those that an ellipsometer with a
// turning polariser and a retarder reads: tan^2 Psi = Rp/Rs, and Delta the phase of the mean of rp
// conj(rs).
struct FilmProblem {
    std::vector<WavelengthData> groups;
    std::vector<std::vector<BandNode>> bands;    // of every group; one node for a narrow slit
    Estimator estimator = Estimator::psi_delta;  // not inversion
    // Deviations of the thickness in units of the spread, and how often they occur; one node for
    // an even film.
    std::vector<double> spread_nodes = {0}, spread_weights = {1};
    bool rough = false;  // is there a layer of half film, half void on top?

    const BandNode& centre(size_t wavelength) const {
        return bands[wavelength][bands[wavelength].size() / 2];
    }
    int residuals_per_point() const { return estimator == Estimator::rho2 ? 1 : 2; }
    int residual_count() const {
        int count = 0;
        for (const WavelengthData& group : groups) {
            count += residuals_per_point() * static_cast<int>(group.points.size());
        }
        return count;
    }
};

// Does a datum take more than one reflection?
inline bool is_averaged(const FilmProblem& problem) {
    return problem.spread_nodes.size() > 1 || problem.bands.front().size() > 1;
}

// The parameters: lengths in nm, the offset of the angles of incidence in radians. `spread` is the
// standard deviation of the thickness over the beam (Gaussian), `roughness` the thickness of the
// layer that stands for it.
template <class T>
struct FilmParameters {
    T thickness, porosity, offset, spread, roughness;
};

// The film's own index: the dense material with the volume fraction `porosity` of empty pores.
template <class T>
ComplexIndex<T> film_index(const Index& material, const T& porosity) {
    return bruggeman(ComplexIndex<T>{T(material.n), T(material.k)}, ComplexIndex<T>{T(1.0), T(0.0)},
                     porosity);
}

// One reflection at a node of the band, the film being `thickness` nm thick.
template <class T>
Reflection<T> film_reflection(const FilmProblem& problem, const BandNode& node,
                              const ComplexIndex<T>& index, const T& thickness, const T& roughness,
                              const T& cos_theta) {
    const ComplexIndex<T> substrate{T(node.substrate.n), T(node.substrate.k)};
    const T wavelength(node.wavelength_nm);
    if (!problem.rough) {
        const ThinFilm<T> film{index, thickness};
        return reflect(&film, 1, substrate, cos_theta, wavelength);
    }
    const ComplexIndex<T> half =
        bruggeman(index, ComplexIndex<T>{T(1.0), T(0.0)}, T(roughness_void));
    const ThinFilm<T> films[] = {{half, roughness}, {index, thickness}};
    return reflect(films, 2, substrate, cos_theta, wavelength);
}

// Averaged over the slit and the thicknesses; `indices` are the film's at the nodes of the slit.
template <class T>
Reflection<T> average_reflection(const FilmProblem& problem, size_t wavelength,
                                 const ComplexIndex<T>* indices, const FilmParameters<T>& p,
                                 const T& cos_theta) {
    using std::sqrt;
    const std::vector<BandNode>& band = problem.bands[wavelength];
    if (!is_averaged(problem)) {
        return film_reflection(problem, band[0], indices[0], p.thickness, p.roughness, cos_theta);
    }
    Reflection<T> sum{T(0.0), T(0.0), T(0.0), T(0.0)};
    for (size_t n = 0; n < band.size(); ++n) {
        const BandNode& node = band[n];
        for (size_t i = 0; i < problem.spread_nodes.size(); ++i) {
            const T thickness = p.thickness + T(problem.spread_nodes[i]) * p.spread;
            // No film is thinner than nothing.
            const T positive = select(thickness < T(0.0), T(0.0), thickness);
            const Reflection<T> r =
                film_reflection(problem, node, indices[n], positive, p.roughness, cos_theta);
            add_weighted(r, T(node.weight * problem.spread_weights[i]), &sum);
        }
    }
    // Psi and Delta of pure light with the same two angles.
    const T length2 = sum.C * sum.C + sum.S * sum.S;
    if (length2 > T(1e-30)) {
        const T scale = sqrt(sum.Rs * sum.Rp / length2);
        sum.C = sum.C * scale;
        sum.S = sum.S * scale;
    }
    return sum;
}

// The residuals of one wavelength. False where nothing is reflected.
template <class T>
bool film_residuals(const FilmProblem& problem, size_t wavelength, const FilmParameters<T>& p,
                    T* residuals) {
    using std::cos;
    using std::sin;
    // What a mixture costs is paid once for all angles.
    const std::vector<BandNode>& band = problem.bands[wavelength];
    const ComplexIndex<T> single = film_index(band[0].material, p.porosity);
    std::vector<ComplexIndex<T>> several;
    for (size_t n = 0; n < band.size() && band.size() > 1; ++n) {
        several.push_back(film_index(band[n].material, p.porosity));
    }
    const ComplexIndex<T>* const indices = several.empty() ? &single : several.data();
    const T cos_offset = cos(p.offset), sin_offset = sin(p.offset);
    for (const AnglePoint& point : problem.groups[wavelength].points) {
        const T cos_theta = T(point.cos_theta) * cos_offset - T(point.sin_theta) * sin_offset;
        const Reflection<T> model = average_reflection(problem, wavelength, indices, p, cos_theta);
        const bool reflects = problem.estimator == Estimator::rho2
                                  ? rho2_residual(point, model, residuals)
                                  : psi_delta_residuals(point, model, residuals);
        if (!reflects) return false;
        residuals += problem.residuals_per_point();
    }
    return true;
}

// All of them.
template <class T>
bool film_residuals(const FilmProblem& problem, const FilmParameters<T>& p, T* residuals) {
    for (size_t i = 0; i < problem.groups.size(); ++i) {
        if (!film_residuals(problem, i, p, residuals)) return false;
        residuals +=
            static_cast<size_t>(problem.residuals_per_point()) * problem.groups[i].points.size();
    }
    return true;
}

// As Ceres differentiates them: parameters of one number each, no more than are in use.
struct FilmResiduals {
    const FilmProblem* problem;

    template <class T>
    bool operator()(const T* thickness, const T* porosity, T* residuals) const {
        return film_residuals(
            *problem, FilmParameters<T>{*thickness, *porosity, T(0.0), T(0.0), T(0.0)}, residuals);
    }

    template <class T>
    bool operator()(const T* thickness, const T* porosity, const T* offset, T* residuals) const {
        return film_residuals(
            *problem, FilmParameters<T>{*thickness, *porosity, *offset, T(0.0), T(0.0)}, residuals);
    }
    template <class T>
    bool operator()(const T* thickness, const T* porosity, const T* offset, const T* spread,
                    const T* roughness, T* residuals) const {
        return film_residuals(
            *problem, FilmParameters<T>{*thickness, *porosity, *offset, *spread, *roughness},
            residuals);
    }
};

}  // namespace drude
