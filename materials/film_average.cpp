#include "materials/film_average.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "materials/film_stack.h"
#include "materials/quadrature.h"

namespace drude {

// The trapezoidal rule for a Gaussian of standard deviation 1: with steps h the average of
// exp(i phase x) is wrong by exp(-(2 pi/h - phase)^2/2), which is spectrally small.
AverageNodes gaussian_nodes(double phase, int harmonics) {
    constexpr double reach = 4.5;  // 7e-6 of it lies beyond
    const int half = static_cast<int>(std::ceil(reach * (harmonics * phase + 5) / (2 * pi)));
    AverageNodes nodes;
    double sum = 0;
    for (int i = -half; i <= half; ++i) {
        const double x = reach * i / half;
        nodes.x.push_back(x);
        nodes.weight.push_back(std::exp(-0.5 * x * x));
        sum += nodes.weight.back();
    }
    for (double& weight : nodes.weight) weight /= sum;
    return nodes;
}

// With n nodes of Gauss-Legendre exp(i a x) is averaged to about (e a / 4n)^2n / 2: below 1e-4 here
// for the highest harmonic, a = harmonics * phase.
AverageNodes uniform_nodes(double phase, int harmonics) {
    const int n = static_cast<int>(std::ceil(0.7 * harmonics * std::abs(phase))) + 2;
    AverageNodes nodes = gauss_legendre(n);
    for (double& weight : nodes.weight) weight /= 2;
    return nodes;
}

namespace {

Index held(const OpticalConstants& constants, double centre, double nm) {
    // A slit at the end of a table looks beyond it.
    return constants.at(constants.covers(centre, centre)
                            ? std::clamp(nm, constants.first_nm(), constants.last_nm())
                            : centre);
}

// r_s and r_p at one interface; q and eps of the media above and below it.
Amplitudes<double> interface_amplitudes(const Complex<double>& q1, const Complex<double>& eps1,
                                        const Complex<double>& q2, const Complex<double>& eps2) {
    const Complex<double> p1 = eps2 * q1, p2 = eps1 * q2;
    return {(q1 - q2) / (q1 + q2), (p1 - p2) / (p1 + p2)};
}

}  // namespace

int film_harmonics(const Material& material, double wavelength_nm, double cos_theta) {
    Complex<double> q{cos_theta, 0}, eps{1, 0};
    // A cavity between the strongest of the upper interfaces and the substrate.
    double above = 0, below = 0;
    for (size_t j = 0; j <= material.layers.size(); ++j) {
        const bool is_substrate = j == material.layers.size();
        const Index index =
            (is_substrate ? material.substrate : material.layers[j].constants).at(wavelength_nm);
        const ComplexIndex<double> next{index.n, index.k};
        const Complex<double> q_next = normal_component(next, cos_theta);
        const Complex<double> eps_next = film_detail::squared(next);
        const Amplitudes<double> r = interface_amplitudes(q, eps, q_next, eps_next);
        const double strongest = std::sqrt(std::max(norm(r.s), norm(r.p)));
        (is_substrate ? below : above) = is_substrate ? strongest : std::max(above, strongest);
        if (material.layers.size() == 1 && !is_substrate) {
            above *=
                std::exp(-4 * pi * q_next.im * material.layers[j].thickness_nm / wavelength_nm);
        }
        q = q_next;
        eps = eps_next;
    }
    const double each = std::clamp(above * below, 1e-3, 0.999);
    const double count = std::ceil(std::log(3e-4) / std::log(each));
    return static_cast<int>(std::clamp(count, 2.0, static_cast<double>(most_harmonics)));
}

std::vector<FilmSample> film_samples(const Material& material, double wavelength_nm,
                                     double width_nm, int harmonics) {
    const size_t count = material.layers.size();
    FilmSample even;
    even.wavelength_nm = wavelength_nm;
    even.substrate = material.substrate.at(wavelength_nm);
    struct Uneven {
        size_t layer;
        double sigma_nm, phase;
    };
    std::vector<Uneven> uneven;
    // What the phase of the other layers changes by over half the width.
    double shift = 0;
    for (size_t j = 0; j < count; ++j) {
        const FilmLayer& layer = material.layers[j];
        const Index index = layer.constants.at(wavelength_nm);
        even.layers.push_back(index);
        even.thickness_nm.push_back(layer.thickness_nm);
        const double turn = 4 * pi * index.n / wavelength_nm;  // radians a nm
        // A fifth more by dispersion.
        const double own = turn * layer.thickness_nm * 1.2 * width_nm / 2 / wavelength_nm;
        double phase = std::min(layer.thickness_spread_nm * turn, largest_phase_spread);
        if (own > 6 * pi) {
            phase = largest_phase_spread;
        } else if (3 * own < phase) {
            // The variance of the uniform distribution; without the allowance for dispersion.
            phase = std::min(std::hypot(phase, own / 1.2 / std::sqrt(3.0)), largest_phase_spread);
        } else {
            shift += own;
        }
        if (phase > 0) uneven.push_back({j, phase / turn, phase});
    }
    if (uneven.size() > 2) {
        user_error(
            "{}: {} of its films are uneven, or too thick for fringes at {} nm; at most two are "
            "averaged over",
            material.name, uneven.size(), wavelength_nm);
    }
    std::vector<FilmSample> samples{even};
    for (const Uneven& one : uneven) {
        const AverageNodes nodes = gaussian_nodes(one.phase, harmonics);
        std::vector<FilmSample> finer;
        for (const FilmSample& sample : samples) {
            for (size_t i = 0; i < nodes.x.size(); ++i) {
                finer.push_back(sample);
                double& thickness = finer.back().thickness_nm[one.layer];
                thickness = std::max(0.0, thickness + nodes.x[i] * one.sigma_nm);
                finer.back().weight *= nodes.weight[i];
            }
        }
        samples = std::move(finer);
    }
    if (!(shift > 0)) return samples;

    const AverageNodes nodes = uniform_nodes(shift, harmonics);
    std::vector<FilmSample> all;
    for (size_t i = 0; i < nodes.x.size(); ++i) {
        const double nm = wavelength_nm + nodes.x[i] * width_nm / 2;
        FilmSample slit = even;
        slit.wavelength_nm = nm;
        slit.substrate = held(material.substrate, wavelength_nm, nm);
        for (size_t j = 0; j < count; ++j) {
            slit.layers[j] = held(material.layers[j].constants, wavelength_nm, nm);
        }
        for (const FilmSample& sample : samples) {
            slit.thickness_nm = sample.thickness_nm;
            slit.weight = sample.weight * nodes.weight[i];
            all.push_back(slit);
        }
    }
    return all;
}

}  // namespace drude
