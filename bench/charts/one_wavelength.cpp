// As the renderer's own tracers are built.
#define GLM_FORCE_INLINE

#include "bench/charts/one_wavelength.h"

#include "render/batch_tracer_impl.h"

namespace drude {

std::unique_ptr<BatchTracer> make_one_wavelength_tracer(const TracerSetup& setup) {
    return std::make_unique<PacketBatchTracer<Transport::scalar, 1>>(setup);
}

}  // namespace drude
