// The anodised surface of the study: a virtual sample that no bare metal explains.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "report/study_data.h"

namespace drude {

// Porous alumina of 3 micrometres (a tenth of it pores) on aluminium, the film that Berger et al.
// 2012 (section 4.2) assumed on theirs: measured at their angles every nanometre, for its fringes
// are 17 nm apart at the blue end; fitted as a bare surface and as a film on aluminium. Writes
// anodised-aluminium/measurement.csv, sample.json, fitted.json and bare.json into `folder` and
// appends their names to `files`.
StudyFilm study_film(const std::string& folder, uint64_t seed, const Provenance& provenance,
                     int threads, std::vector<std::string>* files);

}  // namespace drude
