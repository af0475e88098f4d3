// Integrator: the length of paths. There is one way to render, path tracing.
#include <limits>

#include "scene/builders.h"
#include "scene/vocabulary.h"

namespace drude {

void build_integrator(const std::string& name, ParameterList& list, Messages& messages,
                      Scene& scene) {
    if (name == "ambientocclusion" || name == "function") {
        messages.stand_in(list.place(),
                          fmt::format("Integrator \"{}\" draws no light transport and is not "
                                      "modelled; path tracing stands in",
                                      name));
        list.ignore(known_parameters("Integrator", name));
        return;
    }
    scene.max_depth = list.integer_in("maxdepth", 5, 0, std::numeric_limits<int>::max());
    if (list.boolean("regularize", false)) {
        messages.stand_in(list.place_of("regularize"),
                          "Integrator: regularize is not modelled; lobes are rendered as they are");
    }
    list.text("lightsampler", "");
    if (name != "path" && name != "volpath" && name != "simplepath" && name != "simplevolpath") {
        messages.note(list.place(),
                      fmt::format("Integrator \"{}\": path tracing is used, which converges to the "
                                  "same picture",
                                  name));
        // How these sample is all that their other parameters say.
        list.ignore(known_parameters("Integrator", name));
        return;
    }
    list.boolean("samplelights", true);
    list.boolean("samplebsdf", true);
    list.finish(known_parameters("Integrator", name), messages);
}

}  // namespace drude
