#include "fitter/fitted_material.h"

#include <filesystem>

#include "base/error.h"

namespace drude {

Material fitted_material(const FitResult& fit, const Measurement& measurement,
                         const std::string& name, Provenance provenance) {
    Material material;
    material.name = name;
    if (material.name.empty()) material.name = measurement.header_value("sample");
    if (material.name.empty()) {
        material.name = std::filesystem::path(measurement.file).stem().string();
    }
    if (material.name.empty()) material.name = "fitted";
    OpticalConstants& constants = material.substrate;
    constants.name = material.name;
    constants.material = material.name;
    constants.kind = "fitted";
    constants.citation = fmt::format(
        "pseudo n, k: fitted to Psi and Delta as those of a bare surface (estimator {}); an oxide "
        "or roughness is contained in them",
        fit.estimator);
    for (const FittedPoint& point : fit.points) {
        if (!point.identifiable) continue;
        constants.wavelength_nm.push_back(point.wavelength_nm);
        constants.n.push_back(point.n);
        constants.k.push_back(point.k);
        constants.sigma_n.push_back(point.sigma_n);
        constants.sigma_k.push_back(point.sigma_k);
    }
    if (constants.wavelength_nm.empty()) {
        throw Error(Cause::answer_is_no, "no wavelength of the fit is identifiable: no material");
    }
    material.provenance = std::move(provenance);
    for (const std::string& warning : fit.warnings) {
        material.provenance.warnings.push_back(warning);
    }
    material.check();
    return material;
}

}  // namespace drude
