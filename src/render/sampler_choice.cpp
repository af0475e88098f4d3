#include "render/sampler_choice.h"

#include "render/film_sums.h"
#include "render/sampler.h"

namespace drude {

SamplerChoice sampler_choice(const Scene& scene, const RenderOptions& options) {
    constexpr int usual_batch = 16;
    SamplerChoice choice;
    choice.batch_size = usual_batch;
    choice.reason = "16 points share the space out, and many batches tell the error";
    if ((options.seconds || options.error) && !options.samples_per_pixel) return choice;
    const int samples = options.samples_per_pixel.value_or(scene.samples_per_pixel);
    choice.samples = samples;
    int& size = choice.batch_size;
    while (size > 1 && size * 2 > samples) size /= 2;
    while (size < largest_batch && samples / size >= static_cast<int>(most_terms)) size *= 2;
    if (size < usual_batch) {
        choice.reason = "so few samples a pixel, in two batches, so that their error can be told";
    } else if (size > usual_batch) {
        choice.reason = "so many samples a pixel that the exact sums take them in larger batches";
    }
    return choice;
}

}  // namespace drude
