#include "report/claim_figures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "device/virtual/ellipsometer_simulation.h"
#include "fitter/fit.h"
#include "fitter/fitted_material.h"
#include "materials/surface.h"
#include "materials/torrance_sparrow.h"

namespace drude {

namespace {

constexpr double radians = std::numbers::pi / 180;

OpticalConstants clamped(OpticalConstants set) {
    set.policy = RangePolicy::clamp;
    return set;
}

}  // namespace

std::string percent_text(double share) {
    return std::abs(share) < 0.1 && share != 0 ? fmt::format("{:.2g} %", 100 * share)
                                               : fmt::format("{:.0f} %", 100 * share);
}

const StudyMetal* find_metal(const Study& study, const std::string& folder) {
    for (const StudyMetal& metal : study.metals) {
        if (metal.folder == folder) return &metal;
    }
    return nullptr;
}

double ratio_deviation(const Measurement& measurement, const OpticalConstants& set) {
    const Material material = material_from_set(clamped(set));
    double sum = 0;
    for (const MeasurementRow& row : measurement.rows) {
        const auto r = reflect(material, row.wavelength_nm, std::cos(row.angle_deg * radians));
        const double t = std::tan(row.psi_deg * radians), predicted = r.Rp / r.Rs;
        sum += std::pow((t * t - predicted) / predicted, 2);
    }
    return std::sqrt(sum / static_cast<double>(measurement.rows.size()));
}

EnvelopeShare envelope_share(const StudyMetal& metal) {
    EnvelopeShare result;
    const OpticalConstants& fitted = metal.fitted;
    std::vector<const OpticalConstants*> others;
    for (const OpticalConstants& set : metal.published) {
        if (set.name != metal.sample_set) others.push_back(&set);
    }
    const bool sigmas = fitted.sigma_n.size() == fitted.n.size();
    int inside = 0, tested = 0;
    for (size_t i = 0; i < fitted.n.size(); ++i) {
        const double nm = fitted.wavelength_nm[i];
        constexpr double infinity = std::numeric_limits<double>::infinity();
        double low[2] = {infinity, infinity}, high[2] = {-infinity, -infinity};
        int sets = 0;
        for (const OpticalConstants* set : others) {
            if (!set->covers(nm, nm)) continue;
            ++sets;
            const Index at = set->at(nm);
            const double values[2] = {at.n, at.k};
            for (int c = 0; c < 2; ++c) {
                low[c] = std::min(low[c], values[c]);
                high[c] = std::max(high[c], values[c]);
            }
        }
        result.sets = std::max(result.sets, sets);
        if (sets < 2) continue;
        ++tested;
        const double margin_n = sigmas ? 3 * fitted.sigma_n[i] : 0;
        const double margin_k = sigmas ? 3 * fitted.sigma_k[i] : 0;
        inside += fitted.n[i] >= low[0] - margin_n && fitted.n[i] <= high[0] + margin_n &&
                  fitted.k[i] >= low[1] - margin_k && fitted.k[i] <= high[1] + margin_k;
    }
    result.share = tested ? static_cast<double>(inside) / tested : std::nan("");
    return result;
}

double relative_gap(const OpticalConstants& fitted, const OpticalConstants& set, bool n) {
    double gap = 0, sum = 0;
    for (size_t i = 0; i < fitted.n.size(); ++i) {
        const double nm = fitted.wavelength_nm[i];
        if (!set.covers(nm, nm)) continue;
        const Index there = set.at(nm);
        gap += n ? fitted.n[i] - there.n : fitted.k[i] - there.k;
        sum += n ? there.n : there.k;
    }
    return sum > 0 ? gap / sum : std::nan("");
}

double reflectance_error(const Material& sample, const Material& fitted,
                         const Measurement& measurement) {
    double worst = 0;
    for (const MeasurementRow& row : measurement.rows) {
        const double cosine = std::cos(row.angle_deg * radians);
        const double truth = reflect(sample, row.wavelength_nm, cosine).A();
        const double predicted = reflect(fitted, row.wavelength_nm, cosine).A();
        worst = std::max(worst, std::abs(predicted - truth) / truth);
    }
    return worst;
}

HiddenOxide hidden_oxide(const std::string& sample_set, const Measurement& like) {
    Material sample = material_from_set(clamped(published_set(sample_set)));
    sample.layers = {{clamped(published_set("Al2O3-Malitson-o")), 3.0}};
    SimulationSetup setup;
    setup.angles_deg = like.angles();
    setup.wavelengths_nm = like.wavelengths();
    setup.sigma_psi_deg = setup.sigma_delta_deg = 0;
    const Measurement measurement = simulate_ellipsometer(sample, setup);
    const FitResult fit = fit_measurement(measurement, {});
    const Material bare = fitted_material(fit, measurement, "bare", {});
    return {fit.chi2_reduced(), reflectance_error(sample, bare, measurement)};
}

double largest_ratio_change_by_beta(const OpticalConstants& set, const Measurement& measurement) {
    const OpticalConstants constants = clamped(set);
    const std::vector<double> wavelengths = measurement.wavelengths();
    const Vec3<double> s{0, 1, 0};
    double worst = 0;
    for (const double nm :
         {wavelengths.front(), wavelengths[wavelengths.size() / 2], wavelengths.back()}) {
        const Index at = constants.at(nm);
        const Surface<double> surface{ComplexIndex<double>{at.n, at.k}};
        for (const double angle : measurement.angles()) {
            const double sine = std::sin(angle * radians), cosine = std::cos(angle * radians);
            const Vec3<double> i{sine, 0, cosine}, o{-sine, 0, cosine};
            const auto smooth = surface(cosine);
            for (const Lobe lobe :
                 {Lobe::blinn_phong, Lobe::gaussian, Lobe::beckmann, Lobe::trowbridge_reitz}) {
                for (double beta = 0.05; beta < 1.16; beta += 0.1) {
                    const Microfacets<double> facets(lobe, Masking::v_groove, beta);
                    const auto m = evaluate_conductor(facets, surface, i, s, o, s, 1.0);
                    // S1 > 0 along s: Rs = A + B, Rp = A - B, but for one factor of both.
                    const double ratio = (m.m[0][0] - m.m[0][1]) / (m.m[0][0] + m.m[0][1]);
                    worst = std::max(worst, std::abs(ratio * smooth.Rs / smooth.Rp - 1));
                }
            }
        }
    }
    return worst;
}

std::vector<double> psi_at(const Measurement& measurement, double angle_deg) {
    std::vector<std::pair<double, double>> rows;
    for (const MeasurementRow& row : measurement.rows) {
        if (row.angle_deg == angle_deg) rows.emplace_back(row.wavelength_nm, row.psi_deg);
    }
    std::sort(rows.begin(), rows.end());
    std::vector<double> psi;
    for (const auto& row : rows) psi.push_back(row.second);
    return psi;
}

int turning_points(const std::vector<double>& values, double least) {
    if (values.empty()) return 0;
    int count = 0, direction = 0;
    double low = values[0], high = values[0];  // since the last turn
    for (const double v : values) {
        low = std::min(low, v);
        high = std::max(high, v);
        if (direction >= 0 && v < high - least) {
            count += direction > 0;
            direction = -1;
            low = v;
            high = v;
        } else if (direction <= 0 && v > low + least) {
            count += direction < 0;
            direction = 1;
            low = v;
            high = v;
        }
    }
    return count;
}

}  // namespace drude
