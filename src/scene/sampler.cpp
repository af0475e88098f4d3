// Sampler: how many samples a pixel, and the seed. The sample points are always the project's own.
#include <limits>

#include "scene/builders.h"
#include "scene/vocabulary.h"

namespace drude {

void build_sampler(const std::string& name, ParameterList& list, Messages& messages, Scene& scene) {
    constexpr int most = 1 << 30;
    if (name == "stratified") {
        const int x = list.integer_in("xsamples", 4, 1, 1 << 15);
        const int y = list.integer_in("ysamples", 4, 1, 1 << 15);
        scene.samples_per_pixel = x * y;
        list.boolean("jitter", true);
    } else {
        scene.samples_per_pixel = list.integer_in("pixelsamples", 16, 1, most);
    }
    scene.seed = static_cast<uint64_t>(
        list.integer_in("seed", static_cast<int>(scene.seed), 0, std::numeric_limits<int>::max()));
    list.text("randomization", "");
    list.finish(known_parameters("Sampler", name), messages);
    messages.note(list.place(),
                  fmt::format("Sampler \"{}\": the project's own scrambled low-discrepancy samples "
                              "are used, with the number and the seed given here",
                              name));
}

}  // namespace drude
