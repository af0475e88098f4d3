#include "fitter/model_ladder.h"

#include <cmath>
#include <limits>
#include <optional>

#include "base/error.h"

namespace drude {

namespace {

// "" where `next` is the better model, otherwise what speaks against it.
std::string objection(const FitResult& now, const FitResult& next, const FitOptions& options) {
    const bool unweighted = options.unweighted;
    if (next.data < now.data) {
        return fmt::format("it explains {} data, fewer than {}", next.data, now.data);
    }
    if (!(next.dof() > 0)) return "it has as many parameters as data";
    for (const FittedParameter& parameter : next.common) {
        if (!parameter.identifiable) {
            return fmt::format("the data do not determine its {}", parameter.name);
        }
        // A bound that the smaller model meets as well does not tell against the larger.
        const FittedParameter* before = now.find(parameter.name);
        if (parameter.at_bound && !(before && before->at_bound)) {
            return fmt::format("its {} ends at a bound, {:.4g}", parameter.name, parameter.value);
        }
    }
    // Below 1 it speaks against the standard deviations that were stated, not against a model.
    const bool fits = !unweighted && next.chi2_reduced() - 1 <= 3 * chi2_scatter(next, options);
    // More data, or a criterion that cannot be had: the fit itself decides.
    if (next.data > now.data || !(now.dof() > 0)) {
        return unweighted || fits
                   ? ""
                   : fmt::format("its reduced chi-square is {:.4g}", next.chi2_reduced());
    }
    const double gain = bayesian_criterion(now, unweighted) - bayesian_criterion(next, unweighted);
    if (!(gain > ladder_bic_gain)) return small_gain(gain);
    if (!unweighted && !fits && !(next.chi2_reduced() < now.chi2_reduced())) {
        return fmt::format("its reduced chi-square {:.4g} is above 1 and not below {:.4g}",
                           next.chi2_reduced(), now.chi2_reduced());
    }
    return "";
}

class Ladder {
  public:
    Ladder(const Measurement& measurement, const FitOptions& options)
        : measurement_(measurement), unweighted_(options.unweighted) {}

    // Whether the model could be fitted, taken or not.
    bool climb(const std::string& name, const FitOptions& options) {
        LadderRung rung;
        rung.model = name;
        try {
            FitResult next = fit_measurement(measurement_, options);
            rung.data = next.data;
            rung.parameters = next.parameters;
            rung.chi2_reduced = next.chi2_reduced();
            rung.bic = bayesian_criterion(next, unweighted_);
            if (best_) rung.objection = objection(*best_, next, options);
            rung.taken = rung.objection.empty();
            if (rung.taken) {
                best_ = std::move(next);
                options_ = options;
            }
        } catch (const Error& error) {
            // A wrong option or file is wrong for every rung.
            if (error.cause() != Cause::answer_is_no) throw;
            rung.objection = error.message();
            if (!first_refusal_) first_refusal_ = error;
        }
        rungs_.push_back(std::move(rung));
        return rungs_.back().data > 0;
    }

    const FitOptions& options_taken() const { return options_; }
    bool any() const { return best_.has_value(); }

    FitResult result() {
        if (!best_) throw *first_refusal_;
        // What a dispersion chose its size from comes before the models.
        std::vector<LadderRung> all = std::move(best_->ladder);
        for (LadderRung& rung : all) rung.model = "n, k: " + rung.model;
        all.insert(all.end(), rungs_.begin(), rungs_.end());
        best_->ladder = std::move(all);
        return std::move(*best_);
    }

  private:
    const Measurement& measurement_;
    bool unweighted_;
    std::vector<LadderRung> rungs_;
    std::optional<FitResult> best_;
    FitOptions options_;
    std::optional<Error> first_refusal_;
};

}  // namespace

std::string small_gain(double gain) {
    if (gain < 0) return fmt::format("BIC rises by {:.4g}", -gain);
    return fmt::format("BIC falls by {:.4g}, not by more than {:g}", gain, ladder_bic_gain);
}

double bayesian_criterion(double chi2, int data, int parameters, bool unweighted) {
    // Of residuals that the parameters cancel only rounding is left to take a logarithm of.
    if (unweighted && data <= parameters) return std::numeric_limits<double>::quiet_NaN();
    const double misfit = unweighted ? data * std::log(chi2 / data) : chi2;
    return misfit + parameters * std::log(static_cast<double>(data));
}

double bayesian_criterion(const FitResult& fit, bool unweighted) {
    return bayesian_criterion(fit.chi2, fit.data, fit.parameters, unweighted);
}

FitResult fit_ladder(const Measurement& measurement, const FitOptions& options) {
    FitOptions bulk = options;
    bulk.model = "bulk";
    bulk.overlayers.clear();
    bulk.film.substrate = {};
    bulk.film.spread_nm = {};
    bulk.film.bandwidth_nm = 0;
    bulk.roughness_nm.fitted = false;
    bulk.fit_angle_offset = false;
    Ladder ladder(measurement, options);
    ladder.climb("bulk", bulk);
    if (!options.overlayers.empty()) {
        FitOptions layered = bulk;
        layered.model = "overlayer";
        layered.overlayers = options.overlayers;
        ladder.climb("overlayer", layered);
    }
    FitOptions film = bulk;
    bool film_fits = false;
    if (!options.film.substrate.wavelength_nm.empty()) {
        film.model = "film";
        film.dispersion.clear();
        film.film = options.film;
        if (film.film.spread_nm.fitted) film.film.spread_nm = {};
        film.roughness_nm = options.roughness_nm;
        film_fits = ladder.climb("film", film);
    }
    if (ladder.any() && measurement.angles().size() >= 3) {
        FitOptions tilted = ladder.options_taken();
        tilted.fit_angle_offset = true;
        ladder.climb(tilted.model + " + angle offset", tilted);
    }
    if (film_fits && !film.film.spread_nm.given()) {
        // Also where an even film was not taken: washed-out fringes are no even film's.
        const bool taken = ladder.any() && ladder.options_taken().model == "film";
        FitOptions uneven = taken ? ladder.options_taken() : film;
        uneven.film.spread_nm = {0, true};
        ladder.climb(uneven.fit_angle_offset ? "film + angle offset + spread" : "film + spread",
                     uneven);
    }
    return ladder.result();
}

}  // namespace drude
