#include "report/study_report.h"

#include <fmt/format.h>

#include <cmath>

#include "report/markup.h"
#include "report/page.h"
#include "report/study_plots.h"

namespace drude {

namespace {

std::string number(double value, int decimals) {
    return std::isfinite(value) ? fmt::format("{:.{}f}", value, decimals) : "–";
}

// A duration as people say it.
std::string duration(double seconds) {
    if (!(seconds >= 0)) return "–";
    if (seconds < 90) return fmt::format("{:.1f} s", seconds);
    const auto whole = static_cast<long long>(std::llround(seconds));
    return fmt::format("{} min {} s", whole / 60, whole % 60);
}

const OpticalConstants* find_set(const StudyMetal& metal, const std::string& name) {
    for (const OpticalConstants& set : metal.published)
        if (set.name == name) return &set;
    return nullptr;
}

std::string kind_of(const StudyMetal& metal, const std::string& set_name) {
    const OpticalConstants* set = find_set(metal, set_name);
    return set ? set->kind : "";
}

// "Cu-McPeak (measured)".
std::string set_with_kind(const StudyMetal& metal, const std::string& set_name) {
    const std::string kind = kind_of(metal, set_name);
    return kind.empty() ? set_name : fmt::format("{} ({})", set_name, kind);
}

std::string with_citation(const std::string& set, const std::string& citation) {
    return citation.empty() ? set : set + " · " + citation;
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

std::string roughness(const StudyInfo& info) {
    return fmt::format("{} lobe, {} masking, β = {:.6g} rad", info.lobe, info.masking, info.beta);
}

void introduce(Page& page, const StudyInfo& info, const std::vector<StudyMetal>& metals) {
    page.section("The study", "study");
    page.note(
        "The samples are virtual. No hardware was used and no piece of metal was measured here: "
        "each sample is a set of optical constants that others published, and its measurement is "
        "simulated from it with random instrument noise.");
    if (!info.sheet_png.empty())
        page.picture(
            {info.sheet_png,
             "Sheet of rendered half-spheres, one column a metal: fitted constants above, "
             "literature in the middle, their log-scaled difference below."},
            "Above: rendered with the constants fitted to the simulated measurement. "
            "Middle: with the literature's. Below: log10 of the absolute difference, taken "
            "on linear radiance before tone mapping; both pictures of a pair share one "
            "tone curve.");
    page.paragraph(
        "Each metal was then fitted as if its origin were unknown, wavelength by wavelength, from "
        "Ψ and Δ at all angles together. The fitted n and k, and those of another published set, "
        "were rendered as a half-sphere in the same environment. What differs between the two rows "
        "of the picture is therefore how far two published sets of one metal lie apart, as an "
        "ellipsometer would see it; what the fit itself adds is the scatter of its points around "
        "the sample's line in the plots below.");
    std::vector<std::string> calculated;
    for (const StudyMetal& metal : metals)
        if (kind_of(metal, metal.sample_set) == "calculated")
            calculated.push_back(fmt::format("{} ({})", metal.sample_set, metal.name));
    if (!calculated.empty())
        page.note(
            fmt::format("Not every sample rests on a measurement even at its origin: {} {} "
                        "calculated.",
                        fmt::join(calculated, ", "), calculated.size() == 1 ? "is" : "are"));
    for (const std::string& note : info.notes) page.note(note);
}

void summarise(Page& page, const std::vector<StudyMetal>& metals) {
    page.section("Figures", "figures");
    PageTable fits;
    fits.caption =
        "How well each fit describes its measurement (reduced χ², expected 1 within about "
        "√(2/dof)), and how far it lies from the literature set it is compared with (root mean "
        "square over the measured wavelengths).";
    fits.columns = {"Metal", "Sample made of", "Compared with", "Seed", "χ²/dof",
                    "dof",   "RMS Δn",         "RMS Δk"};
    fits.numeric = {false, false, false, true, true, true, true, true};
    PageTable differences;
    differences.caption =
        "log10 of the absolute difference of linear radiance between the two renderings, over the "
        "pixels of the picture in which they differ.";
    differences.columns = {"Metal", "Mean", "Median", "99th percentile", "Largest"};
    differences.numeric = {false, true, true, true, true};
    for (const StudyMetal& m : metals) {
        fits.rows.push_back({m.name, set_with_kind(m, m.sample_set),
                             set_with_kind(m, m.literature_set), fmt::format("{}", m.seed),
                             number(m.reduced_chi2, 4), number(m.dof, 0), number(m.rms_dn, 4),
                             number(m.rms_dk, 4)});
        const Log10Difference& d = m.log10_difference;
        differences.rows.push_back(
            {m.name, number(d.mean, 2), number(d.p50, 2), number(d.p99, 2), number(d.max, 2)});
    }
    page.table(fits);
    page.table(differences);
}

// Every tenth or so of the wavelengths; the whole table is in the CSV beside the page.
PageTable constants_table(const StudyMetal& metal) {
    PageTable table;
    table.caption =
        "Fitted n and k with one standard deviation, and those of the literature, at some "
        "wavelengths.";
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
            return i < values.size() ? number(values[i], 4) : "–";
        };
        table.rows.push_back({fmt::format("{:g}", nm), number(fitted.n[i], 4),
                              sigma(fitted.sigma_n), number(fitted.k[i], 4), sigma(fitted.sigma_k),
                              number(there.n, 4), number(there.k, 4)});
    }
    return table;
}

void show_metal(Page& page, const StudyMetal& metal) {
    page.section(metal.name, metal.name);
    const std::string sample =
        with_citation(set_with_kind(metal, metal.sample_set), metal.sample_set_citation);
    const std::string literature =
        with_citation(set_with_kind(metal, metal.literature_set), metal.literature_set_citation);
    page.facts({{"Sample", "virtual, made of " + sample},
                {"Compared with", literature},
                {"Measurement",
                 fmt::format("simulated: {}; seed {}", extent(metal.measurement), metal.seed)},
                {"Fit", fmt::format("χ²/dof = {} with {} degrees of freedom; RMS Δn = {}, RMS Δk = "
                                    "{} against the set compared with",
                                    number(metal.reduced_chi2, 4), number(metal.dof, 0),
                                    number(metal.rms_dn, 4), number(metal.rms_dk, 4))}});
    page.begin_grid();
    if (!metal.fitted_png.empty() && !metal.literature_png.empty())
        page.comparison({metal.fitted_png, metal.name + " half-sphere, fitted constants"}, "fitted",
                        {metal.literature_png, metal.name + " half-sphere, literature constants"},
                        metal.literature_set,
                        "Drag the divider, or focus it and use the arrow keys.");
    if (!metal.difference_png.empty())
        page.picture({metal.difference_png,
                      metal.name + ": log10 of the absolute difference of the two renderings"},
                     "log10 of the absolute difference.");
    page.end_grid();
    page.heading("As the instrument would see it");
    page.begin_grid();
    const std::string how = metal.fitted_curve.rows.empty()
                                ? "Points: simulated measurement."
                                : "Points: simulated measurement. Lines: fitted model.";
    page.svg(ellipsometry_plot(metal, EllipsometricAngle::psi), how);
    page.svg(ellipsometry_plot(metal, EllipsometricAngle::delta), how);
    page.end_grid();
    page.heading("Optical constants");
    page.begin_grid();
    const std::string lines =
        "Points: fitted, one standard deviation. The broad grey line is the set the sample is made "
        "of, the strong blue line the set it is compared with.";
    page.svg(constants_plot(metal, ConstantKind::n), lines);
    page.svg(constants_plot(metal, ConstantKind::k), lines);
    page.end_grid();
    page.table(constants_table(metal));
}

void document(Page& page, const StudyInfo& info, const std::vector<StudyMetal>& metals) {
    page.section("Sources", "sources");
    PageTable sets;
    sets.caption = "Every published set drawn above, with its range and its original publication.";
    sets.columns = {"Set", "Kind", "Range (nm)", "Publication"};
    sets.numeric = {false, false, true, false};
    for (const StudyMetal& metal : metals)
        for (const OpticalConstants& set : metal.published)
            sets.rows.push_back({set.name, set.kind,
                                 set.wavelength_nm.empty()
                                     ? "–"
                                     : fmt::format("{:g}–{:g}", set.first_nm(), set.last_nm()),
                                 set.citation});
    page.table(sets);
    page.section("How it was made", "provenance");
    std::vector<std::pair<std::string, std::string>> facts = {
        {"Program", "drude " + info.version},
        {"Environment", info.environment},
        {"Surface", roughness(info)},
        {"Estimator", info.estimator},
        {"Wall time", duration(info.seconds)}};
    if (!info.environment_credit.empty())
        facts.insert(facts.begin() + 2, {"Credit", info.environment_credit});
    page.facts(facts);
    if (!info.command_line.empty()) page.code(info.command_line);
}

}  // namespace

std::string study_page(const StudyInfo& info, const std::vector<StudyMetal>& metals) {
    Page page("Metals, measured and looked up");
    page.banner("drude " + info.version,
                "Optical constants of metals fitted to simulated ellipsometry, rendered beside "
                "those of the literature, and the difference between the two.");
    introduce(page, info, metals);
    summarise(page, metals);
    for (const StudyMetal& metal : metals) show_metal(page, metal);
    document(page, info, metals);
    return page.html();
}

}  // namespace drude
