#include "fitter/refractiveindex_formula.h"

#include <cmath>
#include <limits>

namespace drude {

namespace {

// The coefficients, counted from 1 as in the formulae, and zero beyond their end.
class Coefficients {
  public:
    explicit Coefficients(const std::vector<double>& values) : values_(values) {}
    double operator()(size_t i) const { return i <= values_.size() ? values_[i - 1] : 0; }
    // Sum over the pairs (c_i, c_{i+1}) from i = first on.
    template <class Term>
    double pairs(size_t first, const Term& term) const {
        double sum = 0;
        for (size_t i = first; i <= values_.size(); i += 2) {
            // Unused terms are padded with zeros; theirs may be 0/0.
            if ((*this)(i) != 0) sum += term((*this)(i), (*this)(i + 1));
        }
        return sum;
    }

  private:
    const std::vector<double>& values_;
};

// c L^a/(L^2 - b^e), nothing where the term is absent.
double resonance(double c, double a, double b, double e, double wavelength) {
    if (c == 0) return 0;
    return c * std::pow(wavelength, a) / (wavelength * wavelength - std::pow(b, e));
}

}  // namespace

size_t most_coefficients(int formula) {
    if (formula == 7 || formula == 9) return 6;
    if (formula == 8) return 4;
    return 99;
}

double refractiveindex_formula(int formula, const std::vector<double>& coefficients,
                               double wavelength_um) {
    const Coefficients c(coefficients);
    const double l = wavelength_um, l2 = l * l;
    const auto power = [&](double factor, double exponent) {
        return factor * std::pow(l, exponent);
    };
    switch (formula) {
        case 1:
            return std::sqrt(1 + c(1) + c.pairs(2, [&](double b, double pole) {
                return b * l2 / (l2 - pole * pole);
            }));
        case 2:
            return std::sqrt(
                1 + c(1) + c.pairs(2, [&](double b, double pole) { return b * l2 / (l2 - pole); }));
        case 3:
            return std::sqrt(c(1) + c.pairs(2, power));
        case 4:
            return std::sqrt(c(1) + resonance(c(2), c(3), c(4), c(5), l) +
                             resonance(c(6), c(7), c(8), c(9), l) + c.pairs(10, power));
        case 5:
            return c(1) + c.pairs(2, power);
        case 6:
            return 1 + c(1) +
                   c.pairs(2, [&](double b, double pole) { return b / (pole - 1 / l2); });
        case 7: {
            const double h = 1 / (l2 - 0.028);
            return c(1) + c(2) * h + c(3) * h * h + c(4) * l2 + c(5) * l2 * l2 +
                   c(6) * l2 * l2 * l2;
        }
        case 8: {
            const double x = c(1) + (c(2) != 0 ? c(2) * l2 / (l2 - c(3)) : 0.0) + c(4) * l2;
            return std::sqrt((1 + 2 * x) / (1 - x));
        }
        case 9: {
            const double d = l - c(5);
            return std::sqrt(c(1) + (c(2) != 0 ? c(2) / (l2 - c(3)) : 0.0) +
                             (c(4) != 0 ? c(4) * d / (d * d + c(6)) : 0.0));
        }
        default:
            return std::numeric_limits<double>::quiet_NaN();
    }
}

}  // namespace drude
