// The page as a whole, and those of its sections that are about metals rather than pictures.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "fitter/common_error.h"
#include "report/fit_plots.h"
#include "report/study_fit.h"
#include "report/study_sections.h"
#include "report/web.h"

namespace drude {

namespace {

const OpticalConstants* find_set(const StudyMetal& metal, const std::string& name) {
    for (const OpticalConstants& set : metal.published)
        if (set.name == name) return &set;
    return nullptr;
}

// Every tenth or so of the wavelengths; the whole table is in the CSV beside the page.
PageTable constants_table(const StudyMetal& metal) {
    PageTable table;
    table.caption = fmt::format(
        "{}: fitted n and k with one standard deviation, and those of {}, at some "
        "wavelengths. All of them: {}/nk.csv.",
        metal.name, metal.literature_set, metal.folder);
    table.columns = {"λ (nm)", "n fitted", "σ(n)", "k fitted", "σ(k)", "n lit.", "k lit."};
    table.numeric.assign(table.columns.size(), true);
    const OpticalConstants& fitted = metal.fitted;
    OpticalConstants literature = metal.literature;
    literature.policy = RangePolicy::clamp;
    const size_t step = std::max<size_t>(1, (fitted.wavelength_nm.size() + 7) / 8);
    for (size_t i = 0; i < fitted.wavelength_nm.size(); i += step) {
        const double nm = fitted.wavelength_nm[i];
        const bool compared = !literature.wavelength_nm.empty() && literature.covers(nm, nm);
        const Index there = compared ? literature.at(nm) : Index{std::nan(""), std::nan("")};
        const auto sigma = [&](const std::vector<double>& values) {
            return i < values.size() ? number_text(values[i], 4) : "–";
        };
        table.rows.push_back({fmt::format("{:g}", nm), number_text(fitted.n[i], 4),
                              sigma(fitted.sigma_n), number_text(fitted.k[i], 4),
                              sigma(fitted.sigma_k), number_text(there.n, 4),
                              number_text(there.k, 4)});
    }
    return table;
}

}  // namespace

std::string number_text(double value, int decimals) {
    return std::isfinite(value) ? fmt::format("{:.{}f}", value, decimals) : "–";
}

std::string set_with_kind(const StudyMetal& metal, const std::string& set_name) {
    const OpticalConstants* set = find_set(metal, set_name);
    return set && !set->kind.empty() ? fmt::format("{} ({})", set_name, set->kind) : set_name;
}

void section_samples(Page& page, const Study& study) {
    page.section("The samples", "samples");
    page.note(
        "The samples are virtual. No hardware was used and no piece of metal was measured here: "
        "each sample is a set of optical constants that others published, with a roughness of "
        "ours, "
        "and its measurement is captured on a simulated bench.");
    PageTable table;
    table.caption =
        "What each sample is made of, and the published set that stands for the handbook. The "
        "paper's own samples, metals from a hardware store and two coins, cannot be had: their "
        "data were never published.";
    table.columns = {"Sample", "Made of", "Lobe and β", "Compared with", "Seed"};
    table.numeric = {false, false, false, false, true};
    std::vector<std::string> calculated;
    for (const StudyMetal& m : study.metals) {
        const std::string finish =
            m.lobe ? fmt::format("{}, {:g}", lobe_name(m.lobe->true_lobe), m.lobe->true_beta) : "–";
        table.rows.push_back({m.name, set_with_kind(m, m.sample_set), finish,
                              set_with_kind(m, m.literature_set),
                              fmt::format("{}", m.capture.seed)});
        const OpticalConstants* set = find_set(m, m.sample_set);
        if (set && set->kind == "calculated")
            calculated.push_back(fmt::format("{} ({})", m.sample_set, m.name));
    }
    if (study.film) {
        const StudyFilm& film = *study.film;
        std::string made = film.film_set + " on " + film.substrate_set;
        if (!film.sample.layers.empty())
            made = fmt::format("{:g} nm of {} on {}", film.sample.layers[0].thickness_nm,
                               film.sample.layers[0].constants.citation, film.substrate_set);
        table.rows.push_back({film.name, made, "a mirror", "the bare substrate",
                              fmt::format("{}", film.capture.seed)});
    }
    page.table(table);
    if (!calculated.empty())
        page.note(
            fmt::format("Not every sample rests on a measurement even at its origin: {} {} "
                        "calculated.",
                        fmt::join(calculated, ", "), calculated.size() == 1 ? "is" : "are"));
    for (const std::string& note : study.info.notes) page.note(note);
}

void section_fits(Page& page, const Study& study) {
    page.section("The fits", "fits");
    page.paragraph(
        "Each metal was fitted as if its origin were unknown, wavelength by wavelength, from Ψ and "
        "Δ at all angles together, without start values. What the fit itself adds to the sample's "
        "own constants is the scatter of its points around the sample's line; how far apart the "
        "other lines lie is what authors disagree about.");
    PageTable fits;
    fits.caption =
        "How well each fit describes its measurement: reduced χ² with the noise and the common "
        "error, and how far from 1 that may be; the same with the noise alone, and what the common "
        "error makes of that on average. And how far the fit lies from the literature set it is "
        "compared with (root mean square over the measured wavelengths).";
    fits.columns = {"Metal",    "χ²/dof", "1 ±",    "dof",          "noise alone",
                    "expected", "RMS Δn", "RMS Δk", "Compared with"};
    fits.numeric = {false, true, true, true, true, true, true, true, false};
    for (const StudyMetal& m : study.metals)
        fits.rows.push_back({m.name, number_text(m.reduced_chi2, 3),
                             number_text(chi2_slack(m.measurement, m.capture.common, m.dof), 2),
                             number_text(m.dof, 0), number_text(m.noise_chi2, 2),
                             number_text(chi2_by_common_error(m.measurement, m.capture.common), 2),
                             number_text(m.rms_dn, 4), number_text(m.rms_dk, 4), m.literature_set});
    if (study.film) {
        const StudyFilm& film = *study.film;
        fits.rows.push_back(
            {film.name + ", with its film", number_text(film.film_chi2, 3),
             number_text(chi2_slack(film.measurement, film.capture.common, film.film_dof), 2),
             number_text(film.film_dof, 0), number_text(film.noise_chi2, 2),
             number_text(chi2_by_common_error(film.measurement, film.capture.common), 2), "–", "–",
             "–"});
        fits.rows.push_back({film.name + ", as a bare metal", number_text(film.bare_chi2, 1), "–",
                             number_text(film.bare_dof, 0), "–", "–", "–", "–", "–"});
    }
    page.table(fits);
    page.paragraph(
        "The common error is what the mounts' stops and the calibration's azimuths leave in all "
        "wavelengths of an angle alike. It does not average out over them, so that its few draws "
        "decide how far from 1 a χ² lies; with the noise alone for a measure the χ² would be that "
        "of the mounts. A detector sees a cone, and in it facets that are tilted: on a rough "
        "sample that moves Δ by some hundredths of a degree, which no standard deviation here "
        "holds.");
    if (study.film && !study.film->parameters.empty()) {
        PageTable film;
        film.caption = "The film on the anodised aluminium: fitted, and what it was made with.";
        film.columns = {"Parameter", "Fitted", "σ", "Made with", "Unit"};
        film.numeric = {false, true, true, true, false};
        for (const StudyParameter& p : study.film->parameters)
            film.rows.push_back({p.name, fmt::format("{:.6g}", p.value),
                                 std::isfinite(p.sigma) ? fmt::format("{:.2g}", p.sigma) : "–",
                                 fmt::format("{:g}", p.truth), p.unit.empty() ? "–" : p.unit});
        page.table(film);
    }
    for (const StudyMetal& metal : study.metals) {
        page.heading(metal.name);
        const FitReport report = fit_report_of(metal);
        const std::vector<FitFigure> data = data_figures(report);
        page.begin_grid();
        for (const FitFigure& figure : constants_figures(report))
            page.svg(figure.svg, figure.caption);
        page.svg(data[2].svg, data[2].caption);
        page.svg(data[3].svg, data[3].caption);
        page.end_grid();
        page.details(fmt::format("{}: numbers", metal.name), constants_table(metal));
    }
}

std::string study_page(const Study& study, const StudyPage& content) {
    Page page("Metals, measured and looked up");
    page.banner("drude " + study.info.version,
                "Optical constants of metals fitted to what a virtual ellipsometer captured, "
                "rendered beside those of the literature, and the difference between the two: the "
                "loop of Berger, Weidlich, Wilkie & Magnor (2012), checked claim by claim.");
    page.style(web_style("study"));
    section_question(page, study, content);
    section_samples(page, study);
    section_captured(page, study);
    section_fits(page, study);
    section_lobes(page, study);
    section_table_1(page, study);
    section_pictures(page, study, content);
    section_claims(page, content);
    section_figures(page, content);
    section_sources(page, study, content);
    return page.html();
}

}  // namespace drude
