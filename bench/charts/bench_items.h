// One function an item of `drude bench`; each stands in a file of its own and is listed in
// bench_items.cpp.
#pragma once

#include "bench/charts/bench_item.h"

namespace drude {}  // namespace drude
