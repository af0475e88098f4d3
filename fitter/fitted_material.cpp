#include "fitter/fitted_material.h"

#include <filesystem>

#include "base/error.h"

namespace drude {

namespace {

std::string layer_text(const std::vector<FilmLayer>& layers) {
    std::string text;
    for (const FilmLayer& layer : layers) {
        text += fmt::format("{}{} nm of {}", text.empty() ? "" : " on ", layer.thickness_nm,
                            layer.constants.name);
    }
    return text;
}

Material finished(Material material, const FitResult& fit, Provenance provenance) {
    material.provenance = std::move(provenance);
    for (const std::string& warning : fit.warnings) {
        material.provenance.warnings.push_back(warning);
    }
    material.check();
    return material;
}

}  // namespace

Material fitted_material(const FitResult& fit, const Measurement& measurement,
                         const std::string& name, Provenance provenance) {
    Material material;
    material.name = name;
    if (material.name.empty()) material.name = measurement.header_value("sample");
    if (material.name.empty()) {
        material.name = std::filesystem::path(measurement.file).stem().string();
    }
    if (material.name.empty()) material.name = "fitted";
    if (!fit.substrate.wavelength_nm.empty()) {
        material.substrate = fit.substrate;
        material.layers = fit.layers;
        return finished(std::move(material), fit, std::move(provenance));
    }
    OpticalConstants& constants = material.substrate;
    constants = fit.constants();
    constants.name = material.name;
    constants.material = material.name;
    constants.citation =
        fit.layers.empty() ? fmt::format(
                                 "pseudo n, k: fitted to Psi and Delta as those of a bare surface "
                                 "(estimator {}); an oxide or roughness is contained in them",
                                 fit.estimator)
                           : fmt::format("fitted to Psi and Delta below {} (estimator {})",
                                         layer_text(fit.layers), fit.estimator);
    if (!fit.dispersion.empty()) constants.citation += "; n and k follow " + fit.dispersion;
    material.layers = fit.layers;
    if (constants.wavelength_nm.empty()) {
        throw Error(Cause::answer_is_no, "no wavelength of the fit is identifiable: no material");
    }
    return finished(std::move(material), fit, std::move(provenance));
}

}  // namespace drude
