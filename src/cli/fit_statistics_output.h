// What `drude fit` prints beside n and k: literature, robust loss, bootstrap, profiles.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "report/fit_report.h"

namespace drude {

// Adds "literature" (null where it was not compared) and, where they were asked for, "robust",
// "bootstrap" and "profile".
void add_statistics(const FitReport& report, nlohmann::ordered_json* document);

// `every_wavelength`: n and k of the bootstrap and the profiles too, not only their summary.
void print_statistics(const FitReport& report, bool every_wavelength);

}  // namespace drude
