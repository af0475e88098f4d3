#include "render/batch_tracer_impl.h"

namespace drude {

template std::unique_ptr<BatchTracer> make_packet_tracer<Transport::intensity>(int,
                                                                               const TracerSetup&);

}  // namespace drude
