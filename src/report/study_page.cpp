// The page as a whole, and those of its sections that are about metals rather than pictures.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "fitter/paper_table.h"
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

// "81 wavelengths, 380 to 780 nm, at 45°, 60°; noise σ(Ψ) = 0.05°, σ(Δ) = 0.1°".
std::string extent(const Measurement& measurement) {
    const std::vector<double> wavelengths = measurement.wavelengths();
    if (wavelengths.empty()) return "no rows";
    std::string angles;
    for (const double angle : measurement.angles())
        angles += fmt::format("{}{:g}°", angles.empty() ? "" : ", ", angle);
    std::string text = fmt::format("{} wavelengths, {:g} to {:g} nm, at {}", wavelengths.size(),
                                   wavelengths.front(), wavelengths.back(), angles);
    if (measurement.has_sigma())
        text += fmt::format("; noise σ(Ψ) = {:g}°, σ(Δ) = {:g}°",
                            measurement.rows.front().sigma_psi_deg,
                            measurement.rows.front().sigma_delta_deg);
    return text;
}

// "the paper's 6 angles", "3 angles", "2 to 6 angles": of all measurements together.
std::string angles_text(const Study& study) {
    size_t least = std::numeric_limits<size_t>::max(), most = 0;
    bool papers = !study.metals.empty();
    for (const StudyMetal& metal : study.metals) {
        const std::vector<double> angles = metal.measurement.angles();
        least = std::min(least, angles.size());
        most = std::max(most, angles.size());
        papers = papers && angles == paper_angles_deg();
    }
    if (papers) return fmt::format("the paper's {} angles", most);
    if (least < most) return fmt::format("{} to {} angles", least, most);
    return fmt::format("{} {}", most, most == 1 ? "angle" : "angles");
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
        "each sample is a set of optical constants that others published, and its measurement is "
        "simulated from it with random instrument noise.");
    PageTable table;
    table.caption =
        "What each sample is made of, and the published set that stands for the handbook. The "
        "paper's own samples, metals from a hardware store and two coins, cannot be had: their "
        "data were never published.";
    table.columns = {"Sample", "Made of", "Compared with", "Seed of the noise"};
    table.numeric = {false, false, false, true};
    std::vector<std::string> calculated;
    for (const StudyMetal& m : study.metals) {
        table.rows.push_back({m.name, set_with_kind(m, m.sample_set),
                              set_with_kind(m, m.literature_set), fmt::format("{}", m.seed)});
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
        table.rows.push_back({film.name, made, "the bare substrate", fmt::format("{}", film.seed)});
    }
    page.table(table);
    if (!calculated.empty())
        page.note(
            fmt::format("Not every sample rests on a measurement even at its origin: {} {} "
                        "calculated.",
                        fmt::join(calculated, ", "), calculated.size() == 1 ? "is" : "are"));
    for (const std::string& note : study.info.notes) page.note(note);
}

void section_captured(Page& page, const Study& study) {
    page.section("What was captured", "captured");
    page.paragraph(fmt::format(
        "Ψ and Δ against wavelength at {} of incidence: tan Ψ is how much p light is attenuated "
        "against s light by the reflection, Δ how far it falls behind it. Points are the simulated "
        "measurement, lines the fitted model.{}",
        angles_text(study), study.film ? " " + study.film->name + " is in figure 6 below." : ""));
    std::vector<std::pair<std::string, std::string>> facts;
    for (const StudyMetal& m : study.metals) facts.emplace_back(m.name, extent(m.measurement));
    if (study.film) facts.emplace_back(study.film->name, extent(study.film->measurement));
    page.facts(facts);
    page.begin_grid();
    for (const StudyMetal& m : study.metals) {
        const std::vector<FitFigure> figures = data_figures(fit_report_of(m));
        page.svg(figures[0].svg, "");
        page.svg(figures[1].svg, "");
    }
    page.end_grid();
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
        "How well each fit describes its measurement (reduced χ², expected 1 within about "
        "√(2/dof)), and how far it lies from the literature set it is compared with (root mean "
        "square over the measured wavelengths).";
    fits.columns = {"Metal", "χ²/dof", "dof", "RMS Δn", "RMS Δk", "Compared with"};
    fits.numeric = {false, true, true, true, true, false};
    for (const StudyMetal& m : study.metals)
        fits.rows.push_back({m.name, number_text(m.reduced_chi2, 4), number_text(m.dof, 0),
                             number_text(m.rms_dn, 4), number_text(m.rms_dk, 4), m.literature_set});
    if (study.film) {
        const StudyFilm& film = *study.film;
        fits.rows.push_back({film.name + ", with its film", number_text(film.film_chi2, 4),
                             number_text(film.film_dof, 0), "–", "–", "–"});
        fits.rows.push_back({film.name + ", as a bare metal", number_text(film.bare_chi2, 1),
                             number_text(film.bare_dof, 0), "–", "–", "–"});
    }
    page.table(fits);
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
                "Optical constants of metals fitted to simulated ellipsometry, rendered beside "
                "those of the literature, and the difference between the two: the loop of Berger, "
                "Weidlich, Wilkie & Magnor (2012), checked claim by claim.");
    page.style(web_style("study"));
    section_question(page, study, content);
    section_samples(page, study);
    section_captured(page, study);
    section_fits(page, study);
    section_table_1(page, study);
    section_pictures(page, study, content);
    section_claims(page, content);
    section_figures(page, content);
    section_sources(page, study, content);
    return page.html();
}

}  // namespace drude
