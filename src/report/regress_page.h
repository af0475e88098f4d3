// The result of a regression run as one self-contained page: what failed first, each with the new
// picture, the reference and their difference.
#pragma once

#include <string>

#include "regress/regress.h"

namespace drude {

// S0 (or R, G, B) under one exposure for both pictures; S1, S2, S3 over the mean S0, from -scale
// to scale on the diverging map; the difference in standard errors, -6 to 6. Throws Error
// (outside) where the module that encodes PNGs cannot be loaded.
std::string regress_page(const ReferenceManifest& manifest, const RegressResult& run);

}  // namespace drude
