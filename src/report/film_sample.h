// The anodised surface of the study: a virtual sample that no bare metal explains.
#pragma once

#include "report/bench_capture.h"

namespace drude {

// Porous alumina of 3 micrometres (a tenth of it pores) on aluminium, the film that Berger et al.
// 2012 (section 4.2) assumed on theirs: captured at their angles every nanometre, for its fringes
// are 17 nm apart at the blue end, with a spectrometer of a pixel a nanometre; fitted as a bare
// surface and as a film on aluminium. Writes sample.json, bench.json, recipe.json, measurement.csv
// with its journal, fitted.json and bare.json to `site`.
StudyFilm study_film(CaptureSite site, const Calibration& calibration, const Provenance& provenance,
                     int threads);

}  // namespace drude
