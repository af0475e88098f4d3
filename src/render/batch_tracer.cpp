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

std::unique_ptr<BatchTracer> make_batch_tracer(Transport transport, int wavelengths,
                                               const TracerSetup& setup) {
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
