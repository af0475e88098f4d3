#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/numbers.h"
#include "base/text_table.h"
#include "report/study_report.h"

namespace drude {

namespace {

std::string header(const std::string& key, const std::string& value) {
    return value.empty() ? "" : format_header_line(key, value);
}

std::string row(const std::vector<double>& values) {
    std::string out;
    for (size_t i = 0; i < values.size(); ++i) out += (i ? "," : "") + format_double(values[i]);
    return out + "\n";
}

bool all_finite(const std::vector<double>& values) {
    return std::all_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); });
}

}  // namespace

std::string study_nk_csv(const StudyInfo& info, const StudyMetal& metal) {
    const OpticalConstants& fitted = metal.fitted;
    OpticalConstants literature = metal.literature;
    literature.policy = RangePolicy::clamp;
    const bool compared = !literature.wavelength_nm.empty();
    const bool sigmas = fitted.sigma_n.size() == fitted.n.size() &&
                        fitted.sigma_k.size() == fitted.k.size() && !fitted.n.empty();

    std::string out =
        header("sample", metal.name) +
        header("origin", "fitted to what a virtual bench captured of a published set") +
        header("sample_set", metal.sample_set) +
        header("sample_set_citation", metal.sample_set_citation) +
        header("literature_set", metal.literature_set) +
        header("literature_set_citation", metal.literature_set_citation) +
        header("seed", fmt::format("{}", metal.capture.seed)) +
        header("software", "drude " + info.version);
    if (compared && !fitted.wavelength_nm.empty())
        out += header("note", literature.range_warning(fitted.first_nm(), fitted.last_nm()));
    out += "wavelength_nm,n_fitted,k_fitted";
    if (sigmas) out += ",sigma_n,sigma_k";
    if (compared) out += ",n_literature,k_literature,delta_n,delta_k";
    out += "\n";
    for (size_t i = 0; i < fitted.wavelength_nm.size(); ++i) {
        std::vector<double> values = {fitted.wavelength_nm[i], fitted.n[i], fitted.k[i]};
        if (sigmas) values.insert(values.end(), {fitted.sigma_n[i], fitted.sigma_k[i]});
        if (compared) {
            const Index there = literature.at(fitted.wavelength_nm[i]);
            values.insert(values.end(),
                          {there.n, there.k, fitted.n[i] - there.n, fitted.k[i] - there.k});
        }
        out += row(values);
    }
    return out;
}

std::string study_summary_csv(const Study& study) {
    const StudyInfo& info = study.info;
    std::string head =
        header("software", "drude " + info.version) + header("command", info.command_line) +
        header("environment", info.environment) + header("lobe", info.lobe) +
        header("masking", info.masking) + header("beta_rad", format_double(info.beta));
    std::string rows;
    for (size_t i = 0; i < study.metals.size(); ++i) {
        const StudyMetal& m = study.metals[i];
        const std::string key = fmt::format("metal_{}", i + 1);
        head += header(key, fmt::format("{} (sample {}, literature {})", m.name, m.sample_set,
                                        m.literature_set));
        if (!m.pair) {
            head += header(key + "_note", "left out: no pictures");
            continue;
        }
        const Log10Difference& d = m.pair->log10;
        const std::vector<double> values = {static_cast<double>(i + 1),
                                            static_cast<double>(m.capture.seed),
                                            m.reduced_chi2,
                                            m.dof,
                                            m.rms_dn,
                                            m.rms_dk,
                                            d.mean,
                                            d.p50,
                                            d.p99,
                                            d.max,
                                            m.pair->mean_absolute,
                                            m.pair->mean_delta_e};
        if (all_finite(values)) {
            rows += row(values);
        } else {
            head += header(key + "_note", "left out: a figure is not finite");
        }
    }
    return head +
           "metal,seed,reduced_chi2,dof,rms_dn,rms_dk,log10_mean,log10_p50,log10_p99,log10_max,"
           "mean_absolute,mean_delta_e\n" +
           rows;
}

}  // namespace drude
