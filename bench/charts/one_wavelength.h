// A tracer whose paths carry a single wavelength: what packets are measured against.
#pragma once

#include <memory>

#include "render/batch_tracer.h"

namespace drude {

// Transport scalar, on plain floats.
std::unique_ptr<BatchTracer> make_one_wavelength_tracer(const TracerSetup& setup);

}  // namespace drude
