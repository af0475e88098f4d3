// The fit of one metal of a study, as `drude fit` would report it.
#pragma once

#include "report/fit_report.h"
#include "report/study_data.h"

namespace drude {

// Put together from the fitted constants and their standard deviations, which is all that a point
// by point fit of a bare surface consists of; compared with what is published of the sample's
// metal.
FitReport fit_report_of(const StudyMetal& metal);

}  // namespace drude
