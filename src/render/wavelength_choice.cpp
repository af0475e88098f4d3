#include "render/wavelength_choice.h"

#include "render/batch_tracer.h"

namespace drude {

WavelengthChoice cheapest_exact_wavelengths(const Scene&, const RenderOptions& options) {
    if (options.spectral) {
        return {spectral_bins, "spectral layers are wanted, and a path fills every one of them"};
    }
    // The grid's phase is drawn at random for each path, so R, G, B are without bias for any
    // number.
    return {8, "R, G, B are without bias for any number, and eight fill a vector register"};
}

}  // namespace drude
