#include "render/surface_decisions.h"

#include <algorithm>
#include <cmath>

#include "materials/film_average.h"
#include "materials/film_table.h"
#include "render/decision_costs.h"
#include "render/surface_model.h"

namespace drude {

namespace {

struct NamedLobe {
    std::string name;
    double width = 0;  // beta, or alpha
    double blur = 0;   // lobe_blur()
};

// Conductors that shapes may be made of, bare and under coats; every material counts once.
std::vector<const ConductorMaterial*> metals(const Scene& scene) {
    std::vector<const ConductorMaterial*> list;
    for (const SurfaceMaterial& material : scene.materials) {
        if (const auto* metal = std::get_if<ConductorMaterial>(&material)) list.push_back(metal);
        if (const auto* coated = std::get_if<CoatedMaterial>(&material)) {
            if (const auto* base = std::get_if<ConductorMaterial>(&coated->base)) {
                list.push_back(base);
            }
        }
    }
    return list;
}

std::vector<NamedLobe> lobes(const Scene& scene) {
    std::vector<NamedLobe> list;
    const auto add_alpha = [&](const std::string& name, double alpha) {
        list.push_back({fmt::format("{}, alpha {:.4g}", name, alpha), alpha, 2 * alpha});
    };
    for (const ConductorMaterial* metal : metals(scene)) {
        const Material& surface = metal->surface;
        if (metal->alpha >= 0) {
            add_alpha(surface.name, metal->alpha);
        } else {
            list.push_back({fmt::format("{}, {} beta {:.4g}", surface.name, lobe_name(surface.lobe),
                                        surface.beta),
                            surface.beta, lobe_blur(surface.lobe, surface.beta)});
        }
    }
    for (const SurfaceMaterial& material : scene.materials) {
        if (const auto* glass = std::get_if<DielectricMaterial>(&material)) {
            add_alpha("dielectric", glass->alpha);
        } else if (const auto* coat = std::get_if<CoatedMaterial>(&material)) {
            add_alpha("coat", coat->alpha);
        }
    }
    return list;
}

}  // namespace

ModelDecision lobe_decision(const Scene& scene, const RenderOptions& options) {
    const SurfaceModel model = surface_model(scene, options);
    const double pixel = pixel_angle(scene);
    const bool small_lights = has_small_lights(scene);
    size_t flat = 0, replaced = 0, widened = 0, kept = 0;
    const NamedLobe* narrowest = nullptr;
    double lost_blur = 0;
    const std::vector<NamedLobe> all = lobes(scene);
    for (const NamedLobe& lobe : all) {
        const double drawn = model.lobe_width(lobe.width);
        if (!(lobe.width > 0)) {
            ++flat;
        } else if (drawn == 0) {
            ++replaced;
            lost_blur = std::max(lost_blur, lobe.blur);
        } else {
            ++(drawn > lobe.width ? widened : kept);
            if (narrowest == nullptr || lobe.width < narrowest->width) narrowest = &lobe;
        }
    }
    const auto error = [&](double blur) -> DecisionFigure {
        if (small_lights && blur > 0) {
            return {1, "of the highlights of distant, point and spot lights",
                    "proved: a mirror never meets a light without extent"};
        }
        if (!(pixel > 0) && blur > 0) {
            return {std::nullopt, "", "parallel rays: a flat mirror has no blur small enough"};
        }
        return {mirror_error(blur, pixel), "of the contrast at an edge, in its pixel",
                fmt::format("computed: facets lead light astray by {:.3g} rad, pixels see {:.3g} "
                            "rad; off flat and convex surfaces",
                            blur, pixel)};
    };
    const auto rays = [&](bool lobe) -> DecisionFigure {
        return {lobe ? 2.0 : 1.0, "rays a reflection at most",
                "computed: light is sampled off lobes, not off mirrors"};
    };
    ModelDecision decision;
    decision.name = "mirror or lobe";
    decision.asked = options.mirror_below.has_value();
    std::string& choice = decision.choice;
    const auto count = [&](size_t n, const std::string& what) {
        if (n > 0) choice += fmt::format("{}{} {}", choice.empty() ? "" : ", ", n, what);
    };
    count(kept, kept == 1 ? "lobe" : "lobes");
    count(widened, fmt::format("drawn with {:g}", mirror_below_beta));
    count(replaced, "replaced by a mirror");
    count(flat, "smooth by definition");
    if (choice.empty()) choice = "no specular surface";
    if (decision.asked) {
        decision.reason = fmt::format("lobes below {:.4g} are to be mirrors", model.mirror_below);
    } else if (small_lights) {
        decision.reason = fmt::format(
            "lights without extent are seen in lobes only: none is too narrow; below {:g} a lobe "
            "is as wide as that",
            mirror_below_beta);
    } else {
        decision.reason =
            fmt::format("below {:g} float directions resolve no facets: such lobes are mirrors",
                        mirror_below_beta);
    }
    decision.cost = rays(kept + widened > 0);
    decision.error = error(lost_blur);
    if (narrowest != nullptr) {
        decision.alternatives.push_back(
            {fmt::format("a mirror for the narrowest lobe ({})", narrowest->name),
             rays(kept + widened > 1), error(narrowest->blur)});
    }
    if (replaced > 0) {
        decision.alternatives.push_back(
            {"lobes for all",
             rays(true),
             {mirror_error(2 * mirror_below_beta, pixel),
              "of the contrast at an edge, in its pixel",
              fmt::format("computed: a lobe as wide as {:g}", mirror_below_beta)}});
    }
    decision.override_option = "--mirror-below BETA (0: never)";
    return decision;
}

ModelDecision film_decision(const Scene& scene, const RenderOptions& options) {
    const SurfaceModel model = surface_model(scene, options);
    const double gain = model.gain_of_films;
    const char* of_what = gain > 1 ? "of the light, at most" : "of Rs, Rp, C or S, at most";
    const auto changed = [&](double effect, std::string basis) -> DecisionFigure {
        if (gain > 1) {
            basis += fmt::format(
                "; times {:.3g}, what reflections between surfaces of the scene's largest albedo "
                "make of it",
                gain);
        }
        return {std::min(1.0, gain * effect), of_what, basis};
    };
    const auto computed = [&](double effect) {
        return changed(effect, "computed: film_effect(), 380 to 780 nm, 0 to 88 degrees");
    };
    const DecisionFigure table{film_table_ns, "ns a reflection at 8 wavelengths", measured_costs};
    const DecisionFigure bare{bare_ns, "ns a reflection at 8 wavelengths", measured_costs};
    size_t kept = 0, left_out = 0;
    double lost = 0, weakest = 1;
    for (const ConductorMaterial* metal : metals(scene)) {
        if (metal->surface.layers.empty() || metal->reflectance) continue;
        const double effect = film_effect(metal->surface);
        if (model.keeps_films(metal->surface)) {
            ++kept;
            weakest = std::min(weakest, effect);
        } else {
            ++left_out;
            lost = std::max(lost, effect);
        }
    }
    ModelDecision decision;
    decision.name = "film or bare metal";
    decision.asked = options.films != FilmUse::automatic;
    decision.override_option = "--films auto|keep|leave-out";
    decision.error = computed(lost);
    if (kept + left_out == 0) {
        decision.choice = "bare metal";
        decision.reason = "no metal of the scene has a film";
        decision.cost = bare;
        decision.error = {0, of_what, "proved: there is nothing to leave out"};
        return decision;
    }
    decision.choice = left_out == 0 ? "film"
                      : kept == 0   ? "bare metal"
                                    : fmt::format("{} with films, {} bare", kept, left_out);
    decision.reason =
        decision.asked
            ? "asked for"
            : fmt::format(
                  "films that change less than {:g} {}are left out: as much as a "
                  "film's table may be wrong by",
                  negligible_film_effect, gain > 1 ? "of the light, after all reflections, " : "");
    decision.cost = kept > 0 ? table : bare;
    if (kept > 0) {
        decision.error = changed(std::max(lost, film_table_tolerance),
                                 "computed: what is left out, or the tolerance of the film's "
                                 "table");
        decision.alternatives.push_back({"bare metal", bare, computed(weakest)});
    }
    if (left_out > 0) {
        decision.alternatives.push_back(
            {"film", table, changed(film_table_tolerance, "the tolerance of the film's table")});
    }
    return decision;
}

ModelDecision table_decision(const Scene& scene, const RenderOptions& options) {
    const SurfaceModel model = surface_model(scene, options);
    // A nanometre's mean against the value in its middle is a 24th of the second difference.
    double curvature = 0;
    size_t most_stacks = 0, filmed = 0;
    for (const ConductorMaterial* metal : metals(scene)) {
        if (metal->reflectance) continue;
        const Material& surface = metal->surface;
        if (model.keeps_films(surface)) {
            ++filmed;
            for (const double nm : {400.0, 550.0, 700.0}) {
                const int harmonics = film_harmonics(surface, nm, 0.5);
                most_stacks =
                    std::max(most_stacks, film_samples(surface, nm, 1.0, harmonics).size());
            }
            continue;
        }
        const DenseIndex index = dense(surface.substrate);
        const auto reflectance = [&](int i) {
            return reflect(ComplexIndex<double>{index.n[i], index.k[i]}, 1.0).A();
        };
        for (int i = 1; i + 1 < spectrum_size; ++i) {
            curvature = std::max(
                curvature, std::abs(reflectance(i - 1) - 2 * reflectance(i) + reflectance(i + 1)));
        }
    }
    ModelDecision decision;
    decision.name = "table or formula";
    decision.override_option = "none: the formula at every nanometre is what the tables hold";
    const DecisionFigure grid{curvature / 24, "of the reflectance at normal incidence",
                              "computed: a nanometre's mean against its middle"};
    const DecisionFigure bare{bare_ns, "ns a reflection at 8 wavelengths", measured_costs};
    if (filmed == 0) {
        decision.choice = "n and k from 1 nm tables, reflection by formula";
        decision.reason = "the closed form of a bare metal is as fast as a table over the angle";
        decision.cost = bare;
        decision.error = grid;
        return decision;
    }
    decision.choice = fmt::format(
        "films from tables over angle and nanometre, each averaged over up to {} stacks",
        most_stacks);
    decision.reason =
        most_stacks > 4
            ? "the fringes of a film turn within a nanometre: single values would alias"
            : "a film is smooth over a nanometre; its formula costs more than a look into a table";
    decision.cost = {film_table_ns, "ns a reflection at 8 wavelengths", measured_costs};
    decision.error = {std::max(film_table_tolerance, grid.value.value_or(0)),
                      "of Rs, Rp, C or S, at most", "the tolerance that the table was made to"};
    decision.alternatives.push_back(
        {"the formula of one film, at whole nanometres alone",
         {film_formula_ns, "ns a reflection at 8 wavelengths", measured_costs},
         {std::nullopt, "", "as much as a fringe where it turns within a nanometre"}});
    return decision;
}

}  // namespace drude
