#include "render/path_decisions.h"

#include <algorithm>
#include <cmath>

#include "render/batch_tracer.h"
#include "render/bounce_choice.h"
#include "render/decision_costs.h"
#include "render/diattenuation.h"
#include "render/light_choice.h"
#include "render/light_polarisation.h"
#include "render/sampler_choice.h"
#include "render/transport_choice.h"
#include "render/wavelength_choice.h"

namespace drude {

namespace {

constexpr const char* times_scalar = "times the time of scalar";
constexpr const char* of_s0 = "of S0";

DecisionFigure transport_cost_of(Transport transport) {
    return {transport_cost(transport), times_scalar, measured_costs};
}

// What a transport that is not exact here gets wrong. Two surfaces with diattenuations a and b and
// the angle phi between their planes give A1 A2 (1 + a b cos 2phi) in place of A1 A2; polarised
// light and analysers have diattenuation 1.
DecisionFigure scalar_error(const Scene& scene) {
    const double strongest = largest_diattenuation(scene);
    const bool polarised = scene.camera.analyser.has_value() || has_polarised_lights(scene);
    return {strongest * (polarised ? 1 : strongest), of_s0,
            fmt::format("computed: largest diattenuation {:.3g} of the scene's surfaces, {}, for "
                        "two meetings; more of them may exceed it",
                        strongest, polarised ? "in polarised light" : "squared")};
}

}  // namespace

ModelDecision transport_decision(const Scene& scene, const RenderOptions& options) {
    const TransportChoice chosen = transport_choice(scene, options);
    RenderOptions automatic = options;
    automatic.transport.reset();
    automatic.stokes = false;
    // What the cheapest exact one for S0 is decides what the others would get wrong.
    const Transport cheapest = transport_choice(scene, automatic).transport;
    const auto error = [&](Transport transport) -> DecisionFigure {
        if (transport != Transport::scalar || cheapest == Transport::scalar) {
            return {0, of_s0, "proved: carries all that S0 depends on here"};
        }
        return scalar_error(scene);
    };
    ModelDecision decision;
    decision.name = "transport";
    decision.choice = transport_name(chosen.transport);
    decision.asked = options.transport.has_value();
    decision.reason = chosen.reason;
    decision.cost = transport_cost_of(chosen.transport);
    decision.error = error(chosen.transport);
    for (const Transport other : {Transport::scalar, Transport::intensity, Transport::stokes}) {
        // Without S1 to S3 a picture with these layers is none.
        const bool lacks = options.stokes && other != Transport::stokes;
        if (other == chosen.transport || lacks) continue;
        decision.alternatives.push_back(
            {std::string(transport_name(other)), transport_cost_of(other), error(other)});
    }
    decision.override_option = "--transport scalar|intensity|stokes";
    return decision;
}

ModelDecision wavelength_decision(const Scene& scene, const RenderOptions& options) {
    const WavelengthChoice automatic = cheapest_exact_wavelengths(scene, options);
    const int chosen = options.wavelengths ? options.wavelengths : automatic.wavelengths;
    const Transport transport = transport_choice(scene, options).transport;
    const auto cost = [&](int wavelengths) -> DecisionFigure {
        return {wavelengths_cost(transport, wavelengths), "times the time of 8", measured_costs};
    };
    const DecisionFigure unbiased{
        0, "of R, G, B", "proved: the wavelengths' phase is uniform, so any number is unbiased"};
    ModelDecision decision;
    decision.name = "wavelengths a path";
    decision.choice = fmt::format("{}", chosen);
    decision.asked = options.wavelengths != 0;
    decision.reason = decision.asked ? "asked for" : automatic.reason;
    decision.cost = cost(chosen);
    decision.error = unbiased;
    for (const int other : {4, 8, 16, spectral_bins}) {
        if (other == chosen || (options.spectral && other != spectral_bins)) continue;
        decision.alternatives.push_back({fmt::format("{}", other), cost(other), unbiased});
    }
    decision.override_option = "--wavelengths 4|8|16|40";
    return decision;
}

ModelDecision bounce_decision(const Scene& scene, const RenderOptions& options) {
    const BounceChoice chosen = bounce_choice(scene);
    const SceneAlbedo scene_wide = scene_albedo(scene);
    const double albedo = scene_wide.mean;
    // Surroundings that are closed and alike: albedo^i of the paths have an i-th reflection.
    const auto cost = [&](int reflections) -> DecisionFigure {
        const double most = std::max(0, reflections);
        const double mean =
            albedo < 1 ? albedo * (1 - std::pow(albedo, most)) / (1 - albedo) : most;
        return {mean, "reflections a path",
                fmt::format("estimated: closed surroundings of the scene's mean albedo {:.3g}",
                            albedo)};
    };
    const auto error = [&](int reflections) -> DecisionFigure {
        return {light_beyond(albedo, reflections), "of the light",
                fmt::format("estimated: {:.3g}^{}, what is left in closed surroundings of the "
                            "scene's mean albedo; of its largest, {:.3g}, {:.2g}",
                            albedo, reflections + 1, scene_wide.largest,
                            light_beyond(scene_wide.largest, reflections))};
    };
    ModelDecision decision;
    decision.name = "bounces";
    decision.choice = fmt::format("{}", chosen.reflections);
    decision.reason = chosen.reason;
    decision.override_option = "--max-depth N";
    if (!chosen.limited) {
        const bool untraced = chosen.clear_after <= chosen.reflections && !options.trace_every_ray;
        decision.cost = {
            static_cast<double>(chosen.reflections), "reflections a path",
            untraced ? "proved; rays that leave the surface are not traced" : "proved"};
        decision.error = {0, "of the light", "proved: there are no longer paths"};
        if (scene.max_depth > chosen.reflections) {
            decision.alternatives.push_back(
                {fmt::format("{}, the scene's maxdepth, and every ray traced", scene.max_depth),
                 {static_cast<double>(chosen.reflections), "reflections a path",
                  "proved; a ray more for each, and one for each light sample"},
                 {0, "of the light", "proved: the same picture"}});
        }
        decision.override_option += ", --every-ray";
        return decision;
    }
    decision.cost = cost(chosen.reflections);
    decision.error = error(chosen.reflections);
    std::vector<int> others;
    for (const int depth : {1, 2, 5}) {
        if (depth < chosen.reflections) others.push_back(depth);
    }
    if (albedo > 0 && albedo < 1) {
        constexpr double enough = 1e-3;
        const double needed = std::ceil(std::log(enough) / std::log(albedo)) - 1;
        if (needed < 1e6 && static_cast<int>(needed) > 0 &&
            static_cast<int>(needed) != chosen.reflections) {
            others.push_back(static_cast<int>(needed));
        }
    }
    std::sort(others.begin(), others.end());
    others.erase(std::unique(others.begin(), others.end()), others.end());
    for (const int depth : others) {
        decision.alternatives.push_back({fmt::format("{}", depth), cost(depth), error(depth)});
    }
    return decision;
}

ModelDecision sampler_decision(const Scene& scene, const RenderOptions& options) {
    const SamplerChoice chosen = sampler_choice(scene, options);
    ModelDecision decision;
    decision.name = "sampler";
    decision.choice =
        chosen.batch_size > 1
            ? fmt::format("Owen-scrambled Sobol' points in batches of {}", chosen.batch_size)
            : "independent points";
    decision.reason = chosen.reason;
    const DecisionFigure same{1, "times the time of independent points",
                              "computed: a batch of 1 runs the same code"};
    const DecisionFigure none{0, "of the picture's mean",
                              "proved: every point by itself is uniform"};
    decision.cost = same;
    decision.error = none;
    if (chosen.batch_size > 1) {
        decision.alternatives.push_back({"independent points (batches of 1)", same, none});
    }
    decision.override_option = "--spp N (batches follow from it)";
    return decision;
}

ModelDecision light_decision(const Scene& scene, const RenderOptions& options) {
    const LightChoice chosen = light_choice(scene, options);
    // Of rays spent at a rough surface: one goes on, one may look for a light.
    const auto rays = [](bool samples) -> DecisionFigure {
        return {samples ? 2.0 : 1.0, "rays a reflection at most",
                "computed: one goes on, one looks for a light off rough surfaces"};
    };
    const DecisionFigure none{0, "of the picture's mean",
                              "proved: lobes reach every light that is left to them"};
    ModelDecision decision;
    decision.name = "light sampling";
    decision.choice = !chosen.any             ? "none"
                      : chosen.constant_skies ? "all lights"
                                              : "lights that stand out, by MIS";
    decision.asked = options.sample_every_light;
    decision.reason = chosen.reason;
    decision.cost = rays(chosen.any);
    decision.error = none;
    RenderOptions other = options;
    other.sample_every_light = !options.sample_every_light;
    const LightChoice opposite = light_choice(scene, other);
    if (opposite.any != chosen.any || opposite.constant_skies != chosen.constant_skies) {
        decision.alternatives.push_back(
            {opposite.constant_skies ? "all lights, constant skies too" : "without constant skies",
             rays(opposite.any), none});
    }
    if (!scene.distant_lights.empty() || !scene.point_lights.empty()) {
        decision.alternatives.push_back(
            {"none",
             rays(false),
             {std::nullopt, "", "lights without extent would not be seen at all"}});
    }
    decision.override_option = "--sample-every-light";
    return decision;
}

}  // namespace drude
