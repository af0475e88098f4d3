// What models cost beside each other, measured: processor time a sample.
//
// `drude bench defaults` measures them anew and says where they differ from these.
#pragma once

#include "render/throughput.h"

namespace drude {

inline constexpr const char* measured_costs = "measured: drude bench defaults";

// Of a whole render with 8 wavelengths over that of scalar transport; medians over the box of
// metals, the half-sphere and the two metals.
double transport_cost(Transport transport);

// Of a whole render over that of 8 wavelengths, by the transport.
double wavelengths_cost(Transport transport, int wavelengths);

// Nanoseconds of one reflection at 8 wavelengths: off bare metal by formula, off a film's table,
// off a film of one layer by formula without any average.
inline constexpr double bare_ns = 20, film_table_ns = 28, film_formula_ns = 96;

}  // namespace drude
