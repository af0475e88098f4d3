// The sections of a study's page about the bench: what was captured, and what the lobe scans hold.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "fitter/paper_table.h"
#include "report/fit_plots.h"
#include "report/study_fit.h"
#include "report/study_lobe.h"
#include "report/study_sections.h"

namespace drude {

namespace {

// "81 wavelengths, 380 to 780 nm, at 45°, 60°".
std::string extent(const Measurement& measurement) {
    const std::vector<double> wavelengths = measurement.wavelengths();
    if (wavelengths.empty()) return "no rows";
    std::string angles;
    for (const double angle : measurement.angles())
        angles += fmt::format("{}{:g}°", angles.empty() ? "" : ", ", angle);
    return fmt::format("{} wavelengths, {:g} to {:g} nm, at {}", wavelengths.size(),
                       wavelengths.front(), wavelengths.back(), angles);
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

double median(std::vector<double> values) {
    if (values.empty()) return std::nan("");
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

// Two digits of a small number of degrees.
std::string degrees(double value) {
    return std::isfinite(value) ? fmt::format("{:.2g}", value) : "–";
}

std::vector<std::string> capture_row(const std::string& name, const Measurement& measurement,
                                     const StudyCapture& capture) {
    std::vector<double> psi, delta, common_psi, common_delta;
    for (const MeasurementRow& row : measurement.rows) {
        psi.push_back(row.sigma_psi_deg);
        delta.push_back(row.sigma_delta_deg);
    }
    for (const CommonError& error : capture.common) {
        common_psi.push_back(error.sigma_psi_deg);
        common_delta.push_back(error.sigma_delta_deg);
    }
    return {name,
            fmt::format("{:.3g}", capture.integration_s),
            fmt::format("{}", capture.frames),
            fmt::format("{:.1f}", capture.bench_seconds / 3600),
            degrees(median(psi)) + " / " + degrees(median(delta)),
            degrees(median(common_psi)) + " / " + degrees(median(common_delta)),
            fmt::format("{:.2g}", 100 * capture.harmonic_4),
            number_text(capture.residual_over_noise, 2),
            fmt::format("{}", capture.saturated)};
}

void capture_table(Page& page, const Study& study) {
    PageTable table;
    table.caption =
        "Each sweep: exposure, frames kept, hours by the bench's own clock; standard deviations of "
        "Ψ / Δ in degrees, by noise at one wavelength (the median) and by what all wavelengths of "
        "an angle share (mounts and calibration); the largest fourth harmonic of a scan in per "
        "cent of its mean, the rms residual over the stated noise, and readings left out because "
        "they were saturated.";
    table.columns = {"Sample",   "Exposure (s)", "Frames",   "Hours",    "σ noise",
                     "σ common", "4P (%)",       "Residual", "Saturated"};
    table.numeric = {false, true, true, true, true, true, true, true, true};
    std::set<std::string> warnings;
    const auto add = [&](const std::string& name, const Measurement& measurement,
                         const StudyCapture& capture) {
        table.rows.push_back(capture_row(name, measurement, capture));
        for (const std::string& warning : capture.warnings) warnings.insert(name + ": " + warning);
    };
    for (const StudyMetal& m : study.metals) add(m.name, m.measurement, m.capture);
    if (study.film) add(study.film->name, study.film->measurement, study.film->capture);
    page.table(table);
    if (warnings.empty()) return;
    PageTable said;
    said.caption = "What the sweeps warned of.";
    said.columns = {"Warning"};
    for (const std::string& warning : warnings) said.rows.push_back({warning});
    page.details(fmt::format("{} warnings of the sweeps", warnings.size()), said);
}

std::string lobe_text(Lobe lobe, double beta) {
    return fmt::format("{}, β = {:g}", lobe_name(lobe), beta);
}

}  // namespace

void section_captured(Page& page, const Study& study) {
    page.section("What was captured", "captured");
    page.paragraph(fmt::format(
        "Ψ and Δ against wavelength at {} of incidence: tan Ψ is how much p light is attenuated "
        "against s light by the reflection, Δ how far it falls behind it. No noise was added to "
        "either: a simulated lamp shone through a turning polariser on the sample and through a "
        "retarder and an analyser into a spectrometer, and these are reduced from the counts of "
        "its raw frames, by the same program that drives real parts (drude capture). Points are "
        "the capture, lines the fitted model.{}",
        angles_text(study), study.film ? " " + study.film->name + " is in figure 6 below." : ""));
    page.paragraph(
        "The bench is one of ordinary parts, with what is wrong with these: photon and read noise, "
        "dark counts, a lamp that drifts and is partly polarised, a spectrometer that is not "
        "linear, polarisers that leak, axes beside their marks, an eccentric mount, and mounts "
        "that miss each stop by a little. It was calibrated as a bench is: straight through, and "
        "with a gold mirror; what the program knows of it is that calibration, not its settings.");
    std::vector<std::pair<std::string, std::string>> facts;
    for (const StudyMetal& m : study.metals) facts.emplace_back(m.name, extent(m.measurement));
    if (study.film) facts.emplace_back(study.film->name, extent(study.film->measurement));
    page.facts(facts);
    capture_table(page, study);
    if (!study.info.bench.empty()) {
        page.paragraph("The bench's settings, where they are not zero or the program's own:");
        page.code(study.info.bench);
    }
    page.paragraph(
        "Journals with every raw frame lie in the study's folder, beside what they were taken "
        "with. A sweep again, and the reduction of its journal alone:");
    page.code(
        "drude capture bench/psi-delta.json --instrument copper/bench.json -o copper.csv\n"
        "drude reduce copper/measurement.journal --calibration bench/calibration.json -o "
        "copper.csv");
    page.begin_grid();
    for (const StudyMetal& m : study.metals) {
        const std::vector<FitFigure> figures = data_figures(fit_report_of(m));
        page.svg(figures[0].svg, "");
        page.svg(figures[1].svg, "");
    }
    page.end_grid();
}

void section_lobes(Page& page, const Study& study) {
    const bool any = std::any_of(study.metals.begin(), study.metals.end(),
                                 [](const StudyMetal& m) { return m.lobe.has_value(); });
    if (!any) return;
    page.section("The lobes", "lobes");
    page.paragraph(
        "Ψ and Δ hold nothing of a surface's roughness: the facets' distribution and their masking "
        "cancel in the ratio. A lobe scan does: the detector moves over the lobe, with the "
        "polariser along s and along p, and is compared with the straight-through beam. Each "
        "sample was made with a lobe and a β that the fit was not told; all four lobes were fitted "
        "to its scan, with n and k from its Ψ and Δ.");
    PageTable table;
    table.caption = fmt::format(
        "Made with, and found. σ is that of β: of the noise, or, where that is more, of what the "
        "residuals scatter from one position of the detector to the next, where mounts and lamp "
        "err for all wavelengths together. Lobes within {:g} of the best χ² are a tie. Recovered: "
        "the sample's lobe alone is left, and its β is within 4σ.",
        lobe_tie);
    table.columns = {"Sample", "Made with", "Found",     "β",      "σ(β)",
                     "Off by", "χ²/dof",    "Ties with", "Verdict"};
    table.numeric = {false, false, false, true, true, true, true, false, false};
    for (const StudyMetal& m : study.metals) {
        if (!m.lobe) continue;
        const StudyLobe& lobe = *m.lobe;
        const FittedLobe& best = lobe.fit.lobes.front();
        const FittedLobe& own = own_lobe(lobe);
        const std::string ties = tied_with(lobe);
        table.rows.push_back(
            {m.name, lobe_text(lobe.true_lobe, lobe.true_beta), std::string(lobe_name(best.lobe)),
             number_text(best.beta, 5), fmt::format("{:.1e}", lobe.sigma.front()),
             fmt::format("{:+.1f} σ", (own.beta - lobe.true_beta) / own_sigma(lobe)),
             number_text(best.chi2 / std::max(1, lobe.fit.dof()), 2), ties.empty() ? "–" : ties,
             lobe_verdict_text(lobe_verdict(lobe))});
    }
    page.table(table);
    page.begin_grid();
    for (const StudyMetal& m : study.metals) {
        if (!m.lobe || m.lobe->scan.rows.empty()) continue;
        page.svg(lobe_plot(m, 550),
                 fmt::format("{}: points are the scan (s and p), lines the {} lobe that fits best, "
                             "dashed another that fits worse.",
                             m.name, lobe_name(m.lobe->fit.lobes.front().lobe)));
    }
    page.end_grid();
}

}  // namespace drude
