#include "fitter/substrate_choice.h"

#include <algorithm>

#include "base/error.h"
#include "fitter/model_curve.h"

namespace drude {

namespace {

// The thickness comes first among the parameters of a film.
FittedParameter thickness_on(const OpticalConstants& substrate, const Measurement& measurement,
                             FitOptions options, double first_nm, double last_nm) {
    options.film.substrate = substrate;
    options.first_nm = first_nm;
    options.last_nm = last_nm;
    return fit_measurement(measurement, options).common.front();
}

}  // namespace

std::vector<SubstrateAlternative> other_substrates(const Measurement& measurement,
                                                   const FitOptions& options,
                                                   const FitResult& fit) {
    std::vector<SubstrateAlternative> alternatives;
    if (fit.model != "film" || fit.layers.empty() || fit.substrate.material.empty()) return {};
    FitOptions from_here = options_taken(options, fit);
    const FilmLayer& film = fit.layers.back();
    FilmGuess guess{film.thickness_nm, options.film.porosity.value_or(0)};
    const FittedParameter* porosity = fit.find("porosity");
    if (porosity && porosity->identifiable) guess.porosity = porosity->value;
    from_here.film.start = guess;
    for (const OpticalConstants& set : published_sets()) {
        if (set.material != fit.substrate.material || set.name == fit.substrate.name) continue;
        const double first = std::max(set.first_nm(), fit.points.front().wavelength_nm);
        const double last = std::min(set.last_nm(), fit.points.back().wavelength_nm);
        const auto covered =
            std::count_if(fit.points.begin(), fit.points.end(), [&](const FittedPoint& point) {
                return point.wavelength_nm >= first && point.wavelength_nm <= last;
            });
        if (2 * covered < static_cast<ptrdiff_t>(fit.points.size())) continue;
        try {
            SubstrateAlternative one;
            one.name = set.name;
            one.first_nm = first;
            one.last_nm = last;
            one.thickness = thickness_on(set, measurement, from_here, first, last);
            one.same_range = thickness_on(fit.substrate, measurement, from_here, first, last);
            alternatives.push_back(std::move(one));
        } catch (const Error& error) {
            if (error.cause() != Cause::answer_is_no) throw;
        }
    }
    return alternatives;
}

}  // namespace drude
