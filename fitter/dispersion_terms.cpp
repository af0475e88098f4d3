#include "fitter/dispersion_terms.h"

#include <ceres/jet.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "fitter/kramers_kronig_spline.h"
#include "fitter/named_constants.h"
#include "materials/dispersion.h"
#include "materials/effective_medium.h"

namespace drude {

namespace {

std::vector<double> energies(const Wavelengths& wavelengths_nm) {
    std::vector<double> all;
    for (const double nm : wavelengths_nm) all.push_back(photon_energy(nm));
    return all;
}

// The value and the derivatives of a formula over ceres::Jet.
template <int N, class Formula>
void add_formula(const Formula& formula, const double* parameters, std::complex<double>* epsilon,
                 std::complex<double>* derivatives) {
    using Jet = ceres::Jet<double, N>;
    Jet jets[N];
    for (int j = 0; j < N; ++j) jets[j] = Jet(parameters[j], j);
    const Complex<Jet> value = formula(jets);
    *epsilon += std::complex<double>(value.re.a, value.im.a);
    for (int j = 0; j < N; ++j) derivatives[j] = {value.re.v[j], value.im.v[j]};
}

class Constant : public DispersionTerm {
  public:
    std::vector<DispersionParameter> parameters() const override {
        return {{"eps_inf", "", 1, 100, 1, 6, ParameterRole::linear}};
    }
    void add(size_t, const double* p, std::complex<double>* epsilon,
             std::complex<double>* derivatives) const override {
        *epsilon += p[0];
        derivatives[0] = 1;
    }
};

// A term of N parameters at photon energies.
template <int N>
class EnergyTerm : public DispersionTerm {
  public:
    explicit EnergyTerm(const Wavelengths& wavelengths_nm) : energies_(energies(wavelengths_nm)) {}
    void add(size_t i, const double* p, std::complex<double>* epsilon,
             std::complex<double>* derivatives) const override {
        using Jet = ceres::Jet<double, N>;
        const Jet energy(energies_[i]);
        add_formula<N>([&](const Jet* jets) { return formula(jets, energy); }, p, epsilon,
                       derivatives);
    }

  protected:
    virtual Complex<ceres::Jet<double, N>> formula(const ceres::Jet<double, N>* p,
                                                   const ceres::Jet<double, N>& energy) const = 0;
    // Resonances are sought somewhat beyond the data: their tails reach in.
    double lowest() const { return 0.7 * energies_.back(); }
    double highest() const { return 1.6 * energies_.front(); }

  private:
    std::vector<double> energies_;  // descending, as the wavelengths ascend
};

class FreeElectrons : public EnergyTerm<2> {
  public:
    using EnergyTerm<2>::EnergyTerm;
    std::vector<DispersionParameter> parameters() const override {
        return {{"plasma energy", "eV", 0, 50, 3, 15, ParameterRole::squared},
                {"damping", "eV", 0, 20, 0.02, 1, ParameterRole::nonlinear}};
    }

  protected:
    Complex<ceres::Jet<double, 2>> formula(const ceres::Jet<double, 2>* p,
                                           const ceres::Jet<double, 2>& energy) const override {
        return drude_term(p[0], p[1], energy);
    }
};

class Oscillator : public EnergyTerm<3> {
  public:
    Oscillator(const Wavelengths& wavelengths_nm, int number)
        : EnergyTerm<3>(wavelengths_nm), number_(number) {}
    std::vector<DispersionParameter> parameters() const override {
        return {
            {fmt::format("strength {}", number_), "", 0, 1000, 0.1, 5, ParameterRole::linear},
            {fmt::format("resonance {}", number_), "eV", 0.01, 20, lowest(), highest(),
             ParameterRole::nonlinear},
            {fmt::format("width {}", number_), "eV", 0.01, 20, 0.1, 2, ParameterRole::nonlinear}};
    }

  protected:
    Complex<ceres::Jet<double, 3>> formula(const ceres::Jet<double, 3>* p,
                                           const ceres::Jet<double, 3>& energy) const override {
        return lorentz_term(p[0], p[1], p[2], energy);
    }

  private:
    int number_;
};

class BandEdge : public EnergyTerm<4> {
  public:
    BandEdge(const Wavelengths& wavelengths_nm, int number)
        : EnergyTerm<4>(wavelengths_nm), number_(number) {}
    std::vector<DispersionParameter> parameters() const override {
        return {
            {fmt::format("amplitude {}", number_), "", 0, 1000, 0.1, 3, ParameterRole::linear},
            {fmt::format("critical point {}", number_), "eV", 0.01, 20, lowest(), highest(),
             ParameterRole::nonlinear},
            {fmt::format("width {}", number_), "eV", 0.01, 20, 0.1, 1.5, ParameterRole::nonlinear},
            {fmt::format("phase {}", number_), "rad", -pi, pi, -pi / 2, pi / 4,
             ParameterRole::nonlinear}};
    }

  protected:
    Complex<ceres::Jet<double, 4>> formula(const ceres::Jet<double, 4>* p,
                                           const ceres::Jet<double, 4>& energy) const override {
        return critical_point_term(p[0], p[1], p[2], p[3], energy);
    }

  private:
    int number_;
};

class Cauchy : public DispersionTerm {
  public:
    explicit Cauchy(const Wavelengths& wavelengths_nm) : wavelengths_(wavelengths_nm) {}
    std::vector<DispersionParameter> parameters() const override {
        return {{"A", "", 0.1, 20, 1.2, 4, ParameterRole::nonlinear},
                {"B", "um^2", -10, 10, 0, 0.05, ParameterRole::nonlinear},
                {"C", "um^4", -10, 10, 0, 0.001, ParameterRole::nonlinear}};
    }
    void add(size_t i, const double* p, std::complex<double>* epsilon,
             std::complex<double>* derivatives) const override {
        using Jet = ceres::Jet<double, 3>;
        const auto square = [&](const Jet* jets) {
            const ComplexIndex<Jet> index = cauchy(jets[0], jets[1], jets[2], wavelengths_[i]);
            return Complex<Jet>{index.n * index.n, Jet(0.0)};
        };
        add_formula<3>(square, p, epsilon, derivatives);
    }

  private:
    Wavelengths wavelengths_;
};

class Sellmeier : public DispersionTerm {
  public:
    Sellmeier(const Wavelengths& wavelengths_nm, int count)
        : wavelengths_(wavelengths_nm), count_(count) {}
    std::vector<DispersionParameter> parameters() const override {
        const double below = 1e-3 * wavelengths_.front(), above = 1e-3 * wavelengths_.back();
        std::vector<DispersionParameter> all;
        for (int j = 1; j <= count_; ++j) {
            // The resonances stay out of the data: the last of several above them, others below.
            const bool infrared = j > 1 && j == count_;
            all.push_back({fmt::format("B{}", j), "", 0, 100, 0.2, 3, ParameterRole::linear});
            all.push_back({fmt::format("L{}", j), "um", infrared ? 1.05 * above : 1e-3 * below,
                           infrared ? 100 * above : 0.95 * below,
                           infrared ? 2 * above : 0.2 * below, infrared ? 20 * above : 0.7 * below,
                           ParameterRole::nonlinear});
        }
        return all;
    }
    void add(size_t i, const double* p, std::complex<double>* epsilon,
             std::complex<double>* derivatives) const override {
        *epsilon += 1.0;
        using Jet = ceres::Jet<double, 2>;
        const Jet l(1e-3 * wavelengths_[i]);
        for (int j = 0; j < count_; ++j) {
            add_formula<2>([&](const Jet* jets) { return sellmeier_term(jets[0], jets[1], l); },
                           p + 2 * j, epsilon, derivatives + 2 * j);
        }
    }

  private:
    Wavelengths wavelengths_;
    int count_;
};

class Mixture : public DispersionTerm {
  public:
    Mixture(const Wavelengths& wavelengths_nm, const std::string& a, const std::string& b) {
        const OpticalConstants first = find_constants(a, "--dispersion bruggeman");
        const OpticalConstants second = find_constants(b, "--dispersion bruggeman");
        for (const OpticalConstants* constants : {&first, &second}) {
            const std::string warning =
                constants->range_warning(wavelengths_nm.front(), wavelengths_nm.back());
            if (!warning.empty()) {
                user_error("--dispersion bruggeman: {}; expected constants of every wavelength",
                           warning);
            }
        }
        for (const double nm : wavelengths_nm) {
            a_.push_back(first.at(nm));
            b_.push_back(second.at(nm));
        }
        name_ = "fraction of " + second.name;
    }
    std::vector<DispersionParameter> parameters() const override {
        return {{name_, "", 0, 1, 0, 1, ParameterRole::nonlinear}};
    }
    void add(size_t i, const double* p, std::complex<double>* epsilon,
             std::complex<double>* derivatives) const override {
        using Jet = ceres::Jet<double, 1>;
        const auto square = [&](const Jet* jets) {
            const ComplexIndex<Jet> mixed =
                bruggeman(ComplexIndex<Jet>{Jet(a_[i].n), Jet(a_[i].k)},
                          ComplexIndex<Jet>{Jet(b_[i].n), Jet(b_[i].k)}, jets[0]);
            return Complex<Jet>{(mixed.n - mixed.k) * (mixed.n + mixed.k),
                                Jet(2.0) * mixed.n * mixed.k};
        };
        add_formula<1>(square, p, epsilon, derivatives);
    }

  private:
    std::vector<Index> a_, b_;
    std::string name_;
};

class Spline : public DispersionTerm {
  public:
    Spline(const Wavelengths& wavelengths_nm, int intervals) : energies_(energies(wavelengths_nm)) {
        const KramersKronigSpline spline(energies_.back(), energies_.front(), intervals);
        count_ = spline.count();
        for (const double energy : energies_) {
            for (int i = 0; i < count_; ++i) functions_.push_back(spline.function(i, energy));
        }
    }
    std::vector<DispersionParameter> parameters() const override {
        const double last = energies_.front();
        std::vector<DispersionParameter> all = {
            {"pole", "", 0, 1000, 0.1, 3, ParameterRole::linear},
            {"pole energy", "eV", 1.02 * last, 30 * last, 1.1 * last, 2.5 * last,
             ParameterRole::nonlinear}};
        for (int i = 1; i <= count_; ++i) {
            all.push_back({fmt::format("c{}", i), "", 0, 1e4, 0.1, 5, ParameterRole::linear});
        }
        return all;
    }
    void add(size_t i, const double* p, std::complex<double>* epsilon,
             std::complex<double>* derivatives) const override {
        using Jet = ceres::Jet<double, 2>;
        // What absorbs beyond the data, as one line without width.
        const auto pole = [&](const Jet* jets) {
            return lorentz_term(jets[0], jets[1], Jet(0.0), Jet(energies_[i]));
        };
        add_formula<2>(pole, p, epsilon, derivatives);
        const size_t width = static_cast<size_t>(count_);
        for (size_t j = 0; j < width; ++j) {
            derivatives[2 + j] = functions_[i * width + j];
            *epsilon += p[2 + j] * derivatives[2 + j];
        }
    }

  private:
    std::vector<double> energies_;
    int count_ = 0;
    std::vector<std::complex<double>> functions_;  // wavelengths x splines
};

}  // namespace

std::unique_ptr<DispersionTerm> constant_term() {
    return std::make_unique<Constant>();
}

std::unique_ptr<DispersionTerm> free_electron_term(const Wavelengths& wavelengths_nm) {
    return std::make_unique<FreeElectrons>(wavelengths_nm);
}

std::unique_ptr<DispersionTerm> oscillator_term(const Wavelengths& wavelengths_nm, int number) {
    return std::make_unique<Oscillator>(wavelengths_nm, number);
}

std::unique_ptr<DispersionTerm> band_edge_term(const Wavelengths& wavelengths_nm, int number) {
    return std::make_unique<BandEdge>(wavelengths_nm, number);
}

std::unique_ptr<DispersionTerm> cauchy_formula(const Wavelengths& wavelengths_nm) {
    return std::make_unique<Cauchy>(wavelengths_nm);
}

std::unique_ptr<DispersionTerm> sellmeier_formula(const Wavelengths& wavelengths_nm, int count) {
    return std::make_unique<Sellmeier>(wavelengths_nm, count);
}

std::unique_ptr<DispersionTerm> mixture_formula(const Wavelengths& wavelengths_nm,
                                                const std::string& a, const std::string& b) {
    return std::make_unique<Mixture>(wavelengths_nm, a, b);
}

std::unique_ptr<DispersionTerm> spline_term(const Wavelengths& wavelengths_nm, int intervals) {
    return std::make_unique<Spline>(wavelengths_nm, intervals);
}

}  // namespace drude
