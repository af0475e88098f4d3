#include "report/film_sample.h"

#include <fmt/format.h>

#include <cmath>

#include "base/files.h"
#include "base/sha256.h"
#include "fitter/fit.h"
#include "fitter/fitted_material.h"
#include "fitter/row_residuals.h"
#include "materials/porous_film.h"

namespace drude {

namespace {

constexpr double thickness_nm = 3000, porosity = 0.1;
constexpr const char* substrate_set = "Al-Rakic";
constexpr const char* film_set = "Al2O3-Malitson-o";

// Over all that the bench sees, every nanometre.
Material anodised(const VirtualBenchSettings& bench) {
    Material material = material_from_set(published_set(substrate_set));
    material.name = "anodised aluminium";
    FilmLayer layer;
    layer.thickness_nm = thickness_nm;
    std::vector<double> wavelengths_nm;
    for (double nm = std::floor(bench.first_nm); nm <= std::ceil(bench.last_nm); ++nm) {
        wavelengths_nm.push_back(nm);
    }
    layer.constants = porous_constants(published_set(film_set), porosity, wavelengths_nm);
    layer.constants.name = "porous alumina";
    layer.constants.material = "Al2O3";
    layer.constants.citation =
        fmt::format("Bruggeman mixture of {} with {} % pores", film_set, 100 * porosity);
    material.layers = {layer};
    return material;
}

}  // namespace

StudyFilm study_film(CaptureSite site, const Calibration& calibration, const Provenance& provenance,
                     int threads) {
    // A pixel a bin: where fringes are 17 nm apart, Delta turns too fast for a mean over a
    // nanometre to be its value in the middle.
    site.settings.pixels =
        1 + static_cast<int>(std::lround(site.settings.last_nm - site.settings.first_nm));
    StudyFilm film;
    film.name = "Anodised aluminium";
    film.folder = site.within;
    film.substrate_set = substrate_set;
    film.film_set = film_set;
    const auto write = [&](const std::string& file, const std::string& text) {
        const std::string name = film.folder + "/" + file;
        write_file(site.folder + "/" + name, text);
        site.files->push_back(name);
    };

    Recipe recipe = default_recipe(RecipeKind::psi_delta);
    recipe.step_nm = 1;
    const Material sample = anodised(site.settings);
    write("sample.json", format_material(sample));
    write("recipe.json", format_recipe(recipe));
    write("bench.json", virtual_bench_file(site, "sample.json", "../bench/calibration.json"));
    Captured captured = capture_on_bench(site, sample, recipe, "measurement.journal", calibration);
    const std::string& text = captured.text;
    write("measurement.csv", text);
    film.capture = std::move(captured.about);
    const Measurement measurement = parse_measurement(text, "measurement.csv");
    const Measurement weighed = with_common_error(measurement, film.capture.common);
    Provenance from = provenance;
    from.measurement_sha256 = sha256(text);

    FitOptions options;
    options.threads = threads;
    options.chi2_common_scatter = chi2_common_scatter(measurement, film.capture.common);
    const FitResult bare = fit_measurement(weighed, options);
    film.bare_chi2 = bare.chi2_reduced();
    film.bare_dof = bare.dof();
    write("bare.json", format_material(fitted_material(bare, measurement, "bare", from)));

    options.model = "film";
    options.film.substrate = published_set(substrate_set);
    options.film.material = published_set(film_set);
    const FitResult fit = fit_measurement(weighed, options);
    film.film_chi2 = fit.chi2_reduced();
    film.film_dof = fit.dof();
    for (const RowResidual& row : row_residuals(fit, measurement, options)) {
        if (std::isfinite(row.squared())) film.noise_chi2 += row.squared() / fit.dof();
    }
    for (const FittedParameter& p : fit.common) {
        const double truth = p.name == "thickness" ? thickness_nm : porosity;
        film.parameters.push_back({p.name, p.unit, p.value, p.sigma, truth});
    }
    write("fitted.json", format_material(fitted_material(fit, measurement, film.folder, from)));
    return film;
}

}  // namespace drude
