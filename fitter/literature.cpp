#include "fitter/literature.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "materials/optical_constants.h"

namespace drude {

namespace {

constexpr double not_known = std::numeric_limits<double>::quiet_NaN();

bool same_word(const std::string& a, const std::string& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](char x, char y) {
        return std::tolower(static_cast<unsigned char>(x)) ==
               std::tolower(static_cast<unsigned char>(y));
    });
}

// The published material or set of this name, as a material's name; "" where there is none.
std::string material_named(const std::string& name) {
    for (const OpticalConstants& set : published_sets()) {
        if (same_word(set.material, name) || same_word(set.name, name)) return set.material;
    }
    return "";
}

// Metals hardly let light in; over the visible silver, the least of them, has k above 1.9.
bool is_metal(std::vector<double> k) {
    if (k.empty()) return false;
    const auto middle = k.begin() + static_cast<std::ptrdiff_t>(k.size() / 2);
    std::nth_element(k.begin(), middle, k.end());
    return *middle > 1;
}

// The material of the nearest metal; "" where the fit is none.
std::string nearest_metal(const OpticalConstants& fitted, const std::vector<LiteratureSet>& sets) {
    if (!is_metal(fitted.k)) return "";
    for (const LiteratureSet& named : sets) {
        const OpticalConstants& set = published_set(named.name);
        std::vector<double> k;
        for (const double nm : fitted.wavelength_nm) {
            if (set.covers(nm, nm)) k.push_back(set.at(nm).k);
        }
        if (is_metal(std::move(k))) return set.material;
    }
    return "";
}

bool nearer(const LiteratureSet& a, const LiteratureSet& b) {
    if (a.distance.wavelengths != b.distance.wavelengths) {
        return a.distance.wavelengths > b.distance.wavelengths;
    }
    return a.distance.rms() < b.distance.rms();
}

// Every published set that covers something of `fitted`, nearest first.
std::vector<LiteratureSet> ranked(const OpticalConstants& fitted) {
    std::vector<LiteratureSet> sets;
    for (const OpticalConstants& set : published_sets()) {
        const ConstantsDistance distance = constants_distance(fitted, set);
        if (distance.wavelengths > 0) sets.push_back({set.name, set.kind, distance});
    }
    std::stable_sort(sets.begin(), sets.end(), nearer);
    return sets;
}

LiteratureEnvelope envelope_of(const std::vector<LiteratureSet>& sets,
                               const std::vector<double>& wavelengths) {
    LiteratureEnvelope envelope;
    for (const double nm : wavelengths) {
        double low[] = {not_known, not_known}, high[] = {not_known, not_known};
        int count = 0;
        for (const LiteratureSet& named : sets) {
            const OpticalConstants& set = published_set(named.name);
            if (!set.covers(nm, nm)) continue;
            const Index index = set.at(nm);
            ++count;
            // fmin and fmax pass over the NaN of the start.
            low[0] = std::fmin(low[0], index.n);
            high[0] = std::fmax(high[0], index.n);
            low[1] = std::fmin(low[1], index.k);
            high[1] = std::fmax(high[1], index.k);
        }
        envelope.wavelength_nm.push_back(nm);
        envelope.n_low.push_back(low[0]);
        envelope.n_high.push_back(high[0]);
        envelope.k_low.push_back(low[1]);
        envelope.k_high.push_back(high[1]);
        envelope.sets.push_back(count);
    }
    return envelope;
}

}  // namespace

double ConstantsDistance::rms() const {
    return std::hypot(rms_dn, rms_dk);
}

ConstantsDistance constants_distance(const OpticalConstants& of, const OpticalConstants& from) {
    ConstantsDistance distance;
    double dn2 = 0, dk2 = 0;
    for (size_t i = 0; i < of.wavelength_nm.size(); ++i) {
        const double nm = of.wavelength_nm[i];
        if (!from.covers(nm, nm)) continue;
        const Index there = from.at(nm);
        dn2 += (of.n[i] - there.n) * (of.n[i] - there.n);
        dk2 += (of.k[i] - there.k) * (of.k[i] - there.k);
        ++distance.wavelengths;
    }
    distance.rms_dn = std::sqrt(dn2 / distance.wavelengths);
    distance.rms_dk = std::sqrt(dk2 / distance.wavelengths);
    if (distance.wavelengths == 0) distance.rms_dn = distance.rms_dk = not_known;
    return distance;
}

LiteratureComparison compare_with_literature(const FitResult& fit, const std::string& sample,
                                             const std::string& asked) {
    const OpticalConstants fitted = fit.constants();
    LiteratureComparison comparison;
    comparison.wavelengths = static_cast<int>(fitted.wavelength_nm.size());
    std::vector<LiteratureSet> sets = ranked(fitted);
    std::string only_set;
    if (!asked.empty()) {
        comparison.choice = LiteratureComparison::Choice::asked_for;
        comparison.material = material_named(asked);
        if (comparison.material.empty()) {
            user_error(
                "no published set or material is called '{}'{}; 'drude materials' lists them",
                asked, did_you_mean(asked, published_names()));
        }
        if (!same_word(comparison.material, asked)) only_set = asked;
    } else if (!fit.substrate.wavelength_nm.empty()) {
        return comparison;
    } else if (const std::string named = material_named(sample); !named.empty()) {
        comparison.choice = LiteratureComparison::Choice::sample_header;
        comparison.material = named;
    } else {
        comparison.material = nearest_metal(fitted, sets);
    }
    for (const LiteratureSet& set : sets) {
        if (published_set(set.name).material != comparison.material) continue;
        if (only_set.empty() || same_word(set.name, only_set)) comparison.sets.push_back(set);
    }
    comparison.envelope = envelope_of(comparison.sets, fitted.wavelength_nm);
    return comparison;
}

}  // namespace drude
