#include "fitter/dispersion_model.h"

#include <cctype>
#include <cmath>

#include "base/error.h"
#include "base/numbers.h"
#include "fitter/dispersion_terms.h"

namespace drude {

namespace {

[[noreturn]] void refuse(const std::string& name, const std::string& part) {
    size_t letters = 0;
    while (letters < part.size() && std::isdigit(static_cast<unsigned char>(part[letters]))) {
        ++letters;
    }
    user_error(
        "found the dispersion '{}'{}, expected a sum such as drude+2cp, drude+3lorentz or "
        "2lorentz, or one of cauchy, sellmeier, 2sellmeier, 3sellmeier, bruggeman:A,B, spline:N",
        name, did_you_mean(part.substr(letters), dispersion_words()));
}

// "3lorentz" as 3 and "lorentz"; 1 where there is no number.
struct Counted {
    int count = 1;
    std::string word;
};

Counted parse_counted(const std::string& name, const std::string& part) {
    size_t digits = 0;
    while (digits < part.size() && std::isdigit(static_cast<unsigned char>(part[digits]))) ++digits;
    Counted counted;
    counted.word = part.substr(digits);
    if (digits > 0) {
        const auto number = parse_unsigned(std::string_view(part).substr(0, digits));
        if (!number || *number < 1 || *number > 99) refuse(name, part);
        counted.count = static_cast<int>(*number);
    }
    return counted;
}

void check_count(const std::string& name, const Counted& found, int most) {
    if (found.count > most) {
        user_error(
            "found {} times '{}' in the dispersion '{}', expected at most {}: more than "
            "spectra determine",
            found.count, found.word, name, most);
    }
}

std::vector<std::string> split(const std::string& text, char separator) {
    std::vector<std::string> parts;
    size_t from = 0;
    while (true) {
        const size_t to = text.find(separator, from);
        parts.push_back(text.substr(from, to == std::string::npos ? to : to - from));
        if (to == std::string::npos) return parts;
        from = to + 1;
    }
}

void add_sum(const std::string& name, const Wavelengths& wavelengths, DispersionTerms* terms,
             int* resonances) {
    terms->push_back(constant_term());
    int drudes = 0, oscillators = 0, edges = 0;
    for (const std::string& part : split(name, '+')) {
        const Counted found = parse_counted(name, part);
        if (found.word == "drude") {
            check_count(name, found, 1);
            if (++drudes > 1) refuse(name, part);
            terms->push_back(free_electron_term(wavelengths));
        } else if (found.word == "lorentz") {
            check_count(name, found, 6);
            if (oscillators > 0) refuse(name, part);
            for (int i = 0; i < found.count; ++i) {
                terms->push_back(oscillator_term(wavelengths, ++oscillators));
            }
        } else if (found.word == "cp") {
            check_count(name, found, 4);
            if (edges > 0) refuse(name, part);
            for (int i = 0; i < found.count; ++i) {
                terms->push_back(band_edge_term(wavelengths, oscillators + ++edges));
            }
        } else {
            refuse(name, part);
        }
    }
    *resonances = oscillators + edges;
}

bool starts_with(const std::string& text, std::string_view word) {
    return text.compare(0, word.size(), word) == 0;
}

void add_spline(const std::string& name, const Wavelengths& wavelengths, DispersionTerms* terms) {
    const auto intervals = parse_unsigned(std::string_view(name).substr(7));
    if (!intervals || *intervals < 1 || *intervals > most_spline_intervals) {
        user_error("found the dispersion '{}', expected spline:N with N from 1 to {} intervals",
                   name, most_spline_intervals);
    }
    terms->push_back(constant_term());
    terms->push_back(free_electron_term(wavelengths));
    terms->push_back(spline_term(wavelengths, static_cast<int>(*intervals)));
}

void add_mixture(const std::string& name, const Wavelengths& wavelengths, DispersionTerms* terms) {
    const std::vector<std::string> names = split(name.substr(10), ',');
    if (names.size() != 2 || names[0].empty() || names[1].empty()) {
        user_error("found the dispersion '{}', expected two materials: bruggeman:Au,Ag", name);
    }
    terms->push_back(mixture_formula(wavelengths, names[0], names[1]));
}

}  // namespace

const std::vector<std::string>& dispersion_words() {
    static const std::vector<std::string> words = {"drude",     "lorentz",   "cp",    "cauchy",
                                                   "sellmeier", "bruggeman", "spline"};
    return words;
}

DispersionModel::DispersionModel(const std::string& name, const Wavelengths& wavelengths)
    : name_(name) {
    if (name == "cauchy") {
        terms_.push_back(cauchy_formula(wavelengths));
        starts_ = 8;
    } else if (name.size() <= 10 && name.ends_with("sellmeier")) {
        const Counted found = parse_counted(name, name);
        if (found.word != "sellmeier") refuse(name, name);
        check_count(name, found, 3);
        terms_.push_back(sellmeier_formula(wavelengths, found.count));
        starts_ = 16 * found.count;
    } else if (starts_with(name, "spline:")) {
        add_spline(name, wavelengths, &terms_);
        starts_ = 32;
    } else if (starts_with(name, "bruggeman:")) {
        add_mixture(name, wavelengths, &terms_);
        starts_ = 4;
    } else {
        int resonances = 0;
        add_sum(name, wavelengths, &terms_, &resonances);
        starts_ = 8 + 96 * resonances;
    }
    for (const auto& term : terms_) {
        first_.push_back(parameters_.size());
        for (DispersionParameter& parameter : term->parameters()) {
            parameters_.push_back(std::move(parameter));
        }
    }
}

std::complex<double> DispersionModel::epsilon(size_t i, const double* parameters,
                                              std::complex<double>* derivatives) const {
    std::complex<double> sum = 0;
    for (size_t t = 0; t < terms_.size(); ++t) {
        terms_[t]->add(i, parameters + first_[t], &sum, derivatives + first_[t]);
    }
    return sum;
}

bool DispersionModel::index(size_t i, const double* parameters, Index* index, double* dn,
                            double* dk) const {
    std::vector<std::complex<double>> derivatives(count());
    const std::complex<double> value = epsilon(i, parameters, derivatives.data());
    if (!(value.imag() >= 0)) return false;
    const std::complex<double> N = std::sqrt(value);
    if (!(N.real() > 1e-6) || !std::isfinite(N.real()) || !std::isfinite(N.imag())) return false;
    index->n = N.real();
    index->k = N.imag();
    if (!dn) return true;
    for (size_t j = 0; j < count(); ++j) {
        const std::complex<double> d = derivatives[j] / (2.0 * N);
        dn[j] = d.real();
        dk[j] = d.imag();
    }
    return true;
}

}  // namespace drude
