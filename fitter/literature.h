// How far fitted optical constants are from published ones.
#pragma once

#include <string>
#include <vector>

#include "fitter/fit_result.h"

namespace drude {

// Root mean square differences over the wavelengths of one table that the other covers,
// interpolated linearly; NaN where it covers none.
struct ConstantsDistance {
    double rms_dn = 0, rms_dk = 0;
    int wavelengths = 0;
    double rms() const;  // of both: sqrt(rms_dn^2 + rms_dk^2)
};

ConstantsDistance constants_distance(const OpticalConstants& of, const OpticalConstants& from);

struct LiteratureSet {
    std::string name, kind;  // "Cu-McPeak", "measured"
    ConstantsDistance distance;
};

// Smallest and largest n and k among the sets that cover a wavelength; NaN where `sets` is 0.
struct LiteratureEnvelope {
    std::vector<double> wavelength_nm, n_low, n_high, k_low, k_high;
    std::vector<int> sets;
};

struct LiteratureComparison {
    enum class Choice { asked_for, sample_header, nearest };

    std::string material;  // "Cu"; empty where nothing named or near is published
    Choice choice = Choice::nearest;
    // Of that material, those that cover at least one fitted wavelength; nearest first, and those
    // that cover fewer wavelengths than others after all that cover more.
    std::vector<LiteratureSet> sets;
    LiteratureEnvelope envelope;  // of those sets, at the fitted wavelengths
    int wavelengths = 0;          // that the fit determined

    std::string nearest() const { return sets.empty() ? "" : sets.front().name; }
};

// `asked`: a material ("Cu") or one set ("Cu-McPeak"); empty: the material that `sample` names
// (either way, letter case free), otherwise that of the set that is nearest in root mean square of
// n and k among the published metals that cover the most fitted wavelengths. That last choice is
// arithmetic, not an identification of the sample, and is made for metals only: where the median of
// k over the wavelengths, of the fit as of the set, exceeds 1. A fitted film, whose n and k follow
// from a known material, is compared with what is asked for only. Throws Error (user) with the
// nearest word where nothing published has the name `asked`.
LiteratureComparison compare_with_literature(const FitResult& fit, const std::string& sample,
                                             const std::string& asked);

}  // namespace drude
