#include "report/film_sample.h"

#include <fmt/format.h>

#include "base/files.h"
#include "base/sha256.h"
#include "device/virtual/ellipsometer_simulation.h"
#include "fitter/fit.h"
#include "fitter/fitted_material.h"
#include "materials/effective_medium.h"

namespace drude {

namespace {

constexpr double thickness_nm = 3000, porosity = 0.1;
constexpr const char* substrate_set = "Al-Rakic";
constexpr const char* film_set = "Al2O3-Malitson-o";

Material anodised(const std::vector<double>& wavelengths_nm) {
    Material material = material_from_set(published_set(substrate_set));
    material.name = "anodised aluminium";
    FilmLayer layer;
    layer.thickness_nm = thickness_nm;
    layer.constants.name = "porous alumina";
    layer.constants.material = "Al2O3";
    layer.constants.kind = "calculated";
    layer.constants.citation =
        fmt::format("Bruggeman mixture of {} with {} % pores", film_set, 100 * porosity);
    for (const double nm : wavelengths_nm) {
        const Index dense = published_set(film_set).at(nm);
        const auto index =
            bruggeman(ComplexIndex<double>{dense.n, dense.k}, ComplexIndex<double>{1, 0}, porosity);
        layer.constants.wavelength_nm.push_back(nm);
        layer.constants.n.push_back(index.n);
        layer.constants.k.push_back(index.k);
    }
    material.layers = {layer};
    return material;
}

}  // namespace

StudyFilm study_film(const std::string& folder, uint64_t seed, const Provenance& provenance,
                     int threads, std::vector<std::string>* files) {
    StudyFilm film;
    film.name = "Anodised aluminium";
    film.folder = "anodised-aluminium";
    film.substrate_set = substrate_set;
    film.film_set = film_set;
    film.seed = seed;
    make_folder(folder + "/" + film.folder);
    const auto write = [&](const std::string& file, const std::string& text) {
        const std::string name = film.folder + "/" + file;
        write_file(folder + "/" + name, text);
        files->push_back(name);
    };

    SimulationSetup setup;
    setup.angles_deg = {45, 50, 60, 70, 75, 80};
    for (int nm = 380; nm <= 780; ++nm) setup.wavelengths_nm.push_back(nm);
    setup.seed = seed;
    const Material sample = anodised(setup.wavelengths_nm);
    const Measurement measurement = simulate_ellipsometer(sample, setup);
    const std::string text = format_measurement(measurement);
    write("measurement.csv", text);
    write("sample.json", format_material(sample));
    Provenance from = provenance;
    from.measurement_sha256 = sha256(text);

    FitOptions options;
    options.threads = threads;
    const FitResult bare = fit_measurement(measurement, options);
    film.bare_chi2 = bare.chi2_reduced();
    film.bare_dof = bare.dof();
    write("bare.json", format_material(fitted_material(bare, measurement, "bare", from)));

    options.model = "film";
    options.film.substrate = published_set(substrate_set);
    options.film.material = published_set(film_set);
    const FitResult fit = fit_measurement(measurement, options);
    film.film_chi2 = fit.chi2_reduced();
    film.film_dof = fit.dof();
    for (const FittedParameter& p : fit.common) {
        const double truth = p.name == "thickness" ? thickness_nm : porosity;
        film.parameters.push_back({p.name, p.unit, p.value, p.sigma, truth});
    }
    write("fitted.json", format_material(fitted_material(fit, measurement, film.folder, from)));
    return film;
}

}  // namespace drude
