#include "report/study_lobe.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "fitter/lobe_scan_model.h"
#include "materials/microfacet.h"

namespace drude {

namespace {

size_t own_index(const StudyLobe& lobe) {
    for (size_t i = 0; i < lobe.fit.lobes.size(); ++i) {
        if (lobe.fit.lobes[i].lobe == lobe.true_lobe) return i;
    }
    throw std::logic_error("the sample's lobe was not fitted");
}

// Of one wavelength's rows: what `lobe` makes of them with the scale that fits best, s first and
// then p, in the rows' order.
std::vector<double> lobe_curve(const LobeScan& scan, const Material& metal,
                               const FittedLobe& lobe) {
    const LobeScanModel model(scan, metal);
    const LobeDensity<double> density(lobe.lobe, lobe.beta);
    std::vector<double> facets;
    for (const double tan2 : model.tan2()) facets.push_back(density(tan2));
    std::vector<double> seen = model.average(facets);
    double mm = 0, ym = 0;
    for (size_t i = 0; i < seen.size(); ++i) {
        const LobeDatum& datum = model.data()[i];
        mm += std::pow(seen[i] / datum.sigma, 2);
        ym += seen[i] * datum.value / (datum.sigma * datum.sigma);
    }
    for (double& value : seen) value *= ym / mm;
    return seen;
}

LobeScan at_wavelength(const LobeScan& scan, double wavelength_nm) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const LobeScanRow& row : scan.rows) {
        if (std::abs(row.wavelength_nm - wavelength_nm) < std::abs(nearest - wavelength_nm)) {
            nearest = row.wavelength_nm;
        }
    }
    LobeScan one = scan;
    one.rows.clear();
    std::copy_if(scan.rows.begin(), scan.rows.end(), std::back_inserter(one.rows),
                 [&](const LobeScanRow& row) { return row.wavelength_nm == nearest; });
    return one;
}

}  // namespace

const FittedLobe& own_lobe(const StudyLobe& lobe) {
    return lobe.fit.lobes[own_index(lobe)];
}

double own_sigma(const StudyLobe& lobe) {
    return lobe.sigma.at(own_index(lobe));
}

std::string tied_with(const StudyLobe& lobe) {
    std::vector<std::string_view> names;
    for (size_t i = 1; i < lobe.fit.lobes.size(); ++i) {
        if (lobe.fit.lobes[i].tied) names.push_back(lobe_name(lobe.fit.lobes[i].lobe));
    }
    return fmt::format("{}", fmt::join(names, ", "));
}

LobeVerdict lobe_verdict(const StudyLobe& lobe) {
    const FittedLobe& own = own_lobe(lobe);
    if (!own.tied) return LobeVerdict::lobe_missed;
    if (std::abs(own.beta - lobe.true_beta) > 4 * own_sigma(lobe)) {
        return LobeVerdict::beta_missed;
    }
    return tied_with(lobe).empty() ? LobeVerdict::recovered : LobeVerdict::tie;
}

std::string lobe_verdict_text(LobeVerdict verdict) {
    switch (verdict) {
        case LobeVerdict::recovered:
            return "recovered";
        case LobeVerdict::tie:
            return "tie";
        case LobeVerdict::lobe_missed:
            return "lobe missed";
        case LobeVerdict::beta_missed:
            break;
    }
    return "beta missed";
}

std::string lobe_plot(const StudyMetal& metal, double wavelength_nm) {
    const StudyLobe& lobe = *metal.lobe;
    const LobeScan scan = at_wavelength(lobe.scan, wavelength_nm);
    const std::vector<FittedLobe>& lobes = lobe.fit.lobes;
    auto other =
        std::find_if(lobes.begin(), lobes.end(), [](const FittedLobe& one) { return !one.tied; });
    if (other == lobes.end()) --other;
    const double nm = scan.rows.front().wavelength_nm;
    Plot plot;
    plot.title = fmt::format("{}, the lobe at {:g} nm", metal.name, nm);
    plot.description = fmt::format(
        "Reflectance of {} for s and p polarised light against the offset of the detector from the "
        "mirror direction at {:g} nm: the captured scan, the fitted {} lobe with beta {:.4f} and, "
        "dashed, the {} lobe.",
        metal.name, nm, lobe_name(lobes.front().lobe), lobes.front().beta, lobe_name(other->lobe));
    plot.id = metal.folder + "-lobe";
    plot.x.label = "Detector's offset from the mirror direction (degrees)";
    plot.y.label = "reflectance into the detector";
    plot.y.logarithmic = true;
    const std::vector<double> best = lobe_curve(scan, lobe.surface, lobes.front());
    const std::vector<double> next = lobe_curve(scan, lobe.surface, *other);
    double least = std::numeric_limits<double>::infinity();
    for (const bool s : {true, false}) {
        Series points, line, dashed;
        for (size_t i = 0; i < scan.rows.size(); ++i) {
            const LobeScanRow& row = scan.rows[i];
            const double value = s ? row.reflectance_s : row.reflectance_p;
            const double sigma = s ? row.sigma_s : row.sigma_p;
            for (Series* series : {&points, &line, &dashed}) series->x.push_back(row.offset_deg);
            points.y.push_back(value);
            points.error.push_back(sigma);
            line.y.push_back(best[2 * i + (s ? 0 : 1)]);
            dashed.y.push_back(next[2 * i + (s ? 0 : 1)]);
            // Below the noise a logarithm shows nothing but its depth.
            if (value > 3 * sigma) least = std::min(least, value);
        }
        points.name = s ? "s captured" : "p captured";
        points.mark = Mark::points;
        points.width = 1.8;
        line.name = fmt::format("{} {}", s ? "s" : "p", lobe_name(lobes.front().lobe));
        line.width = 1.2;
        dashed.name = s ? std::string(lobe_name(other->lobe)) : "";
        dashed.dashed = true;
        dashed.width = 1;
        dashed.opacity = 0.7;
        points.colour = line.colour = dashed.colour = s ? 0 : 1;
        plot.series.push_back(std::move(line));
        plot.series.push_back(std::move(dashed));
        plot.series.push_back(std::move(points));
    }
    if (std::isfinite(least)) plot.y.low = least / 3;
    return svg_plot(plot);
}

}  // namespace drude
