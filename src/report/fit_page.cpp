#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "report/fit_plots.h"
#include "report/fit_report.h"
#include "report/page.h"

namespace drude {

namespace {

std::string number(double value, int digits = 5) {
    return std::isfinite(value) ? fmt::format("{:.{}g}", value, digits) : "–";
}

std::string fixed(double value, int decimals) {
    return std::isfinite(value) ? fmt::format("{:.{}f}", value, decimals) : "–";
}

// "490 to 512", with what is open named.
std::string interval(const ProfileInterval& ends) {
    const auto end = [](double value) {
        return std::isfinite(value) ? number(value) : std::string("open");
    };
    return end(ends.lower) + " to " + end(ends.upper);
}

std::string named(const std::string& name, const std::string& unit) {
    return unit.empty() ? name : fmt::format("{} ({})", name, unit);
}

void add_figures(const std::vector<FitFigure>& figures, Page* page) {
    page->begin_grid();
    for (const FitFigure& figure : figures) page->svg(figure.svg, figure.caption);
    page->end_grid();
}

std::string goodness(const FitReport& report) {
    const FitResult& fit = report.fit;
    if (fit.dof() <= 0) return "as many parameters as data";
    if (report.options.unweighted) {
        return fmt::format("root mean square of the residuals {:.4f}°",
                           std::sqrt(fit.chi2 / fit.data));
    }
    if (!fit.robust.empty()) {
        return fmt::format(
            "sum of {} losses over {} degrees of freedom {:.4f}; {} rows "
            "down-weighted",
            fit.robust, fit.dof(), fit.chi2_reduced(), fit.rows_down_weighted);
    }
    return fmt::format("χ²/dof = {:.4f} with {} degrees of freedom, 1 ± {:.2g} expected",
                       fit.chi2_reduced(), fit.dof(), chi2_scatter(fit, report.options));
}

void show_summary(const FitReport& report, Page* page) {
    const FitResult& fit = report.fit;
    page->section("Result", "result");
    const auto determined = std::count_if(fit.points.begin(), fit.points.end(),
                                          [](const FittedPoint& p) { return p.identifiable; });
    std::string angles;
    for (const double angle : report.measurement.angles()) {
        angles += fmt::format("{}{:g}°", angles.empty() ? "" : ", ", angle);
    }
    std::vector<std::pair<std::string, std::string>> facts = {
        {"Measurement", fmt::format("{} rows at {}", report.measurement.rows.size(), angles)},
        {"Fitted", fmt::format("{} at {} of {} wavelengths, {:g} to {:g} nm", what_was_fitted(fit),
                               determined, fit.points.size(), fit.points.front().wavelength_nm,
                               fit.points.back().wavelength_nm)},
        {"Model and estimator",
         fmt::format("{}{}, {}", fit.model,
                     fit.dispersion.empty() ? "" : ", n and k follow " + fit.dispersion,
                     fit.estimator)},
        {"Agreement", goodness(report)}};
    for (const FittedParameter& p : fit.common) {
        facts.emplace_back(named(p.name, p.unit),
                           p.identifiable ? fmt::format("{:.6g} ± {:.2g}{}", p.value, p.sigma,
                                                        p.at_bound ? ", at its bound" : "")
                                          : "not determined by the data");
    }
    if (fit.rival_thickness_nm > 0) {
        facts.emplace_back("Next best thickness",
                           fmt::format("{:.6g} nm, χ² larger by {:.3g}", fit.rival_thickness_nm,
                                       fit.rival_chi2_excess));
    }
    if (report.literature && !report.literature->sets.empty()) {
        const LiteratureSet& nearest = report.literature->sets.front();
        facts.emplace_back("Nearest published",
                           fmt::format("{}: rms Δn {:.4f}, rms Δk {:.4f}", nearest.name,
                                       nearest.distance.rms_dn, nearest.distance.rms_dk));
    }
    page->facts(facts);
    for (const std::string& warning : fit.warnings) page->note(warning);
}

void show_constants(const FitReport& report, Page* page) {
    page->section("Optical constants", "constants");
    add_figures(constants_figures(report), page);
    const OpticalConstants fitted = report.fit.constants();
    constexpr size_t most_rows = 25;
    const size_t step = std::max<size_t>(1, (fitted.n.size() + most_rows - 1) / most_rows);
    PageTable table;
    table.caption = step == 1 ? "Fitted n and k with one standard deviation."
                              : fmt::format(
                                    "Fitted n and k with one standard deviation, one in {} "
                                    "wavelengths; the material file has all of them.",
                                    step);
    table.columns = {"λ (nm)", "n", "σ(n)", "k", "σ(k)"};
    table.numeric.assign(5, true);
    for (size_t i = 0; i < fitted.n.size(); i += step) {
        table.rows.push_back({fmt::format("{:g}", fitted.wavelength_nm[i]), fixed(fitted.n[i], 5),
                              fixed(fitted.sigma_n[i], 5), fixed(fitted.k[i], 5),
                              fixed(fitted.sigma_k[i], 5)});
    }
    page->table(table);
}

void show_ladder(const FitReport& report, Page* page) {
    const FitResult& fit = report.fit;
    if (fit.ladder.empty()) return;
    page->section("Models tried", "models");
    PageTable table;
    table.caption =
        "A model is taken where the Bayesian information criterion falls by more than 10";
    // A formula may be large enough without describing the data.
    const bool judged = fit.dispersion.empty() && !report.options.unweighted;
    table.caption += judged ? " and χ²/dof falls, or is not above 1." : ".";
    table.columns = {"Model", "Parameters", "χ²/dof", "BIC", "Verdict"};
    table.numeric = {false, true, true, true, false};
    for (const LadderRung& rung : fit.ladder) {
        const bool fitted = rung.data > 0;
        table.rows.push_back({rung.model, fitted ? fmt::format("{}", rung.parameters) : "–",
                              fitted ? number(rung.chi2_reduced, 4) : "–",
                              fitted ? number(rung.bic, 6) : "–",
                              rung.taken ? "taken" : "not taken: " + rung.objection});
    }
    page->table(table);
}

void show_bootstrap(const FitReport& report, Page* page) {
    if (!report.bootstrap) return;
    const BootstrapResult& result = *report.bootstrap;
    page->section("Bootstrap", "bootstrap");
    page->paragraph(fmt::format(
        "{} measurements drawn from the fitted model with the data's standard deviations (seed "
        "{}), each fitted anew; {} were refused.",
        result.draws, result.seed, result.failures));
    PageTable table;
    table.columns = {"Parameter", "λ (nm)", "Mean", "σ",     "σ of the fit",
                     "2.5 %",     "16 %",   "84 %", "97.5 %"};
    table.numeric = {false, true, true, true, true, true, true, true, true};
    const auto add = [&](const std::string& name, const std::string& nm, const Scatter& scatter,
                         double sigma) {
        std::vector<std::string> row = {name, nm, number(scatter.mean, 6), number(scatter.sigma, 3),
                                        number(sigma, 3)};
        for (const double quantile : scatter.quantiles) row.push_back(number(quantile, 6));
        table.rows.push_back(std::move(row));
    };
    for (size_t i = 0; i < result.common.size(); ++i) {
        const FittedParameter& p = report.fit.common[i];
        add(named(p.name, p.unit), "", result.common[i], p.sigma);
    }
    const OpticalConstants fitted = report.fit.constants();
    constexpr size_t most = 25;
    const size_t step = std::max<size_t>(1, (result.points.size() + most - 1) / most);
    for (size_t i = 0; i < result.points.size(); i += step) {
        const BootstrapPoint& point = result.points[i];
        const std::string nm = fmt::format("{:g}", point.wavelength_nm);
        add("n", nm, point.n, fitted.sigma_n[i]);
        add("k", nm, point.k, fitted.sigma_k[i]);
    }
    if (step > 1) table.caption = fmt::format("One in {} wavelengths.", step);
    page->table(table);
}

void show_profile(const FitReport& report, Page* page) {
    if (!report.profile) return;
    page->section("Profile likelihood", "profile");
    PageTable table;
    table.caption =
        "Where χ², smallest over all other parameters, has risen by 1 and by 3.84: the intervals "
        "of 68.3 % and 95 %. Open: it never rises so far before the bound of the search.";
    table.columns = {"Parameter", "λ (nm)", "Value", "σ", "68.3 %", "95 %"};
    table.numeric = {false, true, true, true, true, true};
    const auto& parameters = report.profile->parameters;
    constexpr size_t most = 60;
    const size_t step = std::max<size_t>(1, (parameters.size() + most - 1) / most);
    size_t wavelengths = 0;
    for (const ProfiledParameter& p : parameters) {
        // n and k of a wavelength stay together.
        if (p.wavelength_nm > 0 && (wavelengths++ / 2) % step != 0) continue;
        table.rows.push_back({named(p.name, p.unit),
                              p.wavelength_nm > 0 ? fmt::format("{:g}", p.wavelength_nm) : "",
                              number(p.value, 6), number(p.sigma, 3), interval(p.intervals[0]),
                              interval(p.intervals[1])});
    }
    if (step > 1) table.caption += fmt::format(" One in {} wavelengths.", step);
    page->table(table);
}

void show_substrates(const FitReport& report, Page* page) {
    if (report.substrates.empty()) return;
    page->section("Other substrates", "substrates");
    page->paragraph(
        "The thickness stands on constants of the substrate that somebody else measured on another "
        "sample: how far other published sets of the same material move it, over the wavelengths "
        "that they cover.");
    PageTable table;
    table.columns = {"Set", "Wavelengths (nm)", "Thickness (nm)", "±",
                     fmt::format("On {} there (nm)", report.fit.substrate.name)};
    table.numeric = {false, false, true, true, true};
    for (const SubstrateAlternative& other : report.substrates) {
        table.rows.push_back({other.name,
                              fmt::format("{:g} to {:g}", other.first_nm, other.last_nm),
                              fixed(other.thickness.value, 3), fixed(other.thickness.sigma, 4),
                              fixed(other.same_range.value, 3)});
    }
    page->table(table);
}

void show_literature(const FitReport& report, Page* page) {
    if (!report.literature) return;
    const LiteratureComparison& literature = *report.literature;
    page->section("Literature", "literature");
    if (literature.sets.empty()) {
        page->paragraph(
            literature.material.empty()
                ? "Neither does the sample have the name of a published material, nor are n and k "
                  "a metal's."
                : fmt::format("No published set of {} covers any of the fitted wavelengths.",
                              literature.material));
        return;
    }
    switch (literature.choice) {
        case LiteratureComparison::Choice::nearest:
            page->paragraph(fmt::format(
                "The nearest of the published metals is {}. That is arithmetic, no "
                "identification of the sample: oxides and roughness move n and k further than many "
                "metals are apart.",
                literature.material));
            break;
        case LiteratureComparison::Choice::sample_header:
            page->paragraph(
                fmt::format("The measurement names its sample: {}.", literature.material));
            break;
        case LiteratureComparison::Choice::asked_for:
            page->paragraph(fmt::format("Compared with {}, as asked for.", literature.material));
            break;
    }
    PageTable table;
    table.caption =
        "Root mean square differences over the fitted wavelengths that each set covers, nearest "
        "first.";
    table.columns = {"Set", "Kind", "RMS Δn", "RMS Δk", "Wavelengths", "Publication"};
    table.numeric = {false, false, true, true, true, false};
    for (const LiteratureSet& set : literature.sets) {
        table.rows.push_back(
            {set.name, set.kind, fixed(set.distance.rms_dn, 4), fixed(set.distance.rms_dk, 4),
             fmt::format("{} of {}", set.distance.wavelengths, literature.wavelengths),
             published_set(set.name).citation});
    }
    page->table(table);
}

void show_provenance(const FitReport& report, Page* page) {
    page->section("How it was made", "provenance");
    const Provenance& made = report.provenance;
    std::vector<std::pair<std::string, std::string>> facts = {{"Program", "drude " + made.version},
                                                              {"Measurement", made.measurement},
                                                              {"SHA-256", made.measurement_sha256}};
    for (const auto& [key, value] : report.measurement.header) {
        if (key != "warning") facts.emplace_back(key, value);
    }
    page->facts(facts);
    if (!made.command.empty()) page->code(made.command);
}

}  // namespace

std::string what_was_fitted(const FitResult& fit) {
    if (!fit.substrate.wavelength_nm.empty()) {
        return fmt::format("n and k of a film on {}", fit.substrate.name);
    }
    if (fit.layers.empty()) return "pseudo n and k of a bare surface";
    std::string layers;
    for (const FilmLayer& layer : fit.layers) {
        layers += fmt::format("{}{:g} nm of {}", layers.empty() ? "" : " on ", layer.thickness_nm,
                              layer.constants.name);
    }
    return "n and k below " + layers;
}

std::string fit_page(const FitReport& report) {
    Page page(report.name + ", fitted");
    page.banner("drude " + report.provenance.version,
                "Optical constants from Ψ and Δ, with what the data say of them and what they do "
                "not.");
    show_summary(report, &page);
    page.section("Data and model", "data");
    add_figures(data_figures(report), &page);
    show_constants(report, &page);
    show_literature(report, &page);
    show_substrates(report, &page);
    show_ladder(report, &page);
    show_profile(report, &page);
    show_bootstrap(report, &page);
    show_provenance(report, &page);
    return page.html();
}

}  // namespace drude
