#include "fitter/lobe_scatter.h"

#include <cmath>
#include <map>
#include <vector>

#include "base/error.h"
#include "fitter/lobe_scan_model.h"
#include "materials/microfacet.h"

namespace drude {

namespace {

std::vector<double> seen_at(const LobeScanModel& model, Lobe lobe, double beta) {
    const LobeDensity<double> density(lobe, beta);
    std::vector<double> facets;
    facets.reserve(model.tan2().size());
    for (const double tan2 : model.tan2()) facets.push_back(density(tan2));
    return model.average(facets);
}

}  // namespace

double scatter_of_beta(const LobeScan& scan, const Material& metal, const FittedLobe& fitted) {
    scan.check();
    metal.check();
    const LobeScanModel model(scan, metal);
    const std::vector<double> m = seen_at(model, fitted.lobe, fitted.beta);
    const double step = 1e-4 * fitted.beta;
    const std::vector<double> above = seen_at(model, fitted.lobe, fitted.beta + step);
    const std::vector<double> below = seen_at(model, fitted.lobe, fitted.beta - step);

    // Of each wavelength, over the standard deviations: the best scale, and what of the derivative
    // by beta the model itself takes up.
    struct Sums {
        double mm = 0, md = 0, ym = 0;
    };
    std::vector<Sums> sums(model.wavelength_count());
    const auto slope = [&](size_t i) { return (above[i] - below[i]) / (2 * step); };
    for (size_t i = 0; i < m.size(); ++i) {
        const LobeDatum& datum = model.data()[i];
        const double w = 1 / (datum.sigma * datum.sigma);
        Sums& s = sums[datum.wavelength];
        s.mm += w * m[i] * m[i];
        s.md += w * m[i] * slope(i);
        s.ym += w * datum.value * m[i];
    }
    // Two data a row, s first.
    std::map<std::pair<double, double>, double> scores;
    double information = 0;
    for (size_t i = 0; i < m.size(); ++i) {
        const LobeDatum& datum = model.data()[i];
        const Sums& s = sums[datum.wavelength];
        if (!(s.mm > 0)) continue;
        const double scale = std::max(s.ym / s.mm, 0.0);
        const double w = 1 / (datum.sigma * datum.sigma);
        const double own = scale * (slope(i) - m[i] * s.md / s.mm);
        information += w * own * own;
        const LobeScanRow& row = scan.rows[i / 2];
        scores[{row.angle_deg, row.offset_deg}] += w * own * (datum.value - scale * m[i]);
    }
    const auto positions = static_cast<double>(scores.size());
    if (scores.size() < 2) {
        throw Error(Cause::answer_is_no,
                    "the scan has one position of the detector: nothing scatters; scan it over "
                    "the lobe");
    }
    double sum = 0;
    for (const auto& [position, score] : scores) sum += score * score;
    return std::sqrt(sum * positions / (positions - 1)) / information;
}

}  // namespace drude
