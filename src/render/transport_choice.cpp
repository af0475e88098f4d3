#include "render/transport_choice.h"

#include <algorithm>
#include <vector>

#include "render/bounce_choice.h"
#include "render/convexity.h"
#include "render/light_polarisation.h"
#include "render/optical_elements.h"

namespace drude {

std::string_view transport_name(Transport transport) {
    switch (transport) {
        case Transport::scalar:
            return "scalar";
        case Transport::intensity:
            return "intensity";
        case Transport::stokes:
            break;
    }
    return "stokes";
}

namespace {

// How often light may be polarised at one meeting with a surface.
enum class Polarises { never, once, repeatedly };

Polarises polarises(const Scene& scene, int material);

struct PolarisesVisitor {
    const Scene& scene;
    Polarises operator()(const ConductorMaterial&) const { return Polarises::once; }
    Polarises operator()(const DiffuseMaterial&) const { return Polarises::never; }
    Polarises operator()(const DiffuseTransmissionMaterial&) const { return Polarises::never; }
    // Light that goes in meets the same surface again from within.
    Polarises operator()(const DielectricMaterial&) const { return Polarises::repeatedly; }
    // The sum over its inner reflections is taken in one step.
    Polarises operator()(const ThinDielectricMaterial&) const { return Polarises::repeatedly; }
    // Between its surface and a diffuse base light forgets; between that and a metal it does not.
    Polarises operator()(const CoatedMaterial& m) const {
        return std::holds_alternative<DiffuseMaterial>(m.base) ? Polarises::once
                                                               : Polarises::repeatedly;
    }
    Polarises operator()(const MixMaterial& m) const {
        return std::max(polarises(scene, m.first), polarises(scene, m.second));
    }
    Polarises operator()(const OpticalElementMaterial&) const { return Polarises::repeatedly; }
    Polarises operator()(const PluginMaterial&) const { return Polarises::once; }
};

Polarises polarises(const Scene& scene, int material) {
    if (material < 0) return Polarises::never;
    return std::visit(PolarisesVisitor{scene}, scene.materials[material]);
}

}  // namespace

TransportChoice cheapest_exact_transport(const Scene& scene, int max_depth) {
    const auto intensity = [](std::string reason) {
        return TransportChoice{Transport::intensity, std::move(reason)};
    };
    if (scene.camera.analyser) return intensity("an analyser stands before the camera");
    if (has_polarised_lights(scene)) return intensity("some light is polarised at its source");
    std::vector<const Shape*> polarising;
    size_t scattering = 0;
    Polarises worst = Polarises::never;
    for (const Shape& shape : scene.shapes) {
        if (shape.material < 0) continue;
        if (is_optical_element(scene, shape)) {
            return intensity("there are polarisers or retarders in the scene");
        }
        ++scattering;
        const Polarises how = polarises(scene, shape.material);
        worst = std::max(worst, how);
        if (how != Polarises::never) polarising.push_back(&shape);
    }
    if (worst == Polarises::never) {
        return {Transport::scalar, "nothing in the scene polarises light"};
    }
    if (worst == Polarises::repeatedly) {
        // A coat polarises more than once within one reflection.
        if (max_depth < 1) return {Transport::scalar, "paths have no reflection"};
        return intensity("a surface polarises light more than once before it is forgotten");
    }
    if (max_depth <= 1) {
        return {Transport::scalar, "paths have one reflection at most, and lights are unpolarised"};
    }
    if (polarising.size() == 1 && reflects_once(*polarising[0], scene.camera, scattering == 1)) {
        return {Transport::scalar,
                "the only surface that polarises is seen from its convex side alone, so no path is "
                "reflected by it twice"};
    }
    return intensity("a path may be reflected by metal more than once, and only S0 is wanted");
}

TransportChoice transport_choice(const Scene& scene, const RenderOptions& options) {
    if (options.stokes || (options.transport && *options.transport == Transport::stokes)) {
        return {Transport::stokes, "S0..S3 are wanted"};
    }
    if (options.transport) return {*options.transport, "asked for"};
    TransportChoice choice = cheapest_exact_transport(scene, scene.max_depth);
    const int reflections = bounce_choice(scene).reflections;
    if (choice.transport != Transport::scalar && reflections < scene.max_depth) {
        choice = cheapest_exact_transport(scene, reflections);
    }
    return choice;
}

}  // namespace drude
