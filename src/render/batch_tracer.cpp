#include "render/batch_tracer.h"

namespace drude {

template <Transport transport>
std::unique_ptr<BatchTracer> make_packet_tracer(int wavelengths, const TracerSetup& setup);
extern template std::unique_ptr<BatchTracer> make_packet_tracer<Transport::scalar>(
    int, const TracerSetup&);
extern template std::unique_ptr<BatchTracer> make_packet_tracer<Transport::intensity>(
    int, const TracerSetup&);
extern template std::unique_ptr<BatchTracer> make_packet_tracer<Transport::stokes>(
    int, const TracerSetup&);

namespace {

void check_strategy(const TracerSetup& setup) {
    if (setup.strategy.directions != SamplingStrategy::Directions::lobe) return;
    if (!setup.scene.distant_lights.empty()) {
        user_error_at(setup.scene.distant_lights[0].place,
                      "paths that sample surfaces alone never find a distant light");
    }
    if (!setup.scene.point_lights.empty()) {
        user_error_at(setup.scene.point_lights[0].place,
                      "paths that sample surfaces alone never find a light without a size");
    }
}

}  // namespace

std::unique_ptr<BatchTracer> make_batch_tracer(Transport transport, int wavelengths,
                                               const TracerSetup& setup) {
    check_strategy(setup);
    switch (transport) {
        case Transport::scalar:
            return make_packet_tracer<Transport::scalar>(wavelengths, setup);
        case Transport::intensity:
            return make_packet_tracer<Transport::intensity>(wavelengths, setup);
        case Transport::stokes:
            break;
    }
    return make_packet_tracer<Transport::stokes>(wavelengths, setup);
}

}  // namespace drude
